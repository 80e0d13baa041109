//! Places at which a profile touches walls with parallel tangents.
//!
//! A wall point `w` whose normal `u` points into the region, and a point `c` of the reflected profile `−B` with `u` for its outer normal, make
//! the place `w + c`. Normals are compared within a tolerance; a line that is parallel to a wall counts once, with its first end, and
//! where a wall bends away only with what leaves the bend, which makes the sums join one another.

use crate::contour::Contour;
use crate::point::{Point, Vec2};
use crate::region::Region;
use crate::segment::{Arc, Segment};
use crate::tolerance::profile::PARALLEL;
use std::f64::consts::{PI, TAU};

/// All such places, as lines and arcs.
pub(super) fn touching(region: &Region, profile: &Contour) -> Vec<Segment> {
    let reflected = halves(&profile.segments.iter().map(reflected).collect::<Vec<_>>());
    let corners = joints(&reflected, |s| s.end_tangent().right(), |s| s.start_tangent().right(), 1.0);
    let mut out = Vec::new();
    for contour in region.contours() {
        let walls = halves(&contour.segments);
        for wall in &walls {
            for edge in &reflected {
                along_edge(wall, edge, &mut out);
            }
            for corner in &corners {
                at_corner(wall, corner, &mut out);
            }
        }
        for corner in joints(&walls, |s| s.end_tangent().left(), |s| s.start_tangent().left(), -1.0) {
            for edge in &reflected {
                round_corner(&corner, edge, &mut out);
            }
        }
    }
    out
}

fn reflected(s: &Segment) -> Segment {
    let flip = |p: Point| Point::new(-p.x, -p.y);
    match *s {
        Segment::Line(l) => Segment::line(flip(l.start), flip(l.end)),
        Segment::Arc(a) => Segment::Arc(Arc { start: flip(a.start), end: flip(a.end), center: flip(a.center), ..a }),
    }
}

/// The segments, arcs in parts of no more than a quarter turn or so, so that ranges of normals are less than half a turn.
fn halves(segments: &[Segment]) -> Vec<Segment> {
    let mut out = Vec::with_capacity(segments.len());
    for s in segments {
        match s {
            Segment::Arc(a) if a.sweep().abs() > 0.5 * PI + PARALLEL => {
                let count = (a.sweep().abs() / (0.5 * PI)).ceil() as u32;
                let mut rest = *s;
                for k in 1..count {
                    let (before, after) = rest.split_at(s.at(f64::from(k) / f64::from(count)));
                    out.push(before);
                    rest = after;
                }
                out.push(rest);
            }
            _ => out.push(*s),
        }
    }
    out
}

/// A range of directions, counter-clockwise from an angle.
#[derive(Clone, Copy, Debug)]
struct Range {
    from: f64,
    extent: f64,
}

impl Range {
    fn between(a: Vec2, b: Vec2) -> Self {
        Self { from: a.angle(), extent: a.angle_to(b).max(0.0) }
    }

    /// How far a direction lies beyond the start, in [−π, π).
    fn ahead(self, u: Vec2) -> f64 {
        (u.angle() - self.from + PI).rem_euclid(TAU) - PI
    }

    /// Whether a direction lies within, its start left out and its end counted in.
    fn holds(self, u: Vec2) -> bool {
        let ahead = self.ahead(u);
        ahead > PARALLEL && ahead <= self.extent + PARALLEL
    }

    /// Whether a direction lies within, its start counted in and its end left out: for walls, which turn the other way.
    fn holds_of_wall(self, u: Vec2) -> bool {
        let ahead = self.ahead(u);
        ahead >= -PARALLEL && ahead < self.extent - PARALLEL
    }

    /// The directions of both.
    fn common(self, other: Self) -> Option<Self> {
        let gap = (other.from - self.from + PI).rem_euclid(TAU) - PI;
        let (low, high) = (gap.max(0.0), (gap + other.extent).min(self.extent));
        (high - low > PARALLEL).then_some(Self { from: self.from + low, extent: high - low })
    }
}

/// A corner with a range of normals.
struct Corner {
    at: Point,
    normals: Range,
}

/// The corners at which the normal turns to the side of `sign`.
fn joints(
    segments: &[Segment],
    before: impl Fn(&Segment) -> Vec2,
    after: impl Fn(&Segment) -> Vec2,
    sign: f64,
) -> Vec<Corner> {
    let next = segments.iter().cycle().skip(1);
    let corner = |(s, next): (&Segment, &Segment)| {
        let (m, n) = (before(s), after(next));
        let turn = sign * m.angle_to(n);
        let normals = if sign > 0.0 { Range::between(m, n) } else { Range::between(n, m) };
        (turn > PARALLEL).then_some(Corner { at: s.end(), normals })
    };
    segments.iter().zip(next).filter_map(corner).collect()
}

/// The normals of an arc on one side, and whether they point away from its centre.
fn normals(a: &Arc, left: bool) -> (Range, bool) {
    let outward = a.ccw != left;
    let sign = if outward { 1.0 } else { -1.0 };
    let (s, e) = ((a.start - a.center) * sign, (a.end - a.center) * sign);
    (if a.ccw { Range::between(s, e) } else { Range::between(e, s) }, outward)
}

/// The arc of the points `center + radius · u` for a range of directions `u`; the radius may be negative.
fn arc(center: Point, radius: f64, range: Range, out: &mut Vec<Segment>) {
    let at = |angle: f64| center + Vec2::from_angle(angle) * radius;
    let (start, end) = (at(range.from), at(range.from + range.extent));
    if start != end {
        out.push(Segment::Arc(Arc { start, end, center, radius: radius.abs(), ccw: true }));
    }
}

/// A wall and an edge of the reflected profile.
fn along_edge(wall: &Segment, edge: &Segment, out: &mut Vec<Segment>) {
    match (wall, edge) {
        // Parallel lines touch with an end, too.
        (Segment::Line(_), Segment::Line(_)) => {}
        (Segment::Line(l), Segment::Arc(e)) => {
            let u = l.direction().left();
            let (range, outward) = normals(e, false);
            if outward && range.holds(u) {
                out.push(wall.translated(e.center.to_vec() + u * e.radius));
            }
        }
        (Segment::Arc(w), Segment::Line(l)) => {
            let u = l.direction().right();
            let (range, outward) = normals(w, true);
            if outward && range.holds_of_wall(u) {
                out.push(edge.translated(w.center.to_vec() + u * w.radius));
            }
        }
        (Segment::Arc(w), Segment::Arc(e)) => {
            let ((wall_range, wall_out), (edge_range, edge_out)) = (normals(w, true), normals(e, false));
            let signed = |radius: f64, outward: bool| if outward { radius } else { -radius };
            let radius = signed(w.radius, wall_out) + signed(e.radius, edge_out);
            // Hollow against hollow never touches, and hollow against round only where it is wider.
            let touches = if wall_out { edge_out || radius < 0.0 } else { edge_out && radius < 0.0 };
            if let Some(range) = wall_range.common(edge_range).filter(|_| touches) {
                arc(w.center + e.center.to_vec(), radius, range, out);
            }
        }
    }
}

/// A wall and a corner of the reflected profile.
fn at_corner(wall: &Segment, corner: &Corner, out: &mut Vec<Segment>) {
    match wall {
        Segment::Line(l) => {
            if corner.normals.holds(l.direction().left()) {
                out.push(wall.translated(corner.at.to_vec()));
            }
        }
        Segment::Arc(w) => {
            let (range, outward) = normals(w, true);
            if let Some(range) = range.common(corner.normals) {
                let radius = if outward { w.radius } else { -w.radius };
                arc(w.center + corner.at.to_vec(), radius, range, out);
            }
        }
    }
}

/// A reflex corner of the walls and an edge of the reflected profile.
fn round_corner(corner: &Corner, edge: &Segment, out: &mut Vec<Segment>) {
    match edge {
        Segment::Line(l) => {
            if corner.normals.holds_of_wall(l.direction().right()) {
                out.push(edge.translated(corner.at.to_vec()));
            }
        }
        Segment::Arc(e) => {
            let (range, outward) = normals(e, false);
            if let Some(range) = range.common(corner.normals) {
                let radius = if outward { e.radius } else { -e.radius };
                arc(e.center + corner.at.to_vec(), radius, range, out);
            }
        }
    }
}
