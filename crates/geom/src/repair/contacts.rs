//! Which edges meet, and where they must be split.

use super::Edge;
use super::report::RegionError;
use crate::index::SegmentIndex;
use crate::intersect::{Closeness, Contact, Position, contacts};
use crate::point::Point;
use crate::segment::Segment;
use std::ops::ControlFlow;

/// Contacts beyond this many for each edge are no drawing.
const MOST_FOR_EACH_EDGE: usize = 64;

/// Where edges meet. Vertices are named by the edge that starts there; names from the number of edges on are those of
/// `places`, inside edges.
#[derive(Debug, Default)]
pub(super) struct Contacts {
    /// Vertices that are one point.
    pub(super) merges: Vec<(u32, u32)>,
    /// An edge, and a vertex that lies on it.
    pub(super) cuts: Vec<(u32, u32)>,
    /// Tangencies and shallow crossings.
    pub(super) places: Vec<Point>,
    /// Those of `places` that are crossings: the lenses between them are to be closed.
    pub(super) crossings: Vec<u32>,
    /// Edges that may cover one another.
    pub(super) touched: Vec<u32>,
}

/// All contacts beyond those of neighbours at their common vertex.
pub(super) fn find(
    edges: &[Edge],
    next: &[u32],
    index: &SegmentIndex,
    closeness: Closeness,
) -> Result<Contacts, RegionError> {
    let mut seen = Contacts::default();
    let most = MOST_FOR_EACH_EDGE * (edges.len() + MOST_FOR_EACH_EDGE);
    let error = index.visit_pairs(closeness.touch, |i, j| {
        let (i, j) = (i.min(j), i.max(j));
        if runs_on(edges, next, i, j) || runs_on(edges, next, j, i) {
            return ControlFlow::Continue(());
        }
        let mut crossing = None;
        contacts(&edges[i].segment, &edges[j].segment, closeness, |c| match c {
            Contact::Crossing { at, shallow: false } => crossing = Some(at),
            c => seen.note(c, i as u32, j as u32, next, edges.len()),
        });
        if crossing.is_none() && seen.touched.len() > most {
            crossing = Some(edges[i].segment.start());
        }
        match crossing {
            Some(at) => {
                ControlFlow::Break(RegionError::Crossing { first: edges[i].contour, second: edges[j].contour, at })
            }
            None => ControlFlow::Continue(()),
        }
    });
    match error {
        ControlFlow::Break(error) => Err(error),
        ControlFlow::Continue(()) => Ok(seen),
    }
}

/// Whether two straight edges follow one another without turning back: they meet only at their common vertex.
fn runs_on(edges: &[Edge], next: &[u32], i: usize, j: usize) -> bool {
    match (&edges[i].segment, &edges[j].segment) {
        (Segment::Line(l), Segment::Line(m)) => next[i] as usize == j && (l.end - l.start).dot(m.end - m.start) >= 0.0,
        _ => false,
    }
}

impl Contacts {
    /// Whether edges meet nowhere but at common vertices of neighbours.
    pub(super) fn is_empty(&self) -> bool {
        self.touched.is_empty()
    }

    fn note(&mut self, contact: Contact, i: u32, j: u32, next: &[u32], count: usize) {
        let vertex = |edge: u32, start: bool| if start { edge } else { next[edge as usize] };
        match contact {
            Contact::FirstEnd { start, on: Position::Inside } => self.cuts.push((j, vertex(i, start))),
            Contact::FirstEnd { start, on } => {
                let (v, w) = (vertex(i, start), vertex(j, on == Position::Start));
                if v == w && next[i as usize] != next[j as usize] && next[next[i as usize] as usize] != i {
                    return;
                }
                self.merges.push((v, w));
            }
            Contact::SecondEnd { start } => self.cuts.push((i, vertex(j, start))),
            Contact::Tangent(at) | Contact::Crossing { at, .. } => {
                let place = (count + self.places.len()) as u32;
                self.places.push(at);
                self.cuts.extend([(i, place), (j, place)]);
                if !matches!(contact, Contact::Tangent(_)) {
                    self.crossings.push(place);
                }
            }
        }
        self.touched.extend([i, j]);
    }
}
