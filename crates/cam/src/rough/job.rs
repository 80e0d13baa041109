//! What is to be roughed, and how.

use crate::PocketJob;
use crate::job::Entry;
use crate::plan::PlanError;
use crate::surface::stepover_for;
use pocketry_geom::mesh::{Corner, Mesh, above};
use pocketry_geom::offset::OffsetError;
use pocketry_geom::repair::RegionError;
use pocketry_geom::skeleton::SkeletonError;
use pocketry_geom::{BBox, Point};
use pocketry_motion::{Cutter, Direction, Feeds, Heights, Stock, Tool};
use serde::Serialize;

/// More levels than this are a slip of the finger.
const MOST_LEVELS: f64 = 10_000.0;

/// More nodes of the CL-surface than this are a slip of the finger.
const MOST_NODES: f64 = 1e8;

/// A block of stock.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Block {
    /// Its lowest corner, mm.
    pub low: Corner,
    /// Its highest corner, mm.
    pub high: Corner,
}

impl Block {
    /// The model's box grown at the sides and at the top by a margin, mm.
    pub fn around(mesh: &Mesh, margin: f64) -> Self {
        let (bbox, (bottom, top)) = (mesh.bbox().inflated(margin), mesh.heights());
        Self { low: [bbox.min.x, bbox.min.y, bottom], high: [bbox.max.x, bbox.max.y, top + margin] }
    }

    /// Seen from above.
    pub fn plan(&self) -> BBox {
        BBox::of(above(self.low), above(self.high))
    }

    /// How far a place seen from above lies outside, mm; 0 inside.
    pub fn distance(&self, p: Point) -> f64 {
        self.plan().distance_squared(p).sqrt()
    }
}

/// The engine that makes the loops.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub enum Engine {
    /// Exact, over the Voronoi skeleton.
    #[default]
    Voronoi,
    /// Round offsets by pairs of elements.
    Pairwise,
    /// Mitred offsets by bisectors, each of the one before it.
    Bisector,
}

/// A roughing job: everything but the model. Lengths are in mm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RoughJob {
    /// The tool.
    pub tool: Tool,
    /// The shape of its lower end.
    pub cutter: Cutter,
    /// The block of material.
    pub stock: Block,
    /// Distance between successive loops; more than the tool's radius is clamped to it.
    pub stepover: f64,
    /// Largest distance of levels; all are made equal.
    pub stepdown: f64,
    /// Thickness of material left on the model.
    pub stock_to_leave: f64,
    /// Climb or conventional milling.
    pub direction: Direction,
    /// Safe heights above the stock's top.
    pub heights: Heights,
    /// Feeds and spindle speed.
    pub feeds: Feeds,
    /// How the tool goes down into the material.
    pub entry: Entry,
    /// Distance of the CL-surface's nodes: the smallest detail that is seen.
    pub cell: f64,
    /// What makes the loops.
    pub engine: Engine,
}

impl RoughJob {
    /// Nodes of the CL-surface across the tool's radius.
    pub const NODES_PER_RADIUS: f64 = 10.0;

    /// How far the centre may go beyond the stock, as a share of the radius: the tool then stands clear of it.
    const OVERHANG: f64 = 1.25;

    /// The default job for a tool of this diameter.
    pub fn new(diameter: f64, cutter: Cutter, stock: Block) -> Self {
        let pocket = PocketJob::for_diameter(diameter);
        Self {
            tool: pocket.tool,
            cutter,
            stock,
            stepover: Self::usual_stepover(cutter, diameter, pocket.stepdown),
            stepdown: pocket.stepdown,
            stock_to_leave: 0.0,
            direction: pocket.direction,
            heights: pocket.heights,
            feeds: pocket.feeds,
            entry: pocket.entry,
            cell: pocket.tool.radius() / Self::NODES_PER_RADIUS,
            engine: Engine::default(),
        }
    }

    /// The share of the stepdown that may stand between loops where no stepover is asked for.
    const SCALLOP: f64 = 0.25;

    /// The usual distance of loops, mm: that of flat tools, or less where the cutter's shape would leave more than
    /// a quarter of the stepdown between them.
    pub fn usual_stepover(cutter: Cutter, diameter: f64, stepdown: f64) -> f64 {
        let radius = 0.5 * diameter;
        let flat = PocketJob::DEFAULT_STEPOVER * radius;
        if cutter.fits(radius) { flat.min(stepover_for(cutter, radius, Self::SCALLOP * stepdown)) } else { flat }
    }

    /// How far the centre may go beyond the stock, mm.
    pub(super) fn overhang(&self) -> f64 {
        Self::OVERHANG * self.tool.radius()
    }

    /// Heights of the levels, from the top: equal steps, the last at the stock's bottom.
    pub fn levels(&self) -> Vec<f64> {
        let (low, high) = (self.stock.low[2], self.stock.high[2]);
        let count = ((high - low) / self.stepdown).ceil().max(1.0);
        let height = |k: usize| if k as f64 == count { low } else { high - (high - low) * k as f64 / count };
        (1..=count as usize).map(height).collect()
    }

    /// The job of one level as the planner of flat pockets sees it.
    pub(super) fn pocket(&self, top: f64, z: f64) -> PocketJob {
        PocketJob {
            tool: self.tool,
            stock: Stock { top, depth: top - z },
            stepover: self.stepover.min(self.tool.radius()),
            stock_to_leave: 0.0,
            stepdown: 2.0 * (top - z),
            direction: self.direction,
            heights: self.heights,
            feeds: self.feeds,
            entry: self.entry,
            cleanup: false,
        }
    }

    /// Refuses numbers that no machine can do.
    pub(super) fn check(&self) -> Result<(), RoughError> {
        let size = [0, 1, 2].map(|k| self.stock.high[k] - self.stock.low[k]);
        self.pocket(1.0, 0.0).check()?;
        let positive = [
            ("stepdown", self.stepdown),
            ("cell", self.cell),
            ("stock's width", size[0]),
            ("stock's depth", size[1]),
            ("stock's height", size[2]),
        ];
        if let Some(&(what, value)) = positive.iter().find(|(_, v)| !(*v > 0.0 && v.is_finite())) {
            return Err(PlanError::Job { what, value }.into());
        }
        if !(self.stock_to_leave >= 0.0 && self.stock_to_leave.is_finite()) {
            return Err(PlanError::Job { what: "stock to leave", value: self.stock_to_leave }.into());
        }
        if !self.cutter.fits(self.tool.radius()) {
            return Err(RoughError::Cutter { cutter: self.cutter, diameter: self.tool.diameter });
        }
        if size[2] > MOST_LEVELS * self.stepdown {
            return Err(PlanError::Job { what: "stepdown", value: self.stepdown }.into());
        }
        let nodes = size[..2].iter().map(|s| (s + 2.0 * self.overhang()) / self.cell).product::<f64>();
        if nodes > MOST_NODES {
            return Err(PlanError::Job { what: "cell", value: self.cell }.into());
        }
        Ok(())
    }
}

/// Why a model could not be roughed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RoughError {
    /// A number in the job, or a planner's refusal.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The shape does not go with the diameter.
    #[error("a {cutter} can't have a diameter of {diameter} mm")]
    Cutter {
        /// The shape.
        cutter: Cutter,
        /// mm.
        diameter: f64,
    },
    /// No level has anything to cut.
    #[error("a tool of {diameter} mm reaches no stock at any level; take a smaller one, or check the stock")]
    NothingToCut {
        /// mm.
        diameter: f64,
    },
    /// The contour lines of a level are no region.
    #[error("level z {z} mm: {error}")]
    Region {
        /// Height of the level, mm.
        z: f64,
        /// What is wrong.
        error: RegionError,
    },
    /// A level's skeleton could not be built.
    #[error("level z {z} mm: {error}")]
    Skeleton {
        /// Height of the level, mm.
        z: f64,
        /// What is wrong.
        error: SkeletonError,
    },
    /// A level's loops could not be made.
    #[error("level z {z} mm: {error}")]
    Offset {
        /// Height of the level, mm.
        z: f64,
        /// What is wrong.
        error: OffsetError,
    },
}
