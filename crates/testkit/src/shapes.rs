//! Generated regions for tests and benches: the same for the same arguments, everywhere.

use crate::Loops;
use std::f64::consts::TAU;

/// A regular polygon of n edges about a centre.
pub fn ngon(n: usize, radius: f64, [x, y]: [f64; 2]) -> Vec<[f64; 3]> {
    polar(n, |_| radius).into_iter().map(|v| [v[0] + x, v[1] + y, 0.0]).collect()
}

/// A rectangle from the origin with corners rounded to `fillet`.
pub fn rounded_rectangle(width: f64, height: f64, fillet: f64) -> Vec<[f64; 3]> {
    let quarter = (TAU / 16.0).tan();
    let (w, h, f) = (width, height, fillet);
    vec![
        [f, 0.0, 0.0],
        [w - f, 0.0, quarter],
        [w, f, 0.0],
        [w, h - f, quarter],
        [w - f, h, 0.0],
        [f, h, quarter],
        [0.0, h - f, 0.0],
        [0.0, f, quarter],
    ]
}

/// A full circle of two arcs.
pub fn circle(radius: f64, [x, y]: [f64; 2]) -> Vec<[f64; 3]> {
    vec![[x - radius, y, 1.0], [x + radius, y, 1.0]]
}

/// A comb: a back of height 1 with `teeth` teeth of the given length and width 1, 1 apart.
pub fn comb(teeth: usize, length: f64) -> Vec<[f64; 3]> {
    let right = 2.0 * teeth as f64 - 1.0;
    let mut out = vec![[0.0, 0.0, 0.0], [right, 0.0, 0.0]];
    for k in (0..teeth).rev() {
        let x = 2.0 * k as f64;
        out.extend([[x + 1.0, 1.0 + length, 0.0], [x, 1.0 + length, 0.0]]);
        if k > 0 {
            out.extend([[x, 1.0, 0.0], [x - 1.0, 1.0, 0.0]]);
        }
    }
    out
}

/// A gear: teeth with straight flanks between two circles, tips and roots as arcs about the centre.
pub fn gear(teeth: usize, root: f64, tip: f64) -> Vec<[f64; 3]> {
    let pitch = TAU / teeth as f64;
    let arc = (0.3 * pitch / 4.0).tan();
    (0..teeth)
        .flat_map(|k| {
            let at = |radius: f64, part: f64, bulge: f64| {
                let (sin, cos) = ((k as f64 + part) * pitch).sin_cos();
                [radius * cos, radius * sin, bulge]
            };
            [at(root, 0.0, arc), at(root, 0.3, 0.0), at(tip, 0.5, arc), at(tip, 0.8, 0.0)]
        })
        .collect()
}

/// A smooth closed curve with round islands, of about n edges in all: a tenth of them on islands of 12 edges.
/// With `arcs` the edges are arcs that join smoothly, else the chords of those curves.
pub fn smooth_with_islands(n: usize, arcs: bool) -> Loops {
    let islands = (n / 120).max(1);
    let side = (islands as f64).sqrt().ceil();
    let outer = n - 12 * islands;
    let wave = |t: f64| 100.0 * (1.0 + 0.08 * (5.0 * t).sin() + 0.05 * (13.0 * t).cos());
    let island = |t: f64| 20.0 / side * (1.0 + 0.02 * (2.0 * t).sin());
    let curve = |n: usize, r: &dyn Fn(f64) -> f64| if arcs { smooth_arcs(n / 2, r) } else { polar(n, r) };
    let mut loops = vec![curve(outer, &wave)];
    for k in 0..islands {
        let place = |k: f64| 110.0 * ((k + 0.5) / side - 0.5);
        let [x, y] = [place(k as f64 % side), place((k as f64 / side).floor())];
        loops.push(curve(12, &island).into_iter().map(|v| [v[0] + x, v[1] + y, v[2]]).collect());
    }
    loops
}

/// A smooth closed curve of 2n arcs, two between any successive ones of n points on `r(angle)` with its tangents there.
pub fn smooth_arcs(n: usize, r: impl Fn(f64) -> f64) -> Vec<[f64; 3]> {
    let step = TAU / n as f64;
    let at = |k: usize| {
        let t = step * (k % n) as f64;
        let (sin, cos) = t.sin_cos();
        let slope = (r(t + 0.01 * step) - r(t - 0.01 * step)) / (0.02 * step);
        let tangent = [slope * cos - r(t) * sin, slope * sin + r(t) * cos];
        ([r(t) * cos, r(t) * sin], unit(tangent))
    };
    (0..n).flat_map(|k| biarc(at(k), at(k + 1))).collect()
}

fn unit([x, y]: [f64; 2]) -> [f64; 2] {
    let length = x.hypot(y);
    [x / length, y / length]
}

/// The vertices of two arcs from one point with its tangent to another, whose control polygon has legs of one length.
fn biarc((p, t): ([f64; 2], [f64; 2]), (q, u): ([f64; 2], [f64; 2])) -> [[f64; 3]; 2] {
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let chord = [q[0] - p[0], q[1] - p[1]];
    let along = dot(chord, [t[0] + u[0], t[1] + u[1]]);
    let leg = dot(chord, chord) / (along + (along * along + 2.0 * (1.0 - dot(t, u)) * dot(chord, chord)).sqrt());
    let joint = [0, 1].map(|i| 0.5 * (p[i] + q[i] + leg * (t[i] - u[i])));
    let (first, second) = ([joint[0] - p[0], joint[1] - p[1]], [q[0] - joint[0], q[1] - joint[1]]);
    // the tangent of half the angle between tangent and chord
    let bulge = |sine: f64, cosine: f64, chord: [f64; 2]| sine / (chord[0].hypot(chord[1]) + cosine);
    [
        [p[0], p[1], bulge(cross(t, first), dot(t, first), first)],
        [joint[0], joint[1], bulge(cross(second, u), dot(second, u), second)],
    ]
}

/// A section through a die cavity as a mesh slicer gives it: n short chords along a wavy wall with a deep bay.
pub fn die_cavity(n: usize) -> Loops {
    let bay = |t: f64| 1.0 - 0.55 * (-((t - 1.5) / 0.25).powi(2)).exp();
    let ripple = |t: f64| 1.0 + 0.02 * (31.0 * t).sin() + 0.008 * (97.0 * t).cos() + 0.1 * (3.0 * t).sin();
    vec![polar(n, |t| 80.0 * bay(t) * ripple(t))]
}

/// A closed polygon of n vertices at radius r(t) in direction t.
pub fn polar(n: usize, r: impl Fn(f64) -> f64) -> Vec<[f64; 3]> {
    (0..n)
        .map(|k| {
            let t = TAU * k as f64 / n as f64;
            let (sin, cos) = t.sin_cos();
            [r(t) * cos, r(t) * sin, 0.0]
        })
        .collect()
}
