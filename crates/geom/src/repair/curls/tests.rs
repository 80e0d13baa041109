//! Curls are cut off where a pen slipped, and nowhere else.

use crate::contour::Contour;
use crate::point::point;
use crate::repair::{Healed, Note, RegionError, RepairOptions, build};
use crate::tolerance;

/// A square of 10 mm whose right side crosses itself in a curl of a given width, half way up.
fn square_with_curl(width: f64) -> Vec<[f64; 3]> {
    vec![
        [0.0, 0.0, 0.0],
        [10.0, 0.0, 0.0],
        [10.0, 5.0, 0.0],
        [10.0 + width, 5.0 + 0.5 * width, 0.0],
        [10.0 + width, 5.0 - 0.5 * width, 0.0],
        [10.0, 5.0 + 0.25 * width, 0.0],
        [10.0, 10.0, 0.0],
        [0.0, 10.0, 0.0],
    ]
}

fn healed(vertices: &[[f64; 3]]) -> Result<Healed, RegionError> {
    build(vec![Contour::from_vertices(vertices)], &RepairOptions::default())
}

/// Whether the region is one as it stands.
fn is_stable(healed: &Healed) -> bool {
    build(healed.region.contours().to_vec(), &RepairOptions::default()).is_ok_and(|again| again.notes.is_empty())
}

#[test]
fn a_curl_smaller_than_the_join_tolerance_is_cut_off_and_told() {
    for width in [1e-3, 9e-3] {
        let mut vertices = square_with_curl(width);
        for _ in 0..vertices.len() {
            vertices.rotate_left(1);
            let healed = healed(&vertices).unwrap();
            let [Note::Curl { contour: 0, at, size }] = healed.notes[..] else { panic!("{:?}", healed.notes) };
            assert!(at.distance(point(10.0, 5.0)) < width && size <= tolerance::JOIN && size > 0.5 * width);
            assert!((healed.region.area() - 100.0).abs() < width * width);
            assert!(is_stable(&healed));
        }
    }
}

#[test]
fn a_larger_curl_is_refused() {
    for width in [0.03, 1.0] {
        let refused = healed(&square_with_curl(width)).unwrap_err();
        assert!(matches!(refused, RegionError::Crossing { first: 0, second: 0, .. }), "{refused}");
    }
}

#[test]
fn what_a_curl_may_measure_falls_with_the_drawing() {
    let shrunk = |by: f64| square_with_curl(9e-3).into_iter().map(|[x, y, b]| [x * by, y * by, b]).collect::<Vec<_>>();
    assert!(healed(&shrunk(0.01)).is_ok());
    assert!(healed(&shrunk(100.0)).is_err());
    let mut small = shrunk(0.1);
    small[3][0] += 2e-3;
    small[4][0] += 2e-3;
    assert!(healed(&small).is_err(), "2.9 um are too much for a drawing of 1 mm");
}

#[test]
fn curls_of_arcs_and_several_on_one_loop_are_cut_off() {
    // Two arcs that run past one another by 3 um before they turn round.
    let vertices = [
        [0.0, 0.0, 0.3],
        [10.0, 0.0, 0.3],
        [10.003, 5.001, 0.0],
        [10.003, 4.999, 0.3],
        [5.0, 9.0, 0.0],
        [4.999, 9.003, 0.0],
        [5.001, 9.002, 0.0],
        [4.998, 8.9985, 0.0],
    ];
    let healed = healed(&vertices).unwrap();
    assert!(
        healed.notes.iter().all(|n| matches!(n, Note::Curl { .. })) && !healed.notes.is_empty(),
        "{:?}",
        healed.notes
    );
    assert!(is_stable(&healed));
}

#[test]
fn a_path_drawn_past_its_start_is_cut_off_where_it_runs_along_itself() {
    // The last side goes 50 um too far, and the closing line back: 3 um from it, then 20 um.
    for (height, past, fine) in [(3.0, 0.002, true), (30.0, 0.02, false)] {
        let corners = [[20.0, 0.0], [10.0, -0.001], [10.0, 40.0], [50.0, 40.0], [50.0, height], [19.95, -past]];
        let vertices = corners.map(|[x, y]| [x, y, 0.0]);
        let healed = healed(&vertices);
        assert_eq!(healed.is_ok(), fine, "{healed:?}");
        if let Ok(healed) = healed {
            assert!(matches!(healed.notes[..], [Note::Curl { .. }]), "{:?}", healed.notes);
            assert!(is_stable(&healed));
        }
    }
}
