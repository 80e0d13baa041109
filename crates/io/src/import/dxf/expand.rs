//! Blocks are laid out where they are inserted, layers chosen, curves brought to millimetres.

use super::entity::{Entity, Insert, Shape};
use super::{File, too_many};
use crate::import::ImportOptions;
use crate::import::affine::Affine;
use crate::import::error::{FaultKind, ImportError, Place};
use crate::import::sketch::{MAX_CURVES, Sketch, Source};
use pocketry_geom::Point;
use std::collections::{BTreeSet, HashMap};

/// Insertions nested deeper than this are refused.
const MAX_DEPTH: usize = 600;

/// Adds everything that the drawing shows to the sketch; returns the layers that it hides.
pub(super) fn expand(file: &File, options: &ImportOptions, sketch: &mut Sketch) -> Result<Vec<String>, ImportError> {
    let mut census = Census { file, known: HashMap::new(), open: Vec::new() };
    let count = census.count(&file.entities)?;
    if count > MAX_CURVES {
        return Err(too_many(count));
    }
    let scale = sketch.units.millimeters();
    let mut layout = Layout {
        file,
        options,
        sketch,
        wanted: options.layers.iter().map(|l| l.to_lowercase()).collect(),
        present: BTreeSet::new(),
        missing: BTreeSet::new(),
        hidden: BTreeSet::new(),
    };
    layout.draw(&file.entities, &Affine::scale(scale, scale), None)?;
    layout.check_layers()?;
    Ok(layout.hidden.into_iter().collect())
}

/// Counts the curves of a drawing before any of them is laid out.
struct Census<'a> {
    file: &'a File,
    known: HashMap<&'a str, u64>,
    open: Vec<&'a str>,
}

impl<'a> Census<'a> {
    fn count(&mut self, entities: &'a [Entity]) -> Result<u64, ImportError> {
        let mut total: u64 = 0;
        for entity in entities {
            total = total.saturating_add(match &entity.shape {
                Shape::Curves { curves, .. } => curves.len() as u64,
                Shape::Insert(insert) => {
                    let copies = insert.copies[0].saturating_mul(insert.copies[1]);
                    copies.saturating_mul(self.block(&insert.block, &entity.source)?.saturating_add(1))
                }
            });
        }
        Ok(total)
    }

    fn block(&mut self, name: &'a str, source: &Source) -> Result<u64, ImportError> {
        if let Some(&count) = self.known.get(name) {
            return Ok(count);
        }
        let Some(block) = self.file.blocks.get(name) else { return Ok(0) };
        if self.open.contains(&name) {
            return Err(source.error(format!("block {name} inserts itself"), "redraw the block without itself in it"));
        }
        if self.open.len() >= MAX_DEPTH {
            return Err(source.error(format!("blocks are nested more than {MAX_DEPTH} deep"), "explode the blocks"));
        }
        self.open.push(name);
        let count = self.count(&block.entities)?;
        self.open.pop();
        self.known.insert(name, count);
        Ok(count)
    }
}

/// Walks the drawing and adds what it shows to the sketch.
struct Layout<'a> {
    file: &'a File,
    options: &'a ImportOptions,
    sketch: &'a mut Sketch,
    wanted: Vec<String>,
    present: BTreeSet<String>,
    missing: BTreeSet<String>,
    hidden: BTreeSet<String>,
}

impl<'a> Layout<'a> {
    fn draw(&mut self, entities: &'a [Entity], map: &Affine, inherited: Option<&str>) -> Result<(), ImportError> {
        for entity in entities {
            let own = entity.source.layer.as_str();
            let layer = inherited.filter(|_| own == "0").unwrap_or(own);
            match &entity.shape {
                Shape::Curves { curves, closed } => {
                    if self.shows(layer) {
                        let source = Source { layer: layer.to_owned(), ..entity.source.clone() };
                        for note in &entity.notes {
                            self.sketch.warn(source.place(), note);
                        }
                        let source = self.sketch.source(source);
                        self.sketch.add(curves, *closed, map, source, self.options.fit_tolerance)?;
                    }
                }
                Shape::Insert(insert) => self.insert(insert, &entity.source, map, layer)?,
            }
        }
        Ok(())
    }

    fn insert(&mut self, insert: &'a Insert, source: &Source, map: &Affine, layer: &str) -> Result<(), ImportError> {
        let file = self.file;
        let Some(block) = file.blocks.get(&insert.block) else {
            if self.missing.insert(insert.block.clone()) {
                let message = format!("block {} is not in the drawing and is left out", insert.block);
                self.sketch.warn(source.place(), message);
            }
            return Ok(());
        };
        if self.wanted.is_empty() && file.layers.visibility(layer).frozen {
            self.hidden.insert(layer.to_owned());
            return Ok(());
        }
        let base = Affine::translate(Point::ORIGIN - block.base);
        for row in 0..insert.copies[1] {
            for column in 0..insert.copies[0] {
                let step = insert.steps[0] * column as f64 + insert.steps[1] * row as f64;
                let copy = map.after(&Affine::translate(step)).after(&insert.map).after(&base);
                if copy.is_singular() {
                    return Err(source.error("its scale makes the block vanish", "no scale may be 0"));
                }
                self.draw(&block.entities, &copy, Some(layer))?;
            }
        }
        Ok(())
    }

    /// Whether curves on this layer are to be read; remembers that it is there.
    fn shows(&mut self, layer: &str) -> bool {
        if !self.present.contains(layer) {
            self.present.insert(layer.to_owned());
        }
        if !self.wanted.is_empty() {
            let lower = layer.to_lowercase();
            return self.wanted.contains(&lower);
        }
        let visibility = self.file.layers.visibility(layer);
        let hidden = visibility.off || visibility.frozen;
        if hidden && !self.hidden.contains(layer) {
            self.hidden.insert(layer.to_owned());
        }
        !hidden
    }

    fn check_layers(&self) -> Result<(), ImportError> {
        for (wanted, name) in self.wanted.iter().zip(&self.options.layers) {
            let drawn = self.present.iter().any(|layer| layer.to_lowercase() == *wanted);
            if !drawn {
                let empty = if self.file.layers.contains(wanted) { "has no curves" } else { "is not in the drawing" };
                let present: Vec<&str> = self.present.iter().map(String::as_str).collect();
                let hint = format!("layers with curves: {}", present.join(", "));
                let problem = format!("layer {name} {empty}");
                return Err(ImportError::new(FaultKind::Layer, Place::default(), problem, hint));
            }
        }
        Ok(())
    }
}
