//! `pocketry pocket` for a single drawing.

use crate::args::PocketArgs;
use crate::console::{self, duration, figure};
use crate::failure::Failure;
use crate::job::{self, Proven};
use crate::output::{Outputs, distinct, print};
use crate::report::JobReport;
use crate::settings::Settings;
use crate::{drawing, picture};
use std::path::Path;
use std::time::Instant;

pub(crate) fn run(args: &PocketArgs) -> Result<(), Failure> {
    if args.out_dir.is_some() {
        return Err(Failure::arguments("--out-dir is for batches (.jsonl); use -o for a single drawing"));
    }
    let begun = Instant::now();
    let target = args.output.clone().unwrap_or_else(|| args.input.with_extension("ngc"));
    check_targets(args, &target)?;
    let mut drawing = drawing::read(&args.input, &args.drawing)?;
    let name =
        drawing.id.clone().unwrap_or_else(|| args.input.file_name().unwrap_or_default().to_string_lossy().into_owned());
    let mut report = JobReport::named(name);
    let profile = args.tool_profile.as_ref().map(|p| p.shape(&args.drawing)).transpose()?;
    let settings = Settings::new(args.tool, args.cut.clone(), args.machine.clone()).with_profile(profile, args.turning);
    let result = job::run(&mut drawing, &settings, &mut report);
    console::warnings(&report.warnings);
    let proven = result?;

    report.program = Some(target.display().to_string());
    report.seconds = begun.elapsed().as_secs_f64();
    let mut outputs = Outputs::default();
    outputs.add(&target, &proven.text)?;
    if let Some(path) = &args.plot {
        let picture = picture::of_job(&report.id, &drawing.region, &proven, args.plot_skeleton);
        outputs.add(path, &picture.to_svg())?;
    }
    if let Some(path) = &args.report {
        outputs.add(path, &report.to_pretty())?;
    }
    outputs.commit()?;
    print(&said(&target, &proven))
}

/// No two outputs, and no output and the drawing, may be one file.
fn check_targets(args: &PocketArgs, target: &Path) -> Result<(), Failure> {
    let mut files: Vec<&Path> = vec![&args.input, target];
    files.extend(args.plot.as_deref());
    files.extend(args.report.as_deref());
    distinct(&files)
}

fn said(target: &Path, proven: &Proven) -> String {
    let (figures, proof) = (&proven.figures, &proven.proof);
    format!(
        "{}: {} loops, {} mm of cutting, {} retracts, about {}\n{}",
        target.display(),
        proven.plan.loops.len(),
        figure(figures.cut_length),
        figures.retracts,
        duration(figures.machine_seconds),
        match &proven.setup.profile {
            Some(section) => section.said(proof),
            None => said_of_round(proof, proven.setup.job.tool.diameter),
        },
    )
}

/// What the proof for a round tool says, for people.
pub(crate) fn said_of_round(proof: &pocketry_verify::Report, diameter: f64) -> String {
    format!(
        "proven: deepest gouge {} mm, everything cut that a {} mm tool can reach{}\n",
        figure(proof.gouge_depth()),
        figure(diameter),
        out_of_reach(proof),
    )
}

/// What the tool can't reach, where that is known.
fn out_of_reach(proof: &pocketry_verify::Report) -> String {
    let Some(area) = proof.known_unreachable_area() else { return String::new() };
    let share = if proof.region_area > 0.0 { 100.0 * area / proof.region_area } else { 0.0 };
    format!("; it can't reach {} mm² ({share:.1} %)", figure(area))
}
