//! Models: STL (binary and ASCII), OBJ and 3MF become a [`Mesh`] in millimetres.
//!
//! Every reader ends in the same place: loose triangles, welded and judged here. What can't be a model is an
//! [`ImportError`] that names the facet or the line; what was healed, or what the model lacks to be a solid, is a [`Warning`].
//!
//! STL and OBJ are read by code of our own: the crates tried say neither line nor facet of what is wrong, and both readers
//! are small. 3MF is a zip archive of XML, read through `zip` and `roxmltree`.

mod obj;
mod stl;
mod threemf;

use super::error::{FaultKind, ImportError, Place, Warning};
use super::read_bytes;
use super::units::Units;
use pocketry_geom::mesh::{Corner, Mesh, Welded};
use pocketry_geom::tolerance::{ABSURD, JOIN, SMALLEST_SIZE};
use std::path::Path;

/// More facets than this are refused: the file is no model of a part.
const MOST_FACETS: usize = 50_000_000;

/// How a model is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshOptions {
    /// The unit of the model's numbers, in place of what the file says; STL and OBJ say nothing and mean millimetres.
    pub units: Option<Units>,
    /// Vertices along open edges this near to one another are joined, mm. Default: [`JOIN`].
    pub weld_tolerance: f64,
}

impl Default for MeshOptions {
    fn default() -> Self {
        Self { units: None, weld_tolerance: JOIN }
    }
}

/// A model that has been read.
#[derive(Clone, Debug)]
pub struct Model {
    /// Its surface, mm, outside out where it is closed.
    pub mesh: Mesh,
    /// What was healed, and what it lacks to be a solid.
    pub warnings: Vec<Warning>,
}

/// Loose triangles as a file holds them.
#[derive(Debug, Default)]
struct Soup {
    triangles: Vec<[Corner; 3]>,
    units: Option<Units>,
    /// The line at which each triangle begins, for messages, where there are lines.
    lines: Option<Vec<usize>>,
    warnings: Vec<Warning>,
}

impl Soup {
    /// Where a triangle stands in the file.
    fn place(&self, triangle: usize) -> Place {
        Place { line: self.lines.as_ref().and_then(|l| l.get(triangle)).copied(), ..facet(triangle) }
    }
}

/// A facet's place, counted from 1.
fn facet(triangle: usize) -> Place {
    Place { entity: Some(format!("facet {}", triangle + 1)), ..Place::default() }
}

/// Reads a model: STL, OBJ or 3MF, by its name's extension, or its content where that says nothing.
///
/// # Errors
/// [`ImportError::Io`] where the file can't be read, [`ImportError::Bad`] where it can and is no model.
pub fn read_mesh(path: &Path, options: &MeshOptions) -> Result<Model, ImportError> {
    parse_mesh(path, &read_bytes(path)?, options)
}

/// The model in a file's bytes; the name serves for its extension and for messages.
///
/// # Errors
/// [`ImportError::Bad`] where the bytes are no model.
pub fn parse_mesh(name: &Path, bytes: &[u8], options: &MeshOptions) -> Result<Model, ImportError> {
    let mut model = parse_kind(name, bytes).and_then(|soup| build(soup, options)).map_err(|e| e.in_file(name))?;
    for warning in &mut model.warnings {
        warning.place.file.get_or_insert_with(|| name.to_owned());
    }
    Ok(model)
}

fn parse_kind(name: &Path, bytes: &[u8]) -> Result<Soup, ImportError> {
    let extension = name.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase).unwrap_or_default();
    match extension.as_str() {
        _ if bytes.trim_ascii().is_empty() => {
            Err(ImportError::new(FaultKind::Empty, Place::default(), "the file is empty", "export the model again"))
        }
        "stl" => stl::read(bytes),
        "obj" => obj::read(bytes),
        "3mf" => threemf::read(bytes),
        _ if bytes.starts_with(b"PK\x03\x04") => threemf::read(bytes),
        _ if stl::looks_like(bytes) => stl::read(bytes),
        _ => {
            let problem = "not a model of a known kind";
            Err(ImportError::new(FaultKind::Format, Place::default(), problem, "give a .stl, .obj or .3mf file"))
        }
    }
}

fn build(mut soup: Soup, options: &MeshOptions) -> Result<Model, ImportError> {
    let units = options.units.or(soup.units).unwrap_or_default().millimeters();
    check(&mut soup, units)?;
    let Welded { mesh, collapsed, joined, farthest } = Mesh::weld(&soup.triangles, options.weld_tolerance);
    let mut warnings = soup.warnings;
    let mut warn = |message: String| warnings.push(Warning::new(Place::default(), message));
    let empty = |problem: &str| {
        Err(ImportError::new(FaultKind::Empty, Place::default(), problem, "export the model as a solid"))
    };
    if mesh.facets().is_empty() {
        return empty("there is no facet with an area in it");
    }
    let (low, high) = mesh.heights();
    if mesh.bbox().size() < SMALLEST_SIZE || high - low < SMALLEST_SIZE {
        return empty("the model is flat: it has no height or no extent");
    }
    if collapsed > 0 {
        warn(format!("{collapsed} facet(s) without area were dropped"));
    }
    if joined > 0 {
        warn(format!("cracks closed: {joined} vertices along open edges joined, the farthest over {farthest:.3e} mm"));
    }
    let flaws = mesh.flaws();
    if flaws.inverted {
        warn("the model was inside out and has been turned over".to_owned());
        return Ok(Model { mesh: mesh.inverted(), warnings });
    }
    flaws.complaints().into_iter().for_each(warn);
    Ok(Model { mesh, warnings })
}

/// Every number finite and of a sane size; converts to millimetres.
fn check(soup: &mut Soup, units: f64) -> Result<(), ImportError> {
    if soup.triangles.is_empty() {
        let hint = "export the model's solid or surface as triangles";
        return Err(ImportError::new(FaultKind::Empty, Place::default(), "there is no facet in it", hint));
    }
    let sane = |c: &f64| (c * units).abs() <= ABSURD;
    if let Some(bad) = soup.triangles.iter().position(|t| !t.iter().flatten().all(sane)) {
        let corner = soup.triangles[bad].into_iter().find(|c| !c.iter().all(sane)).unwrap_or_default();
        return Err(nowhere(corner, soup.place(bad)));
    }
    if units != 1.0 {
        soup.triangles.iter_mut().flatten().flatten().for_each(|c| *c *= units);
    }
    Ok(())
}

/// The corner if its numbers are finite; units don't matter for that, so that readers can ask while they know the very line.
fn finite(corner: Corner, place: impl FnOnce() -> Place) -> Result<Corner, ImportError> {
    if corner.iter().all(|c| c.is_finite()) { Ok(corner) } else { Err(nowhere(corner, place())) }
}

fn nowhere([x, y, z]: Corner, place: Place) -> ImportError {
    let problem = format!("the corner ({x}, {y}, {z}) is no place of a part");
    ImportError::new(FaultKind::Value, place, problem, "export the model again")
}

/// Refuses one facet more than any model has.
fn check_count(count: usize) -> Result<(), ImportError> {
    if count <= MOST_FACETS {
        return Ok(());
    }
    let problem = format!("more than {MOST_FACETS} facets");
    Err(ImportError::new(FaultKind::Limit, Place::default(), problem, "export the model with a coarser tolerance"))
}
