//! What the proof of a roughing program found.

use crate::report::{Figures, Violation};
use pocketry_geom::Point;
use serde::Serialize;

/// An entry into the model, or into the stock that must stay on it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RoughGouge {
    /// How far the cutter enters the model along the normal, mm; negative where it enters only the stock to leave.
    pub depth: f64,
    /// How far it enters the stock to leave, mm.
    pub into: f64,
    /// The tool's tip, seen from above.
    pub at: Point,
    /// Height of the tip, mm.
    pub z: f64,
    /// Line of the program, from 1.
    pub line: u32,
}

/// Material above what a tool with the same levels could leave.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RoughLeftover {
    /// How high, mm; not positive where nothing is left.
    pub height: f64,
    /// Where, seen from above.
    pub at: Point,
}

/// A straight descent into material.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RoughDescent {
    /// How thick the material was that the cutter came down on, mm.
    pub depth: f64,
    /// Where, seen from above.
    pub at: Point,
    /// Line of the program, from 1.
    pub line: u32,
}

/// The worst of one level.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LevelReport {
    /// Height of its floor, mm.
    pub z: f64,
    /// The deepest entry of moves down to this level; `None` where all keep clear of the stock to leave.
    pub gouge: Option<RoughGouge>,
    /// The highest leftover where this level could have cut; `None` where it could cut nowhere.
    pub leftover: Option<RoughLeftover>,
}

impl LevelReport {
    pub(super) const fn at(z: f64) -> Self {
        Self { z, gouge: None, leftover: None }
    }

    pub(super) fn deepen(&mut self, g: RoughGouge) {
        if self.gouge.is_none_or(|known| g.depth > known.depth) {
            self.gouge = Some(g);
        }
    }

    pub(super) fn leave(&mut self, l: RoughLeftover) {
        if self.leftover.is_none_or(|known| l.height > known.height) {
            self.leftover = Some(l);
        }
    }
}

/// The outcome of the proof of a roughing program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RoughReport {
    /// The deepest entry of all; `None` where every move keeps clear of the stock to leave.
    pub gouge: Option<RoughGouge>,
    /// The highest leftover of all.
    pub leftover: Option<RoughLeftover>,
    /// The straight descent into the thickest material, if there is any; told, but not held against the proof.
    pub descent: Option<RoughDescent>,
    /// Level by level, from the top.
    pub levels: Vec<LevelReport>,
    /// How deep the cutter may enter the model, and as much the stock to leave, mm.
    pub gouge_tolerance: f64,
    /// What the cutter's shape leaves between loops and within the innermost ones at most, mm.
    pub scallop: f64,
    /// Rapid moves below the stock's top, straight retracts apart.
    pub rapids_below: Vec<Violation>,
    /// Moves across before any height was set.
    pub unknown_height: Vec<Violation>,
    /// First line that cuts under a path control without a tolerance.
    pub unbounded_blending: Option<u32>,
    /// Whether M2 or M30 ended it.
    pub ended: bool,
    /// The program's own figures.
    pub figures: Figures,
}

impl RoughReport {
    /// How deep the cutter enters the model at worst, mm; 0 where it does not.
    pub fn gouge_depth(&self) -> f64 {
        self.gouge.map_or(0.0, |g| g.depth.max(0.0))
    }

    /// How deep the cutter enters the stock that must stay at worst, mm; 0 where it does not.
    pub fn into_stock(&self) -> f64 {
        self.gouge.map_or(0.0, |g| g.into)
    }

    /// The highest leftover, mm; 0 where there is none.
    pub fn leftover_height(&self) -> f64 {
        self.leftover.map_or(0.0, |l| l.height.max(0.0))
    }

    /// Whether the program does what it should and nothing that it should not.
    pub fn is_proven(&self) -> bool {
        self.complaints().is_empty()
    }

    /// Everything that speaks against the program, the worst first, for a machinist.
    pub fn complaints(&self) -> Vec<String> {
        let mut out = Vec::new();
        if let Some(v) = self.unknown_height.first() {
            out.push(format!("line {} moves across before the program has set a height", v.line));
        }
        if let Some(v) = self.rapids_below.first() {
            let (n, z) = (self.rapids_below.len(), v.z);
            out.push(format!("{n} rapid move(s) below the stock's top, the first at line {} (Z{z:.3})", v.line));
        }
        if let Some(line) = self.unbounded_blending {
            out.push(format!("line {line} cuts under a path control without a tolerance"));
        }
        if let Some(g) = self.gouge.filter(|g| g.into > self.gouge_tolerance) {
            let what = if g.depth > self.gouge_tolerance { ("model", g.depth) } else { ("stock to leave", g.into) };
            out.push(format!(
                "line {} cuts {:.4} mm into the {} at X{:.3} Y{:.3} Z{:.3}",
                g.line, what.1, what.0, g.at.x, g.at.y, g.z
            ));
        }
        if let Some(l) = self.leftover.filter(|l| l.height > self.scallop + self.gouge_tolerance) {
            out.push(format!(
                "{:.3} mm are left at X{:.3} Y{:.3} above what the tool could cut there",
                l.height, l.at.x, l.at.y
            ));
        }
        out
    }
}
