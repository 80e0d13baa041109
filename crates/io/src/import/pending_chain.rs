//! Stand-in until `pocketry_geom::chain` lands.
use pocketry_geom::{Contour, Point, Segment};
use std::collections::HashMap;
pub(crate) struct Open {
    pub(crate) pieces: Vec<usize>,
    pub(crate) start: Point,
    pub(crate) end: Point,
    pub(crate) length: f64,
}
pub(crate) struct Chains {
    pub(crate) closed: Vec<(Contour, Vec<usize>)>,
    pub(crate) open: Vec<Open>,
}
pub(crate) fn chain(pieces: &[Segment], tol: f64) -> Chains {
    let cell = (tol * 2.0).max(1e-9);
    let key = |p: Point| ((p.x / cell).floor() as i64, (p.y / cell).floor() as i64);
    let mut grid: HashMap<(i64, i64), Vec<usize>> = HashMap::new();
    for (k, s) in pieces.iter().enumerate() {
        grid.entry(key(s.start())).or_default().push(k);
        grid.entry(key(s.end())).or_default().push(k);
    }
    let mut used = vec![false; pieces.len()];
    let (mut closed, mut open) = (Vec::new(), Vec::new());
    for k in 0..pieces.len() {
        if used[k] {
            continue;
        }
        used[k] = true;
        let mut run = vec![pieces[k]];
        let mut ids = vec![k];
        loop {
            let end = run[run.len() - 1].end();
            if end.distance(run[0].start()) <= tol && run.len() > 1 {
                break;
            }
            let (x, y) = key(end);
            let mut best: Option<(f64, usize, bool)> = None;
            for dx in -1..=1 {
                for dy in -1..=1 {
                    for &j in grid.get(&(x + dx, y + dy)).into_iter().flatten() {
                        if used[j] {
                            continue;
                        }
                        for (d, rev) in
                            [(pieces[j].start().distance(end), false), (pieces[j].end().distance(end), true)]
                        {
                            if d <= tol && best.is_none_or(|b| d < b.0) {
                                best = Some((d, j, rev));
                            }
                        }
                    }
                }
            }
            let Some((_, j, rev)) = best else { break };
            used[j] = true;
            ids.push(j);
            run.push(if rev { pieces[j].reversed() } else { pieces[j] });
        }
        let (s, e) = (run[0].start(), run[run.len() - 1].end());
        if s.distance(e) <= tol {
            super::fit::weld(&mut run, s, s);
            closed.push((Contour::new(run), ids));
        } else {
            let length = run.iter().map(Segment::length).sum();
            open.push(Open { pieces: ids, start: s, end: e, length });
        }
    }
    Chains { closed, open }
}
