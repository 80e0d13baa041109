//! Which area each loop bounds, from the loops alone.

use crate::plan::levels::{Area, Levels};
use crate::plan::track::Track;
use pocketry_geom::offset::Offset;
use pocketry_geom::{BBox, Contour, Point, Region};

/// The outer loop of an area.
struct Outer {
    area: u32,
    /// Its inside, for questions.
    inside: Region,
    bbox: BBox,
    size: f64,
}

impl Outer {
    fn new(area: u32, contour: &Contour) -> Self {
        let inside = Region::from_parts_unchecked(vec![contour.clone()], vec![None]);
        Self { area, inside, bbox: contour.bbox(), size: contour.area() }
    }
}

/// The smallest of the areas around a point.
fn around(outers: &[Outer], p: Point) -> Option<u32> {
    let holding = outers.iter().filter(|o| o.bbox.contains(p) && o.inside.contains(p));
    holding.min_by(|a, b| a.size.total_cmp(&b.size)).map(|o| o.area)
}

/// The loops of offsets at increasing distances as tracks and nested areas.
pub(super) fn levels(offsets: &[Offset]) -> Levels {
    let mut levels = Levels::default();
    let mut before: Vec<Outer> = Vec::new();
    for (level, found) in offsets.iter().enumerate() {
        let loops = &found.loops;
        let mut outers = Vec::new();
        for outer in loops.iter().filter(|l| l.contour.area() > 0.0) {
            let area = levels.areas.len() as u32;
            levels.areas.push(Area { clearance: found.distance, ..Area::default() });
            match around(&before, outer.contour.segments[0].start()) {
                Some(parent) => levels.areas[parent as usize].children.push(area),
                None => levels.roots.push(area),
            }
            outers.push(Outer::new(area, &outer.contour));
        }
        for one in loops {
            let own = outers.iter().find(|o| o.inside.contours()[0] == one.contour).map(|o| o.area);
            let Some(area) = own.or_else(|| around(&outers, one.contour.segments[0].start())) else { continue };
            levels.areas[area as usize].tracks.push(levels.tracks.len() as u32);
            levels.tracks.push(Track::of_loop(one.clone(), found.distance, level));
        }
        before = outers;
    }
    rise(&mut levels.areas);
    levels
}

/// An area is as high as the highest inside it; those come later in the list.
fn rise(areas: &mut [Area]) {
    for k in (0..areas.len()).rev() {
        let highest = areas[k].children.iter().map(|&c| areas[c as usize].clearance).fold(areas[k].clearance, f64::max);
        areas[k].clearance = highest;
    }
}
