use super::*;
use crate::point::point;

fn square(x: f64, y: f64, side: f64) -> Contour {
    Contour::from_vertices(&[[x, y, 0.0], [x + side, y, 0.0], [x + side, y + side, 0.0], [x, y + side, 0.0]])
}

fn heal(loops: Vec<Contour>) -> Healed {
    build(loops, &RepairOptions::default()).unwrap()
}

#[test]
fn nested_squares_alternate() {
    let loops: Vec<Contour> = (0..5).map(|k| square(f64::from(k), f64::from(k), 20.0 - 2.0 * f64::from(k))).collect();
    let healed = heal(loops);
    assert!(healed.notes.is_empty());
    assert_eq!(healed.region.parents(), [None, Some(0), None, Some(2), None]);
    assert!((healed.region.area() - (400.0 - 324.0 + 256.0 - 196.0 + 144.0)).abs() < 1e-9);
}

#[test]
fn a_bowtie_is_refused_where_it_crosses() {
    let bowtie = Contour::from_vertices(&[[0.0, 0.0, 0.0], [2.0, 2.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]]);
    let error = build(vec![square(-5.0, -5.0, 20.0), bowtie], &RepairOptions::default()).unwrap_err();
    assert_eq!(error, RegionError::Crossing { first: 1, second: 1, at: point(1.0, 1.0) });
}
