//! Integration of smooth functions by adaptive Gauss–Legendre quadrature.

use std::sync::LazyLock;

/// Points of the rule: exact for polynomials of degree 19.
const POINTS: usize = 10;

/// How many intervals may be halved: a function with noise above the tolerance would go on for ever.
const HALVINGS: u32 = 100;

/// Nodes in [−1, 1] and weights.
static RULE: LazyLock<[(f64, f64); POINTS]> = LazyLock::new(|| std::array::from_fn(node));

/// The integral of `f` from `from` to `to`, halving until the rule on two halves agrees with the rule on the whole
/// within `allowed`; where noise forbids that, after a fixed number of halvings.
pub fn integrate(from: f64, to: f64, allowed: f64, f: impl Fn(f64) -> f64) -> f64 {
    let mut left = HALVINGS;
    halve([from, to], apply(from, to, &f), allowed, &mut left, &f)
}

fn halve([from, to]: [f64; 2], whole: f64, allowed: f64, left: &mut u32, f: &impl Fn(f64) -> f64) -> f64 {
    let middle = 0.5 * (from + to);
    let (low, high) = (apply(from, middle, f), apply(middle, to, f));
    if *left == 0 || (low + high - whole).abs() <= allowed {
        return low + high;
    }
    *left -= 1;
    halve([from, middle], low, allowed, left, f) + halve([middle, to], high, allowed, left, f)
}

/// The rule on one interval.
fn apply(from: f64, to: f64, f: &impl Fn(f64) -> f64) -> f64 {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    half * RULE.iter().map(|&(x, w)| w * f(middle + half * x)).sum::<f64>()
}

/// Node `k` and its weight: a root of the Legendre polynomial by Newton's method from the usual cosine guess.
fn node(k: usize) -> (f64, f64) {
    let n = POINTS as f64;
    let mut x = (std::f64::consts::PI * (k as f64 + 0.75) / (n + 0.5)).cos();
    let mut slope = 1.0;
    for _ in 0..20 {
        let (mut p, mut before) = (x, 1.0);
        for j in 2..=POINTS {
            let j = j as f64;
            (p, before) = (((2.0 * j - 1.0) * x * p - (j - 1.0) * before) / j, p);
        }
        slope = n * (x * p - before) / (x * x - 1.0);
        x -= p / slope;
    }
    (x, 2.0 / ((1.0 - x * x) * slope * slope))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_of_degree_19_are_exact() {
        let value = integrate(-1.0, 2.0, 1e-9, |x| 20.0 * x.powi(19));
        assert!((value - (2f64.powi(20) - 1.0)).abs() < 1e-8);
    }

    #[test]
    fn a_near_pole_is_met_by_halving() {
        let value = integrate(0.0, 1.0, 1e-13, |x| 1.0 / (x + 1e-4));
        assert!((value - (10001f64).ln()).abs() < 1e-11);
    }
}
