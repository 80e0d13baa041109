//! Steps 2 to 4 for all pieces of an engine: their paths, and where they hang on loops.

use super::forest::Forest;
use super::prune::{Tour, tours};
use super::{Cleanup, Exit, Piece, Place, Uncut, Way, trusted};
use crate::link::fitted;
use crate::plan::order::Orderer;
use crate::plan::track::{Insertion, Tip};
use pocketry_geom::offset::degenerate_slack;
use pocketry_geom::{Point, Segment};

/// Places of a centre that are tried as the one where its path begins.
pub(crate) const CANDIDATES: usize = 12;

/// How far arcs may leave the chords of a path, as a share of how far the chords may leave the skeleton.
const FIT_SHARE: f64 = 0.25;

/// What clean-up takes.
#[derive(Debug, Default)]
pub(crate) struct Gathered {
    /// Tracks with their detours, one for each of the clean-up paths.
    pub(super) insertions: Vec<(u32, Insertion)>,
    pub(super) cleanups: Vec<Cleanup>,
}

impl Gathered {
    /// All detours.
    pub(crate) fn tours(&self) -> impl Iterator<Item = &Segment> {
        self.insertions.iter().flat_map(|(_, i)| &i.tour)
    }

    /// Adds a detour, which has segments, of a track.
    pub(crate) fn add(&mut self, kind: Uncut, track: u32, insertion: Insertion) {
        self.cleanups.push(Cleanup { kind, start: insertion.tour[0].start(), length: insertion.length() });
        self.insertions.push((track, insertion));
    }
}

/// The clean-up paths of pieces, each given with the level of the loops around it, for a tool of this radius.
pub(crate) fn gather(pieces: &[(usize, Piece)], orderer: &Orderer<'_>, radius: f64) -> Gathered {
    let radius = trusted(radius);
    let mut gathered = Gathered::default();
    for (level, piece) in pieces {
        let found = if piece.roots.is_empty() {
            center(piece, orderer, *level, radius).into_iter().collect()
        } else {
            rooted(piece, radius)
        };
        for (track, insertion) in found {
            gathered.add(piece.kind(), track, insertion);
        }
    }
    gathered
}

/// The paths of a piece that hangs on inner loops.
fn rooted(piece: &Piece, radius: f64) -> Vec<(u32, Insertion)> {
    let roots: Vec<u32> = piece.roots.iter().map(|r| r.0).collect();
    let tours = tours(&Forest::new(piece, &roots), radius);
    let hung = |(&(_, (track, segment)), tour): (&(u32, (u32, u32)), Tour)| {
        Some((track, insertion(segment as usize, None, &tour, [piece.least; 2], radius)?))
    };
    piece.roots.iter().zip(tours).filter_map(hung).collect()
}

/// A tour as a detour, unless nothing is uncut; with the least clearance on it, and that at its tip.
fn insertion(
    segment: usize,
    at: Option<Point>,
    tour: &Tour,
    [least, at_tip]: [f64; 2],
    radius: f64,
) -> Option<Insertion> {
    let fitted = |path: &[Segment]| fitted(path, FIT_SHARE * degenerate_slack(radius));
    let (mut path, back) = (fitted(&tour.out), fitted(&tour.back));
    let tip = Some(Tip { segment: path.len(), clearance: at_tip });
    path.extend(back);
    (!path.is_empty()).then_some(Insertion { segment, at, tour: path, clearance: least, tip })
}

/// The path of a piece without inner loops: from the outer one, straight away from the wall, and from there.
fn center(piece: &Piece, orderer: &Orderer<'_>, level: usize, radius: f64) -> Option<(u32, Insertion)> {
    let of_place = piece.exits.chunk_by(|a, b| a.place == b.place);
    let tried = of_place.filter_map(|exits| exits.iter().find_map(|exit| through(piece, exit, orderer, level, radius)));
    let length = |found: &(u32, Option<Insertion>)| found.1.as_ref().map_or(0.0, Insertion::length);
    let (track, insertion) = tried.min_by(|a, b| length(a).total_cmp(&length(b)))?;
    Some((track, insertion?))
}

/// The same by one of its exits, if that lies on a loop: none is needed where that leaves nothing.
fn through(
    piece: &Piece,
    exit: &Exit,
    orderer: &Orderer<'_>,
    level: usize,
    radius: f64,
) -> Option<(u32, Option<Insertion>)> {
    let landing = orderer.landing(exit.at, exit.site, level, &|_| true)?;
    let (foot, at) = (landing.point, piece.places[exit.place as usize].at);
    let mut piece =
        Piece { least: piece.least, places: piece.places.clone(), ways: piece.ways.clone(), ..Piece::default() };
    let root = piece.places.len() as u32;
    piece.places.push(Place { at: foot, reach: -1.0 });
    piece.ways.push(Way { ends: [root, exit.place], segment: Segment::line(foot, at) });
    let tour = tours(&Forest::new(&piece, &[root]), radius).pop()?;
    let base = orderer.levels.tracks[landing.track as usize].distance;
    let at_tip = if tour.out.len() > 1 { piece.least } else { base };
    Some((landing.track, insertion(landing.segment, Some(foot), &tour, [base, at_tip], radius)))
}
