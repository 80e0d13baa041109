//! Offsets every polygon region of corpus files with the bisector engine and tells which take long, fail, or have a loop that runs the
//! wrong way round.
//!
//! `cargo run --release -p pocketry-geom --example bisector_corpus -- [--only TEXT] [--limit MITRE] [--slow SECONDS] FILE.jsonl...`

use pocketry_geom::Segment;
use pocketry_geom::offset::{BisectorEngine, Offset, OffsetEngine, OffsetOptions, bisector};
use pocketry_testkit::corpus;
use std::process::ExitCode;
use std::time::Instant;

/// Distances r, r + w, … of a record.
const LEVELS: u32 = 4;

fn main() -> ExitCode {
    let (mut only, mut limit, mut slow, mut files) = (String::new(), None, 0.5, Vec::new());
    let mut args = std::env::args().skip(1);
    while let Some(arg) = args.next() {
        let mut value = || args.next().unwrap_or_default();
        match arg.as_str() {
            "--only" => only = value(),
            "--limit" => limit = value().parse().ok(),
            "--slow" => slow = value().parse().unwrap_or(slow),
            _ => files.push(arg),
        }
    }
    let engine = BisectorEngine { mitre_limit: limit, ..BisectorEngine::default() };
    let (mut seen, mut made, mut loops, mut failed, begun) = (0, 0, 0, 0, Instant::now());
    for record in files.iter().flat_map(|f| corpus::read(f.as_ref()).unwrap_or_default()) {
        let Some(region) = corpus::region(&record.loops).ok().filter(|_| record.id.contains(&only)) else { continue };
        if !region.segments().all(|s| matches!(s, Segment::Line(_))) {
            continue;
        }
        seen += 1;
        let size = region.bbox().size();
        let (r, w) =
            if record.tool_radius > 0.0 { (record.tool_radius, record.interval) } else { (0.02 * size, 0.03 * size) };
        for distance in (0..LEVELS).map(|k| r + f64::from(k) * w) {
            let clock = Instant::now();
            let offsets = engine.offsets(&region, &[distance], &OffsetOptions::default());
            let (seconds, lines) = (clock.elapsed().as_secs_f64(), region.edge_count());
            let name = format!("{} ({lines} lines) at {distance}", record.id);
            let offset = match offsets {
                Ok(mut offsets) => offsets.remove(0),
                Err(e) => {
                    failed += 1;
                    println!("{name}: {e}");
                    continue;
                }
            };
            made += 1;
            loops += offset.loops.len();
            if seconds > slow {
                println!("{name}: {seconds:.2} s, {} loops", offset.loops.len());
            }
            let wrong = wrong_way_round(&offset);
            if wrong > 0 {
                failed += 1;
                println!("{name}: {wrong} loops run the wrong way round");
            }
        }
    }
    println!(
        "{seen} regions, {made} offsets with {loops} loops in {:.1} s, {failed} failed",
        begun.elapsed().as_secs_f64()
    );
    if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Boundaries run counter-clockwise, islands clockwise.
fn wrong_way_round(offset: &Offset) -> usize {
    let remaining = bisector::remaining(offset);
    let loops = remaining.contours().iter().zip(remaining.parents());
    loops.filter(|(contour, parent)| (contour.area() > 0.0) != parent.is_none()).count()
}
