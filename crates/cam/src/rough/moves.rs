//! From levels to moves.

use super::job::RoughJob;
use super::level::Level;
use crate::plan::{EntryKind, Group, Link, Writer, helix_of, ramp_of};
use crate::surface::scallop;
use pocketry_geom::{Point, Segment};
use pocketry_motion::{FeedKind, Move, Point3, Program};

/// Writes all levels, from the top.
pub(super) fn write(levels: &[Level], job: &RoughJob) -> Program {
    let mut out = Out { job, moves: Vec::new() };
    for level in levels {
        for pocket in level.groups.chunk_by(|a, b| a.pocket == b.pocket) {
            // The groups of a pocket follow one another.
            let first = level.groups.iter().position(|g| g.pocket == pocket[0].pocket).unwrap_or(0);
            let groups: Vec<Vec<Step<'_>>> = (first..first + pocket.len()).map(|g| steps_of(level, g)).collect();
            if groups.iter().any(|steps| outside(steps, job).is_some()) {
                out.open_pocket(level, first, &groups);
            } else {
                pocket.iter().zip(&groups).for_each(|(group, steps)| out.enter_within(level, group, steps));
            }
        }
    }
    out.lift(job.heights.clearance);
    Program { moves: out.moves, ..Program::default() }
}

/// A loop of a group and the way that leads to it from the loop before.
struct Step<'a> {
    way: &'a [Segment],
    path: &'a [Segment],
    /// Number of its distance from the boundary.
    level: usize,
}

fn steps_of(level: &Level, group: usize) -> Vec<Step<'_>> {
    let way = |k: usize| -> &[Segment] {
        // Ways stand in the order of the loops that they lead to.
        let at = level.links.partition_point(|l: &Link| l.to < k);
        level.links.get(at).filter(|l| l.to == k).map_or(&[], |l| &l.segments)
    };
    let of_group = level.loops.iter().enumerate().filter(|(_, l)| l.group == group);
    of_group.map(|(k, l)| Step { way: way(k), path: &l.segments, level: l.level }).collect()
}

/// The outermost loop with a place where the tool stands clear of the stock: its number, and the segment that starts there.
fn outside(steps: &[Step<'_>], job: &RoughJob) -> Option<(usize, usize)> {
    let clear = |s: &Segment| job.stock.distance(s.start()) >= job.tool.radius();
    let found = |(k, step): (usize, &Step<'_>)| step.path.iter().position(clear).map(|at| (k, at));
    steps.iter().enumerate().rev().find_map(found)
}

struct Out<'a> {
    job: &'a RoughJob,
    moves: Vec<Move>,
}

impl Out<'_> {
    fn top(&self) -> f64 {
        self.job.stock.high[2]
    }

    fn lift(&mut self, height: f64) {
        let z = self.top() + height;
        if let Some(at) = self.moves.last().map(Move::to) {
            self.moves.push(Move::Rapid { to: Point3 { z, ..at } });
        }
    }

    /// Through the air to above `p`, then down at feed to `z`, where nothing is any more.
    fn approach(&mut self, p: Point, z: f64) {
        let heights = self.job.heights;
        let above = self.top() + heights.retract;
        if self.moves.is_empty() {
            self.moves.push(Move::Rapid { to: Point3::at(p, self.top() + heights.clearance.max(heights.retract)) });
        }
        self.lift(heights.retract);
        self.moves.push(Move::Rapid { to: Point3::at(p, above) });
        if z < above {
            self.moves.push(Move::Line { to: Point3::at(p, z), feed: FeedKind::Ramp });
        }
    }

    fn follow<'s>(&mut self, path: impl IntoIterator<Item = &'s Segment>, z: f64) {
        self.moves.extend(path.into_iter().map(|s| Writer::along(s, z, FeedKind::Cut)));
    }

    /// Down by helix or ramp, then loop by loop from the innermost.
    fn enter_within(&mut self, level: &Level, group: &Group, steps: &[Step<'_>]) {
        let Some(first) = steps.first() else { return };
        let z = level.z;
        // What the level above left between its loops is cut on the way down.
        let from = (level.top + scallop(self.job.cutter, self.job.tool.radius(), self.job.stepover)).min(self.top());
        self.approach(group.start, from);
        let entry = self.job.pocket(from, z);
        match group.entry {
            EntryKind::Helix { center, radius } => self.moves.extend(helix_of(&entry, group.start, center, radius)),
            EntryKind::Ramp => self.moves.extend(ramp_of(&entry, first.path)),
            EntryKind::Plunge => self.moves.push(Move::Line { to: Point3::at(group.start, z), feed: FeedKind::Plunge }),
        }
        for step in steps {
            self.follow(step.way.iter().chain(step.path), z);
        }
    }

    /// The groups of a pocket that reaches beyond the stock, from the outside in: each lies within one that comes later in
    /// the planner's order.
    fn open_pocket(&mut self, level: &Level, first: usize, steps: &[Vec<Step<'_>>]) {
        for (k, steps) in steps.iter().enumerate().rev() {
            let group = first + k;
            if let Some((k, at)) = outside(steps, self.job) {
                self.enter_outside(level.z, steps, k, at);
            } else if let Some(beside) = Self::beside(level, group, steps) {
                self.enter_beside(level.z, steps, beside);
            } else {
                self.enter_within(level, &level.groups[group], steps);
            }
        }
    }

    /// The place nearest to the start of a group's outermost loop on the loops around it, which have been cut already: those one
    /// level farther out in later groups. No wall stands between a loop and the nearest place of the one around it.
    fn beside(level: &Level, group: usize, steps: &[Step<'_>]) -> Option<Point> {
        let last = steps.last()?;
        let start = last.path.first()?.start();
        let around = level.loops.iter().filter(|l| l.group > group && l.level + 1 == last.level);
        let places = around.flat_map(|l| &l.segments).map(|s| s.nearest(start));
        places.min_by(|a, b| a.distance_squared(start).total_cmp(&b.distance_squared(start)))
    }

    /// Down at a place that is cut already, sideways onto the outermost loop, and inwards from it.
    fn enter_beside(&mut self, z: f64, steps: &[Step<'_>], beside: Point) {
        let Some((last, start)) = steps.last().and_then(|s| Some((s, s.path.first()?.start()))) else { return };
        self.approach(beside, z);
        self.follow(std::iter::once(&Segment::line(beside, start)).chain(last.path), z);
        self.inwards(z, steps);
    }

    /// From the last loop's start to the first one, ways run backwards.
    fn inwards(&mut self, z: f64, steps: &[Step<'_>]) {
        for pair in steps.windows(2).rev() {
            let back: Vec<Segment> = pair[1].way.iter().rev().map(Segment::reversed).collect();
            self.follow(back.iter().chain(pair[0].path), z);
        }
    }

    /// Down beside the stock onto loop `k`, then inwards to the first loop; and once more, outwards from it, if there is more.
    ///
    /// Loops are closed, so a group can be cut from any of its loops in both directions, ways run backwards.
    fn enter_outside(&mut self, z: f64, steps: &[Step<'_>], k: usize, at: usize) {
        let lead = &steps[k].path[at..];
        let start = lead[0].start();
        self.approach(start, z);
        self.follow(lead, z);
        self.follow(steps[k].path, z);
        self.inwards(z, &steps[..=k]);
        if k + 1 < steps.len() {
            self.approach(start, z);
            self.follow(lead, z);
            for step in &steps[k + 1..] {
                self.follow(step.way.iter().chain(step.path), z);
            }
        }
    }
}
