//! What was typed becomes what is to be done: defaults, percentages and limits resolved, one [`Setup`] a region.

use crate::args::{CutArgs, MachineArgs, Stepover};
use crate::failure::Failure;
use pocketry_io::post::OutputUnit;
use pocketry_motion::{Direction, Feeds, Heights, Stock, Tool};

/// Share of the tool's radius that is the default distance between loops.
const DEFAULT_STEPOVER: f64 = 0.9;

/// The settings shared by all regions of a run.
#[derive(Clone, Debug)]
pub(crate) struct Settings {
    diameter: Option<f64>,
    cut: CutArgs,
    machine: MachineArgs,
}

/// Everything that has to be known to cut one region.
#[derive(Clone, Debug)]
pub(crate) struct Setup {
    pub(crate) tool: Tool,
    /// Distance between loops, mm, at most the tool's radius.
    pub(crate) stepover: f64,
    pub(crate) stock_to_leave: f64,
    pub(crate) stock: Stock,
    /// Largest depth of a pass, mm.
    pub(crate) stepdown: f64,
    pub(crate) feeds: Feeds,
    pub(crate) heights: Heights,
    pub(crate) direction: Direction,
    pub(crate) unit: OutputUnit,
    /// What was changed of what was asked for.
    pub(crate) warnings: Vec<String>,
}

impl Settings {
    pub(crate) fn new(diameter: Option<f64>, cut: CutArgs, machine: MachineArgs) -> Self {
        Self { diameter, cut, machine }
    }

    /// The setup for a region; the file's own tool radius and interval (mm) stand where none were typed.
    pub(crate) fn resolve(&self, file_radius: Option<f64>, file_interval: Option<f64>) -> Result<Setup, Failure> {
        let diameter = self.diameter.or(file_radius.map(|r| 2.0 * r)).ok_or_else(|| {
            Failure::arguments("no tool: give its diameter in mm with --tool (this drawing does not name one)")
        })?;
        let tool = Tool { diameter, number: self.machine.tool_number };
        let mut warnings = Vec::new();
        let stepover = self.stepover(&tool, file_interval, &mut warnings);
        let stepdown = self.cut.stepdown.unwrap_or(tool.radius());
        let feeds = self.feeds();
        Ok(Setup {
            tool,
            stepover,
            stock_to_leave: self.cut.stock_to_leave,
            stock: Stock { top: self.cut.top, depth: self.cut.depth.unwrap_or(stepdown) },
            stepdown,
            feeds,
            heights: self.heights()?,
            direction: if self.cut.conventional { Direction::Conventional } else { Direction::Climb },
            unit: if self.machine.inch { OutputUnit::Inch } else { OutputUnit::Millimetre },
            warnings,
        })
    }

    fn stepover(&self, tool: &Tool, file_interval: Option<f64>, warnings: &mut Vec<String>) -> f64 {
        let radius = tool.radius();
        let asked = match self.cut.stepover {
            Some(Stepover::Length(mm)) => mm,
            Some(Stepover::OfDiameter(share)) => share * tool.diameter,
            None => file_interval.unwrap_or(DEFAULT_STEPOVER * radius),
        };
        if asked > radius {
            warnings.push(format!("stepover {asked} mm is above the tool's radius; {radius} mm is used"));
        }
        asked.min(radius)
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
        let s = setup("--tool 6", None, None).unwrap();
        assert_eq!((s.tool.radius(), s.stepover, s.stock.depth, s.stepdown), (3.0, 2.7, 3.0, 3.0));
        assert_eq!((s.feeds.ramp, s.feeds.plunge), (300.0, 150.0));
        assert!(setup("", None, None).is_err());
    }

    #[test]
    fn the_files_own_tool_and_interval_stand_unless_typed() {
        let s = setup("", Some(2.0), Some(1.5)).unwrap();
        assert_eq!((s.tool.diameter, s.stepover), (4.0, 1.5));
        let s = setup("--tool 10 --stepover 20%", Some(2.0), Some(1.5)).unwrap();
        assert_eq!((s.tool.diameter, s.stepover), (10.0, 2.0));
    }

    #[test]
    fn stepovers_above_the_radius_are_clamped_with_a_warning() {
        let s = setup("--tool 6 --stepover 80%", None, None).unwrap();
        assert_eq!((s.stepover, s.warnings.len()), (3.0, 1));
    }

    #[test]
    fn heights_must_be_in_order() {
        assert!(setup("--tool 6 --clearance-height 1", None, None).is_err());
    }
}
