//! The walls of a region: distance and inside or outside, through a tree of boxes.

use crate::distance;
use crate::tree::Tree;
use pocketry_geom::{Arc, Point, Region, Segment, Vec2, vec2};

/// A region's boundary, prepared for many questions.
pub(crate) struct Walls {
    /// Every boundary segment, arcs in parts of at most half a turn, contour by contour.
    pub(crate) segments: Vec<Segment>,
    /// For each segment the one that follows it on its contour.
    pub(crate) next: Vec<u32>,
    /// The tree over `segments`.
    pub(crate) tree: Tree,
    /// The tree over parts that are monotone in y, for counting crossings of a ray.
    monotone: Tree,
}

impl Walls {
    /// Prepares a region; arcs flatter than `flat` become their chords.
    pub(crate) fn new(region: &Region, flat: f64) -> Self {
        let (mut segments, mut next) = (Vec::new(), Vec::new());
        for contour in region.contours() {
            let first = segments.len() as u32;
            for segment in contour.segments.iter().filter(|s| s.start() != s.end() || matches!(s, Segment::Arc(_))) {
                push_halves(&straightened(segment, flat), &mut segments);
            }
            let end = segments.len() as u32;
            next.extend((first..end).map(|k| if k + 1 == end { first } else { k + 1 }));
        }
        let mut monotone = Vec::with_capacity(segments.len());
        for segment in &segments {
            push_monotone(segment, &mut monotone);
        }
        Self { tree: Tree::new(&segments), monotone: Tree::new(&monotone), segments, next }
    }

    /// Length of the whole boundary, mm.
    pub(crate) fn length(&self) -> f64 {
        self.segments.iter().map(Segment::length).sum()
    }

    /// Whether a point off the boundary lies inside the region: a ray to the right crosses it an odd number of times.
    pub(crate) fn contain(&self, p: Point) -> bool {
        let mut odd = false;
        self.monotone.on_ray(p, |piece| odd ^= crosses_ray(piece, p));
        odd
    }

    /// Length of the parts of a curve outside the region.
    pub(crate) fn length_outside(&self, curve: &Segment) -> f64 {
        let mut cuts = vec![curve.start()];
        self.tree.near(curve, f64::MIN_POSITIVE, |wall| {
            distance::crossings(curve, wall, &mut cuts);
            true
        });
        cuts.push(curve.end());
        let from = curve.start();
        let along = |p: &Point| match curve {
            Segment::Line(_) => p.distance(from),
            Segment::Arc(a) => turned(a, from, *p) * a.radius,
        };
        let mut marks: Vec<f64> = cuts[..cuts.len() - 1].iter().map(along).chain([curve.length()]).collect();
        marks.sort_by(f64::total_cmp);
        let length = curve.length();
        let outside = |w: &&[f64]| w[1] > w[0] && !self.contain(curve.at(0.5 * (w[0] + w[1]) / length));
        marks.windows(2).filter(outside).map(|w| w[1] - w[0]).sum()
    }
}

/// How far the arc turns from one of its points to another, radians.
fn turned(a: &Arc, from: Point, to: Point) -> f64 {
    let angle = (from - a.center).angle_to(to - a.center);
    let ahead = if a.ccw { angle } else { -angle };
    if ahead < 0.0 { ahead + std::f64::consts::TAU } else { ahead }
}

/// The chord of an arc that is flatter than `flat`, else the segment itself.
pub(crate) fn straightened(segment: &Segment, flat: f64) -> Segment {
    match segment {
        Segment::Arc(a) if a.start != a.end && a.sweep().abs() < std::f64::consts::FRAC_PI_2 => {
            let chord = a.start.distance_squared(a.end);
            if chord <= 8.0 * flat * a.radius { Segment::line(a.start, a.end) } else { *segment }
        }
        _ => *segment,
    }
}

/// Adds a segment, an arc of more than half a turn in two parts.
pub(crate) fn push_halves(segment: &Segment, out: &mut Vec<Segment>) {
    if let Segment::Arc(a) = segment
        && (a.start == a.end || a.sweep().abs() > std::f64::consts::PI)
    {
        let (first, second) = segment.split_at(segment.at(0.5));
        out.extend([first, second]);
    } else {
        out.push(*segment);
    }
}

/// Adds a segment in parts along which y only rises or only falls.
fn push_monotone(segment: &Segment, out: &mut Vec<Segment>) {
    let Segment::Arc(a) = segment else { return out.push(*segment) };
    let ahead = |d: &Vec2| turned(a, a.start, a.center + *d);
    let mut tops: Vec<Vec2> = [vec2(0.0, a.radius), vec2(0.0, -a.radius)]
        .into_iter()
        .filter(|d| ahead(d) > 0.0 && ahead(d) < a.sweep().abs())
        .collect();
    tops.sort_by(|d, e| ahead(d).total_cmp(&ahead(e)));
    let mut rest = *segment;
    for top in tops.into_iter().map(|d| a.center + d) {
        if top != rest.start() && top != rest.end() {
            let (part, after) = rest.split_at(top);
            out.push(part);
            rest = after;
        }
    }
    out.push(rest);
}

/// Whether a ray from `p` in the direction of +x crosses a piece that is monotone in y (its lower end counts, not its upper).
fn crosses_ray(piece: &Segment, p: Point) -> bool {
    let (mut low, mut high) = (piece.start(), piece.end());
    if low.y > high.y {
        std::mem::swap(&mut low, &mut high);
    }
    if p.y < low.y || p.y >= high.y {
        return false;
    }
    match piece {
        Segment::Line(_) => (high - low).cross(p - low) > 0.0,
        Segment::Arc(a) => {
            let right_half = (a.end.y > a.start.y) == a.ccw;
            let (beside, level) = (p.x - a.center.x, p.y - a.center.y);
            let reach = (a.radius * a.radius - level * level).max(0.0).sqrt();
            if right_half { beside < reach } else { beside < -reach }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pocketry_geom::{Contour, point};

    fn ring() -> Region {
        let disc = |r: f64, s: f64| Contour::from_vertices(&[[r, 0.0, s], [-r, 0.0, s]]);
        Region::from_parts_unchecked(vec![disc(10.0, 1.0), disc(4.0, 1.0).reversed()], vec![None, Some(0)])
    }

    #[test]
    fn a_ring_contains_what_lies_between_its_circles() {
        let walls = Walls::new(&ring(), 0.0);
        for k in 0..360 {
            let d = Vec2::from_angle(f64::from(k).to_radians());
            assert!(!walls.contain(Point::ORIGIN + d * 3.9));
            assert!(walls.contain(Point::ORIGIN + d * 4.1));
            assert!(walls.contain(Point::ORIGIN + d * 9.9));
            assert!(!walls.contain(Point::ORIGIN + d * 10.1));
        }
    }

    #[test]
    fn the_length_outside_is_cut_at_the_walls() {
        let walls = Walls::new(&ring(), 0.0);
        let through = Segment::line(point(-12.0, 0.0), point(12.0, 0.0));
        assert!((walls.length_outside(&through) - 12.0).abs() < 1e-12);
    }
}
