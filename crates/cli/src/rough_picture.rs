//! Pictures of a roughing job: one for each level, and one of all in projection.

use crate::console::figure;
use pocketry_cam::rough::{Level, RoughJob, RoughPlan};
use pocketry_geom::mesh::Mesh;
use pocketry_geom::mesh::slice::{SliceOptions, slices};
use pocketry_geom::{BBox, Contour, Region, Segment};
use pocketry_io::plot::{Look, Picture, Projection};
use pocketry_motion::Move;
use std::path::{Path, PathBuf};

/// The pictures with their files: `plot.svg` in projection, and `plot-01.svg`, `plot-02.svg`, ... from the top.
pub(crate) fn all(path: &Path, name: &str, mesh: &Mesh, plan: &RoughPlan, job: &RoughJob) -> Vec<(PathBuf, String)> {
    let heights: Vec<f64> = plan.levels.iter().map(|l| l.z).collect();
    let sections = slices(mesh, &heights, SliceOptions::default());
    let mut pictures = vec![(path.to_owned(), projected(name, plan).to_svg())];
    for (k, (level, section)) in plan.levels.iter().zip(sections).enumerate() {
        let section = section.map(|s| s.region).unwrap_or_default();
        pictures.push((numbered(path, k + 1), of_level(name, level, &section, job).to_svg()));
    }
    pictures
}

fn numbered(path: &Path, number: usize) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-{number:02}.{ending}"))
}

/// The model's section as walls, the stock, and the loops in the order they are made.
fn of_level(name: &str, level: &Level, section: &Region, job: &RoughJob) -> Picture {
    let mut picture = Picture::of(section, format!("{name}, level z {} mm", figure(level.z)));
    let stock = outline(job.stock.plan());
    picture.notes.push(format!("{} loops in {} groups", level.loops.len(), level.groups.len()));
    picture.add("stock", Look::Thin, vec![stock.segments]);
    let borders = level.region.contours().iter().map(|c| c.segments.clone()).collect();
    picture.add("where the tool's centre may be", Look::Skeleton, borders);
    let last = level.loops.len().saturating_sub(1).max(1) as f64;
    for (k, cut) in level.loops.iter().enumerate() {
        picture.add("loop", Look::Loop(k as f64 / last), vec![cut.segments.clone()]);
    }
    picture.add("link", Look::Link, level.links.iter().map(|l| l.segments.clone()).collect());
    picture
}

fn outline(b: BBox) -> Contour {
    let (l, h) = (b.min, b.max);
    Contour::from_vertices(&[[l.x, l.y, 0.0], [h.x, l.y, 0.0], [h.x, h.y, 0.0], [l.x, h.y, 0.0]])
}

/// All moves as seen from the front, right and above, coloured from the top level to the lowest.
fn projected(name: &str, plan: &RoughPlan) -> Picture {
    let mut picture = Picture { title: format!("{name}, all levels"), ..Picture::default() };
    let view = Projection::default();
    let (top, low) = match (plan.levels.first(), plan.levels.last()) {
        (Some(first), Some(last)) => (first.z, last.z),
        _ => return picture,
    };
    let mut paths: Vec<(f64, Vec<Segment>)> = Vec::new();
    for (from, step) in plan.program.steps() {
        let to = step.to();
        if step.feed().is_none() || from.z != to.z {
            continue;
        }
        let curve = step.plan_view(from.xy());
        let pieces = if matches!(step, Move::Arc { .. }) { 16 } else { 1 };
        let place = |k: u32| {
            view.place([
                curve.at(f64::from(k) / f64::from(pieces)).x,
                curve.at(f64::from(k) / f64::from(pieces)).y,
                to.z,
            ])
        };
        let lines = (0..pieces).map(|k| Segment::line(place(k), place(k + 1)));
        match paths.last_mut().filter(|(z, _)| *z == to.z) {
            Some((_, path)) => path.extend(lines),
            None => paths.push((to.z, lines.collect())),
        }
    }
    for (z, path) in paths.into_iter().rev() {
        let share = if top > low { (top - z) / (top - low) } else { 0.0 };
        picture.add("level, top to lowest", Look::Loop(share), vec![path]);
    }
    picture
}
