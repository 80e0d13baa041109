//! Draws mitre-joined offsets like figures 12 and 13 of Kim, Lee and Yang as SVG: shapes with and without islands, and a section of
//! about 2,069 lines at 3 mm.
//!
//! `cargo run --release -p pocketry-geom --example bisector_figures -- docs`

use pocketry_geom::offset::{BisectorEngine, OffsetEngine, OffsetOptions};
use pocketry_geom::{Contour, Region};
use pocketry_testkit::{Loops, corpus, shapes};
use std::error::Error;
use std::f64::consts::TAU;
use std::fmt::Write;
use std::path::PathBuf;

/// Width and height of a panel, pixels.
const PANEL: f64 = 320.0;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "docs".to_owned()));
    let panels = [star(false), star(true), gear(), vec![shapes::comb(5, 9.0)], labyrinth(), islands()];
    std::fs::write(folder.join("bisector-figure-12.svg"), sheet(&panels, 3, 12)?)?;
    std::fs::write(folder.join("bisector-figure-13.svg"), section()?)?;
    Ok(())
}

fn star(island: bool) -> Loops {
    let at = |scale: f64| {
        let long = |t: f64| ((t / TAU * 10.0).round() as usize).is_multiple_of(2);
        shapes::polar(10, |t| scale * if long(t) { 20.0 } else { 9.0 })
    };
    if island { vec![at(1.0), at(0.3)] } else { vec![at(1.0)] }
}

fn gear() -> Loops {
    let mut outline = shapes::gear(12, 18.0, 23.0);
    for v in &mut outline {
        v[2] = 0.0;
    }
    vec![outline, shapes::ngon(6, 5.0, [0.0; 2])]
}

/// Four walls of a labyrinth as islands.
fn labyrinth() -> Loops {
    let wall = |x0: f64, y0: f64, x1: f64, y1: f64| vec![[x0, y0, 0.0], [x1, y0, 0.0], [x1, y1, 0.0], [x0, y1, 0.0]];
    vec![
        wall(0.0, 0.0, 40.0, 40.0),
        wall(8.0, 8.0, 32.0, 10.0),
        wall(8.0, 18.0, 10.0, 34.0),
        wall(18.0, 18.0, 34.0, 20.0),
        wall(18.0, 28.0, 26.0, 32.0),
    ]
}

fn islands() -> Loops {
    let islands = (0..5).map(|k| (3 + k, f64::from(k as u32) * TAU / 5.0));
    let around = islands.map(|(n, t)| shapes::ngon(n, 3.5, [11.0 * t.cos(), 11.0 * t.sin()]));
    std::iter::once(shapes::ngon(9, 20.0, [0.0; 2])).chain(around).collect()
}

fn section() -> Result<String, Box<dyn Error>> {
    let file = corpus::shared().map(|folder| folder.join("corpus/dev/mesh.jsonl"));
    let records = file.and_then(|f| corpus::read(&f).ok()).unwrap_or_default();
    let speaker = records.into_iter().find(|r| r.id == "mesh/literature/speaker-2069a");
    let loops = speaker.map_or_else(|| shapes::die_cavity(2069), |r| r.loops);
    let region = corpus::region(&loops)?;
    let offset = BisectorEngine::default().offsets(&region, &[3.0], &OffsetOptions::default())?;
    let loops = offset[0].loops.iter().map(|l| &l.contour);
    let drawing = panel(&region, loops, 0.0, 0.0, 2.5 * PANEL);
    Ok(svg(2.5 * PANEL, 2.5 * PANEL, &drawing))
}

/// Panels with `count` loops each, up to a third of the size.
fn sheet(panels: &[Loops], columns: usize, count: usize) -> Result<String, Box<dyn Error>> {
    let mut drawing = String::new();
    for (k, loops) in panels.iter().enumerate() {
        let region = corpus::region(loops)?;
        let step = region.bbox().size() / 4.0 / count as f64;
        let distances: Vec<f64> = (1..=2 * count).map(|j| j as f64 * step).collect();
        let family = BisectorEngine::default().offsets(&region, &distances, &OffsetOptions::default())?;
        let contours = family.iter().flat_map(|o| o.loops.iter().map(|l| &l.contour));
        let (x, y) = ((k % columns) as f64 * PANEL, (k / columns) as f64 * PANEL);
        drawing += &panel(&region, contours, x, y, PANEL);
    }
    Ok(svg(columns as f64 * PANEL, panels.len().div_ceil(columns) as f64 * PANEL, &drawing))
}

fn svg(width: f64, height: f64, drawing: &str) -> String {
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='{width}' height='{height}'>\
         <rect width='100%' height='100%' fill='white'/>\n{drawing}</svg>\n"
    )
}

fn panel<'a>(region: &Region, offsets: impl Iterator<Item = &'a Contour>, x: f64, y: f64, side: f64) -> String {
    let bbox = region.bbox();
    let scale = 0.92 * side / bbox.size();
    let mut out = String::new();
    let mut draw = |contour: &Contour, colour: &str, width: f64| {
        let _ = write!(out, "<polygon fill='none' stroke='{colour}' stroke-width='{width}' points='");
        for s in &contour.segments {
            let v = s.start() - bbox.center();
            let _ = write!(out, "{:.2},{:.2} ", x + 0.5 * side + scale * v.x, y + 0.5 * side - scale * v.y);
        }
        out.push_str("'/>\n");
    };
    for c in offsets {
        draw(c, "royalblue", 0.8);
    }
    for c in region.contours() {
        draw(c, "black", 1.6);
    }
    out
}
