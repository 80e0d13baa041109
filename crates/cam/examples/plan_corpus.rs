//! Plans whole corpus files and judges the plans by brute force: every path keeps its distance from the walls, loops
//! close and keep their clearance, lifts stay within their budget.
//!
//! ```text
//! cargo run --release -p pocketry-cam --example plan_corpus -- [--only TEXT] [--edges A..B] [--strategy subpockets] [--svg DIR] FILE.jsonl...
//! ```

use pocketry_cam::{EntryKind, Plan, PlanError, PocketJob, plan, plan_subpockets};
use pocketry_geom::distance::Boundary;
use pocketry_geom::repair::{self, RepairOptions};
use pocketry_geom::skeleton::Skeleton;
use pocketry_geom::skeleton::Vertex;
use pocketry_geom::{Arc, Contour, Point, Region, Segment};
use pocketry_motion::Move;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::time::Instant;

#[derive(Deserialize)]
struct Record {
    #[serde(default)]
    id: String,
    #[serde(default)]
    tool_radius: f64,
    #[serde(default)]
    interval: f64,
    loops: Vec<Vec<[f64; 3]>>,
}

struct Options {
    only: String,
    least: usize,
    most: usize,
    subpockets: bool,
    svg: Option<String>,
    files: Vec<String>,
}

fn options() -> Options {
    let mut o =
        Options { only: String::new(), least: 0, most: usize::MAX, subpockets: false, svg: None, files: Vec::new() };
    let mut args = std::env::args().skip(1);
    while let Some(arg) = args.next() {
        match arg.as_str() {
            "--only" => o.only = args.next().unwrap_or_default(),
            "--strategy" => o.subpockets = args.next().as_deref() == Some("subpockets"),
            "--svg" => o.svg = args.next(),
            "--edges" => {
                let range = args.next().unwrap_or_default();
                let (a, b) = range.split_once("..").unwrap_or(("0", ""));
                o.least = a.parse().unwrap_or(0);
                o.most = b.parse().unwrap_or(usize::MAX);
            }
            _ => o.files.push(arg),
        }
    }
    o
}

fn main() {
    let options = options();
    let mut tally: BTreeMap<String, usize> = BTreeMap::new();
    let mut count = |what: &str| *tally.entry(what.into()).or_default() += 1;
    for file in &options.files {
        let text = std::fs::read_to_string(file).expect("readable file");
        for line in text.lines().filter(|l| !l.trim().is_empty()) {
            let Ok(record) = serde_json::from_str::<Record>(line) else {
                count("unreadable line");
                continue;
            };
            let edges: usize = record.loops.iter().map(Vec::len).sum();
            if !record.id.contains(&options.only) || edges < options.least || edges > options.most {
                continue;
            }
            let start = Instant::now();
            let outcome = judge(&record, &options);
            let seconds = start.elapsed().as_secs_f64();
            match outcome {
                Ok(note) => {
                    count(if note.is_empty() { "good" } else { "good, with notes" });
                    if !note.is_empty() || seconds > 5.0 {
                        println!("{} ({edges} edges, {seconds:.2} s): {note}", record.id);
                    }
                }
                Err((kind, what)) => {
                    count(kind);
                    println!("{} ({edges} edges, {seconds:.2} s) FAILED {kind}: {what}", record.id);
                }
            }
        }
    }
    println!("{tally:#?}");
}

type Failure = (&'static str, String);

fn judge(record: &Record, options: &Options) -> Result<String, Failure> {
    let contours = record.loops.iter().map(|l| Contour::from_vertices(l)).collect();
    let healed = repair::build(contours, &RepairOptions::default()).map_err(|e| ("region", e.to_string()))?;
    let skeleton = Skeleton::build(&healed.region).map_err(|e| ("skeleton", e.to_string()))?;
    let region = &healed.region;
    let exact = Boundary::new(region);
    let off = |v: &&Vertex| (exact.distance(v.point) - v.clearance).abs() > 1e-7 * region.bbox().size();
    let wrong = skeleton.vertices().iter().find(off);
    let mut job = PocketJob::for_diameter(2.0 * record.tool_radius);
    // Beyond the radius loops have detours, which keep another distance.
    job.stepover = record.interval.min(record.tool_radius);
    let planner = if options.subpockets { plan_subpockets } else { plan };
    let plan = match planner(&healed.region, &skeleton, &job) {
        Ok(plan) => plan,
        Err(e @ PlanError::DoesNotFit { .. }) => return Err(("does not fit", e.to_string())),
        Err(e) => return Err(("plan", e.to_string())),
    };
    if let Some(folder) = &options.svg {
        let name: String = record.id.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
        std::fs::write(format!("{folder}/{name}.svg"), picture(&healed.region, &plan)).expect("writable folder");
    }
    match check(&healed.region, &plan, &job) {
        Err((_, what)) if wrong.is_some() => Err(("wrong skeleton", format!("{wrong:?}: {what}"))),
        Ok(note) if wrong.is_some() => Ok(format!("{note} in spite of {wrong:?}")),
        outcome => outcome,
    }
}

fn check(region: &Region, plan: &Plan, job: &PocketJob) -> Result<String, Failure> {
    let size = region.bbox().size();
    let first = job.first_distance();
    let slack = 1.5e-4_f64.min(1.5e-4 * first) + 1e-7 * size;
    let walls = Boundary::new(region);
    let mut worst: f64 = 0.0;
    for l in &plan.loops {
        for (k, s) in l.segments.iter().enumerate() {
            if s.end() != l.segments[(k + 1) % l.segments.len()].start() {
                return Err(("open loop", format!("{:?}", s.end())));
            }
            for t in [0.0, 0.37, 0.5, 0.81] {
                let c = walls.distance(s.at(t));
                let error = c - l.distance;
                if l.level > 0 && plan.subpockets.is_none() {
                    worst = worst.max(error.abs() / size);
                }
                // Loops of a subpocket run along its critical edges, too, where the walls are farther away.
                if error < -slack || (l.level > 0 && plan.subpockets.is_none() && error > slack) {
                    return Err(("loop off", format!("clearance {c} instead of {} on {s:?}", l.distance)));
                }
            }
        }
    }
    let mut at: Option<Point> = None;
    let (mut lifts, top) = (0, job.stock.top);
    let mut z = f64::INFINITY;
    for m in &plan.program.moves {
        let to = m.to();
        if let (Some(from), false) = (at, matches!(m, Move::Rapid { .. })) {
            let c = nearest(&walls, from, m);
            if c < first - slack {
                return Err(("move off", format!("clearance {c} instead of {first} on {m:?}")));
            }
        }
        if z < top && to.z > top {
            lifts += 1;
        }
        if matches!(m, Move::Rapid { .. }) && z.min(to.z) < top && at.is_some_and(|p| p != to.xy()) {
            return Err(("rapid below top", format!("{m:?}")));
        }
        at = Some(to.xy());
        z = to.z;
    }
    let (most, of) = plan.subpockets.map_or((plan.control_vertices, "control vertices"), |s| (s, "subpockets"));
    if lifts > most * plan.passes {
        return Err(("lifts", format!("{lifts} lifts in {} passes, {most} {of}", plan.passes)));
    }
    let plunges = plan.groups.iter().filter(|g| g.entry == EntryKind::Plunge).count();
    Ok(if worst > 1e-8 { format!("worst {worst:.1e}, plunges {plunges}") } else { String::new() })
}

/// Distance of a move's path in the plane to the walls.
fn nearest(walls: &Boundary, from: Point, m: &Move) -> f64 {
    let to = m.to().xy();
    match *m {
        Move::Arc { center, ccw, .. } => {
            let radius = 0.5 * (center.distance(from) + center.distance(to));
            walls.distance_to(&Segment::Arc(Arc { start: from, end: to, center, radius, ccw }))
        }
        _ if from == to => walls.distance(to),
        _ => walls.distance_to(&Segment::line(from, to)),
    }
}

fn path(segments: &[Segment]) -> String {
    let mut d = String::new();
    if let Some(s) = segments.first() {
        let _ = write!(d, "M{} {}", s.start().x, -s.start().y);
    }
    for s in segments {
        let mut points = Vec::new();
        s.flatten(0.01, &mut points);
        for p in points.iter().skip(1).chain(std::iter::once(&s.end())) {
            let _ = write!(d, "L{:.4} {:.4}", p.x, -p.y);
        }
    }
    d
}

fn picture(region: &Region, plan: &Plan) -> String {
    let b = region.bbox().inflated(0.02 * region.bbox().size());
    let w = b.size() / 500.0;
    let mut svg = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='1000' height='{}' viewBox='{} {} {} {}'><rect x='{}' y='{}' width='100%' height='100%' fill='white'/>",
        1000.0 * b.height() / b.width(),
        b.min.x,
        -b.max.y,
        b.width(),
        b.height(),
        b.min.x,
        -b.max.y
    );
    let mut draw = |segments: &[Segment], color: &str, width: f64| {
        let _ = write!(svg, "<path d='{}' fill='none' stroke='{color}' stroke-width='{width}'/>", path(segments));
    };
    for c in region.contours() {
        draw(&c.segments, "black", 1.5 * w);
    }
    for l in &plan.loops {
        let hue = (l.group * 47) % 360;
        draw(&l.segments, &format!("hsl({hue},80%,45%)"), if l.degenerate { 2.0 * w } else { 0.7 * w });
    }
    for l in &plan.links {
        let color = match l.kind {
            pocketry_cam::LinkKind::Entry | pocketry_cam::LinkKind::CleanUp => "green",
            pocketry_cam::LinkKind::SideStep => "red",
            pocketry_cam::LinkKind::Medial => "magenta",
            pocketry_cam::LinkKind::Through => "purple",
        };
        draw(&l.segments, color, 1.2 * w);
    }
    for g in &plan.groups {
        let (c, r, color) = match g.entry {
            EntryKind::Helix { center, radius } => (center, radius, "blue"),
            EntryKind::Ramp => (g.start, 2.0 * w, "orange"),
            EntryKind::Plunge => (g.start, 2.0 * w, "red"),
        };
        let _ =
            write!(svg, "<circle cx='{}' cy='{}' r='{r}' fill='none' stroke='{color}' stroke-width='{w}'/>", c.x, -c.y);
    }
    svg + "</svg>"
}
