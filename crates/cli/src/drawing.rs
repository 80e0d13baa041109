//! Reading drawings as the command line asks for it.

use crate::args::{DrawingArgs, Origin};
use crate::failure::{Exit, Failure};
use pocketry_geom::{Region, Vec2, vec2};
use pocketry_io::import::{self, Drawing, ImportError, ImportOptions};
use std::path::Path;

/// Reads a drawing.
pub(crate) fn read(path: &Path, args: &DrawingArgs) -> Result<Drawing, Failure> {
    let drawing = import::read(path, &options(args)).map_err(|e| failure(&e))?;
    Ok(placed(drawing, args.origin))
}

/// Reads a line of a batch.
pub(crate) fn parse(text: &str, args: &DrawingArgs) -> Result<Drawing, Failure> {
    let drawing = import::parse_region_json(text, &options(args)).map_err(|e| failure(&e))?;
    Ok(placed(drawing, args.origin))
}

/// The failure that an import error is.
pub(crate) fn failure(error: &ImportError) -> Failure {
    let exit = if error.is_io() { Exit::InputOutput } else { Exit::BadInput };
    Failure::new(exit, error.kind(), error)
}

fn options(args: &DrawingArgs) -> ImportOptions {
    let origin = match args.origin {
        Origin::Drawing | Origin::At(..) => import::Origin::Keep,
        Origin::Center => import::Origin::Center,
        Origin::LowerLeft => import::Origin::LowerLeft,
    };
    ImportOptions { layers: args.layer.clone(), units: args.units, origin, ..ImportOptions::default() }
}

fn placed(mut drawing: Drawing, origin: Origin) -> Drawing {
    if let Origin::At(x, y) = origin {
        drawing.region = moved(&drawing.region, vec2(-x, -y));
    }
    drawing
}

fn moved(region: &Region, by: Vec2) -> Region {
    let contours = region.contours().iter().map(|c| c.translated(by)).collect();
    Region::from_parts_unchecked(contours, region.parents().to_vec())
}
