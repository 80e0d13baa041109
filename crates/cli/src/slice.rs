//! `pocketry slice`.

use crate::args::SliceArgs;
use crate::console::{self, figure};
use crate::failure::Failure;
use crate::model;
use crate::output::{form_of, write_or_print};
use pocketry_geom::mesh::slice::{Slice, SliceOptions, slices};
use pocketry_io::export::{Sheet, to_dxf, to_region_json, to_svg};
use std::path::Path;

/// The form of a written file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Dxf,
    Svg,
    JsonLines,
}

impl Form {
    /// By the file's ending; JSON lines for standard output.
    fn of(path: Option<&Path>) -> Result<Self, Failure> {
        form_of(path, &[("dxf", Self::Dxf), ("svg", Self::Svg), ("jsonl", Self::JsonLines)], Self::JsonLines)
    }
}

pub(crate) fn run(args: &SliceArgs) -> Result<(), Failure> {
    let form = Form::of(args.output.as_deref())?;
    let mesh = model::read(&args.input, args.units)?;
    let name = args.input.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let mut made = Vec::new();
    for (&z, slice) in args.z.iter().zip(slices(&mesh, &args.z, SliceOptions::default())) {
        let slice = slice.map_err(|e| model::crossing(z, &e))?;
        console::warnings(&remarks(&slice));
        made.push(slice);
    }
    let text = match form {
        Form::Dxf => to_dxf(&sheets(made)),
        Form::Svg => to_svg(&sheets(made)),
        Form::JsonLines => made
            .iter()
            .filter(|s| !s.region.contours().is_empty())
            .map(|s| to_region_json(&format!("{name}-z{}", s.z), &s.region))
            .collect(),
    };
    write_or_print(args.output.as_deref(), &text)
}

/// What is missing or was changed.
fn remarks(slice: &Slice) -> Vec<String> {
    let at = format!("at z {} mm", figure(slice.z));
    let mut out: Vec<String> = slice
        .gaps
        .iter()
        .map(|g| {
            let (a, b) = (g.start, g.end);
            format!(
                "{at}: a contour is open between ({:.4}, {:.4}) and ({:.4}, {:.4}) and was left out",
                a.x, a.y, b.x, b.y
            )
        })
        .collect();
    if slice.joined > 0 {
        out.push(format!("{at}: {} gap(s) within the join tolerance were closed", slice.joined));
    }
    out.extend(slice.notes.iter().map(|n| format!("{at}: {n}")));
    if slice.region.contours().is_empty() {
        out.push(format!("{at}: the plane cuts nothing out of the model"));
    }
    out
}

fn sheets(slices: Vec<Slice>) -> Vec<Sheet> {
    let sheet =
        |s: Slice| Sheet { name: format!("z {}", figure(s.z)), distance: None, loops: s.region.contours().to_vec() };
    slices.into_iter().map(sheet).collect()
}
