//! What an entity of a drawing is made of, before it is lines and arcs.

use super::affine::Affine;
use super::bezier::Bezier;
use super::fit;
use pocketry_geom::{Arc, Point, Segment, Vec2, tolerance};
use std::f64::consts::{PI, TAU};

/// A piece of an ellipse, `center + u cos t + v sin t`, with its end points as the drawing gives them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Elliptic {
    /// Where it begins.
    pub(crate) start: Point,
    /// Where it ends; the start for a whole ellipse.
    pub(crate) end: Point,
    /// Its centre.
    pub(crate) center: Point,
    /// The radius at parameter 0.
    pub(crate) u: Vec2,
    /// The radius at parameter π/2.
    pub(crate) v: Vec2,
    /// Parameter of the start, radians.
    pub(crate) from: f64,
    /// Parameter of the end less that of the start, radians, at most a whole turn.
    pub(crate) sweep: f64,
}

/// A piece of an entity: affine maps keep its kind.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Curve {
    /// Straight.
    Line(Point, Point),
    /// Of an ellipse or circle.
    Elliptic(Elliptic),
    /// Free-form: curves of which each starts where the one before ends.
    Free(Vec<Bezier>),
}

impl Elliptic {
    /// The piece of an ellipse between two parameters, end points computed.
    pub(crate) fn new(center: Point, u: Vec2, v: Vec2, from: f64, sweep: f64) -> Self {
        let on = |t: f64| center + u * t.cos() + v * t.sin();
        let start = on(from);
        let end = if sweep.abs() >= TAU { start } else { on(from + sweep) };
        Self { start, end, center, u, v, from, sweep }
    }

    /// The same points as an arc.
    pub(crate) fn of_arc(arc: &Arc) -> Self {
        let (u, v) = (Vec2::new(arc.radius, 0.0), Vec2::new(0.0, arc.radius));
        let from = (arc.start - arc.center).angle();
        Self { start: arc.start, end: arc.end, center: arc.center, u, v, from, sweep: arc.sweep() }
    }

    fn is_circular(&self) -> bool {
        let (a, b) = (self.u.length(), self.v.length());
        (a - b).abs() <= tolerance::CIRCULAR * a && self.u.dot(self.v).abs() <= tolerance::CIRCULAR * a * b
    }

    /// As arcs: exactly where it is a circle's, else fitted.
    fn segments(&self, fit_tolerance: f64, out: &mut Vec<Segment>) {
        let before = out.len();
        if self.is_circular() {
            self.circular_segments(out);
        } else {
            for quarter in fit::ellipse(self.center, self.u, self.v, self.from, self.sweep) {
                out.extend(fit::fit(&[quarter], fit_tolerance).segments);
            }
        }
        fit::weld(&mut out[before..], self.start, self.end);
    }

    fn circular_segments(&self, out: &mut Vec<Segment>) {
        let ccw = (self.sweep > 0.0) == (self.u.cross(self.v) > 0.0);
        let radius = 0.5 * (self.u.length() + self.v.length());
        let arc = |start, end| Segment::Arc(Arc { start, end, center: self.center, radius, ccw });
        if self.sweep.abs() < TAU && self.start != self.end {
            out.push(arc(self.start, self.end));
        } else if self.sweep.abs() > PI {
            let middle = self.center + (self.center - self.start);
            out.extend([arc(self.start, middle), arc(middle, self.end)]);
        }
    }
}

impl Curve {
    /// A polyline's edge.
    pub(crate) fn from_bulge(start: Point, end: Point, bulge: f64) -> Self {
        match Segment::from_bulge(start, end, bulge) {
            Segment::Line(l) => Self::Line(l.start, l.end),
            Segment::Arc(a) => Self::Elliptic(Elliptic::of_arc(&a)),
        }
    }

    /// The image under an affine map.
    pub(crate) fn transformed(&self, map: &Affine) -> Self {
        match self {
            Self::Line(a, b) => Self::Line(map.point(*a), map.point(*b)),
            Self::Elliptic(e) => Self::Elliptic(Elliptic {
                start: map.point(e.start),
                end: map.point(e.end),
                center: map.point(e.center),
                u: map.vector(e.u),
                v: map.vector(e.v),
                ..*e
            }),
            Self::Free(chain) => Self::Free(chain.iter().map(|b| b.transformed(map)).collect()),
        }
    }

    /// Appends this curve as lines and arcs within `fit_tolerance` mm; nothing for a curve without length.
    pub(crate) fn segments(&self, fit_tolerance: f64, out: &mut Vec<Segment>) {
        match self {
            Self::Line(a, b) if a == b => {}
            Self::Line(a, b) => out.push(Segment::line(*a, *b)),
            Self::Elliptic(e) => e.segments(fit_tolerance, out),
            Self::Free(chain) => out.extend(fit::fit(chain, fit_tolerance).segments),
        }
    }

    /// The largest coordinate, or radius of more than half a turn, in it; infinite where something in it is no number.
    pub(crate) fn reach(&self) -> f64 {
        let far = |p: Point| p.x.abs().max(p.y.abs());
        let largest = |reach: f64, next: f64| if next.is_nan() { f64::INFINITY } else { reach.max(next) };
        match self {
            Self::Line(a, b) => largest(far(*a), far(*b)),
            // A flat arc stays near its ends, however far away its centre is.
            Self::Elliptic(e) if e.sweep.abs() < PI && e.center.is_finite() => largest(far(e.start), far(e.end)),
            Self::Elliptic(e) => {
                [far(e.start), far(e.end), far(e.center), e.u.length(), e.v.length()].into_iter().fold(0.0, largest)
            }
            Self::Free(chain) => chain.iter().flat_map(Bezier::places).map(far).fold(0.0, largest),
        }
    }
}
