//! `pocketry verify`.

use crate::args::VerifyArgs;
use crate::console::{self, figure};
use crate::drawing;
use crate::failure::{Exit, Failure};
use crate::job::places;
use crate::output::{print, write_file};
use crate::report::NOT_PROVEN;
use pocketry_verify::VerifyOptions;
use serde::Serialize;

#[derive(Serialize)]
struct Judgement<'a> {
    proven: bool,
    complaints: Vec<String>,
    #[serde(flatten)]
    proof: &'a pocketry_verify::Report,
}

pub(crate) fn run(args: &VerifyArgs) -> Result<(), Failure> {
    let drawing = drawing::read(&args.input, &args.drawing)?;
    let bytes = std::fs::read(&args.program).map_err(|e| Failure::read(&args.program, e))?;
    let text = String::from_utf8_lossy(&bytes);
    console::warnings(&drawing.warnings);
    let radius = args.tool.map(|d| 0.5 * d).or(drawing.tool_radius);
    let Some(radius) = radius else {
        return Err(Failure::arguments("no tool: give its diameter in mm with --tool"));
    };
    let options = VerifyOptions { stock_to_leave: args.stock_to_leave, top: args.top, ..VerifyOptions::new(radius) };
    let unreadable = |e| Failure::new(Exit::BadInput, "program", format!("{}: {e}", args.program.display()));
    let proof = pocketry_verify::verify(&drawing.region, &text, &options).map_err(unreadable)?;
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
    print(&format!(
        "proven: deepest gouge {} mm, everything cut that a {} mm tool can reach; it can't reach {} mm² of {} mm²\n",
        figure(proof.gouge_depth()),
        figure(2.0 * radius),
        figure(proof.unreachable_area),
        figure(proof.region_area),
    ))
}
