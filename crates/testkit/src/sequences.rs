//! Point sequences as bad as files hold them: repeated points, spikes of no width, tiny segments, backtracking, crossings.

use crate::Loops;

/// A sequence of pseudo-random numbers (xorshift).
#[derive(Clone, Debug)]
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// From 0 to 1.
    fn share(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }
}

/// One or two closed point sequences with some defects, the same for the same seed.
pub fn malformed(seed: u64) -> Loops {
    let mut numbers = Numbers(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    (0..=numbers.below(2)).map(|_| sequence(&mut numbers)).collect()
}

fn sequence(numbers: &mut Numbers) -> Vec<[f64; 3]> {
    let count = 3 + numbers.below(10);
    let snapped = numbers.below(2) == 0;
    let mut points: Vec<[f64; 3]> = Vec::new();
    for k in 0..count {
        let angle = std::f64::consts::TAU * k as f64 / count as f64;
        let radius = 2.0 + 8.0 * numbers.share();
        let mut p = [radius * angle.cos(), radius * angle.sin(), 0.0];
        if snapped {
            p = p.map(f64::round);
        }
        points.push(p);
        let last = points[points.len() - 1];
        match numbers.below(12) {
            0 => points.push(last),
            // A spike of no width: out and back.
            1 => points.extend([[last[0] + 3.0, last[1] + 1.0, 0.0], last]),
            2 => points.push([last[0] + 1e-9, last[1], 0.0]),
            // Back along the way it came.
            3 if points.len() > 1 => {
                let before = points[points.len() - 2];
                points.push([0.5 * (before[0] + last[0]), 0.5 * (before[1] + last[1]), 0.0]);
            }
            4 => points.push([20.0 * numbers.share() - 10.0, 20.0 * numbers.share() - 10.0, 0.0]),
            _ => {}
        }
    }
    points
}
