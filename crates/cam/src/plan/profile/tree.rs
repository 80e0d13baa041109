//! The forest of the connected parts of successive erosions: figure 8 of the paper.

use super::MOST_LEVELS;
use crate::plan::PlanError;
use pocketry_geom::distance::Boundary;
use pocketry_geom::offset::morphology::{MorphologyError, eroded};
use pocketry_geom::{Contour, Point, Region};

/// Shares of the step that are tried where it is refused.
const SMALLER_STEPS: [f64; 3] = [0.97, 0.93, 0.88];

/// A connected part of an erosion.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// Its outer contour and then its islands, the part to the left.
    pub(super) contours: Vec<Contour>,
    /// The parts of the next erosion inside it.
    pub(super) children: Vec<u32>,
    /// Number of the erosion, from 0.
    pub(super) level: usize,
}

/// All parts.
#[derive(Clone, Debug)]
pub(super) struct Forest {
    pub(super) parts: Vec<Part>,
    /// The parts of the first erosion.
    pub(super) roots: Vec<u32>,
    /// The first erosion's boundary: no way may cross it.
    pub(super) limit: Boundary,
}

impl Forest {
    /// The parts of `first` and of its successive erosions by `step`. Each part is eroded on its own: the step is connected, so that
    /// what comes of a part lies inside it.
    pub(super) fn new(first: &Region, step: &Contour) -> Result<Self, PlanError> {
        let mut forest = Self { parts: Vec::new(), roots: Vec::new(), limit: Boundary::new(first) };
        forest.roots = forest.add(first, 0);
        let mut next = 0;
        while let Some(part) = forest.parts.get(next) {
            if part.level >= MOST_LEVELS {
                return Err(PlanError::Job { what: "stepover", value: step.bbox().size() });
            }
            let (level, inner) = (part.level + 1, shrunk(&part.region(), step)?);
            forest.parts[next].children = forest.add(&inner, level);
            next += 1;
        }
        Ok(forest)
    }

    fn add(&mut self, region: &Region, level: usize) -> Vec<u32> {
        let contours = region.contours();
        let first = self.parts.len() as u32;
        self.parts.extend(region.pockets().iter().map(|pocket| {
            let all = std::iter::once(pocket.outer).chain(pocket.islands.iter().copied());
            Part { contours: all.map(|k| contours[k as usize].clone()).collect(), children: Vec::new(), level }
        }));
        (first..self.parts.len() as u32).collect()
    }
}

/// A part eroded by a step, or by a somewhat smaller one: any part of the step leaves nothing either (about its reference point, the
/// mean of its corners), and where one runs into places that coincide within rounding, another doesn't.
fn shrunk(region: &Region, step: &Contour) -> Result<Region, MorphologyError> {
    let first = eroded(region, step, Point::ORIGIN);
    SMALLER_STEPS.iter().fold(first, |done, &share| {
        done.or_else(|refused| eroded(region, &scaled(step, share), Point::ORIGIN).map_err(|_| refused))
    })
}

/// A contour scaled about the origin.
fn scaled(contour: &Contour, share: f64) -> Contour {
    let vertices = contour.to_vertices();
    Contour::from_vertices(&vertices.into_iter().map(|[x, y, bulge]| [share * x, share * y, bulge]).collect::<Vec<_>>())
}

impl Part {
    fn region(&self) -> Region {
        let parents = (0..self.contours.len()).map(|k| (k > 0).then_some(0)).collect();
        Region::from_parts_unchecked(self.contours.clone(), parents)
    }
}
