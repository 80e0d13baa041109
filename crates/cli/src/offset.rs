//! `pocketry offset`.

use crate::args::{Engine, OffsetArgs};
use crate::console::{self, figure};
use crate::drawing;
use crate::failure::{Exit, Failure};
use crate::output::{form_of, write_or_print};
use pocketry_geom::Segment;
use pocketry_geom::offset::{BisectorEngine, Offset, OffsetEngine, OffsetOptions, PairwiseEngine, VoronoiEngine};
use pocketry_io::export::{Sheet, to_dxf, to_json, to_svg};
use std::path::Path;

/// The form of a written file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    Dxf,
    Svg,
    Json,
}

impl Form {
    /// By the file's ending; JSON for standard output.
    pub(crate) fn of(path: Option<&Path>) -> Result<Self, Failure> {
        form_of(path, &[("dxf", Self::Dxf), ("svg", Self::Svg), ("json", Self::Json)], Self::Json)
    }
}

pub(crate) fn run(args: &OffsetArgs) -> Result<(), Failure> {
    let form = Form::of(args.output.as_deref())?;
    let drawing = drawing::read(&args.input, &args.drawing)?;
    console::warnings(&drawing.warnings);
    let failed = |e| Failure::new(Exit::NotProven, "offset", e);
    let bisector = BisectorEngine::default();
    let engine: &dyn OffsetEngine = match args.engine {
        Engine::Voronoi => &VoronoiEngine,
        Engine::Pairwise => &PairwiseEngine,
        Engine::Bisector => &bisector,
    };
    if args.engine == Engine::Bisector && drawing.region.segments().any(|s| matches!(s, Segment::Arc(_))) {
        let within = figure(bisector.chord_tolerance);
        console::warnings(&[format!(
            "arcs were replaced by chords within {within} mm: the bisector engine takes lines only"
        )]);
    }
    let offsets = engine.offsets(&drawing.region, &args.distance, &OffsetOptions::default()).map_err(failed)?;
    let empty: Vec<String> = offsets
        .iter()
        .filter(|o| o.loops.is_empty())
        .map(|o| format!("nothing is left at a distance of {} mm", figure(o.distance)))
        .collect();
    console::warnings(&empty);
    let sheets: Vec<Sheet> = offsets.into_iter().map(sheet).collect();
    let text = match form {
        Form::Dxf => to_dxf(&sheets),
        Form::Svg => to_svg(&sheets),
        Form::Json => to_json(&sheets),
    };
    write_or_print(args.output.as_deref(), &text)
}

fn sheet(offset: Offset) -> Sheet {
    Sheet {
        name: format!("offset {}", figure(offset.distance)),
        distance: Some(offset.distance),
        loops: offset.loops.into_iter().map(|l| l.contour).collect(),
    }
}
