//! The order of subpockets, and ways from one to the next without a lift.
//!
//! A pass higher than the innermost loop of a subpocket lets the tool in: that loop runs along the pass's critical edge, and
//! so does the outermost loop of the neighbour. The tool goes along the neighbour's outermost loop to the critical edge
//! and along it, all through cut material, and takes up the innermost loop there. From farther away it travels over the
//! outermost loops of subpockets between, if that is quicker than to lift and go down anew.

use super::levels::Levels;
use super::order::{Chain, Orderer, Step};
use super::{Landing, LinkKind, length_of};
use pocketry_geom::offset::voronoi::Gate;
use pocketry_geom::skeleton::trees::DisjointSets;
use pocketry_geom::subpockets::Subpockets;
use pocketry_geom::{Point, Segment};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// Subpockets that are looked at for a way to the next one, before the tool lifts.
const MOST_SEEN: usize = 64;

/// The way into a subpocket that is not cut yet.
struct Entrance<'a> {
    /// Gates passed on the way, the last one leads in.
    gates: Vec<&'a Gate>,
    into: u32,
}

/// What is cut, and what can be gone through.
struct Progress<'a> {
    subpockets: &'a Subpockets,
    /// Each subpocket's outermost area.
    roots: &'a BTreeMap<u32, u32>,
    /// The gates out of each subpocket that are higher than the first distance.
    doors: BTreeMap<u32, Vec<&'a Gate>>,
    left: BTreeSet<u32>,
    first: f64,
}

impl Orderer<'_> {
    /// Chains of all subpockets, given with their outermost areas, and of what lies in none.
    pub(super) fn subpocket_chains(
        &self,
        subpockets: &Subpockets,
        roots: &BTreeMap<u32, u32>,
        first: f64,
        longest_detour: f64,
    ) -> Vec<Chain> {
        let mut progress = Progress::new(subpockets, roots, first);
        let mut chains: Vec<Chain> = Vec::new();
        for (pocket, members) in progress.pockets(self.levels).into_iter().enumerate() {
            for fresh in members {
                let mut next = progress.left.contains(&fresh).then_some((fresh, None));
                while let Some((subpocket, way)) = next {
                    progress.left.remove(&subpocket);
                    self.cut_subpocket(roots[&subpocket], pocket, way, &mut chains);
                    next = progress.entrance(self.levels, subpocket).and_then(|e| {
                        let step = self.through(&progress, chains.last()?, &e, longest_detour)?;
                        Some((e.into, Some(step)))
                    });
                }
            }
        }
        // Channels just as wide as the tool that hang on no loop.
        let alone = self.levels.roots.clone();
        for area in alone {
            let pocket = chains.last().map_or(0, |c| c.pocket + 1);
            self.cut_area(&self.levels.areas[area as usize], pocket, false, &mut chains);
        }
        chains
    }

    /// The areas of a subpocket from the inside out; the innermost one starts a chain, unless there is a way to it.
    fn cut_subpocket(&self, root: u32, pocket: usize, way: Option<Step>, chains: &mut Vec<Chain>) {
        let mut areas = self.inner_first(root).into_iter();
        if let (Some(step), Some(chain)) = (way, chains.last_mut()) {
            areas.next();
            chain.steps.push(step);
        }
        for area in areas {
            self.cut_area(&self.levels.areas[area as usize], pocket, false, chains);
        }
    }

    /// The step over cut loops and along a critical edge to the innermost loop of the subpocket behind an entrance.
    fn through(&self, progress: &Progress<'_>, chain: &Chain, entrance: &Entrance<'_>, longest: f64) -> Option<Step> {
        let last = chain.steps.last()?;
        let mut link = Vec::new();
        let (mut track, mut from) = (last.track, last.cut.start);
        for (k, gate) in entrance.gates.iter().enumerate() {
            if k > 0 {
                track =
                    *self.levels.areas[progress.roots[&progress.subpockets.sides(gate)[0]] as usize].tracks.first()?;
            }
            let to = gate.at(progress.first);
            link.append(&mut self.way_along(track, from, to)?);
            from = to;
        }
        let length = length_of(&link);
        if entrance.gates.len() > 1 && length > longest {
            return None;
        }
        let innermost = progress.innermost(self.levels, entrance.into)?;
        let goal = &self.levels.tracks[innermost as usize];
        let point = entrance.gates.last()?.at(goal.distance);
        let segment = goal.segments.iter().position(|s| s.start() == point)?;
        if from != point {
            link.push(Segment::line(from, point));
        }
        Some(self.step(Landing { track: innermost, segment, point }, link, LinkKind::Through))
    }

    /// The shorter way along a track between two of its places, the second one the start of a segment.
    fn way_along(&self, track: u32, from: Point, to: Point) -> Option<Vec<Segment>> {
        let t = &self.levels.tracks[track as usize];
        let on = |s: &Segment| if s.start() == from { 0.0 } else { s.distance(from) };
        let segment = (0..t.segments.len()).min_by(|&a, &b| on(&t.segments[a]).total_cmp(&on(&t.segments[b])))?;
        let cut = t.cut_from(Landing { track, segment, point: from });
        let end = cut.segments.iter().position(|s| s.start() == to)?;
        Some(cut.way(end))
    }
}

impl<'a> Progress<'a> {
    fn new(subpockets: &'a Subpockets, roots: &'a BTreeMap<u32, u32>, first: f64) -> Self {
        let mut doors: BTreeMap<u32, Vec<&Gate>> = BTreeMap::new();
        for gate in subpockets.gates().iter().filter(|g| g.clearance > first) {
            let [from, to] = subpockets.sides(gate);
            if from != to {
                doors.entry(from).or_default().push(gate);
            }
        }
        Self { subpockets, roots, doors, left: roots.keys().copied().collect(), first }
    }

    /// The subpockets of each connected part of what can be reached, the highest first; those that let the tool in through
    /// a pass come last, since a neighbour will lead to them.
    fn pockets(&self, levels: &Levels) -> Vec<Vec<u32>> {
        let mut sets = DisjointSets::new(self.subpockets.list().len());
        let mut enterable = BTreeSet::new();
        for (&from, gates) in &self.doors {
            for gate in gates {
                let to = self.subpockets.sides(gate)[1];
                sets.join(from, to);
                if self.innermost(levels, to).is_some_and(|t| levels.tracks[t as usize].distance < gate.clearance) {
                    enterable.insert(to);
                }
            }
        }
        let mut pockets: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for &s in self.roots.keys() {
            pockets.entry(sets.find(s)).or_default().push(s);
        }
        let clearance = |s: u32| self.subpockets.list()[s as usize].clearance;
        for members in pockets.values_mut() {
            members.sort_by(|&a, &b| {
                enterable.contains(&a).cmp(&enterable.contains(&b)).then(clearance(b).total_cmp(&clearance(a)))
            });
        }
        pockets.into_values().collect()
    }

    /// The innermost track of a subpocket; none of an annulus, which has two.
    fn innermost(&self, levels: &Levels, subpocket: u32) -> Option<u32> {
        let mut area = &levels.areas[*self.roots.get(&subpocket)? as usize];
        while let Some(&child) = area.children.first() {
            area = &levels.areas[child as usize];
        }
        if let [only] = area.tracks[..] { Some(only) } else { None }
    }

    /// The nearest entrance, counted in gates, to a subpocket that is left, over subpockets that are cut.
    fn entrance(&self, levels: &Levels, from: u32) -> Option<Entrance<'a>> {
        let mut came: BTreeMap<u32, Option<&'a Gate>> = BTreeMap::from([(from, None)]);
        let mut queue = VecDeque::from([from]);
        while let Some(at) = queue.pop_front().filter(|_| came.len() < MOST_SEEN) {
            for &gate in self.doors.get(&at).into_iter().flatten() {
                let to = self.subpockets.sides(gate)[1];
                if self.left.contains(&to) {
                    let level = self.innermost(levels, to).map(|t| levels.tracks[t as usize].distance);
                    if level.is_some_and(|d| d < gate.clearance) {
                        return Some(Entrance { gates: self.trace(&came, gate), into: to });
                    }
                } else if self.roots.contains_key(&to) && !came.contains_key(&to) {
                    came.insert(to, Some(gate));
                    queue.push_back(to);
                }
            }
        }
        None
    }

    fn trace(&self, came: &BTreeMap<u32, Option<&'a Gate>>, last: &'a Gate) -> Vec<&'a Gate> {
        let mut gates = vec![last];
        let mut at = self.subpockets.sides(last)[0];
        while let Some(Some(gate)) = came.get(&at) {
            gates.push(gate);
            at = self.subpockets.sides(gate)[0];
        }
        gates.reverse();
        gates
    }
}
