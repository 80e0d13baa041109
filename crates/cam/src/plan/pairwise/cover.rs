//! What the clean-up paths still leave, found and cut: the last step, after which nothing is uncut whatever the ways between
//! the ends of fibres are worth.
//!
//! All that may be uncut lies on fibres through the clean-up curves, between the envelope and the inner loops' distance. This
//! ground is divided into cells, along the walls and away from them, each halved until
//!
//! - it lies within the tool's radius of a single segment of the path: such a place is convex, so that corners tell;
//! - or no fibre of its wall gets there: its middle is nearer to another wall than that by more than the cell is wide;
//! - or it is as small as what a tool is not trusted to cut ([`trusted`](crate::plan::cleanup::trusted)). If its middle is uncut,
//!   it becomes the place of a *spoke*: a detour from the outer loop along the fibre, on which clearance grows like length.
//!   It cuts the fibre to its end, and no less than that on both sides of it.

use super::curves::{CleanupCurve, Stretch};
use super::fibres::Fibres;
use super::nearby::Nearby;
use crate::plan::cleanup::{Gathered, Uncut};
use crate::plan::order::Orderer;
use crate::plan::track::{Insertion, Landing};
use pocketry_geom::index::SegmentIndex;
use pocketry_geom::offset::{PairwiseOffsetter, degenerate_slack};
use pocketry_geom::skeleton::SiteShape;
use pocketry_geom::{BBox, Point, Segment};

/// Share of the radius by which a spoke goes farther than its fibre asks for, so that it cuts what is beside it, too.
const BESIDE: f64 = 0.125;

/// Cells about vertices turn by no more than this, radians.
const WIDEST: f64 = 0.5;

/// Share of the slack down to which cells are halved.
const FINEST: f64 = 0.25;

/// The clean-up curves between two distances that a single degenerate vertex does not settle.
pub(super) struct Ground {
    /// The number of the outer loops' distance.
    pub(super) level: usize,
    /// That distance, mm.
    pub(super) base: f64,
    /// That of the envelope.
    pub(super) low: f64,
    /// That of the inner loops.
    pub(super) high: f64,
    pub(super) curves: Vec<CleanupCurve>,
}

/// Adds spokes to what still is uncut of the ground.
pub(super) fn complete(
    gathered: &mut Gathered,
    grounds: &[Ground],
    offsetter: &PairwiseOffsetter<'_>,
    orderer: &Orderer<'_>,
    radius: f64,
) {
    if grounds.iter().all(|g| g.curves.is_empty()) {
        return;
    }
    let loops = orderer.levels.tracks.iter().flat_map(|t| &t.segments);
    let nearby = Nearby::new(&boxes(grounds, radius));
    let path: Vec<Segment> = loops.chain(gathered.tours()).filter(|s| nearby.may_meet(s.bbox())).copied().collect();
    let swept = Swept { index: SegmentIndex::new(&path), path, offsetter, radius, slack: degenerate_slack(radius) };
    for ground in grounds {
        for curve in &ground.curves {
            let kind = kind(curve);
            let spokes = swept.spokes(ground, curve);
            for (landing, tour) in spokes.iter().filter_map(|spoke| spoke.hung(ground, orderer)) {
                let (segment, at) = (landing.segment, Some(landing.point));
                let insertion = Insertion { segment, at, tour, clearance: ground.base, tip: None };
                gathered.add(kind, landing.track, insertion);
            }
        }
    }
}

/// What holds every path that may cut something of the grounds.
fn boxes(grounds: &[Ground], radius: f64) -> Vec<BBox> {
    let of_ground = |g: &Ground| {
        let margin = g.high - g.low + radius;
        let stretches = g.curves.iter().flat_map(|c| &c.stretches);
        stretches.map(|s| s.segment.bbox().inflated(margin)).collect::<Vec<_>>()
    };
    grounds.iter().flat_map(of_ground).collect()
}

fn kind(curve: &CleanupCurve) -> Uncut {
    match curve.roots {
        None => Uncut::Center,
        Some([a, b]) if a == b => Uncut::Corner,
        Some(_) => Uncut::Neck,
    }
}

/// A part of the ground: fibres through a stretch of the envelope, between two distances from their wall.
#[derive(Clone, Copy, Debug)]
struct Cell {
    stretch: Stretch,
    from: f64,
    to: f64,
}

/// A detour along a fibre.
struct Spoke {
    stretch: Stretch,
    /// Where it leaves the outer loop, and where it turns.
    ends: [Point; 2],
}

/// The path so far.
struct Swept<'a> {
    path: Vec<Segment>,
    index: SegmentIndex,
    offsetter: &'a PairwiseOffsetter<'a>,
    radius: f64,
    slack: f64,
}

impl Swept<'_> {
    /// The spokes that a clean-up curve still needs.
    fn spokes(&self, ground: &Ground, curve: &CleanupCurve) -> Vec<Spoke> {
        let mut spokes: Vec<Spoke> = Vec::new();
        let whole = |s: &Stretch| Cell { stretch: *s, from: ground.low, to: ground.high };
        let mut cells: Vec<Cell> = curve.stretches.iter().map(whole).collect();
        while let Some(cell) = cells.pop() {
            let corners = self.corners(&cell, ground.low);
            let middle = self.place(&cell.stretch, 0.5, ground.low, 0.5 * (cell.from + cell.to));
            let extent = corners.iter().map(|c| c.distance(middle)).fold(0.0, f64::max);
            if self.is_cut(&spokes, middle, &corners) || self.is_elsewhere(&cell, middle, extent) {
                continue;
            }
            if extent > FINEST * self.slack {
                cells.extend(self.halves(&cell, ground.low));
            } else if self.distance(&spokes, middle) > self.radius + self.slack - extent {
                spokes.push(self.spoke(&cell, ground));
            }
        }
        spokes
    }

    /// The place on the fibre through a place of a stretch, at a distance from its wall.
    fn place(&self, stretch: &Stretch, share: f64, low: f64, distance: f64) -> Point {
        let at = stretch.segment.at(share);
        match self.offsetter.shape(stretch.site) {
            SiteShape::Point(p) => p + (at - p).normalized() * distance,
            _ => at + stretch.segment.start_tangent().left() * (distance - low),
        }
    }

    /// Points around a cell, about a vertex with that where the tangents at its outer corners meet.
    fn corners(&self, cell: &Cell, low: f64) -> [Point; 5] {
        let turn = sweep(&cell.stretch.segment);
        let beyond = cell.to / (0.5 * turn).cos();
        [(0.0, cell.from), (1.0, cell.from), (1.0, cell.to), (0.5, beyond), (0.0, cell.to)]
            .map(|(share, distance)| self.place(&cell.stretch, share, low, distance))
    }

    fn halves(&self, cell: &Cell, low: f64) -> [Cell; 2] {
        let [a, b] = [0.0, 1.0].map(|share| self.place(&cell.stretch, share, low, cell.to));
        let Stretch { segment, site } = cell.stretch;
        if a.distance(b) > cell.to - cell.from || sweep(&segment).abs() > WIDEST {
            let (first, second) = segment.split_at(segment.at(0.5));
            return [first, second].map(|segment| Cell { stretch: Stretch { segment, site }, ..*cell });
        }
        let middle = 0.5 * (cell.from + cell.to);
        [Cell { to: middle, ..*cell }, Cell { from: middle, ..*cell }]
    }

    /// Whether a cell lies within the radius of the segment that is nearest to its middle.
    fn is_cut(&self, spokes: &[Spoke], middle: Point, corners: &[Point; 5]) -> bool {
        let reaches = |s: &Segment| corners.iter().all(|c| s.distance(*c) <= self.radius);
        let nearest = self.index.nearest_within(middle, self.radius);
        nearest.is_some_and(|(k, _)| reaches(&self.path[k])) || spokes.iter().any(|s| reaches(&s.line()))
    }

    /// Whether no fibre of a cell's wall gets there.
    fn is_elsewhere(&self, cell: &Cell, middle: Point, extent: f64) -> bool {
        let enough = cell.from - extent;
        enough > 0.0 && self.offsetter.boundary().index().nearest_within(middle, enough).is_some()
    }

    fn distance(&self, spokes: &[Spoke], p: Point) -> f64 {
        let nearest = self.index.nearest(p).map_or(f64::INFINITY, |n| n.1);
        spokes.iter().map(|s| s.line().distance(p)).fold(nearest, f64::min)
    }

    /// The spoke along the fibre through a cell's middle.
    fn spoke(&self, cell: &Cell, ground: &Ground) -> Spoke {
        let Stretch { segment, site } = cell.stretch;
        let fibre = Fibres::new(self.offsetter, ground.low, ground.high).through(segment.at(0.5), site, None);
        let end = fibre.clearance.clamp(cell.to, ground.high);
        let turn = end - (1.0 - BESIDE) * self.radius;
        let ends = [ground.base, turn].map(|d| self.place(&cell.stretch, 0.5, ground.low, d));
        Spoke { stretch: cell.stretch, ends }
    }
}

impl Spoke {
    fn line(&self) -> Segment {
        Segment::line(self.ends[0], self.ends[1])
    }

    /// Its place on a loop, and its way out and back.
    fn hung(&self, ground: &Ground, orderer: &Orderer<'_>) -> Option<(Landing, Vec<Segment>)> {
        let [foot, turn] = self.ends;
        let landing = orderer.landing(foot, self.stretch.site, ground.level, &|_| true)?;
        let way = Segment::line(landing.point, turn);
        Some((landing, vec![way, way.reversed()]))
    }
}

/// By how much a segment turns, radians.
fn sweep(s: &Segment) -> f64 {
    if let Segment::Arc(a) = s { a.sweep() } else { 0.0 }
}
