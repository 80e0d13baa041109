//! The walk from a region to a proven program. No files, no clock: the same for a single job and for a batch.

use crate::console::{duration, figure};
use crate::failure::{Exit, Failure};
use crate::report::{Details, JobReport, NOT_PROVEN, Status};
use crate::settings::{Settings, Setup};
use pocketry_cam::{Plan, PlanError, PocketJob};
use pocketry_geom::skeleton::Skeleton;
use pocketry_io::import::Drawing;
use pocketry_io::post::{Dialect, LinuxCnc, PostError, PostOptions};
use pocketry_motion::{Direction, Figures};
use pocketry_verify::VerifyOptions;

/// Why there is no file.
pub(crate) const NOT_WRITTEN: &str = "the program is not proven and was not written; please report it with the drawing";

/// A program that may be written.
pub(crate) struct Proven {
    pub(crate) setup: Setup,
    pub(crate) skeleton: Skeleton,
    pub(crate) plan: Plan,
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
    let plan = pocketry_cam::plan(region, &skeleton, &setup.job).map_err(|e| plan_failure(&e))?;
    let figures = plan.program.figures(&setup.job.feeds, &setup.job.stock);
    report.set_plan(&plan, &figures);
    let text = write(&plan, &figures, &setup, &report.id)?;

    if let Ok(d) = std::env::var("KEEP") {
        let _ = std::fs::write(format!("{d}/{}.ngc", report.id.replace('/', "_")), &text);
    }
    let proof = prove(drawing, &setup, &text)?;
    report.set_proof(&proof);
    report.details = Some(details(&setup, &plan, &figures, &proof));
    if !proof.is_proven() {
        return Err(
            Failure::new(Exit::NotProven, NOT_PROVEN, summary(NOT_WRITTEN, &proof)).with_details(places(&proof))
        );
    }
    report.status = Status::Proven;
    Ok(Proven { setup, skeleton, plan, figures, text, proof })
}

fn plan_failure(error: &PlanError) -> Failure {
    let (exit, kind) = match error {
        PlanError::DoesNotFit { .. } => (Exit::BadInput, "does-not-fit"),
        PlanError::Job { .. } => (Exit::BadInput, "arguments"),
        PlanError::Skeleton { .. } => (Exit::NotProven, "skeleton"),
        PlanError::Offset(_) => (Exit::NotProven, "offset"),
    };
    Failure::new(exit, kind, error)
}

fn write(plan: &Plan, figures: &Figures, setup: &Setup, id: &str) -> Result<String, Failure> {
    plan.program.check(&setup.job.stock).map_err(|e| Failure::new(Exit::NotProven, "program", e))?;
    let mut options = PostOptions::for_tool(setup.job.tool, setup.job.feeds, setup.unit);
    options.header = header(id, &setup.job, plan, figures);
    LinuxCnc.write(&plan.program, &options).map_err(|e| post_failure(&e))
}

pub(crate) fn post_failure(error: &PostError) -> Failure {
    let (exit, kind) = match error {
        PostError::Fault(_) => (Exit::NotProven, "program"),
        PostError::TooLarge { .. } => (Exit::BadInput, "too-large"),
        PostError::BadSpeed { .. } => (Exit::BadInput, "arguments"),
    };
    Failure::new(exit, kind, error)
}

fn prove(drawing: &Drawing, setup: &Setup, text: &str) -> Result<pocketry_verify::Report, Failure> {
    let options = VerifyOptions {
        stock_to_leave: setup.job.stock_to_leave,
        top: setup.job.stock.top,
        depth: Some(setup.job.stock.depth),
        ..VerifyOptions::new(setup.job.tool.radius())
    };
    let unreadable =
        |e| Failure::new(Exit::NotProven, NOT_PROVEN, format!("the written program can't be read back: {e}"));
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
        format!(
            "uncut at X{:.3} Y{:.3}: {} mm², circle of radius {} mm",
            s.at.x,
            s.at.y,
            figure(s.area),
            figure(s.radius)
        )
    };
    proof.complaints().into_iter().chain(proof.uncut_spots.iter().map(spot)).collect()
}

fn header(id: &str, job: &PocketJob, plan: &Plan, figures: &Figures) -> Vec<String> {
    let cut = match job.direction {
        Direction::Climb => "climb",
        Direction::Conventional => "conventional",
    };
    let (top, depth, passes) = (figure(job.stock.top), figure(job.stock.depth), plan.passes);
    vec![
        format!("Pocketry {}: {id}", env!("CARGO_PKG_VERSION")),
        format!("T{}: end mill, diameter {} mm", job.tool.number, figure(job.tool.diameter)),
        format!("stock top at Z{top} mm, depth {depth} mm in {passes} passes"),
        format!("stepover {} mm, {} mm left on the walls, {cut}", figure(plan.stepover), figure(job.stock_to_leave)),
        format!("{} loops, cut {:.1} mm, rapid {:.1} mm", plan.loops.len(), figures.cut_length, figures.rapid_length),
        format!("{} retracts, about {} at the programmed feeds", figures.retracts, duration(figures.machine_seconds)),
    ]
}

fn details(setup: &Setup, plan: &Plan, figures: &Figures, proof: &pocketry_verify::Report) -> Details {
    Details {
        tool_diameter: setup.job.tool.diameter,
        depth: setup.job.stock.depth,
        passes: plan.passes,
        stock_to_leave: setup.job.stock_to_leave,
        machine_seconds: figures.machine_seconds,
        moves: figures.moves,
        arcs: figures.arcs,
        region_area: proof.region_area,
        reachable_area: proof.reachable_area,
    }
}
