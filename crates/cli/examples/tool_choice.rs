//! Judges the choice of a tool by brute force: on regions of a batch every tool is planned and its program proven, and what
//! it leaves is measured along the walls from the path itself.
//!
//! `cargo run --release -p pocketry --example tool_choice -- REGIONS BATCH.jsonl...`; exit status 1 where a choice differs.

use pocketry_cam::{PocketJob, ToolChooser, plan};
use pocketry_geom::index::SegmentIndex;
use pocketry_geom::skeleton::Skeleton;
use pocketry_geom::{Point, Region, Segment};
use pocketry_io::import::{self, ImportOptions};
use pocketry_io::post::{Dialect, LinuxCnc, OutputUnit, PostOptions};
use pocketry_motion::{FeedKind, Move};
use pocketry_verify::{VerifyOptions, verify};
use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

/// Tools as shares of the one that the record names.
const SHARES: [f64; 5] = [0.3, 0.6, 1.0, 1.5, 2.5];
/// Scallops as shares of that tool's radius.
const SCALLOPS: [f64; 3] = [0.05, 0.2, 0.45];
/// Samples on each wall.
const SAMPLES: u32 = 64;
/// Regions larger than this take too long here.
const MOST_EDGES: usize = 300;
/// What the samples, and the proof's own tolerance, may miss: a share of the scallop.
const DOUBT: f64 = 0.02;

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let mut args = std::env::args().skip(1);
    let wanted: usize = args.next().unwrap_or_default().parse()?;
    let (mut judged, mut choices, mut differ) = (0, 0, 0);
    let files: Vec<String> = args.collect();
    for file in &files {
        let mut here = 0;
        for line in import::read_batch(Path::new(file))? {
            let Ok(drawing) = import::parse_region_json(&line.text, &ImportOptions::default()) else { continue };
            let Some(radius) = drawing.tool_radius.filter(|_| drawing.region.edge_count() <= MOST_EDGES) else {
                continue;
            };
            if here >= wanted.div_ceil(files.len()) {
                break;
            }
            here += 1;
            judged += 1;
            for (scallop, ours, theirs) in compare(&drawing.region, radius)? {
                choices += 1;
                if ours != theirs {
                    differ += 1;
                    println!("{:?}: scallop {scallop}: chosen {ours:?}, by brute force {theirs:?}", line.id);
                }
            }
        }
    }
    println!("{judged} regions, {choices} choices, {differ} differ");
    Ok(if differ == 0 && judged > 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// For each tolerance that is not in doubt the diameter chosen, and the one found by brute force.
type Choice = (f64, Option<f64>, Option<f64>);

fn compare(region: &Region, radius: f64) -> Result<Vec<Choice>, Box<dyn Error>> {
    let skeleton = Skeleton::build(region)?;
    let chooser = ToolChooser::new(&skeleton);
    let tools: Vec<f64> = SHARES.iter().map(|s| 2.0 * radius * s).collect();
    let left: Vec<Option<f64>> = tools.iter().map(|&d| brute_force(region, &skeleton, d)).collect();
    let mut out = Vec::new();
    for scallop in SCALLOPS.map(|s| s * radius) {
        let doubtful = left.iter().flatten().any(|l| (l - scallop).abs() <= DOUBT * scallop);
        if !doubtful {
            let meets = |k: &usize| left[*k].is_some_and(|l| l <= scallop);
            let theirs = (0..tools.len()).rev().find(meets).map(|k| tools[k]);
            out.push((scallop, chooser.largest(&tools, scallop, &PocketJob::default())?, theirs));
        }
    }
    Ok(out)
}

/// How far from what a proven program cuts a wall is at most; `None` where there is no such program.
fn brute_force(region: &Region, skeleton: &Skeleton, diameter: f64) -> Option<f64> {
    let job = PocketJob::for_diameter(diameter);
    let plan = plan(region, skeleton, &job).ok()?;
    let options = PostOptions::for_tool(job.tool, job.feeds, OutputUnit::Millimetre);
    let text = LinuxCnc.write(&plan.program, &options).ok()?;
    let judge = VerifyOptions { depth: Some(job.stock.depth), ..VerifyOptions::new(0.5 * diameter) };
    if !verify(region, &text, &judge).ok()?.is_proven() {
        return None;
    }
    let cutting = |m: &&(pocketry_motion::Point3, &Move)| m.1.feed() == Some(FeedKind::Cut);
    let steps: Vec<_> = plan.program.steps().collect();
    let mut path: Vec<Segment> = steps.iter().filter(cutting).map(|(from, m)| m.plan_view(from.xy())).collect();
    path.extend(plan.groups.iter().map(|g| Segment::line(g.start, g.start)));
    let index = SegmentIndex::new(&path);
    let beyond = |p: Point| index.nearest(p).map_or(f64::INFINITY, |n| n.1) - 0.5 * diameter;
    let samples = |s: &Segment| (0..=SAMPLES).map(|k| s.at(f64::from(k) / f64::from(SAMPLES))).collect::<Vec<_>>();
    Some(region.segments().flat_map(samples).map(beyond).fold(0.0, f64::max))
}
