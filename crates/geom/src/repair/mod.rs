//! From any closed loops to a valid [`Region`].
//!
//! The loops' fill is even-odd; their direction, order and starting points carry no meaning. The steps:
//!
//! 1. [`clean`]: every number finite and of a sane size, each loop closed, no edge of zero length, no full circle;
//! 2. [`circles`]: arcs of one circle share its centre and radius exactly;
//! 3. [`duplicates`]: loops without area and loops drawn twice are dropped;
//! 4. [`contacts`]: edges that cross are an error unless they bound a mere sliver; ends on other edges and tangencies
//!    are touches; where a loop crosses itself, [`curls`] within the join tolerance are cut off first;
//! 5. [`arrangement`]: edges are split at touches, pieces that cover each other cancel in pairs;
//! 6. [`fans`], [`sides`]: which side of every edge is interior, by parity from the left;
//! 7. [`splice`]: contours that keep the interior to the left and walk each wedge of it at a touch by itself;
//! 8. nesting: the outer contour that each island lies directly inside.
//!
//! Each step takes O(n log n) for n edges, apart from what contacts there are. Whatever was changed is told in a
//! [`Note`]; what can't be made a region is a [`RegionError`].

mod arrangement;
mod circles;
mod clean;
mod contacts;
mod curls;
mod duplicates;
mod fans;
mod report;
mod sides;
mod splice;

pub use report::{Note, RegionError};

use crate::bbox::BBox;
use crate::contour::Contour;
use crate::index::SegmentIndex;
use crate::intersect::Closeness;
use crate::nesting;
use crate::region::Region;
use crate::segment::Segment;
use crate::tolerance;

/// What may be changed to make a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RepairOptions {
    /// Contours that nowhere lie farther apart than this are one drawn twice, and slivers no wider than this where edges
    /// cross are dropped, mm; but never above [`tolerance::NARROW`] of the size. Curls are cut off that stray no farther than
    /// this from what stays and are no larger than [`tolerance::CURL`] of the size.
    pub join_tolerance: f64,
}

impl RepairOptions {
    fn narrow(self, bbox: BBox) -> f64 {
        self.join_tolerance.min(tolerance::NARROW * bbox.size())
    }

    fn curl(self, bbox: BBox) -> curls::Limits {
        let extent = tolerance::CURL * bbox.size();
        curls::Limits { extent, stray: self.join_tolerance.min(extent) }
    }
}

impl Default for RepairOptions {
    fn default() -> Self {
        Self { join_tolerance: tolerance::JOIN }
    }
}

/// A valid region, and what was done to get it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Healed {
    /// The region.
    pub region: Region,
    /// What was changed; empty where the loops were a region as they came.
    pub notes: Vec<Note>,
}

/// An edge and the input loop that it comes from.
#[derive(Clone, Copy, Debug)]
struct Edge {
    segment: Segment,
    contour: u32,
}

/// Makes a region of closed loops, filled even-odd.
///
/// # Errors
/// Numbers that are not finite or absurdly large, loops that don't close, edges that cross, nothing that encloses an
/// area: see [`RegionError`], which names the loops by their places in `loops`.
pub fn build(loops: Vec<Contour>, options: &RepairOptions) -> Result<Healed, RegionError> {
    let mut notes = Vec::new();
    let count = loops.len();
    let bbox = clean::check_numbers(&loops)?;
    let touch = tolerance::touch_length(bbox);
    let mut loops = clean::clean(loops, touch, &mut notes)?;
    circles::snap(&mut loops, bbox);
    duplicates::drop_repeated(&mut loops, options.narrow(bbox), &mut notes);
    let closeness = Closeness { touch, lens: options.narrow(bbox) };
    let mut drawn = Drawn::new(&loops);
    let mut found = drawn.contacts(closeness);
    if found.is_err() && curls::cut_off(&mut loops, options.curl(bbox), closeness, &mut notes) {
        drawn = Drawn::new(&loops);
        found = drawn.contacts(closeness);
    }
    let contacts = found?;
    let Drawn { edges, next, mut index } = drawn;
    let as_drawn = contacts.is_empty();
    let (pieces, vertices) = arrangement::pieces(&edges, &next, contacts, closeness, &mut notes);
    if pieces.is_empty() {
        return Err(RegionError::Nothing { loops: count, at: bbox.center() });
    }
    if !as_drawn {
        index = SegmentIndex::new(&pieces.iter().map(|p| p.segment).collect::<Vec<_>>());
    }
    let fans = fans::Fans::new(&pieces, vertices);
    let left = sides::interior_left(&pieces, &fans, &index)?;
    splice::touch_notes(&pieces, &fans, &mut notes);
    let (contours, owners) = splice::contours(&pieces, &fans, &left);
    let parents = nesting::parents_by(&contours, &index, |piece| owners[piece]);
    Ok(Healed { region: Region::from_parts_unchecked(contours, parents), notes })
}

/// All edges with the names of their loops, and for each the one that follows.
struct Drawn {
    edges: Vec<Edge>,
    next: Vec<u32>,
    index: SegmentIndex,
}

impl Drawn {
    fn new(loops: &[(u32, Contour)]) -> Self {
        let mut edges = Vec::new();
        let mut next = Vec::new();
        for (contour, c) in loops {
            let first = edges.len() as u32;
            edges.extend(c.segments.iter().map(|&segment| Edge { segment, contour: *contour }));
            next.extend((first..edges.len() as u32).map(|k| k + 1));
            if let Some(last) = next.last_mut() {
                *last = first;
            }
        }
        let index = SegmentIndex::new(&edges.iter().map(|e| e.segment).collect::<Vec<_>>());
        Self { edges, next, index }
    }

    fn contacts(&self, closeness: Closeness) -> Result<contacts::Contacts, RegionError> {
        contacts::find(&self.edges, &self.next, &self.index, closeness)
    }
}

/// The box of the loops' points.
fn bbox_of(loops: &[Contour]) -> BBox {
    loops.iter().fold(BBox::EMPTY, |b, c| b.union(c.bbox()))
}

#[cfg(test)]
mod tests;
