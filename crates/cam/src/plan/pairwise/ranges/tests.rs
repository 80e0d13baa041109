use super::*;
use pocketry_geom::offset::Offset;
use pocketry_geom::{Contour, Region};
use pocketry_testkit::shapes;

#[test]
fn stretches_about_a_circle_are_not_refined_for_ever() {
    // All fibres of a circle end at its centre, but for rounding along them: stretches were halved again and again.
    let (radius, stepover) = (0.2, 0.392);
    let circle = Contour::from_vertices(&shapes::ngon(470, 0.45, [0.0, 0.0]));
    let circle = Region::from_parts_unchecked(vec![circle], vec![None]);
    let offsetter = PairwiseOffsetter::new(&circle);
    let stray = 0.5 * degenerate_slack(radius) + STRAY_SHARE * (2.0 * radius - stepover);
    let (low, high) = (2.0 * radius, radius + stepover);
    let range = Range { fibres: Fibres::new(&offsetter, low, high), radius: trusted(radius), stray };
    let envelope = offsetter.offset(low).unwrap();
    for curve in cleanup_curves(&envelope, &Offset::default(), 0.0) {
        let (fibres, stretches) = (range.curve(&curve).fibres.len(), curve.stretches.len());
        assert!(fibres <= 4 * stretches, "{fibres} fibres for {stretches} stretches");
    }
}
