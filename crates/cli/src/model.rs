//! Reading models as the command line asks for it.

use crate::console;
use crate::drawing;
use crate::failure::{Exit, Failure};
use pocketry_geom::mesh::Mesh;
use pocketry_io::import::Units;
use pocketry_io::import::mesh::{MeshOptions, read_mesh};
use std::path::Path;

/// Reads a model and says what was healed.
pub(crate) fn read(path: &Path, units: Option<Units>) -> Result<Mesh, Failure> {
    let model = read_mesh(path, &MeshOptions { units, ..MeshOptions::default() }).map_err(|e| drawing::failure(&e))?;
    console::warnings(&model.warnings);
    Ok(model.mesh)
}

/// The failure that a model's contours can't be made a region.
pub(crate) fn crossing(z: f64, error: &pocketry_geom::repair::RegionError) -> Failure {
    let message = format!("the model runs through itself at a height of {z} mm: {error}");
    Failure::new(Exit::BadInput, "region", message)
}
