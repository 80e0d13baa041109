//! The table of tools of `pocketry info`.

use crate::args::Boundary;
use crate::console::{duration, figure};
use crate::failure::{Exit, Failure};
use crate::job;
use crate::report::JobReport;
use crate::settings::Setup;
use pocketry_cam::{Neck, PlanError, PocketJob, Strategy, ToolChooser};
use pocketry_geom::skeleton::Skeleton;
use pocketry_io::import::Drawing;
use pocketry_io::post::OutputUnit;
use serde::Serialize;
use std::fmt::Write;

/// What a tool makes of the drawing with the default settings. Lengths in mm, areas in mm².
#[derive(Serialize)]
pub(crate) struct ToolInfo {
    diameter: f64,
    fits: bool,
    /// Share of the area that it can cut, from 0 to 1.
    reachable: Option<f64>,
    /// How far material stays from what is cut, in corners and necks.
    scallop: Option<f64>,
    /// Where that is.
    scallop_at: Option<[f64; 2]>,
    /// The narrowest place between parts of the pocket that it can't pass.
    neck: Option<Neck>,
    strategy: Option<Strategy>,
    cut_length: Option<f64>,
    machine_seconds: Option<f64>,
    /// Whether its program is proven.
    proven: bool,
}

/// One row a tool.
pub(crate) fn table(drawing: &Drawing, skeleton: &Skeleton, tools: &[f64]) -> Result<Vec<ToolInfo>, Failure> {
    let chooser = ToolChooser::new(skeleton);
    tools.iter().map(|&diameter| row(drawing, skeleton, &chooser, diameter)).collect()
}

fn row(drawing: &Drawing, skeleton: &Skeleton, chooser: &ToolChooser<'_>, diameter: f64) -> Result<ToolInfo, Failure> {
    let (job, radius) = (PocketJob::for_diameter(diameter), 0.5 * diameter);
    let scallop = chooser.scallop(radius).map_err(|e| Failure::new(Exit::NotProven, "offset", e))?;
    let mut info = ToolInfo {
        diameter,
        fits: scallop.is_some(),
        reachable: None,
        scallop: scallop.map(|s| s.size),
        scallop_at: scallop.map(|s| [s.at.x, s.at.y]),
        neck: chooser.neck(radius),
        strategy: None,
        cut_length: None,
        machine_seconds: None,
        proven: false,
    };
    let plans = match pocketry_cam::plans(&drawing.region, skeleton, &job, Strategy::Auto) {
        Err(PlanError::DoesNotFit { .. }) => return Ok(info),
        other => other.map_err(|e| Failure::new(Exit::NotProven, "plan", e))?,
    };
    let setup = Setup {
        job,
        strategy: Strategy::Auto,
        unit: OutputUnit::Millimetre,
        boundary: Boundary::Walls,
        any_stepover: false,
    };
    if let Some((plan, cost)) = plans.into_iter().next() {
        let attempt = job::attempt(drawing, &setup, plan, &mut JobReport::named(String::new()))?;
        info.reachable = Some(attempt.proof.reachable_area / attempt.proof.region_area);
        info.strategy = Some(cost.strategy);
        info.cut_length = Some(cost.cut_length);
        info.machine_seconds = Some(cost.machine_seconds);
        info.proven = attempt.proof.is_proven();
    }
    Ok(info)
}

/// The table for people.
pub(crate) fn write(tools: &[ToolInfo], text: &mut String) {
    let _ = writeln!(text, "tools         diameter  reachable  scallop     path        time");
    for t in tools {
        let share = t.reachable.map_or("fits nowhere".to_owned(), |r| format!("{:7.2} %", 100.0 * r));
        let _ = write!(text, "{:>18} mm  {share}", figure(t.diameter));
        if let (Some(scallop), Some(length), Some(seconds)) = (t.scallop, t.cut_length, t.machine_seconds) {
            let path = format!("{} mm", figure(length));
            let scallop = format!("{} mm", figure(scallop));
            let _ = write!(text, "  {scallop:<10}  {path:<10}  {}", duration(seconds));
            text.push_str(if t.proven { "" } else { "  not proven" });
        }
        text.push('\n');
        if let Some(n) = t.neck {
            let more = if n.count > 1 { format!(" and {} more", n.count - 1) } else { String::new() };
            let _ = writeln!(
                text,
                "                    can't pass the neck at X{:.3} Y{:.3}, {} mm wide{more}",
                n.at.x,
                n.at.y,
                figure(n.width)
            );
        }
    }
}
