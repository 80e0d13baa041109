//! The walk from a region to a proven program. No files, no clock: the same for a single job and for a batch.

use crate::args::{Boundary, LoopEngine};
use crate::console::{duration, figure};
use crate::failure::{Exit, Failure};
use crate::report::{Details, JobReport, NOT_PROVEN, Status};
use crate::settings::{Settings, Setup};
use crate::toolbox;
use pocketry_cam::{Choice, Plan, PlanError, PocketJob, StrategyCost, choose};
use pocketry_geom::Region;
use pocketry_geom::offset::{VoronoiEngine, outward};
use pocketry_geom::repair::{RepairOptions, build};
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
    /// Where one was needed.
    pub(crate) skeleton: Option<Skeleton>,
    pub(crate) plan: Plan,
    pub(crate) figures: Figures,
    pub(crate) text: String,
    pub(crate) proof: pocketry_verify::Report,
}

/// Area curves that already are tool paths become the walls that such paths keep clear of: the region grows by the tool's radius
/// and what is left on walls. (Where that closes a gap, the tool would not fit between the two sides of a wall.)
pub(crate) fn to_walls(drawing: &mut Drawing, setup: &Setup) -> Result<(), Failure> {
    if setup.boundary == Boundary::Walls {
        return Ok(());
    }
    let failed = |e: &dyn std::fmt::Display| Failure::new(Exit::NotProven, "offset", e);
    let contours = outward(&VoronoiEngine, &drawing.region, setup.job.first_distance()).map_err(|e| failed(&e))?;
    drawing.region = build(contours, &RepairOptions::default()).map_err(|e| failed(&e))?.region;
    Ok(())
}

/// Plans, posts and proves. What is found on the way goes into `report`, failure or not.
pub(crate) fn run(drawing: &mut Drawing, settings: &Settings, report: &mut JobReport) -> Result<Proven, Failure> {
    report.warnings.extend(drawing.warnings.iter().map(ToString::to_string));
    let typed =
        settings.choice().is_none().then(|| settings.resolve(drawing.tool_radius, drawing.interval)).transpose()?;
    if let Some(setup) = &typed {
        report.set_setup(setup);
        to_walls(drawing, setup)?;
    }

    let region = &drawing.region;
    let mut skeleton = None;
    let setup = if let Some(setup) = typed {
        setup
    } else {
        let setup = chosen(skeleton.insert(skeleton_of(region)?), settings)?;
        report.set_setup(&setup);
        setup
    };
    let plans = planned(region, &mut skeleton, &setup)?;
    report.strategies = plans.iter().map(|p| p.1).collect();
    // The best one, unless only the other can be proven.
    let mut first: Option<(Attempt, JobReport)> = None;
    for (plan, _) in plans {
        let mut own = report.clone();
        let attempt = attempt(drawing, &setup, plan, &mut own)?;
        if attempt.proof.is_proven() {
            own.status = Status::Proven;
            *report = own;
            let Attempt { plan, figures, text, proof } = attempt;
            return Ok(Proven { setup, skeleton, plan, figures, text, proof });
        }
        first.get_or_insert((attempt, own));
    }
    Err(match first {
        Some((attempt, own)) => {
            *report = own;
            let why = summary(NOT_WRITTEN, &attempt.proof);
            Failure::new(Exit::NotProven, NOT_PROVEN, why).with_details(places(&attempt.proof))
        }
        None => Failure::new(Exit::NotProven, NOT_PROVEN, NOT_WRITTEN),
    })
}

/// The plans, the best first; the skeleton is built where one is needed.
fn planned(
    region: &Region,
    skeleton: &mut Option<Skeleton>,
    setup: &Setup,
) -> Result<Vec<(Plan, StrategyCost)>, Failure> {
    if let Some(section) = &setup.profile {
        let plan = section.plan(region, &setup.job).map_err(|e| plan_failure(&e))?;
        let cost = StrategyCost::of(&plan, &setup.job);
        return Ok(vec![(plan, cost)]);
    }
    if setup.engine == LoopEngine::Pairwise {
        return pocketry_cam::pairwise_plans(region, &setup.job, setup.any_stepover).map_err(|e| plan_failure(&e));
    }
    let skeleton = match skeleton {
        Some(built) => built,
        None => skeleton.insert(skeleton_of(region)?),
    };
    let planner = if setup.any_stepover { pocketry_cam::quickest_plans } else { pocketry_cam::plans };
    planner(region, skeleton, &setup.job, setup.strategy).map_err(|e| plan_failure(&e))
}

fn skeleton_of(region: &Region) -> Result<Skeleton, Failure> {
    Skeleton::build(region).map_err(|e| Failure::new(Exit::NotProven, "skeleton", e))
}

/// The setup for the largest of the tools at hand whose scallops are small enough.
fn chosen(skeleton: &Skeleton, settings: &Settings) -> Result<Setup, Failure> {
    let (tools, scallop) = settings.choice().unwrap_or_default();
    if settings.cut.boundary == Boundary::Cl {
        return Err(Failure::arguments("--tool auto looks at walls; with --boundary cl name the tool"));
    }
    let usual = settings.resolve_for(tools.iter().copied().fold(f64::INFINITY, f64::min), None)?;
    let choice =
        choose(skeleton, tools, scallop, &usual.job).map_err(|e| Failure::new(Exit::NotProven, "offset", e))?;
    match choice {
        Choice::Tool(diameter) => settings.resolve_for(diameter, None),
        Choice::None(refused) => Err(toolbox::none(&refused, scallop)),
    }
}

/// A plan with its program and the judgement on it.
pub(crate) struct Attempt {
    pub(crate) plan: Plan,
    figures: Figures,
    text: String,
    pub(crate) proof: pocketry_verify::Report,
}

/// Posts and proves a plan.
pub(crate) fn attempt(
    drawing: &Drawing,
    setup: &Setup,
    plan: Plan,
    report: &mut JobReport,
) -> Result<Attempt, Failure> {
    let figures = plan.program.figures(&setup.job.feeds, &setup.job.stock);
    report.set_plan(&plan, &figures);
    let text = write(&plan, &figures, setup, &report.id)?;
    let proof = prove(drawing, setup, &text)?;
    report.set_proof(&proof);
    report.details = Some(details(setup, &plan, &figures, &proof));
    Ok(Attempt { plan, figures, text, proof })
}

pub(crate) fn plan_failure(error: &PlanError) -> Failure {
    let (exit, kind) = match error {
        PlanError::DoesNotFit { .. } | PlanError::ProfileDoesNotFit { .. } => (Exit::BadInput, "does-not-fit"),
        PlanError::Job { .. } | PlanError::Profile { .. } => (Exit::BadInput, "arguments"),
        PlanError::Skeleton { .. } => (Exit::NotProven, "skeleton"),
        PlanError::Offset(_) | PlanError::Morphology(_) => (Exit::NotProven, "offset"),
    };
    Failure::new(exit, kind, error)
}

pub(crate) fn write(plan: &Plan, figures: &Figures, setup: &Setup, id: &str) -> Result<String, Failure> {
    plan.program.check(&setup.job.stock).map_err(|e| Failure::new(Exit::NotProven, "program", e))?;
    let mut options = PostOptions::for_tool(setup.job.tool, setup.job.feeds, setup.unit);
    options.header = header(id, setup, plan, figures);
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

pub(crate) fn prove(drawing: &Drawing, setup: &Setup, text: &str) -> Result<pocketry_verify::Report, Failure> {
    let options = VerifyOptions {
        stock_to_leave: setup.job.stock_to_leave,
        top: setup.job.stock.top,
        depth: Some(setup.job.stock.depth),
        ..VerifyOptions::new(setup.job.tool.radius())
    };
    let unreadable =
        |e| Failure::new(Exit::NotProven, NOT_PROVEN, format!("the written program can't be read back: {e}"));
    match &setup.profile {
        Some(section) => section.prove(&drawing.region, text, &options),
        None => pocketry_verify::verify(&drawing.region, text, &options),
    }
    .map_err(unreadable)
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

fn header(id: &str, setup: &Setup, plan: &Plan, figures: &Figures) -> Vec<String> {
    let job: &PocketJob = &setup.job;
    let tool = match &setup.profile {
        Some(section) => {
            let turns = if section.turns { "turns with the walls (C)" } else { "does not turn" };
            format!("T{}: {turns}, {}", job.tool.number, section.shape)
        }
        None => format!("T{}: end mill, diameter {} mm", job.tool.number, figure(job.tool.diameter)),
    };
    let cut = match job.direction {
        Direction::Climb => "climb",
        Direction::Conventional => "conventional",
    };
    let (top, depth, passes) = (figure(job.stock.top), figure(job.stock.depth), plan.passes);
    vec![
        format!("Pocketry {}: {id}", env!("CARGO_PKG_VERSION")),
        tool,
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
