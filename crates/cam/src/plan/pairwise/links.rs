//! Fibres' ends joined to pieces.

use super::fibres::Fibre;
use super::ranges::bits;
use crate::plan::cleanup::{CANDIDATES, Exit, Piece, Place, Way};
use pocketry_geom::skeleton::trees::DisjointSets;
use pocketry_geom::{Point, Segment};
use std::collections::{BTreeMap, HashMap, HashSet};

/// Rounds of joining: each at least halves the number of parts that lie close to others.
const ROUNDS: usize = 16;

/// Share of the allowance within which places are merged.
const MERGED: f64 = 0.125;

/// A clean-up curve with its fibres in order.
pub(super) struct Curve {
    pub(super) fibres: Vec<Fibre>,
    /// The degenerate vertices where it starts and ends; none where the last fibre is followed by the first.
    pub(super) roots: Option<[Point; 2]>,
}

/// How far a place is, and which it is.
type Nearest = Option<(f64, u32)>;

/// Gathers places and ways.
pub(super) struct Builder {
    low: f64,
    /// Added to every reach.
    allowance: f64,
    /// The longest way that may join two parts: no wall is as near to them.
    gap: f64,
    places: Vec<Place>,
    /// The fibre of each place that has one.
    fibres: Vec<Option<Fibre>>,
    ways: Vec<Way>,
    /// The chain of each place, by its number.
    chains: Vec<u32>,
    /// Places where chains end.
    ends: Vec<u32>,
    /// Degenerate vertices with their places.
    roots: Vec<(u32, Point)>,
    known: HashSet<(u64, u64)>,
}

impl Builder {
    pub(super) fn new(low: f64, allowance: f64, radius: f64) -> Self {
        let (places, fibres, ways, chains, ends) = (Vec::new(), Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let (roots, known) = (Vec::new(), HashSet::new());
        Self { low, allowance, gap: radius, places, fibres, ways, chains, ends, roots, known }
    }

    /// How far from a place of this clearance the points may lie that it answers for. Where fibres end for the inner loop's
    /// sake, at the clearance `high`, that loop answers for them.
    fn reach(&self, clearance: f64, high: f64) -> f64 {
        if clearance < high { (clearance - self.low).max(0.0) + self.allowance } else { -1.0 }
    }

    /// Adds a place to the chain that `before` belongs to, or to a new one.
    fn add_place(&mut self, at: Point, reach: f64, fibre: Option<Fibre>, before: Option<u32>) -> u32 {
        let place = self.places.len() as u32;
        self.places.push(Place { at, reach });
        self.fibres.push(fibre);
        self.chains.push(before.map_or(place, |k| self.chains[k as usize]));
        place
    }

    fn join(&mut self, a: u32, b: u32) {
        let [from, to] = [a, b].map(|k| self.places[k as usize].at);
        self.ways.push(Way { ends: [a, b], segment: Segment::line(from, to) });
    }

    /// The chains of those fibres of a curve that count, and its degenerate vertices, of clearance `high`.
    pub(super) fn add(&mut self, curve: &Curve, high: f64) {
        curve.roots.into_iter().flatten().for_each(|at| self.add_root(at, high));
        let mut chain: Option<u32> = None;
        let begun = self.places.len() as u32;
        for fibre in &curve.fibres {
            if !fibre.first {
                self.ends.extend(chain.take());
                continue;
            }
            match chain {
                Some(k) if self.places[k as usize].at.distance(fibre.end) <= MERGED * self.allowance => {
                    let reach = self.reach(fibre.clearance, high);
                    self.places[k as usize].reach = self.places[k as usize].reach.max(reach);
                }
                _ => {
                    let next = self.add_place(fibre.end, self.reach(fibre.clearance, high), Some(*fibre), chain);
                    match chain {
                        Some(k) => self.join(k, next),
                        None => self.ends.push(next),
                    }
                    chain = Some(next);
                }
            }
        }
        self.ends.extend(chain);
        let ring = curve.roots.is_none() && curve.fibres.iter().all(|f| f.first);
        if let Some(last) = chain.filter(|&last| ring && last > begun + 1) {
            self.join(last, begun);
        }
    }

    fn add_root(&mut self, at: Point, clearance: f64) {
        if self.known.insert(bits(at)) {
            let place = self.add_place(at, self.reach(clearance, clearance), None, None);
            self.roots.push((place, at));
            self.ends.push(place);
        }
    }

    /// The pieces; `starts` says which segment of an inner loop starts at a degenerate vertex, `base` is the distance of the
    /// outer loops.
    pub(super) fn pieces(mut self, base: f64, starts: &HashMap<(u64, u64), (u32, u32)>) -> Vec<Piece> {
        let mut sets = DisjointSets::new(self.places.len());
        for way in &self.ways {
            sets.join(way.ends[0], way.ends[1]);
        }
        for _ in 0..ROUNDS {
            if !self.link(&mut sets) {
                break;
            }
        }
        let mut members: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for k in 0..self.places.len() as u32 {
            members.entry(sets.find(k)).or_default().push(k);
        }
        let mut place_of = vec![0; self.places.len()];
        let mut pieces: BTreeMap<u32, Piece> = BTreeMap::new();
        for (&set, members) in &members {
            let places = members.iter().map(|&k| self.places[k as usize]).collect();
            members.iter().zip(0..).for_each(|(&k, new)| place_of[k as usize] = new);
            pieces.insert(set, Piece { least: self.low, places, ..Piece::default() });
        }
        for way in &self.ways {
            if let Some(piece) = pieces.get_mut(&sets.find(way.ends[0])) {
                piece.least = piece.least.min(self.least_on(way));
                piece.ways.push(Way { ends: way.ends.map(|e| place_of[e as usize]), segment: way.segment });
            }
        }
        for (place, at) in &self.roots {
            if let (Some(piece), Some(&start)) = (pieces.get_mut(&sets.find(*place)), starts.get(&bits(*at))) {
                piece.roots.push((place_of[*place as usize], start));
            }
        }
        for (set, members) in &members {
            if let Some(piece) = pieces.get_mut(set).filter(|p| p.roots.is_empty()) {
                for &k in members.iter().step_by(members.len().div_ceil(CANDIDATES)) {
                    let exit =
                        |f: Fibre| Exit { place: place_of[k as usize], site: f.site, at: f.foot + f.normal * base };
                    piece.exits.extend(self.fibres[k as usize].map(exit));
                }
            }
        }
        // Tips alone lie where the outer loop cuts.
        let least = (1.0 + MERGED) * self.allowance;
        pieces.into_values().filter(|p| p.places.iter().any(|place| place.reach > least)).collect()
    }

    /// The least clearance on a way: it falls no faster than way is made from both ends.
    fn least_on(&self, way: &Way) -> f64 {
        let fallen = |place: u32| (self.places[place as usize].reach - self.allowance).max(0.0);
        self.low + 0.5 * (fallen(way.ends[0]) + fallen(way.ends[1]) - way.segment.length())
    }

    /// Whether a place is where a branch comes down to the lower clearance: nothing goes on from there. Tips of a fan of
    /// branches lie nearer to one another than to the trunk from which they come.
    fn is_tip(&self, place: u32) -> bool {
        self.fibres[place as usize].is_some_and(|f| f.clearance <= self.low + MERGED * self.allowance)
    }

    /// Joins parts to the nearest others within the gap. An end of a part that has a root is done with when the nearest
    /// place of another chain is of the same part: what is near it belongs to other roots.
    fn link(&mut self, sets: &mut DisjointSets) -> bool {
        let open: Vec<u32> = (0..self.places.len() as u32).filter(|&k| !self.is_tip(k)).collect();
        let grid = Grid::new(self.gap, open.iter().map(|&k| (k, self.places[k as usize].at)));
        let rooted: HashSet<u32> = self.roots.iter().map(|r| sets.find(r.0)).collect();
        let mut found: Vec<(f64, u32, u32)> = Vec::new();
        for &end in self.ends.iter().filter(|&&k| !self.is_tip(k)) {
            let (own, at) = (sets.find(end), self.places[end as usize].at);
            let chain = self.chains[end as usize];
            let (mut other_part, mut other_chain) = (Nearest::None, Nearest::None);
            grid.visit(at, |k| {
                let far = self.places[k as usize].at.distance(at);
                let is_nearer = |best: Nearest| far <= best.map_or(self.gap, |b| b.0);
                if self.chains[k as usize] == chain || !is_nearer(other_part) {
                    return;
                }
                if is_nearer(other_chain) {
                    other_chain = Some((far, k));
                }
                if sets.find(k) != own {
                    other_part = Some((far, k));
                }
            });
            let is_done = rooted.contains(&own) && other_chain.is_some_and(|(_, k)| sets.find(k) == own);
            found.extend(other_part.filter(|_| !is_done).map(|(far, k)| (far, end, k)));
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut joined = false;
        for (_, a, b) in found {
            if sets.find(a) != sets.find(b) {
                sets.join(a, b);
                self.join(a, b);
                joined = true;
            }
        }
        joined
    }
}

/// Places in square cells.
struct Grid {
    size: f64,
    cells: HashMap<(i64, i64), Vec<u32>>,
}

impl Grid {
    fn new(size: f64, places: impl Iterator<Item = (u32, Point)>) -> Self {
        let mut grid = Self { size, cells: HashMap::new() };
        for (k, at) in places {
            grid.cells.entry(grid.cell(at)).or_default().push(k);
        }
        grid
    }

    fn cell(&self, p: Point) -> (i64, i64) {
        ((p.x / self.size).floor() as i64, (p.y / self.size).floor() as i64)
    }

    /// Calls `found` for all places within a cell's size of a point, and some more.
    fn visit(&self, p: Point, mut found: impl FnMut(u32)) {
        let (x, y) = self.cell(p);
        for cell in (-1..=1).flat_map(|i| (-1..=1).map(move |j| (x + i, y + j))) {
            self.cells.get(&cell).into_iter().flatten().for_each(|&k| found(k));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pocketry_geom::vec2;

    /// Tips of branches are where the envelope turns, and clearance there is that of the envelope but for rounding. Hundreds of
    /// spokes of 0.03 mm were made of them in a die cavity.
    #[test]
    fn a_tip_alone_is_no_piece() {
        let fibre = |clearance: f64, first: bool| {
            let (foot, normal) = (Point::ORIGIN, vec2(0.0, 1.0));
            Fibre { site: 0, foot, normal, end: foot + normal * clearance, clearance, first }
        };
        for (clearance, count) in [(5.0 + 1e-11, 0), (5.5, 1)] {
            let mut builder = Builder::new(5.0, 0.02, 5.0);
            let fibres = vec![fibre(6.0, false), fibre(clearance, true), fibre(6.0, false)];
            builder.add(&Curve { fibres, roots: None }, 10.0);
            assert_eq!(builder.pieces(0.0, &HashMap::new()).len(), count, "{clearance}");
        }
    }
}
