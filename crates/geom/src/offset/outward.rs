//! Offsets to the outside: the region grown by a distance.

use super::{OffsetEngine, OffsetError, OffsetOptions};
use crate::bbox::BBox;
use crate::contour::Contour;
use crate::point::point;
use crate::region::Region;
use crate::segment::Segment;

/// The boundary of all points that lie within `distance` (mm) of a region: outer contours move outwards, islands shrink and may
/// vanish. It is the offset of what the region leaves of a box around it.
///
/// # Errors
/// As [`OffsetEngine::offsets`].
pub fn outward(engine: &dyn OffsetEngine, region: &Region, distance: f64) -> Result<Vec<Contour>, OffsetError> {
    let reach = region.bbox().inflated(2.0 * distance);
    // The box's own loop lies outside of everything that the region can grow to.
    let frame = reach.inflated(4.0 * distance);
    let offset = engine.offsets(&outside(region, frame), &[distance], &OffsetOptions::default())?;
    let grown = offset.into_iter().flat_map(|o| o.loops).map(|l| l.contour.reversed());
    Ok(grown.filter(|c| reach.contains(c.segments[0].start())).collect())
}

/// What a region leaves of a box.
fn outside(region: &Region, frame: BBox) -> Region {
    let (a, c) = (frame.min, frame.max);
    let corners = [a, point(c.x, a.y), c, point(a.x, c.y)];
    let around = (0..4).map(|k| Segment::line(corners[k], corners[(k + 1) % 4])).collect();
    let mut contours = vec![Contour::new(around)];
    contours.extend(region.contours().iter().map(Contour::reversed));
    let parents = region.parents();
    let mut turned = vec![None];
    // Islands become outer contours; an outer contour becomes an island of the smallest of them around it.
    for (k, parent) in parents.iter().enumerate() {
        turned.push(if parent.is_some() { None } else { Some(around_contour(region, k)) });
    }
    Region::from_parts_unchecked(contours, turned)
}

/// The contour of the outside that an outer contour lies directly in: an island, or the box.
fn around_contour(region: &Region, outer: usize) -> u32 {
    let p = region.contours()[outer].segments[0].start();
    let holds = |island: &Contour| {
        let alone = Region::from_parts_unchecked(vec![island.reversed()], vec![None]);
        island.bbox().contains(p) && alone.contains(p)
    };
    let islands = region.contours().iter().enumerate().filter(|(k, c)| region.parents()[*k].is_some() && holds(c));
    let smallest = islands.min_by(|a, b| a.1.area().abs().total_cmp(&b.1.area().abs()));
    smallest.map_or(0, |(k, _)| k as u32 + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::offset::VoronoiEngine;

    fn square(half: f64) -> Contour {
        Contour::from_vertices(&[[-half, -half, 0.0], [half, -half, 0.0], [half, half, 0.0], [-half, half, 0.0]])
    }

    #[test]
    fn a_frame_grows_to_both_sides_and_what_lies_in_it_too() {
        let contours = vec![square(20.0), square(10.0).reversed(), square(2.0)];
        let region = Region::from_parts_unchecked(contours, vec![None, Some(0), None]);
        let mut areas: Vec<f64> = outward(&VoronoiEngine, &region, 1.0).unwrap().iter().map(Contour::area).collect();
        areas.sort_by(f64::total_cmp);
        let rounded = |half: f64| 4.0 * half * half + 8.0 * half + std::f64::consts::PI;
        let expected = [-18.0 * 18.0, rounded(2.0), rounded(20.0)];
        assert!(areas.iter().zip(expected).all(|(a, e)| (a - e).abs() < 1e-9), "{areas:?}");
    }

    #[test]
    fn an_island_too_small_vanishes() {
        let contours = vec![square(20.0), square(0.5).reversed()];
        let region = Region::from_parts_unchecked(contours, vec![None, Some(0)]);
        assert_eq!(outward(&VoronoiEngine, &region, 1.0).unwrap().len(), 1);
    }
}
