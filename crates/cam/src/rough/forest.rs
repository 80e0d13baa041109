//! Which loops of a family lie around which, without a skeleton.
//!
//! An *area* is a connected part of what remains inside of an offset: an outer loop and its islands. From a point
//! of it, the nearest place on the loops of the offset before lies on the area around it: the straight way there meets no
//! other loop, and so leaves no area.

use pocketry_geom::index::SegmentIndex;
use pocketry_geom::offset::{Offset, bisector};
use pocketry_geom::{Point, Segment};

/// A closed path and what is known of it.
#[derive(Clone, Debug)]
pub(super) struct Track {
    pub(super) segments: Vec<Segment>,
    pub(super) distance: f64,
    pub(super) level: usize,
}

/// A part of what remains.
#[derive(Clone, Debug, Default)]
pub(super) struct Area {
    pub(super) tracks: Vec<usize>,
    pub(super) children: Vec<usize>,
    /// Levels inside it.
    pub(super) height: usize,
}

/// All tracks and areas; areas come after those around them.
#[derive(Clone, Debug, Default)]
pub(super) struct Forest {
    pub(super) tracks: Vec<Track>,
    pub(super) areas: Vec<Area>,
    pub(super) roots: Vec<usize>,
}

impl Forest {
    pub(super) fn new(family: &[Offset]) -> Self {
        let mut forest = Self::default();
        let mut outer = Places::default();
        for (level, offset) in family.iter().enumerate() {
            let region = bisector::remaining(offset);
            let mut places = Vec::new();
            for pocket in region.pockets() {
                let area = forest.areas.len();
                forest.areas.push(Area::default());
                for &contour in std::iter::once(&pocket.outer).chain(&pocket.islands) {
                    let segments = region.contours()[contour as usize].segments.clone();
                    places.extend(segments.iter().map(|s| (area, *s)));
                    forest.areas[area].tracks.push(forest.tracks.len());
                    forest.tracks.push(Track { segments, distance: offset.distance, level });
                }
                let start = forest.tracks[forest.areas[area].tracks[0]].segments[0].start();
                match outer.area_at(start) {
                    Some(around) => forest.areas[around].children.push(area),
                    None => forest.roots.push(area),
                }
            }
            outer = Places::new(places);
        }
        for k in (0..forest.areas.len()).rev() {
            let height = forest.areas[k].children.iter().map(|&c| forest.areas[c].height + 1).max();
            forest.areas[k].height = height.unwrap_or(0);
        }
        forest
    }

    /// The areas of a tree, each after those inside it, the highest of them last.
    pub(super) fn inner_first(&self, root: usize) -> Vec<usize> {
        let (mut order, mut stack) = (Vec::new(), vec![root]);
        while let Some(area) = stack.pop() {
            order.push(area);
            let mut children = self.areas[area].children.clone();
            children.sort_by_key(|&c| (self.areas[c].height, std::cmp::Reverse(c)));
            stack.append(&mut children);
        }
        order.reverse();
        order
    }
}

/// Where the areas of one offset are.
#[derive(Default)]
struct Places {
    areas: Vec<usize>,
    index: SegmentIndex,
}

impl Places {
    fn new(places: Vec<(usize, Segment)>) -> Self {
        let (areas, segments): (Vec<usize>, Vec<Segment>) = places.into_iter().unzip();
        Self { areas, index: SegmentIndex::new(&segments) }
    }

    fn area_at(&self, p: Point) -> Option<usize> {
        self.index.nearest(p).map(|(k, _)| self.areas[k])
    }
}
