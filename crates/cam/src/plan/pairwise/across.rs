//! Straight ways between the loops of an area.

use crate::plan::Landing;
use crate::plan::levels::Area;
use crate::plan::order::{Orderer, Step};
use crate::plan::ways::{Summit, Way, Ways};
use pocketry_geom::Segment;
use pocketry_geom::offset::{PairwiseOffsetter, degenerate_slack};
use std::collections::BTreeSet;

/// Places of a loop from which ways are tried.
const TRIED: usize = 64;

/// Ways are looked for without a skeleton.
pub(super) struct StraightWays<'a> {
    pub(super) offsetter: &'a PairwiseOffsetter<'a>,
    pub(super) size: f64,
}

impl Ways for StraightWays<'_> {
    fn size(&self) -> f64 {
        self.size
    }

    fn peak(&self, _: &Area) -> Option<Summit> {
        None
    }

    /// Along the last loop to where a straight way, no nearer to walls than the loops, leads to another one: the shortest of
    /// some.
    fn across(&self, orderer: &Orderer<'_>, last: &Step, left: &BTreeSet<u32>) -> Option<Way> {
        let from = &last.cut.segments;
        let distance = orderer.levels.tracks[last.track as usize].distance;
        let free = distance - degenerate_slack(distance);
        let mut tried: Vec<(f64, usize, Landing)> = Vec::new();
        for &track in left {
            let segments = &orderer.levels.tracks[track as usize].segments;
            for k in (0..from.len()).step_by(from.len().div_ceil(TRIED)) {
                let p = from[k].start();
                let places = (0..segments.len()).step_by(segments.len().div_ceil(TRIED));
                let landings = places.map(|segment| Landing { track, segment, point: segments[segment].start() });
                let nearest = landings.min_by(|a, b| a.point.distance(p).total_cmp(&b.point.distance(p)))?;
                tried.push((nearest.point.distance(p), k, nearest));
            }
        }
        tried.sort_by(|a, b| a.0.total_cmp(&b.0));
        let walls = self.offsetter.boundary();
        let (_, k, landing) = tried.into_iter().take(TRIED).find(|&(_, k, landing)| {
            let way = Segment::line(from[k].start(), landing.point);
            walls.nearest_to(&way, free).is_none()
        })?;
        let mut way = last.cut.way(k);
        way.push(Segment::line(from[k].start(), landing.point));
        Some((way, landing))
    }
}
