//! Boundary elements as the check sees them: taken from the region itself, not from the skeleton's copy.

use crate::point::{Point, Vec2};
use crate::region::Region;
use crate::segment::Segment;
use std::f64::consts::{PI, TAU};

/// Feet on an arc that move so many times as far as the point whose feet they are, or more, are unsteady.
const UNSTEADY: f64 = 1000.0;

/// A point of the boundary with the directions there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub(super) point: Point,
    pub(super) tangent: Vec2,
    /// Unit normal that points into the pocket.
    pub(super) normal: Vec2,
}

/// A foot on an element: `anchor + offset`, kept apart so that nothing cancels near an end that two elements share.
#[derive(Clone, Copy, Debug)]
pub(super) struct Foot {
    pub(super) anchor: Point,
    pub(super) offset: Vec2,
    pub(super) normal: Vec2,
}

/// A line or an arc; its parameter is the length travelled from its start.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wall {
    segment: Segment,
    length: f64,
    curvature: f64,
    start: Frame,
    end: Frame,
    /// By how much feet may miss the extent at either end, per unit of clearance: the turn of a joint taken as smooth.
    loose: [f64; 2],
}

/// A reflex vertex; its parameter is the angle turned clockwise from the normal of the segment before it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    point: Point,
    from: Vec2,
    fan: f64,
}

/// A boundary element.
#[derive(Clone, Copy, Debug)]
pub(super) enum Element {
    Wall(Wall),
    Corner(Corner),
}

impl Foot {
    pub(super) fn point(&self) -> Point {
        self.anchor + self.offset
    }
}

/// Signed turn in (−π, π] at the start of segment `k` of contour `c`: negative at a reflex vertex.
pub(super) fn turn_at(region: &Region, c: usize, k: usize) -> f64 {
    let segments = &region.contours()[c].segments;
    let before = &segments[(k + segments.len() - 1) % segments.len()];
    before.end_tangent().angle_to(segments[k].start_tangent())
}

impl Wall {
    /// Segment `k` of contour `c`; joints that turn by less than `smooth` count as smooth.
    pub(super) fn new(region: &Region, c: usize, k: usize, smooth: f64) -> Self {
        let segments = &region.contours()[c].segments;
        let segment = segments[k];
        let loose = [k, (k + 1) % segments.len()]
            .map(|joint| Some(turn_at(region, c, joint).abs()).filter(|&turn| turn <= smooth).unwrap_or(0.0));
        let frame = |point, tangent: Vec2| Frame { point, tangent, normal: tangent.left() };
        Self {
            segment,
            length: segment.length(),
            curvature: segment.curvature(),
            start: frame(segment.start(), segment.start_tangent()),
            end: frame(segment.end(), segment.end_tangent()),
            loose,
        }
    }

    /// The end nearest to `p`.
    fn frame_near(&self, p: Point) -> Frame {
        if p.distance_squared(self.start.point) <= p.distance_squared(self.end.point) { self.start } else { self.end }
    }

    /// The point at length `s`, reckoned from the nearer end.
    fn at(&self, s: f64) -> Foot {
        let (frame, s) = if s <= 0.5 * self.length { (self.start, s) } else { (self.end, s - self.length) };
        let (sin, cos) = (self.curvature * s).sin_cos();
        let (along, aside) = if self.curvature == 0.0 {
            (s, 0.0)
        } else {
            let half = (0.5 * self.curvature * s).sin();
            (sin / self.curvature, 2.0 * half * half / self.curvature)
        };
        Foot {
            anchor: frame.point,
            offset: frame.tangent * along + frame.normal * aside,
            normal: frame.normal * cos - frame.tangent * sin,
        }
    }

    /// The parameter of the carrier's point nearest to `x`, outside `0..=length` where `x` lies beyond an end.
    fn foot(&self, x: Point) -> f64 {
        match &self.segment {
            Segment::Line(_) => {
                let from_start = (x - self.start.point).dot(self.start.tangent);
                let from_end = (x - self.end.point).dot(self.end.tangent);
                if from_start.abs() <= from_end.abs() { from_start } else { self.length + from_end }
            }
            Segment::Arc(a) => self.foot_towards(x - a.center, x),
        }
    }

    /// The parameter of the arc's point in direction `outward` from the centre.
    fn foot_towards(&self, outward: Vec2, x: Point) -> f64 {
        let Segment::Arc(a) = &self.segment else { return self.foot(x) };
        let middle = (a.start - a.center).rotated(0.5 * a.sweep());
        let turn = middle.angle_to(outward) * self.curvature.signum();
        0.5 * self.length + turn / self.curvature.abs()
    }
}

impl Corner {
    /// The reflex vertex at the start of segment `k` of contour `c`.
    pub(super) fn new(region: &Region, c: usize, k: usize) -> Self {
        let segments = &region.contours()[c].segments;
        let before = &segments[(k + segments.len() - 1) % segments.len()];
        let turn = turn_at(region, c, k);
        // A vertex named reflex whose turn rounds to +π is a needle: the fan is a half-turn.
        let fan = if turn > 0.5 * PI { TAU - turn } else { -turn };
        Self { point: segments[k].start(), from: before.end_tangent().left(), fan }
    }

    fn foot_towards(&self, direction: Vec2) -> f64 {
        0.5 * self.fan - self.from.rotated(-0.5 * self.fan).angle_to(direction)
    }
}

impl Element {
    /// Where the parameter ends; it begins at 0.
    pub(super) fn extent(&self) -> f64 {
        match self {
            Self::Wall(w) => w.length,
            Self::Corner(c) => c.fan,
        }
    }

    /// Where its cell begins and ends on the boundary.
    pub(super) fn ends(&self) -> [Point; 2] {
        match self {
            Self::Wall(w) => [w.start.point, w.end.point],
            Self::Corner(c) => [c.point; 2],
        }
    }

    /// Signed curvature for the area formula; `None` for a vertex.
    pub(super) fn curvature(&self) -> Option<f64> {
        match self {
            Self::Wall(w) => Some(w.curvature),
            Self::Corner(_) => None,
        }
    }

    /// Distance from `x` to the closed element.
    pub(super) fn distance(&self, x: Point) -> f64 {
        match self {
            Self::Wall(w) => w.segment.distance(x),
            Self::Corner(c) => c.point.distance(x),
        }
    }

    /// The parameter of the foot of `x`; it leaves `0..=extent` where `x` lies beyond an end.
    pub(super) fn foot(&self, x: Point) -> f64 {
        match self {
            Self::Wall(w) => w.foot(x),
            Self::Corner(c) => c.foot_towards(x - c.point),
        }
    }

    /// As [`Self::foot`], but within the arc where `x` lies almost in its centre: a rounding unit beyond the centre the
    /// foot on the full circle lies opposite.
    pub(super) fn steady_foot(&self, x: Point) -> f64 {
        let foot = self.foot(x);
        match self {
            Self::Wall(Wall { segment: Segment::Arc(a), length, .. }) if a.center.distance(x) * UNSTEADY < a.radius => {
                foot.clamp(0.0, *length)
            }
            _ => foot,
        }
    }

    /// The parameter of the foot that lies in direction `towards` from the centre of a disk about (almost) this
    /// element's own centre of curvature.
    pub(super) fn foot_towards(&self, towards: Vec2, x: Point) -> f64 {
        match self {
            Self::Wall(w) => w.foot_towards(towards, x),
            Self::Corner(c) => c.foot_towards(-towards),
        }
    }

    /// Distance of `x` to the element's centre of curvature: where it vanishes the foot is undefined.
    pub(super) fn distance_to_center(&self, x: Point) -> f64 {
        match self {
            Self::Wall(Wall { segment: Segment::Arc(a), .. }) => a.center.distance(x),
            Self::Wall(_) => f64::INFINITY,
            Self::Corner(c) => c.point.distance(x),
        }
    }

    /// By how much the foot's parameter may change where `x` moves by `by`.
    pub(super) fn foot_slack(&self, x: Point, by: f64) -> f64 {
        let away = self.distance_to_center(x);
        match self {
            Self::Wall(Wall { segment: Segment::Arc(a), .. }) => by * (a.radius / away).max(1.0),
            Self::Wall(_) => by,
            Self::Corner(_) => by / away,
        }
    }

    /// By how much the foot of a disk of radius `r` may miss the extent at its start and end.
    pub(super) fn looseness(&self, r: f64) -> [f64; 2] {
        match self {
            Self::Wall(w) => w.loose.map(|turn| turn * r),
            Self::Corner(_) => [0.0; 2],
        }
    }

    /// The length on the element (or on a circle of radius `r` about it) of a change of parameter.
    pub(super) fn length_of(&self, change: f64, r: f64) -> f64 {
        match self {
            Self::Wall(_) => change.abs(),
            Self::Corner(_) => change.abs() * r,
        }
    }

    /// The point and normal at a parameter.
    pub(super) fn at(&self, s: f64) -> Foot {
        match self {
            Self::Wall(w) => w.at(s),
            Self::Corner(c) => Foot { anchor: c.point, offset: Vec2::ZERO, normal: c.from.rotated(-s) },
        }
    }

    /// The radius of the disk that is tangent at `foot` from inside the pocket and touches this element's carrier.
    ///
    /// With u from a point q of the carrier to the foot, m the normal at q and κ the curvature, the two conditions
    /// leave one linear equation: r = (2u·m − κ|u|²) / (|m − n|² + 2κ u·n). NaN or infinite where there is none.
    pub(super) fn tangent_radius(&self, foot: &Foot) -> f64 {
        match self {
            Self::Wall(w) => {
                let near = w.frame_near(foot.anchor);
                let u = (foot.anchor - near.point) + foot.offset;
                let k = w.curvature;
                (2.0 * u.dot(near.normal) - k * u.length_squared())
                    / ((near.normal - foot.normal).length_squared() + 2.0 * k * u.dot(foot.normal))
            }
            Self::Corner(c) => {
                let u = (foot.anchor - c.point) + foot.offset;
                -u.length_squared() / (2.0 * u.dot(foot.normal))
            }
        }
    }
}
