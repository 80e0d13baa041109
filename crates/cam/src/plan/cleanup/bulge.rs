//! Clean-up paths for next to nothing, as in figure 12 of the paper: instead of going to the corner of its loop, from there to
//! the tip of the path and back, the tool bends aside a little before the corner and goes past the tip to the other side: a
//! *bulge*.
//!
//! A bulge consists of arcs and lines that touch: from a place `A` on one side of the corner `C` away from it, straight on,
//! about a tip circle, and back onto the other side in the same way. It leaves nothing that the loop with the detour would
//! have cut. Let `r` be the tool's radius, and `x` a point within `r` of what the bulge replaces.
//!
//! - If the way from `x` to the nearest place of that crosses the bulge, the bulge is nearer.
//! - If `x` lies between the two, the bulge is no farther from it than `A` from `C`, or than the tip circle is wide.
//! - Else `x` lies inside the loop. Let its nearest place be on the side of `A`, at the distance `s` from the corner. It is
//!   at most `s tan t` away, with half the angle `t` between the sides, for beyond that the other side is nearer. The distance
//!   of `x` from `A` is largest where `s` is nothing or all: at most `r`, if both `|A - C|` and `|A - C| tan t` are. Where
//!   sides bend, the angle may be as much wider as both do twice.
//!
//! As with a drop ([`super::rounded`]) there has to be [`Room`] for it.

use super::rounded::{Room, axis, hull_points};
use crate::plan::length_of;
use pocketry_geom::offset::degenerate_slack;
use pocketry_geom::{Arc, Point, Segment, Vec2};
use std::f64::consts::{FRAC_PI_2, PI};

/// Radii of the tip circle that are tried, as shares of the tool's: larger ones hold tours that bend, smaller ones leave where little
/// of the sides may be replaced.
const TIPS: [f64; 7] = [0.1, 0.2, 0.4, 0.8, 0.05, 0.025, 0.0125];

/// Share of what a bulge may replace that it does.
const REPLACED: f64 = 0.9;

/// Arcs of a bulge turn by less than this, radians.
const MOST_TURN: f64 = 2.5;

/// Sides that turn by more than this, in radians, are too crooked.
const CROOKED: f64 = 0.3;

/// A place on a path.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    pub(super) segment: usize,
    pub(super) at: Point,
}

/// A way off a closed path and back to it that replaces what is between.
#[derive(Clone, Debug)]
pub(super) struct Bulge {
    pub(super) from: Spot,
    pub(super) to: Spot,
    pub(super) path: Vec<Segment>,
    /// By how much the path becomes longer, mm.
    pub(super) extra: f64,
}

/// What is known of a corner of a closed path.
pub(super) struct Corner<'a> {
    pub(super) loop_path: &'a [Segment],
    /// The segment that starts there.
    pub(super) segment: usize,
    /// How much of the path before and after it may be replaced, mm.
    pub(super) free: f64,
    /// The tool's radius.
    pub(super) radius: f64,
    pub(super) room: Room,
}

/// A side of the corner up to where a bulge leaves it.
struct Side {
    /// Where that is.
    place: Spot,
    /// From there towards the corner.
    towards: Vec2,
    /// What is replaced.
    replaced: Vec<Segment>,
    /// By how much it turns, at the most.
    bend: f64,
}

/// An arc that touches a side, and the line that touches it and the tip circle.
struct Blend {
    center: Point,
    radius: f64,
    /// Where the line touches the arc, and where the circle.
    line: [Point; 2],
}

impl Corner<'_> {
    /// The bulge that replaces a closed path from the corner, where there is one.
    pub(super) fn bulge(&self, tour: &[Segment]) -> Option<Bulge> {
        let [before, after] = self.tangents();
        let turn = before.cross(after).atan2(before.dot(after));
        if turn <= 0.0 {
            return None;
        }
        let half = 0.5 * (PI - turn);
        let most = REPLACED * self.free.min(self.radius).min(self.radius / half.tan());
        let bend = self.side(false, most)?.bend.max(self.side(true, most)?.bend);
        if bend > CROOKED || half + 2.0 * bend >= FRAC_PI_2 {
            return None;
        }
        let length = most.min(REPLACED * self.radius / (half + 2.0 * bend).tan());
        let sides = [self.side(false, length)?, self.side(true, length)?];
        let outward = axis(before, after, true);
        let path = TIPS.iter().find_map(|share| self.around(tour, &sides, outward, share * self.radius))?;
        let extra = length_of(&path) - 2.0 * length;
        let [from, to] = sides.map(|s| s.place);
        Some(Bulge { from, to, path, extra })
    }

    /// Towards the corner before it, and from it after it.
    pub(super) fn tangents(&self) -> [Vec2; 2] {
        let (segments, k) = (self.loop_path, self.segment);
        let before = &segments[(k + segments.len() - 1) % segments.len()];
        [before.end_tangent(), segments[k].start_tangent()]
    }

    fn at(&self) -> Point {
        self.loop_path[self.segment].start()
    }

    /// The side after the corner, or the one before it, backwards.
    fn side(&self, is_after: bool, length: f64) -> Option<Side> {
        let n = self.loop_path.len();
        let [before, after] = self.tangents();
        let away = if is_after { after } else { -before };
        let mut side =
            Side { place: Spot { segment: 0, at: self.at() }, towards: -away, replaced: Vec::new(), bend: 0.0 };
        let mut left = length;
        for step in 0..n {
            let k = (self.segment + if is_after { step } else { n - 1 - step }) % n;
            let segment = if is_after { self.loop_path[k] } else { self.loop_path[k].reversed() };
            let whole = segment.length();
            let taken = if whole > left { segment.split_at(segment.at(left / whole)).0 } else { segment };
            let turns = [taken.start_tangent(), taken.end_tangent()].map(|t| away.cross(t).atan2(away.dot(t)).abs());
            side.bend = turns.into_iter().fold(side.bend, f64::max);
            side.towards = -taken.end_tangent();
            side.place = Spot { segment: k, at: taken.end() };
            side.replaced.push(taken);
            left -= whole;
            if left < 0.0 {
                return Some(side);
            }
        }
        None
    }

    /// The bulge about the tour with a tip circle of this radius, if there is room for it.
    fn around(&self, tour: &[Segment], sides: &[Side; 2], outward: Vec2, radius: f64) -> Option<Vec<Segment>> {
        let corner = self.at();
        let mut center_at = f64::NEG_INFINITY;
        for p in hull_points(tour) {
            let (along, aside) = ((p - corner).dot(outward), (p - corner).cross(outward));
            if aside.abs() <= radius {
                center_at = center_at.max(along - ((radius - aside) * (radius + aside)).sqrt());
            }
        }
        let center = corner + outward * center_at;
        let farthest = center + outward * radius;
        // The walls are on the right.
        let first = sides[0].blend(true, center, radius)?;
        let last = sides[1].blend(false, center, radius)?;
        // The tour lies between the lines and this side of the circle, and no place that is replaced within the arcs.
        let slack = 0.25 * degenerate_slack(self.radius);
        let touches = [first.line[1], last.line[1]];
        let is_held = |p: Point| {
            let is_inward = |t: &Point| (*t - center).dot(p - *t) <= slack * radius;
            let is_before = (touches[1] - touches[0]).cross(p - touches[0]) >= 0.0;
            let is_outside = (p - corner).dot(outward) >= -slack;
            is_outside && touches.iter().all(is_inward) && (is_before || p.distance(center) <= radius + slack)
        };
        let is_inside = |s: &Segment| [&first, &last].iter().all(|b| s.distance(b.center) >= b.radius - slack);
        let replaced: Vec<Segment> = tour.iter().chain(sides.iter().flat_map(|s| &s.replaced)).copied().collect();
        if !hull_points(tour).all(is_held) || !replaced.iter().all(is_inside) {
            return None;
        }
        let arc = |start, end, center, radius, ccw| Segment::Arc(Arc { start, end, center, radius, ccw });
        let [a, b] = [sides[0].place.at, sides[1].place.at];
        let path = [
            arc(a, first.line[0], first.center, first.radius, false),
            Segment::line(first.line[0], first.line[1]),
            arc(first.line[1], farthest, center, radius, true),
            arc(farthest, last.line[1], center, radius, true),
            Segment::line(last.line[1], last.line[0]),
            arc(last.line[0], b, last.center, last.radius, false),
        ];
        let is_short = |s: &Segment| if let Segment::Arc(a) = s { a.sweep().abs() < MOST_TURN } else { true };
        let fits = path.iter().all(is_short) && self.room.holds(&path, &replaced, center_at + radius);
        fits.then(|| path.into_iter().filter(|s| s.start() != s.end()).collect())
    }
}

impl Side {
    /// The arc that bends away from the side where the bulge leaves it, to the right or to the left as seen towards the corner,
    /// and the line from it to a circle beyond.
    fn blend(&self, to_right: bool, center: Point, radius: f64) -> Option<Blend> {
        let aside = |v: Vec2| if to_right { v.right() } else { v.left() };
        let (to, outward) = (center - self.place.at, aside(self.towards));
        let (twice, rise) = (to.length_squared() - radius * radius, radius + to.dot(outward));
        if twice <= 0.0 || rise <= 0.0 || to.dot(self.towards) <= 0.0 {
            return None;
        }
        // The largest one touches the circle, with no line between.
        let own = (0.5 * twice / rise).min(radius);
        let own_center = self.place.at + outward * own;
        let across = center - own_center;
        let (apart, both) = (across.length(), radius + own);
        let (along, off) = (both / apart, ((apart - both) * (apart + both)).max(0.0).sqrt() / apart);
        let towards = (across * along - aside(across) * off) / apart;
        Some(Blend { center: own_center, radius: own, line: [own_center + towards * own, center - towards * radius] })
    }
}
