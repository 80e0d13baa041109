//! Compares the offset engines on corpus files: the offset of one at `d + ε` must lie inside that of the other at `d`, and that
//! inside the first's at `d - ε`.
//!
//! ```text
//! cargo run --release -p pocketry-geom --example engines_agree -- [--only TEXT] [--arcs] [--levels N] FILE.jsonl...
//! ```
//!
//! ε is 2e-7 of the region's size (for regions with arcs, with `--arcs`, the chord tolerance on top).

use pocketry_geom::distance::Boundary;
use pocketry_geom::offset::{Offset, OffsetEngine, OffsetOptions, PairwiseEngine, VoronoiEngine};
use pocketry_geom::{Point, Region, Segment};
use pocketry_testkit::corpus;
use std::process::ExitCode;
use std::time::Instant;

/// ε as a part of the region's size.
const RELATIVE: f64 = 2e-7;

fn main() -> ExitCode {
    let (mut only, mut arcs, mut levels, mut files) = (String::new(), false, 12, Vec::new());
    let mut args = std::env::args().skip(1);
    while let Some(arg) = args.next() {
        match arg.as_str() {
            "--only" => only = args.next().unwrap_or_default(),
            "--arcs" => arcs = true,
            "--levels" => levels = args.next().and_then(|l| l.parse().ok()).unwrap_or(levels),
            _ => files.push(arg),
        }
    }
    let (mut seen, mut bad) = (0, 0);
    for record in files.iter().flat_map(|f| corpus::read(f.as_ref()).unwrap_or_default()) {
        let straight = record.loops.iter().flatten().all(|v| v[2] == 0.0);
        if !record.id.contains(&only) || (!straight && !arcs) {
            continue;
        }
        let Ok(region) = corpus::region(&record.loops) else { continue };
        seen += 1;
        let begun = Instant::now();
        let distances: Vec<f64> =
            (0..levels).map(|k| record.tool_radius + f64::from(k) * record.interval).filter(|d| *d > 0.0).collect();
        let outcome = compare(&region, &distances, straight);
        let seconds = begun.elapsed().as_secs_f64();
        if let Err(why) = &outcome {
            bad += 1;
            println!("{} ({} edges): {why}", record.id, region.edge_count());
        } else if seconds > 20.0 {
            println!("{} took {seconds:.1} s", record.id);
        }
    }
    println!("{} of {seen} regions agree", seen - bad);
    if bad == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn compare(region: &Region, distances: &[f64], straight: bool) -> Result<(), String> {
    let options = OffsetOptions::default();
    let chords = PairwiseEngine::chord_tolerance(distances[0]);
    let epsilon = RELATIVE * region.bbox().size() + if straight { 0.0 } else { chords };
    let around: Vec<f64> = distances.iter().flat_map(|d| [d + epsilon, (d - epsilon).max(0.5 * d)]).collect();
    let pairwise = PairwiseEngine.offsets(region, distances, &options).map_err(|e| e.to_string())?;
    let exact = VoronoiEngine.offsets(region, &around, &options).map_err(|e| e.to_string())?;
    for (k, b) in pairwise.iter().enumerate() {
        inside(&exact[2 * k], b).map_err(|p| format!("at {}: exact d + ε is outside pairwise at {p:?}", b.distance))?;
        inside(b, &exact[2 * k + 1])
            .map_err(|p| format!("at {}: pairwise is outside exact d - ε at {p:?}", b.distance))?;
    }
    Ok(())
}

/// Whether one offset's area lies within another's: no point of its loops outside, no point of the other's loops inside.
fn inside(small: &Offset, large: &Offset) -> Result<(), Point> {
    let [s, l] = [small, large].map(|o| {
        let contours: Vec<_> = o.loops.iter().map(|l| l.contour.clone()).collect();
        let none = vec![None; contours.len()];
        Boundary::new(&Region::from_parts_unchecked(contours, none))
    });
    let points = |b: &Boundary| -> Vec<Point> {
        b.segments().iter().flat_map(|s: &Segment| [s.start(), s.at(0.3), s.at(0.7)]).collect()
    };
    let outside = points(&s).into_iter().find(|&p| !l.contains(p));
    outside.or_else(|| points(&l).into_iter().find(|&p| s.contains(p))).map_or(Ok(()), Err)
}
