//! Order and ways of loops without a skeleton.
//!
//! Areas are visited inner ones first; of several inner areas the highest last, so that its group goes on through the loops
//! around all of them. From loop to loop the tool goes straight: from where it is, or from the corner of its loop that is
//! nearest to any loop that comes next. A way is taken where it stays as far from the walls as the first loops; else the tool lifts.

use super::forest::{Area, Forest};
use super::job::RoughJob;
use super::level::Level;
use crate::PocketJob;
use crate::plan::{EntryKind, Group, Link, LinkKind, PlannedLoop, length_of, oriented, shorter_way};
use pocketry_geom::distance::Boundary;
use pocketry_geom::index::SegmentIndex;
use pocketry_geom::offset::Offset;
use pocketry_geom::tolerance::{LANDING, LANDING_SNAP};
use pocketry_geom::{Point, Segment, Vec2};

/// From where it is, the tool goes to loops up to so many stepovers away.
const STRAIGHT_ON: f64 = 1.5;

/// Puts a level's loops in order.
pub(super) fn order(level: &mut Level, family: &[Offset], job: &RoughJob) {
    let Some(first) = family.first() else { return };
    let forest = Forest::new(family);
    let size = level.region.bbox().size();
    let walls = Boundary::new(&level.region);
    let mut chains = Chains {
        forest: &forest,
        walls,
        least: first.distance - LANDING * size.min(first.distance),
        snap: LANDING_SNAP * size,
        job: job.pocket(level.top, level.z),
        level,
        last: None,
    };
    for (pocket, &root) in forest.roots.iter().enumerate() {
        for area in forest.inner_first(root) {
            chains.cut(&forest.areas[area], pocket);
        }
    }
}

struct Chains<'a> {
    forest: &'a Forest,
    walls: Boundary,
    /// How near to the walls ways may come, mm.
    least: f64,
    /// Nearer than this to an end of a segment, a landing is moved there, mm.
    snap: f64,
    job: PocketJob,
    level: &'a mut Level,
    /// The loop that was cut last, from where the tool is.
    last: Option<Vec<Segment>>,
}

/// A place on a track.
#[derive(Clone, Copy)]
struct Landing {
    track: usize,
    segment: usize,
    at: Point,
}

impl Chains<'_> {
    /// Cuts an area's loops, going on from the last loop if the area holds inner ones.
    fn cut(&mut self, area: &Area, pocket: usize) {
        if area.children.is_empty() {
            self.last = None;
        }
        let mut left = area.tracks.clone();
        while let Some(&track) = left.first() {
            let next = self.last.as_ref().and_then(|last| self.way(last, &left));
            let taken = if let Some((way, landing)) = next {
                self.go_on(way, landing);
                landing.track
            } else {
                self.enter(track, pocket);
                track
            };
            left.retain(|&t| t != taken);
        }
    }

    /// The way from a loop to the nearest of some tracks, if there is a clear one.
    fn way(&self, last: &[Segment], tracks: &[usize]) -> Option<(Vec<Segment>, Landing)> {
        let pieces = |t: usize| self.forest.tracks[t].segments.iter().enumerate().map(move |(k, s)| (t, k, *s));
        let places: Vec<(usize, usize, Segment)> = tracks.iter().flat_map(|&t| pieces(t)).collect();
        let index = SegmentIndex::new(&places.iter().map(|p| p.2).collect::<Vec<Segment>>());
        let (_, near) = index.nearest(last[0].start())?;
        let mut best = (0, near);
        if near > STRAIGHT_ON * self.job.stepover {
            for (k, s) in last.iter().enumerate() {
                best = index.nearest_within(s.start(), best.1).map_or(best, |(_, d)| (k, d));
            }
        }
        let from = last[best.0].start();
        let (track, segment, s) = places[index.nearest(from)?.0];
        let at = self.place(&s, from);
        let mut way = shorter_way(last, best.0);
        if at != from {
            let step = Segment::line(from, at);
            if self.walls.distance_to(&step) < self.least {
                return None;
            }
            way.push(step);
        }
        Some((way, Landing { track, segment, at }))
    }

    /// The place on a segment nearest to a point; an end where it lies next to it.
    fn place(&self, s: &Segment, p: Point) -> Point {
        let at = s.nearest(p);
        [s.start(), s.end()].into_iter().find(|e| e.distance(at) <= self.snap).unwrap_or(at)
    }

    fn go_on(&mut self, way: Vec<Segment>, landing: Landing) {
        let group = self.level.groups.len() - 1;
        let outwards = self.level.loops.last().is_some_and(|l| l.level > self.forest.tracks[landing.track].level);
        let kind = if outwards { LinkKind::SideStep } else { LinkKind::Medial };
        if !way.is_empty() {
            self.level.links.push(Link { segments: way, group, kind, to: self.level.loops.len() });
        }
        self.push(landing, group);
    }

    /// Starts a group with a track.
    fn enter(&mut self, track: usize, pocket: usize) {
        let path = &self.forest.tracks[track].segments;
        let landing = Landing { track, segment: 0, at: path[0].start() };
        let group = self.level.groups.len();
        let entry = self.entry(path);
        let start = match entry {
            EntryKind::Helix { center, radius } => center + (landing.at - center).normalized() * radius,
            EntryKind::Ramp | EntryKind::Plunge => landing.at,
        };
        if entry == EntryKind::Plunge {
            let (z, x, y, least) = (self.level.z, start.x, start.y, self.job.entry.least_ramp * self.job.tool.radius());
            let length = length_of(path);
            self.level.warnings.push(format!(
                "level z {z:.3} mm: plunge at ({x:.3}, {y:.3}): the loop there is {length:.1} mm long, {least:.1} mm would do for a ramp, \
                 and no helix fits; use a tool that cuts to its centre"
            ));
        }
        if start != landing.at {
            let segments = vec![Segment::line(start, landing.at)];
            self.level.links.push(Link { segments, group, kind: LinkKind::Entry, to: self.level.loops.len() });
        }
        let clearance = self.walls.distance(start);
        self.level.groups.push(Group { start, clearance, entry, pocket });
        self.push(landing, group);
    }

    /// The gentlest entry that there is room for: a helix in the middle of a loop, or a ramp along it.
    fn entry(&self, path: &[Segment]) -> EntryKind {
        let tool = self.job.tool.radius();
        let [least, largest] = [self.job.entry.least_helix, self.job.entry.largest_helix].map(|h| h * tool);
        let start = path[0].start();
        let center = start + path.iter().fold(Vec2::ZERO, |sum, s| sum + (s.start() - start)) / path.len() as f64;
        let room = self.walls.distance(center) - self.least;
        let clear =
            || self.walls.contains(center) && self.walls.distance_to(&Segment::line(center, start)) >= self.least;
        let reach = center.distance(start);
        let helix = if (least..=largest).contains(&reach) { reach } else { largest }.min(room);
        if helix >= least && reach > 0.0 && clear() {
            return EntryKind::Helix { center, radius: helix };
        }
        if length_of(path) >= self.job.entry.least_ramp * tool { EntryKind::Ramp } else { EntryKind::Plunge }
    }

    fn push(&mut self, landing: Landing, group: usize) {
        let track = &self.forest.tracks[landing.track];
        let segments = oriented(&from(&track.segments, landing), self.job.direction);
        self.last = Some(segments.clone());
        let (distance, level) = (track.distance, track.level);
        self.level.loops.push(PlannedLoop { segments, distance, level, group, degenerate: false });
    }
}

/// A closed path from a place on it.
fn from(path: &[Segment], landing: Landing) -> Vec<Segment> {
    let Landing { segment, at, .. } = landing;
    let order = |k: usize| (k..path.len()).chain(0..k).map(|i| path[i]);
    if at == path[segment].end() {
        return order((segment + 1) % path.len()).collect();
    }
    let mut out: Vec<Segment> = order(segment).collect();
    if at != out[0].start() {
        let (before, after) = out[0].split_at(at);
        out[0] = after;
        out.push(before);
    }
    out
}
