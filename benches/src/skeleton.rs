//! Skeleton and one offset at n = 1e3, 1e4, 1e5, with growth exponents; against `boostvoronoi` on the same edges.
//!
//! `cargo run --release -p pocketry-benches --bin skeleton`. The best of several runs counts; ratios are of one run.

use boostvoronoi::prelude::Builder;
use peak_alloc::PeakAlloc;
use pocketry_geom::Region;
use pocketry_geom::offset::OffsetOptions;
use pocketry_geom::offset::voronoi::VoronoiOffsetter;
use pocketry_geom::skeleton::Skeleton;
use pocketry_testkit::{Loops, corpus, shapes};
use std::error::Error;
use std::time::Instant;

#[global_allocator]
static PEAK: PeakAlloc = PeakAlloc;

/// Coordinates for `boostvoronoi` are integers: the region's size becomes this.
const GRID: f64 = 1e8;

/// Seconds and memory of one piece of work.
#[derive(Clone, Copy)]
struct Cost {
    seconds: f64,
    megabytes: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    println!(
        "{:<22} {:>8} {:>10} {:>8} {:>8} {:>12}",
        "smooth with islands", "edges", "skeleton s", "µs/edge", "MB", "one offset s"
    );
    let lines = ladder(false)?;
    let arcs = ladder(true)?;
    for (name, costs) in [("lines", &lines), ("arcs", &arcs)] {
        let (first, last) = (costs[0], costs[costs.len() - 1]);
        let decades = (last.0 as f64 / first.0 as f64).ln();
        let exponent = |pick: fn(&(usize, f64, f64)) -> f64| (pick(&last) / pick(&first)).ln() / decades;
        println!("growth exponent, {name}: skeleton {:.2}, offset {:.2}", exponent(|c| c.1), exponent(|c| c.2));
    }
    for (l, a) in lines.iter().zip(&arcs) {
        println!("arcs / lines at {}: {:.2}", l.0, (a.1 / a.0 as f64) / (l.1 / l.0 as f64));
    }
    compare("die cavity", &die(3500))?;
    compare("smooth with islands", &shapes::smooth_with_islands(100_000, false))
}

/// The corpus's cavity of 3,500 edges where it is at hand, a generated one elsewhere.
fn die(n: usize) -> Loops {
    let file = corpus::shared().map(|folder| folder.join("corpus/dev/mesh.jsonl"));
    let records = file.and_then(|f| corpus::read(&f).ok()).unwrap_or_default();
    let found = records.into_iter().find(|r| r.id == format!("mesh/literature/die-{n}"));
    found.map_or_else(|| shapes::die_cavity(n), |r| r.loops)
}

/// Edges, seconds of the skeleton, seconds of one offset.
fn ladder(arcs: bool) -> Result<Vec<(usize, f64, f64)>, Box<dyn Error>> {
    let mut out = Vec::new();
    for n in [1_000, 10_000, 100_000] {
        let region = corpus::region(&shapes::smooth_with_islands(n, arcs))?;
        let (skeleton, cost) = best(|| Skeleton::build(&region));
        let skeleton = skeleton?;
        let distance = 0.3 * skeleton.vertices().iter().map(|v| v.clearance).fold(0.0, f64::max);
        let offsetter = VoronoiOffsetter::new(&skeleton);
        let (offset, offset_cost) = best(|| offsetter.offset(distance, &OffsetOptions::default()));
        offset?;
        let edges = region.edge_count();
        println!(
            "{:<22} {edges:>8} {:>10.5} {:>8.3} {:>8.1} {:>12.6}",
            if arcs { "arcs" } else { "lines" },
            cost.seconds,
            1e6 * cost.seconds / edges as f64,
            cost.megabytes,
            offset_cost.seconds
        );
        out.push((edges, cost.seconds, offset_cost.seconds));
    }
    Ok(out)
}

fn compare(name: &str, loops: &Loops) -> Result<(), Box<dyn Error>> {
    let region = corpus::region(loops)?;
    let (skeleton, ours) = best(|| Skeleton::build(&region));
    skeleton?;
    let segments = integer_segments(&region);
    let (diagram, theirs) = best(|| Builder::<i32>::default().with_segments(segments.iter())?.build());
    diagram?;
    println!(
        "{name}, {} edges: skeleton {:.5} s, {:.1} MB; boostvoronoi {:.5} s, {:.1} MB; ratio {:.1}",
        region.edge_count(),
        ours.seconds,
        ours.megabytes,
        theirs.seconds,
        theirs.megabytes,
        theirs.seconds / ours.seconds
    );
    Ok(())
}

fn integer_segments(region: &Region) -> Vec<[i32; 4]> {
    let bbox = region.bbox();
    let place = |c: f64, low: f64| ((c - low) / bbox.size() * GRID).round() as i32;
    region
        .segments()
        .map(|s| [s.start(), s.end()].map(|p| [place(p.x, bbox.min.x), place(p.y, bbox.min.y)]))
        .filter(|[a, b]| a != b)
        .map(|[a, b]| [a[0], a[1], b[0], b[1]])
        .collect()
}

/// The fastest of at least three runs, half a second of them if they are short, and the memory above what was in use.
fn best<T>(mut work: impl FnMut() -> T) -> (T, Cost) {
    let before = PEAK.current_usage_as_mb();
    PEAK.reset_peak_usage();
    let mut result = work();
    let megabytes = f64::from(PEAK.peak_usage_as_mb() - before);
    let mut seconds = f64::INFINITY;
    let clock = Instant::now();
    for run in 0.. {
        let start = Instant::now();
        result = work();
        seconds = seconds.min(start.elapsed().as_secs_f64());
        if run >= 2 && clock.elapsed().as_secs_f64() > 0.5 {
            break;
        }
    }
    (result, Cost { seconds, megabytes })
}
