//! Pockets whole corpus files with a tool that is not round, proves the written programs, and counts.
//!
//! ```text
//! cargo run --release -p pocketry --example profile_corpus -- [--profile rect|rounded] [--every N] [--only TEXT] [--write FOLDER] FILE.jsonl...
//! ```
//!
//! With `--write`, pictures and programs of what is not proven go into a folder.
//!
//! The profile is scaled with the tool radius `r` that a record names: a rectangle of 3 r by 1.5 r, sharp or with corners of 0.4 r.

use pocketry_cam::{Plan, PlanError, PocketJob, inscribed_circle, plan_profile};
use pocketry_geom::repair::{RepairOptions, build};
use pocketry_geom::{Contour, Region, ToolProfile};
use pocketry_io::plot::{Look, Picture};
use pocketry_io::post::{Dialect, LinuxCnc, OutputUnit, PostOptions};
use pocketry_verify::{VerifyOptions, verify_profile};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

#[derive(Deserialize)]
struct Record {
    #[serde(default)]
    id: String,
    tool_radius: f64,
    loops: Vec<Vec<[f64; 3]>>,
}

struct Options {
    rounded: bool,
    every: usize,
    only: String,
    write: Option<PathBuf>,
    files: Vec<String>,
}

fn options() -> Options {
    let mut o = Options { rounded: false, every: 1, only: String::new(), write: None, files: Vec::new() };
    let mut args = std::env::args().skip(1);
    while let Some(arg) = args.next() {
        match arg.as_str() {
            "--profile" => o.rounded = args.next().as_deref() == Some("rounded"),
            "--every" => o.every = args.next().and_then(|n| n.parse().ok()).unwrap_or(1),
            "--only" => o.only = args.next().unwrap_or_default(),
            "--write" => o.write = args.next().map(PathBuf::from),
            _ => o.files.push(arg),
        }
    }
    o
}

fn main() {
    let options = options();
    for file in &options.files {
        let text = std::fs::read_to_string(file).expect("a readable file");
        let mut tally: BTreeMap<String, usize> = BTreeMap::new();
        let (mut planning, mut proving) = (Duration::ZERO, Duration::ZERO);
        for line in text.lines().step_by(options.every) {
            let record: Record = serde_json::from_str(line).expect("a region");
            if !record.id.contains(&options.only) {
                continue;
            }
            let outcome = catch_unwind(|| one(&record, &options));
            let word = match outcome {
                Ok(done) => {
                    planning += done.planning;
                    proving += done.proving;
                    if done.planning + done.proving > Duration::from_secs(5) {
                        println!("slow: {} {:.1?} {:.1?}", record.id, done.planning, done.proving);
                    }
                    done.word
                }
                Err(_) => "PANIC".to_owned(),
            };
            let (kind, detail) = word.split_once(": ").unwrap_or((&word, ""));
            if kind != "proven" && kind != "does not fit" {
                println!("{}: {kind}: {detail}", record.id);
            }
            *tally.entry(kind.to_owned()).or_default() += 1;
        }
        println!("{file}: {tally:?}, planning {planning:.1?}, proving {proving:.1?}");
    }
}

struct Done {
    word: String,
    planning: Duration,
    proving: Duration,
}

fn one(record: &Record, options: &Options) -> Done {
    let mut done = Done { word: String::new(), planning: Duration::ZERO, proving: Duration::ZERO };
    let loops = record.loops.iter().map(|l| Contour::from_vertices(l)).collect();
    let region = match build(loops, &RepairOptions::default()) {
        Ok(healed) => healed.region,
        Err(e) => return Done { word: format!("bad region: {e}"), ..done },
    };
    let r = record.tool_radius;
    let profile = ToolProfile::rounded(3.0 * r, 1.5 * r, if options.rounded { 0.4 * r } else { 0.0 });
    let begun = Instant::now();
    let planned = planned(&region, &profile);
    done.planning = begun.elapsed();
    let (plan, text) = match planned {
        Ok(planned) => planned,
        Err(word) => return Done { word, ..done },
    };
    let begun = Instant::now();
    let report = verify_profile(&region, &text, profile.contour(), &VerifyOptions::new(r));
    done.proving = begun.elapsed();
    done.word = match report {
        Ok(report) if report.is_proven() => "proven".to_owned(),
        Ok(report) => format!("not proven: {}", report.complaints().join("; ")),
        Err(e) => format!("unreadable: {e}"),
    };
    if let Some(folder) = options.write.as_ref().filter(|_| done.word != "proven") {
        write(folder, record, &region, &plan, &text).expect("a writable folder");
    }
    done
}

/// The program and its picture.
fn write(folder: &Path, record: &Record, region: &Region, plan: &Plan, text: &str) -> std::io::Result<()> {
    let mut picture = Picture::of(region, &record.id);
    let last = plan.loops.len().saturating_sub(1).max(1) as f64;
    for (k, cut) in plan.loops.iter().enumerate() {
        picture.add("loop", Look::Loop(k as f64 / last), vec![cut.segments.clone()]);
    }
    picture.add("link", Look::Link, plan.links.iter().map(|l| l.segments.clone()).collect());
    let name = record.id.replace('/', "-");
    std::fs::write(folder.join(format!("{name}.svg")), picture.to_svg())?;
    std::fs::write(folder.join(format!("{name}.ngc")), text)
}

fn planned(region: &Region, profile: &ToolProfile) -> Result<(Plan, String), String> {
    let (_, radius) = inscribed_circle(profile).map_err(|e| format!("profile: {e}"))?;
    let job = PocketJob::for_diameter(2.0 * radius);
    let plan = plan_profile(region, profile, &job).map_err(|e| match e {
        PlanError::ProfileDoesNotFit { .. } => "does not fit".to_owned(),
        PlanError::Morphology(e) => format!("outline: {e}"),
        other => format!("plan: {other}"),
    })?;
    plan.program.check(&job.stock).map_err(|e| format!("program: {e}"))?;
    let options = PostOptions::for_tool(job.tool, job.feeds, OutputUnit::Millimetre);
    let text = LinuxCnc.write(&plan.program, &options).map_err(|e| format!("post: {e}"))?;
    Ok((plan, text))
}
