//! The loops of a level from engines that need no skeleton.
//!
//! **Nothing is left** at a stepover `w` up to the tool's radius `r`. For round offsets of the region it is argued in
//! [`crate::plan`]. Mitred ones are made from one another, as Kim, Lee and Yang do (each boundary with its islands is the
//! profile of the next offset): what a loop's successor takes away lies in strips of depth `w` along the loop or in
//! mitres at its reflex corners. Mitres are limited to `r/w` offset distances, so all of it lies within `r` of the loop. Offsets of the
//! region itself would not do: their mitres grow with the distance, and reach through thin walls.

use super::job::Engine;
use pocketry_geom::Region;
use pocketry_geom::offset::{
    BisectorEngine, Offset, OffsetEngine, OffsetError, OffsetOptions, PairwiseEngine, bisector,
};

/// So many offsets of the region are asked for at a time.
const BATCH: usize = 8;

/// The offsets at `first`, `first + stepover`, … of a region, as far as there are loops.
pub(super) fn family(
    region: &Region,
    engine: Engine,
    first: f64,
    stepover: f64,
    radius: f64,
) -> Result<Vec<Offset>, OffsetError> {
    match engine {
        Engine::Bisector => successive(region, first, stepover, (radius / stepover).max(1.0)),
        Engine::Pairwise | Engine::Voronoi => from_region(region, first, stepover),
    }
}

/// Each offset from the one before it.
fn successive(region: &Region, first: f64, stepover: f64, limit: f64) -> Result<Vec<Offset>, OffsetError> {
    let engine = BisectorEngine { mitre_limit: Some(limit), ..BisectorEngine::default() };
    let mut family: Vec<Offset> = Vec::new();
    loop {
        let profile = family.last().map(bisector::remaining);
        let step = if family.is_empty() { first } else { stepover };
        let found = engine.offsets(profile.as_ref().unwrap_or(region), &[step], &OffsetOptions::default())?;
        let Some(next) = found.into_iter().next().filter(|o| !o.loops.is_empty()) else { return Ok(family) };
        let distance = first + family.len() as f64 * stepover;
        family.push(Offset { distance, ..next });
    }
}

fn from_region(region: &Region, first: f64, stepover: f64) -> Result<Vec<Offset>, OffsetError> {
    let mut family: Vec<Offset> = Vec::new();
    loop {
        let distances: Vec<f64> = (0..BATCH).map(|k| first + (family.len() + k) as f64 * stepover).collect();
        for offset in PairwiseEngine.offsets(region, &distances, &OffsetOptions::default())? {
            if offset.loops.is_empty() {
                return Ok(family);
            }
            family.push(offset);
        }
    }
}
