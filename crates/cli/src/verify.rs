//! `pocketry verify`.

use crate::args::VerifyArgs;
use crate::console;
use crate::drawing;
use crate::failure::{Exit, Failure};
use crate::job::places;
use crate::output::{print, write_file};
use crate::pocket::said_of_round;
use crate::report::NOT_PROVEN;
use crate::tool_profile::Section;
use pocketry_verify::{ProgramError, Report, VerifyOptions};
use serde::Serialize;

#[derive(Serialize)]
struct Judgement<'a> {
    proven: bool,
    complaints: Vec<String>,
    #[serde(flatten)]
    proof: &'a Report,
}

pub(crate) fn run(args: &VerifyArgs) -> Result<(), Failure> {
    let drawing = drawing::read(&args.input, &args.drawing)?;
    let bytes = std::fs::read(&args.program).map_err(|e| Failure::read(&args.program, e))?;
    let text = String::from_utf8_lossy(&bytes);
    console::warnings(&drawing.warnings);
    if let Some(profile) = &args.tool_profile {
        let section = Section::at(&profile.shape(&args.drawing)?, args.turning, args.depth)?;
        let options = VerifyOptions { top: args.top, depth: args.depth, ..VerifyOptions::new(section.radius) };
        let proof = section.prove(&drawing.region, &text, &options);
        return told(args, proof, |proof| section.said(proof));
    }
    let radius = args.tool.map(|d| 0.5 * d).or(drawing.tool_radius);
    let Some(radius) = radius else {
        return Err(Failure::arguments("no tool: give its diameter in mm with --tool"));
    };
    let options = VerifyOptions { stock_to_leave: args.stock_to_leave, top: args.top, ..VerifyOptions::new(radius) };
    told(args, pocketry_verify::verify(&drawing.region, &text, &options), |proof| said_of_round(proof, 2.0 * radius))
}

/// Says what the proof found, in the report and to people.
fn told(
    args: &VerifyArgs,
    proof: Result<Report, ProgramError>,
    said: impl Fn(&Report) -> String,
) -> Result<(), Failure> {
    let unreadable = |e| Failure::new(Exit::BadInput, "program", format!("{}: {e}", args.program.display()));
    let proof = proof.map_err(unreadable)?;
    if let Some(path) = &args.report {
        let judgement = Judgement { proven: proof.is_proven(), complaints: proof.complaints(), proof: &proof };
        let text = serde_json::to_string_pretty(&judgement).map_err(|e| Failure::write(path, e))?;
        write_file(path, &(text + "\n"))?;
    }
    console::warnings(&proof.notes());
    if !proof.is_proven() {
        let message = format!("{} does not stand up to the drawing", args.program.display());
        return Err(Failure::new(Exit::NotProven, NOT_PROVEN, message).with_details(places(&proof)));
    }
    print(&said(&proof))
}
