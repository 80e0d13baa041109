//! Planar regions: what is to be milled.

use crate::bbox::BBox;
use crate::contour::Contour;
use crate::point::Point;
use crate::ray::crossings_left;
use crate::segment::Segment;

/// A bounded set of the plane, the interior of its contours: outer contours run counter-clockwise, islands clockwise,
/// so that the pocket lies to the left of travel and the wall to the right. Nesting may be of any depth.
///
/// Invariants, established by the constructor that validates (see `repair`): every contour is closed, has at least two
/// segments, none of them of zero length and none a full circle; contours neither cross nor touch themselves or one
/// another except that *corners* may share a point (a touch), and there the interior's wedges are walked one by one,
/// so that each contour bounds a connected piece of the interior from one side.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Region {
    contours: Vec<Contour>,
    parents: Vec<Option<u32>>,
}

/// A connected piece of a region: one outer contour and the islands directly inside it (indices of contours).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pocket {
    /// The outer contour.
    pub outer: u32,
    /// The islands directly inside it.
    pub islands: Vec<u32>,
}

impl Region {
    /// A region from contours that already keep the invariants; `parents[k]` is the outer contour that island `k` lies
    /// directly inside, `None` for an outer contour.
    pub fn from_parts_unchecked(contours: Vec<Contour>, parents: Vec<Option<u32>>) -> Self {
        assert_eq!(contours.len(), parents.len());
        Self { contours, parents }
    }

    /// All contours.
    pub fn contours(&self) -> &[Contour] {
        &self.contours
    }

    /// For each contour: `None` for an outer one, else the outer contour around it.
    pub fn parents(&self) -> &[Option<u32>] {
        &self.parents
    }

    /// The connected pieces, in the order of their outer contours.
    pub fn pockets(&self) -> Vec<Pocket> {
        let mut place = vec![u32::MAX; self.contours.len()];
        let mut pockets = Vec::new();
        for (k, parent) in self.parents.iter().enumerate() {
            if parent.is_none() {
                place[k] = pockets.len() as u32;
                pockets.push(Pocket { outer: k as u32, islands: Vec::new() });
            }
        }
        for (k, parent) in self.parents.iter().enumerate() {
            if let Some(outer) = parent {
                pockets[place[*outer as usize] as usize].islands.push(k as u32);
            }
        }
        pockets
    }

    /// Every boundary segment, contour by contour.
    pub fn segments(&self) -> impl Iterator<Item = &Segment> {
        self.contours.iter().flat_map(|c| &c.segments)
    }

    /// Number of boundary segments.
    pub fn edge_count(&self) -> usize {
        self.contours.iter().map(|c| c.segments.len()).sum()
    }

    /// Area, mm².
    pub fn area(&self) -> f64 {
        self.contours.iter().map(Contour::area).sum()
    }

    /// Whether a point lies in the region (even-odd); a point of the boundary itself may count either way. All segments
    /// are looked at: see [`crate::distance::Boundary`] for many questions.
    pub fn contains(&self, p: Point) -> bool {
        let mut crossings = 0;
        self.segments().for_each(|s| crossings_left(s, p, |_| crossings += 1));
        crossings % 2 == 1
    }

    /// Smallest axis-parallel box.
    pub fn bbox(&self) -> BBox {
        self.contours.iter().fold(BBox::EMPTY, |b, c| b.union(c.bbox()))
    }
}
