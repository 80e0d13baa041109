//! SVG path data as curves in user units.

use crate::import::affine::Affine;
use crate::import::bezier::Bezier;
use crate::import::curve::{Curve, Elliptic};
use pocketry_geom::{Point, Vec2, point, vec2};
use std::f64::consts::TAU;
use svgtypes::{PathParser, PathSegment};

/// A connected run of curves of a path.
#[derive(Clone, Debug, Default)]
pub(super) struct Subpath {
    /// End to end.
    pub(super) curves: Vec<Curve>,
    /// Whether the path closes it.
    pub(super) closed: bool,
}

/// Reads path data; every number must be finite and every command whole.
pub(super) fn parse(data: &str) -> Result<Vec<Subpath>, String> {
    let mut pen = Pen::default();
    for segment in PathParser::from(data) {
        let segment = segment.map_err(|e| format!("its path data can't be read: {e}"))?;
        pen.draw(segment);
        if !(pen.at.is_finite()) {
            return Err("its path data holds a number that is too large".to_owned());
        }
    }
    pen.finish();
    Ok(pen.done)
}

/// The state between two commands.
#[derive(Default)]
struct Pen {
    at: Point,
    start: Point,
    /// The control point that a smooth command mirrors, and whether it is a cubic's.
    handle: Option<(Point, bool)>,
    open: Subpath,
    done: Vec<Subpath>,
}

impl Pen {
    fn finish(&mut self) {
        let subpath = std::mem::take(&mut self.open);
        if !subpath.curves.is_empty() {
            self.done.push(subpath);
        }
    }

    fn place(&self, abs: bool, x: f64, y: f64) -> Point {
        if abs { point(x, y) } else { self.at + vec2(x, y) }
    }

    fn line_to(&mut self, to: Point) {
        if to != self.at {
            self.open.curves.push(Curve::Line(self.at, to));
        }
        self.at = to;
        self.handle = None;
    }

    fn curve_to(&mut self, controls: &[Point], to: Point) {
        let mut points = vec![self.at];
        points.extend_from_slice(controls);
        points.push(to);
        if points.iter().any(|&p| p != self.at) {
            self.open.curves.push(Curve::Free(vec![Bezier::polynomial(&points)]));
        }
        self.handle = controls.last().map(|&c| (c, controls.len() == 2));
        self.at = to;
    }

    /// The first control point of a smooth command.
    fn mirrored(&self, cubic: bool) -> Point {
        match self.handle {
            Some((c, kind)) if kind == cubic => self.at + (self.at - c),
            _ => self.at,
        }
    }

    fn draw(&mut self, segment: PathSegment) {
        match segment {
            PathSegment::MoveTo { abs, x, y } => {
                let to = self.place(abs, x, y);
                self.finish();
                (self.at, self.start, self.handle) = (to, to, None);
            }
            PathSegment::LineTo { abs, x, y } => self.line_to(self.place(abs, x, y)),
            PathSegment::HorizontalLineTo { abs, x } => {
                self.line_to(point(if abs { x } else { self.at.x + x }, self.at.y));
            }
            PathSegment::VerticalLineTo { abs, y } => {
                self.line_to(point(self.at.x, if abs { y } else { self.at.y + y }));
            }
            PathSegment::CurveTo { abs, x1, y1, x2, y2, x, y } => {
                let controls = [self.place(abs, x1, y1), self.place(abs, x2, y2)];
                self.curve_to(&controls, self.place(abs, x, y));
            }
            PathSegment::SmoothCurveTo { abs, x2, y2, x, y } => {
                let controls = [self.mirrored(true), self.place(abs, x2, y2)];
                self.curve_to(&controls, self.place(abs, x, y));
            }
            PathSegment::Quadratic { abs, x1, y1, x, y } => {
                let controls = [self.place(abs, x1, y1)];
                self.curve_to(&controls, self.place(abs, x, y));
            }
            PathSegment::SmoothQuadratic { abs, x, y } => {
                let controls = [self.mirrored(false)];
                self.curve_to(&controls, self.place(abs, x, y));
            }
            PathSegment::EllipticalArc { abs, rx, ry, x_axis_rotation, large_arc, sweep, x, y } => {
                let to = self.place(abs, x, y);
                self.arc_to(vec2(rx, ry), x_axis_rotation, large_arc, sweep, to);
            }
            PathSegment::ClosePath { .. } => self.close(),
        }
    }

    fn close(&mut self) {
        self.open.closed = true;
        let start = self.start;
        self.line_to(start);
        self.finish();
    }

    /// An arc by its end points, as SVG's implementation notes (F.6.5) turn it into one by its centre.
    fn arc_to(&mut self, radii: Vec2, rotation: f64, large: bool, positive: bool, to: Point) {
        let (mut rx, mut ry) = (radii.x.abs(), radii.y.abs());
        if rx == 0.0 || ry == 0.0 || to == self.at {
            self.line_to(to);
            return;
        }
        let turn = Affine::rotate_degrees(rotation);
        let back = Affine::rotate_degrees(-rotation);
        let half = back.vector((self.at - to) * 0.5);
        let reach = (half.x / rx).hypot(half.y / ry);
        if reach > 1.0 {
            (rx, ry) = (rx * reach, ry * reach);
        }
        let unit = vec2(half.x / rx, half.y / ry);
        let short = unit.length_squared();
        let height = ((1.0 - short).max(0.0) / short).sqrt() * if large == positive { -1.0 } else { 1.0 };
        let unit_center = unit.right() * height;
        let center = self.at.midpoint(to) + turn.vector(vec2(unit_center.x * rx, unit_center.y * ry));
        let (from_dir, to_dir) = (unit - unit_center, -unit - unit_center);
        let mut sweep = from_dir.angle_to(to_dir);
        if positive && sweep <= 0.0 {
            sweep += TAU;
        } else if !positive && sweep >= 0.0 {
            sweep -= TAU;
        }
        let (u, v) = (turn.vector(vec2(rx, 0.0)), turn.vector(vec2(0.0, ry)));
        let arc = Elliptic { start: self.at, end: to, center, u, v, from: from_dir.angle(), sweep };
        self.open.curves.push(Curve::Elliptic(arc));
        self.at = to;
        self.handle = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pocketry_geom::Contour;

    fn area(data: &str) -> f64 {
        let mut total = 0.0;
        for subpath in parse(data).unwrap() {
            let mut segments = Vec::new();
            for curve in &subpath.curves {
                curve.segments(1e-4, &mut segments);
            }
            total += Contour::new(segments).area();
        }
        total
    }

    #[test]
    fn arcs_take_the_side_that_their_flags_say() {
        // The small and the large part of a circle of radius 5 cut 3 from the centre, y pointing down as in SVG.
        let small = 25.0 * (0.8_f64).asin() - 12.0;
        let disc = 25.0 * std::f64::consts::PI;
        assert!((area("M0 0A5 5 0 0 1 8 0Z") - small).abs() < 1e-9);
        assert!((area("M0 0A5 5 0 0 0 8 0Z") + small).abs() < 1e-9);
        assert!((area("M0 0A5 5 0 1 1 8 0Z") - (disc - small)).abs() < 1e-9);
        assert!((area("M0 0A5 5 0 1 0 8 0Z") + (disc - small)).abs() < 1e-9);
    }

    #[test]
    fn radii_too_small_grow_to_a_half_circle() {
        assert!((area("M0 0a1 1 0 0 1 8 0z") - 8.0 * std::f64::consts::PI).abs() < 1e-9);
    }

    #[test]
    fn smooth_commands_mirror_the_handle_before() {
        let whole = area("M0 0C0 2 3 2 3 0S6-2 6 0L6 5H0Z");
        let spelled = area("M0 0C0 2 3 2 3 0C3 -2 6 -2 6 0L6 5L0 5Z");
        assert!((whole - spelled).abs() < 1e-12 && whole.abs() > 1.0);
    }

    #[test]
    fn what_is_broken_is_refused() {
        for bad in ["0 0L1 1", "M0 0C1 1 2", "M0 0LNaN 1", "M0 0L1 1X", "M0 0L1e400 0"] {
            assert!(parse(bad).is_err(), "{bad}");
        }
    }
}
