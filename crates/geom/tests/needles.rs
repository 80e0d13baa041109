//! Walls that turn back on themselves by almost a whole turn, where a commercial library failed: figure 11 of Molina-Carmona, Jimeno
//! and Davia. Every engine offsets a pocket with a needle of wall in it, of angles 2π − 10^-k inside the pocket.

use pocketry_geom::offset::bisector::BisectorEngine;
use pocketry_geom::offset::morphology::eroded;
use pocketry_geom::offset::{OffsetEngine, OffsetOptions, PairwiseEngine, VoronoiEngine};
use pocketry_geom::repair::{Healed, Note, RepairOptions, build};
use pocketry_geom::{Contour, Point, Vec2};
use std::f64::consts::PI;

/// Offset distance, mm.
const D: f64 = 3.0;
const LENGTH: f64 = 20.0;
/// Without the needle.
const PLAIN: f64 = 34.0 * 24.0;

/// A pocket of 40 by 30 mm with a needle from the middle of its upper side, turned about the origin.
fn pocket(angle: f64, turned: f64) -> Healed {
    let half = LENGTH * (0.5 * angle).tan();
    let corners = [
        [0.0, 0.0],
        [40.0, 0.0],
        [40.0, 30.0],
        [20.0 + half, 30.0],
        [20.0, 30.0 - LENGTH],
        [20.0 - half, 30.0],
        [0.0, 30.0],
    ];
    let turn = |[x, y]: [f64; 2]| {
        let v = Vec2::from_angle(turned);
        [x * v.x - y * v.y, x * v.y + y * v.x, 0.0]
    };
    build(vec![Contour::from_vertices(&corners.map(turn))], &RepairOptions::default()).unwrap()
}

/// A needle that is nowhere as wide as two points can be told apart is cut off, with a note.
fn is_cut_off(healed: &Healed) -> bool {
    healed.notes.iter().any(|n| matches!(n, Note::Spike { .. }))
}

/// The area that `offset` leaves, against that for a needle without width.
fn check(name: &str, without_width: f64, offset: impl Fn(&Healed) -> f64) {
    for k in 1..=12 {
        let angle = 10f64.powi(-k);
        for turned in [0.0, 0.3, 1.1, 2.0] {
            let healed = pocket(angle, turned);
            let expected = if is_cut_off(&healed) { PLAIN } else { without_width };
            let area = offset(&healed);
            // The needle and its parallels take up to some mm2 for each radian of its angle.
            assert!(
                (area - expected).abs() <= 800.0 * angle + 1e-3,
                "{name}, 2π − 1e-{k}: {area} instead of {expected}"
            );
        }
    }
}

fn area_by(engine: &impl OffsetEngine, healed: &Healed) -> f64 {
    let offsets = engine.offsets(&healed.region, &[D], &OffsetOptions::default()).unwrap();
    offsets[0].loops.iter().map(|l| l.contour.area()).sum()
}

/// Around a needle without width: a band of twice the distance, and half a disc about its tip.
const ROUND: f64 = PLAIN - 2.0 * D * (LENGTH - D) - 0.5 * PI * D * D;

#[test]
fn round_offsets_of_needles() {
    check("voronoi", ROUND, |h| area_by(&VoronoiEngine, h));
    check("pairwise", ROUND, |h| area_by(&PairwiseEngine, h));
    let disc = Contour::from_vertices(&[[-D, 0.0, 1.0], [D, 0.0, 1.0]]);
    check("morphology", ROUND, |h| eroded(&h.region, &disc, Point::ORIGIN).unwrap().area());
}

#[test]
fn mitred_offsets_of_needles() {
    // Without a limit the mitre goes through the wall across; at a limit of 1 it is square.
    check("bisector", PLAIN - 2.0 * D * 24.0, |h| area_by(&BisectorEngine::default(), h));
    let square = BisectorEngine { mitre_limit: Some(1.0), ..BisectorEngine::default() };
    check("bisector, limited", PLAIN - 2.0 * D * LENGTH, |h| area_by(&square, h));
}
