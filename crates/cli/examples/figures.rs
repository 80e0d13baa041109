//! Figures 1 to 5 of J. J. Chou and E. Cohen, *Computing Offsets and Tool Paths With Voronoi Diagrams*, drawn from a pocket with
//! arcs and an island.
//!
//! `cargo run -p pocketry --example figures -- docs` writes `figure-1.svg` … `figure-5.svg` into `docs`.

use pocketry_cam::{LinkKind, Plan, PocketJob, plan, plan_subpockets};
use pocketry_geom::offset::voronoi::{EdgeCurve, upward};
use pocketry_geom::repair::{self, RepairOptions};
use pocketry_geom::skeleton::trees::{Kind, Trees};
use pocketry_geom::skeleton::{EdgeId, Skeleton};
use pocketry_geom::subpockets::Subpockets;
use pocketry_geom::{Contour, Point, Region, Segment, vec2};
use pocketry_io::plot::{Look, Picture, Spot};
use std::error::Error;
use std::path::Path;

/// How far a drawn edge may lie from the true one, mm.
const DRAWING: f64 = 0.01;
/// Half the size of a cross, mm.
const CROSS: f64 = 1.2;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| "docs".to_owned());
    let region = pocket()?;
    let skeleton = Skeleton::build(&region)?;
    let trees = Trees::new(&skeleton);
    let subpockets = Subpockets::new(&skeleton);
    let job = PocketJob { stepover: 2.5, ..PocketJob::for_diameter(5.0) };
    let figures = [
        skeleton_figure(&region, &skeleton, &trees),
        trees_figure(&region, &skeleton, &trees),
        path_figure("offsets and tool path I", &region, &plan(&region, &skeleton, &job)?),
        subpockets_figure(&region, &subpockets),
        path_figure("loops and tool path II", &region, &plan_subpockets(&region, &skeleton, &job)?),
    ];
    for (k, figure) in figures.iter().enumerate() {
        std::fs::write(Path::new(&folder).join(format!("figure-{}.svg", k + 1)), figure.to_svg())?;
    }
    Ok(())
}

/// Two chambers of lines and arcs, one with an island.
fn pocket() -> Result<Region, Box<dyn Error>> {
    let outer = [
        [0.0, 0.0, 0.0],
        [45.0, 0.0, 0.0],
        [52.0, 18.0, 0.0],
        [58.0, 0.0, 0.0],
        [90.0, 0.0, 0.414],
        [100.0, 10.0, 0.0],
        [100.0, 44.0, 0.3],
        [84.0, 60.0, 0.0],
        [64.0, 60.0, -0.8],
        [40.0, 60.0, 0.0],
        [0.0, 60.0, 0.2],
    ];
    let island = [[16.0, 22.0, 0.0], [28.0, 20.0, 0.5], [30.0, 36.0, 0.0], [18.0, 38.0, 0.3]];
    let contours = vec![Contour::from_vertices(&outer), Contour::from_vertices(&island)];
    Ok(repair::build(contours, &RepairOptions::default())?.region)
}

fn edge(skeleton: &Skeleton, e: EdgeId) -> Vec<Segment> {
    EdgeCurve::new(skeleton, e).whole(true, DRAWING)
}

fn edges(skeleton: &Skeleton) -> Vec<Vec<Segment>> {
    (0..skeleton.edge_count() as EdgeId).map(|k| edge(skeleton, upward(skeleton, 2 * k))).collect()
}

fn places(skeleton: &Skeleton, trees: &Trees, kind: Kind) -> Vec<Point> {
    let first = |k: u32| skeleton.vertices()[trees.plateaus()[k as usize].vertices[0] as usize].point;
    trees.of_kind(kind).map(first).collect()
}

fn mark_extremes(picture: &mut Picture, skeleton: &Skeleton, trees: &Trees) {
    for at in places(skeleton, trees, Kind::Peak) {
        picture.spots.push(Spot { at, radius: CROSS, name: "peak".to_owned() });
    }
    let stroke = |p: Point, dy: f64| vec![Segment::line(p - vec2(CROSS, dy), p + vec2(CROSS, dy))];
    let passes = places(skeleton, trees, Kind::Pass);
    picture.add("pass", Look::Rapid, passes.iter().flat_map(|&p| [stroke(p, CROSS), stroke(p, -CROSS)]).collect());
}

/// Figure 1: the skeleton, its peaks circled, its passes crossed.
fn skeleton_figure(region: &Region, skeleton: &Skeleton, trees: &Trees) -> Picture {
    let mut picture = Picture::of(region, "the skeleton");
    picture.add("skeleton", Look::Skeleton, edges(skeleton));
    mark_extremes(&mut picture, skeleton, trees);
    picture
}

/// Figure 2: the trees and their key branches.
fn trees_figure(region: &Region, skeleton: &Skeleton, trees: &Trees) -> Picture {
    let mut picture = Picture::of(region, "trees with key branches");
    picture.add("tree", Look::Skeleton, edges(skeleton));
    let key = trees.controls().iter().flat_map(|c| &c.key_branch).map(|&e| edge(skeleton, e)).collect();
    picture.add("key branch", Look::Link, key);
    mark_extremes(&mut picture, skeleton, trees);
    picture
}

/// Figures 3 and 5: loops in the order of cutting, and the ways between them.
fn path_figure(title: &str, region: &Region, plan: &Plan) -> Picture {
    let mut picture = Picture::of(region, title);
    let last = plan.loops.len().saturating_sub(1).max(1) as f64;
    for (k, cut) in plan.loops.iter().enumerate() {
        picture.add("loop", Look::Loop(k as f64 / last), vec![cut.segments.clone()]);
    }
    let links = |entry: bool| {
        let wanted = plan.links.iter().filter(|l| (l.kind == LinkKind::Entry) == entry);
        wanted.map(|l| l.segments.clone()).collect::<Vec<_>>()
    };
    picture.add("link", Look::Link, links(false));
    picture.add("entry", Look::Entry, links(true));
    picture.notes = vec![format!("{} loops, {} groups", plan.loops.len(), plan.groups.len())];
    picture
}

/// Figure 4: the subpockets and the critical edges between them.
fn subpockets_figure(region: &Region, subpockets: &Subpockets) -> Picture {
    let mut picture = Picture::of(region, "subpockets");
    let critical = subpockets.critical_edges().map(|(pass, foot)| vec![Segment::line(pass, foot)]).collect();
    let last = subpockets.list().len().saturating_sub(1).max(1) as f64;
    for (k, s) in subpockets.list().iter().enumerate() {
        let contours = s.contours.iter().map(|c| c.segments.clone()).collect();
        picture.add("subpocket", Look::Loop(k as f64 / last), contours);
    }
    picture.add("critical edge", Look::Link, critical);
    let place = |v: u32| subpockets.skeleton().vertices()[v as usize].point;
    picture.spots.extend(subpockets.list().iter().map(|s| Spot {
        at: place(s.peak[0]),
        radius: CROSS,
        name: "peak".to_owned(),
    }));
    picture
}
