//! What an engine knows of a region beyond its loops: where to go down, and ways from loop to loop.

use super::Landing;
use super::levels::Area;
use super::order::{Orderer, Step};
use crate::link::{Fans, medial_way, towards};
use pocketry_geom::skeleton::{EdgeId, SiteId, Skeleton};
use pocketry_geom::{BBox, Point, Segment, Vec2};
use std::collections::BTreeSet;

/// A way and where it leads.
pub(super) type Way = (Vec<Segment>, Landing);

/// A place of largest clearance.
#[derive(Clone, Debug)]
pub(super) struct Summit {
    pub(super) at: Point,
    pub(super) clearance: f64,
    /// Its nearest walls: their sites and unit vectors towards them.
    pub(super) walls: Vec<(SiteId, Vec2)>,
}

/// An engine's knowledge.
pub(super) trait Ways {
    /// Size of what the loops lie in, mm.
    fn size(&self) -> f64;

    /// Where an area is highest, if that is known.
    fn peak(&self, area: &Area) -> Option<Summit>;

    /// A short way, clear of walls, from the last loop to one of the tracks `left`, which bound the same area.
    fn across(&self, orderer: &Orderer<'_>, last: &Step, left: &BTreeSet<u32>) -> Option<Way>;
}

/// Ways along the skeleton.
pub(super) struct SkeletonWays<'a> {
    pub(super) skeleton: &'a Skeleton,
    pub(super) fans: Fans<'a>,
}

impl<'a> SkeletonWays<'a> {
    pub(super) fn new(skeleton: &'a Skeleton) -> Self {
        Self { skeleton, fans: Fans::new(skeleton) }
    }
}

impl Ways for SkeletonWays<'_> {
    fn size(&self) -> f64 {
        self.skeleton.vertices().iter().fold(BBox::EMPTY, |b, v| b.with(v.point)).size()
    }

    fn peak(&self, area: &Area) -> Option<Summit> {
        let v = area.peak?;
        let vertex = self.skeleton.vertices()[v as usize];
        let sites = self.fans.around(v).map(|e| self.skeleton.site(e));
        let walls = sites.map(|s| (s, towards(self.skeleton.sites()[s as usize].shape, vertex.point))).collect();
        Some(Summit { at: vertex.point, clearance: vertex.clearance, walls })
    }

    fn across(&self, orderer: &Orderer<'_>, last: &Step, left: &BTreeSet<u32>) -> Option<Way> {
        let track = &orderer.levels.tracks[last.track as usize];
        let place = |e: EdgeId| orderer.crossing(track.level, e).filter(|(t, _)| left.contains(t));
        let (way, edge) = medial_way(&self.fans, &last.cut, track.distance, &|e| place(e).is_some())?;
        let (track, segment) = place(edge)?;
        let point = orderer.start_of(track, segment);
        Some((way, Landing { track, segment: segment as usize, point }))
    }
}
