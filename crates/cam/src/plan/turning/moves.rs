//! From runs to moves with directions.

use super::Cut;
use crate::job::PocketJob;
use crate::plan::moves::{Writer, passes_of};
use crate::plan::{EntryKind, Group, Plan, PlannedLoop, Warning};
use pocketry_geom::profile::turning::Course;
use pocketry_motion::{Direction, FeedKind};
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
    let mut turned = TurnedWriter { writer: Writer::new(job), headings: Vec::new() };
    for pass in 1..=passes {
        let floor = turned.writer.floor(pass, passes);
        for courses in &travelled {
            turned.run(courses, floor);
        }
    }
    turned.writer.lift(job.heights.clearance);
    turned.heading(turned.headings.last().copied().unwrap_or_default());
    plan.program.moves = turned.writer.into_moves();
    plan.program.headings = turned.headings;
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
struct TurnedWriter<'a> {
    writer: Writer<'a>,
    headings: Vec<f64>,
}

impl TurnedWriter<'_> {
    /// At the end of the moves that have no direction yet, the profile has this one.
    fn heading(&mut self, heading: f64) {
        self.headings.resize(self.writer.moves().len(), heading);
    }

    /// To above the start of a run, the shorter way round to its direction, down, and along it.
    fn run(&mut self, courses: &[Course], floor: f64) {
        let (start, from) = (courses[0].path.start(), courses[0].from);
        let last = self.headings.last().copied();
        let by = last.map_or(0.0, |last| TAU * ((last - from) / TAU).round());
        self.writer.approach(start, last.is_none());
        // It lifts with the direction that it has.
        self.headings.extend(last);
        self.writer.plunge(start, floor);
        self.heading(from + by);
        for course in courses {
            self.writer.extend([Writer::along(&course.path, floor, FeedKind::Cut)]);
            self.heading(course.to + by);
        }
    }
}
