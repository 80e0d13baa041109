//! DXF entities as curves, in the coordinates of the block that holds them.

use super::groups::syntax;
use super::raw::{Raw, block_key};
use crate::import::affine::{Affine, direction_degrees};
use crate::import::curve::{Curve, Elliptic};
use crate::import::error::ImportError;
use crate::import::json::polyline;
use crate::import::nurbs::Spline;
use crate::import::sketch::Source;
use crate::import::spline_fit;
use pocketry_geom::{Vec2, tolerance, vec2};
use std::f64::consts::TAU;

/// The insertion of a block, once or as an array.
#[derive(Clone, Debug)]
pub(super) struct Insert {
    /// The block's name in capitals.
    pub(super) block: String,
    /// From the block's coordinates, its base point at the origin, to those of the first copy.
    pub(super) map: Affine,
    /// Number of copies along the insertion's x and y axes.
    pub(super) copies: [u64; 2],
    /// Displacements from a copy to the next along these axes.
    pub(super) steps: [Vec2; 2],
}

/// What an entity draws.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    /// Connected curves.
    Curves {
        /// End to end.
        curves: Vec<Curve>,
        /// Whether the last joins the first.
        closed: bool,
    },
    /// The contents of a block.
    Insert(Insert),
}

/// An entity that draws something.
#[derive(Clone, Debug)]
pub(super) struct Entity {
    /// Where it comes from.
    pub(super) source: Source,
    /// What it draws.
    pub(super) shape: Shape,
    /// What was healed in it.
    pub(super) notes: Vec<String>,
}

/// What became of an entity of the file.
pub(super) enum Reading {
    /// It draws something.
    Drawn(Box<Entity>),
    /// It stands in paper space, or is marked invisible.
    Hidden,
    /// Text, dimensions and the like, which nobody mills.
    Annotation,
    /// It has no length; what it is.
    Empty(Source),
    /// It isn't a kind that is read.
    Unknown(Source),
}

/// Kinds that say something about a part and are no part of it.
const ANNOTATIONS: [&str; 22] = [
    "TEXT",
    "MTEXT",
    "DIMENSION",
    "LARGE_RADIAL_DIMENSION",
    "ARC_DIMENSION",
    "LEADER",
    "MLEADER",
    "MULTILEADER",
    "TOLERANCE",
    "ATTRIB",
    "ATTDEF",
    "HATCH",
    "POINT",
    "VIEWPORT",
    "IMAGE",
    "WIPEOUT",
    "RAY",
    "XLINE",
    "SEQEND",
    "ACAD_TABLE",
    "OLE2FRAME",
    "RTEXT",
];

impl Raw<'_> {
    /// What the entity is.
    pub(super) fn read(&self) -> Result<Reading, ImportError> {
        if ANNOTATIONS.contains(&self.kind) {
            return Ok(Reading::Annotation);
        }
        if self.integer_or(67, 0)? != 0 || self.integer_or(60, 0)? != 0 {
            return Ok(Reading::Hidden);
        }
        let source = self.source();
        let mut notes = Vec::new();
        let Some(shape) = self.shape(&source, &mut notes)? else { return Ok(Reading::Unknown(source)) };
        if matches!(&shape, Shape::Curves { curves, .. } if curves.is_empty()) {
            return Ok(Reading::Empty(source));
        }
        if !matches!(self.kind, "INSERT" | "LWPOLYLINE") && self.heights_differ()? {
            notes.push("its points lie at different heights; it is flattened onto the XY plane".to_owned());
        }
        Ok(Reading::Drawn(Box::new(Entity { source, shape, notes })))
    }

    fn shape(&self, source: &Source, notes: &mut Vec<String>) -> Result<Option<Shape>, ImportError> {
        let shape = match self.kind {
            "LINE" => self.line()?,
            "CIRCLE" => self.mirrored(self.circle(source)?, source)?,
            "ARC" => self.mirrored(self.arc(source)?, source)?,
            "LWPOLYLINE" => self.mirrored(self.lwpolyline(source, notes)?, source)?,
            "POLYLINE" => return self.polyline(source, notes),
            "ELLIPSE" => self.ellipse(source, notes)?,
            "SPLINE" => self.spline(source, notes)?,
            "INSERT" => Shape::Insert(self.insert(source)?),
            _ => return Ok(None),
        };
        Ok(Some(shape))
    }

    fn mirrored(&self, shape: Shape, source: &Source) -> Result<Shape, ImportError> {
        match shape {
            Shape::Curves { curves, closed } if self.faces_down(source)? => {
                let mirror = Affine::scale(-1.0, 1.0);
                Ok(Shape::Curves { curves: curves.iter().map(|c| c.transformed(&mirror)).collect(), closed })
            }
            as_is => Ok(as_is),
        }
    }

    fn line(&self) -> Result<Shape, ImportError> {
        let (a, b) = (self.point(10)?, self.point(11)?);
        let curves = if a == b { Vec::new() } else { vec![Curve::Line(a, b)] };
        Ok(Shape::Curves { curves, closed: false })
    }

    fn radius(&self, source: &Source) -> Result<f64, ImportError> {
        let radius = self.needed(40)?;
        if radius < 0.0 {
            return Err(source.error(format!("its radius is {radius}"), "draw it with a positive radius"));
        }
        Ok(radius)
    }

    fn circle(&self, source: &Source) -> Result<Shape, ImportError> {
        let (center, radius) = (self.point(10)?, self.radius(source)?);
        let (u, v) = (vec2(radius, 0.0), vec2(0.0, radius));
        let whole = Elliptic::new(center, u, v, 0.0, TAU);
        let curves = if radius > 0.0 { vec![Curve::Elliptic(whole)] } else { Vec::new() };
        Ok(Shape::Curves { curves, closed: true })
    }

    fn arc(&self, source: &Source) -> Result<Shape, ImportError> {
        let (center, radius) = (self.point(10)?, self.radius(source)?);
        let (from, to) = (self.needed(50)?, self.needed(51)?);
        if from == to {
            let hint = "draw a CIRCLE if the full turn is meant, remove it otherwise";
            return Err(source.error(format!("its start and end angle are both {from}"), hint));
        }
        if radius == 0.0 {
            return Ok(Shape::Curves { curves: Vec::new(), closed: false });
        }
        let sweep = (to - from).rem_euclid(360.0);
        let whole = sweep == 0.0;
        let elliptic = Elliptic {
            start: center + direction_degrees(from) * radius,
            end: center + direction_degrees(if whole { from } else { to }) * radius,
            center,
            u: vec2(radius, 0.0),
            v: vec2(0.0, radius),
            from: from.rem_euclid(360.0).to_radians(),
            sweep: if whole { TAU } else { sweep.to_radians() },
        };
        Ok(Shape::Curves { curves: vec![Curve::Elliptic(elliptic)], closed: whole })
    }

    fn lwpolyline(&self, source: &Source, notes: &mut Vec<String>) -> Result<Shape, ImportError> {
        let mut vertices: Vec<[f64; 3]> = Vec::with_capacity(self.groups.len() / 2);
        let mut awaits_y = None;
        for group in &self.groups {
            match (group.code, vertices.last_mut()) {
                (10, _) => {
                    if awaits_y.is_some() {
                        break;
                    }
                    vertices.push([group.number()?, 0.0, 0.0]);
                    awaits_y = Some(group.line);
                }
                (20, Some(vertex)) if awaits_y.take().is_some() => vertex[1] = group.number()?,
                (42, Some(vertex)) => vertex[2] = group.number()?,
                _ => {}
            }
        }
        if let Some(line) = awaits_y {
            return Err(syntax(line, "a vertex of the LWPOLYLINE has no y coordinate", "save the drawing again"));
        }
        Self::edges(&vertices, self.integer_or(70, 0)? & 1 != 0, source, notes)
    }

    fn polyline(&self, source: &Source, notes: &mut Vec<String>) -> Result<Option<Shape>, ImportError> {
        const CLOSED: i64 = 1;
        const SPATIAL: i64 = 8;
        const MESHES: i64 = 16 + 64;
        let flags = self.integer_or(70, 0)?;
        if flags & MESHES != 0 {
            return Ok(None);
        }
        let shape = Self::edges(&self.vertices, flags & CLOSED != 0, source, notes)?;
        if flags & SPATIAL != 0 { Ok(Some(shape)) } else { self.mirrored(shape, source).map(Some) }
    }

    fn edges(
        vertices: &[[f64; 3]],
        closed: bool,
        source: &Source,
        notes: &mut Vec<String>,
    ) -> Result<Shape, ImportError> {
        if vertices.len() < 2 {
            return Ok(Shape::Curves { curves: Vec::new(), closed });
        }
        let mut dropped = Vec::new();
        let curves = polyline(vertices, closed, source, &mut dropped)?;
        if let Some(p) = dropped.first() {
            notes.push(format!("a bulge on an edge without length at ({}, {}) is ignored", p.x, p.y));
        }
        Ok(Shape::Curves { curves, closed })
    }

    fn ellipse(&self, source: &Source, notes: &mut Vec<String>) -> Result<Shape, ImportError> {
        let (center, major) = (self.point(10)?, self.point(11)?.to_vec());
        let ratio = self.needed(40)?;
        if major.length() == 0.0 || ratio == 0.0 {
            return Err(source.error("one of its axes has no length", "remove it"));
        }
        if ratio.abs() > 1.0 {
            notes.push(format!("its axis ratio is {ratio}, above 1; taken as it is"));
        }
        let minor = if self.faces_down(source)? { major.right() } else { major.left() } * ratio;
        let (from, to) = (self.number_or(41, 0.0)?, self.number_or(42, TAU)?);
        let mut sweep = (to - from).rem_euclid(TAU);
        let whole = sweep <= tolerance::ANGLE || TAU - sweep <= tolerance::ANGLE;
        if whole {
            sweep = TAU;
        }
        let curves = vec![Curve::Elliptic(Elliptic::new(center, major, minor, from, sweep))];
        Ok(Shape::Curves { curves, closed: whole })
    }

    fn spline(&self, source: &Source, notes: &mut Vec<String>) -> Result<Shape, ImportError> {
        const CLOSED: i64 = 1;
        let closed = self.integer_or(70, 0)? & CLOSED != 0;
        let points = self.points(10)?;
        if points.is_empty() {
            let through = self.points(11)?;
            if through.len() < 2 {
                return Err(source.error("the spline has no control points", "draw it again"));
            }
            notes.push("the spline has fit points only; a smooth cubic is laid through them".to_owned());
            return Ok(Shape::Curves { curves: vec![Curve::Free(spline_fit::through(&through, closed))], closed });
        }
        let degree = usize::try_from(self.integer_or(71, 3)?).unwrap_or(0);
        let spline = Spline { degree, knots: self.numbers(40)?, points, weights: self.numbers(41)? };
        let chain =
            spline.to_beziers().map_err(|e| source.error(format!("the spline is damaged: {e}"), "draw it again"))?;
        let ends_meet = chain[0].start().distance(chain[chain.len() - 1].end()) <= tolerance::JOIN;
        Ok(Shape::Curves { curves: vec![Curve::Free(chain)], closed: closed && ends_meet })
    }

    fn insert(&self, source: &Source) -> Result<Insert, ImportError> {
        let block = self.first(2).map(|g| block_key(g.value)).ok_or_else(|| {
            syntax(self.line, "INSERT doesn't name its block", "the entity is damaged; save the drawing again")
        })?;
        let at = self.point(10)?.to_vec();
        let (scale_x, scale_y) = (self.number_or(41, 1.0)?, self.number_or(42, 1.0)?);
        let turn = Affine::rotate_degrees(self.number_or(50, 0.0)?);
        let mirror = if self.faces_down(source)? { Affine::scale(-1.0, 1.0) } else { Affine::IDENTITY };
        let placed = mirror.after(&Affine::translate(at)).after(&turn);
        let map = placed.after(&Affine::scale(scale_x, scale_y));
        if map.is_singular() {
            return Err(source.error(format!("it is scaled by {scale_x} × {scale_y}"), "no scale may be 0"));
        }
        let copies = |code| self.integer_or(code, 1).map(|n| u64::try_from(n).unwrap_or(1).max(1));
        let step = |v: Vec2| placed.vector(v);
        Ok(Insert {
            block,
            map,
            copies: [copies(70)?, copies(71)?],
            steps: [step(vec2(self.number_or(44, 0.0)?, 0.0)), step(vec2(0.0, self.number_or(45, 0.0)?))],
        })
    }

    /// The vertex that a VERTEX entity is, unless it only guides a spline's frame.
    pub(super) fn vertex(&self) -> Result<Option<[f64; 3]>, ImportError> {
        const FRAME: i64 = 16;
        if self.integer_or(70, 0)? & FRAME != 0 {
            return Ok(None);
        }
        let p = self.point(10)?;
        Ok(Some([p.x, p.y, self.number_or(42, 0.0)?]))
    }
}
