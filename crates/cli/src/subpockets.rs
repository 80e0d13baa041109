//! `pocketry subpockets`.

use crate::args::SubpocketsArgs;
use crate::console::{self, figure};
use crate::drawing;
use crate::failure::{Exit, Failure};
use crate::offset::Form;
use crate::output::write_or_print;
use pocketry_geom::skeleton::Skeleton;
use pocketry_geom::subpockets::{Subpocket, Subpockets};
use pocketry_io::export::{Sheet, to_dxf, to_svg};
use serde::Serialize;

/// Lengths in mm, areas in mm²; contours are lists of `[x, y, bulge]`.
#[derive(Serialize)]
struct File {
    units: &'static str,
    subpockets: Vec<Entry>,
    passes: Vec<PassEntry>,
}

#[derive(Serialize)]
struct Entry {
    area: f64,
    /// Radius of the largest circle in it.
    clearance: f64,
    /// Vertices of its peak.
    peak: Vec<[f64; 2]>,
    annulus: bool,
    contours: Vec<Vec<[f64; 3]>>,
}

#[derive(Serialize)]
struct PassEntry {
    /// The subpockets that meet there, numbered from 0.
    between: [u32; 2],
    at: [f64; 2],
    /// Width of the bottleneck.
    width: f64,
    /// Ends of the critical edges.
    feet: [[f64; 2]; 2],
}

pub(crate) fn run(args: &SubpocketsArgs) -> Result<(), Failure> {
    let form = Form::of(args.output.as_deref())?;
    let drawing = drawing::read(&args.input, &args.drawing)?;
    console::warnings(&drawing.warnings);
    let skeleton = Skeleton::build(&drawing.region).map_err(|e| Failure::new(Exit::NotProven, "skeleton", e))?;
    let subpockets = Subpockets::new(&skeleton);
    let text = match form {
        Form::Dxf => to_dxf(&sheets(&subpockets)),
        Form::Svg => to_svg(&sheets(&subpockets)),
        Form::Json => to_json(&subpockets),
    };
    write_or_print(args.output.as_deref(), &text)
}

fn sheets(subpockets: &Subpockets) -> Vec<Sheet> {
    let sheet = |(k, s): (usize, &Subpocket)| Sheet {
        name: format!("subpocket {} clearance {}", k + 1, figure(s.clearance)),
        distance: None,
        loops: s.contours.clone(),
    };
    subpockets.list().iter().enumerate().map(sheet).collect()
}

fn to_json(subpockets: &Subpockets) -> String {
    let place = |p: pocketry_geom::Point| [p.x, p.y];
    let vertex = |&v: &u32| place(subpockets.skeleton().vertices()[v as usize].point);
    let entry = |s: &Subpocket| Entry {
        area: s.area(),
        clearance: s.clearance,
        peak: s.peak.iter().map(vertex).collect(),
        annulus: s.is_annulus,
        contours: s.contours.iter().map(pocketry_geom::Contour::to_vertices).collect(),
    };
    let passes = subpockets.borders().iter().map(|b| PassEntry {
        between: b.between,
        at: place(b.pass),
        width: 2.0 * b.clearance,
        feet: b.feet.map(place),
    });
    let file =
        File { units: "mm", subpockets: subpockets.list().iter().map(entry).collect(), passes: passes.collect() };
    // Numbers, strings and lists only: this can't fail.
    let mut text = serde_json::to_string(&file).unwrap_or_default();
    text.push('\n');
    text
}
