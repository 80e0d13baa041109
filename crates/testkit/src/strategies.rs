//! Random valid regions for property tests.

use crate::{Loops, shapes};
use proptest::prelude::*;
use std::f64::consts::TAU;

/// Any of the families below.
pub fn region() -> impl Strategy<Value = Loops> {
    prop_oneof![star(), star_with_arcs(), plate_with_holes(), slot(), gear(), comb(), near_joints(), ngon()]
}

/// A star-shaped polygon about the origin with radii of 5 to 10.
pub fn star() -> impl Strategy<Value = Loops> {
    prop::collection::vec(5.0..10.0, 3..24_usize)
        .prop_map(|radii| vec![shapes::polar(radii.len(), |t| radii[(t / TAU * radii.len() as f64).round() as usize])])
}

/// The same with arcs for edges, too flat to meet one another.
pub fn star_with_arcs() -> impl Strategy<Value = Loops> {
    prop::collection::vec((7.0..10.0, -0.08..0.08), 6..24_usize).prop_map(|items| {
        let n = items.len();
        let mut polygon = shapes::polar(n, |t| items[(t / TAU * n as f64).round() as usize].0);
        for (v, (_, bulge)) in polygon.iter_mut().zip(&items) {
            v[2] = *bulge;
        }
        vec![polygon]
    })
}

/// A rounded plate with round and polygonal islands on a grid.
pub fn plate_with_holes() -> impl Strategy<Value = Loops> {
    let hole = (0..7_usize, 1.0..3.5, -0.5..0.5, -0.5..0.5);
    (prop::collection::vec(hole, 0..6_usize), 0.5..4.0).prop_map(|(holes, fillet)| {
        let mut loops = vec![shapes::rounded_rectangle(30.0, 20.0, fillet)];
        for (k, (sides, radius, dx, dy)) in holes.into_iter().enumerate() {
            let center = [5.0 + 10.0 * (k % 3) as f64 + dx, 5.0 + 10.0 * (k / 3) as f64 + dy];
            let hole = if sides < 3 { shapes::circle(radius, center) } else { shapes::ngon(sides, radius, center) };
            loops.push(hole);
        }
        loops
    })
}

/// A straight slot with round ends: a channel of constant width.
pub fn slot() -> impl Strategy<Value = Loops> {
    (0.1..20.0, 0.5..5.0).prop_map(|(length, r): (f64, f64)| {
        vec![vec![[0.0, -r, 0.0], [length, -r, 1.0], [length, r, 0.0], [0.0, r, 1.0]]]
    })
}

/// A gear.
pub fn gear() -> impl Strategy<Value = Loops> {
    (4..16_usize, 5.0..9.0, 1.0..3.0).prop_map(|(teeth, root, depth)| vec![shapes::gear(teeth, root, root + depth)])
}

/// A comb.
pub fn comb() -> impl Strategy<Value = Loops> {
    (2..8_usize, 0.5..6.0).prop_map(|(teeth, length)| vec![shapes::comb(teeth, length)])
}

/// A regular polygon: one vertex of degree n.
pub fn ngon() -> impl Strategy<Value = Loops> {
    (3..40_usize, 1.0..10.0).prop_map(|(n, radius)| vec![shapes::ngon(n, radius, [0.0; 2])])
}

/// A rectangle whose lower side has a joint that turns by almost nothing.
pub fn near_joints() -> impl Strategy<Value = Loops> {
    (-9.0..-1.0, prop::bool::ANY, 1.0..9.0).prop_map(|(digits, up, x)| {
        let turn = 10_f64.powf(digits) * if up { 1.0 } else { -1.0 };
        vec![vec![[0.0, 0.0, 0.0], [x, turn, 0.0], [10.0, 0.0, 0.0], [10.0, 6.0, 0.0], [0.0, 6.0, 0.0]]]
    })
}
