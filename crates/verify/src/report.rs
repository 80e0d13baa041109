//! What a proof found, for programs and for machinists.

use crate::options::Budget;
use pocketry_geom::Point;
use serde::Serialize;

/// The deepest entry into a wall.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Gouge {
    /// How far the tool's edge enters the wall (or the stock to leave), mm.
    pub depth: f64,
    /// The tool's centre there.
    pub at: Point,
    /// Line of the program, from 1.
    pub line: u32,
}

/// A place that the tool can reach and did not cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Spot {
    /// A point of it, the farthest from the tool that was looked at.
    pub at: Point,
    /// Area without holes, mm²; 0 where the place is only in doubt.
    pub area: f64,
    /// No circle larger than this fits into it, mm.
    pub radius: f64,
    /// How far that point lies beyond the tool's edge and the tolerance, mm; infinite where nothing is cut at all.
    pub beyond: f64,
}

/// A move that no program may make.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Violation {
    /// Line of the program, from 1.
    pub line: u32,
    /// Where the move ends.
    pub at: Point,
    /// Its lowest height, mm.
    pub z: f64,
}

/// The program's own figures. Lengths in mm.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Figures {
    /// Length of moves at feed.
    pub cut_length: f64,
    /// Length of rapid moves from known places.
    pub rapid_length: f64,
    /// Moves from below the stock's top to it or above.
    pub retracts: usize,
    /// Straight descents into the stock.
    pub plunges: usize,
    /// Descents into the stock of any kind.
    pub entries: usize,
    /// Motions.
    pub blocks: usize,
    /// Arcs among them.
    pub arcs: usize,
    /// Lowest height; infinite without any motion.
    pub lowest_z: f64,
}

/// The outcome of a proof.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The tool's radius, mm.
    pub tool_radius: f64,
    /// The tolerances it was judged by.
    pub budget: Budget,
    /// The deepest entry into a wall, tolerated or not; `None` where every move keeps its distance.
    pub gouge: Option<Gouge>,
    /// Length of centre line outside the region below the stock's top, mm.
    pub outside: f64,
    /// First line of the program that is there.
    pub outside_line: Option<u32>,
    /// Whether everything that can be reached is proven cut.
    pub covered: bool,
    /// Area of reachable material left uncut, mm²; 0 where it is proven that nothing is.
    pub uncut_area: f64,
    /// Where it was left, largest first.
    pub uncut_spots: Vec<Spot>,
    /// Area of the region, mm².
    pub region_area: f64,
    /// Area that the tool can cut (the opening of the region by the tool; with stock to leave, by a tool that much larger), mm².
    pub reachable_area: f64,
    /// Area that the tool can't cut, mm².
    pub unreachable_area: f64,
    /// Bound of the error in the two areas, mm²: the reach tolerance times the walls' length, and what gaps in the outline may make;
    /// the region's area where they are not known.
    pub area_error: f64,
    /// Rapid moves below the stock's top, straight retracts apart.
    pub rapids_below: Vec<Violation>,
    /// Moves across before any height was set.
    pub unknown_height: Vec<Violation>,
    /// First line that cuts under a path control without a tolerance.
    pub unbounded_blending: Option<u32>,
    /// First line that cuts while the spindle stands; told, but not held against the proof.
    pub spindle_stopped: Option<u32>,
    /// Whether M2 or M30 ended the program; told, but not held against the proof.
    pub ended: bool,
    /// The floor that was asked for, where one was, mm.
    pub floor: Option<f64>,
    /// The program's own figures.
    pub figures: Figures,
}

impl Report {
    /// How deep the tool enters a wall at worst, mm.
    pub fn gouge_depth(&self) -> f64 {
        self.gouge.map_or(0.0, |g| g.depth)
    }

    /// Area that the tool can't cut, mm², where it was measured.
    pub fn known_unreachable_area(&self) -> Option<f64> {
        (self.area_error < self.region_area).then_some(self.unreachable_area)
    }

    /// Whether the program does what it should and nothing that it should not.
    pub fn is_proven(&self) -> bool {
        self.complaints().is_empty()
    }

    /// Everything that speaks against the program, the worst first, for a machinist.
    pub fn complaints(&self) -> Vec<String> {
        let mut out = Vec::new();
        self.complain_of_moves(&mut out);
        self.complain_of_walls(&mut out);
        self.complain_of_floor(&mut out);
        self.complain_of_uncut(&mut out);
        out
    }

    /// What a machinist should know though the program is no worse for it.
    pub fn notes(&self) -> Vec<String> {
        let mut out = Vec::new();
        if let Some(line) = self.spindle_stopped {
            out.push(format!("line {line} cuts before the program starts the spindle (M3 or M4)"));
        }
        if !self.ended {
            out.push("the program does not end with M2 or M30".into());
        }
        if self.reachable_area == 0.0 {
            out.push("the tool fits nowhere in this region".into());
        }
        out
    }

    fn complain_of_moves(&self, out: &mut Vec<String>) {
        if let Some(v) = self.unknown_height.first() {
            out.push(format!("line {} moves across before the program has set a height; retract first", v.line));
        }
        if let Some(v) = self.rapids_below.first() {
            let (n, x, y, z) = (self.rapids_below.len(), v.at.x, v.at.y, v.z);
            out.push(format!(
                "{n} rapid move(s) below the stock's top, the first in line {} to X{x:.3} Y{y:.3} down to Z{z:.3}",
                v.line
            ));
        }
        if let Some(line) = self.unbounded_blending {
            out.push(format!(
                "line {line} cuts while the control may round corners as it likes; set G61 or G64 P with a tolerance first"
            ));
        }
    }

    fn complain_of_walls(&self, out: &mut Vec<String>) {
        if let Some(line) = self.outside_line {
            out.push(format!("the tool's centre leaves the region over {:.3} mm, first in line {line}", self.outside));
        }
        if let Some(g) = self.gouge.filter(|g| g.depth > self.budget.gouge) {
            out.push(format!(
                "line {} cuts {:.4} mm into the wall with the tool at X{:.4} Y{:.4} ({:.4} mm is allowed)",
                g.line, g.depth, g.at.x, g.at.y, self.budget.gouge
            ));
        }
    }

    fn complain_of_floor(&self, out: &mut Vec<String>) {
        let lowest = self.figures.lowest_z;
        if let Some(floor) = self.floor.filter(|f| (f - lowest).abs() > self.budget.gouge) {
            out.push(if lowest < floor {
                format!("the program cuts down to Z{lowest:.4}, below the floor at Z{floor:.4}")
            } else {
                format!("the program cuts down to Z{lowest:.4} only, the floor is at Z{floor:.4}")
            });
        }
    }

    fn complain_of_uncut(&self, out: &mut Vec<String>) {
        if self.covered {
            return;
        }
        let n = self.uncut_spots.iter().filter(|s| s.area > 0.0).count();
        out.push(match self.uncut_spots.first() {
            Some(s) if n > 0 => format!(
                "{:.4} mm² that the tool can reach are left uncut in {n} place(s), the largest ({:.4} mm²) at X{:.4} Y{:.4}",
                self.uncut_area, s.area, s.at.x, s.at.y
            ),
            Some(s) => format!(
                "it can't be shown that nothing within reach is left uncut; the doubt is at X{:.4} Y{:.4}",
                s.at.x, s.at.y
            ),
            None => "it can't be shown that nothing within the tool's reach is left uncut".into(),
        });
    }
}
