//! Decompositions of skeletons made by hand.

use super::*;
use crate::offset::OffsetOptions;
use crate::point::point;
use crate::skeleton::handmade::{annulus, disc, ell, neck, rectangle};

fn areas(s: &Subpockets) -> Vec<f64> {
    s.list().iter().map(Subpocket::area).collect()
}

#[test]
fn a_convex_pocket_is_one_subpocket() {
    for (skeleton, area) in [(rectangle(10.0, 4.0), 40.0), (disc(5.0), 25.0 * std::f64::consts::PI), (ell(10.0), 300.0)]
    {
        let s = Subpockets::new(&skeleton);
        assert_eq!((s.list().len(), s.borders().len(), s.list()[0].contours.len()), (1, 0, 1));
        assert!((areas(&s)[0] - area).abs() < 1e-9, "{:?}", areas(&s));
    }
}

#[test]
fn an_annulus_of_constant_width_is_a_kind_of_its_own() {
    let s = Subpockets::new(&annulus(10.0, 4.0));
    assert_eq!((s.list().len(), s.list()[0].is_annulus, s.list()[0].contours.len()), (1, true, 2));
    assert!((areas(&s)[0] - 84.0 * std::f64::consts::PI).abs() < 1e-9);
}

#[test]
fn a_neck_is_cut_from_tip_to_tip() {
    let s = Subpockets::new(&neck());
    let [border] = s.borders() else { panic!("{:?}", s.borders()) };
    assert_eq!((border.pass, border.clearance), (point(0.0, 0.0), 1.0));
    let areas = areas(&s);
    assert!(areas.len() == 2 && areas.iter().all(|a| (a - 87.0).abs() < 1e-9), "{areas:?}");
    // Below the pass loops run along the cut; above it they are the offset's.
    let offsetter = s.offsetter();
    for (d, sharing) in [(0.5, true), (0.99, true), (1.0, false), (2.0, false)] {
        let loops = s.loops_at(&offsetter, d).unwrap();
        assert_eq!(loops.len(), 2, "at {d}");
        assert!(loops.iter().all(|l| l.path.sites.contains(&NONE) == sharing), "at {d}");
    }
    let half = s.loops_at(&offsetter, 0.5).unwrap();
    let whole = VoronoiOffsetter::new(&neck()).offset(0.5, &OffsetOptions::default()).unwrap();
    let sum: f64 = half.iter().map(|l| l.path.contour.area()).sum();
    assert!((sum - whole.loops[0].contour.area()).abs() < 1e-9);
}
