//! Steps 2 to 4 for all pieces of an engine: their paths, and where they hang on loops.

use super::forest::Forest;
use super::prune::tours;
use super::{Cleanup, Exit, Piece, Place, Uncut, Way, trusted};
use crate::link::fitted;
use crate::plan::order::Orderer;
use crate::plan::track::Insertion;
use pocketry_geom::Segment;
use pocketry_geom::offset::degenerate_slack;

/// Places of a centre that are tried as the one where its path begins.
pub(crate) const CANDIDATES: usize = 12;

/// How far arcs may leave the chords of a path, as a share of how far the chords may leave the skeleton.
const FIT_SHARE: f64 = 0.25;

/// What clean-up takes.
#[derive(Debug, Default)]
pub(crate) struct Gathered {
    /// Tracks with their detours.
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
        for (track, mut insertion) in found {
            insertion.tour = fitted(&insertion.tour, FIT_SHARE * degenerate_slack(radius));
            gathered.add(piece.kind(), track, insertion);
        }
    }
    gathered
}

/// The paths of a piece that hangs on inner loops.
fn rooted(piece: &Piece, radius: f64) -> Vec<(u32, Insertion)> {
    let roots: Vec<u32> = piece.roots.iter().map(|r| r.0).collect();
    let tours = tours(&Forest::new(piece, &roots), radius);
    let hung = |(&(_, (track, segment)), tour): (&(u32, (u32, u32)), Vec<Segment>)| {
        (track, Insertion { segment: segment as usize, at: None, tour })
    };
    piece.roots.iter().zip(tours).map(hung).filter(|(_, i)| !i.tour.is_empty()).collect()
}

/// The path of a piece without inner loops: from the outer one, straight away from the wall, and from there.
fn center(piece: &Piece, orderer: &Orderer<'_>, level: usize, radius: f64) -> Option<(u32, Insertion)> {
    let of_place = piece.exits.chunk_by(|a, b| a.place == b.place);
    let tried = of_place.filter_map(|exits| exits.iter().find_map(|exit| through(piece, exit, orderer, level, radius)));
    tried.min_by(|a, b| a.1.length().total_cmp(&b.1.length())).filter(|(_, i)| !i.tour.is_empty())
}

/// The same by one of its exits, if that lies on a loop.
fn through(piece: &Piece, exit: &Exit, orderer: &Orderer<'_>, level: usize, radius: f64) -> Option<(u32, Insertion)> {
    let landing = orderer.landing(exit.at, exit.site, level, &|_| true)?;
    let (foot, at) = (landing.point, piece.places[exit.place as usize].at);
    let mut piece = Piece { places: piece.places.clone(), ways: piece.ways.clone(), ..Piece::default() };
    let root = piece.places.len() as u32;
    piece.places.push(Place { at: foot, reach: -1.0 });
    piece.ways.push(Way { ends: [root, exit.place], segment: Segment::line(foot, at) });
    let tour = tours(&Forest::new(&piece, &[root]), radius).pop()?;
    Some((landing.track, Insertion { segment: landing.segment, at: Some(foot), tour }))
}
