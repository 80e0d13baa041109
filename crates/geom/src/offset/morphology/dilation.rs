//! Dilation, opening and closing from erosion.
//!
//! What no place of a region reaches with the profile is where the reflected profile lies in the region's complement: dilation
//! is the erosion of the complement by the reflected profile. The complement is taken in a frame so large that its edge is out of reach.

use super::{MorphologyError, eroded};
use crate::bbox::BBox;
use crate::contour::Contour;
use crate::nesting;
use crate::point::{Point, point};
use crate::region::Region;
use crate::segment::{Arc, Segment};

/// The frame's distance from the region, in reaches of the profile.
const FRAME: f64 = 4.0;

/// All points that the profile covers with its reference point at places of a region: the Minkowski sum. Arguments are as for [`eroded`].
///
/// # Errors
/// Where its outline does not close, with a place.
pub fn dilated(region: &Region, profile: &Contour, inside: Point) -> Result<Region, MorphologyError> {
    if region.contours().is_empty() {
        return Ok(Region::default());
    }
    let bbox = profile.bbox();
    let reach = [bbox.min, bbox.max].map(|p| p.x.abs().max(p.y.abs())).into_iter().fold(0.0, f64::max);
    let outside = complement(region, FRAME * reach);
    let untouched = eroded(&outside, &reflected(profile), point(-inside.x, -inside.y))?;
    let frame = untouched.bbox();
    let loops = untouched.contours().iter().filter(|c| c.bbox() != frame);
    let loops: Vec<Contour> = loops.map(Contour::reversed).collect();
    let parents = nesting::parents(&loops);
    Ok(Region::from_parts_unchecked(loops, parents))
}

/// All points that the profile covers where it lies in a region: what a tool of that shape can cut of it.
///
/// # Errors
/// Where an outline does not close, with a place.
pub fn opened(region: &Region, profile: &Contour, inside: Point) -> Result<Region, MorphologyError> {
    dilated(&eroded(region, profile, inside)?, profile, inside)
}

/// A region and all points that the profile cannot cover without touching it: notches narrower than the profile are filled.
///
/// # Errors
/// Where an outline does not close, with a place.
pub fn closed(region: &Region, profile: &Contour, inside: Point) -> Result<Region, MorphologyError> {
    eroded(&dilated(region, profile, inside)?, profile, inside)
}

/// What a rectangle about a region, this far from it, holds besides it.
fn complement(region: &Region, margin: f64) -> Region {
    let frame = rectangle(region.bbox().inflated(margin));
    let loops: Vec<Contour> = std::iter::once(frame).chain(region.contours().iter().map(Contour::reversed)).collect();
    let parents = nesting::parents(&loops);
    Region::from_parts_unchecked(loops, parents)
}

fn rectangle(b: BBox) -> Contour {
    let corners = [b.min, point(b.max.x, b.min.y), b.max, point(b.min.x, b.max.y)];
    Contour::from_vertices(&corners.map(|p| [p.x, p.y, 0.0]))
}

/// A contour turned by half about the origin.
fn reflected(contour: &Contour) -> Contour {
    let flip = |p: Point| point(-p.x, -p.y);
    let segment = |s: &Segment| match *s {
        Segment::Line(l) => Segment::line(flip(l.start), flip(l.end)),
        Segment::Arc(a) => Segment::Arc(Arc { start: flip(a.start), end: flip(a.end), center: flip(a.center), ..a }),
    };
    Contour::new(contour.segments.iter().map(segment).collect())
}
