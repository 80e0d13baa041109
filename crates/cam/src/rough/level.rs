//! One level: where the tool's centre may be, and the loops there.

use super::chain;
use super::family::family;
use super::job::{Engine, RoughError, RoughJob};
use crate::plan::{Group, Link, Plan, PlanError, PlannedLoop, plan_from};
use crate::surface::{ClSurface, HeightGrid};
use pocketry_geom::skeleton::Skeleton;
use pocketry_geom::tolerance::surface::{INSET, LEVEL};
use pocketry_geom::{Contour, Region};

/// The tool must reach this share of its radius into the stock for a part of a level to be cut.
const LEAST_REACH: f64 = 0.01;

/// A level and how it is cut.
#[derive(Clone, Debug, Default)]
pub struct Level {
    /// Height of its floor, mm.
    pub z: f64,
    /// Height of the floor above, mm.
    pub top: f64,
    /// Where the tool's centre may be.
    pub region: Region,
    /// The loops in the order they are made.
    pub loops: Vec<PlannedLoop>,
    /// The ways between them.
    pub links: Vec<Link>,
    /// The groups of loops; the tool lifts between them.
    pub groups: Vec<Group>,
    /// What the machinist should know.
    pub(super) warnings: Vec<String>,
}

pub(super) fn plan_level(
    grid: &HeightGrid,
    surface: &ClSurface,
    job: &RoughJob,
    top: f64,
    z: f64,
) -> Result<Level, RoughError> {
    let admits = |p| job.stock.distance(p) < job.overhang();
    let free = grid.free_region(surface, z + LEVEL, &admits).map_err(|error| RoughError::Region { z, error })?;
    let mut level = Level { z, top, region: with_stock(&free, job), ..Level::default() };
    if level.region.contours().is_empty() {
        return Ok(level);
    }
    if job.engine == Engine::Voronoi {
        by_skeleton(&mut level, job)?;
    } else {
        by_loops(&mut level, job)?;
    }
    if level.loops.is_empty() {
        level.warnings.push(format!("level z {z:.3} mm: what can be reached is narrower than the tolerances"));
    }
    Ok(level)
}

/// Plans a level like a flat pocket.
fn by_skeleton(level: &mut Level, job: &RoughJob) -> Result<(), RoughError> {
    let (top, z) = (level.top, level.z);
    let skeleton = Skeleton::build(&level.region).map_err(|error| RoughError::Skeleton { z, error })?;
    match plan_from(&level.region, &skeleton, &job.pocket(top, z), INSET) {
        Ok(Plan { loops, links, groups, .. }) => {
            (level.loops, level.links, level.groups) = (loops, links, groups);
            Ok(())
        }
        // Parts no wider than the tolerances.
        Err(PlanError::DoesNotFit { .. }) => Ok(()),
        Err(other) => Err(other.into()),
    }
}

/// Plans a level from nothing but an engine's loops.
fn by_loops(level: &mut Level, job: &RoughJob) -> Result<(), RoughError> {
    let (z, radius) = (level.z, job.tool.radius());
    let stepover = job.stepover.min(radius);
    let family =
        family(&level.region, job.engine, INSET, stepover, radius).map_err(|error| RoughError::Offset { z, error })?;
    chain::order(level, &family, job);
    Ok(())
}

/// The parts of a region from which the tool reaches stock: those whose boundary comes near enough, and those that hold all
/// of the stock.
fn with_stock(region: &Region, job: &RoughJob) -> Region {
    let near = (1.0 - LEAST_REACH) * job.tool.radius();
    let reaches = |c: &Contour| c.segments.iter().any(|s| job.stock.distance(s.start()) < near);
    let middle = job.stock.plan().center();
    let mut contours = Vec::new();
    let mut parents = Vec::new();
    for pocket in region.pockets() {
        let own = std::iter::once(&pocket.outer).chain(&pocket.islands);
        let own: Vec<Contour> = own.map(|&c| region.contours()[c as usize].clone()).collect();
        let outer = contours.len() as u32;
        let own_parents: Vec<Option<u32>> = (0..own.len()).map(|k| (k > 0).then_some(0)).collect();
        let part = Region::from_parts_unchecked(own, own_parents);
        if part.contours().iter().any(reaches) || part.contains(middle) {
            parents.extend(part.parents().iter().map(|p| p.map(|_| outer)));
            contours.extend(part.contours().iter().cloned());
        }
    }
    Region::from_parts_unchecked(contours, parents)
}
