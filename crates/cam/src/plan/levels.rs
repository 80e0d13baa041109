//! The loops at all distances and the areas they bound.
//!
//! An *area* is a connected part of the set of points whose clearance is above a level's distance. Areas of successive
//! levels nest: they make a forest, whose leaves hold one distinguishable peak each. Which area a loop bounds
//! follows from the skeleton: vertices above the distance that are joined by edges above it lie in the same area.

use super::{PlanError, Track};
use pocketry_geom::offset::{Degenerate, OffsetOptions, VoronoiOffsetter, upward};
use pocketry_geom::skeleton::trees::DisjointSets;
use pocketry_geom::skeleton::{EdgeId, Skeleton, VertexId};
use std::collections::BTreeMap;

/// A connected part of the points above a level's distance, or a degenerate path on its own.
#[derive(Clone, Debug, Default)]
pub(crate) struct Area {
    /// The tracks that bound it.
    pub(crate) tracks: Vec<u32>,
    /// The areas of the next level inside it.
    pub(crate) children: Vec<u32>,
    /// Its vertex of largest clearance; none for a degenerate path.
    pub(crate) peak: Option<VertexId>,
    /// Clearance there, mm.
    pub(crate) clearance: f64,
}

/// All tracks and areas.
#[derive(Clone, Debug, Default)]
pub(crate) struct Levels {
    pub(crate) tracks: Vec<Track>,
    pub(crate) areas: Vec<Area>,
    /// The areas of the first level.
    pub(crate) roots: Vec<u32>,
}

impl Levels {
    /// The loops at these increasing distances; degenerate paths at the first.
    pub(crate) fn new(skeleton: &Skeleton, distances: &[f64]) -> Result<Self, PlanError> {
        let offsetter = VoronoiOffsetter::new(skeleton);
        let mut levels = Self::default();
        let mut flood = Flood::new(skeleton);
        let mut inner: Vec<u32> = Vec::new();
        for (level, &d) in distances.iter().enumerate().rev() {
            let degenerate = if level == 0 { Degenerate::Keep } else { Degenerate::Drop };
            let offset = offsetter.offset(d, &OffsetOptions { degenerate })?;
            flood.fall_to(d);
            let mut of_root: BTreeMap<VertexId, u32> = BTreeMap::new();
            for found in offset.loops {
                let root = flood.sets.find(skeleton.target(found.crossings[0]));
                let area = *of_root
                    .entry(root)
                    .or_insert_with(|| levels.add_area(Some(flood.highest[root as usize]), skeleton));
                levels.areas[area as usize].tracks.push(levels.tracks.len() as u32);
                levels.tracks.push(Track::of_loop(found, d, level));
            }
            for child in std::mem::take(&mut inner) {
                let peak = levels.areas[child as usize].peak.expect("areas with loops have a peak");
                match of_root.get(&flood.sets.find(peak)) {
                    Some(&area) => levels.areas[area as usize].children.push(child),
                    None => levels.roots.push(child),
                }
            }
            inner = of_root.into_values().collect();
            inner.sort_unstable();
            for path in offset.degenerate {
                levels.add_path(path, d);
            }
        }
        levels.roots.append(&mut inner);
        levels.roots.sort_unstable();
        Ok(levels)
    }

    fn add_area(&mut self, peak: Option<VertexId>, skeleton: &Skeleton) -> u32 {
        let clearance = peak.map_or(0.0, |v| skeleton.vertices()[v as usize].clearance);
        self.areas.push(Area { peak, clearance, ..Area::default() });
        self.areas.len() as u32 - 1
    }

    /// A degenerate path becomes a detour of the loop it hangs on, or an area of its own.
    pub(super) fn add_path(&mut self, mut path: pocketry_geom::offset::DegeneratePath, d: f64) {
        if path.attached.is_some() {
            for track in self.tracks.iter_mut().filter(|t| t.level == 0) {
                match track.splice(path) {
                    Some(back) => path = back,
                    None => return,
                }
            }
        }
        let tracks = vec![self.tracks.len() as u32];
        self.tracks.push(Track::of_path(path, d));
        self.roots.push(self.areas.len() as u32);
        self.areas.push(Area { tracks, clearance: d, ..Area::default() });
    }
}

/// Vertices joined by edges above a falling clearance.
struct Flood<'a> {
    skeleton: &'a Skeleton,
    /// Edges by the clearance of their lower end, highest last.
    edges: Vec<(f64, EdgeId)>,
    sets: DisjointSets,
    /// For the representative of each set its vertex of largest clearance.
    highest: Vec<VertexId>,
}

impl<'a> Flood<'a> {
    fn new(skeleton: &'a Skeleton) -> Self {
        let mut edges: Vec<(f64, EdgeId)> = (0..skeleton.edge_count() as EdgeId)
            .map(|k| upward(skeleton, 2 * k))
            .map(|e| (skeleton.origin_clearance(e), e))
            .collect();
        edges.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
        let count = skeleton.vertices().len();
        Self { skeleton, edges, sets: DisjointSets::new(count), highest: (0..count as VertexId).collect() }
    }

    /// Joins the ends of every edge that lies above `d`.
    fn fall_to(&mut self, d: f64) {
        while let Some(&(low, e)) = self.edges.last().filter(|(low, _)| *low > d) {
            debug_assert!(low > d);
            self.edges.pop();
            let (a, b) = (self.sets.find(self.skeleton.origin(e)), self.sets.find(self.skeleton.target(e)));
            let (a_top, b_top) = (self.highest[a as usize], self.highest[b as usize]);
            self.sets.join(a, b);
            let clearance = |v: VertexId| self.skeleton.vertices()[v as usize].clearance;
            let top = if clearance(a_top) >= clearance(b_top) { a_top } else { b_top };
            let root = self.sets.find(a);
            self.highest[root as usize] = top;
        }
    }
}
