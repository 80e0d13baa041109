//! What was typed becomes what is to be done: defaults, percentages and limits resolved, one [`Setup`] a region.

use crate::args::{Boundary, CutArgs, LoopEngine, MachineArgs, Stepover, StrategyArg, ToolArg};
use crate::console::figure;
use crate::failure::Failure;
use crate::tool_profile::Section;
use pocketry_cam::{PocketJob, Strategy};
use pocketry_geom::ToolShape;
use pocketry_io::post::OutputUnit;
use pocketry_motion::{Direction, Feeds, Heights, Stock, Tool};

/// The settings shared by all regions of a run.
#[derive(Clone, Debug)]
pub(crate) struct Settings {
    tool: Option<ToolArg>,
    pub(crate) cut: CutArgs,
    machine: MachineArgs,
    /// A tool that is not round.
    /// And whether it turns with the walls.
    profile: Option<(ToolShape, bool)>,
}

/// Everything that has to be known to cut one region and to write its program.
#[derive(Clone, Debug)]
pub(crate) struct Setup {
    pub(crate) job: PocketJob,
    pub(crate) strategy: Strategy,
    pub(crate) unit: OutputUnit,
    /// What makes the loops.
    pub(crate) engine: LoopEngine,
    /// What the drawing's curves are.
    pub(crate) boundary: Boundary,
    /// Nobody has asked for a stepover: the quickest is chosen.
    pub(crate) any_stepover: bool,
    /// The cross-section of a tool that is not round; the job's tool is then the largest circle in it.
    pub(crate) profile: Option<Section>,
}

impl Setup {
    /// The tool as people are told of it.
    pub(crate) fn tool_name(&self) -> String {
        match &self.profile {
            Some(section) => section.shape.to_string(),
            None => format!("{} mm", figure(self.job.tool.diameter)),
        }
    }
}

impl Settings {
    pub(crate) fn new(tool: Option<ToolArg>, cut: CutArgs, machine: MachineArgs) -> Self {
        Self { tool, cut, machine, profile: None }
    }

    /// The same for a tool that is not round, and may turn with the walls.
    pub(crate) fn with_profile(self, profile: Option<ToolShape>, turns: bool) -> Self {
        Self { profile: profile.map(|shape| (shape, turns)), ..self }
    }

    /// The setup for a region; the file's own tool radius and interval (mm) stand where none were typed.
    pub(crate) fn resolve(&self, file_radius: Option<f64>, file_interval: Option<f64>) -> Result<Setup, Failure> {
        if let Some((shape, turns)) = &self.profile {
            return self.resolve_profile(shape, *turns);
        }
        let typed = match self.tool {
            Some(ToolArg::Diameter(diameter)) => Some(diameter),
            Some(ToolArg::Auto) | None => None,
        };
        let diameter = typed.or(file_radius.map(|r| 2.0 * r)).ok_or_else(|| {
            Failure::arguments("no tool: give its diameter in mm with --tool (this drawing does not name one)")
        })?;
        self.resolve_for(diameter, file_interval)
    }

    /// The tools to choose from and the largest scallop allowed, where the choice is left to us.
    pub(crate) fn choice(&self) -> Option<(&[f64], f64)> {
        (matches!(self.tool, Some(ToolArg::Auto)) && self.profile.is_none())
            .then_some((&self.cut.tools, self.cut.scallop))
    }

    /// The setup for a tool of this cross-section.
    fn resolve_profile(&self, shape: &ToolShape, turns: bool) -> Result<Setup, Failure> {
        if self.cut.boundary == Boundary::Cl {
            return Err(Failure::arguments("--boundary cl is for round tools; with --tool-profile draw the walls"));
        }
        if self.cut.stock_to_leave > 0.0 {
            let message = "--stock-to-leave is for round tools; with --tool-profile give a profile that much larger";
            return Err(Failure::arguments(message));
        }
        let section = Section::at(shape, turns, self.cut.depth.or(self.cut.stepdown))?;
        let setup = self.resolve_for(2.0 * section.radius, None)?;
        Ok(Setup { any_stepover: false, profile: Some(section), ..setup })
    }

    /// The setup for a tool of this diameter, mm.
    pub(crate) fn resolve_for(&self, diameter: f64, file_interval: Option<f64>) -> Result<Setup, Failure> {
        let usual = PocketJob::for_diameter(diameter);
        let stepdown = self.cut.stepdown.unwrap_or(usual.stepdown);
        let asked = self.stepover(diameter, file_interval);
        let job = PocketJob {
            tool: Tool { diameter, number: self.machine.tool_number },
            stock: Stock { top: self.cut.top, depth: self.cut.depth.unwrap_or(stepdown) },
            stepover: asked.unwrap_or(usual.stepover),
            cleanup: !self.cut.no_cleanup,
            stock_to_leave: self.cut.stock_to_leave,
            stepdown,
            direction: if self.cut.conventional { Direction::Conventional } else { Direction::Climb },
            heights: self.heights()?,
            feeds: self.feeds(),
            entry: usual.entry,
        };
        let strategy = match self.cut.strategy {
            StrategyArg::Auto => Strategy::Auto,
            StrategyArg::Contour => Strategy::Contour,
            StrategyArg::Subpockets => Strategy::Subpockets,
        };
        if self.cut.engine == LoopEngine::Pairwise && strategy == Strategy::Subpockets {
            let message =
                "the pair-wise engine knows no subpockets: drop --strategy subpockets or use --engine voronoi";
            return Err(Failure::arguments(message));
        }
        Ok(Setup {
            engine: self.cut.engine,
            job,
            strategy,
            unit: if self.machine.inch { OutputUnit::Inch } else { OutputUnit::Millimetre },
            boundary: self.cut.boundary,
            any_stepover: asked.is_none() && !self.cut.no_cleanup,
            profile: None,
        })
    }

    /// What was asked for, mm: typed, else in the file.
    fn stepover(&self, diameter: f64, file_interval: Option<f64>) -> Option<f64> {
        match self.cut.stepover {
            Some(Stepover::Length(mm)) => Some(mm),
            Some(Stepover::OfDiameter(share)) => Some(share * diameter),
            None => file_interval,
        }
    }

    fn feeds(&self) -> Feeds {
        let cut = self.machine.feed;
        Feeds {
            cut,
            ramp: self.machine.ramp_feed.unwrap_or(0.5 * cut),
            plunge: self.machine.plunge_feed.unwrap_or(0.25 * cut),
            rapid: self.machine.rapid_feed,
            spindle: self.machine.spindle,
        }
    }

    fn heights(&self) -> Result<Heights, Failure> {
        let heights = Heights { clearance: self.machine.clearance_height, retract: self.machine.retract_height };
        if heights.clearance < heights.retract {
            let message = format!(
                "the clearance height ({} mm) must not lie below the retract height ({} mm)",
                heights.clearance, heights.retract
            );
            return Err(Failure::arguments(message));
        }
        Ok(heights)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::{Cli, Command};
    use clap::Parser;

    fn setup(typed: &str, radius: Option<f64>, interval: Option<f64>) -> Result<Setup, Failure> {
        let words = "pocketry pocket a.dxf".split(' ').chain(typed.split(' ').filter(|w| !w.is_empty()));
        let Command::Pocket(args) = Cli::try_parse_from(words).unwrap().command else { unreachable!() };
        Settings::new(args.tool, args.cut, args.machine).resolve(radius, interval)
    }

    #[test]
    fn a_tool_is_a_diameter_and_the_rest_follows() {
        let job = setup("--tool 6", None, None).unwrap().job;
        assert_eq!((job.tool.radius(), job.stock.depth, job.stepdown), (3.0, 3.0, 3.0));
        assert!((job.stepover - 2.7).abs() < 1e-12);
        assert_eq!((job.feeds.ramp, job.feeds.plunge), (300.0, 150.0));
        assert!(setup("", None, None).is_err());
    }

    #[test]
    fn the_files_own_tool_and_interval_stand_unless_typed() {
        let job = setup("", Some(2.0), Some(1.5)).unwrap().job;
        assert_eq!((job.tool.diameter, job.stepover), (4.0, 1.5));
        let job = setup("--tool 10 --stepover 20%", Some(2.0), Some(1.5)).unwrap().job;
        assert_eq!((job.tool.diameter, job.stepover), (10.0, 2.0));
    }

    #[test]
    fn heights_must_be_in_order() {
        assert!(setup("--tool 6 --clearance-height 1", None, None).is_err());
    }
}
