//! Erodes the regions of corpus files by a circle, as by any other profile, and compares with the exact engine: the erosion at `d` must
//! lie inside the exact offset at `d − ε`, and the exact offset at `d + ε` inside the erosion.
//!
//! ```text
//! cargo run --release -p pocketry-geom --example morphology_corpus -- [--only TEXT] [--every N] [--levels N] [--share X] FILE.jsonl...
//! ```
//!
//! ε is a share of the region's size. Disagreements come with the place; refusals of either engine are counted apart. The worst
//! distance by which the circle misses touching the walls, as a share of the size, is printed at the end.

use pocketry_geom::distance::Boundary;
use pocketry_geom::offset::morphology::{MorphologyError, eroded};
use pocketry_geom::offset::{Offset, OffsetEngine, OffsetError, OffsetOptions, VoronoiEngine};
use pocketry_geom::{Contour, Point, Region};
use pocketry_testkit::{corpus, shapes};
use std::process::ExitCode;

/// What was asked for.
struct Options {
    only: String,
    every: usize,
    levels: u32,
    share: f64,
    files: Vec<String>,
}

/// Results so far.
#[derive(Default)]
struct Tally {
    agree: usize,
    differ: usize,
    refused: usize,
    exact_refused: usize,
    unbuilt: usize,
    worst: f64,
}

enum Outcome {
    /// With the worst miss, as a share of the size.
    Agree(f64),
    Differ {
        distance: f64,
        at: Point,
        what: &'static str,
    },
    Refused {
        distance: f64,
        why: MorphologyError,
    },
    ExactRefused(OffsetError),
}

fn main() -> ExitCode {
    let options = options();
    let mut tally = Tally::default();
    let records = options.files.iter().flat_map(|f| corpus::read(f.as_ref()).unwrap_or_default());
    for record in records.step_by(options.every).filter(|r| r.id.contains(&options.only)) {
        let Ok(region) = corpus::region(&record.loops) else {
            tally.unbuilt += 1;
            continue;
        };
        let distances: Vec<f64> = (0..options.levels)
            .map(|k| record.tool_radius + f64::from(k) * record.interval)
            .filter(|d| *d > 0.0)
            .collect();
        match compare(&region, &distances, options.share) {
            Outcome::Agree(worst) => {
                tally.agree += 1;
                tally.worst = tally.worst.max(worst);
            }
            Outcome::Differ { distance, at, what } => {
                tally.differ += 1;
                println!("{}: at {distance} {what} near ({:.4}, {:.4})", record.id, at.x, at.y);
            }
            Outcome::Refused { distance, why } => {
                tally.refused += 1;
                println!("{}: at {distance} refused: {why}", record.id);
            }
            Outcome::ExactRefused(why) => {
                tally.exact_refused += 1;
                println!("{}: the exact engine refused: {why}", record.id);
            }
        }
    }
    let Tally { agree, differ, refused, exact_refused, unbuilt, worst } = tally;
    println!(
        "{agree} agree, {differ} differ, {refused} refused, {exact_refused} refused by the exact engine, {unbuilt} are no region; \
         worst miss {worst:.1e} of the size"
    );
    if differ == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn options() -> Options {
    let mut options = Options { only: String::new(), every: 1, levels: 4, share: 1e-6, files: Vec::new() };
    let mut args = std::env::args().skip(1);
    while let Some(arg) = args.next() {
        match arg.as_str() {
            "--only" => options.only = args.next().unwrap_or_default(),
            "--every" => options.every = number(args.next(), options.every).max(1),
            "--levels" => options.levels = number(args.next(), options.levels),
            "--share" => options.share = number(args.next(), options.share),
            _ => options.files.push(arg),
        }
    }
    options
}

fn number<T: std::str::FromStr>(text: Option<String>, otherwise: T) -> T {
    text.and_then(|t| t.parse().ok()).unwrap_or(otherwise)
}

fn compare(region: &Region, distances: &[f64], share: f64) -> Outcome {
    let size = region.bbox().size();
    let epsilon = share * size;
    let around: Vec<f64> = distances.iter().flat_map(|d| [d + epsilon, (d - epsilon).max(0.5 * d)]).collect();
    let exact = match VoronoiEngine.offsets(region, &around, &OffsetOptions::default()) {
        Ok(exact) => exact,
        Err(why) => return Outcome::ExactRefused(why),
    };
    let walls = Boundary::new(region);
    let mut worst: f64 = 0.0;
    for (&distance, exact) in distances.iter().zip(exact.chunks(2)) {
        let circle = Contour::from_vertices(&shapes::circle(distance, [0.0; 2]));
        let places = match eroded(region, &circle, Point::ORIGIN) {
            Ok(places) => Boundary::new(&places),
            Err(why) => return Outcome::Refused { distance, why },
        };
        let [small, large] = [&exact[0], &exact[1]].map(boundary);
        if let Some(at) = outside(&small, &places) {
            return Outcome::Differ { distance, at, what: "places are missing" };
        }
        if let Some(at) = outside(&places, &large) {
            return Outcome::Differ { distance, at, what: "there are places too many" };
        }
        let misses = samples(&places).map(|p| (walls.signed_distance(p) - distance).abs() / size);
        worst = misses.fold(worst, f64::max);
    }
    Outcome::Agree(worst)
}

fn boundary(offset: &Offset) -> Boundary {
    let contours: Vec<Contour> = offset.loops.iter().map(|l| l.contour.clone()).collect();
    let none = vec![None; contours.len()];
    Boundary::new(&Region::from_parts_unchecked(contours, none))
}

/// Where one area is not within another: a point of its loops that is outside, or a point of the other's loops inside it.
fn outside(small: &Boundary, large: &Boundary) -> Option<Point> {
    samples(small).find(|&p| !large.contains(p)).or_else(|| samples(large).find(|&p| small.contains(p)))
}

fn samples(of: &Boundary) -> impl Iterator<Item = Point> {
    of.segments().iter().flat_map(|s| [s.start(), s.at(0.3), s.at(0.7)])
}
