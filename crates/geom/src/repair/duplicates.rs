//! Loops that enclose nothing, and loops drawn twice.

use super::report::Note;
use crate::bbox::BBox;
use crate::contour::Contour;
use crate::index::SegmentIndex;

/// Drops every loop that another one repeats within the tolerance, however split, started or directed.
pub(super) fn drop_repeated(loops: &mut Vec<(u32, Contour)>, tolerance: f64, notes: &mut Vec<Note>) {
    let boxes: Vec<BBox> = loops.iter().map(|(_, c)| c.bbox()).collect();
    let mut order: Vec<usize> = (0..loops.len()).collect();
    order.sort_by(|&a, &b| boxes[a].min.x.total_cmp(&boxes[b].min.x).then(a.cmp(&b)));
    let mut repeats: Vec<Option<usize>> = vec![None; loops.len()];
    for (k, &i) in order.iter().enumerate() {
        let near = order[k + 1..].iter().take_while(|&&j| boxes[j].min.x - boxes[i].min.x <= tolerance);
        for &j in near {
            let (kept, later) = (i.min(j), i.max(j));
            let same = repeats[kept].is_none() && repeats[later].is_none();
            if same && corners_agree(boxes[i], boxes[j], tolerance) && cover(&loops[i].1, &loops[j].1, tolerance) {
                repeats[later] = Some(kept);
            }
        }
    }
    for (later, kept) in repeats.iter().enumerate() {
        if let Some(kept) = kept {
            let at = loops[later].1.segments[0].start();
            notes.push(Note::Duplicate { contour: loops[later].0, kept: loops[*kept].0, at });
        }
    }
    let mut repeat = repeats.iter();
    loops.retain(|_| repeat.next().is_some_and(Option::is_none));
}

fn corners_agree(a: BBox, b: BBox, tolerance: f64) -> bool {
    a.min.distance(b.min) <= 2.0 * tolerance && a.max.distance(b.max) <= 2.0 * tolerance
}

/// Whether each loop's corners and middles lie on the other.
fn cover(a: &Contour, b: &Contour, tolerance: f64) -> bool {
    let lies_on = |a: &Contour, b: &Contour| {
        let index = SegmentIndex::new(&b.segments);
        a.segments
            .iter()
            .all(|s| [s.start(), s.at(0.5)].into_iter().all(|p| index.nearest(p).is_some_and(|(_, d)| d <= tolerance)))
    };
    (a.length() - b.length()).abs() <= tolerance * (a.segments.len() + b.segments.len()) as f64
        && lies_on(a, b)
        && lies_on(b, a)
}
