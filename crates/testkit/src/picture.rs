//! A skeleton as an SVG picture, to look at.

use pocketry_geom::skeleton::{EdgeId, SiteShape, Skeleton, check};
use pocketry_geom::{Point, Region, Segment};
use std::fmt::Write;

/// Width of the picture, pixels.
const WIDTH: f64 = 1600.0;

/// Walls black, edges blue (spokes grey), vertices as dots, sites labelled with their numbers, `marks` as red rings.
pub fn svg(region: &Region, skeleton: &Skeleton, marks: &[Point]) -> String {
    let bbox = region.bbox();
    let scale = WIDTH / bbox.size();
    let margin = 20.0;
    let place = |p: Point| [(p.x - bbox.min.x) * scale + margin, (bbox.max.y - p.y) * scale + margin];
    let (w, h) = (bbox.width() * scale + 2.0 * margin, bbox.height() * scale + 2.0 * margin);
    let mut out = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='{w}' height='{h}' font-size='9'>\
         <rect width='100%' height='100%' fill='white'/>\n"
    );
    let mut line = |points: &[Point], colour: &str, width: f64| {
        let list: Vec<String> = points
            .iter()
            .map(|&p| {
                let [x, y] = place(p);
                format!("{x:.2},{y:.2}")
            })
            .collect();
        let _ = writeln!(
            out,
            "<polyline points='{}' fill='none' stroke='{colour}' stroke-width='{width}'/>",
            list.join(" ")
        );
    };
    for s in region.segments() {
        let mut points = Vec::new();
        s.flatten(0.2 / scale, &mut points);
        points.push(s.end());
        line(&points, "black", 1.5);
    }
    for (k, points) in check::edge_polylines(skeleton, region, 15).iter().enumerate() {
        let colour = if is_spoke(skeleton, 2 * k as EdgeId) { "silver" } else { "royalblue" };
        line(points, colour, 1.0);
    }
    for (k, v) in skeleton.vertices().iter().enumerate() {
        let [x, y] = place(v.point);
        let _ = writeln!(out, "<circle cx='{x:.2}' cy='{y:.2}' r='2'><title>v{k} {}</title></circle>", v.clearance);
    }
    for (k, s) in skeleton.sites().iter().enumerate() {
        let [x, y] = place(middle(&s.shape));
        let _ = writeln!(out, "<text x='{x:.2}' y='{y:.2}' fill='green'>{k}</text>");
    }
    for &p in marks {
        let [x, y] = place(p);
        let _ = writeln!(out, "<circle cx='{x:.2}' cy='{y:.2}' r='9' fill='none' stroke='red'/>");
    }
    out.push_str("</svg>\n");
    out
}

fn is_spoke(skeleton: &Skeleton, e: EdgeId) -> bool {
    let corner = |e: EdgeId| matches!(skeleton.sites()[skeleton.site(e) as usize].shape, SiteShape::Point(_));
    let at_boundary = skeleton.origin_clearance(e) == 0.0 || skeleton.target_clearance(e) == 0.0;
    at_boundary && (corner(e) || corner(e ^ 1))
}

fn middle(shape: &SiteShape) -> Point {
    match *shape {
        SiteShape::Line(l) => Segment::Line(l).at(0.5),
        SiteShape::Arc(a) => Segment::Arc(a).at(0.5),
        SiteShape::Point(p) => p,
    }
}
