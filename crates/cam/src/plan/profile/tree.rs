//! The forest of the connected parts of successive erosions: figure 8 of the paper.

use super::MOST_LEVELS;
use super::levels::Levels;
use crate::plan::PlanError;
use pocketry_geom::distance::Boundary;
use pocketry_geom::offset::morphology::MorphologyError;
use pocketry_geom::{BBox, Contour, Region};

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
    /// The parts of all levels; empty where the profile fits nowhere.
    pub(super) fn new(levels: &Levels<'_>) -> Result<Self, PlanError> {
        let first = levels.first()?;
        let mut forest = Self { parts: Vec::new(), roots: Vec::new(), limit: Boundary::new(&first) };
        forest.roots = forest.add(&first, 0);
        let mut outer = forest.roots.clone();
        let (mut level, mut depth) = (0, 0.0);
        while !outer.is_empty() {
            level += 1;
            if level > MOST_LEVELS {
                return Err(PlanError::Job { what: "stepover", value: levels.stepover() });
            }
            let inner = levels.after(&mut depth)?;
            let parts = forest.add(&inner, level);
            forest.hang(&parts, &outer)?;
            outer = parts;
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

    /// Makes each part the child of the one that it lies in. A step is connected and its reference point well inside it, so that a
    /// part lies wholly in one, some way off its outline: any point tells which.
    fn hang(&mut self, parts: &[u32], outer: &[u32]) -> Result<(), MorphologyError> {
        let around: Vec<(u32, BBox, Boundary)> = outer
            .iter()
            .map(|&k| (k, self.parts[k as usize].contours[0].bbox(), self.parts[k as usize].boundary()))
            .collect();
        for &part in parts {
            let at = self.parts[part as usize].contours[0].segments[0].start();
            let holds = |(_, bbox, boundary): &&(u32, BBox, Boundary)| bbox.contains(at) && boundary.contains(at);
            let (parent, ..) = around.iter().find(holds).ok_or(MorphologyError::Outline { at })?;
            self.parts[*parent as usize].children.push(part);
        }
        Ok(())
    }
}

impl Part {
    fn boundary(&self) -> Boundary {
        Boundary::new(&Region::from_parts_unchecked(self.contours.clone(), vec![None; self.contours.len()]))
    }
}
