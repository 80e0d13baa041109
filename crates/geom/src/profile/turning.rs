//! Profiles that turn with the walls: the trajectory-based erosion of R. Molina-Carmona, A. Jimeno and M. Davia, *Contour pocketing
//! computation using mathematical morphology*, section 2, where homogeneous transformations of translations and rotations orientate
//! the structuring element at every position on the boundary.
//!
//! The profile's x axis is kept along the wall, which stays on its right, so that its −y side touches: the reference point runs along the
//! parallel of each wall at [`Turning::touch_distance`] or a trifle further in, and on an arc about each reflex corner: one touching direction for every place.
//! Further in, it runs along offsets of the walls, and keeps the direction of the wall that is nearest.
//!
//! 1. Along a line of such a parallel the profile is shifted; along an arc it turns about the arc's centre as a rigid body, for its
//!    direction turns as the arc does. Seen from the profile, a wall's points move along lines or arcs, too.
//! 2. A wall can begin or cease to enter the profile only where an end of one comes upon the other, or two curves become tangent:
//!    crossings of lines and arcs, in closed form ([`Motion::marks`]).
//! 3. Between two successive ones the middle decides (`CollideSE` of the paper's algorithm 1, with an index to find the walls).
//! 4. Where the profile does not fit at the touching distance it goes as near to the wall as it does (`nearest`).
//! 5. What is free makes *runs*. At a corner a run goes on where the profile can back off and turn on the spot, by the same test (`joints`); else it
//!    ends.
//!
//! Apart from 4 there is no step, and so no error of one. Departure from the paper: what collides is not a lost sample but the exact end of a run.

mod joints;
mod nearest;

use super::ToolProfile;
use crate::bbox::BBox;
use crate::contour::Contour;
use crate::distance::Boundary;
use crate::intersect::{Closeness, Contact, contacts};
use crate::point::{Point, Vec2, point, vec2};
use crate::region::Region;
use crate::segment::{Arc, Segment};
use crate::tolerance::profile::{ENTERED, PARALLEL, SMOOTH_TURN};
use std::f64::consts::{PI, TAU};

/// A piece of path with the profile's direction at its ends: linear in the length between, as a rotary axis follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Course {
    /// Where the reference point goes; a line of no length where the profile turns on the spot.
    pub path: Segment,
    /// Direction of the profile's x axis at the start, radians counter-clockwise.
    pub from: f64,
    /// At the end; it may lie beyond a full turn.
    pub to: f64,
}

impl Course {
    /// The profile's direction after a share of the piece, radians.
    fn direction(&self, share: f64) -> f64 {
        self.from + share * (self.to - self.from)
    }

    /// Travelled the other way, the profile's directions unchanged.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self { path: self.path.reversed(), from: self.to, to: self.from }
    }

    /// With both directions changed by `by` radians.
    #[must_use]
    pub fn turned(&self, by: f64) -> Self {
        Self { from: self.from + by, to: self.to + by, ..*self }
    }
}

/// A path that the profile can follow without touching more than walls: successive pieces with one place and direction at each joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Its pieces, in order; never empty.
    pub courses: Vec<Course>,
}

impl Run {
    /// Whether it ends where it starts, with the same direction or whole turns more.
    pub fn is_closed(&self) -> bool {
        let (first, last) = (self.courses[0], self.courses[self.courses.len() - 1]);
        let over = (last.to - first.from).rem_euclid(TAU);
        self.courses.len() > 1 && first.path.start() == last.path.end() && over.min(TAU - over) <= SMOOTH_TURN
    }
}

/// A profile that turns with the walls of a region.
pub struct Turning<'a> {
    walls: &'a Boundary,
    outline: Vec<Segment>,
    profile: Boundary,
    bbox: BBox,
    reach: f64,
    touch: f64,
    /// How far it keeps from the wall that it follows, mm.
    spare: f64,
    /// How deep a wall may come into the profile and still count as touching it, mm.
    entered: f64,
}

impl<'a> Turning<'a> {
    /// A profile among walls, that keeps a distance to spare (mm, far less than it is wide) from the one it follows. Without any, it comes to a
    /// halt where a smooth bend begins, and what a tool with the least play could do goes much further.
    pub fn new(walls: &'a Boundary, profile: &ToolProfile, spare: f64) -> Self {
        let contour = profile.contour().clone();
        let all = walls.segments().iter().fold(contour.bbox(), |b, s| b.union(s.bbox()));
        Self {
            walls,
            outline: contour.segments.clone(),
            bbox: contour.bbox(),
            reach: profile.reach(),
            touch: profile.support(vec2(0.0, -1.0)),
            spare,
            entered: ENTERED * all.size(),
            profile: Boundary::new(&Region::from_parts_unchecked(vec![contour], vec![None])),
        }
    }

    /// Distance of the reference point from a wall that the profile touches with its −y side, mm.
    pub fn touch_distance(&self) -> f64 {
        self.touch
    }

    /// The runs on which the profile follows the walls of a region: with its distance to spare or, where it does not fit so near to them, as
    /// near as it does; and in channels too narrow for that, touching.
    pub fn wall_runs(&self, region: &Region) -> Vec<Run> {
        let of_contour = |c: &Contour| {
            let beside = self.beside(&c.segments, self.touch + self.spare);
            let mut runs = self.runs_of(beside.iter().flat_map(|s| self.beside_as_near_as_can_be(s)));
            let touching = self.beside(&c.segments, self.touch);
            runs.extend(self.runs_of(touching.iter().flat_map(|s| self.free(&along(s))).filter(|c| self.is_tight(c))));
            runs
        };
        region.contours().iter().flat_map(of_contour).collect()
    }

    /// Whether the profile, touching a wall along a piece, is too tight for its distance to spare.
    fn is_tight(&self, course: &Course) -> bool {
        let angle = 0.5 * (course.from + course.to);
        let at = course.path.at(0.5) + Vec2::from_angle(angle).left() * self.spare;
        let is_entered = |_, wall: &Segment| self.is_entered_by(&Frame { at, angle }.seen(wall));
        let blocked = || self.walls.index().any(BBox::EMPTY.with(at), self.reach, is_entered);
        self.spare > 0.0 && (!self.walls.contains(at) || blocked())
    }

    /// The curves beside the walls of a contour at a distance; where walls turn inwards they don't meet.
    fn beside(&self, walls: &[Segment], distance: f64) -> Vec<Segment> {
        let mut curves: Vec<Segment> = Vec::new();
        let mut push = |mut curve: Segment| {
            if let Some(last) = curves.last().filter(|last| last.end().distance(curve.start()) <= self.entered) {
                curve = starting_at(&curve, last.end());
            }
            curves.push(curve);
        };
        for (wall, next) in walls.iter().zip(walls.iter().cycle().skip(1)) {
            parallel(wall, distance).into_iter().for_each(&mut push);
            let (arriving, leaving) = (wall.end_tangent().left(), next.start_tangent().left());
            let turn = arriving.angle_to(leaving);
            // At a cusp rounding decides on the sign; one that points out of the region has no room beside it anyway.
            if !(-PARALLEL..=PI - SMOOTH_TURN).contains(&turn) {
                let (center, radius) = (wall.end(), distance);
                let (start, end) = (center + arriving * radius, center + leaving * radius);
                push(Segment::Arc(Arc { start, end, center, radius, ccw: false }));
            }
        }
        if let (Some(first), Some(last)) = (curves.first().copied(), curves.last().copied())
            && last.end().distance(first.start()) <= self.entered
        {
            curves[0] = starting_at(&first, last.end());
        }
        curves
    }

    /// The parts of successive curves, the nearest wall to their right, along which the profile enters no wall.
    pub fn runs(&self, curves: &[Segment]) -> Vec<Run> {
        self.runs_of(curves.iter().flat_map(|s| self.free(&along(s))))
    }

    /// Runs of successive free pieces.
    fn runs_of(&self, courses: impl Iterator<Item = Course>) -> Vec<Run> {
        let mut runs: Vec<Run> = Vec::new();
        for course in courses {
            let joined = runs.last().and_then(|run| self.joined(run.courses[run.courses.len() - 1], course));
            match (runs.last_mut(), joined) {
                (Some(run), Some(more)) => run.courses.extend(more),
                _ => runs.push(Run { courses: vec![course] }),
            }
        }
        self.close(&mut runs);
        runs
    }

    /// The last run goes on with the first one where the parallel begins.
    fn close(&self, runs: &mut Vec<Run>) {
        let (Some(first), Some(last)) = (runs.first(), runs.last()) else { return };
        let (head, tail) = (first.courses[0], last.courses[last.courses.len() - 1]);
        let Some(more) = self.joined(tail, head) else { return };
        let by = more[more.len() - 1].from - head.from;
        if runs.len() == 1 {
            // A turn on the spot closes the loop.
            runs[0].courses.extend(&more[..more.len() - 1]);
        } else if let Some(mut last) = runs.pop() {
            last.courses.extend(&more[..more.len() - 1]);
            last.courses.extend(runs[0].courses.iter().map(|c| c.turned(by)));
            runs[0] = last;
        }
    }

    /// The parts of a piece along which no wall enters the profile.
    fn free(&self, course: &Course) -> Vec<Course> {
        self.free_shares(course).into_iter().map(|span| part(course, span)).collect()
    }

    /// The same as shares of its length.
    fn free_shares(&self, course: &Course) -> Vec<[f64; 2]> {
        let frame = Frame { at: course.path.start(), angle: course.from };
        let motion = Motion::of(course, frame);
        let mut near = Vec::new();
        self.walls.index().visit(course.path.bbox(), self.reach, |_, wall| near.push(frame.seen(wall)));
        let mut marks = vec![0.0, 1.0];
        for wall in &near {
            for edge in &self.outline {
                motion.marks(wall, edge, self.entered, &mut marks);
            }
        }
        marks.retain(|m| (0.0..=1.0).contains(m));
        marks.sort_by(f64::total_cmp);
        let least = self.entered / (course.path.length() + self.reach * (course.to - course.from).abs());
        marks.dedup_by(|later, earlier| *later - *earlier < least);
        if let Some(last) = marks.last_mut() {
            *last = 1.0;
        }
        let mut spans: Vec<[f64; 2]> = Vec::new();
        for span in marks.windows(2) {
            let middle = 0.5 * (span[0] + span[1]);
            let on_path = if course.path.length() > 0.0 { course.path.at(middle) } else { course.path.start() };
            if near.iter().any(|wall| self.is_entered_by(&motion.moved(wall, middle))) || !self.walls.contains(on_path)
            {
                continue;
            }
            match spans.last_mut() {
                Some(last) if last[1] == span[0] => last[1] = span[1],
                _ => spans.push([span[0], span[1]]),
            }
        }
        spans
    }

    /// Whether a wall comes into the profile: its ends, or its middles between crossings of the outline.
    fn is_entered_by(&self, wall: &Segment) -> bool {
        if !wall.bbox().intersects(self.bbox) {
            return false;
        }
        let mut cuts = Vec::new();
        let closeness = Closeness { touch: self.entered, lens: self.entered };
        for edge in &self.outline {
            contacts(wall, edge, closeness, |contact| match contact {
                Contact::Crossing { at, .. } | Contact::Tangent(at) => cuts.push(share_of(wall, at)),
                Contact::SecondEnd { start } => {
                    cuts.push(share_of(wall, if start { edge.start() } else { edge.end() }));
                }
                Contact::FirstEnd { .. } => {}
            });
        }
        cuts.extend([0.0, 1.0]);
        cuts.sort_by(f64::total_cmp);
        let inside = |t: f64| self.profile.signed_distance(wall.at(t)) > self.entered;
        inside(0.0) || inside(1.0) || cuts.windows(2).any(|w| inside(0.5 * (w[0] + w[1])))
    }
}

/// The parallel of a wall on its left; `None` where it would turn inside out.
fn parallel(wall: &Segment, distance: f64) -> Option<Segment> {
    match wall {
        Segment::Line(l) => Some(wall.translated(l.direction().left() * distance)),
        Segment::Arc(a) => {
            let radius = if a.ccw { a.radius - distance } else { a.radius + distance };
            let moved = |p: Point| a.center + (p - a.center) * (radius / a.radius);
            (radius > 0.0).then(|| Segment::Arc(Arc { start: moved(a.start), end: moved(a.end), radius, ..*a }))
        }
    }
}

/// The same curve from a point a trifle from its start.
fn starting_at(curve: &Segment, start: Point) -> Segment {
    match *curve {
        Segment::Line(l) => Segment::line(start, l.end),
        Segment::Arc(a) => Segment::Arc(Arc { start, ..a }),
    }
}

/// A segment of a parallel with the profile's x axis along it.
fn along(segment: &Segment) -> Course {
    let from = segment.start_tangent().angle();
    let by = if let Segment::Arc(a) = segment { a.sweep() } else { 0.0 };
    Course { path: *segment, from, to: from + by }
}

/// The part of a piece between two shares of it.
fn part(course: &Course, shares: [f64; 2]) -> Course {
    let on_the_spot = course.path.start() == course.path.end();
    let path = if on_the_spot { course.path } else { course.path.between(shares) };
    let [from, to] = shares.map(|share| course.direction(share));
    Course { path, from, to }
}

/// Where on a segment a point of it lies, as a share of its length.
fn share_of(segment: &Segment, p: Point) -> f64 {
    match segment {
        Segment::Line(l) => p.distance(l.start) / segment.length(),
        Segment::Arc(a) => ahead(p - a.center, a.start - a.center, a.sweep()),
    }
}

/// How far `to` lies ahead of `from` in the sense of a turn, as a share of it; a trifle behind counts as that.
fn ahead(to: Vec2, from: Vec2, turn: f64) -> f64 {
    let angle = from.angle_to(to) * turn.signum();
    let angle = if angle < -SMOOTH_TURN { angle + TAU } else { angle };
    angle / turn.abs()
}

/// The profile's own axes where a piece begins.
#[derive(Clone, Copy)]
struct Frame {
    at: Point,
    angle: f64,
}

impl Frame {
    fn seen(&self, wall: &Segment) -> Segment {
        wall.translated(-self.at.to_vec()).rotated(-self.angle)
    }

    fn place(&self, p: Point) -> Point {
        (p - self.at).rotated(-self.angle).to_point()
    }
}

/// What the profile does along a piece, in its axes at the start.
#[derive(Clone, Copy)]
enum Motion {
    Shift(Vec2),
    About { center: Point, by: f64 },
}

impl Motion {
    fn of(course: &Course, frame: Frame) -> Self {
        let by = course.to - course.from;
        match course.path {
            Segment::Arc(a) => Self::About { center: frame.place(a.center), by },
            Segment::Line(l) if l.start == l.end => Self::About { center: Point::ORIGIN, by },
            Segment::Line(l) => Self::Shift(frame.place(l.end).to_vec()),
        }
    }

    /// A wall where the profile sees it after a share of the motion.
    fn moved(&self, wall: &Segment, share: f64) -> Segment {
        match *self {
            Self::Shift(by) => wall.translated(-by * share),
            Self::About { center, by } => {
                wall.translated(-center.to_vec()).rotated(-by * share).translated(center.to_vec())
            }
        }
    }

    /// The way of a point of the profile (`sign` 1), or of a wall as the profile sees it (−1).
    fn way(&self, p: Point, sign: f64) -> Option<Segment> {
        match *self {
            Self::Shift(by) => Some(Segment::line(p, p + by * sign)),
            Self::About { center, by } => {
                let end = center + (p - center).rotated(sign * by);
                let arc = Arc { start: p, end, center, radius: p.distance(center), ccw: sign * by > 0.0 };
                (p != end).then_some(Segment::Arc(arc))
            }
        }
    }

    /// Adds the shares of the motion at which a wall and an edge of the profile may begin or cease to cross.
    fn marks(&self, wall: &Segment, edge: &Segment, touch: f64, out: &mut Vec<f64>) {
        let mut meet = |p: Point, sign: f64, other: &Segment| {
            let Some(way) = self.way(p, sign) else { return };
            if !way.bbox().inflated(touch).intersects(other.bbox()) {
                return;
            }
            contacts(&way, other, Closeness { touch, lens: touch }, |contact| {
                out.push(match contact {
                    Contact::Crossing { at, .. } | Contact::Tangent(at) => share_of(&way, at),
                    Contact::FirstEnd { start, .. } => f64::from(u8::from(!start)),
                    Contact::SecondEnd { start } => share_of(&way, if start { other.start() } else { other.end() }),
                });
            });
        };
        for (of_wall, of_edge) in [(wall.start(), edge.start()), (wall.end(), edge.end())] {
            meet(of_wall, -1.0, edge);
            meet(of_edge, 1.0, wall);
        }
        match (wall, edge) {
            (Segment::Line(_), Segment::Line(_)) => {}
            (Segment::Line(w), Segment::Arc(e)) => {
                let side = w.direction().left() * e.radius;
                meet(e.center, 1.0, &wall.translated(side));
                meet(e.center, 1.0, &wall.translated(-side));
            }
            (Segment::Arc(w), Segment::Line(e)) => {
                let side = e.direction().left() * w.radius;
                meet(w.center, -1.0, &edge.translated(side));
                meet(w.center, -1.0, &edge.translated(-side));
            }
            (Segment::Arc(w), Segment::Arc(e)) => {
                for radius in [w.radius + e.radius, (w.radius - e.radius).abs()].into_iter().filter(|r| *r > touch) {
                    for half in halves(e.center, radius) {
                        meet(w.center, -1.0, &half);
                    }
                }
            }
        }
    }
}

/// A circle in two halves.
fn halves(center: Point, radius: f64) -> [Segment; 2] {
    let (right, left) = (point(center.x + radius, center.y), point(center.x - radius, center.y));
    let half = |start, end| Segment::Arc(Arc { start, end, center, radius, ccw: true });
    [half(right, left), half(left, right)]
}

#[cfg(test)]
mod tests;
