//! Closed paths of the tool's axis, before and after it is known where the tool enters them.

use pocketry_geom::offset::{DegeneratePath, OffsetLoop};
use pocketry_geom::skeleton::{EdgeId, NONE, SiteId};
use pocketry_geom::{Point, Segment};

/// A loop of an offset, or the tour of a degenerate path: closed, the walls to the right.
#[derive(Clone, Debug, Default)]
pub(crate) struct Track {
    /// Lines and arcs; none where the path is a point.
    pub(crate) segments: Vec<Segment>,
    /// For each segment its site, `NONE` on degenerate paths.
    pub(crate) sites: Vec<SiteId>,
    /// For each segment the half-edge at whose crossing it starts, or `NONE`.
    pub(crate) crossings: Vec<EdgeId>,
    /// A point of it.
    pub(crate) start: Point,
    /// Distance from the walls, mm.
    pub(crate) distance: f64,
    /// Number of the distance.
    pub(crate) level: usize,
    /// Whether it is a degenerate path on its own.
    pub(crate) degenerate: bool,
}

/// A place on a track where the tool enters it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Landing {
    pub(crate) track: u32,
    pub(crate) segment: usize,
    pub(crate) point: Point,
}

/// A track from where the tool enters it, once round.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cut {
    pub(crate) segments: Vec<Segment>,
    pub(crate) crossings: Vec<EdgeId>,
    pub(crate) start: Point,
}

impl Track {
    pub(crate) fn of_loop(found: OffsetLoop, distance: f64, level: usize) -> Self {
        let start = found.contour.segments[0].start();
        let OffsetLoop { contour, sites, crossings } = found;
        Self { segments: contour.segments, sites, crossings, start, distance, level, degenerate: false }
    }

    pub(crate) fn of_path(path: DegeneratePath, distance: f64) -> Self {
        let none = vec![NONE; path.tour.len()];
        Self {
            segments: path.tour,
            sites: none.clone(),
            crossings: none,
            start: path.start,
            distance,
            level: 0,
            degenerate: true,
        }
    }

    /// Inserts the tour of a degenerate path at the crossing it hangs on; gives it back where there is none.
    pub(crate) fn splice(&mut self, path: DegeneratePath) -> Option<DegeneratePath> {
        let at = self.crossings.iter().position(|&c| Some(c) == path.attached);
        let Some(at) = at.filter(|&at| self.segments[at].start() == path.start) else { return Some(path) };
        let count = path.tour.len();
        self.segments.splice(at..at, path.tour);
        self.sites.splice(at..at, std::iter::repeat_n(NONE, count));
        // The crossing stays with the segment after the tour.
        self.crossings.splice(at..at, std::iter::repeat_n(NONE, count));
        None
    }

    /// The place on a segment nearest to `at`; the segment's own end where it lies within `snap` of it.
    pub(crate) fn place(&self, segment: usize, at: Point, snap: f64) -> Point {
        let s = &self.segments[segment];
        let ends = [s.start(), s.end()];
        let p = s.nearest(at);
        ends.into_iter().find(|e| e.distance(p) <= snap).unwrap_or(p)
    }

    /// The track as travelled from a landing.
    pub(crate) fn cut_from(&self, landing: Landing) -> Cut {
        if self.segments.is_empty() {
            return Cut { segments: Vec::new(), crossings: Vec::new(), start: self.start };
        }
        let (k, p) = (landing.segment, landing.point);
        let order = (k..self.segments.len()).chain(0..k);
        let mut segments: Vec<Segment> = order.clone().map(|i| self.segments[i]).collect();
        let mut crossings: Vec<EdgeId> = order.map(|i| self.crossings[i]).collect();
        if p == segments[0].end() {
            segments.rotate_left(1);
            crossings.rotate_left(1);
        } else if p != segments[0].start() {
            let (before, after) = segments[0].split_at(p);
            segments[0] = after;
            segments.push(before);
            crossings[0] = NONE;
            crossings.push(NONE);
        }
        Cut { segments, crossings, start: p }
    }
}

impl Cut {
    /// Length, mm.
    pub(crate) fn length(&self) -> f64 {
        self.segments.iter().map(Segment::length).sum()
    }

    /// The way along the cut from its start to the start of segment `to`, the shorter way round.
    pub(crate) fn way(&self, to: usize) -> Vec<Segment> {
        let (ahead, behind) = self.segments.split_at(to);
        let length = |s: &[Segment]| s.iter().map(Segment::length).sum::<f64>();
        if length(ahead) <= length(behind) {
            ahead.to_vec()
        } else {
            behind.iter().rev().map(Segment::reversed).collect()
        }
    }
}
