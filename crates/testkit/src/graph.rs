//! Skeletons compared as graphs: vertices that coincide are merged, sites are matched by their places.

use crate::Transform;
use pocketry_geom::skeleton::{EdgeId, SiteId, SiteShape, Skeleton};
use pocketry_geom::{Point, Segment};

/// Vertices merged, each with the pairs of sites of the edges that leave it.
struct Merged {
    places: Vec<Point>,
    /// Sorted, the smaller site first.
    fans: Vec<Vec<(SiteId, SiteId)>>,
}

/// Whether `image` is what `transform` makes of `original`: the same sites, and once vertices within `tolerance` (mm, in
/// the image) are merged, the same vertices with the same edges leaving them.
///
/// # Errors
/// The first difference, in words.
pub fn same(original: &Skeleton, image: &Skeleton, transform: &Transform, tolerance: f64) -> Result<(), String> {
    let names = match_sites(original, image, transform, tolerance)?;
    let a = merge(original, |p| transform.apply_point(p), |s| names[s as usize], tolerance);
    let b = merge(image, |p| p, |s| s, tolerance);
    if a.places.len() != b.places.len() {
        return Err(format!("{} merged vertices became {}", a.places.len(), b.places.len()));
    }
    for (place, fan) in a.places.iter().zip(&a.fans) {
        let k = nearest(&b.places, *place);
        let off = b.places[k].distance(*place);
        if off > 4.0 * tolerance {
            return Err(format!("no vertex at ({}, {}): the nearest is {off:.1e} away", place.x, place.y));
        }
        if *fan != b.fans[k] {
            return Err(format!("at ({}, {}) edges {fan:?} became {:?}", place.x, place.y, b.fans[k]));
        }
    }
    Ok(())
}

fn match_sites(a: &Skeleton, b: &Skeleton, t: &Transform, tolerance: f64) -> Result<Vec<SiteId>, String> {
    if a.sites().len() != b.sites().len() {
        return Err(format!("{} sites became {}", a.sites().len(), b.sites().len()));
    }
    let key = |shape: &SiteShape| match *shape {
        SiteShape::Line(l) => (0, Segment::Line(l).at(0.5)),
        SiteShape::Arc(s) => (1, Segment::Arc(s).at(0.5)),
        SiteShape::Point(p) => (2, p),
    };
    let images: Vec<(i32, Point)> = b.sites().iter().map(|s| key(&s.shape)).collect();
    let find = |(kind, place): (i32, Point)| {
        let place = t.apply_point(place);
        let near = |&(k, p): &(i32, Point)| k == kind && p.distance(place) <= tolerance;
        let found = images.iter().position(near).map(|k| k as SiteId);
        found.ok_or_else(|| format!("no site at ({}, {})", place.x, place.y))
    };
    a.sites().iter().map(|s| find(key(&s.shape))).collect()
}

fn merge(s: &Skeleton, place: impl Fn(Point) -> Point, name: impl Fn(SiteId) -> SiteId, tolerance: f64) -> Merged {
    let points: Vec<Point> = s.vertices().iter().map(|v| place(v.point)).collect();
    let mut places: Vec<Point> = Vec::new();
    let cluster: Vec<usize> = points
        .iter()
        .zip(s.vertices())
        .map(|(&p, v)| {
            // A boundary vertex stands for itself even where contours touch.
            let found = (v.clearance > 0.0).then(|| places.iter().position(|q| q.distance(p) <= tolerance)).flatten();
            found.unwrap_or_else(|| {
                places.push(p);
                places.len() - 1
            })
        })
        .collect();
    let mut fans = vec![Vec::new(); places.len()];
    for e in 0..s.half_edges().len() as EdgeId {
        let (from, to) = (cluster[s.origin(e) as usize], cluster[s.target(e) as usize]);
        if from != to {
            let (x, y) = (name(s.site(e)), name(s.site(e ^ 1)));
            fans[from].push((x.min(y), x.max(y)));
        }
    }
    for fan in &mut fans {
        fan.sort_unstable();
    }
    Merged { places, fans }
}

fn nearest(places: &[Point], p: Point) -> usize {
    let by_distance = |a: &Point, b: &Point| a.distance_squared(p).total_cmp(&b.distance_squared(p));
    places.iter().enumerate().min_by(|a, b| by_distance(a.1, b.1)).map_or(0, |(k, _)| k)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{corpus, shapes};

    fn skeleton(radius: f64) -> Skeleton {
        let loops = vec![shapes::ngon(5, 10.0, [0.0; 2]), shapes::ngon(3, radius, [0.0; 2])];
        Skeleton::build(&corpus::region(&loops).unwrap()).unwrap()
    }

    #[test]
    fn a_difference_is_seen() {
        let plain = Transform::default();
        let (a, b) = (skeleton(2.0), skeleton(2.001));
        assert_eq!(same(&a, &a, &plain, 1e-6), Ok(()));
        assert!(same(&a, &b, &plain, 1e-6).is_err());
        // Sites match within this tolerance, vertices and edges then too: the shapes are the same at this scale.
        assert_eq!(same(&a, &b, &plain, 0.1), Ok(()));
        let turned = Transform { rotate: 0.1, ..plain };
        assert!(same(&a, &a, &turned, 1e-6).is_err());
    }
}
