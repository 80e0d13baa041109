//! The forest of the connected parts of successive erosions: figure 8 of the paper.

use super::MOST_LEVELS;
use crate::plan::PlanError;
use pocketry_geom::distance::Boundary;
use pocketry_geom::offset::morphology::eroded;
use pocketry_geom::{Contour, Point, Region};

/// Points of a part's outline that say which part is around it, and where on their segments they lie.
const VOTES: usize = 9;
const VOTE_AT: f64 = 0.437;

/// A connected part of an erosion.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// Its outer contour and then its islands, the part to the left.
    pub(super) contours: Vec<Contour>,
    /// The parts of the next erosion inside it.
    pub(super) children: Vec<u32>,
    /// Number of the erosion, from 0.
    pub(super) level: usize,
}

/// All parts.
#[derive(Clone, Debug)]
pub(super) struct Forest {
    pub(super) parts: Vec<Part>,
    /// The parts of the first erosion.
    pub(super) roots: Vec<u32>,
    /// The first erosion's boundary: no way may cross it.
    pub(super) limit: Boundary,
}

impl Forest {
    /// The parts of `first` and of its successive erosions by `step`.
    pub(super) fn new(first: Region, step: &Contour) -> Result<Self, PlanError> {
        let mut forest = Self { parts: Vec::new(), roots: Vec::new(), limit: Boundary::new(&first) };
        let mut parents: Vec<u32> = Vec::new();
        let mut region = first;
        for level in 0..MOST_LEVELS {
            let new = forest.add(&region, level);
            if level == 0 {
                forest.roots.clone_from(&new);
            } else {
                forest.hang(&new, &parents);
            }
            region = eroded(&region, step, Point::ORIGIN)?;
            if region.contours().is_empty() {
                return Ok(forest);
            }
            parents = new;
        }
        Err(PlanError::Job { what: "stepover", value: step.bbox().size() })
    }

    fn add(&mut self, region: &Region, level: usize) -> Vec<u32> {
        let contours = region.contours();
        let first = self.parts.len() as u32;
        self.parts.extend(region.pockets().iter().map(|pocket| {
            let all = std::iter::once(pocket.outer).chain(pocket.islands.iter().copied());
            Part { contours: all.map(|k| contours[k as usize].clone()).collect(), children: Vec::new(), level }
        }));
        (first..self.parts.len() as u32).collect()
    }

    /// Hangs each part on the one around it.
    fn hang(&mut self, parts: &[u32], parents: &[u32]) {
        let regions: Vec<Region> = parents.iter().map(|&p| self.region(p)).collect();
        let boxes: Vec<_> = regions.iter().map(Region::bbox).collect();
        for &part in parts {
            // Rounding may misplace one point, or leave a thin part beside all others.
            let outline = &self.parts[part as usize].contours[0].segments;
            let points: Vec<_> = outline.iter().step_by(outline.len().div_ceil(VOTES)).map(|s| s.at(VOTE_AT)).collect();
            let votes = |k: usize| points.iter().filter(|p| boxes[k].contains(**p) && regions[k].contains(**p)).count();
            let found = (0..parents.len()).max_by_key(|&k| (votes(k), std::cmp::Reverse(k))).unwrap_or(0);
            self.parts[parents[found] as usize].children.push(part);
        }
    }

    fn region(&self, part: u32) -> Region {
        let contours = self.parts[part as usize].contours.clone();
        let parents = (0..contours.len()).map(|k| (k > 0).then_some(0)).collect();
        Region::from_parts_unchecked(contours, parents)
    }
}
