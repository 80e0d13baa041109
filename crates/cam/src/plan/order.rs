//! Steps 3 and 4 of algorithm 4.1: which loop after which, and how the tool gets from one to the next.
//!
//! Areas are visited inner ones first; of several inner areas the one with the highest peak last, so that its group goes
//! on through the loops around all of them. An area without inner ones starts a group at its peak.

use super::levels::{Area, Levels};
use super::track::Entrance;
use super::ways::{Summit, Ways};
use super::{Cut, Landing, LinkKind};
use pocketry_geom::skeleton::{EdgeId, NONE, SiteId};
use pocketry_geom::tolerance::{LANDING, LANDING_SNAP};
use pocketry_geom::{Point, Segment, Vec2};
use std::collections::BTreeSet;

/// One track of a chain.
#[derive(Clone, Debug)]
pub(super) struct Step {
    pub(super) track: u32,
    pub(super) cut: Cut,
    /// The way from the end of the step before; at the first step from the entry's place.
    pub(super) link: Vec<Segment>,
    pub(super) kind: LinkKind,
}

/// Where a chain starts.
#[derive(Clone, Copy, Debug)]
pub(super) enum Start {
    /// At the peak of its area.
    Peak(Point),
    /// At the tip of a clean-up path.
    Tip {
        /// Radius of the helix that ends there, mm.
        helix: f64,
        /// Which one.
        cleanup: usize,
    },
    /// On its first track.
    Track,
}

/// A group of tracks cut without lifting.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    pub(super) start: Start,
    /// The highest clearance inside its first track, as far as it is known, mm.
    pub(super) clearance: f64,
    pub(super) steps: Vec<Step>,
    /// Number of the connected part of what can be reached.
    pub(super) pocket: usize,
}

impl Chain {
    /// Whether it starts at the tip of a clean-up path.
    pub(super) const fn is_from_tip(&self) -> bool {
        matches!(self.start, Start::Tip { .. })
    }
}

/// Puts tracks in order.
pub(super) struct Orderer<'a> {
    ways: &'a dyn Ways,
    pub(super) levels: &'a Levels,
    /// Every segment parallel to a site: `(level, site, track, segment)`, sorted.
    pieces: Vec<(usize, SiteId, u32, u32)>,
    /// Every place where a track crosses an edge: `(level, half-edge, track, segment)`, sorted.
    crossings: Vec<(usize, EdgeId, u32, u32)>,
    /// How far a landing may miss a loop, mm.
    miss: f64,
    /// Nearer than this to an end of a segment, a landing is moved there, mm.
    snap: f64,
}

impl<'a> Orderer<'a> {
    pub(super) fn new(ways: &'a dyn Ways, levels: &'a Levels) -> Self {
        let mut pieces = Vec::new();
        let mut crossings = Vec::new();
        for (t, track) in levels.tracks.iter().enumerate() {
            for (k, (&site, &crossing)) in track.sites.iter().zip(&track.crossings).enumerate() {
                pieces.push((track.level, site, t as u32, k as u32));
                if crossing != NONE {
                    crossings.push((track.level, crossing, t as u32, k as u32));
                }
            }
        }
        pieces.sort_unstable();
        crossings.sort_unstable();
        let size = ways.size();
        Self { ways, levels, pieces, crossings, miss: LANDING * size, snap: LANDING_SNAP * size }
    }

    /// All chains in the order they are cut. Those of a pocket start at tips of clean-up paths where that takes neither more nor
    /// fewer lifts: clean-up is no reason to lift.
    pub(super) fn chains(&self) -> Vec<Chain> {
        let of_root = |(pocket, &root): (usize, &u32)| {
            let from_tips = self.chains_of(root, pocket, true);
            if !from_tips.iter().any(Chain::is_from_tip) {
                return from_tips;
            }
            let others = self.chains_of(root, pocket, false);
            if from_tips.len() == others.len() { from_tips } else { others }
        };
        self.levels.roots.iter().enumerate().flat_map(of_root).collect()
    }

    /// The chains of a tree of areas.
    fn chains_of(&self, root: u32, pocket: usize, from_tips: bool) -> Vec<Chain> {
        let mut chains = Vec::new();
        for area in self.inner_first(root) {
            self.cut_area(&self.levels.areas[area as usize], pocket, from_tips, &mut chains);
        }
        chains
    }

    /// The areas of a tree, each after those inside it, the highest of them last.
    pub(super) fn inner_first(&self, root: u32) -> Vec<u32> {
        let clearance = |a: u32| self.levels.areas[a as usize].clearance;
        let (mut order, mut stack) = (Vec::new(), vec![root]);
        while let Some(area) = stack.pop() {
            order.push(area);
            let mut children = self.levels.areas[area as usize].children.clone();
            children.sort_by(|&a, &b| clearance(a).total_cmp(&clearance(b)).then(b.cmp(&a)));
            stack.append(&mut children);
        }
        order.reverse();
        order
    }

    /// Cuts an area's own tracks, going on from the last chain if the area holds inner ones; others may start at tips of clean-up
    /// paths.
    pub(super) fn cut_area(&self, area: &Area, pocket: usize, from_tips: bool, chains: &mut Vec<Chain>) {
        let mut left: BTreeSet<u32> = area.tracks.iter().copied().collect();
        if area.children.is_empty() {
            chains.push(self.entered(area, pocket, from_tips, &mut left));
        }
        while let Some(&first) = left.first() {
            let chain = chains.last_mut().expect("inner areas have chains");
            if let Some(step) = self.next_step(chain, &left) {
                left.remove(&step.track);
                chain.steps.push(step);
            } else {
                // No way is proven: lift and go in anew.
                left.remove(&first);
                let alone = Area { tracks: vec![first], clearance: area.clearance, ..Area::default() };
                chains.push(self.entered(&alone, pocket, from_tips, &mut BTreeSet::from([first])));
            }
        }
    }

    /// A chain whose entry is at the area's peak and whose first track is the one a step towards the wall meets; or at the
    /// tip of a clean-up path of that track.
    fn entered(&self, area: &Area, pocket: usize, from_tips: bool, left: &mut BTreeSet<u32>) -> Chain {
        let peak = self.ways.peak(area);
        let landing = peak.as_ref().and_then(|p| self.step_off(p, left));
        let track = landing.map_or(area.tracks[0], |l| l.track);
        let start = self.levels.tracks[track as usize].start;
        let at = landing.unwrap_or(Landing { track, segment: 0, point: start });
        left.remove(&track);
        let clearance = peak.as_ref().filter(|_| landing.is_some()).map(|p| p.clearance);
        let clearance = clearance.unwrap_or(self.levels.tracks[track as usize].distance);
        let entrance = self.levels.tracks[track as usize].entrance.as_ref();
        if let Some(Entrance { way, helix, cleanup, landing }) = entrance.filter(|_| from_tips) {
            let start = Start::Tip { helix: *helix, cleanup: *cleanup };
            let step = self.step(*landing, way.clone(), LinkKind::CleanUp);
            return Chain { start, clearance, steps: vec![step], pocket };
        }
        let link = match (&peak, landing) {
            (Some(p), Some(l)) if p.at != l.point => vec![Segment::line(p.at, l.point)],
            _ => Vec::new(),
        };
        let start = peak.filter(|_| landing.is_some()).map_or(Start::Track, |p| Start::Peak(p.at));
        Chain { start, clearance, steps: vec![self.step(at, link, LinkKind::Entry)], pocket }
    }

    pub(super) fn step(&self, landing: Landing, link: Vec<Segment>, kind: LinkKind) -> Step {
        let cut = self.levels.tracks[landing.track as usize].cut_from(landing);
        Step { track: landing.track, cut, link, kind }
    }

    /// Where a step from a peak straight to one of its nearest walls meets one of the `tracks`.
    fn step_off(&self, peak: &Summit, tracks: &BTreeSet<u32>) -> Option<Landing> {
        let track = &self.levels.tracks[*tracks.first()? as usize];
        peak.walls.iter().find_map(|&(site, step)| {
            let at = peak.at + step * (peak.clearance - track.distance);
            self.landing(at, site, track.level, &|t| tracks.contains(&t))
        })
    }

    /// Where a segment of a track starts.
    pub(super) fn start_of(&self, track: u32, segment: u32) -> Point {
        self.levels.tracks[track as usize].segments[segment as usize].start()
    }

    /// The track and the segment of it that cross an edge.
    pub(super) fn crossing(&self, level: usize, edge: EdgeId) -> Option<(u32, u32)> {
        let after = self.crossings.partition_point(|c| (c.0, c.1) <= (level, edge));
        let &(l, e, track, segment) = self.crossings[..after].last()?;
        ((l, e) == (level, edge)).then_some((track, segment))
    }

    /// The place on one of the tracks that `admits` lets pass, in a segment parallel to `site`, that is `at` but for rounding.
    pub(super) fn landing(
        &self,
        at: Point,
        site: SiteId,
        level: usize,
        admits: &dyn Fn(u32) -> bool,
    ) -> Option<Landing> {
        let from = self.pieces.partition_point(|p| (p.0, p.1) < (level, site));
        self.pieces[from..]
            .iter()
            .take_while(|p| (p.0, p.1) == (level, site))
            .filter(|p| admits(p.2))
            .map(|&(_, _, track, segment)| {
                let point = self.levels.tracks[track as usize].place(segment as usize, at, self.snap);
                Landing { track, segment: segment as usize, point }
            })
            .find(|l| l.point.distance(at) <= self.miss)
    }

    /// The next of the tracks `left` of an area after the last one of a chain.
    fn next_step(&self, chain: &Chain, left: &BTreeSet<u32>) -> Option<Step> {
        let last = chain.steps.last()?;
        let (from, to) = (&self.levels.tracks[last.track as usize], &self.levels.tracks[*left.first()? as usize]);
        if from.level == to.level { self.medial_step(last, left) } else { self.side_step(last, left) }
    }

    /// From a loop to one of the next level further out, straight towards the wall (step 4(b)i), from where the loop was
    /// entered or else, along it, from the first place where such a step is met by the outer loop.
    fn side_step(&self, last: &Step, left: &BTreeSet<u32>) -> Option<Step> {
        (0..last.cut.segments.len()).find_map(|k| self.side_step_from(last, k, left))
    }

    /// The side-step from the start of a segment of a cut.
    fn side_step_from(&self, last: &Step, segment: usize, left: &BTreeSet<u32>) -> Option<Step> {
        let (from, to) = (&self.levels.tracks[last.track as usize], &self.levels.tracks[*left.first()? as usize]);
        let leaving = &last.cut.segments[segment];
        let towards_wall: Vec2 = leaving.start_tangent().right();
        let at = leaving.start() + towards_wall * (from.distance - to.distance);
        let site = Some(last.cut.sites[segment]).filter(|&site| site != NONE)?;
        let landing = self.landing(at, site, to.level, &|t| left.contains(&t))?;
        let mut link = last.cut.way(segment);
        link.push(Segment::line(leaving.start(), landing.point));
        Some(self.step(landing, link, LinkKind::SideStep))
    }

    /// From a loop to another one of the same area.
    fn medial_step(&self, last: &Step, left: &BTreeSet<u32>) -> Option<Step> {
        let (way, landing) = self.ways.across(self, last, left)?;
        Some(self.step(landing, way, LinkKind::Medial))
    }
}
