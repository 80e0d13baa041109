//! Which tool: what a round tool leaves in corners and necks, computed from the skeleton, and the bottlenecks that it can't
//! pass (Chou and Cohen, section 4: "this allows us to select a tool with maximum size to satisfy a given tolerance").
//!
//! **Scallop.** A tool of radius `r` cuts everything within `r` of where its axis can be: of the points whose clearance is at
//! least `r`. Its largest scallop is the largest distance of a point of the region from what is cut. Between loops there is none
//! as long as the stepover is at most the radius; so scallops lie in corners and in necks and bays too narrow for the tool. The
//! distance grows away from the axis' region, up to the walls: the maximum is sought on the walls and at the vertices of
//! the skeleton. Along a wall the distance changes no faster than the length, which bounds it on every piece
//! between two places where it is known; pieces are halved until no bound exceeds what was found by more than the tolerance:
//! the result is certified, not sampled.

use crate::job::PocketJob;
use pocketry_geom::index::SegmentIndex;
use pocketry_geom::offset::voronoi::EdgeCurve;
use pocketry_geom::offset::{Degenerate, OffsetError, OffsetOptions, VoronoiOffsetter, degenerate_slack};
use pocketry_geom::skeleton::{EdgeId, SiteShape, Skeleton, VertexId};
use pocketry_geom::subpockets::{Border, Subpockets};
use pocketry_geom::tolerance::GOUGE;
use pocketry_geom::{Arc, Point, Segment};
use serde::Serialize;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// How exactly scallops are found, mm: a tenth of what a program may gouge.
const TOLERANCE: f64 = 0.1 * GOUGE;

/// The largest scallop that a tool leaves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Scallop {
    /// Distance of its farthest point from what is cut, mm.
    pub size: f64,
    /// That point.
    pub at: Point,
}

/// The narrowest place that a tool can't pass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Neck {
    /// Its middle.
    pub at: Point,
    /// Width, mm.
    pub width: f64,
    /// How many such places there are.
    pub count: usize,
}

/// A skeleton prepared for questions about tools.
#[derive(Debug)]
pub struct ToolChooser<'a> {
    skeleton: &'a Skeleton,
    offsetter: VoronoiOffsetter<'a>,
    subpockets: Subpockets,
}

impl<'a> ToolChooser<'a> {
    /// Prepares a skeleton, in O(n log n).
    pub fn new(skeleton: &'a Skeleton) -> Self {
        Self { skeleton, offsetter: VoronoiOffsetter::new(skeleton), subpockets: Subpockets::new(skeleton) }
    }

    /// The largest scallop of a tool of this radius, mm, to within a tenth of what a program may gouge; `None` where the
    /// tool fits nowhere.
    ///
    /// # Errors
    /// When the radius is not a positive number.
    pub fn scallop(&self, radius: f64) -> Result<Option<Scallop>, OffsetError> {
        let offset = self.offsetter.offset(radius, &OffsetOptions { degenerate: Degenerate::Keep })?;
        let mut axis: Vec<Segment> = offset.loops.into_iter().flat_map(|l| l.contour.segments).collect();
        for path in offset.degenerate {
            axis.push(Segment::line(path.start, path.start));
            axis.extend(path.tour);
        }
        if axis.is_empty() {
            return Ok(None);
        }
        let index = SegmentIndex::new(&axis);
        let size = |at: Point| {
            let beyond = index.nearest(at).map_or(0.0, |n| n.1) - radius;
            // Less is rounding.
            Scallop { size: if beyond > TOLERANCE { beyond } else { 0.0 }, at }
        };
        let start = Scallop { size: 0.0, at: axis[0].start() };
        let low = self.skeleton.vertices().iter().filter(|v| v.clearance < radius).map(|v| size(v.point));
        let start = low.fold(start, larger);
        Ok(Some(farthest(&self.unswept(radius), start, size)))
    }

    /// The parts of the walls below edges, or parts of edges, of less clearance: all others are reached.
    fn unswept(&self, radius: f64) -> Vec<Segment> {
        let part = |e: EdgeId| {
            let s = self.skeleton;
            let (from, to) = (s.origin_clearance(e), s.target_clearance(e));
            if from.min(to) >= radius {
                return None;
            }
            let curve = EdgeCurve::new(s, e);
            let place = |v: VertexId, c: f64| {
                if c > radius { curve.at_clearance(radius) } else { s.vertices()[v as usize].point }
            };
            let (a, b) = (place(s.origin(e), from), place(s.target(e), to));
            let (wall, whole) = match s.sites()[s.site(e) as usize].shape {
                SiteShape::Line(l) => (Segment::line(l.nearest(a), l.nearest(b)), Segment::Line(l)),
                SiteShape::Arc(c) => {
                    (Segment::Arc(Arc { start: c.nearest(a), end: c.nearest(b), ..c }), Segment::Arc(c))
                }
                SiteShape::Point(_) => return None,
            };
            // Feet run forward along a wall; below a spoke, and where rounding turns them round, there is nothing.
            (wall.start() != wall.end() && wall.length() <= whole.length()).then_some(wall)
        };
        (0..self.skeleton.half_edges().len() as EdgeId).filter_map(part).collect()
    }

    /// The narrowest place that a tool of this radius can't pass and has a side that it can reach.
    pub fn neck(&self, radius: f64) -> Option<Neck> {
        let limit = radius - degenerate_slack(radius);
        let wide = |k: &u32| self.subpockets.list().get(*k as usize).is_some_and(|s| s.clearance >= limit);
        let narrow: Vec<&Border> =
            self.subpockets.borders().iter().filter(|b| b.clearance < limit && b.between.iter().any(wide)).collect();
        let least = narrow.iter().min_by(|a, b| a.clearance.total_cmp(&b.clearance))?;
        Some(Neck { at: least.pass, width: 2.0 * least.clearance, count: narrow.len() })
    }

    /// The largest of these diameters (mm) whose scallop, with the job's stock to leave, is at most `scallop`.
    ///
    /// # Errors
    /// When a diameter is not a positive number.
    pub fn largest(&self, diameters: &[f64], scallop: f64, job: &PocketJob) -> Result<Option<f64>, OffsetError> {
        let mut sorted = diameters.to_vec();
        sorted.sort_by(|a, b| b.total_cmp(a));
        for diameter in sorted {
            let radius = 0.5 * diameter + job.stock_to_leave;
            if self.scallop(radius)?.is_some_and(|s| s.size <= scallop) {
                return Ok(Some(diameter));
            }
        }
        Ok(None)
    }
}

fn larger(a: Scallop, b: Scallop) -> Scallop {
    if b.size > a.size { b } else { a }
}

/// A piece of a wall and a bound of the scallop on it.
struct Piece {
    bound: f64,
    length: f64,
    wall: Segment,
    /// Parameters of its ends.
    from: f64,
    to: f64,
    /// Scallops there.
    ends: [f64; 2],
}

impl Piece {
    fn new(wall: Segment, length: f64, [from, to]: [f64; 2], ends: [f64; 2]) -> Self {
        // Rising from both ends at most like length.
        let bound = 0.5 * (ends[0] + ends[1] + length * (to - from));
        Self { bound, length, wall, from, to, ends }
    }
}

impl PartialEq for Piece {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Piece {}

impl PartialOrd for Piece {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Piece {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

/// The largest scallop on these walls: the piece with the highest bound is halved until it promises no more.
fn farthest(walls: &[Segment], start: Scallop, size: impl Fn(Point) -> Scallop) -> Scallop {
    let mut best = start;
    let mut pieces = BinaryHeap::new();
    for wall in walls {
        let ends = [size(wall.start()), size(wall.end())];
        best = ends.into_iter().fold(best, larger);
        pieces.push(Piece::new(*wall, wall.length(), [0.0, 1.0], ends.map(|s| s.size)));
    }
    while let Some(p) = pieces.pop().filter(|p| p.bound > best.size + TOLERANCE) {
        let middle = p.from.midpoint(p.to);
        let found = size(p.wall.at(middle));
        best = larger(best, found);
        pieces.push(Piece::new(p.wall, p.length, [p.from, middle], [p.ends[0], found.size]));
        pieces.push(Piece::new(p.wall, p.length, [middle, p.to], [found.size, p.ends[1]]));
    }
    best
}
