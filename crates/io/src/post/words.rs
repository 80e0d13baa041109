//! Blocks of words, with the modal ones left out where they repeat.

use super::arc::{Piece, fit};
use super::grid::{Grid, Steps};
use super::{PostError, PostOptions};
use pocketry_geom::Segment;
use pocketry_motion::{FeedKind, Move, Point3};
use std::fmt::Write;

/// Steps of the rotary axis in a degree: a tool that reaches 20 mm is then off by 0.00002 mm at most.
const DEGREE_STEPS: f64 = 1e4;

/// Writes motion blocks and remembers what the control unit remembers: position, motion code and feed.
pub(crate) struct Blocks<'a> {
    text: String,
    grid: Grid,
    options: &'a PostOptions,
    /// Where the machine is after rounding; unknown before the first move.
    at: Option<(Steps, i64)>,
    /// The rotary axis after rounding, in steps of [`DEGREE_STEPS`]; none for a tool that does not turn.
    turned: Option<i64>,
    /// Where the program means it to be.
    meant: Option<Point3>,
    /// Which direction the program means the tool to have, radians.
    meant_heading: Option<f64>,
    motion: Option<u8>,
    feed: Option<FeedKind>,
}

impl<'a> Blocks<'a> {
    pub(crate) fn new(options: &'a PostOptions) -> Self {
        let grid = Grid::new(options.unit, options.decimals);
        Self {
            text: String::new(),
            grid,
            options,
            at: None,
            turned: None,
            meant: None,
            meant_heading: None,
            motion: None,
            feed: None,
        }
    }

    /// A line of its own, as it stands.
    pub(crate) fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// A comment: printable ASCII, no brackets of its own, of bounded length.
    pub(crate) fn comment(&mut self, comment: &str) {
        const LONGEST: usize = 120;
        let clean: String = comment
            .chars()
            .take(LONGEST)
            .map(|c| match c {
                '(' => '[',
                ')' => ']',
                ' '..='~' => c,
                _ => '?',
            })
            .collect();
        let _ = writeln!(self.text, "({})", clean.trim());
    }

    /// The text so far.
    pub(crate) fn finish(self) -> String {
        self.text
    }

    /// Writes a move at the end of which the tool, if it turns, has this direction (radians).
    pub(crate) fn step(&mut self, step: &Move, heading: Option<f64>) -> Result<(), PostError> {
        let to = step.to();
        let turned = heading.map(degree_steps);
        match (*step, self.meant) {
            (Move::Arc { feed, .. }, Some(from)) => {
                self.arc(step.plan_view(from.xy()), (from, to), heading, feed)?;
            }
            (Move::Line { feed, .. } | Move::Arc { feed, .. }, _) => {
                let (xy, z) = (self.grid.point_steps(to.xy())?, self.grid.steps(to.z)?);
                self.straight(1, xy, z, turned, Some(feed));
            }
            (Move::Rapid { .. }, _) => self.rapid(to, turned)?,
        }
        (self.meant, self.meant_heading) = (Some(to), heading);
        Ok(())
    }

    /// Height and place change in two blocks, the one first that leaves the tool higher; the tool turns with its place.
    fn rapid(&mut self, to: Point3, turned: Option<i64>) -> Result<(), PostError> {
        let (xy, z) = (self.grid.point_steps(to.xy())?, self.grid.steps(to.z)?);
        match self.at {
            None => {
                let _ = writeln!(self.text, "G0 Z{}", self.grid.text(z));
                let _ = write!(self.text, "X{} Y{}", self.grid.text(xy[0]), self.grid.text(xy[1]));
                let _ = turned.map(|c| write!(self.text, " C{}", degrees(c)));
                self.text.push('\n');
                (self.motion, self.at, self.turned) = (Some(0), Some((xy, z)), turned);
            }
            Some((at, height)) => {
                let first = if z > height { (at, z, self.turned) } else { (xy, height, turned) };
                self.straight(0, first.0, first.1, first.2, None);
                self.straight(0, xy, z, turned, None);
            }
        }
        Ok(())
    }

    fn arc(
        &mut self,
        path: Segment,
        (from, to): (Point3, Point3),
        heading: Option<f64>,
        feed: FeedKind,
    ) -> Result<(), PostError> {
        let (Segment::Arc(arc), Some((start, _))) = (path, self.at) else {
            return Ok(());
        };
        let last = self.grid.steps(to.z)?;
        let pieces = fit(&arc, start, &self.grid)?;
        let count = pieces.len();
        for (k, (piece, t)) in pieces.into_iter().enumerate() {
            let z = if k + 1 == count { last } else { self.grid.steps(from.z + t * (to.z - from.z))? };
            let turned = heading.map(|h| {
                let before = self.meant_heading.unwrap_or(h);
                degree_steps(if k + 1 == count { h } else { before + t * (h - before) })
            });
            match piece {
                Piece::Line(xy) => self.straight(1, xy, z, turned, Some(feed)),
                Piece::Arc { to, offset, ccw } => self.turn((to, offset, ccw), z, turned, feed),
            }
        }
        Ok(())
    }

    fn straight(&mut self, code: u8, xy: Steps, z: i64, turned: Option<i64>, feed: Option<FeedKind>) {
        let known = self.at;
        if known == Some((xy, z)) && self.turned == turned {
            return;
        }
        let mut block = self.motion_word(code);
        for (axis, value, before) in [
            ('X', xy[0], known.map(|(p, _)| p[0])),
            ('Y', xy[1], known.map(|(p, _)| p[1])),
            ('Z', z, known.map(|(_, h)| h)),
        ] {
            if before != Some(value) {
                let _ = write!(block, "{axis}{} ", self.grid.text(value));
            }
        }
        self.turn_word(&mut block, turned);
        self.end_block(&block, feed, (xy, z));
    }

    /// The rotary axis, where it changes.
    fn turn_word(&mut self, block: &mut String, turned: Option<i64>) {
        if let Some(c) = turned.filter(|_| self.turned != turned) {
            let _ = write!(block, "C{} ", degrees(c));
        }
        self.turned = turned;
    }

    fn turn(&mut self, (to, offset, ccw): (Steps, Steps, bool), z: i64, turned: Option<i64>, feed: FeedKind) {
        let mut block = self.motion_word(if ccw { 3 } else { 2 });
        let _ = write!(block, "X{} Y{} ", self.grid.text(to[0]), self.grid.text(to[1]));
        if self.at.is_none_or(|(_, height)| height != z) {
            let _ = write!(block, "Z{} ", self.grid.text(z));
        }
        self.turn_word(&mut block, turned);
        let _ = write!(block, "I{} J{} ", self.grid.text(offset[0]), self.grid.text(offset[1]));
        self.end_block(&block, Some(feed), (to, z));
    }

    fn motion_word(&mut self, code: u8) -> String {
        if self.motion == Some(code) {
            return String::new();
        }
        self.motion = Some(code);
        format!("G{code} ")
    }

    fn end_block(&mut self, block: &str, feed: Option<FeedKind>, at: (Steps, i64)) {
        self.at = Some(at);
        self.text.push_str(block.trim_end());
        if let Some(kind) = feed.filter(|&kind| self.feed != Some(kind)) {
            let speed = self.options.feeds.speed(Some(kind)) / self.options.unit.millimetres();
            let _ = write!(self.text, " F{}", plain(speed));
            self.feed = Some(kind);
        }
        self.text.push('\n');
    }
}

fn degree_steps(heading: f64) -> i64 {
    (heading.to_degrees() * DEGREE_STEPS).round() as i64
}

fn degrees(steps: i64) -> String {
    format!("{:.4}", steps as f64 / DEGREE_STEPS)
}

/// A positive number with at most three digits after the point, never rounded to 0.
pub(crate) fn plain(value: f64) -> String {
    if value < 0.001 {
        return format!("{value:.9}");
    }
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
