//! What a plan holds, and what can be said about it.

use super::{Cleanup, Strategy};
use pocketry_geom::offset::morphology::MorphologyError;
use pocketry_geom::offset::{OffsetError, degenerate_slack};
use pocketry_geom::skeleton::Skeleton;
use pocketry_geom::skeleton::trees::{Kind, Trees};
use pocketry_geom::{Point, Segment};
use pocketry_motion::Program;
use serde::Serialize;

/// Parts out of the tool's reach that are named one by one.
const NAMED_PARTS: usize = 20;

/// Why a job cannot be planned.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// A number of the job makes no sense.
    #[error("{what} of {value}: out of range")]
    Job {
        /// Which number.
        what: &'static str,
        /// Its value, mm (radians for angles).
        value: f64,
    },
    /// The tool is too large for every part of the region.
    #[error("a tool of {diameter} mm fits nowhere in this pocket; the largest that fits measures {largest:.4} mm")]
    DoesNotFit {
        /// Diameter of the tool asked for, mm.
        diameter: f64,
        /// Largest diameter that fits somewhere, the stock to leave considered, mm.
        largest: f64,
    },
    /// The skeleton contradicts the region; a fault of the program, not of the drawing.
    #[error(
        "the skeleton claims a clearance of {clearance} mm, more than the region measures; please report the drawing"
    )]
    Skeleton {
        /// Largest clearance of its vertices, mm.
        clearance: f64,
    },
    /// The offsets failed.
    #[error(transparent)]
    Offset(#[from] OffsetError),
    /// The tool's cross-section is no use.
    #[error("the tool profile can't be used: {reason}")]
    Profile {
        /// Why.
        reason: String,
    },
    /// The places at which the profile may be are not clear.
    #[error(transparent)]
    Morphology(#[from] MorphologyError),
    /// The tool's cross-section is too large for every part of the region, as it is turned.
    #[error(
        "a tool profile of {width:.3} x {height:.3} mm fits nowhere in this pocket as it is turned; take a smaller one or turn it \
         (@DEGREES)"
    )]
    ProfileDoesNotFit {
        /// Extent along x, mm.
        width: f64,
        /// Extent along y, mm.
        height: f64,
    },
}

/// What was done differently from what was asked, or cannot be done.
#[derive(Clone, Debug, PartialEq, Serialize, thiserror::Error)]
pub enum Warning {
    /// The stepover was above what the tool path takes, where ridges would stay between loops: the tool's diameter less the
    /// tolerance for tool path I, the tool's radius for tool path II.
    #[error("a stepover of {asked} mm would leave ridges between the loops; {used} mm is used")]
    StepoverClamped {
        /// mm.
        asked: f64,
        /// mm.
        used: f64,
    },
    /// The stepover was above the radius of the largest circle in the tool's profile, beyond which material could stay.
    #[error("stepover {asked} mm may leave material between loops of this profile; {used:.4} mm is used")]
    ProfileStepoverClamped {
        /// mm.
        asked: f64,
        /// mm.
        used: f64,
    },
    /// No room for a helix nor a loop long enough for a ramp.
    #[error("plunge at ({:.3}, {:.3}): no room for a helix or a ramp; use a tool that cuts to its centre", .at.x, .at.y)]
    Plunge {
        /// Where.
        at: Point,
    },
    /// A part of the pocket that the tool cannot get into.
    #[error("the part around ({:.3}, {:.3}) cannot be reached: it takes a tool of at most {largest:.4} mm", .at.x, .at.y)]
    Unreached {
        /// Its widest place.
        at: Point,
        /// Diameter that fits there, mm.
        largest: f64,
    },
    /// More such parts.
    #[error("{count} more parts of the pocket cannot be reached")]
    MoreUnreached {
        /// How many.
        count: usize,
    },
}

/// A planned job.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Plan {
    /// The moves.
    pub program: Program,
    /// The loops in the order they are cut in each depth pass.
    pub loops: Vec<PlannedLoop>,
    /// The ways between them, in the same order.
    pub links: Vec<Link>,
    /// The groups of loops; the tool lifts between them.
    pub groups: Vec<Group>,
    /// Control vertices of the region's skeleton.
    pub control_vertices: usize,
    /// How it was planned: [`Strategy::Contour`] or [`Strategy::Subpockets`].
    pub strategy: Strategy,
    /// Subpockets of the region, where they were looked for.
    pub subpockets: Option<usize>,
    /// Depth passes.
    pub passes: usize,
    /// Detours of the loops to places that would stay uncut between them.
    pub cleanups: Vec<Cleanup>,
    /// Distance between loops that was used, mm.
    pub stepover: f64,
    /// What the machinist should know.
    pub warnings: Vec<Warning>,
}

/// A closed path of the tool's axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlannedLoop {
    /// Its lines and arcs as they are travelled, from where the tool enters it.
    pub segments: Vec<Segment>,
    /// Distance from the walls, mm.
    pub distance: f64,
    /// Number of the distance, from 0 at the walls.
    pub level: usize,
    /// The group it belongs to, an index into [`Plan::groups`].
    pub group: usize,
    /// Whether it is the tour of a channel just as wide as the tool, rather than a loop around material.
    pub degenerate: bool,
}

/// What kind of way a link is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum LinkKind {
    /// From the entry to the first loop, straight towards the nearest wall.
    Entry,
    /// From an entry at the tip of a clean-up path along that to the first loop.
    CleanUp,
    /// From a loop to the next one further out, straight towards the nearest wall.
    SideStep,
    /// Between loops of one distance, along loops and the skeleton.
    Medial,
    /// Into a neighbouring subpocket, along loops that are cut and the critical edge between the two.
    Through,
}

/// A way of the tool, cutting depth kept, from one loop to the next.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Link {
    /// Its lines and arcs.
    pub segments: Vec<Segment>,
    /// The group it belongs to.
    pub group: usize,
    /// What it is.
    pub kind: LinkKind,
    /// The loop that it leads to, an index into [`Plan::loops`].
    pub to: usize,
}

/// How the tool goes down at the start of a group.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum EntryKind {
    /// Along a helix.
    Helix {
        /// Its axis.
        center: Point,
        /// mm.
        radius: f64,
    },
    /// Along the first loop.
    Ramp,
    /// Straight down.
    Plunge,
}

/// A sequence of loops that the tool cuts without lifting.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Group {
    /// Where it starts: the place of the entry.
    pub start: Point,
    /// The highest clearance inside its first loop, mm.
    pub clearance: f64,
    /// How the tool goes down.
    pub entry: EntryKind,
    /// The connected part of what can be reached, numbered from 0.
    pub pocket: usize,
}

/// Every peak that the tool cannot get to, widest first.
pub(super) fn unreached(skeleton: &Skeleton, trees: &Trees, first: f64, stock_to_leave: f64) -> Vec<Warning> {
    let limit = first - degenerate_slack(first);
    let mut parts: Vec<(f64, Point)> = trees
        .of_kind(Kind::Peak)
        .map(|k| &trees.plateaus()[k as usize])
        .filter(|p| p.clearance < limit)
        .map(|p| (2.0 * (p.clearance - stock_to_leave).max(0.0), skeleton.vertices()[p.vertices[0] as usize].point))
        .collect();
    parts.sort_by(|a, b| b.0.total_cmp(&a.0));
    let more = parts.len().saturating_sub(NAMED_PARTS);
    let named = parts.iter().take(NAMED_PARTS).map(|&(largest, at)| Warning::Unreached { at, largest });
    named.chain((more > 0).then_some(Warning::MoreUnreached { count: more })).collect()
}
