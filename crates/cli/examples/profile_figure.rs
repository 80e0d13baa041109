//! Figure 4 of R. Molina-Carmona, A. Jimeno and M. Davia, *Contour pocketing computation using mathematical morphology*: a rectangle cut
//! by a rectangular tool as a whole, and by a round one of the same width but for its corners.
//!
//! `cargo run -p pocketry --example profile_figure -- docs` writes `profile-figure-4b.svg` and `profile-figure-4c.svg` into `docs`
//! and prints what stays.

use pocketry_cam::{Plan, PocketJob, inscribed_circle, plan_profile};
use pocketry_geom::distance::Boundary;
use pocketry_geom::{Contour, Point, Region, Segment, ToolProfile, ToolShape, vec2};
use pocketry_io::plot::{Look, Picture};
use pocketry_io::post::{Dialect, LinuxCnc, OutputUnit, PostOptions};
use pocketry_verify::{VerifyOptions, verify_profile};
use std::error::Error;
use std::path::Path;

/// Distance of the points that are looked at, mm.
const GRID: f64 = 0.2;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| "docs".to_owned());
    let corners = [[0.0, 0.0, 0.0], [60.0, 0.0, 0.0], [60.0, 36.0, 0.0], [0.0, 36.0, 0.0]];
    let region = Region::from_parts_unchecked(vec![Contour::from_vertices(&corners)], vec![None]);
    for (letter, word) in [("b", "rect:12x8"), ("c", "circle:8")] {
        let profile = word.parse::<ToolShape>()?.section(0.0);
        let (_, radius) = inscribed_circle(&profile)?;
        let job = PocketJob::for_diameter(2.0 * radius);
        let plan = plan_profile(&region, &profile, &job)?;
        let text =
            LinuxCnc.write(&plan.program, &PostOptions::for_tool(job.tool, job.feeds, OutputUnit::Millimetre))?;
        let proof = verify_profile(&region, &text, profile.contour(), &VerifyOptions::new(radius))?;
        let left = left_by(&region, &profile, &plan);
        let area = left.len() as f64 * GRID * GRID;
        println!(
            "{word}: proven {}, gouge at most {:.4} mm, out of reach {area:.2} mm² of {} mm² (on a grid of {GRID} mm)",
            proof.is_proven(),
            proof.gouge_depth(),
            region.area()
        );
        let mut picture = figure(&region, &profile, &left, &plan);
        picture.title = format!("figure 4{letter}: {word}");
        picture.notes = vec![format!("{area:.2} mm² stay of {} mm²", region.area())];
        std::fs::write(Path::new(&folder).join(format!("profile-figure-4{letter}.svg")), picture.to_svg())?;
    }
    Ok(())
}

/// The points of a grid in the region that the tool covers nowhere on the path.
fn left_by(region: &Region, profile: &ToolProfile, plan: &Plan) -> Vec<Point> {
    let shape = Boundary::new(&Region::from_parts_unchecked(vec![profile.contour().clone()], vec![None]));
    let path: Vec<Segment> = plan.loops.iter().flat_map(|l| l.segments.iter().copied()).collect();
    let covers = |q: Point, way: &Segment| {
        // The tool about p covers q where q − p lies in the profile.
        let seen = Segment::line((q - way.start()).to_point(), (q - way.end()).to_point());
        shape.contains(seen.start()) || shape.distance_to(&seen) == 0.0
    };
    let b = region.bbox();
    let (columns, rows) = ((b.width() / GRID) as u32, (b.height() / GRID) as u32);
    let at = |i: u32, j: u32| b.min + vec2(f64::from(i) + 0.5, f64::from(j) + 0.5) * GRID;
    let points = (0..columns).flat_map(|i| (0..rows).map(move |j| at(i, j)));
    points.filter(|&q| !path.iter().any(|way| covers(q, way))).collect()
}

/// Loops, what stays, and the tool in a corner and where it begins.
fn figure(region: &Region, profile: &ToolProfile, left: &[Point], plan: &Plan) -> Picture {
    let mut picture = Picture::of(region, "");
    let last = plan.loops.len().saturating_sub(1).max(1) as f64;
    for (k, cut) in plan.loops.iter().enumerate() {
        picture.add("loop", Look::Loop(k as f64 / last), vec![cut.segments.clone()]);
    }
    picture.add("link", Look::Link, plan.links.iter().map(|l| l.segments.clone()).collect());
    let dot = |p: &Point| vec![Segment::line(*p - vec2(0.3 * GRID, 0.0), *p + vec2(0.3 * GRID, 0.0))];
    picture.add("what stays", Look::Rapid, left.iter().map(dot).collect());
    let b = profile.contour().bbox();
    let corner = region.bbox().min - b.min.to_vec();
    let places = [corner.to_vec(), plan.groups[0].start.to_vec()];
    let tools = places.map(|at| profile.contour().translated(at).segments).to_vec();
    picture.add("tool", Look::Thin, tools);
    picture
}
