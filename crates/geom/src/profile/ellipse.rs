//! An ellipse as tangent arcs.

use crate::contour::Contour;
use crate::point::{Point, Vec2, point, vec2};
use crate::tolerance::{CIRCULAR, FIT};
use std::f64::consts::TAU;

/// Never more parts than this: an ellipse as slim as the drawing's coordinates allow has ends that no tool has.
const MOST_PARTS: u32 = 4096;

/// The ellipse with these half axes as biarcs that lie within the fit tolerance of it; a circle is four arcs.
///
/// Each part between two parameters becomes a biarc with the ellipse's own ends and tangents. Curvature changes one way in a
/// quarter, so that the biarc crosses the ellipse once, and its error is largest near the quarters of its parts, where it is
/// looked at.
pub(super) fn contour(a: f64, b: f64) -> Contour {
    let mut parts = 4;
    if (a - b).abs() > CIRCULAR * a.max(b) {
        parts = 8;
        while parts < MOST_PARTS && error(a, b, parts) > FIT {
            parts *= 2;
        }
    }
    let vertices: Vec<[f64; 3]> =
        (0..parts).flat_map(|k| biarc(place(a, b, k, parts), place(a, b, k + 1, parts))).collect();
    Contour::from_vertices(&vertices)
}

/// A point of the ellipse and its unit tangent there.
type Place = (Point, Vec2);

fn place(a: f64, b: f64, k: u32, parts: u32) -> Place {
    let (sin, cos) = (TAU * f64::from(k % parts) / f64::from(parts)).sin_cos();
    (point(a * cos, b * sin), vec2(-a * sin, b * cos).normalized())
}

/// The two arcs, as vertices with bulges, that leave and arrive along the tangents; their joint is the one with tangents of
/// equal length.
fn biarc((p, t): Place, (q, u): Place) -> [[f64; 3]; 2] {
    let v = q - p;
    let (along, spread) = (v.dot(t + u), 2.0 * (1.0 - t.dot(u)));
    let length = v.length_squared() / (along + (along * along + spread * v.length_squared()).sqrt());
    let joint = p.midpoint(q) + (t - u) * (0.5 * length);
    // An arc's sweep is twice the angle between its tangent and its chord.
    let leave = (0.5 * t.angle_to(joint - p)).tan();
    let arrive = (0.5 * (q - joint).angle_to(u)).tan();
    [[p.x, p.y, leave], [joint.x, joint.y, arrive]]
}

/// How far the arcs lie from the ellipse (to first order in the error), mm.
fn error(a: f64, b: f64, parts: u32) -> f64 {
    let off = |p: Point| {
        let (x, y) = (p.x / a, p.y / b);
        let slope = 2.0 * (x / a).hypot(y / b);
        ((x * x + y * y - 1.0) / slope).abs()
    };
    let of_part = |k: u32| {
        let arcs = Contour { segments: open_biarc(place(a, b, k, parts), place(a, b, k + 1, parts)) };
        arcs.segments.iter().flat_map(|s| [0.25, 0.5, 0.75, 1.0].map(|t| off(s.at(t)))).fold(0.0, f64::max)
    };
    (0..parts / 4).map(of_part).fold(0.0, f64::max)
}

fn open_biarc(from: Place, to: Place) -> Vec<crate::segment::Segment> {
    let [first, second] = biarc(from, to);
    let joint = point(second[0], second[1]);
    vec![
        crate::segment::Segment::from_bulge(from.0, joint, first[2]),
        crate::segment::Segment::from_bulge(joint, to.0, second[2]),
    ]
}
