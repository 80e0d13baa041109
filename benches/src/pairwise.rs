//! The pair-wise engine: single offsets, the family of figure 14 (tool radius 10, interval 15) and its whole plan with clean-up
//! paths on the die cavities of 3,500 and 4,000 points, against `cavalier_contours` (bare offsets) in the same run; growth from 1e3 to 1e5 points, of one shape
//! sampled ever more finely and of one that has ever more parts.
//!
//! `cargo run --release -p pocketry-benches --bin pairwise`. The best of several runs counts.

use cavalier_contours::polyline::{PlineSource, PlineSourceMut, Polyline};
use cavalier_contours::shape_algorithms::Shape;
use pocketry_cam::{PocketJob, plan_pairwise};
use pocketry_geom::Region;
use pocketry_geom::offset::PairwiseEngine;
use pocketry_testkit::{Loops, corpus, shapes};
use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    for n in [3500, 4000] {
        let loops = die(n);
        let region = corpus::region(&loops)?;
        let shape = shape(&region);
        let family = family(&region)?;
        let ours = best(20, || PairwiseEngine.with_ranges(black_box(&region), &family));
        let one = best(20, || PairwiseEngine.with_ranges(black_box(&region), &family[..1]));
        let theirs = best(5, || family.iter().map(|&d| parallel(&shape, d)).sum::<usize>());
        let their_one = best(5, || parallel(&shape, family[0]));
        println!(
            "die-{n}: {} offsets {ours:.2} ms, cavalier_contours {theirs:.2} ms: {:.1} x",
            family.len(),
            theirs / ours
        );
        let job = PocketJob { stepover: 15.0, ..PocketJob::for_diameter(20.0) };
        for (what, cleanup) in [("bare", false), ("with clean-up", true)] {
            let job = PocketJob { cleanup, ..job.clone() };
            let planned = best(20, || plan_pairwise(black_box(&region), &job));
            println!("die-{n}: plan {what} {planned:.2} ms: {:.1} x", theirs / planned);
        }
        println!("die-{n}: one offset {one:.2} ms, cavalier_contours {their_one:.2} ms: {:.1} x", their_one / one);
    }
    growth("die cavity at 5 mm", |n| Ok((corpus::region(&shapes::die_cavity(n))?, 5.0)))?;
    // As many teeth as it takes: work and output grow alike.
    growth("comb at a third of its gaps", |n| Ok((corpus::region(&comb(n))?, 1.0)))
}

/// Times from 1e3 to 1e5 points, and the exponent of their growth.
fn growth(name: &str, job: impl Fn(usize) -> Result<(Region, f64), Box<dyn Error>>) -> Result<(), Box<dyn Error>> {
    let mut rungs = Vec::new();
    for n in [1_000, 10_000, 100_000] {
        let (region, d) = job(n)?;
        let ms = best(9, || PairwiseEngine.with_ranges(black_box(&region), &[d]));
        println!("{name}, {n} points: {ms:.3} ms, {:.3} µs a point", 1e3 * ms / n as f64);
        rungs.push((n as f64, ms));
    }
    let (first, last) = (rungs[0], rungs[rungs.len() - 1]);
    println!("{name}: growth exponent {:.3}", (last.1 / first.1).ln() / (last.0 / first.0).ln());
    Ok(())
}

/// A trunk with narrow bays on one side, of n points.
fn comb(n: usize) -> Loops {
    let bays = (n / 4) as f64;
    let mut points = vec![[6.0 * bays, 10.0, 0.0], [0.0, 10.0, 0.0]];
    for k in 0..n / 4 {
        let x = 6.0 * k as f64;
        let depth = 5.0 + (k % 7) as f64;
        points.extend([[x, 0.0, 0.0], [x, -depth, 0.0], [x + 3.0, -depth, 0.0], [x + 3.0, 0.0, 0.0]]);
    }
    vec![points]
}

/// The corpus's cavity where it is at hand, a generated one elsewhere.
fn die(n: usize) -> Loops {
    let file = corpus::shared().map(|folder| folder.join("corpus/dev/mesh.jsonl"));
    let records = file.and_then(|f| corpus::read(&f).ok()).unwrap_or_default();
    let found = records.into_iter().find(|r| r.id == format!("mesh/literature/die-{n}"));
    found.map_or_else(|| shapes::die_cavity(n), |r| r.loops)
}

/// The distances 10, 25, 40, … as long as something is left.
fn family(region: &Region) -> Result<Vec<f64>, Box<dyn Error>> {
    let all: Vec<f64> = (0..100).map(|k| 10.0 + 15.0 * f64::from(k)).collect();
    let offsets = PairwiseEngine.with_ranges(region, &all)?;
    Ok(offsets.iter().filter(|o| !o.offset.loops.is_empty()).map(|o| o.offset.distance).collect())
}

/// Best time of several runs, ms.
fn best<T>(runs: usize, mut work: impl FnMut() -> T) -> f64 {
    let mut time = || {
        let begun = Instant::now();
        black_box(work());
        1e3 * begun.elapsed().as_secs_f64()
    };
    (0..runs).map(|_| time()).fold(f64::INFINITY, f64::min)
}

fn shape(region: &Region) -> Shape<f64> {
    let plines = region.contours().iter().map(|c| {
        let mut pline = Polyline::new_closed();
        for [x, y, bulge] in c.to_vertices() {
            pline.add(x, y, bulge);
        }
        pline
    });
    Shape::from_plines(plines)
}

/// Vertices of the offset that `cavalier_contours` finds.
fn parallel(shape: &Shape<f64>, d: f64) -> usize {
    let found = shape.parallel_offset(d, &cavalier_contours::shape_algorithms::ShapeOffsetOptions::default());
    found.ccw_plines.iter().chain(&found.cw_plines).map(|p| p.polyline.vertex_count()).sum()
}
