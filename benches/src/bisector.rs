//! One mitre-joined offset against `cavalier_contours` (round) and `clipper2-rust` (mitre) in the same run, and how time grows.
//!
//! `cargo run --release -p pocketry-benches --bin bisector`. The best of several runs counts, the three take turns; conversions of
//! the input, and the peer's index over it, are not timed.

use cavalier_contours::polyline::{PlineSourceMut, Polyline};
use cavalier_contours::shape_algorithms::{Shape, ShapeOffsetOptions};
use clipper2_rust::clipper::inflate_paths_64;
use clipper2_rust::core::{Paths64, Point64};
use clipper2_rust::offset::{EndType, JoinType};
use pocketry_geom::offset::{BisectorEngine, OffsetEngine, OffsetOptions};
use pocketry_geom::{Region, Segment};
use pocketry_testkit::{Loops, corpus, shapes};
use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

/// The peer's coordinates are integers: so many steps a millimetre.
const GRID: f64 = 1e6;

fn main() -> Result<(), Box<dyn Error>> {
    compare("speaker, 3 mm", &speaker(), 3.0)?;
    for (name, shape) in [
        ("smooth with islands", &(|n| shapes::smooth_with_islands(n, false)) as &dyn Fn(usize) -> Loops),
        ("die cavity", &shapes::die_cavity),
    ] {
        let mut times = Vec::new();
        for n in [1_000, 10_000, 100_000] {
            let region = corpus::region(&shape(n))?;
            // Islands become smaller with n: the distance stays the same share of the gaps between them.
            let distance = if name == "die cavity" { 3.0 } else { 30.0 / (n as f64 / 120.0).sqrt().max(1.0) };
            let seconds = best(|| ours(&region, distance))?;
            println!("{name:<22} {:>7} lines, {distance:.2} mm: {:.3} ms", region.edge_count(), 1e3 * seconds);
            times.push((region.edge_count() as f64, seconds));
        }
        let (first, last) = (times[0], times[times.len() - 1]);
        println!("{name}: growth exponent {:.3}", (last.1 / first.1).ln() / (last.0 / first.0).ln());
    }
    Ok(())
}

/// The corpus's speaker of 2,069 lines where it is at hand, a generated section elsewhere.
fn speaker() -> Loops {
    let file = corpus::shared().map(|folder| folder.join("corpus/dev/mesh.jsonl"));
    let records = file.and_then(|f| corpus::read(&f).ok()).unwrap_or_default();
    let found = records.into_iter().find(|r| r.id == "mesh/literature/speaker-2069a");
    found.map_or_else(|| shapes::die_cavity(2069), |r| r.loops)
}

fn ours(region: &Region, distance: f64) -> Result<usize, Box<dyn Error>> {
    Ok(BisectorEngine::default().offsets(region, &[distance], &OffsetOptions::default())?[0].loops.len())
}

fn compare(name: &str, loops: &Loops, distance: f64) -> Result<(), Box<dyn Error>> {
    let region = corpus::region(loops)?;
    let (indexed, paths) = (Shape::from_plines(plines(&region)), paths(&region));
    let mut least = [f64::INFINITY; 3];
    for _ in 0..5 {
        let clipper = || inflate_paths_64(&paths, -distance * GRID, JoinType::Miter, EndType::Polygon, 10.0, 0.0).len();
        let cavalier = || indexed.parallel_offset(distance, &ShapeOffsetOptions::default());
        let seconds =
            [best(|| ours(&region, distance))?, best(|| Ok(cavalier().ccw_plines.len()))?, best(|| Ok(clipper()))?];
        least = std::array::from_fn(|k| least[k].min(seconds[k]));
    }
    let [ours, cavalier, clipper] = least.map(|s| 1e3 * s);
    println!(
        "{name}, {} lines: {ours:.3} ms; cavalier_contours {cavalier:.3} ms, {:.2} times; clipper2-rust {clipper:.3} ms, {:.2} times",
        region.edge_count(),
        cavalier / ours,
        clipper / ours
    );
    Ok(())
}

fn plines(region: &Region) -> Vec<Polyline> {
    let pline = |c: &pocketry_geom::Contour| {
        let mut pline = Polyline::new_closed();
        for s in &c.segments {
            pline.add(s.start().x, s.start().y, s.bulge());
        }
        pline
    };
    region.contours().iter().map(pline).collect()
}

fn paths(region: &Region) -> Paths64 {
    let place = |s: &Segment| Point64::new((s.start().x * GRID).round() as i64, (s.start().y * GRID).round() as i64);
    region.contours().iter().map(|c| c.segments.iter().map(place).collect()).collect()
}

/// Seconds of the fastest of some runs.
fn best(mut work: impl FnMut() -> Result<usize, Box<dyn Error>>) -> Result<f64, Box<dyn Error>> {
    let mut seconds = f64::INFINITY;
    let clock = Instant::now();
    for run in 0.. {
        let start = Instant::now();
        black_box(work()?);
        seconds = seconds.min(start.elapsed().as_secs_f64());
        if run >= 2 && clock.elapsed().as_secs_f64() > 0.2 {
            break;
        }
    }
    Ok(seconds)
}
