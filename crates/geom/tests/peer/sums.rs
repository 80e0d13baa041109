//! Erosions of every region of the shared corpus, where it is at hand, by convex polygons. The complement of the places is the Minkowski sum of
//! the region's complement and the reflected polygon.

use crate::corpus::{FAMILIES, is_wanted};
use crate::peer::Grid;
use pocketry_geom::offset::morphology::eroded;
use pocketry_geom::{Contour, Point, Region};
use pocketry_testkit::corpus::{Record, read, region as build, shared};
use pocketry_testkit::shapes;

/// How much smaller and larger the peer's polygons are, as a share of the region's size.
const NESTING: f64 = 1e-6;

/// How far chords may lie from arcs, as a share of the region's size.
const FLATTENING: f64 = 1e-4;

/// A record's region with chords in place of arcs.
fn flattened(record: &Record) -> Option<Region> {
    let region = build(&record.loops).ok()?;
    let height = FLATTENING * region.bbox().size();
    let vertices = |c: &Contour| {
        let mut points = Vec::new();
        c.segments.iter().for_each(|s| s.flatten(height, &mut points));
        points.iter().map(|p| [p.x, p.y, 0.0]).collect()
    };
    let loops = region.contours().iter().map(vertices).collect();
    build(&loops).ok()
}

/// Convex polygons about the origin, and the distance of their nearest edge from there, mm.
fn polygons(r: f64) -> [(Vec<[f64; 3]>, f64); 3] {
    let block =
        vec![[-1.5 * r, -0.7 * r, 0.0], [1.5 * r, -0.7 * r, 0.0], [1.5 * r, 0.8 * r, 0.0], [-1.5 * r, 0.8 * r, 0.0]];
    [(block, 0.7 * r), (shapes::ngon(3, r, [0.0; 2]), 0.5 * r), (shapes::ngon(8, r, [0.1 * r, 0.0]), 0.8 * r)]
}

/// What is wrong with the places of a polygon in a region.
fn compare(region: &Region, (polygon, reach): &(Vec<[f64; 3]>, f64)) -> Vec<String> {
    let places = match eroded(region, &Contour::from_vertices(polygon), Point::ORIGIN) {
        Ok(places) => places,
        Err(e) => return vec![e.to_string()],
    };
    let grid = Grid::new(region.bbox());
    let step = NESTING * region.bbox().size() / reach;
    let scaled = |share: f64| polygon.iter().map(|v| Point { x: share * v[0], y: share * v[1] }).collect::<Vec<_>>();
    let [smaller, larger] = [1.0 - step, 1.0 + step].map(scaled);
    let far = larger.iter().map(|p| p.to_vec().length()).fold(0.0, f64::max);
    let all = grid.region(&places);
    let mut wrong = Vec::new();
    for window in grid.windows(region, far) {
        let ours = grid.within(&all, window.bbox);
        let too_many = grid.excess(&ours, &grid.places(&window, &smaller));
        let missing = grid.excess(&grid.places(&window, &larger), &ours);
        wrong.extend(too_many.iter().map(|p| format!("places too many at {p:?}")));
        wrong.extend(missing.iter().map(|p| format!("places missing at {p:?}")));
    }
    wrong
}

#[test]
fn places_of_polygons_agree_with_an_independent_minkowski_sum_on_the_corpus() {
    let Some(shared) = shared() else { return };
    let (mut agree, mut regions, mut failures) = (0, 0, Vec::new());
    for family in FAMILIES {
        for record in read(&shared.join(format!("corpus/dev/{family}.jsonl"))).expect("a corpus file") {
            let Some(region) = flattened(&record).filter(|r| is_wanted(&record, r, 40)) else { continue };
            regions += 1;
            let r = if record.tool_radius > 0.0 { record.tool_radius } else { 0.02 * region.bbox().size() };
            for (k, polygon) in polygons(r).iter().enumerate() {
                let wrong = compare(&region, polygon);
                agree += usize::from(wrong.is_empty());
                failures.extend(wrong.into_iter().map(|w| format!("{} by {k}: {w}", record.id)));
            }
        }
    }
    println!("{regions} regions, {agree} erosions agree");
    assert!(failures.is_empty(), "{} failures:\n{}", failures.len(), failures.join("\n"));
}
