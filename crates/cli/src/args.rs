//! What was typed. What it means is [`crate::settings`]'s affair.

use crate::tool_profile::ProfileArg;
use clap::{Args, Parser, Subcommand, ValueEnum};
use pocketry_io::import::Units;
use pocketry_motion::Cutter;
use std::path::PathBuf;
use std::str::FromStr;

/// From the drawing of a pocket to a proven milling program.
#[derive(Debug, Parser)]
#[command(version, about, max_term_width = 100, propagate_version = true)]
#[command(after_help = "Exit codes: 0 written and proven, 1 planned but not provable (nothing written), \
    2 bad input, arguments or a tool that fits nowhere, 3 input/output failure. A batch returns the highest.")]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Write a proven G-code program that clears the drawing's pockets.
    Pocket(Box<PocketArgs>),
    /// Offset the drawing's pockets inwards and write the loops as DXF, SVG or JSON.
    Offset(OffsetArgs),
    /// Write the skeleton (Voronoi diagram inside the pockets) as SVG or JSON.
    Skeleton(SkeletonArgs),
    /// Cut the pockets at their bottlenecks and write the subpockets as DXF, SVG or JSON.
    Subpockets(SubpocketsArgs),
    /// Judge a program against a drawing: gouges, uncut material, rapid moves in the stock.
    Verify(VerifyArgs),
    /// Show what the stepover does: length, time, lifts, uncut material, with and without clean-up.
    Study(Box<StudyArgs>),
    /// Write a G-code program, proven in space, that roughs a model (STL, OBJ, 3MF) out of a block, level by level.
    Rough(Box<RoughArgs>),
    /// Cut a model (STL, OBJ, 3MF) at heights and write the contours as DXF, SVG or region JSON lines.
    Slice(SliceArgs),
    /// Say what is in a drawing: contours, areas, the largest tool that fits.
    Info(InfoArgs),
}

/// How a drawing is read.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Drawing")]
pub(crate) struct DrawingArgs {
    /// Read this layer only (may be given several times).
    #[arg(long, value_name = "NAME")]
    pub(crate) layer: Vec<String>,
    /// The drawing's unit (mm, cm, m, in, px, ...), where the file does not say or says wrong.
    #[arg(long, value_name = "UNIT")]
    pub(crate) units: Option<Units>,
    /// Where the program's X0 Y0 lies: `drawing` (as drawn), `center`, `lower-left`, or `X,Y` in mm.
    #[arg(long, value_name = "PLACE", default_value = "drawing", allow_hyphen_values = true)]
    pub(crate) origin: Origin,
}

/// The place that becomes X0 Y0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Origin {
    /// The drawing's own.
    Drawing,
    /// The middle of the pockets' box.
    Center,
    /// The lower left corner of the pockets' box.
    LowerLeft,
    /// This place, in the drawing's coordinates, mm.
    At(f64, f64),
}

impl FromStr for Origin {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "drawing" => return Ok(Self::Drawing),
            "center" | "centre" => return Ok(Self::Center),
            "lower-left" => return Ok(Self::LowerLeft),
            _ => {}
        }
        let parsed = text.split_once(',').and_then(|(x, y)| Some((finite(x)?, finite(y)?)));
        parsed.map(|(x, y)| Self::At(x, y)).ok_or_else(|| "expected drawing, center, lower-left or X,Y".to_owned())
    }
}

/// What the curves of a drawing are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Boundary {
    /// Walls, from which the tool's axis keeps its radius.
    Walls,
    /// Paths of the tool's axis.
    Cl,
}

/// An engine that offsets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Engine {
    /// Exact, from the Voronoi skeleton.
    Voronoi,
    /// By pair-wise interference detection; arcs become chords within 0.0001 mm.
    Pairwise,
    /// By bisectors: mitred corners at reflex vertices; arcs become chords.
    Bisector,
}

/// An engine whose offsets programs are made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum LoopEngine {
    /// Exact, from the Voronoi skeleton: lines and arcs.
    #[default]
    Voronoi,
    /// By pair-wise interference detection, for point sequences: arcs of the drawing become chords.
    Pairwise,
}

/// Stepovers from one to another, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stepovers {
    from: Stepover,
    to: Stepover,
    steps: u32,
}

impl Stepovers {
    /// Each of them, mm.
    pub(crate) fn values(&self, diameter: f64) -> Vec<f64> {
        let [a, b] = [self.from, self.to].map(|s| match s {
            Stepover::Length(mm) => mm,
            Stepover::OfDiameter(share) => share * diameter,
        });
        (0..=self.steps).map(|k| a + (b - a) * f64::from(k) / f64::from(self.steps.max(1))).collect()
    }
}

impl FromStr for Stepovers {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (range, steps) = text.split_once('/').unwrap_or((text, "10"));
        let steps = steps.trim().parse().map_err(|_| "expected a number of steps after the slash".to_owned())?;
        let (from, to) = range.split_once("..").unwrap_or((range, range));
        let steps = if from == to { 0 } else { steps };
        Ok(Self { from: from.parse()?, to: to.parse()?, steps })
    }
}

/// The distance between loops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Stepover {
    /// In mm.
    Length(f64),
    /// As a fraction of the tool's diameter.
    OfDiameter(f64),
}

impl FromStr for Stepover {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (number, wrap): (&str, fn(f64) -> Self) = match text.strip_suffix('%') {
            Some(percent) => (percent, |p| Self::OfDiameter(p / 100.0)),
            None => (text.strip_suffix("mm").unwrap_or(text).trim_end(), Self::Length),
        };
        match finite(number) {
            Some(value) if value > 0.0 => Ok(wrap(value)),
            _ => Err("expected a positive length in mm, or a percentage of the tool's diameter such as 45%".to_owned()),
        }
    }
}

/// Which tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ToolArg {
    /// The largest that meets the tolerance.
    Auto,
    /// Of this diameter, mm.
    Diameter(f64),
}

impl FromStr for ToolArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "auto" { Ok(Self::Auto) } else { positive(text).map(Self::Diameter) }
    }
}

/// How loops are laid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum StrategyArg {
    /// The quicker one.
    Auto,
    /// Around the whole pocket.
    Contour,
    /// Subpocket by subpocket.
    Subpockets,
}

fn finite(text: &str) -> Option<f64> {
    text.trim().parse().ok().filter(|v: &f64| v.is_finite())
}

/// A number that is not infinite.
fn number(text: &str) -> Result<f64, String> {
    finite(text).ok_or_else(|| "expected a number".to_owned())
}

/// A number above 0.
fn positive(text: &str) -> Result<f64, String> {
    finite(text).filter(|&v| v > 0.0).ok_or_else(|| "expected a number above 0".to_owned())
}

/// A number that is 0 or more.
fn not_negative(text: &str) -> Result<f64, String> {
    finite(text).filter(|&v| v >= 0.0).ok_or_else(|| "expected 0 or a number above".to_owned())
}

/// `pocketry pocket`.
#[derive(Args, Debug)]
pub(crate) struct PocketArgs {
    /// The drawing: DXF, SVG, region JSON, or JSON lines for a batch.
    pub(crate) input: PathBuf,
    /// Diameter of the tool, mm, or `auto`: the largest of --tools that meets --scallop. Region JSON may hold its own radius.
    #[arg(short, long, value_name = "MM|auto")]
    pub(crate) tool: Option<ToolArg>,
    /// Cross-section of a tool that is not round, mm: rect:WxH, rounded:WxHrR, stadium:LxW, ellipse:AxB,
    /// polygon:SIDESxDIAMETER (across corners), circle:D, file:DRAWING (drawn about X0 Y0, in SVG the page's lower left corner);
    /// or cone:ANGLE, ball:D at --depth. @DEGREES at the end turns it.
    #[arg(long, value_name = "SHAPE", conflicts_with = "tool")]
    pub(crate) tool_profile: Option<ProfileArg>,
    /// The tool of --tool-profile turns with the walls: its x axis along the nearest one, which lies on its -y side. The program
    /// turns it with the rotary axis C.
    #[arg(long, requires = "tool_profile")]
    pub(crate) turning: bool,
    /// The program to write [default: the drawing's name with .ngc].
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Picture of the job to write (SVG).
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,
    /// Draw the skeleton into the picture, too.
    #[arg(long, requires = "plot")]
    pub(crate) plot_skeleton: bool,
    /// Report to write (JSON; JSON lines for a batch).
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,
    /// Folder for the programs of a batch.
    #[arg(long, value_name = "DIR")]
    pub(crate) out_dir: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) drawing: DrawingArgs,
    #[command(flatten)]
    pub(crate) cut: CutArgs,
    #[command(flatten)]
    pub(crate) machine: MachineArgs,
}

/// What is to be cut, and how.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Cutting")]
pub(crate) struct CutArgs {
    /// Distance between loops, mm or a percentage of the diameter, up to all of it [default: the quickest].
    #[arg(long, value_name = "MM|%")]
    pub(crate) stepover: Option<Stepover>,
    /// What the drawing's curves are: `walls`, or `cl` for tool paths (curves on a cutter-location surface).
    #[arg(long, value_enum, default_value = "walls")]
    pub(crate) boundary: Boundary,
    /// No detours to what loops more than the radius apart leave uncut: such programs are refused.
    #[arg(long)]
    pub(crate) no_cleanup: bool,
    /// What makes the loops.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) engine: LoopEngine,
    /// With --tool auto: how far material may stay from what is cut, in corners and necks, mm.
    #[arg(long, value_name = "MM", default_value = "0.1", value_parser = positive)]
    pub(crate) scallop: f64,
    /// With --tool auto: diameters of the tools at hand, mm, separated by commas.
    #[arg(long, value_name = "MM,...", value_delimiter = ',', default_value = "3,4,6,8,10", value_parser = positive)]
    pub(crate) tools: Vec<f64>,
    /// Material to leave on the walls, mm.
    #[arg(long, value_name = "MM", default_value = "0", value_parser = not_negative)]
    pub(crate) stock_to_leave: f64,
    /// Depth of the pocket below the stock's top, mm [default: one stepdown].
    #[arg(long, value_name = "MM", value_parser = positive)]
    pub(crate) depth: Option<f64>,
    /// Largest depth of one pass, mm; passes are equal [default: the tool's radius].
    #[arg(long, value_name = "MM", value_parser = positive)]
    pub(crate) stepdown: Option<f64>,
    /// Z of the stock's top, mm.
    #[arg(long, value_name = "MM", default_value = "0", allow_hyphen_values = true, value_parser = number)]
    pub(crate) top: f64,
    /// How loops are laid: around the whole pocket (`contour`), around one subpocket after the other (`subpockets`), or
    /// whichever takes less time (`auto`).
    #[arg(long, value_name = "HOW", default_value = "auto")]
    pub(crate) strategy: StrategyArg,
    /// Climb milling (the default).
    #[arg(long, conflicts_with = "conventional")]
    pub(crate) climb: bool,
    /// Conventional milling.
    #[arg(long)]
    pub(crate) conventional: bool,
}

/// Speeds, heights and how numbers are written.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Machine")]
pub(crate) struct MachineArgs {
    /// Cutting feed, mm/min.
    #[arg(long, value_name = "MM/MIN", default_value = "600", value_parser = positive)]
    pub(crate) feed: f64,
    /// Feed along entry helix and ramp, mm/min [default: half the cutting feed].
    #[arg(long, value_name = "MM/MIN", value_parser = positive)]
    pub(crate) ramp_feed: Option<f64>,
    /// Feed straight down, mm/min [default: a quarter of the cutting feed].
    #[arg(long, value_name = "MM/MIN", value_parser = positive)]
    pub(crate) plunge_feed: Option<f64>,
    /// Rapid speed for the time estimate, mm/min.
    #[arg(long, value_name = "MM/MIN", default_value = "3000", value_parser = positive)]
    pub(crate) rapid_feed: f64,
    /// Spindle speed, rpm.
    #[arg(long, value_name = "RPM", default_value = "12000", value_parser = positive)]
    pub(crate) spindle: f64,
    /// Height of moves between pockets above the stock's top, mm.
    #[arg(long, value_name = "MM", default_value = "10", value_parser = positive)]
    pub(crate) clearance_height: f64,
    /// Height of moves inside a pocket above the stock's top, mm.
    #[arg(long, value_name = "MM", default_value = "2", value_parser = positive)]
    pub(crate) retract_height: f64,
    /// The tool's number in the machine's tool table.
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) tool_number: u32,
    /// Write the program in inches.
    #[arg(long)]
    pub(crate) inch: bool,
}

/// `pocketry offset`.
#[derive(Args, Debug)]
pub(crate) struct OffsetArgs {
    /// The drawing: DXF, SVG or region JSON.
    pub(crate) input: PathBuf,
    /// Distances from the walls, mm, separated by commas.
    #[arg(short, long, value_name = "MM,...", value_delimiter = ',', required = true, value_parser = positive)]
    pub(crate) distance: Vec<f64>,
    /// The engine that computes the loops.
    #[arg(long, value_enum, default_value = "voronoi")]
    pub(crate) engine: Engine,
    /// File to write; its ending (.dxf, .svg, .json) says in which form [default: JSON to standard output].
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) drawing: DrawingArgs,
}

/// `pocketry study`.
#[derive(Args, Debug)]
pub(crate) struct StudyArgs {
    /// The drawing: DXF, SVG or region JSON.
    pub(crate) input: PathBuf,
    /// Diameter of the tool, mm. Region JSON may hold its own radius.
    #[arg(short, long, value_name = "MM", value_parser = positive)]
    pub(crate) tool: Option<f64>,
    /// Stepovers, mm or percentages of the diameter: first, last and (after a slash) how many steps.
    #[arg(long = "stepover", value_name = "FROM..TO[/STEPS]", default_value = "45%..98%/10")]
    pub(crate) stepovers: Stepovers,
    /// Table to write (CSV).
    #[arg(long, value_name = "FILE")]
    pub(crate) csv: Option<PathBuf>,
    /// Chart to write (SVG).
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,
    /// What makes the loops.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) engine: LoopEngine,
    #[command(flatten)]
    pub(crate) drawing: DrawingArgs,
    /// What the drawing's curves are: `walls`, or `cl` for tool paths (curves on a cutter-location surface).
    #[arg(long, value_enum, default_value = "walls")]
    pub(crate) boundary: Boundary,
}

/// `pocketry skeleton`.
#[derive(Args, Debug)]
pub(crate) struct SkeletonArgs {
    /// The drawing: DXF, SVG or region JSON.
    pub(crate) input: PathBuf,
    /// File to write; its ending (.svg, .json) says in which form [default: JSON to standard output].
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) drawing: DrawingArgs,
}

/// `pocketry subpockets`.
#[derive(Args, Debug)]
pub(crate) struct SubpocketsArgs {
    /// The drawing: DXF, SVG or region JSON.
    pub(crate) input: PathBuf,
    /// File to write; its ending (.dxf, .svg, .json) says in which form [default: JSON to standard output].
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) drawing: DrawingArgs,
}

/// `pocketry verify`.
#[derive(Args, Debug)]
pub(crate) struct VerifyArgs {
    /// The drawing: DXF, SVG or region JSON.
    pub(crate) input: PathBuf,
    /// The program to judge.
    pub(crate) program: PathBuf,
    /// Diameter of the tool, mm. Region JSON may hold its own radius.
    #[arg(short, long, value_name = "MM", value_parser = positive)]
    pub(crate) tool: Option<f64>,
    /// Cross-section of a tool that is not round, as for `pocket`.
    #[arg(long, value_name = "SHAPE", conflicts_with_all = ["tool", "stock_to_leave"])]
    pub(crate) tool_profile: Option<ProfileArg>,
    /// The tool of --tool-profile turns with the walls, as for `pocket`.
    #[arg(long, requires = "tool_profile")]
    pub(crate) turning: bool,
    /// How deep the tool cuts, mm; for tool profiles that depend on it.
    #[arg(long, value_name = "MM", requires = "tool_profile", value_parser = positive)]
    pub(crate) depth: Option<f64>,
    /// Material that is to stay on the walls, mm.
    #[arg(long, value_name = "MM", default_value = "0", value_parser = not_negative)]
    pub(crate) stock_to_leave: f64,
    /// Z of the stock's top, mm.
    #[arg(long, value_name = "MM", default_value = "0", allow_hyphen_values = true, value_parser = number)]
    pub(crate) top: f64,
    /// Report to write (JSON).
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) drawing: DrawingArgs,
}

/// A block of stock: two opposite corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StockBox {
    pub(crate) low: [f64; 3],
    pub(crate) high: [f64; 3],
}

impl FromStr for StockBox {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Option<Vec<f64>> = text.split(',').map(finite).collect();
        match numbers.as_deref() {
            Some(&[a, b, c, d, e, f]) if a < d && b < e && c < f => Ok(Self { low: [a, b, c], high: [d, e, f] }),
            _ => Err("expected X0,Y0,Z0,X1,Y1,Z1 in mm, the lowest corner first".to_owned()),
        }
    }
}

/// The engine that makes the loops.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum EngineArg {
    /// Exact, over the Voronoi skeleton.
    #[default]
    Voronoi,
    /// Round offsets by pairs of elements.
    Pairwise,
    /// Mitred offsets by bisectors, each of the one before it.
    Bisector,
}

/// `pocketry rough`.
#[derive(Args, Debug)]
pub(crate) struct RoughArgs {
    /// The model: STL, OBJ or 3MF.
    pub(crate) input: PathBuf,
    /// Diameter of the tool, mm.
    #[arg(short, long, value_name = "MM", value_parser = positive)]
    pub(crate) tool: f64,
    /// Shape of the tool's end: flat, ball, bull:CORNER (mm) or cone:ANGLE (degrees between the flanks).
    #[arg(long, value_name = "SHAPE", default_value = "flat")]
    pub(crate) cutter: Cutter,
    /// The program to write [default: the model's name with .ngc].
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Picture to write (SVG): all levels in projection; one for each level is written beside it.
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,
    /// Report to write (JSON).
    #[arg(long, value_name = "FILE")]
    pub(crate) report: Option<PathBuf>,
    /// The model's unit (mm, in, ...), where the file does not say or says wrong.
    #[arg(long, value_name = "UNIT")]
    pub(crate) units: Option<Units>,
    /// The block of material, mm [default: the model's box and the margin].
    #[arg(long, value_name = "X0,Y0,Z0,X1,Y1,Z1", allow_hyphen_values = true, conflicts_with = "margin")]
    pub(crate) stock: Option<StockBox>,
    /// How much larger than the model the block is at its sides and at its top, mm.
    #[arg(long, value_name = "MM", default_value = "1", value_parser = not_negative)]
    pub(crate) margin: f64,
    /// Distance of the nodes at which the model is looked at, mm [default: a tenth of the tool's radius].
    #[arg(long, value_name = "MM", value_parser = positive)]
    pub(crate) cell: Option<f64>,
    /// What makes the loops.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) engine: EngineArg,
    #[command(flatten)]
    pub(crate) cut: RoughCutArgs,
    #[command(flatten)]
    pub(crate) machine: MachineArgs,
}

/// What is to be cut of a model, and how.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Cutting")]
pub(crate) struct RoughCutArgs {
    /// Distance between loops, mm or a percentage of the diameter; at most the radius [default: 45%, or less where
    /// the cutter's shape would leave more than a quarter of the stepdown between loops].
    #[arg(long, value_name = "MM|%")]
    pub(crate) stepover: Option<Stepover>,
    /// Largest distance of levels, mm; levels are equal [default: the tool's radius].
    #[arg(long, value_name = "MM", value_parser = positive)]
    pub(crate) stepdown: Option<f64>,
    /// Material to leave on the model, mm.
    #[arg(long, value_name = "MM", default_value = "0", value_parser = not_negative)]
    pub(crate) stock_to_leave: f64,
    /// Climb milling (the default).
    #[arg(long, conflicts_with = "conventional")]
    pub(crate) climb: bool,
    /// Conventional milling.
    #[arg(long)]
    pub(crate) conventional: bool,
}

impl From<RoughCutArgs> for CutArgs {
    fn from(a: RoughCutArgs) -> Self {
        let RoughCutArgs { stepover, stepdown, stock_to_leave, climb, conventional } = a;
        Self {
            stepover,
            stock_to_leave,
            depth: None,
            stepdown,
            top: 0.0,
            climb,
            conventional,
            strategy: StrategyArg::Contour,
            boundary: Boundary::Walls,
            engine: LoopEngine::Voronoi,
            no_cleanup: false,
            scallop: 0.0,
            tools: Vec::new(),
        }
    }
}

/// `pocketry slice`.
#[derive(Args, Debug)]
pub(crate) struct SliceArgs {
    /// The model: STL, OBJ or 3MF.
    pub(crate) input: PathBuf,
    /// Heights of the planes, mm, separated by commas.
    #[arg(short, long, value_name = "MM,...", value_delimiter = ',', required = true, allow_hyphen_values = true, value_parser = number)]
    pub(crate) z: Vec<f64>,
    /// File to write; its ending (.dxf, .svg, .jsonl) says in which form [default: JSON lines to standard output].
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// The model's unit (mm, in, ...), where the file does not say or says wrong.
    #[arg(long, value_name = "UNIT")]
    pub(crate) units: Option<Units>,
}

/// `pocketry info`.
#[derive(Args, Debug)]
pub(crate) struct InfoArgs {
    /// The drawing: DXF, SVG or region JSON.
    pub(crate) input: PathBuf,
    /// Diameters of tools to compare, mm, separated by commas.
    #[arg(long, value_name = "MM,...", value_delimiter = ',', default_value = "3,4,6,8,10", value_parser = positive)]
    pub(crate) tools: Vec<f64>,
    /// Say it in JSON.
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) drawing: DrawingArgs,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn stepovers_and_origins_are_read() {
        assert_eq!("45%".parse(), Ok(Stepover::OfDiameter(0.45)));
        assert_eq!("2.5".parse(), Ok(Stepover::Length(2.5)));
        assert_eq!("10..20/4".parse::<Stepovers>().unwrap().values(20.0), [10.0, 12.5, 15.0, 17.5, 20.0]);
        assert_eq!("75%".parse::<Stepovers>().unwrap().values(20.0), [15.0]);
        assert!("10..x".parse::<Stepovers>().is_err() && "10..20/x".parse::<Stepovers>().is_err());
        assert!("-1".parse::<Stepover>().is_err() && "nan".parse::<Stepover>().is_err());
        assert_eq!("-3, 4.5".parse(), Ok(Origin::At(-3.0, 4.5)));
        assert_eq!("0,0,-1,2,3,4".parse(), Ok(StockBox { low: [0.0, 0.0, -1.0], high: [2.0, 3.0, 4.0] }));
        assert!("0,0,0,1,1,0".parse::<StockBox>().is_err() && "0,0,0,1,1,inf".parse::<StockBox>().is_err());
        assert!("1".parse::<Origin>().is_err() && "inf,0".parse::<Origin>().is_err());
    }
}
