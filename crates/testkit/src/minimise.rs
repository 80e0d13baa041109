//! Smaller cases that still fail: loops, then runs of vertices, are left out as long as the failure stays.

use crate::Loops;

/// The smallest loops found for which `fails` still holds, with at most `budget` trials.
///
/// First whole loops are dropped, then runs of vertices of halving length (their bulges with them), then bulges are
/// straightened, then coordinates are rounded to fewer digits.
pub fn minimise(loops: &Loops, budget: usize, mut fails: impl FnMut(&Loops) -> bool) -> Loops {
    let mut best = loops.clone();
    let mut left = budget;
    let mut attempt = |candidate: Loops, best: &mut Loops| {
        if left == 0 || candidate.is_empty() || candidate == *best {
            return false;
        }
        left -= 1;
        let smaller = fails(&candidate);
        if smaller {
            *best = candidate;
        }
        smaller
    };
    loop {
        let before = best.clone();
        drop_loops(&mut best, &mut attempt);
        drop_runs(&mut best, &mut attempt);
        straighten(&mut best, &mut attempt);
        if best == before {
            break;
        }
    }
    round(&mut best, &mut attempt);
    best
}

type Attempt<'a> = &'a mut dyn FnMut(Loops, &mut Loops) -> bool;

fn drop_loops(best: &mut Loops, attempt: Attempt) {
    let mut k = 0;
    while k < best.len() {
        let mut candidate = best.clone();
        candidate.remove(k);
        if !attempt(candidate, best) {
            k += 1;
        }
    }
}

fn drop_runs(best: &mut Loops, attempt: Attempt) {
    for l in 0..best.len() {
        let mut run = best[l].len() / 2;
        while run > 0 {
            let mut at = 0;
            while at + run <= best[l].len() && best[l].len() > run + 1 {
                let mut candidate = best.clone();
                candidate[l].drain(at..at + run);
                if !attempt(candidate, best) {
                    at += run;
                }
            }
            run /= 2;
        }
    }
}

fn straighten(best: &mut Loops, attempt: Attempt) {
    for l in 0..best.len() {
        for k in 0..best[l].len() {
            let mut candidate = best.clone();
            candidate[l][k][2] = 0.0;
            attempt(candidate, best);
        }
    }
}

fn round(best: &mut Loops, attempt: Attempt) {
    for digits in [0, 1, 2, 3, 4, 6, 8] {
        let unit = 10_f64.powi(digits);
        let candidate = best
            .iter()
            .map(|l| l.iter().map(|v| [(v[0] * unit).round() / unit, (v[1] * unit).round() / unit, v[2]]).collect())
            .collect();
        if attempt(candidate, best) {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_matter_goes() {
        let square = |x: f64| vec![[x, 0.0, 0.3], [x + 1.0, 0.0, 0.0], [x + 1.0, 1.0, 0.0], [x, 1.0, 0.0]];
        let loops = vec![square(0.1), square(5.0), square(10.0)];
        let small = minimise(&loops, 10_000, |l| l.iter().flatten().any(|v| v[0] > 10.5 && v[1] > 0.5));
        assert_eq!(small, [[[11.0, 1.0, 0.0], [10.0, 1.0, 0.0]]]);
    }
}
