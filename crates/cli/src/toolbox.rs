//! The table of tools of `pocketry info`, and why none of them will do.

use crate::console::{duration, figure};
use crate::failure::{Exit, Failure};
use pocketry_cam::{Narrow, PlanError, PocketJob, Strategy, StrategyCost, ToolFit};
use pocketry_geom::Point;
use pocketry_geom::skeleton::Skeleton;
use pocketry_io::import::Drawing;
use rayon::prelude::*;
use serde::Serialize;
use std::fmt::Write;

/// What a tool makes of the drawing at the usual stepover. Lengths in mm, areas in mm².
#[derive(Serialize)]
pub(crate) struct ToolInfo {
    diameter: f64,
    fits: bool,
    /// Share of the area that it can cut, from 0 to 1.
    reachable: f64,
    /// Area that it leaves in corners and necks.
    leftover: f64,
    /// How far material stays from what is cut.
    scallop: Option<f64>,
    /// Where that is.
    scallop_at: Option<[f64; 2]>,
    /// The narrowest place between parts of the pocket that it can't pass.
    neck: Option<Narrow>,
    /// The widest place of the pockets that it doesn't fit into.
    closed: Option<Narrow>,
    strategy: Option<Strategy>,
    cut_length: Option<f64>,
    /// At the programmed feeds.
    machine_seconds: Option<f64>,
}

/// One row a tool. What it leaves needs no tool path; only length and time do. Programs are proven when they are written.
pub(crate) fn table(drawing: &Drawing, skeleton: &Skeleton, tools: &[f64]) -> Result<Vec<ToolInfo>, Failure> {
    tools.par_iter().map(|&diameter| row(drawing, skeleton, diameter)).collect()
}

fn row(drawing: &Drawing, skeleton: &Skeleton, diameter: f64) -> Result<ToolInfo, Failure> {
    let job = PocketJob::for_diameter(diameter);
    let fit =
        ToolFit::new(skeleton, diameter, job.stock_to_leave).map_err(|e| Failure::new(Exit::NotProven, "offset", e))?;
    let cost = cost(drawing, skeleton, &job)?;
    Ok(ToolInfo {
        diameter,
        fits: fit.fits,
        reachable: if fit.fits { (1.0 - fit.left / drawing.region.area()).clamp(0.0, 1.0) } else { 0.0 },
        leftover: fit.left,
        scallop: fit.fits.then(|| fit.scallop.map_or(0.0, |s| s.size)),
        scallop_at: fit.scallop.map(|s| [s.at.x, s.at.y]),
        neck: fit.neck,
        closed: fit.closed,
        strategy: cost.map(|c| c.strategy),
        cut_length: cost.map(|c| c.cut_length),
        machine_seconds: cost.map(|c| c.machine_seconds),
    })
}

/// Length and time of the better strategy's path; none where the tool fits nowhere.
fn cost(drawing: &Drawing, skeleton: &Skeleton, job: &PocketJob) -> Result<Option<StrategyCost>, Failure> {
    match pocketry_cam::plans(&drawing.region, skeleton, job, Strategy::Auto) {
        Ok(plans) => Ok(plans.first().map(|p| p.1)),
        Err(PlanError::DoesNotFit { .. }) => Ok(None),
        Err(other) => Err(Failure::new(Exit::NotProven, "plan", other)),
    }
}

/// The table for people.
pub(crate) fn write(tools: &[ToolInfo], text: &mut String) {
    let _ = writeln!(text, "tools         diameter  reachable  left over     scallop     path          time");
    for t in tools {
        let _ = write!(text, "{:>18} mm  ", figure(t.diameter));
        if let (Some(scallop), Some(length), Some(seconds)) = (t.scallop, t.cut_length, t.machine_seconds) {
            let [left, scallop, path] = [(t.leftover, "mm²"), (scallop, "mm"), (length, "mm")]
                .map(|(value, unit)| format!("{} {unit}", figure(value)));
            let _ = write!(text, "{:7.2} %  {left:<12}  {scallop:<10}  {path:<12}  ", 100.0 * t.reachable);
            let _ = writeln!(text, "{}", duration(seconds));
        } else {
            text.push_str("fits nowhere\n");
        }
        if let Some(n) = t.neck {
            let _ = writeln!(text, "{:20}{}", "", cannot_pass(&n));
        }
        if let Some(c) = t.closed.filter(|_| t.fits) {
            let _ = writeln!(text, "{:20}{}", "", does_not_enter(&c));
        }
    }
}

/// The failure where none of the tools leaves so little, with what each leaves.
pub(crate) fn none(refused: &[ToolFit], scallop: f64) -> Failure {
    let message = format!(
        "none of the tools leaves scallops of at most {} mm; take a smaller tool, or allow more with --scallop",
        figure(scallop)
    );
    let details = refused.iter().map(|fit| format!("{} mm: {}", figure(fit.diameter), why(fit))).collect();
    Failure::new(Exit::BadInput, "no-tool", message).with_details(details)
}

/// Why a tool was not chosen.
fn why(fit: &ToolFit) -> String {
    let mut reasons = Vec::new();
    if let Some(c) = fit.closed {
        reasons.push(if fit.fits {
            does_not_enter(&c)
        } else {
            format!("fits nowhere: the widest place, {}, is {} mm wide", at(c.at), figure(c.width))
        });
    }
    if let Some(s) = fit.scallop {
        reasons.push(format!("leaves {} mm {}", figure(s.size), at(s.at)));
    }
    reasons.extend(fit.neck.as_ref().map(cannot_pass));
    reasons.join("; ")
}

fn cannot_pass(n: &Narrow) -> String {
    format!("can't pass the neck {}, {} mm wide{}", at(n.at), figure(n.width), and_more(n.count))
}

fn does_not_enter(c: &Narrow) -> String {
    format!("fits nowhere in the pocket {}, {} mm wide there at most{}", at(c.at), figure(c.width), and_more(c.count))
}

fn at(p: Point) -> String {
    format!("at X{:.3} Y{:.3}", p.x, p.y)
}

fn and_more(count: usize) -> String {
    if count > 1 { format!(" (and {} more)", count - 1) } else { String::new() }
}
