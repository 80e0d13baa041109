//! `pocketry study`: what the stepover does to length, time, lifts and uncut material, with and without clean-up
//! (figure 15 of S. C. Park and B. K. Choi, *Uncut free pocketing tool-paths generation*, 2001).

mod chart;

use crate::args::{LoopEngine, StudyArgs};
use crate::console::{self, figure};
use crate::failure::{Exit, Failure};
use crate::output::{Outputs, print};
use crate::settings::Setup;
use crate::{drawing, job};
use pocketry_cam::{PocketJob, Strategy};
use pocketry_geom::Segment;
use pocketry_geom::skeleton::Skeleton;
use pocketry_io::import::Drawing;
use pocketry_io::post::OutputUnit;
use std::fmt::Write;

/// One stepover. Lengths in mm, areas in mm².
#[derive(Clone, Copy, Debug)]
struct Row {
    stepover: f64,
    cleanup: bool,
    length: f64,
    /// Of the loops with their detours: without entries, side-steps and ways between loops.
    loop_length: f64,
    cleanup_length: f64,
    seconds: f64,
    retracts: usize,
    loops: usize,
    uncut: f64,
}

pub(crate) fn run(args: &StudyArgs) -> Result<(), Failure> {
    let mut drawing = drawing::read(&args.input, &args.drawing)?;
    console::warnings(&drawing.warnings);
    let radius = args.tool.map(|d| 0.5 * d).or(drawing.tool_radius);
    let Some(radius) = radius else {
        return Err(Failure::arguments("no tool: give its diameter in mm with --tool"));
    };
    let setup = Setup {
        job: PocketJob::for_diameter(2.0 * radius),
        strategy: Strategy::Contour,
        unit: OutputUnit::Millimetre,
        engine: args.engine,
        boundary: args.boundary,
        any_stepover: false,
        profile: None,
    };
    job::to_walls(&mut drawing, &setup)?;
    let build = || Skeleton::build(&drawing.region).map_err(|e| Failure::new(Exit::NotProven, "skeleton", e));
    let skeleton = (setup.engine == LoopEngine::Voronoi).then(build).transpose()?;
    let mut rows = Vec::new();
    for stepover in args.stepovers.values(setup.job.tool.diameter) {
        for cleanup in [true, false] {
            rows.push(row(&drawing, skeleton.as_ref(), &setup, stepover, cleanup)?);
        }
    }
    let mut outputs = Outputs::default();
    if let Some(path) = &args.csv {
        outputs.add(path, &csv(&rows))?;
    }
    if let Some(path) = &args.plot {
        outputs.add(path, &chart::svg(&title(&drawing, &setup), &rows))?;
    }
    outputs.commit()?;
    print(&table(&rows))
}

fn title(drawing: &Drawing, setup: &Setup) -> String {
    format!("{}, tool {} mm", drawing.id.as_deref().unwrap_or("stepover study"), figure(setup.job.tool.diameter))
}

fn row(
    drawing: &Drawing,
    skeleton: Option<&Skeleton>,
    setup: &Setup,
    stepover: f64,
    cleanup: bool,
) -> Result<Row, Failure> {
    let setup = Setup { job: PocketJob { stepover, cleanup, ..setup.job.clone() }, ..setup.clone() };
    let plan = match skeleton {
        Some(skeleton) => pocketry_cam::plan(&drawing.region, skeleton, &setup.job),
        None => pocketry_cam::plan_pairwise(&drawing.region, &setup.job),
    };
    let plan = plan.map_err(|e| job::plan_failure(&e))?;
    let figures = plan.program.figures(&setup.job.feeds, &setup.job.stock);
    let text = job::write(&plan, &figures, &setup, "study")?;
    let proof = job::prove(drawing, &setup, &text)?;
    let segments = plan.loops.iter().flat_map(|l| &l.segments);
    Ok(Row {
        stepover: plan.stepover,
        cleanup,
        length: figures.cut_length,
        loop_length: plan.passes as f64 * segments.map(Segment::length).sum::<f64>(),
        cleanup_length: plan.passes as f64 * plan.cleanups.iter().fold(0.0, |sum, c| sum + c.length),
        seconds: figures.machine_seconds,
        retracts: figures.retracts,
        loops: plan.loops.len(),
        uncut: proof.uncut_area,
    })
}

const HEADINGS: [&str; 9] = [
    "stepover_mm",
    "cleanup",
    "cut_length_mm",
    "loop_length_mm",
    "cleanup_length_mm",
    "seconds",
    "retracts",
    "loops",
    "uncut_mm2",
];

fn cells(row: &Row) -> [String; 9] {
    [
        figure(row.stepover),
        if row.cleanup { "yes" } else { "no" }.to_owned(),
        format!("{:.1}", row.length),
        format!("{:.1}", row.loop_length),
        format!("{:.1}", row.cleanup_length),
        format!("{:.1}", row.seconds),
        row.retracts.to_string(),
        row.loops.to_string(),
        figure(row.uncut),
    ]
}

fn csv(rows: &[Row]) -> String {
    let lines = rows.iter().map(|r| cells(r).join(",") + "\n");
    std::iter::once(HEADINGS.join(",") + "\n").chain(lines).collect()
}

fn table(rows: &[Row]) -> String {
    let mut out = String::new();
    let mut line = |cells: &[String]| {
        for cell in cells {
            let _ = write!(out, "{cell:>18}");
        }
        out.push('\n');
    };
    line(&HEADINGS.map(str::to_owned));
    for row in rows {
        line(&cells(row));
    }
    out
}
