use super::*;
use crate::point::point;
use proptest::prelude::*;

fn segment() -> impl Strategy<Value = Segment> {
    let c = || -50.0..50.0_f64;
    (c(), c(), c(), c(), -2.0..2.0_f64).prop_map(|(x, y, u, v, bulge)| {
        let (a, b) = (point(x, y), point(x + 0.3 * u, y + 0.3 * v));
        Segment::from_bulge(a, b, if bulge.abs() < 0.7 { 0.0 } else { bulge })
    })
}

proptest! {
    #[test]
    fn nearest_is_the_minimum_over_all(
        segments in prop::collection::vec(segment(), 1..60), x in -90.0..90.0_f64, y in -90.0..90.0_f64,
    ) {
        let index = SegmentIndex::new(&segments);
        let p = point(x, y);
        let brute = segments.iter().map(|s| s.distance(p)).fold(f64::INFINITY, f64::min);
        let (k, d) = index.nearest(p).unwrap();
        prop_assert_eq!(d, brute);
        prop_assert_eq!(segments[k].distance(p), d);
        prop_assert!(index.nearest_within(p, brute).is_none());
    }

    #[test]
    fn pairs_and_boxes_miss_nothing(segments in prop::collection::vec(segment(), 1..60), margin in 0.0..5.0_f64) {
        let index = SegmentIndex::new(&segments);
        let mut seen = std::collections::HashSet::new();
        let _: ControlFlow<()> = index.visit_pairs(margin, |i, j| {
            assert!(seen.insert((i.min(j), i.max(j))));
            ControlFlow::Continue(())
        });
        let mut visited = Vec::new();
        index.visit(segments[0].bbox(), margin, |k, _| visited.push(k));
        for (i, a) in segments.iter().enumerate() {
            let reach = |q| segments[0].bbox().distance_squared(q).sqrt();
            let inside = (0..=8).any(|k| reach(a.at(f64::from(k) / 8.0)) < 0.999 * margin);
            prop_assert!(!inside || visited.contains(&i));
            for (j, b) in segments.iter().enumerate().skip(i + 1) {
                let near = a.bbox().inflated(0.49 * margin).intersects(b.bbox().inflated(0.49 * margin));
                let close = (0..=8).any(|k| b.distance(a.at(f64::from(k) / 8.0)) < 0.9 * margin);
                prop_assert!(!(near && close) || seen.contains(&(i, j)));
            }
        }
    }

    #[test]
    fn rays_find_what_all_segments_say(
        segments in prop::collection::vec(segment(), 1..60), x in -60.0..90.0_f64, y in -60.0..60.0_f64,
    ) {
        let (index, p) = (SegmentIndex::new(&segments), point(x, y));
        let mut hits = Vec::new();
        for s in &segments {
            crossings_left(s, p, |h| hits.push(h.x));
        }
        prop_assert_eq!(index.crossings_left(p), hits.len());
        let first = hits.into_iter().reduce(f64::max);
        prop_assert_eq!(index.first_left(p, |_, _| true).map(|(_, h)| h.x), first);
    }
}

#[test]
fn an_empty_index_answers() {
    let index = SegmentIndex::new(&[]);
    assert!(index.is_empty() && index.nearest(Point::ORIGIN).is_none());
    assert!(index.first_left(Point::ORIGIN, |_, _| true).is_none());
    assert_eq!(index.visit_pairs(1.0, |_, _| ControlFlow::Break(())), ControlFlow::Continue(()));
}
