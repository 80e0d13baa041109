//! What is told to other programs about a job. The names and their meaning stay.

use crate::failure::{ErrorReport, Failure};
use crate::settings::Setup;
use pocketry_cam::{Plan, Strategy, StrategyCost};
use pocketry_motion::Figures;
use serde::Serialize;

/// How a job ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Status {
    /// Written and proven.
    Proven,
    /// Planned, but the proof failed: nothing was written.
    Refused,
    /// It did not come to a program.
    Failed,
}

/// One job: a line of a batch's report, or the report of a single job.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct JobReport {
    pub(crate) id: String,
    pub(crate) status: Status,
    pub(crate) error: Option<ErrorReport>,
    /// The program's file.
    pub(crate) program: Option<String>,
    /// mm.
    pub(crate) tool_radius: Option<f64>,
    /// mm.
    pub(crate) stepover: Option<f64>,
    /// mm.
    pub(crate) cut_length: Option<f64>,
    /// mm.
    pub(crate) rapid_length: Option<f64>,
    pub(crate) retracts: Option<usize>,
    pub(crate) loops: Option<usize>,
    pub(crate) control_vertices: Option<usize>,
    /// The strategy that was taken.
    pub(crate) strategy: Option<Strategy>,
    /// What each strategy that was planned costs, the best first.
    pub(crate) strategies: Vec<StrategyCost>,
    /// Subpockets, where they were looked for and taken.
    pub(crate) subpockets: Option<usize>,
    /// Depth passes.
    pub(crate) depth_passes: Option<usize>,
    /// How deep the tool enters a wall at worst, mm.
    pub(crate) gouge: Option<f64>,
    /// mm².
    pub(crate) uncut_area: Option<f64>,
    /// mm², as the proof finds it.
    pub(crate) unreachable_area: Option<f64>,
    /// How long the job took to compute; the only field that differs from run to run.
    pub(crate) seconds: f64,
    pub(crate) warnings: Vec<String>,
    #[serde(flatten)]
    pub(crate) details: Option<Details>,
}

/// What the report of a single job holds besides. Lengths in mm, areas in mm².
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Details {
    pub(crate) tool_diameter: f64,
    pub(crate) depth: f64,
    pub(crate) passes: usize,
    pub(crate) stock_to_leave: f64,
    pub(crate) machine_seconds: f64,
    pub(crate) moves: usize,
    pub(crate) arcs: usize,
    pub(crate) region_area: f64,
    pub(crate) reachable_area: f64,
}

impl JobReport {
    /// A report with nothing but a name and a time in it.
    pub(crate) fn named(id: String) -> Self {
        Self {
            id,
            status: Status::Failed,
            error: None,
            program: None,
            tool_radius: None,
            stepover: None,
            cut_length: None,
            rapid_length: None,
            retracts: None,
            loops: None,
            control_vertices: None,
            strategy: None,
            strategies: Vec::new(),
            subpockets: None,
            depth_passes: None,
            gouge: None,
            uncut_area: None,
            unreachable_area: None,
            seconds: 0.0,
            warnings: Vec::new(),
            details: None,
        }
    }

    pub(crate) fn set_setup(&mut self, setup: &Setup) {
        self.tool_radius = Some(setup.job.tool.radius());
        self.stepover = Some(setup.job.stepover);
    }

    pub(crate) fn set_plan(&mut self, plan: &Plan, figures: &Figures) {
        self.stepover = Some(plan.stepover);
        self.warnings.extend(plan.warnings.iter().map(ToString::to_string));
        self.cut_length = Some(figures.cut_length);
        self.rapid_length = Some(figures.rapid_length);
        self.retracts = Some(figures.retracts);
        self.loops = Some(plan.loops.len());
        self.control_vertices = Some(plan.control_vertices);
        self.strategy = Some(plan.strategy);
        self.subpockets = plan.subpockets;
        self.depth_passes = Some(plan.passes);
    }

    pub(crate) fn set_proof(&mut self, proof: &pocketry_verify::Report) {
        self.gouge = Some(proof.gouge_depth());
        self.uncut_area = Some(proof.uncut_area);
        self.unreachable_area = proof.known_unreachable_area();
    }

    pub(crate) fn fail(&mut self, failure: &Failure) {
        self.status = if failure.kind == NOT_PROVEN { Status::Refused } else { Status::Failed };
        self.error = Some(failure.report());
        self.program = None;
    }

    /// One line of JSON.
    pub(crate) fn to_line(&self) -> String {
        // Numbers, strings and lists only: this can't fail.
        let mut line = serde_json::to_string(self).unwrap_or_default();
        line.push('\n');
        line
    }

    /// JSON for reading.
    pub(crate) fn to_pretty(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).unwrap_or_default();
        text.push('\n');
        text
    }
}

/// Kind of the failure that makes a job *refused*.
pub(crate) const NOT_PROVEN: &str = "not-proven";
