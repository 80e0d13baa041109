//! `pocketry rough`: from a model to a roughing program, judged in space.

use crate::args::{EngineArg, RoughArgs, StockBox, ToolArg};
use crate::console::{self, counted, duration, figure};
use crate::failure::{Exit, Failure};
use crate::job::NOT_WRITTEN;
use crate::model;
use crate::output::{Outputs, print, write_file};
use crate::rough_picture;
use crate::settings::Settings;
use indicatif::{ProgressBar, ProgressStyle};
use pocketry_cam::PlanError;
use pocketry_cam::rough::{Block, Engine, RoughError, RoughJob, RoughPlan, rough};
use pocketry_geom::mesh::Mesh;
use pocketry_io::post::{Dialect, LinuxCnc, OutputUnit, PostOptions};
use pocketry_motion::{Direction, Figures, Stock};
use pocketry_verify::{RoughOptions, RoughReport, verify_rough};
use serde::Serialize;
use std::path::Path;
use std::time::Instant;

/// What `--report` holds.
#[derive(Serialize)]
struct Report<'a> {
    id: &'a str,
    status: &'static str,
    program: String,
    job: RoughJob,
    facets: usize,
    loops: usize,
    figures: Figures,
    proof: &'a RoughReport,
    seconds: f64,
    plan_seconds: f64,
    proof_seconds: f64,
    warnings: &'a [String],
}

impl Report<'_> {
    fn to_pretty(&self) -> String {
        // Numbers, strings and lists only: this can't fail.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }
}

pub(crate) fn run(args: &RoughArgs) -> Result<(), Failure> {
    let begun = Instant::now();
    let target = args.output.clone().unwrap_or_else(|| args.input.with_extension("ngc"));
    check_targets(args, &target)?;
    let mesh = model::read(&args.input, args.units)?;
    let (job, unit) = job(args, &mesh)?;
    let bar = progress();
    let plan = rough(&mesh, &job, &|done, all| {
        bar.set_length(all as u64);
        bar.set_position(done as u64);
    });
    bar.finish_and_clear();
    let plan = plan.map_err(|e| failure(&e))?;
    console::warnings(&plan.warnings);
    let planned = begun.elapsed().as_secs_f64();

    let name = args.input.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let stock = Stock { top: job.stock.high[2], depth: job.stock.high[2] - job.stock.low[2] };
    let figures = plan.program.figures(&job.feeds, &stock);
    let text = write(&name, &plan, &job, &figures, &stock, unit)?;
    let proof = prove(&mesh, &text, &job)?;
    // Less is what the cutter's shape left between loops.
    if let Some(d) = proof.descent.filter(|d| d.depth > proof.scallop) {
        let (x, y) = (d.at.x, d.at.y);
        let message = format!("line {} goes straight down {:.3} mm into material at X{x:.3} Y{y:.3}", d.line, d.depth);
        console::warnings(&[format!("{message}: the tool must cut at its centre")]);
    }
    let report = Report {
        id: &name,
        status: if proof.is_proven() { "proven" } else { "refused" },
        program: target.display().to_string(),
        job,
        facets: mesh.facets().len(),
        loops: plan.levels.iter().map(|l| l.loops.len()).sum(),
        figures,
        proof: &proof,
        seconds: begun.elapsed().as_secs_f64(),
        plan_seconds: planned,
        proof_seconds: begun.elapsed().as_secs_f64() - planned,
        warnings: &plan.warnings,
    };
    if !proof.is_proven() {
        let complaints = proof.complaints();
        let first = complaints.first().cloned().unwrap_or_default();
        if let Some(path) = &args.report {
            write_file(path, &report.to_pretty())?;
        }
        return Err(
            Failure::new(Exit::NotProven, "not-proven", format!("{NOT_WRITTEN}: {first}")).with_details(complaints)
        );
    }
    let mut outputs = Outputs::default();
    outputs.add(&target, &text)?;
    if let Some(path) = &args.plot {
        for (file, picture) in rough_picture::all(path, &name, &mesh, &plan, &job) {
            outputs.add(&file, &picture)?;
        }
    }
    if let Some(path) = &args.report {
        outputs.add(path, &report.to_pretty())?;
    }
    outputs.commit()?;
    print(&said(&report))
}

/// No two outputs, and no output and the model, may be one file.
fn check_targets(args: &RoughArgs, target: &Path) -> Result<(), Failure> {
    let mut files: Vec<&Path> = vec![&args.input, target];
    files.extend(args.plot.as_deref());
    files.extend(args.report.as_deref());
    crate::output::distinct(&files)
}

fn job(args: &RoughArgs, mesh: &Mesh) -> Result<(RoughJob, OutputUnit), Failure> {
    let settings = Settings::new(Some(ToolArg::Diameter(args.tool)), args.cut.clone().into(), args.machine.clone());
    let setup = settings.resolve(None, None)?;
    let stock = match args.stock {
        Some(StockBox { low, high }) => Block { low, high },
        None => Block::around(mesh, args.margin),
    };
    let usual = RoughJob::new(args.tool, args.cutter, stock);
    let usual_stepover = RoughJob::usual_stepover(args.cutter, args.tool, setup.job.stepdown);
    let job = RoughJob {
        tool: setup.job.tool,
        stepover: args.cut.stepover.map_or(usual_stepover, |_| setup.job.stepover),
        stepdown: setup.job.stepdown,
        stock_to_leave: setup.job.stock_to_leave,
        direction: setup.job.direction,
        heights: setup.job.heights,
        feeds: setup.job.feeds,
        cell: args.cell.unwrap_or(usual.cell),
        engine: match args.engine {
            EngineArg::Voronoi => Engine::Voronoi,
            EngineArg::Pairwise => Engine::Pairwise,
            EngineArg::Bisector => Engine::Bisector,
        },
        ..usual
    };
    Ok((job, setup.unit))
}

fn progress() -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} levels, {elapsed}");
    ProgressBar::new(1).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

fn failure(error: &RoughError) -> Failure {
    let (exit, kind) = match error {
        RoughError::Plan(PlanError::Job { .. }) | RoughError::Cutter { .. } => (Exit::BadInput, "arguments"),
        RoughError::NothingToCut { .. } => (Exit::BadInput, "does-not-fit"),
        RoughError::Plan(_) => (Exit::NotProven, "plan"),
        RoughError::Region { .. } => (Exit::NotProven, "region"),
        RoughError::Skeleton { .. } => (Exit::NotProven, "skeleton"),
        RoughError::Offset { .. } => (Exit::NotProven, "offset"),
    };
    Failure::new(exit, kind, error)
}

fn write(
    name: &str,
    plan: &RoughPlan,
    job: &RoughJob,
    figures: &Figures,
    stock: &Stock,
    unit: OutputUnit,
) -> Result<String, Failure> {
    plan.program.check(stock).map_err(|e| Failure::new(Exit::NotProven, "program", e))?;
    let mut options = PostOptions::for_tool(job.tool, job.feeds, unit);
    let cut = if job.direction == Direction::Climb { "climb" } else { "conventional" };
    let [low, high] = [job.stock.low, job.stock.high].map(|c| c.map(figure).join(" "));
    options.header = vec![
        format!("Pocketry {}: roughing of {name}", env!("CARGO_PKG_VERSION")),
        format!("T{}: {}, diameter {} mm", job.tool.number, job.cutter, figure(job.tool.diameter)),
        format!("stock from {low} to {high} mm, {}", counted(plan.levels.len(), "level")),
        format!("stepover {} mm, {} mm left on the model, {cut}", figure(plan.stepover), figure(job.stock_to_leave)),
        format!(
            "cut {:.0} mm, {}, about {}",
            figures.cut_length,
            counted(figures.retracts, "retract"),
            duration(figures.machine_seconds)
        ),
    ];
    LinuxCnc.write(&plan.program, &options).map_err(|e| crate::job::post_failure(&e))
}

fn prove(mesh: &Mesh, text: &str, job: &RoughJob) -> Result<RoughReport, Failure> {
    let options = RoughOptions {
        stock_to_leave: job.stock_to_leave,
        levels: job.levels(),
        stepover: job.stepover,
        ..RoughOptions::new(job.cutter, job.tool.radius(), job.stock.low, job.stock.high)
    };
    let options = RoughOptions { detail: options.detail.max(job.cell), ..options };
    verify_rough(mesh, text, &options).map_err(|e| {
        Failure::new(Exit::NotProven, "not-proven", format!("the written program can't be read back: {e}"))
    })
}

fn said(report: &Report<'_>) -> String {
    let (figures, proof) = (&report.figures, report.proof);
    let cut = proof.levels.iter().filter(|l| l.leftover.is_some()).count();
    format!(
        "{}: {}, {}, {:.0} mm of cutting, {}, about {}\n\
         proven: deepest gouge {} mm ({} mm into the stock to leave), highest leftover {} mm over what the tool can reach\n",
        report.program,
        counted(cut, "level"),
        counted(report.loops, "loop"),
        figures.cut_length,
        counted(figures.retracts, "retract"),
        duration(figures.machine_seconds),
        figure(proof.gouge_depth()),
        figure(proof.into_stock()),
        figure(proof.leftover_height()),
    )
}
