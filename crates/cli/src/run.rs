//! The walk from a region to a proven program. No files, no clock: the same for a single job and for a batch.

use crate::console::{duration, figure};
use crate::failure::{Exit, Failure};
use crate::planning::{self, Planned};
use crate::report::{Details, JobReport, NOT_PROVEN, Status};
use crate::settings::{Settings, Setup};
use pocketry_geom::skeleton::Skeleton;
use pocketry_io::import::Drawing;
use pocketry_io::post::{Dialect, LinuxCnc, PostOptions};
use pocketry_motion::{Direction, Figures};
use pocketry_verify::VerifyOptions;

/// A program that may be written.
pub(crate) struct Proven {
    pub(crate) setup: Setup,
    pub(crate) skeleton: Skeleton,
    pub(crate) planned: Planned,
    pub(crate) figures: Figures,
    pub(crate) text: String,
    pub(crate) proof: pocketry_verify::Report,
}

/// Plans, posts and proves. What is found on the way goes into `report`, failure or not.
pub(crate) fn run(drawing: &Drawing, settings: &Settings, report: &mut JobReport) -> Result<Proven, Failure> {
    report.warnings.extend(drawing.warnings.iter().map(ToString::to_string));
    let setup = settings.resolve(drawing.tool_radius, drawing.interval)?;
    report.set_setup(&setup);

    let region = &drawing.region;
    let skeleton = Skeleton::build(region).map_err(|e| Failure::new(Exit::NotProven, "skeleton", e))?;
    let planned = planning::plan(region, &skeleton, &setup)?;
    report.warnings.extend(planned.warnings.iter().cloned());

    let fault = |e: &dyn std::fmt::Display| Failure::new(Exit::NotProven, "program", e);
    planned.program.check(&setup.stock).map_err(|e| fault(&e))?;
    let figures = planned.program.figures(&setup.feeds, &setup.stock);
    report.set_figures(&figures, planned.loops.len(), planned.control_vertices);

    let mut options = PostOptions::for_tool(setup.tool, setup.feeds, setup.unit);
    options.header = header(&report.id, &setup, &planned, &figures);
    let text = LinuxCnc.write(&planned.program, &options).map_err(|e| fault(&e))?;

    let proof = prove(drawing, &setup, &text)?;
    report.set_proof(&proof);
    report.details = Some(details(&setup, &planned, &figures, &proof));
    if !proof.is_proven() {
        let message = "the program is not proven and was not written; please report it with the drawing";
        return Err(Failure::new(Exit::NotProven, NOT_PROVEN, summary(message, &proof)).with_details(places(&proof)));
    }
    report.status = Status::Proven;
    Ok(Proven { setup, skeleton, planned, figures, text, proof })
}

fn prove(drawing: &Drawing, setup: &Setup, text: &str) -> Result<pocketry_verify::Report, Failure> {
    let options = VerifyOptions {
        stock_to_leave: setup.stock_to_leave,
        top: setup.stock.top,
        depth: Some(setup.stock.depth),
        ..VerifyOptions::new(setup.tool.radius())
    };
    let unreadable = |e| Failure::new(Exit::NotProven, NOT_PROVEN, format!("the written program can't be read back: {e}"));
    pocketry_verify::verify(&drawing.region, text, &options).map_err(unreadable)
}

fn summary(message: &str, proof: &pocketry_verify::Report) -> String {
    match proof.complaints().first() {
        Some(first) => format!("{message}: {first}"),
        None => message.to_owned(),
    }
}

/// Complaints and the places of uncut material, for people.
pub(crate) fn places(proof: &pocketry_verify::Report) -> Vec<String> {
    let spot = |s: &pocketry_verify::Spot| {
        format!("uncut at X{:.3} Y{:.3}: {} mm², circle of radius {} mm", s.at.x, s.at.y, figure(s.area), figure(s.radius))
    };
    proof.complaints().into_iter().chain(proof.uncut_spots.iter().map(spot)).collect()
}

fn header(id: &str, setup: &Setup, planned: &Planned, figures: &Figures) -> Vec<String> {
    let cut = match setup.direction {
        Direction::Climb => "climb",
        Direction::Conventional => "conventional",
    };
    vec![
        format!("Pocketry {}: {id}", env!("CARGO_PKG_VERSION")),
        format!("T{}: end mill, diameter {} mm", setup.tool.number, figure(setup.tool.diameter)),
        format!("stock top at Z{} mm, depth {} mm in {} passes", figure(setup.stock.top), figure(setup.stock.depth), planned.passes),
        format!("stepover {} mm, {} mm left on the walls, {cut}", figure(setup.stepover), figure(setup.stock_to_leave)),
        format!("{} loops, cut {:.1} mm, rapid {:.1} mm, {} retracts", planned.loops.len(), figures.cut_length, figures.rapid_length, figures.retracts),
        format!("about {} at the programmed feeds", duration(figures.machine_seconds)),
    ]
}

fn details(setup: &Setup, planned: &Planned, figures: &Figures, proof: &pocketry_verify::Report) -> Details {
    Details {
        tool_diameter: setup.tool.diameter,
        depth: setup.stock.depth,
        passes: planned.passes,
        stock_to_leave: setup.stock_to_leave,
        machine_seconds: figures.machine_seconds,
        moves: figures.moves,
        arcs: figures.arcs,
        region_area: proof.region_area,
        reachable_area: proof.reachable_area,
    }
}
