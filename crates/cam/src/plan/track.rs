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
    /// How the tool may come in where it starts with this track.
    pub(crate) entrance: Option<Entrance>,
}

/// A detour of a track by which the tool may come in.
#[derive(Clone, Debug)]
pub(crate) struct Entrance {
    /// From the detour's tip to the track.
    pub(crate) way: Vec<Segment>,
    /// Radius of the helix down to the tip, mm.
    pub(crate) helix: f64,
    /// Which clean-up path it is.
    pub(crate) cleanup: usize,
    /// Where on the track it leads.
    pub(crate) landing: Landing,
}

/// The tip of a tour. The tool that comes in there need not travel what lies before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tip {
    /// The tour's segment that starts there.
    pub(crate) segment: usize,
    /// Clearance, at the least, mm.
    pub(crate) clearance: f64,
}

/// A tour from a point of a track and back to it.
#[derive(Clone, Debug)]
pub(crate) struct Insertion {
    /// The segment on which it starts.
    pub(crate) segment: usize,
    /// Where; `None` for the segment's start.
    pub(crate) at: Option<Point>,
    pub(crate) tour: Vec<Segment>,
    /// Clearance on the tour, at the least, mm.
    pub(crate) clearance: f64,
    /// Where the tool may come in.
    pub(crate) tip: Option<Tip>,
}

impl Insertion {
    /// mm.
    pub(crate) fn length(&self) -> f64 {
        length_of(&self.tour)
    }
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
    /// For each segment its site, `NONE` on degenerate paths.
    pub(crate) sites: Vec<SiteId>,
    pub(crate) crossings: Vec<EdgeId>,
    pub(crate) start: Point,
    /// Number of the track's segment that the first one is, or the end of it: then the rest of that comes last.
    pub(crate) from: usize,
}

impl Track {
    pub(crate) fn of_loop(found: OffsetLoop, distance: f64, level: usize) -> Self {
        let start = found.contour.segments[0].start();
        let OffsetLoop { contour, sites, crossings } = found;
        Self { segments: contour.segments, sites, crossings, start, distance, level, ..Self::default() }
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
            entrance: None,
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

    /// How many segments the tours that start at the end of segment `k` have. They come last where the tool enters there:
    /// the segment after them is parallel to a wall. Critical edges have no site either, but do not come back.
    fn tours_after(&self, k: usize) -> usize {
        let (n, at) = (self.segments.len(), self.segments[k].end());
        let without_site = (1..n).take_while(|i| self.sites[(k + i) % n] == NONE);
        without_site.filter(|i| self.segments[(k + i) % n].end() == at).last().unwrap_or(0)
    }

    /// The track as travelled from a landing.
    pub(crate) fn cut_from(&self, landing: Landing) -> Cut {
        if self.segments.is_empty() {
            return Cut { start: self.start, ..Cut::default() };
        }
        let (k, p) = (landing.segment, landing.point);
        let order = (k..self.segments.len()).chain(0..k);
        let mut segments: Vec<Segment> = order.clone().map(|i| self.segments[i]).collect();
        let mut sites: Vec<SiteId> = order.clone().map(|i| self.sites[i]).collect();
        let mut crossings: Vec<EdgeId> = order.map(|i| self.crossings[i]).collect();
        let mut from = k;
        if p == segments[0].end() {
            let tour = self.tours_after(k);
            from = (k + 1 + tour) % self.segments.len();
            segments.rotate_left(1 + tour);
            sites.rotate_left(1 + tour);
            crossings.rotate_left(1 + tour);
        } else if p != segments[0].start() {
            let (before, after) = segments[0].split_at(p);
            segments[0] = after;
            segments.push(before);
            sites.push(sites[0]);
            crossings[0] = NONE;
            crossings.push(NONE);
        }
        Cut { segments, sites, crossings, start: p, from }
    }
}

impl Cut {
    /// Length, mm.
    pub(crate) fn length(&self) -> f64 {
        length_of(&self.segments)
    }

    /// The way along the cut from its start to the start of segment `to`, the shorter way round.
    pub(crate) fn way(&self, to: usize) -> Vec<Segment> {
        shorter_way(&self.segments, to)
    }
}

/// The length of a path, mm.
pub(crate) fn length_of(path: &[Segment]) -> f64 {
    path.iter().map(Segment::length).sum()
}

/// The way along a closed path from its start to the start of segment `to`, the shorter way round.
pub(crate) fn shorter_way(path: &[Segment], to: usize) -> Vec<Segment> {
    let (ahead, behind) = path.split_at(to);
    if length_of(ahead) <= length_of(behind) {
        ahead.to_vec()
    } else {
        behind.iter().rev().map(Segment::reversed).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pocketry_geom::point;

    /// A track through points, with segments that have no site.
    fn track(points: &[[f64; 2]], without_site: &[usize]) -> Track {
        let at = |k: usize| point(points[k % points.len()][0], points[k % points.len()][1]);
        let n = points.len();
        let site = |k: usize| if without_site.contains(&k) { NONE } else { k as SiteId };
        Track {
            segments: (0..n).map(|k| Segment::line(at(k), at(k + 1))).collect(),
            sites: (0..n).map(site).collect(),
            crossings: vec![NONE; n],
            start: at(0),
            ..Track::default()
        }
    }

    fn entered_at_end_of(track: &Track, segment: usize) -> Cut {
        track.cut_from(Landing { track: 0, segment, point: track.segments[segment].end() })
    }

    #[test]
    fn a_tour_at_the_entry_comes_last() {
        let track = track(&[[0.0, 0.0], [9.0, 0.0], [4.0, 4.0], [9.0, 0.0], [9.0, 9.0]], &[1, 2]);
        let cut = entered_at_end_of(&track, 0);
        assert_eq!((cut.start, cut.segments[0]), (point(9.0, 0.0), track.segments[3]));
        assert_eq!(cut.segments[4], track.segments[2]);
    }

    #[test]
    fn critical_edges_after_the_entry_are_no_tour() {
        // Between neighbours: up to one critical edge, along it and along the next, which meet near the passes' centre.
        let track = track(&[[0.0, 0.0], [9.0, 0.0], [5.0, 4.0], [0.0, 9.0]], &[1, 2]);
        let cut = entered_at_end_of(&track, 0);
        assert_eq!((cut.start, cut.segments[0]), (point(9.0, 0.0), track.segments[1]));
        assert_eq!(cut.segments[0].start(), cut.start);
    }
}
