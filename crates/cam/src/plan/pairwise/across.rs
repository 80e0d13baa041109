//! Straight ways between the loops of an area.

use crate::plan::Landing;
use crate::plan::levels::Area;
use crate::plan::order::{Orderer, Step};
use crate::plan::ways::{Summit, Way, Ways};
use pocketry_geom::offset::{PairwiseOffsetter, degenerate_slack};
use pocketry_geom::skeleton::{NONE, SiteId};
use pocketry_geom::{BBox, Segment};
use std::cell::OnceCell;
use std::collections::BTreeSet;

/// Places of a loop from which ways are tried.
const TRIED: usize = 64;

/// Ways are looked for without a skeleton.
pub(super) struct StraightWays<'a> {
    offsetter: &'a PairwiseOffsetter<'a>,
    size: f64,
    /// For each track where parts of it begin, and their box; found when first asked for.
    starts: OnceCell<Vec<(Vec<usize>, BBox)>>,
}

impl<'a> StraightWays<'a> {
    pub(super) fn new(offsetter: &'a PairwiseOffsetter<'a>) -> Self {
        Self { offsetter, size: offsetter.size(), starts: OnceCell::new() }
    }
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
        let (starts, own) = own_starts(from, &last.cut.sites);
        let all = self.starts.get_or_init(|| {
            let tracks = &orderer.levels.tracks;
            tracks.iter().map(|t| own_starts(&t.segments, &t.sites)).collect()
        });
        let mut by_gap: Vec<(f64, u32)> = left.iter().map(|&track| (gap(own, all[track as usize].1), track)).collect();
        by_gap.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut tried: Vec<(f64, usize, Landing)> = Vec::new();
        for (gap, track) in by_gap {
            if tried.get(TRIED - 1).is_some_and(|farthest| gap > farthest.0) {
                break;
            }
            let segments = &orderer.levels.tracks[track as usize].segments;
            let places = &all[track as usize].0;
            for &k in starts.iter().step_by(starts.len().div_ceil(TRIED).max(1)) {
                let p = from[k].start();
                let some = places.iter().step_by(places.len().div_ceil(TRIED).max(1));
                let landings = some.map(|&segment| Landing { track, segment, point: segments[segment].start() });
                let nearest = landings.min_by(|a, b| a.point.distance(p).total_cmp(&b.point.distance(p)));
                let Some(nearest) = nearest else { continue };
                tried.push((nearest.point.distance(p), k, nearest));
            }
            tried.sort_by(|a, b| a.0.total_cmp(&b.0));
            tried.truncate(TRIED);
        }
        let walls = self.offsetter.boundary();
        let (_, k, landing) = tried.into_iter().find(|&(_, k, landing)| {
            let way = Segment::line(from[k].start(), landing.point);
            walls.nearest_to(&way, free).is_none()
        })?;
        let mut way = last.cut.way(k);
        way.push(Segment::line(from[k].start(), landing.point));
        Some((way, landing))
    }
}

/// Segments of a loop at whose starts a wall's part of it begins, and the box of these: where the tool enters it makes no difference.
fn own_starts(segments: &[Segment], sites: &[SiteId]) -> (Vec<usize>, BBox) {
    let mut before = NONE;
    let mut begins = |&(_, &site): &(usize, &SiteId)| site != NONE && std::mem::replace(&mut before, site) != site;
    let starts: Vec<usize> = sites.iter().enumerate().filter(&mut begins).map(|(k, _)| k).collect();
    let bbox = starts.iter().fold(BBox::EMPTY, |b, &k| b.with(segments[k].start()));
    (starts, bbox)
}

/// How far two boxes are from one another at least, mm.
fn gap(a: BBox, b: BBox) -> f64 {
    let apart = |low: f64, high: f64| (low - high).max(0.0);
    let x = apart(a.min.x, b.max.x).max(apart(b.min.x, a.max.x));
    let y = apart(a.min.y, b.max.y).max(apart(b.min.y, a.max.y));
    x.hypot(y)
}
