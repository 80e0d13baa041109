//! Many offsets of one skeleton: time for each output segment of a further offset at n = 1e3 … 1e5 and 10 … 1,000 offsets,
//! and 50 offsets of the die cavity against `cavalier_contours`.
//!
//! `cargo run --release -p pocketry-benches --bin offsets`. Times are CPU
//! seconds, the mean of several runs; ratios are of one run.

use cavalier_contours::polyline::{PlineSource, PlineSourceMut, PlineVertex, Polyline};
use cavalier_contours::shape_algorithms::{Shape, ShapeOffsetOptions};
use pocketry_geom::Region;
use pocketry_geom::offset::OffsetOptions;
use pocketry_geom::offset::voronoi::VoronoiOffsetter;
use pocketry_geom::skeleton::Skeleton;
use pocketry_testkit::{Loops, corpus, shapes};
use std::error::Error;
use std::time::Instant;

/// Offsets of the family that is compared.
const FAMILY: usize = 50;

fn main() -> Result<(), Box<dyn Error>> {
    println!("{:<8} {:>8} {:>8} {:>12} {:>10} {:>12}", "edges of", "n", "offsets", "segments", "s", "ns/segment");
    let mut costs = Vec::new();
    for arcs in [false, true] {
        for n in [1_000, 10_000, 100_000] {
            let region = corpus::region(&shapes::smooth_with_islands(n, arcs))?;
            let skeleton = Skeleton::build(&region)?;
            let offsetter = VoronoiOffsetter::new(&skeleton);
            for m in [10, 100, 1_000] {
                let (segments, seconds) = timed(|| output(&offsetter, &distances(&skeleton, m)));
                let each = 1e9 * seconds / segments as f64;
                let kind = if arcs { "arcs" } else { "lines" };
                println!("{kind:<8} {n:>8} {m:>8} {segments:>12} {seconds:>10.4} {each:>12.1}");
                costs.push(each);
            }
        }
    }
    let (least, most) = costs.iter().fold((f64::INFINITY, 0.0), |(a, b): (f64, f64), &c| (a.min(c), b.max(c)));
    println!("time for each segment varies by a factor of {:.2}", most / least);
    compare(&die(3500))
}

/// Distances that share the largest clearance evenly.
fn distances(skeleton: &Skeleton, m: usize) -> Vec<f64> {
    let highest = skeleton.vertices().iter().map(|v| v.clearance).fold(0.0, f64::max);
    (0..m).map(|k| highest * (k as f64 + 0.5) / m as f64).collect()
}

/// Segments of all offsets; each is dropped once it is counted.
fn output(offsetter: &VoronoiOffsetter<'_>, distances: &[f64]) -> usize {
    let count = |&d: &f64| {
        let offset = offsetter.offset(d, &OffsetOptions::default()).unwrap_or_default();
        offset.loops.iter().map(|l| l.contour.segments.len()).sum::<usize>()
    };
    distances.iter().map(count).sum()
}

fn die(n: usize) -> Loops {
    let file = corpus::shared().map(|folder| folder.join("corpus/dev/mesh.jsonl"));
    let records = file.and_then(|f| corpus::read(&f).ok()).unwrap_or_default();
    let found = records.into_iter().find(|r| r.id == format!("mesh/literature/die-{n}"));
    found.map_or_else(|| shapes::die_cavity(n), |r| r.loops)
}

fn compare(loops: &Loops) -> Result<(), Box<dyn Error>> {
    let region = corpus::region(loops)?;
    let skeleton = Skeleton::build(&region)?;
    let at = distances(&skeleton, FAMILY);
    let ((), building) = timed(|| drop(Skeleton::build(&region)));
    let (segments, offsets) = timed(|| output(&VoronoiOffsetter::new(&skeleton), &at));
    let shape = shape(&region);
    let (theirs_segments, theirs) = timed(|| theirs(&shape, &at));
    println!(
        "die cavity, {} edges, {FAMILY} offsets: {segments} segments, skeleton {building:.5} s + offsets {offsets:.5} s; \
         cavalier_contours {theirs_segments} segments, {theirs:.5} s; {:.1} times as long as skeleton and offsets, {:.1} times as \
         long as the offsets",
        region.edge_count(),
        theirs / (building + offsets),
        theirs / offsets
    );
    Ok(())
}

/// The region for `cavalier_contours`, which offsets to the left like us.
fn shape(region: &Region) -> Shape<f64> {
    let polyline = |vertices: Vec<[f64; 3]>| {
        let mut line = Polyline::new_closed();
        for v in vertices {
            line.add_vertex(PlineVertex::new(v[0], v[1], v[2]));
        }
        line
    };
    Shape::from_plines(region.contours().iter().map(|c| polyline(c.to_vertices())))
}

/// Segments of all of their offsets.
fn theirs(shape: &Shape<f64>, distances: &[f64]) -> usize {
    let count = |&d: &f64| {
        let offset = shape.parallel_offset(d, &ShapeOffsetOptions::default());
        let lines = offset.ccw_plines.iter().chain(&offset.cw_plines);
        lines.map(|p| p.polyline.vertex_count()).sum::<usize>()
    };
    distances.iter().map(count).sum()
}

/// The mean of at least as many runs as fill half a second: the system counts CPU time in ticks.
fn timed<T>(mut work: impl FnMut() -> T) -> (T, f64) {
    let clock = Instant::now();
    let now = || cpu_seconds().unwrap_or_else(|| clock.elapsed().as_secs_f64());
    let start = now();
    let mut runs = 0.0;
    loop {
        let result = work();
        runs += 1.0;
        if clock.elapsed().as_secs_f64() > 0.5 {
            return (result, (now() - start) / runs);
        }
    }
}

/// What this thread has computed so far, where the system tells: other programs' turns are not counted.
fn cpu_seconds() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split(' ').next()?.parse::<f64>().ok().map(|nanoseconds| nanoseconds / 1e9)
}
