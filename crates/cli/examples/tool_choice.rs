//! Judges the choice of a tool by brute force: on regions of a batch every tool is planned and its program proven, and what
//! it leaves is measured from the path itself, at points along the walls and all over the region.
//!
//! `cargo run --release -p pocketry --example tool_choice -- REGIONS BATCH.jsonl...`; exit status 1 where a choice differs.

use pocketry_cam::{Choice, PocketJob, ToolFit, choose, plan};
use pocketry_geom::index::SegmentIndex;
use pocketry_geom::skeleton::Skeleton;
use pocketry_geom::{BBox, Point, Region, Segment, point};
use pocketry_io::import::{self, ImportOptions};
use pocketry_io::post::{Dialect, LinuxCnc, OutputUnit, PostOptions};
use pocketry_motion::{FeedKind, Move};
use pocketry_verify::{Report, VerifyOptions, verify};
use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

/// Tools as shares of the one that the record names.
const SHARES: [f64; 5] = [0.3, 0.6, 1.0, 1.5, 2.5];
/// Scallops as shares of that tool's radius.
const SCALLOPS: [f64; 3] = [0.05, 0.2, 0.45];
/// Distance of samples along walls as a share of the tool's radius: what is deepest in a neck is a peak along the wall.
const WALL_STEP: f64 = 0.01;
/// Samples in each row and column of a grid over the region.
const SAMPLES: u32 = 64;
/// Regions larger than this take too long here.
const MOST_EDGES: usize = 300;
/// What the samples, and the proof's own tolerance, may miss: a share of the scallop.
const DOUBT: f64 = 0.02;

/// By how much, as a share of the region's, the area that a tool leaves may differ from what the proof finds unreachable;
/// and how well that has to be known.
const AREA: f64 = 1e-4;

/// What the comparisons have come to.
#[derive(Default)]
struct Tally {
    regions: usize,
    choices: usize,
    doubtful: usize,
    areas: usize,
    differ: usize,
    areas_differ: usize,
}

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let mut args = std::env::args().skip(1);
    let wanted: usize = args.next().unwrap_or_default().parse()?;
    let files: Vec<String> = args.collect();
    let mut tally = Tally::default();
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
            tally.compare(&drawing.region, radius, line.id.as_deref().unwrap_or("?"))?;
        }
    }
    let Tally { regions, choices, doubtful, areas, differ, areas_differ } = tally;
    println!("{regions} regions, {choices} choices, {differ} differ ({doubtful} more too close to call)");
    println!("{areas} areas left are known to the proof, {areas_differ} differ");
    Ok(if differ == 0 && regions > 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

impl Tally {
    /// For each tolerance that is not in doubt compares the tool chosen with the one found by brute force.
    fn compare(&mut self, region: &Region, radius: f64, id: &str) -> Result<(), Box<dyn Error>> {
        self.regions += 1;
        let skeleton = Skeleton::build(region)?;
        let tools: Vec<f64> = SHARES.iter().map(|s| 2.0 * radius * s).collect();
        let left: Vec<Option<Left>> = tools.iter().map(|&d| brute_force(region, &skeleton, d)).collect();
        for (&diameter, theirs) in tools.iter().zip(&left) {
            let Some(theirs) = theirs.as_ref().and_then(|l| l.area) else { continue };
            self.areas += 1;
            let ours = ToolFit::new(&skeleton, diameter, 0.0)?.left;
            if (ours - theirs).abs() > AREA * region.area() {
                self.areas_differ += 1;
                println!("{id}: diameter {diameter}: leaves {ours} mm², by the proof {theirs}");
            }
        }
        for scallop in SCALLOPS.map(|s| s * radius) {
            if left.iter().flatten().any(|l| (l.depth - scallop).abs() <= DOUBT * scallop) {
                self.doubtful += 1;
                continue;
            }
            self.choices += 1;
            let meets = |k: &usize| left[*k].as_ref().is_some_and(|l| l.depth <= scallop);
            let theirs = (0..tools.len()).rev().find(meets).map(|k| tools[k]);
            let ours = match choose(&skeleton, &tools, scallop, &PocketJob::default())? {
                Choice::Tool(diameter) => Some(diameter),
                Choice::None(_) => None,
            };
            if ours != theirs {
                self.differ += 1;
                println!("{id}: scallop {scallop}: chosen {ours:?}, by brute force {theirs:?}");
            }
        }
        Ok(())
    }
}

/// What a proven program leaves.
struct Left {
    /// How far a point of the region is from what is cut at most, mm.
    depth: f64,
    /// What the proof finds unreachable, mm²; none where it does not vouch for it.
    area: Option<f64>,
}

/// What the tool leaves by its program; `None` where there is no proven one.
fn brute_force(region: &Region, skeleton: &Skeleton, diameter: f64) -> Option<Left> {
    let job = PocketJob::for_diameter(diameter);
    let plan = plan(region, skeleton, &job).ok()?;
    let options = PostOptions::for_tool(job.tool, job.feeds, OutputUnit::Millimetre);
    let text = LinuxCnc.write(&plan.program, &options).ok()?;
    let judge = VerifyOptions { depth: Some(job.stock.depth), ..VerifyOptions::new(0.5 * diameter) };
    let proof = verify(region, &text, &judge).ok().filter(Report::is_proven)?;
    let cutting = |m: &&(pocketry_motion::Point3, &Move)| m.1.feed() == Some(FeedKind::Cut);
    let steps: Vec<_> = plan.program.steps().collect();
    let mut path: Vec<Segment> = steps.iter().filter(cutting).map(|(from, m)| m.plan_view(from.xy())).collect();
    path.extend(plan.groups.iter().map(|g| Segment::line(g.start, g.start)));
    let index = SegmentIndex::new(&path);
    let beyond = |p: Point| index.nearest(p).map_or(f64::INFINITY, |n| n.1) - 0.5 * diameter;
    let vouched = proof.area_error <= AREA * proof.region_area;
    Some(Left {
        depth: samples(region, WALL_STEP * 0.5 * diameter).into_iter().map(beyond).fold(0.0, f64::max),
        area: vouched.then_some(proof.unreachable_area),
    })
}

/// Points along the walls, no farther apart than this, and all over the region.
fn samples(region: &Region, step: f64) -> Vec<Point> {
    let along = |s: &Segment| {
        let steps = (s.length() / step).ceil().max(1.0);
        (0..=steps as u32).map(|k| s.at(f64::from(k) / steps)).collect::<Vec<_>>()
    };
    let share = |k: u32| f64::from(k) / f64::from(SAMPLES);
    let BBox { min, max } = region.bbox();
    let row = |y: f64| (0..=SAMPLES).map(move |k| point(min.x + share(k) * (max.x - min.x), y));
    let grid = (0..=SAMPLES).flat_map(|k| row(min.y + share(k) * (max.y - min.y))).filter(|&p| region.contains(p));
    region.segments().flat_map(along).chain(grid).collect()
}
