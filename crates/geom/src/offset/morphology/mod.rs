//! Offsets by any cross-section: the morphological erosion of R. Molina-Carmona, A. Jimeno and M. Davia, *Contour pocketing computation
//! using mathematical morphology*, section 2.
//!
//! The erosion of a region by a profile `B` is the set of places of the profile's reference point at which the profile lies in the
//! region. Equations 3 and 4 of the paper disagree about touching; here containment is closed: a profile may touch walls.
//!
//! 1. *Instant basic operations* (`touch`): the places at which `B` touches a wall from inside with parallel tangents are sums of a
//!    point of the wall and a point of `−B` with the same normal, away from the wall. The paper takes them one by one at a step along
//!    the trajectory; for lines and arcs they are lines and arcs, and taken whole, at corners for the whole range of normals.
//! 2. They are cut where they cross, through an index, rather than left with gaps as in the paper.
//! 3. *Collision* (`Judge`): parts at whose middle a wall comes into the profile are dropped. An index finds the walls that may.
//! 4. What is left closes to loops. Where it does not, places coincide within rounding: all is done anew with a profile a trifle
//!    larger, a few times at most. What does not close even then is a [`MorphologyError`].
//!
//! **Exactness.** With lines and arcs on both sides there is no step, and so no error of one. The profile is grown by
//! [`GROWTH`] first, so that slots exactly as wide as it vanish, whatever the rounding; gaps up to [`JOINED`] of the size are closed.
//!
//! **Cost.** O(m k) for walls and edges of the profile in step 1, then O(n log n + c) for n pieces with c crossings.
//!
//! Not there: profiles that turn with the walls, dilation, opening and closing, curves that are neither lines nor arcs.

mod touch;

#[cfg(test)]
mod tests;

use crate::chain::chain;
use crate::contour::Contour;
use crate::distance::Boundary;
use crate::index::SegmentIndex;
use crate::intersect::{Closeness, Contact, contacts};
use crate::point::Point;
use crate::region::Region;
use crate::repair::{RegionError, RepairOptions, build};
use crate::segment::Segment;
use crate::tolerance::profile::{ATTEMPTS, ENTERED, GROWTH, JOINED, SHORTEST};
use crate::tolerance::touch_length;
use rayon::prelude::*;
use std::ops::ControlFlow;
use touch::touching;

/// Why a region could not be eroded.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum MorphologyError {
    /// The outline of the places at which the profile may be does not close.
    #[error(
        "the places of this tool profile have no clear outline near ({:.4}, {:.4}); look for walls there that run along one another \
         within a micrometre, or change the profile's size a little",
        .at.x, .at.y
    )]
    Outline {
        /// A place of the tool there.
        at: Point,
    },
}

/// The places at which a profile lies in a region; empty where it fits nowhere. The profile is a counter-clockwise contour, convex or
/// not, about its reference point at the origin; `inside` is a point within it.
///
/// # Errors
/// Where the outline of the places does not close, with a place.
pub fn eroded(region: &Region, profile: &Contour, inside: Point) -> Result<Region, MorphologyError> {
    let mut outcome = attempt(region, profile, inside, GROWTH);
    for growth in (2..=ATTEMPTS).map(|k| f64::from(k) * GROWTH) {
        if outcome.is_ok() {
            break;
        }
        outcome = attempt(region, profile, inside, growth).or(outcome);
    }
    outcome
}

/// The places of a profile that is grown by a part of it.
fn attempt(region: &Region, profile: &Contour, inside: Point, growth: f64) -> Result<Region, MorphologyError> {
    let profile = scaled(profile, inside, 1.0 + growth);
    let size = region.bbox().size().max(profile.bbox().size());
    let raw: Vec<Segment> = touching(region, &profile).into_iter().filter(|s| s.length() > SHORTEST * size).collect();
    let touch = touch_length(region.bbox());
    let pieces = split(&raw, Closeness { touch, lens: touch }, SHORTEST * size);
    let judge = Judge::new(region, &profile, inside, ENTERED * size);
    let kept: Vec<Segment> =
        pieces.into_par_iter().filter(|s| s.length() > SHORTEST * size && judge.admits(s.at(0.5))).collect();
    let chains = chain(&kept, JOINED * size);
    if let Some(open) = chains.open.first() {
        return Err(MorphologyError::Outline { at: open.end });
    }
    // Loops go for being thin, not for being small: a tight place just wider than the profile is one.
    let is_wide = |c: &Contour| c.area().abs() > JOINED * size * c.length();
    let loops: Vec<Contour> = chains.closed.into_iter().map(|(c, _)| c).filter(is_wide).collect();
    if loops.is_empty() {
        return Ok(Region::default());
    }
    match build(loops, &RepairOptions { join_tolerance: JOINED * size }) {
        Ok(healed) => Ok(healed.region),
        Err(RegionError::Nothing { .. }) => Ok(Region::default()),
        Err(_) => Err(MorphologyError::Outline { at: kept[0].start() }),
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
        // A wall along an edge leaves it at a corner, which must not fall between the two edges there.
        let closeness = Closeness { touch: self.entered, lens: self.entered };
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
