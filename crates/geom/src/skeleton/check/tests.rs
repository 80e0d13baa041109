//! Skeletons made by hand, right and wrong.

use super::*;
use crate::contour::Contour;
use crate::point::point;
use crate::segment::Segment;
use crate::skeleton::{HalfEdge, NONE, Site, Vertex};

/// A region and a skeleton of it.
struct Case {
    region: Region,
    skeleton: Skeleton,
}

/// Sites in the order of `paths`: contour, segment, whether it is the corner there, and the vertices of its cell.
type Path<'a> = (u32, u32, bool, &'a [u32]);

fn region(loops: &[&[[f64; 3]]]) -> Region {
    let contours: Vec<Contour> = loops.iter().map(|l| Contour::from_vertices(l)).collect();
    let parents = (0..contours.len()).map(|k| (k > 0).then_some(0)).collect();
    Region::from_parts_unchecked(contours, parents)
}

/// Joins the steps u → v and v → u of the cells to edges, in the order in which they appear.
fn assemble(region: Region, vertices: &[[f64; 3]], paths: &[Path]) -> Case {
    let vertices = vertices.iter().map(|v| Vertex { point: point(v[0], v[1]), clearance: v[2] }).collect();
    let mut skeleton = Skeleton { vertices, ..Skeleton::default() };
    let mut open: Vec<(u32, u32, EdgeId)> = Vec::new();
    for (site, &(contour, segment, corner, path)) in paths.iter().enumerate() {
        let edges: Vec<EdgeId> = path
            .windows(2)
            .map(|step| {
                let found = open.iter().position(|&(u, v, _)| (v, u) == (step[0], step[1]));
                let e = found.map_or(skeleton.half_edges.len() as EdgeId, |k| open.remove(k).2 ^ 1);
                if found.is_none() {
                    open.push((step[0], step[1], e));
                    let blank = HalfEdge { origin: NONE, next: NONE, site: NONE };
                    skeleton.half_edges.extend([blank; 2]);
                }
                skeleton.half_edges[e as usize] = HalfEdge { origin: step[0], next: NONE, site: site as SiteId };
                e
            })
            .collect();
        for (k, &e) in edges.iter().enumerate() {
            skeleton.half_edges[e as usize].next = edges[(k + 1) % edges.len()];
        }
        let element = region.contours()[contour as usize].segments[segment as usize];
        let shape = match element {
            _ if corner => SiteShape::Point(element.start()),
            Segment::Line(l) => SiteShape::Line(l),
            Segment::Arc(a) => SiteShape::Arc(a),
        };
        skeleton.sites.push(Site { shape, contour, segment, first: edges[0] });
    }
    assert!(open.is_empty());
    Case { region, skeleton }
}

fn square() -> Case {
    let region = region(&[&[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]]]);
    let vertices = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0], [1.0, 1.0, 1.0]];
    let paths: [Path; 4] =
        [(0, 0, false, &[0, 4, 1]), (0, 1, false, &[1, 4, 2]), (0, 2, false, &[2, 4, 3]), (0, 3, false, &[3, 4, 0])];
    assemble(region, &vertices, &paths)
}

fn disc() -> Case {
    let region = region(&[&[[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0]]]);
    let vertices = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    assemble(region, &vertices, &[(0, 0, false, &[0, 2, 1]), (0, 1, false, &[1, 2, 0])])
}

fn slot() -> Case {
    let region = region(&[&[[0.0, -1.0, 0.0], [4.0, -1.0, 1.0], [4.0, 1.0, 0.0], [0.0, 1.0, 1.0]]]);
    let vertices =
        [[0.0, -1.0, 0.0], [4.0, -1.0, 0.0], [4.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [4.0, 0.0, 1.0]];
    let paths: [Path; 4] = [
        (0, 0, false, &[0, 4, 5, 1]),
        (0, 1, false, &[1, 5, 2]),
        (0, 2, false, &[2, 5, 4, 3]),
        (0, 3, false, &[3, 4, 0]),
    ];
    assemble(region, &vertices, &paths)
}

/// An L of width 2 with arms of length 4: the parabola between the reflex vertex (2, 2) and the outer walls.
fn ell() -> Case {
    let region = region(&[&[
        [0.0, 0.0, 0.0],
        [4.0, 0.0, 0.0],
        [4.0, 2.0, 0.0],
        [2.0, 2.0, 0.0],
        [2.0, 4.0, 0.0],
        [0.0, 4.0, 0.0],
    ]]);
    // The centre of the disk at the bend: |p − (2, 2)| = x on the diagonal.
    let bend = 4.0 - 2.0 * 2.0_f64.sqrt();
    let vertices = [
        [0.0, 0.0, 0.0],
        [4.0, 0.0, 0.0],
        [4.0, 2.0, 0.0],
        [2.0, 2.0, 0.0],
        [2.0, 4.0, 0.0],
        [0.0, 4.0, 0.0],
        [bend, bend, bend],
        [2.0, 1.0, 1.0],
        [1.0, 2.0, 1.0],
        [3.0, 1.0, 1.0],
        [1.0, 3.0, 1.0],
    ];
    let paths: [Path; 7] = [
        (0, 0, false, &[0, 6, 7, 9, 1]),
        (0, 1, false, &[1, 9, 2]),
        (0, 2, false, &[2, 9, 7, 3]),
        (0, 3, true, &[3, 7, 6, 8, 3]),
        (0, 3, false, &[3, 8, 10, 4]),
        (0, 4, false, &[4, 10, 5]),
        (0, 5, false, &[5, 10, 8, 6, 0]),
    ];
    assemble(region, &vertices, &paths)
}

/// A ring of constant width 2 about a round island of radius 1: one cycle of constant clearance.
fn ring() -> Case {
    let region = region(&[&[[-3.0, 0.0, 1.0], [3.0, 0.0, 1.0]], &[[-1.0, 0.0, -1.0], [1.0, 0.0, -1.0]]]);
    let vertices =
        [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [-2.0, 0.0, 1.0], [2.0, 0.0, 1.0]];
    let paths: [Path; 4] = [
        (0, 0, false, &[0, 4, 5, 1]),
        (1, 1, false, &[3, 5, 4, 2]),
        (0, 1, false, &[1, 5, 4, 0]),
        (1, 0, false, &[2, 4, 5, 3]),
    ];
    assemble(region, &vertices, &paths)
}

fn report(case: &Case) -> CheckReport {
    case.skeleton.check(&case.region, &CheckOptions::default())
}

fn kinds(case: &Case) -> Vec<FaultKind> {
    report(case).counts.into_keys().collect()
}

#[test]
fn right_skeletons_pass() {
    for (name, case) in [("square", square()), ("disc", disc()), ("slot", slot()), ("ell", ell()), ("ring", ring())] {
        let report = report(&case);
        assert!(report.is_ok(), "{name}: {report}\n{:?}", report.faults);
        assert!(report.worst_vertex < 1e-15 && report.worst_edge < 1e-14 && report.area_error < 1e-14, "{name}");
        assert_eq!(report.components, 1, "{name}");
    }
}

#[test]
fn the_tree_of_boxes_agrees_with_brute_force() {
    for case in [slot(), ell(), ring()] {
        let tree = Nearest::new(&case.region, 0);
        let brute = Nearest::new(&case.region, usize::MAX);
        for k in 0..400 {
            let x = point(-4.0 + 0.4 * f64::from(k % 20), -4.0 + 0.4 * f64::from(k / 20));
            assert_eq!(tree.distance(x), brute.distance(x));
        }
    }
}

#[test]
fn a_wrong_clearance_is_found() {
    let mut case = square();
    case.skeleton.vertices[4].clearance = 1.0 + 1e-7;
    assert!(kinds(&case).contains(&FaultKind::VertexClearance));
}

#[test]
fn a_vertex_off_its_place_is_found() {
    let mut case = ell();
    case.skeleton.vertices[6].point.x += 1e-6;
    let kinds = kinds(&case);
    assert!(kinds.contains(&FaultKind::FootDistance) || kinds.contains(&FaultKind::VertexClearance), "{kinds:?}");
}

#[test]
fn a_vertex_that_slides_along_a_plateau_off_its_spoke_is_found() {
    let mut case = slot();
    case.skeleton.vertices[4].point.x += 1e-5;
    assert!(!report(&case).is_ok());
    let mut case = slot();
    case.skeleton.vertices[4].point.x -= 1e-5;
    assert!(!report(&case).is_ok());
}

#[test]
fn a_missing_reflex_vertex_is_found() {
    let mut case = ell();
    case.region = region(&[&[[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 2.0, 0.0], [2.0, 2.0, 0.0], [0.0, 4.0, 0.0]]]);
    assert!(!report(&case).is_ok());
    let mut case = ell();
    case.skeleton.sites[3].segment = 4;
    assert!(kinds(&case).contains(&FaultKind::SiteMissing));
}

#[test]
fn broken_links_are_found_without_a_panic() {
    let whole = ell();
    for e in 0..whole.skeleton.half_edges.len() {
        for change in [0, 1, 5, 1_000_000, NONE] {
            let mut case = ell();
            case.skeleton.half_edges[e].next = change;
            if change != whole.skeleton.half_edges[e].next {
                assert!(!report(&case).is_ok(), "next of {e} = {change}");
            }
            let mut case = ell();
            case.skeleton.half_edges[e].origin = change;
            if change != whole.skeleton.half_edges[e].origin {
                assert!(!report(&case).is_ok(), "origin of {e} = {change}");
            }
            let mut case = ell();
            case.skeleton.half_edges[e].site = change;
            if change != whole.skeleton.half_edges[e].site {
                assert!(!report(&case).is_ok(), "site of {e} = {change}");
            }
        }
    }
}

/// A round island off the centre of a disc; the bisector is an ellipse with its apexes on the x axis.
fn eccentric(with_apexes: bool) -> Case {
    let region = region(&[&[[0.0, -3.0, 1.0], [0.0, 3.0, 1.0]], &[[0.5, 1.0, -1.0], [0.5, -1.0, -1.0]]]);
    let vertices = [
        [0.0, -3.0, 0.0],
        [0.0, 3.0, 0.0],
        [0.5, 1.0, 0.0],
        [0.5, -1.0, 0.0],
        [0.0, 1.96875, 1.03125],
        [0.5, 1.96875, 0.96875],
        [0.0, -1.96875, 1.03125],
        [0.5, -1.96875, 0.96875],
        [2.25, 0.0, 0.75],
        [-1.75, 0.0, 1.25],
    ];
    let paths: [Path; 4] = if with_apexes {
        [
            (0, 0, false, &[0, 6, 7, 8, 5, 4, 1]),
            (0, 1, false, &[1, 4, 9, 6, 0]),
            (1, 0, false, &[2, 5, 8, 7, 3]),
            (1, 1, false, &[3, 7, 6, 9, 4, 5, 2]),
        ]
    } else {
        [
            (0, 0, false, &[0, 6, 7, 5, 4, 1]),
            (0, 1, false, &[1, 4, 6, 0]),
            (1, 0, false, &[2, 5, 7, 3]),
            (1, 1, false, &[3, 7, 6, 4, 5, 2]),
        ]
    };
    let count = if with_apexes { 10 } else { 8 };
    assemble(region, &vertices[..count], &paths)
}

#[test]
fn an_edge_across_an_apex_is_found() {
    let right = report(&eccentric(true));
    assert!(right.is_ok(), "{right}");
    assert_eq!(kinds(&eccentric(false)), [FaultKind::NotMonotone]);
}

#[test]
fn a_lost_component_is_found() {
    let loops: [&[[f64; 3]]; 2] = [
        &[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]],
        &[[5.0, 0.0, 0.0], [7.0, 0.0, 0.0], [7.0, 2.0, 0.0], [5.0, 2.0, 0.0]],
    ];
    let contours = loops.iter().map(|l| Contour::from_vertices(l)).collect();
    let two = Region::from_parts_unchecked(contours, vec![None, None]);
    let kinds = kinds(&Case { region: two, skeleton: square().skeleton });
    assert!(kinds.contains(&FaultKind::SiteMissing) && kinds.contains(&FaultKind::Component), "{kinds:?}");
}

#[test]
fn scaled_options_scale_every_tolerance() {
    let wide = CheckOptions::default().scaled(10.0);
    assert!((wide.clearance / tolerance::CHECK_CLEARANCE - 10.0).abs() < 1e-12);
    assert_eq!(wide.samples, CheckOptions::default().samples);
}
