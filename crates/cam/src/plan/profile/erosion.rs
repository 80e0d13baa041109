//! Where a profile may be in a region: the erosion of the region by it.
//!
//! The places at which the profile `B` touches a wall from inside with parallel tangents are sums of a point of the wall and a point of
//! `−B` with the same normal, away from the wall; for lines and arcs these are lines and arcs (`touch`). They are cut where they cross,
//! parts at whose middle a wall comes into the profile are dropped, and what is left closes to the outline of the erosion.
//! The profile is grown by a trifle first, so that slots exactly as wide as it vanish, whatever the rounding.

use super::touch::touching;
use crate::plan::PlanError;
use pocketry_geom::chain::chain;
use pocketry_geom::distance::Boundary;
use pocketry_geom::index::SegmentIndex;
use pocketry_geom::intersect::{Closeness, Contact, contacts};
use pocketry_geom::repair::{RegionError, RepairOptions, build};
use pocketry_geom::tolerance::profile::{ENTERED, GROWTH, JOINED, SHORTEST};
use pocketry_geom::tolerance::touch_length;
use pocketry_geom::{Contour, Point, Region, Segment};
use rayon::prelude::*;
use std::ops::ControlFlow;

/// The places at which a counter-clockwise contour about its reference point, with this point inside it, lies in a region.
pub(super) fn eroded(region: &Region, profile: &Contour, inside: Point) -> Result<Region, PlanError> {
    let profile = scaled(profile, inside, 1.0 + GROWTH);
    let size = region.bbox().size().max(profile.bbox().size());
    let raw: Vec<Segment> = touching(region, &profile).into_iter().filter(|s| s.length() > SHORTEST * size).collect();
    let touch = touch_length(region.bbox());
    let pieces = split(&raw, Closeness { touch, lens: touch }, SHORTEST * size);
    let judge = Judge::new(region, &profile, inside, ENTERED * size);
    let kept: Vec<Segment> =
        pieces.into_par_iter().filter(|s| s.length() > SHORTEST * size && judge.admits(s.at(0.5))).collect();
    let chains = chain(&kept, JOINED * size);
    if let Some(open) = chains.open.first() {
        return Err(PlanError::ProfileOutline { at: open.end });
    }
    let area = JOINED * size * size;
    let loops: Vec<Contour> = chains.closed.into_iter().map(|(c, _)| c).filter(|c| c.area().abs() > area).collect();
    if loops.is_empty() {
        return Ok(Region::default());
    }
    match build(loops, &RepairOptions { join_tolerance: JOINED * size }) {
        Ok(healed) => Ok(healed.region),
        Err(RegionError::Nothing { .. }) => Ok(Region::default()),
        Err(_) => Err(PlanError::ProfileOutline { at: kept[0].start() }),
    }
}

/// A contour scaled about a point.
fn scaled(contour: &Contour, about: Point, factor: f64) -> Contour {
    let moved = |[x, y, bulge]: [f64; 3]| [about.x + factor * (x - about.x), about.y + factor * (y - about.y), bulge];
    Contour::from_vertices(&contour.to_vertices().into_iter().map(moved).collect::<Vec<_>>())
}

/// Curves cut where they meet.
fn split(curves: &[Segment], closeness: Closeness, least: f64) -> Vec<Segment> {
    let index = SegmentIndex::new(curves);
    let mut cuts: Vec<Vec<Point>> = vec![Vec::new(); curves.len()];
    let _: ControlFlow<()> = index.visit_pairs(closeness.touch, |i, j| {
        contacts(&curves[i], &curves[j], closeness, |contact| match contact {
            Contact::Crossing { at, .. } | Contact::Tangent(at) => {
                cuts[i].push(at);
                cuts[j].push(at);
            }
            Contact::FirstEnd { start, .. } => {
                cuts[j].push(if start { curves[i].start() } else { curves[i].end() });
            }
            Contact::SecondEnd { start } => cuts[i].push(if start { curves[j].start() } else { curves[j].end() }),
        });
        ControlFlow::Continue(())
    });
    curves.iter().zip(cuts).flat_map(|(curve, cuts)| parts(curve, cuts, least)).collect()
}

/// A curve cut at points of it, but no nearer to its ends than `least`.
fn parts(curve: &Segment, mut cuts: Vec<Point>, least: f64) -> Vec<Segment> {
    let along = |p: &Point| match curve {
        Segment::Line(l) => p.distance(l.start),
        Segment::Arc(a) => {
            let turn = (a.start - a.center).angle_to(*p - a.center);
            let ahead = if a.ccw { turn } else { -turn };
            if ahead < 0.0 { ahead + std::f64::consts::TAU } else { ahead }
        }
    };
    cuts.retain(|p| p.distance(curve.start()) > least && p.distance(curve.end()) > least);
    cuts.sort_by(|p, q| along(p).total_cmp(&along(q)));
    cuts.dedup();
    let mut rest = *curve;
    let mut out = Vec::with_capacity(cuts.len() + 1);
    for p in cuts {
        let (before, after) = rest.split_at(p);
        out.push(before);
        rest = after;
    }
    out.push(rest);
    out
}

/// Says where the profile may be.
struct Judge {
    walls: Boundary,
    profile: Boundary,
    outline: Contour,
    /// A point within the profile.
    inside: Point,
    /// How deep a wall may come into the profile and still count as touching it, mm.
    entered: f64,
}

impl Judge {
    fn new(region: &Region, profile: &Contour, inside: Point, entered: f64) -> Self {
        let own = Region::from_parts_unchecked(vec![profile.clone()], vec![None]);
        Self { walls: Boundary::new(region), profile: Boundary::new(&own), outline: profile.clone(), inside, entered }
    }

    fn admits(&self, at: Point) -> bool {
        if !self.walls.contains(at + self.inside.to_vec()) {
            return false;
        }
        let bbox = self.outline.translated(at.to_vec()).bbox();
        let mut free = true;
        self.walls.index().visit(bbox, 0.0, |_, wall| {
            free = free && !self.is_entered_by(&wall.translated(-at.to_vec()));
        });
        free
    }

    /// Whether a wall, seen from the reference point, comes into the profile: its ends, or its middles between crossings of the outline.
    fn is_entered_by(&self, wall: &Segment) -> bool {
        let mut cuts = Vec::new();
        let closeness = Closeness { touch: 0.0, lens: 0.0 };
        for edge in &self.outline.segments {
            contacts(wall, edge, closeness, |contact| match contact {
                Contact::Crossing { at, .. } | Contact::Tangent(at) => cuts.push(at),
                Contact::SecondEnd { start } => cuts.push(if start { edge.start() } else { edge.end() }),
                Contact::FirstEnd { .. } => {}
            });
        }
        let middles = parts(wall, cuts, self.entered).into_iter().map(|s| s.at(0.5));
        middles.chain([wall.start(), wall.end()]).any(|p| self.profile.signed_distance(p) > self.entered)
    }
}
