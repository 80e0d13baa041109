//! Step 5: clean-up paths become parts of the loops as they are travelled, as smooth as can be.

use super::bulge::{Bulge, Corner, Spot};
use super::rounded::{Room, circle_about, drop_around};
use super::{Cleanup, Gathered, trusted};
use crate::job::PocketJob;
use crate::plan::levels::Levels;
use crate::plan::order::{Chain, Start};
use crate::plan::track::{Cut, Entrance, Insertion, Landing, length_of};
use pocketry_geom::{Point, Segment};

/// Share of the loop between two clean-up paths that the bulges of both may replace, each.
const REPLACED: f64 = 0.45;

/// Share of what the clearance at a tip exceeds the first distance that the radius of a helix there may be: half of it, less
/// what ways may stray from where clearance is known.
const TIP_ROOM: f64 = 0.35;

/// A way in is at least so many times the tool's radius long.
const WORTH: f64 = 0.5;

/// Lets chains start at tips of clean-up paths: for each loop that of the path whose way in is longest, where there is room to go
/// down, and it pays. The first loops lie at the distance `first`.
pub(crate) fn mark_entrances(levels: &mut Levels, gathered: &Gathered, job: &PocketJob, first: f64) {
    for (cleanup, &(number, ref insertion)) in gathered.insertions.iter().enumerate() {
        let track = &mut levels.tracks[number as usize];
        let Some(tip) = insertion.tip else { continue };
        let Some(helix) = tip_helix(tip.clearance, job, first) else { continue };
        let way = &insertion.tour[tip.segment..];
        let longest = track.entrance.as_ref().map_or(0.0, |e| length_of(&e.way));
        if length_of(way) > longest.max(WORTH * job.tool.radius()) {
            let point = insertion.at.unwrap_or(track.segments[insertion.segment].start());
            let landing = Landing { track: number, segment: insertion.segment, point };
            track.entrance = Some(Entrance { way: way.to_vec(), helix, cleanup, landing });
        }
    }
}

/// The radius of a helix that ends at the tip of a way, where there is room for one: it stays within its diameter of the tip.
fn tip_helix(clearance: f64, job: &PocketJob, first: f64) -> Option<f64> {
    let room = TIP_ROOM * (clearance - first);
    let [least, largest] = [job.entry.least_helix, job.entry.largest_helix].map(|share| share * job.tool.radius());
    (room >= least).then(|| room.min(largest))
}

/// Hangs clean-up paths on the loops of chains.
pub(crate) fn hang(
    chains: &mut [Chain],
    gathered: Gathered,
    levels: &Levels,
    job: &PocketJob,
    first: f64,
) -> Vec<Cleanup> {
    let Gathered { insertions, mut cleanups } = gathered;
    let mut of_track: Vec<Vec<Hung>> = vec![Vec::new(); levels.tracks.len()];
    for (cleanup, (track, insertion)) in insertions.into_iter().enumerate() {
        of_track[track as usize].push(Hung { cleanup, along: 0.0, insertion });
    }
    let radius = trusted(job.tool.radius());
    for chain in chains {
        let mut entrance = if let Start::Tip { cleanup, .. } = chain.start { Some(cleanup) } else { None };
        for step in &mut chain.steps {
            let track = step.track as usize;
            let mut hung = std::mem::take(&mut of_track[track]);
            if let Some(entrance) = entrance.take() {
                cleanups[entrance].length = length_of(&step.link);
                hung.retain(|h| h.cleanup != entrance);
            }
            if !hung.is_empty() {
                let (count, distance) = (levels.tracks[track].segments.len(), levels.tracks[track].distance);
                let mut hanging = Hanging { cut: &step.cut, count, radius, distance, first, cleanups: &mut cleanups };
                step.cut.segments = hanging.path(hung);
            }
        }
    }
    cleanups
}

/// A detour of a loop.
#[derive(Clone, Debug)]
struct Hung {
    /// Which clean-up path it is.
    cleanup: usize,
    /// How far along the loop as travelled it leaves it, mm.
    along: f64,
    insertion: Insertion,
}

/// A detour that the tool leaves and enters in the loop's direction.
enum Smooth {
    /// Instead of a part of the loop.
    Bulge(Bulge),
    /// A closed path.
    Tour(Vec<Segment>),
}

/// A loop as it is travelled.
struct Hanging<'a> {
    cut: &'a Cut,
    /// How many segments its track has.
    count: usize,
    /// The tool's radius.
    radius: f64,
    /// Its distance from the walls, and that of the outermost loops.
    distance: f64,
    first: f64,
    cleanups: &'a mut [Cleanup],
}

impl Hanging<'_> {
    /// The loop with its detours.
    fn path(&mut self, mut hung: Vec<Hung>) -> Vec<Segment> {
        let mut starts = vec![0.0];
        self.cut.segments.iter().for_each(|s| starts.push(starts[starts.len() - 1] + s.length()));
        for h in &mut hung {
            self.place(&mut h.insertion, self.count);
            let i = &h.insertion;
            let within = i.at.map_or(0.0, |p| self.cut.segments[i.segment].split_at(p).0.length());
            h.along = starts[i.segment] + within;
        }
        hung.sort_by(|a, b| a.along.total_cmp(&b.along));
        let along: Vec<f64> = hung.iter().map(|h| h.along).collect();
        let mut path =
            Path { cut: &self.cut.segments, done: Spot { segment: 0, at: self.cut.start }, segments: Vec::new() };
        let mut last = Vec::new();
        for (k, Hung { cleanup, mut insertion, .. }) in hung.into_iter().enumerate() {
            // The tool comes in at the start.
            let before = if k == 0 { 0.0 } else { along[k - 1] };
            let after = along.get(k + 1).copied().unwrap_or(starts[starts.len() - 1]);
            let free = REPLACED * (along[k] - before).min(after - along[k]);
            // What is not the only one there is left as it is.
            let is_only = along[k] < after && (k == 0 || along[k] > before);
            match if is_only { self.smooth(&insertion, free) } else { None } {
                Some(Smooth::Bulge(bulge)) => {
                    self.cleanups[cleanup].length = bulge.extra;
                    path.bypass(&bulge);
                    continue;
                }
                Some(Smooth::Tour(tour)) => {
                    self.cleanups[cleanup].length = length_of(&tour);
                    insertion.tour = tour;
                }
                None => {}
            }
            if along[k] == 0.0 {
                last.append(&mut insertion.tour);
            } else {
                path.insert(&insertion);
            }
        }
        path.finish(last)
    }

    /// What a detour becomes that leaves the loop where so much of it is free on both sides: the shorter one of a bulge and a
    /// drop or circle.
    fn smooth(&self, insertion: &Insertion, free: f64) -> Option<Smooth> {
        let (tour, segment) = (&insertion.tour, insertion.segment);
        let room = Room { about_loop: self.distance - self.first, about_tour: insertion.clearance - self.first };
        if let Some(p) = insertion.at {
            let tangent = self.cut.segments[segment].split_at(p).0.end_tangent();
            return circle_about(tour, [tangent; 2], self.radius, room).map(Smooth::Tour);
        }
        let (loop_path, radius) = (&self.cut.segments, self.radius);
        let corner = Corner { loop_path, segment, free, radius, room };
        let drop = drop_around(tour, corner.tangents(), radius, room);
        let drop = drop.or_else(|| circle_about(tour, corner.tangents(), radius, room));
        let longest = drop.as_deref().map_or(f64::INFINITY, length_of);
        let bulge = if free > 0.0 { corner.bulge(tour) } else { None };
        bulge.filter(|b| b.extra < longest).map(Smooth::Bulge).or(drop.map(Smooth::Tour))
    }

    /// Numbers the segment of an insertion, of `count` of the track, as in the cut, and puts it at the start of one where it is
    /// at an end.
    fn place(&self, insertion: &mut Insertion, count: usize) {
        let segments = &self.cut.segments;
        let mut k = (insertion.segment + count - self.cut.from) % count;
        if k == 0 && segments.len() > count {
            let is_before = insertion.at.is_none_or(|p| segments[count].distance(p) <= segments[0].distance(p));
            k = if is_before { count } else { 0 };
        }
        if insertion.at == Some(segments[k].end()) {
            (k, insertion.at) = ((k + 1) % segments.len(), None);
        }
        insertion.segment = k;
        insertion.at = insertion.at.filter(|&p| p != segments[k].start());
    }
}

/// A loop with detours in the making.
struct Path<'a> {
    cut: &'a [Segment],
    /// Up to where it is done.
    done: Spot,
    segments: Vec<Segment>,
}

impl Path<'_> {
    /// What is left of a segment, up to a point of it or all; `None` for nothing.
    fn part(&self, k: usize, to: Option<Point>) -> Option<Segment> {
        let (mut part, start) = (self.cut[k], self.cut[k].start());
        if let Some(to) = to {
            part = if to == start { return None } else { part.split_at(to).0 };
        }
        if k == self.done.segment && self.done.at != start {
            part = if self.done.at == part.end() { return None } else { part.split_at(self.done.at).1 };
        }
        Some(part)
    }

    /// Goes on along the loop.
    fn advance(&mut self, to: Spot) {
        for k in self.done.segment..=to.segment {
            self.segments.extend(self.part(k, (k == to.segment).then_some(to.at)));
        }
        self.done = to;
    }

    fn insert(&mut self, insertion: &Insertion) {
        let at = insertion.at.unwrap_or(self.cut[insertion.segment].start());
        self.advance(Spot { segment: insertion.segment, at });
        self.segments.extend(&insertion.tour);
    }

    fn bypass(&mut self, bulge: &Bulge) {
        self.advance(bulge.from);
        self.segments.extend(&bulge.path);
        self.done = bulge.to;
    }

    /// The whole loop, with what comes last.
    fn finish(mut self, mut last: Vec<Segment>) -> Vec<Segment> {
        for k in self.done.segment..self.cut.len() {
            self.segments.extend(self.part(k, None));
        }
        self.segments.append(&mut last);
        self.segments
    }
}
