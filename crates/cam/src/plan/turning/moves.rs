//! From runs to moves with directions.

use super::Cut;
use crate::job::PocketJob;
use crate::plan::moves::{Writer as Along, passes_of};
use crate::plan::{EntryKind, Group, Plan, PlannedLoop, Warning};
use pocketry_geom::profile::turning::Course;
use pocketry_geom::{Point, Segment};
use pocketry_motion::{Direction, FeedKind, Move, Point3};
use std::f64::consts::TAU;

/// Writes every run at every depth; each is a group of its own, with a plunge.
pub(super) fn write(cuts: &[Cut], widest: f64, job: &PocketJob) -> Plan {
    let passes = passes_of(job);
    let mut plan = Plan { passes, ..Plan::default() };
    let travelled: Vec<Vec<Course>> = cuts.iter().map(|c| travelled(c, job.direction)).collect();
    for (group, (cut, courses)) in cuts.iter().zip(&travelled).enumerate() {
        let start = courses[0].path.start();
        let clearance = widest - cut.distance;
        plan.groups.push(Group { start, clearance, entry: EntryKind::Plunge, pocket: 0 });
        let paths = courses.iter().map(|c| c.path);
        plan.loops.push(PlannedLoop {
            segments: paths.filter(|s| s.start() != s.end()).collect(),
            distance: cut.distance,
            level: cut.level,
            group,
            degenerate: false,
        });
    }
    plan.warnings.extend(plan.groups.first().map(|g| Warning::Plunge { at: g.start }));
    let mut writer = Writer { job, moves: Vec::new(), headings: Vec::new() };
    for pass in 1..=passes {
        let floor = job.stock.top - job.stock.depth * pass as f64 / passes as f64;
        let floor = if pass == passes { job.stock.top - job.stock.depth } else { floor };
        for courses in &travelled {
            writer.run(courses, floor);
        }
    }
    writer.lift(job.heights.clearance);
    plan.program.moves = writer.moves;
    plan.program.headings = writer.headings;
    plan
}

/// The pieces in the order and sense in which they are travelled; the profile's directions stay.
fn travelled(cut: &Cut, direction: Direction) -> Vec<Course> {
    match direction {
        Direction::Climb => cut.run.courses.clone(),
        Direction::Conventional => cut.run.courses.iter().rev().map(Course::reversed).collect(),
    }
}

/// Appends moves with directions.
struct Writer<'a> {
    job: &'a PocketJob,
    moves: Vec<Move>,
    headings: Vec<f64>,
}

impl Writer<'_> {
    fn push(&mut self, step: Move, heading: f64) {
        self.moves.push(step);
        self.headings.push(heading);
    }

    fn lift(&mut self, height: f64) {
        if let (Some(at), Some(&heading)) = (self.moves.last().map(Move::to), self.headings.last()) {
            self.push(Move::Rapid { to: Point3 { z: self.job.stock.top + height, ..at } }, heading);
        }
    }

    /// To above the start of a run, the shorter way round to its direction, down, and along it.
    fn run(&mut self, courses: &[Course], floor: f64) {
        let heights = self.job.heights;
        let height = if self.moves.is_empty() { heights.clearance.max(heights.retract) } else { heights.retract };
        self.lift(height);
        let (start, from) = (courses[0].path.start(), courses[0].from);
        let by = self.headings.last().map_or(0.0, |last| TAU * ((last - from) / TAU).round());
        let above = |height: f64| Move::Rapid { to: Point3::at(start, self.job.stock.top + height) };
        self.push(above(height), from + by);
        if height > heights.retract {
            self.push(above(heights.retract), from + by);
        }
        self.push(plunge(start, floor), from + by);
        for course in courses {
            self.push(along(&course.path, floor), course.to + by);
        }
    }
}

fn plunge(at: Point, z: f64) -> Move {
    Move::Line { to: Point3::at(at, z), feed: FeedKind::Plunge }
}

fn along(path: &Segment, z: f64) -> Move {
    Along::along(path, z, FeedKind::Cut)
}
