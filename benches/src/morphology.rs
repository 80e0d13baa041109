//! The morphological engine on shapes of the sizes of table 1 of Molina-Carmona, Jimeno and Davia, and how its time grows.
//!
//! `cargo run --release -p pocketry-benches --bin morphology`. The best of several runs counts. The paper's times are of other hardware
//! (about 2006). Shapes are blobs of `m` lines, as long as `n` steps of 0.1 mm, the paper's usual step; lines are offset whole
//! here, so that `n` costs nothing. The tool is a rounded rectangle of two radii and two flats a side, as in the paper's figure 3.

use pocketry_geom::offset::morphology::eroded;
use pocketry_geom::{Point, Region, ToolProfile};
use pocketry_testkit::{corpus, shapes};
use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

/// Segments, points and milliseconds of table 1.
const TABLE_1: [(usize, usize, f64); 10] = [
    (102, 2370, 31.0),
    (158, 5620, 141.0),
    (198, 4772, 156.0),
    (200, 3943, 140.0),
    (190, 3071, 109.0),
    (161, 2461, 79.0),
    (181, 5772, 172.0),
    (296, 10516, 500.0),
    (391, 9702, 609.0),
    (444, 6009, 531.0),
];

/// Length of the paper's step, mm.
const STEP: f64 = 0.1;

fn main() -> Result<(), Box<dyn Error>> {
    for (m, n, paper) in TABLE_1 {
        let ours = 1e3 * seconds(m, n)?;
        println!("m {m:>4}  n {n:>6}  {ours:>7.3} ms  paper {paper:>4} ms: {:>5.0} x", paper / ours);
    }
    let mut rungs = Vec::new();
    for m in [100, 1_000, 10_000] {
        let n = 24 * m;
        let ours = seconds(m, n)?;
        println!("m {m:>5}  n {n:>6}  {:>8.3} ms", 1e3 * ours);
        rungs.push(((m * n) as f64, ours));
    }
    let (first, last) = (rungs[0], rungs[rungs.len() - 1]);
    println!("time grows with (n m) to the power of {:.3}", (last.1 / first.1).ln() / (last.0 / first.0).ln());
    Ok(())
}

/// Seconds of the fastest of some erosions.
fn seconds(m: usize, n: usize) -> Result<f64, Box<dyn Error>> {
    let region = blob(m, STEP * n as f64)?;
    // Of the width of some lobes, so that there is global interference too.
    let size = region.bbox().size() / 25.0;
    let tool = ToolProfile::rounded(2.0 * size, size, size / 4.0);
    let mut least = f64::INFINITY;
    let clock = Instant::now();
    for run in 0.. {
        let start = Instant::now();
        black_box(eroded(black_box(&region), tool.contour(), Point::ORIGIN)?.edge_count());
        least = least.min(start.elapsed().as_secs_f64());
        if run >= 4 && clock.elapsed().as_secs_f64() > 0.5 {
            break;
        }
    }
    Ok(least)
}

/// A lobed outline of `m` lines, `length` mm long.
fn blob(m: usize, length: f64) -> Result<Region, Box<dyn Error>> {
    let lobed = |scale: f64| shapes::polar(m, |a| scale * (1.0 + 0.25 * (7.0 * a).sin() + 0.05 * (31.0 * a).cos()));
    let unit: f64 = corpus::region(&vec![lobed(1.0)])?.segments().map(pocketry_geom::Segment::length).sum();
    Ok(corpus::region(&vec![lobed(length / unit)])?)
}
