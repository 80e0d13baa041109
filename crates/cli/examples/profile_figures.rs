//! Figures 3, 4, 9, 10 and 11 of R. Molina-Carmona, A. Jimeno and M. Davia, *Contour pocketing computation using mathematical morphology*, with
//! shapes of the same kind; those of figures 9 and 10 are free-form curves, sampled without fitting arcs.
//!
//! `cargo run -p pocketry --example profile_figures -- docs` writes `profile-figure-3a.svg` … into `docs` and prints what stays.
//!
//! - 3: what a tool of two radii (a) and a round one (b) leave of one shape.
//! - 4: a rectangle cut by a rectangular tool as a whole (b), and by a round one of the same width but for its corners (c).
//! - 9: the offset by a round tool (a) and by a rectangular one (b).
//! - 10: the same shape pocketed by both.
//! - 11: two consecutive segments that are almost parallel.

use pocketry_cam::{Plan, PocketJob, inscribed_circle, plan_profile};
use pocketry_geom::distance::Boundary;
use pocketry_geom::freeform::{Cubic, FreeRegion, closed_bspline};
use pocketry_geom::offset::morphology::eroded;
use pocketry_geom::repair::{RepairOptions, build};
use pocketry_geom::{Contour, Point, Region, Segment, ToolProfile, ToolShape, Vec2, point};
use pocketry_io::plot::{Look, Picture};
use pocketry_io::post::{Dialect, LinuxCnc, OutputUnit, PostOptions};
use pocketry_verify::{VerifyOptions, verify_profile};
use std::error::Error;
use std::f64::consts::PI;
use std::ops::Add;
use std::path::Path;

type Anything = Result<(), Box<dyn Error>>;

/// Distance of the points of a line that are looked at, half that of the lines, mm; such that no line lies on a wall.
const GRID: f64 = 0.1875;

/// What is drawn of a pocket.
#[derive(Clone, Copy, PartialEq)]
enum Drawn {
    Path,
    /// What stays, with the outermost loop only.
    Left,
    Both,
}

/// How far chords may be off the curves of a figure, mm.
const TOLERANCE: f64 = 0.02;

fn main() -> Anything {
    let folder = std::env::args().nth(1).unwrap_or_else(|| "docs".to_owned());
    let folder = Path::new(&folder);
    let armed = armed()?;
    for (letter, word) in [("a", "stadium:14x5"), ("b", "circle:14")] {
        pocketed(folder, &format!("3{letter}"), word, &armed, Drawn::Left)?;
    }
    let rectangle = polygon(&[[0.0, 0.0], [60.0, 0.0], [60.0, 36.0], [0.0, 36.0]])?;
    for (letter, word) in [("b", "rect:12x8"), ("c", "circle:8")] {
        pocketed(folder, &format!("4{letter}"), word, &rectangle, Drawn::Both)?;
    }
    let free = sampled(&[leaf(), island()])?;
    for (letter, word) in [("a", "circle:7"), ("b", "rect:9x5")] {
        offset(folder, &format!("9{letter}"), word, &free)?;
        pocketed(folder, &format!("10{letter}"), word, &free, Drawn::Path)?;
    }
    pocketed(folder, "11", "circle:6", &needle()?, Drawn::Path)
}

fn sampled(contours: &[Vec<Cubic>]) -> Result<Region, Box<dyn Error>> {
    let region = FreeRegion { contours: contours.to_vec() };
    Ok(region.sampled(region.step_for(TOLERANCE))?.region)
}

/// A middle with two arms, and all corners sharp.
fn armed() -> Result<Region, Box<dyn Error>> {
    let corners = [
        [22.0, 0.0],
        [60.0, 0.0],
        [60.0, 12.0],
        [84.0, 10.0],
        [84.0, 18.0],
        [60.0, 18.0],
        [54.0, 36.0],
        [28.0, 36.0],
        [22.0, 26.0],
        [0.0, 28.0],
        [0.0, 19.0],
        [22.0, 19.0],
    ];
    polygon(&corners)
}

/// A ring with five lobes.
fn leaf() -> Vec<Cubic> {
    lobes(Point::ORIGIN, 10, [33.0, 21.0])
}

fn island() -> Vec<Cubic> {
    lobes(point(2.0, -1.0), 6, [8.0, 5.0])
}

fn lobes(center: Point, count: u32, radii: [f64; 2]) -> Vec<Cubic> {
    let turn = std::f64::consts::TAU / f64::from(count);
    let at = |k: u32| center + Vec2::from_angle(turn * f64::from(k)) * radii[k as usize % 2];
    closed_bspline(&(0..count).map(at).collect::<Vec<_>>()).unwrap_or_default()
}

/// A pocket with a wall of two segments at an angle of 2π − 10⁻⁴ within the pocket.
fn needle() -> Result<Region, Box<dyn Error>> {
    let thin = 30.0 * 1e-4;
    let corners = [[0.0, 0.0], [25.0, 0.0], [25.0, 30.0], [25.0 + thin, 0.0], [60.0, 0.0], [52.0, 40.0], [8.0, 40.0]];
    polygon(&corners)
}

fn polygon(corners: &[[f64; 2]]) -> Result<Region, Box<dyn Error>> {
    let vertices: Vec<[f64; 3]> = corners.iter().map(|[x, y]| [*x, *y, 0.0]).collect();
    Ok(build(vec![Contour::from_vertices(&vertices)], &RepairOptions::default())?.region)
}

/// The offset, with the tool at some places of it.
fn offset(folder: &Path, number: &str, word: &str, region: &Region) -> Anything {
    let profile = word.parse::<ToolShape>()?.section(0.0);
    let places = eroded(region, profile.contour(), Point::ORIGIN)?;
    let mut picture = Picture::of(region, "");
    picture.add("offset", Look::Loop(0.2), places.contours().iter().map(|c| c.segments.clone()).collect());
    let every = places.segments().count().div_ceil(24);
    let tools = places.segments().step_by(every).map(|s| profile.contour().translated(s.start().to_vec()).segments);
    picture.add("tool", Look::Thin, tools.collect());
    println!("figure {number}, {word}: {} contours, {:.2} mm² of places", places.contours().len(), places.area());
    write(folder, number, word, String::new(), picture)
}

/// The whole pocket, proven, and what stays.
fn pocketed(folder: &Path, number: &str, word: &str, region: &Region, drawn: Drawn) -> Anything {
    let profile = word.parse::<ToolShape>()?.section(0.0);
    let (_, radius) = inscribed_circle(&profile)?;
    let job = PocketJob::for_diameter(2.0 * radius);
    let plan = plan_profile(region, &profile, &job)?;
    let options = PostOptions::for_tool(job.tool, job.feeds, OutputUnit::Millimetre);
    let text = LinuxCnc.write(&plan.program, &options)?;
    let proof = verify_profile(region, &text, profile.contour(), &VerifyOptions::new(radius))?;
    let left = left_by(region, &profile, &plan);
    let (stays, area) = (2.0 * GRID * left.iter().flatten().map(Segment::length).fold(0.0, Add::add), region.area());
    println!(
        "figure {number}, {word}: proven {}, gouge at most {:.4} mm, {} loops, {stays:.2} mm² stay of {area:.2} mm²",
        proof.is_proven(),
        proof.gouge_depth(),
        plan.loops.len(),
    );
    let mut picture = Picture::of(region, "");
    if drawn != Drawn::Path {
        picture.add("what stays", Look::Rapid, left);
    }
    let last = plan.loops.len().saturating_sub(1).max(1) as f64;
    let shown = if drawn == Drawn::Left { &plan.loops[plan.loops.len() - 1..] } else { &plan.loops[..] };
    for (k, cut) in shown.iter().enumerate() {
        picture.add("loop", Look::Loop(k as f64 / last), vec![cut.segments.clone()]);
    }
    if drawn != Drawn::Left {
        picture.add("link", Look::Link, plan.links.iter().map(|l| l.segments.clone()).collect());
    }
    let start = plan.groups[0].start.to_vec();
    picture.add("tool", Look::Thin, vec![profile.contour().translated(start).segments]);
    write(folder, number, word, format!("{stays:.1} mm² stay of {area:.0} mm²"), picture)
}

fn write(folder: &Path, number: &str, word: &str, note: String, mut picture: Picture) -> Anything {
    picture.title = format!("figure {number}: {word}");
    picture.notes = vec![note];
    Ok(std::fs::write(folder.join(format!("profile-figure-{number}.svg")), picture.to_svg())?)
}

/// Lines through the parts of the region that the tool covers nowhere on the path.
fn left_by(region: &Region, profile: &ToolProfile, plan: &Plan) -> Vec<Vec<Segment>> {
    let shape = Boundary::new(&Region::from_parts_unchecked(vec![profile.contour().clone()], vec![None]));
    let path: Vec<Segment> = plan.loops.iter().flat_map(|l| l.segments.iter().copied()).collect();
    let reach = profile.reach();
    let covered = |q: Point| {
        path.iter().filter(|way| way.distance(q) <= reach).any(|way| {
            // The tool about p covers q where q − p lies in the profile.
            let seen = way.rotated(PI).translated(q.to_vec());
            shape.contains(seen.start()) || shape.distance_to(&seen) == 0.0
        })
    };
    let b = region.bbox();
    let (columns, rows) = ((b.width() / GRID).ceil() as u32, (b.height() / (2.0 * GRID)).ceil() as u32);
    let at = |i: u32, j: u32| b.min + Vec2::new(f64::from(i) + 0.5, 2.0 * (f64::from(j) + 0.5)) * GRID;
    let mut lines = Vec::new();
    for row in 0..rows {
        let left: Vec<u32> = (0..columns).filter(|&i| region.contains(at(i, row)) && !covered(at(i, row))).collect();
        let runs = left.chunk_by(|a, b| b - a == 1);
        lines.extend(runs.map(|run| vec![Segment::line(at(run[0], row), at(run[run.len() - 1] + 1, row))]));
    }
    lines
}
