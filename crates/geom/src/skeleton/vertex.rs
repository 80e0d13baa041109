//! The disk that touches three elements: closed forms, refined by Newton's method.
//!
//! The disk `(x, r)` touches an element's carrier where its signed gap is `r`. That is linear in `(x, r)` for a line
//! and `|x - c|² = (r + rho)²` for a circle or point, so three elements give two candidates at the most. Each form is
//! written such that nearly tangent elements cancel as little as possible; what is left is polished on the gaps.

use super::element::{Disk, Element};
use crate::point::{Point, Vec2, vec2};
use crate::tolerance::skeleton as tol;

/// Candidates, at most two, better left unsorted.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Candidates {
    disks: [Option<Disk>; 2],
}

impl Candidates {
    const fn none() -> Self {
        Self { disks: [None, None] }
    }

    fn one(disk: Disk) -> Self {
        Self { disks: [Some(disk), None] }
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = Disk> + '_ {
        self.disks.iter().flatten().copied()
    }
}

/// The disks that touch the carriers of three elements.
pub(super) fn touching_three(e: [&Element; 3]) -> Candidates {
    match e.iter().position(|e| e.is_line()) {
        Some(k) => with_line(e[k], e[(k + 1) % 3], e[(k + 2) % 3]),
        None => circles_only(e),
    }
}

/// The radius of a disk that touches a base line at parameter `s` and another carrier, as `(q2 s² + q1 s + q0) / k`.
struct RadiusAlong {
    q: [f64; 3],
    k: f64,
}

impl RadiusAlong {
    fn new(base: &Element, other: &Element) -> Self {
        let (u, n, from) = (base.along(), base.n0, base.start - other.start);
        let difference = (n - other.n0).length_squared();
        if other.is_line() {
            Self { q: [from.dot(other.n0), u.dot(other.n0), 0.0], k: 0.5 * difference }
        } else {
            let to_center = from + other.n0 * other.rho;
            let power = from.dot(from + other.n0 * (2.0 * other.rho));
            let k = other.rho * difference - 2.0 * from.dot(n);
            Self { q: [power, 2.0 * u.dot(to_center), 1.0], k }
        }
    }

    fn at(&self, s: f64) -> f64 {
        ((self.q[2] * s + self.q[1]) * s + self.q[0]) / self.k
    }
}

fn with_line(base: &Element, b: &Element, c: &Element) -> Candidates {
    let (rb, rc) = (RadiusAlong::new(base, b), RadiusAlong::new(base, c));
    let q: [f64; 3] = std::array::from_fn(|i| rb.q[i] * rc.k - rc.q[i] * rb.k);
    let better = if rb.k.abs() >= rc.k.abs() { &rb } else { &rc };
    let disk = |s: f64| {
        let radius = better.at(s);
        Disk { center: base.start + base.along() * s + base.n0 * radius, radius }
    };
    let roots = solve_quadratic(q);
    Candidates { disks: roots.map(|s| s.map(disk)) }
}

/// Real roots of `q0 + q1 s + q2 s²`; a discriminant below 0 counts as 0 (a nearly double root).
fn solve_quadratic([c, b, a]: [f64; 3]) -> [Option<f64>; 2] {
    let finite = |s: f64| Some(s).filter(|s| s.is_finite());
    let half = -0.5 * b;
    let discriminant = (half * half - a * c).max(0.0);
    let q = half + discriminant.sqrt().copysign(half);
    [finite(c / q), finite(q / a)]
}

fn circles_only(e: [&Element; 3]) -> Candidates {
    let base = (0..3).min_by(|&i, &j| e[i].rho.abs().total_cmp(&e[j].rho.abs())).unwrap_or(0);
    let (base, b, c) = (e[base], e[(base + 1) % 3], e[(base + 2) % 3]);
    // with x = c0 + t v, |v| = 1 and t = r + rho0, each other circle gives t = a / (2 (delta - d v))
    let relation = |other: &Element| {
        let d = base.center - other.center;
        let delta = other.rho - base.rho;
        let (length, other_length) = (d.length(), delta.abs());
        (d, delta, (length - other_length) * (length + other_length))
    };
    let ((d1, delta1, a1), (d2, delta2, a2)) = (relation(b), relation(c));
    let v = d2 * a1 - d1 * a2;
    let k = a1 * delta2 - a2 * delta1;
    let squared = v.length_squared();
    if squared == 0.0 {
        return concentric(base, a1, delta1);
    }
    let root = (squared - k * k).max(0.0).sqrt();
    let disk = |side: f64| {
        let unit = (v * k + v.left() * (side * root)) / squared;
        let (k1, k2) = (delta1 - d1.dot(unit), delta2 - d2.dot(unit));
        let t = if k1.abs() >= k2.abs() { 0.5 * a1 / k1 } else { 0.5 * a2 / k2 };
        let radius = t - base.rho;
        Some(Disk { center: base.center + unit * t, radius }).filter(|d| radius.is_finite() && d.center.is_finite())
    };
    Candidates { disks: [disk(1.0), disk(-1.0)] }
}

/// Three circles without a direction: all on one circle seen from inside, whose centre is the vertex.
fn concentric(base: &Element, a: f64, delta: f64) -> Candidates {
    if a == 0.0 && delta == 0.0 && base.rho < 0.0 {
        Candidates::one(Disk { center: base.center, radius: -base.rho })
    } else {
        Candidates::none()
    }
}

/// The largest of the three deviations of the gaps from the radius.
pub(super) fn residual(e: [&Element; 3], disk: Disk) -> f64 {
    e.iter().map(|e| (e.gap(disk.center) - disk.radius).abs()).fold(0.0, f64::max)
}

/// At most two Newton steps on the three gaps; the best disk met and its residual.
pub(super) fn polish(e: [&Element; 3], start: Disk) -> (Disk, f64) {
    let mut best = (start, residual(e, start));
    let mut disk = start;
    for _ in 0..tol::NEWTON_STEPS {
        if best.1 <= tol::EXACT {
            break;
        }
        let Some(next) = newton_step(e, disk) else { break };
        disk = next;
        let error = residual(e, disk);
        if error < best.1 {
            best = (disk, error);
        } else {
            break;
        }
    }
    best
}

fn newton_step(e: [&Element; 3], disk: Disk) -> Option<Disk> {
    let n: [Vec2; 3] = e.map(|e| e.normal_at(disk.center));
    let f: [f64; 3] = e.map(|e| e.gap(disk.center) - disk.radius);
    let (u, v) = (n[1] - n[0], n[2] - n[0]);
    let (a, b) = (f[0] - f[1], f[0] - f[2]);
    let determinant = u.cross(v);
    let step = vec2(a * v.y - b * u.y, b * u.x - a * v.x) / determinant;
    let center: Point = disk.center + step;
    let radius = disk.radius + f[0] + n[0].dot(step);
    (center.is_finite() && radius.is_finite()).then_some(Disk { center, radius })
}
