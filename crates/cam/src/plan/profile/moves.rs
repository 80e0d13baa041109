//! From chains to moves.

use super::tree::Forest;
use super::walk::Chain;
use crate::job::PocketJob;
use crate::plan::length_of;
use crate::plan::moves::{Writer, at_every_depth, oriented, passes_of, rounds};
use crate::plan::{EntryKind, Group, Link, Plan, PlannedLoop, Warning};
use pocketry_geom::Segment;
use pocketry_motion::FeedKind;

/// Writes every chain at every depth.
pub(super) fn write(forest: &Forest, chains: &[Chain], job: &PocketJob, stepover: f64) -> Plan {
    let passes = passes_of(job);
    let mut plan = Plan { passes, ..Plan::default() };
    let deepest = forest.parts.iter().map(|p| p.level).max().unwrap_or(0);
    let travelled: Vec<Travelled> = chains.iter().map(|c| Travelled::new(c, job)).collect();
    for (group, t) in travelled.iter().enumerate() {
        t.describe(group, stepover, deepest, &mut plan);
    }
    let (pocket, start) = (|t: &Travelled<'_>| t.chain.pocket, |t: &Travelled<'_>| t.chain.cuts[0].start());
    plan.program.moves = at_every_depth(&travelled, job, pocket, start, |w, t, pass| t.cut(w, pass, passes));
    plan
}

/// A chain with its cuts in the direction they are travelled.
struct Travelled<'a> {
    chain: &'a Chain,
    entry: EntryKind,
    cuts: Vec<Vec<Segment>>,
    job: &'a PocketJob,
}

impl<'a> Travelled<'a> {
    fn new(chain: &'a Chain, job: &'a PocketJob) -> Self {
        let cuts: Vec<Vec<Segment>> = chain.cuts.iter().map(|c| oriented(&c.segments, job.direction)).collect();
        // A helix would need room for the profile beside the loop; a ramp along the loop has it.
        let long = length_of(&cuts[0]) >= job.entry.least_ramp * job.tool.radius();
        Self { chain, entry: if long { EntryKind::Ramp } else { EntryKind::Plunge }, cuts, job }
    }

    fn describe(&self, group: usize, stepover: f64, deepest: usize, plan: &mut Plan) {
        let first = &self.chain.cuts[0];
        let distance = |level: usize| stepover * level as f64;
        let clearance = distance(deepest - first.level.min(deepest));
        plan.groups.push(Group { start: first.start(), clearance, entry: self.entry, pocket: self.chain.pocket });
        if self.entry == EntryKind::Plunge {
            plan.warnings.push(Warning::Plunge { at: first.start() });
        }
        for (cut, segments) in self.chain.cuts.iter().zip(&self.cuts) {
            if let Some((way, kind)) = cut.link {
                plan.links.push(Link { segments: vec![way], group, kind, to: plan.loops.len() });
            }
            plan.loops.push(PlannedLoop {
                segments: segments.clone(),
                distance: distance(cut.level),
                level: cut.level,
                group,
                degenerate: false,
            });
        }
    }

    fn cut(&self, writer: &mut Writer<'_>, pass: usize, passes: usize) {
        let (from, floor) = (writer.floor(pass, passes), writer.floor(pass + 1, passes));
        let start = self.chain.cuts[0].start();
        match self.entry {
            EntryKind::Ramp => {
                writer.plunge(start, from);
                writer.extend(rounds(self.job, &self.cuts[0], from, floor));
            }
            _ => writer.plunge(start, floor),
        }
        for (cut, segments) in self.chain.cuts.iter().zip(&self.cuts) {
            let link = cut.link.iter().map(|(way, _)| way);
            writer.extend(link.chain(segments).map(|s| Writer::along(s, floor, FeedKind::Cut)));
        }
    }
}
