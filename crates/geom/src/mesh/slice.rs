//! Horizontal slices of a mesh: from triangles to closed, nested, oriented contours (the "polyhedral models" of H. C. Kim,
//! S. G. Lee and M. Y. Yang, *A new offset algorithm for closed 2D lines with islands*, 2005, figure 13).
//!
//! 1. A vertex at or above the height is *above*, every other *below*: the plane is seen infinitely little below its height,
//!    so that vertices, edges and whole facets in the plane are no special case. A flat top at the height is in
//!    the slice, a flat bottom is not.
//! 2. A facet with vertices on both sides holds one segment, between the two of its edges that cross the plane. All heights are
//!    found in one sweep over the facets; the slices are then made in parallel.
//! 3. Segments are chained by the edges they share, never by coordinates: at each edge, ends that go up are joined to ends that
//!    go down. On a closed oriented mesh that is a permutation, and *every chain closes, whatever the rounding*.
//! 4. An edge's crossing point is computed once, from its lower vertex number to its higher, so that chains meet exactly.
//! 5. Chains that end at open edges are joined where their ends lie within the join tolerance (cracks between
//!    facets that don't share corners); what stays open is told with its place.
//! 6. The contours' fill is even-odd: [`repair::build`] nests and orients them, and walks touches wedge by wedge.
//!
//! O(n log n + k log k) for n facets and k segments of all slices.

use super::{Mesh, above};
use crate::contour::Contour;
use crate::point::Point;
use crate::region::Region;
use crate::repair::{self, Healed, Note, RegionError, RepairOptions};
use crate::segment::Segment;
use crate::{chain, tolerance};
use rayon::prelude::*;

/// How a slice is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliceOptions {
    /// Ends of chains up to this far apart are joined, mm. Default: [`tolerance::JOIN`].
    pub join_tolerance: f64,
}

impl Default for SliceOptions {
    fn default() -> Self {
        Self { join_tolerance: tolerance::JOIN }
    }
}

/// A gap that could not be closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Where the chain begins.
    pub start: Point,
    /// Where it ends.
    pub end: Point,
}

/// What a plane cuts out of a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Slice {
    /// Height of the plane, mm.
    pub z: f64,
    /// The solid's cross-section; without contours where the plane misses it.
    pub region: Region,
    /// Chains that stay open; they are not part of the region.
    pub gaps: Vec<Gap>,
    /// Ends of chains that were joined.
    pub joined: usize,
    /// What was changed to make a region.
    pub notes: Vec<Note>,
}

/// The slices at these heights, in the order asked.
///
/// # Errors
/// For each height by itself: contours that cross, where the mesh runs through itself.
pub fn slices(mesh: &Mesh, heights: &[f64], options: SliceOptions) -> Vec<Result<Slice, RegionError>> {
    let crossed = sweep(mesh, heights);
    heights.par_iter().zip(crossed).map(|(&z, facets)| slice_of(mesh, z, &facets, options)).collect()
}

/// Step 2: for each height the facets that cross it.
fn sweep(mesh: &Mesh, heights: &[f64]) -> Vec<Vec<u32>> {
    let mut order: Vec<usize> = (0..heights.len()).collect();
    order.sort_by(|&a, &b| heights[a].total_cmp(&heights[b]));
    let mut crossed = vec![Vec::new(); heights.len()];
    for f in 0..mesh.facets().len() {
        let z = mesh.corners(f).map(|c| c[2]);
        let (low, high) = (z[0].min(z[1]).min(z[2]), z[0].max(z[1]).max(z[2]));
        let first = order.partition_point(|&k| heights[k] <= low);
        for &k in order[first..].iter().take_while(|&&k| heights[k] <= high) {
            crossed[k].push(f as u32);
        }
    }
    crossed
}

fn slice_of(mesh: &Mesh, z: f64, facets: &[u32], options: SliceOptions) -> Result<Slice, RegionError> {
    let segments: Vec<[u32; 2]> = facets.iter().map(|&f| segment_of(mesh, z, f as usize)).collect();
    let mut chains = chained(&segments);
    let mut slice = Slice { z, ..Slice::default() };
    let mut contours = Vec::new();
    let mut loose = Vec::new();
    for c in &mut chains {
        let points: Vec<Point> = c.edges.iter().map(|&e| crossing(mesh, z, e)).collect();
        let lines = points.windows(2).filter(|w| w[0] != w[1]).map(|w| Segment::line(w[0], w[1]));
        if c.closed { contours.push(Contour::new(lines.collect())) } else { loose.extend(lines) }
    }
    heal(&loose, options, &mut contours, &mut slice);
    contours.retain(|c| c.segments.len() > 1);
    if contours.is_empty() {
        return Ok(slice);
    }
    let healed = match build(contours, options) {
        // Contours without area: ridges that touch the plane from below.
        Err(RegionError::Nothing { .. }) => return Ok(slice),
        other => other?,
    };
    Ok(Slice { region: healed.region, notes: healed.notes, ..slice })
}

/// Step 6. Contours that coincide are the two sides of a ring without width, such as a closed ridge in the plane: they cancel
/// in pairs, where a drawing would mean one contour drawn twice.
fn build(mut contours: Vec<Contour>, options: SliceOptions) -> Result<Healed, RegionError> {
    let repair = RepairOptions { join_tolerance: options.join_tolerance };
    let healed = repair::build(contours.clone(), &repair)?;
    let mut dropped = vec![false; contours.len()];
    for note in &healed.notes {
        if let Note::Duplicate { contour, kept, .. } = *note {
            dropped[contour as usize] = true;
            dropped[kept as usize] ^= true;
        }
    }
    if !dropped.contains(&true) {
        return Ok(healed);
    }
    let mut drop = dropped.into_iter();
    contours.retain(|_| drop.next() != Some(true));
    if contours.is_empty() { Ok(Healed::default()) } else { repair::build(contours, &repair) }
}

/// The edges on which a facet's segment begins and ends: where the facet's boundary goes down, and where it goes up again, so
/// that the solid lies to the left.
fn segment_of(mesh: &Mesh, z: f64, facet: usize) -> [u32; 2] {
    let up = mesh.corners(facet).map(|c| c[2] >= z);
    let sides = mesh.sides()[facet];
    let mut ends = [0; 2];
    for k in 0..3 {
        match (up[k], up[(k + 1) % 3]) {
            (true, false) => ends[0] = sides[k],
            (false, true) => ends[1] = sides[k],
            _ => {}
        }
    }
    ends
}

/// Step 4.
fn crossing(mesh: &Mesh, z: f64, edge: u32) -> Point {
    let [p, q] = mesh.edges()[edge as usize].map(|v| mesh.vertices()[v as usize]);
    let t = ((z - p[2]) / (q[2] - p[2])).clamp(0.0, 1.0);
    above(p).lerp(above(q), t)
}

/// Segments joined end to end, as the edges they lead over; a closed chain repeats its first edge.
struct Chain {
    edges: Vec<u32>,
    closed: bool,
}

/// Step 3. End `2k` is the start of segment `k`, `2k + 1` its end.
fn chained(segments: &[[u32; 2]]) -> Vec<Chain> {
    let partner = partners(segments);
    let mut used = vec![false; segments.len()];
    let mut chains = Vec::new();
    let open = (0..partner.len()).filter(|&e| partner[e].is_none());
    for first in open.chain((0..segments.len()).map(|k| 2 * k)) {
        if used[first / 2] {
            continue;
        }
        let mut edges = vec![segments[first / 2][first % 2]];
        let mut end = Some(first);
        while let Some(e) = end.filter(|e| !std::mem::replace(&mut used[e / 2], true)) {
            edges.push(segments[e / 2][1 - e % 2]);
            end = partner[e ^ 1];
        }
        chains.push(Chain { closed: end == Some(first), edges });
    }
    chains
}

/// For each end the one it is joined to: a start to an end first, then whatever is left at the edge.
fn partners(segments: &[[u32; 2]]) -> Vec<Option<usize>> {
    let mut ends: Vec<(u32, usize)> = segments.iter().flatten().copied().zip(0..).collect();
    ends.sort_unstable();
    let mut partner = vec![None; ends.len()];
    for there in ends.chunk_by(|a, b| a.0 == b.0) {
        let (mut starts, mut stops): (Vec<usize>, Vec<usize>) = there.iter().map(|e| e.1).partition(|e| e % 2 == 0);
        let both = starts.len().min(stops.len());
        let mut pairs: Vec<(usize, usize)> = starts.drain(..both).zip(stops.drain(..both)).collect();
        let rest = if starts.is_empty() { stops } else { starts };
        pairs.extend(rest.chunks_exact(2).map(|two| (two[0], two[1])));
        for (a, b) in pairs {
            partner[a] = Some(b);
            partner[b] = Some(a);
        }
    }
    partner
}

/// Step 5.
fn heal(loose: &[Segment], options: SliceOptions, contours: &mut Vec<Contour>, slice: &mut Slice) {
    if loose.is_empty() {
        return;
    }
    let chains = chain::chain(loose, options.join_tolerance);
    contours.extend(chains.closed.into_iter().map(|(contour, _)| contour));
    slice.gaps.extend(chains.open.iter().map(|c| Gap { start: c.start, end: c.end }));
    slice.joined =
        chains.notes.iter().map(|n| if let chain::ChainNote::Joined { count, .. } = n { *count } else { 0 }).sum();
}
