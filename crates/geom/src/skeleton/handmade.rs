//! Skeletons made by hand, for tests of what stands on them.

use super::{EdgeId, HalfEdge, NONE, Site, SiteShape, Skeleton, Vertex};
use crate::point::{Point, point};
use crate::segment::{Arc, Line};

/// A skeleton from vertices `(x, y, clearance)`, edges `(from, to)` (edge `k` makes half-edges `2k` and `2k + 1`) and
/// sites with the half-edges of their cells from start to end.
pub(crate) fn skeleton(
    vertices: &[(f64, f64, f64)],
    edges: &[(u32, u32)],
    sites: &[(SiteShape, u32, &[EdgeId])],
) -> Skeleton {
    let vertices = vertices.iter().map(|&(x, y, clearance)| Vertex { point: point(x, y), clearance }).collect();
    let mut half_edges: Vec<HalfEdge> =
        edges.iter().flat_map(|&(a, b)| [a, b].map(|origin| HalfEdge { origin, next: NONE, site: NONE })).collect();
    for (site, (_, _, cell)) in sites.iter().enumerate() {
        for (k, &e) in cell.iter().enumerate() {
            half_edges[e as usize].site = site as u32;
            half_edges[e as usize].next = cell[(k + 1) % cell.len()];
        }
    }
    assert!(half_edges.iter().all(|h| h.next != NONE), "every half-edge belongs to a cell");
    let sites = sites
        .iter()
        .enumerate()
        .map(|(k, &(shape, contour, cell))| Site { shape, contour, segment: k as u32, first: cell[0] })
        .collect();
    Skeleton { sites, vertices, half_edges }
}

pub(crate) fn line(a: (f64, f64), b: (f64, f64)) -> SiteShape {
    SiteShape::Line(Line::new(point(a.0, a.1), point(b.0, b.1)))
}

pub(crate) fn arc(a: (f64, f64), b: (f64, f64), center: (f64, f64), ccw: bool) -> SiteShape {
    let (start, end, center) = (point(a.0, a.1), point(b.0, b.1), point(center.0, center.1));
    SiteShape::Arc(Arc { start, end, center, radius: start.distance(center), ccw })
}

pub(crate) fn reflex(p: (f64, f64)) -> SiteShape {
    SiteShape::Point(point(p.0, p.1))
}

/// A rectangle of `width` × `height` (width above height) from the origin: a constant-clearance edge in the middle.
pub(crate) fn rectangle(width: f64, height: f64) -> Skeleton {
    let r = 0.5 * height;
    let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
    skeleton(
        &[(0.0, 0.0, 0.0), (width, 0.0, 0.0), (width, height, 0.0), (0.0, height, 0.0), (r, r, r), (width - r, r, r)],
        &[(0, 4), (1, 5), (2, 5), (3, 4), (4, 5)],
        &[
            (line(corners[0], corners[1]), 0, &[0, 8, 3]),
            (line(corners[1], corners[2]), 0, &[2, 5]),
            (line(corners[2], corners[3]), 0, &[4, 9, 7]),
            (line(corners[3], corners[0]), 0, &[6, 1]),
        ],
    )
}

/// A disc as two half arcs: two spokes that meet in the centre.
pub(crate) fn disc(radius: f64) -> Skeleton {
    let (east, west) = ((radius, 0.0), (-radius, 0.0));
    skeleton(
        &[(radius, 0.0, 0.0), (-radius, 0.0, 0.0), (0.0, 0.0, radius)],
        &[(0, 2), (1, 2)],
        &[(arc(east, west, (0.0, 0.0), true), 0, &[0, 3]), (arc(west, east, (0.0, 0.0), true), 0, &[2, 1])],
    )
}

/// The L of side `2 * width` whose notch's reflex corner lies at `(width, width)`: the square `[0, 2w]²` without its
/// upper right quarter. Its skeleton runs from both ends' middles over a parabola each to the corner's bisector.
pub(crate) fn ell(width: f64) -> Skeleton {
    let w = width;
    let h = 0.5 * w;
    // The disk on the diagonal touches both outer walls and the reflex corner: c = sqrt(2) (w - c).
    let c = w * std::f64::consts::SQRT_2 / (1.0 + std::f64::consts::SQRT_2);
    skeleton(
        &[
            (0.0, 0.0, 0.0),
            (2.0 * w, 0.0, 0.0),
            (2.0 * w, w, 0.0),
            (w, w, 0.0),
            (w, 2.0 * w, 0.0),
            (0.0, 2.0 * w, 0.0),
            (2.0 * w - h, h, h), // 6: end of the horizontal arm
            (w, h, h),           // 7: below the reflex corner
            (c, c, c),           // 8: on the diagonal
            (h, w, h),           // 9: left of the reflex corner
            (h, 2.0 * w - h, h), // 10: end of the vertical arm
        ],
        &[(0, 8), (1, 6), (2, 6), (7, 6), (3, 7), (7, 8), (3, 9), (9, 8), (9, 10), (4, 10), (5, 10)],
        &[
            (line((0.0, 0.0), (2.0 * w, 0.0)), 0, &[0, 11, 6, 3]),
            (line((2.0 * w, 0.0), (2.0 * w, w)), 0, &[2, 5]),
            (line((2.0 * w, w), (w, w)), 0, &[4, 7, 9]),
            (reflex((w, w)), 0, &[8, 10, 15, 13]),
            (line((w, w), (w, 2.0 * w)), 0, &[12, 16, 19]),
            (line((w, 2.0 * w), (0.0, 2.0 * w)), 0, &[18, 21]),
            (line((0.0, 2.0 * w), (0.0, 0.0)), 0, &[20, 17, 14, 1]),
        ],
    )
}

/// The ring between two concentric circles, each two half arcs: a constant-clearance cycle and four spokes.
pub(crate) fn annulus(outer: f64, inner: f64) -> Skeleton {
    let (m, r) = (0.5 * (outer + inner), 0.5 * (outer - inner));
    let o = (0.0, 0.0);
    let at = |x: f64| (x, 0.0);
    skeleton(
        &[(outer, 0.0, 0.0), (-outer, 0.0, 0.0), (inner, 0.0, 0.0), (-inner, 0.0, 0.0), (m, 0.0, r), (-m, 0.0, r)],
        // 4: the northern half from east to west, 5: the southern half from west to east.
        &[(0, 4), (1, 5), (2, 4), (3, 5), (4, 5), (5, 4)],
        &[
            (arc(at(outer), at(-outer), o, true), 0, &[0, 8, 3]),
            (arc(at(-outer), at(outer), o, true), 0, &[2, 10, 1]),
            (arc(at(inner), at(-inner), o, false), 1, &[4, 11, 7]),
            (arc(at(-inner), at(inner), o, false), 1, &[6, 9, 5]),
        ],
    )
}

/// Distance from `p` to the nearest site, by brute force.
pub(crate) fn clearance(skeleton: &Skeleton, p: Point) -> f64 {
    let distance = |site: &Site| match site.shape {
        SiteShape::Line(l) => l.distance(p),
        SiteShape::Arc(a) => a.distance(p),
        SiteShape::Point(q) => q.distance(p),
    };
    skeleton.sites().iter().map(distance).fold(f64::INFINITY, f64::min)
}

/// Two chambers joined by a neck: outer walls `y = ±4` between `x = ±12`, teeth whose reflex tips stand at `(0, ±1)`,
/// each a wedge of two walls at 45°.
pub(crate) fn neck() -> Skeleton {
    // Right half: the disk tangent to y = ±s (s = 4 wide walls), tips... see the comments at the vertices.
    let s2 = std::f64::consts::SQRT_2;
    let (a, tip) = (12.0, 1.0);
    let foot = 3.0; // where a tooth's flank meets y = ±4: the flanks run at 45°
    // Disk of the right chamber on the axis: touches both flanks' lines (distance (x + 1)/√2) once past the spokes; the
    // spoke of (0, 1) to the flank has direction (1, -1)/√2 and meets the axis at (1, 0), clearance √2.
    // On the axis beyond: clearance (x + 1)/√2 reaches 4 at x = 4√2 - 1, where the walls y = ±4 take over: but the
    // corner at (3, 4) is reflex-free (interior angle 135°), its bisector meets the axis there.
    let m = 4.0 * s2 - 1.0;
    let r = 4.0;
    skeleton(
        &[
            (0.0, tip, 0.0),   // 0
            (0.0, -tip, 0.0),  // 1
            (foot, 4.0, 0.0),  // 2
            (foot, -4.0, 0.0), // 3
            (a, 4.0, 0.0),     // 4
            (a, -4.0, 0.0),    // 5
            (-foot, 4.0, 0.0), // 6
            (-foot, -4.0, 0.0),
            (-a, 4.0, 0.0), // 8
            (-a, -4.0, 0.0),
            (0.0, 0.0, tip), // 10: pass
            (1.0, 0.0, s2),  // 11
            (-1.0, 0.0, s2),
            (m, 0.0, r), // 13
            (-m, 0.0, r),
            (a - r, 0.0, r), // 15
            (r - a, 0.0, r),
        ],
        &[
            (10, 11), // 0
            (10, 12), // 1
            (0, 11),  // 2 spokes
            (0, 12),  // 3
            (1, 11),  // 4
            (1, 12),  // 5
            (11, 13), // 6
            (12, 14), // 7
            (2, 13),  // 8
            (3, 13),  // 9
            (6, 14),  // 10
            (7, 14),  // 11
            (13, 15), // 12 constant
            (14, 16), // 13
            (4, 15),  // 14
            (5, 15),  // 15
            (8, 16),  // 16
            (9, 16),  // 17
        ],
        &[
            (line((-foot, -4.0), (0.0, -tip)), 0, &[22, 15, 11]),
            (reflex((0.0, -tip)), 0, &[10, 3, 0, 9]),
            (line((0.0, -tip), (foot, -4.0)), 0, &[8, 12, 19]),
            (line((foot, -4.0), (a, -4.0)), 0, &[18, 24, 31]),
            (line((a, -4.0), (a, 4.0)), 0, &[30, 29]),
            (line((a, 4.0), (foot, 4.0)), 0, &[28, 25, 17]),
            (line((foot, 4.0), (0.0, tip)), 0, &[16, 13, 5]),
            (reflex((0.0, tip)), 0, &[4, 1, 2, 7]),
            (line((0.0, tip), (-foot, 4.0)), 0, &[6, 14, 21]),
            (line((-foot, 4.0), (-a, 4.0)), 0, &[20, 26, 33]),
            (line((-a, 4.0), (-a, -4.0)), 0, &[32, 35]),
            (line((-a, -4.0), (-foot, -4.0)), 0, &[34, 27, 23]),
        ],
    )
}
