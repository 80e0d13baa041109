//! From chains to moves: passes in depth, entries, lifts.

use super::levels::Levels;
use super::order::{Chain, Start, Step};
use super::report::{EntryKind, Group, Link, Plan, PlannedLoop, Warning};
use super::track::length_of;
use crate::job::PocketJob;
use pocketry_geom::{Point, Segment, Vec2, vec2};
use pocketry_motion::{Direction, FeedKind, Move, Point3};
use std::f64::consts::TAU;

/// Writes every chain at every depth.
pub(super) fn write(levels: &Levels, chains: &[Chain], job: &PocketJob, first: f64) -> Plan {
    let passes = passes_of(job);
    let mut plan = Plan { passes, ..Plan::default() };
    let travelled: Vec<Travelled> = chains.iter().map(|c| Travelled::new(c, job, first)).collect();
    for (group, t) in travelled.iter().enumerate() {
        t.describe(group, levels, &mut plan);
    }
    let (pocket, start) = (|t: &Travelled<'_>| t.chain.pocket, |t: &Travelled<'_>| t.entry_point());
    plan.program.moves = at_every_depth(&travelled, job, pocket, start, |w, t, pass| w.chain(t, pass, passes));
    plan
}

/// Depth passes: as many as the stepdown takes.
pub(super) fn passes_of(job: &PocketJob) -> usize {
    (job.stock.depth / job.stepdown).ceil().max(1.0) as usize
}

/// The moves of all chains, those of one pocket in each depth pass before the next: to above each one's start, and along it.
pub(super) fn at_every_depth<C>(
    chains: &[C],
    job: &PocketJob,
    pocket: impl Fn(&C) -> usize,
    start: impl Fn(&C) -> Point,
    cut: impl Fn(&mut Writer<'_>, &C, usize),
) -> Vec<Move> {
    let mut writer = Writer::new(job);
    for same_pocket in chains.chunk_by(|a, b| pocket(a) == pocket(b)) {
        for pass in 0..passes_of(job) {
            for (k, chain) in same_pocket.iter().enumerate() {
                writer.approach(start(chain), pass == 0 && k == 0);
                cut(&mut writer, chain, pass);
            }
        }
    }
    writer.lift(job.heights.clearance);
    writer.moves
}

/// A loop in the direction that it is travelled in.
pub(crate) fn oriented(segments: &[Segment], direction: Direction) -> Vec<Segment> {
    match direction {
        Direction::Climb => segments.to_vec(),
        Direction::Conventional => segments.iter().rev().map(Segment::reversed).collect(),
    }
}

/// A chain with its entry and its cuts in the direction they are travelled.
struct Travelled<'a> {
    chain: &'a Chain,
    entry: EntryKind,
    cuts: Vec<Vec<Segment>>,
}

impl<'a> Travelled<'a> {
    fn new(chain: &'a Chain, job: &PocketJob, first: f64) -> Self {
        let cuts = chain.steps.iter().map(|s: &Step| oriented(&s.cut.segments, job.direction)).collect();
        Self { chain, entry: entry(chain, job, first), cuts }
    }

    /// Where the tool goes down.
    fn entry_point(&self) -> Point {
        match self.entry {
            _ if self.chain.is_from_tip() => self.chain.steps[0].link[0].start(),
            EntryKind::Helix { center, radius } => center + self.outward(center) * radius,
            EntryKind::Ramp | EntryKind::Plunge => self.chain.steps[0].cut.start,
        }
    }

    /// From a helix's axis to where its first loop begins.
    fn outward(&self, center: Point) -> Vec2 {
        let to = self.chain.steps[0].cut.start - center;
        if to == Vec2::ZERO { vec2(1.0, 0.0) } else { to.normalized() }
    }

    /// The ways to each cut as travelled: the entry's link starts on the helix, or is none.
    fn links(&self) -> Vec<Vec<Segment>> {
        let mut links: Vec<Vec<Segment>> = self.chain.steps.iter().map(|s| s.link.clone()).collect();
        if self.chain.is_from_tip() {
            return links;
        }
        let (from, to) = (self.entry_point(), self.chain.steps[0].cut.start);
        links[0] = if from == to { Vec::new() } else { vec![Segment::line(from, to)] };
        links
    }

    fn describe(&self, group: usize, levels: &Levels, plan: &mut Plan) {
        let start = self.entry_point();
        plan.groups.push(Group {
            start,
            clearance: self.chain.clearance,
            entry: self.entry,
            pocket: self.chain.pocket,
        });
        if self.entry == EntryKind::Plunge {
            plan.warnings.push(Warning::Plunge { at: start });
        }
        for ((step, cut), link) in self.chain.steps.iter().zip(&self.cuts).zip(self.links()) {
            let track = &levels.tracks[step.track as usize];
            if !link.is_empty() {
                plan.links.push(Link { segments: link, group, kind: step.kind, to: plan.loops.len() });
            }
            plan.loops.push(PlannedLoop {
                segments: cut.clone(),
                distance: track.distance,
                level: track.level,
                group,
                degenerate: track.degenerate,
            });
        }
    }
}

/// The gentlest entry that there is room for: the axis of a helix may stray from the peak by what its clearance exceeds
/// the first distance.
fn entry(chain: &Chain, job: &PocketJob, first: f64) -> EntryKind {
    let radius = job.tool.radius();
    let (least, largest) = (job.entry.least_helix * radius, job.entry.largest_helix * radius);
    let cut = &chain.steps[0].cut;
    if let Start::Tip { helix: radius, .. } = chain.start {
        // It ends in the direction in which the way from the tip begins.
        let (tip, along) = (chain.steps[0].link[0].start(), chain.steps[0].link[0].start_tangent());
        let aside = if job.direction == Direction::Climb { along.left() } else { along.right() };
        return EntryKind::Helix { center: tip + aside * radius, radius };
    }
    if let Start::Peak(center) = chain.start {
        let (room, reach) = (chain.clearance - first, center.distance(cut.start));
        let helix = if (least..=largest).contains(&reach) { reach } else { largest };
        let helix = helix.min(room);
        if helix >= least {
            return EntryKind::Helix { center, radius: helix };
        }
    }
    if cut.length() >= job.entry.least_ramp * radius { EntryKind::Ramp } else { EntryKind::Plunge }
}

/// Appends moves.
pub(crate) struct Writer<'a> {
    job: &'a PocketJob,
    moves: Vec<Move>,
}

impl<'a> Writer<'a> {
    pub(super) const fn new(job: &'a PocketJob) -> Self {
        Self { job, moves: Vec::new() }
    }

    fn at(&self) -> Option<Point3> {
        self.moves.last().map(Move::to)
    }

    pub(super) fn floor(&self, pass: usize, passes: usize) -> f64 {
        let stock = self.job.stock;
        if pass == passes { stock.top - stock.depth } else { stock.top - stock.depth * pass as f64 / passes as f64 }
    }

    /// The moves so far.
    pub(super) fn moves(&self) -> &[Move] {
        &self.moves
    }

    pub(super) fn into_moves(self) -> Vec<Move> {
        self.moves
    }

    pub(super) fn extend(&mut self, moves: impl IntoIterator<Item = Move>) {
        self.moves.extend(moves);
    }

    /// Straight up to a height above the stock.
    pub(super) fn lift(&mut self, height: f64) {
        if let Some(at) = self.at() {
            self.moves.push(Move::Rapid { to: Point3 { z: self.job.stock.top + height, ..at } });
        }
    }

    /// Through the air to above `p`: at retract height within a pocket, at clearance height to a `fresh` one.
    pub(super) fn approach(&mut self, p: Point, fresh: bool) {
        let heights = self.job.heights;
        let height = if fresh { heights.clearance.max(heights.retract) } else { heights.retract };
        self.lift(height);
        self.moves.push(Move::Rapid { to: Point3::at(p, self.job.stock.top + height) });
        if height > heights.retract {
            self.moves.push(Move::Rapid { to: Point3::at(p, self.job.stock.top + heights.retract) });
        }
    }

    fn chain(&mut self, t: &Travelled<'_>, pass: usize, passes: usize) {
        let (from, floor) = (self.floor(pass, passes), self.floor(pass + 1, passes));
        match t.entry {
            EntryKind::Helix { center, radius } => {
                self.plunge(t.entry_point(), from);
                self.moves.extend(turns(self.job, t.entry_point(), center, radius, from, floor));
            }
            EntryKind::Ramp => {
                self.plunge(t.entry_point(), from);
                self.moves.extend(rounds(self.job, &t.cuts[0], from, floor));
            }
            EntryKind::Plunge => self.plunge(t.entry_point(), floor),
        }
        for (link, cut) in t.links().iter().zip(&t.cuts) {
            for segment in link.iter().chain(cut) {
                self.moves.push(Self::along(segment, floor, FeedKind::Cut));
            }
        }
    }

    pub(super) fn plunge(&mut self, p: Point, z: f64) {
        self.moves.push(Move::Line { to: Point3::at(p, z), feed: FeedKind::Plunge });
    }

    /// A move along a segment seen from above that ends at height `z`.
    pub(crate) fn along(segment: &Segment, z: f64, feed: FeedKind) -> Move {
        match segment {
            Segment::Line(l) => Move::Line { to: Point3::at(l.end, z), feed },
            Segment::Arc(a) => Move::Arc { to: Point3::at(a.end, z), center: a.center, ccw: a.ccw, feed },
        }
    }
}

/// From the stock's top down to its floor: full turns of equal pitch, in the sense that cuts the hole's wall like the loops.
pub(crate) fn helix_of(job: &PocketJob, start: Point, center: Point, radius: f64) -> Vec<Move> {
    let (from, floor) = (job.stock.top, job.stock.top - job.stock.depth);
    turns(job, start, center, radius, from, floor)
}

/// From the stock's top down to its floor along whole rounds of a closed path.
pub(crate) fn ramp_of(job: &PocketJob, path: &[Segment]) -> Vec<Move> {
    rounds(job, path, job.stock.top, job.stock.top - job.stock.depth)
}

fn turns(job: &PocketJob, start: Point, center: Point, radius: f64, from: f64, floor: f64) -> Vec<Move> {
    let pitch = TAU * radius * job.entry.angle.tan();
    let count = ((from - floor) / pitch).ceil().max(1.0);
    let turn = |k: usize| {
        let z = from + (floor - from) * (k as f64 / count);
        let to = Point3::at(start, if k as f64 == count { floor } else { z });
        Move::Arc { to, center, ccw: job.direction == Direction::Climb, feed: FeedKind::Ramp }
    };
    (1..=count as usize).map(turn).collect()
}

/// From a height down to a floor along whole rounds of a closed path.
pub(super) fn rounds(job: &PocketJob, path: &[Segment], from: f64, floor: f64) -> Vec<Move> {
    let length = length_of(path);
    let count = ((from - floor) / (length * job.entry.angle.tan())).ceil().max(1.0);
    let mut moves = Vec::new();
    for round in 0..count as usize {
        let mut run = 0.0;
        for (k, segment) in path.iter().enumerate() {
            run += segment.length();
            let last = k + 1 == path.len();
            let share = if last { round as f64 + 1.0 } else { round as f64 + run / length };
            let z = if last && share == count { floor } else { from + (floor - from) * share / count };
            moves.push(Writer::along(segment, z, FeedKind::Ramp));
        }
    }
    moves
}
