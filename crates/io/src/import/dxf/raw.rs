//! An entity of the file as groups, and what its groups hold.

use super::groups::{Group, syntax};
use crate::import::error::ImportError;
use crate::import::sketch::Source;
use pocketry_geom::{Point, point, tolerance};

/// An entity as the file gives it.
#[derive(Clone, Debug, Default)]
pub(super) struct Raw<'a> {
    /// Its type, such as `LINE`.
    pub(super) kind: &'a str,
    /// Its groups, the type left out.
    pub(super) groups: Vec<Group<'a>>,
    /// Vertices `[x, y, bulge]` that follow as entities of their own (POLYLINE).
    pub(super) vertices: Vec<[f64; 3]>,
    /// The line of its type.
    pub(super) line: usize,
}

impl<'a> Raw<'a> {
    /// The entity's layer, handle and line.
    pub(super) fn source(&self) -> Source {
        let text = |code| self.first(code).map(|g| g.value);
        let entity = match text(5) {
            Some(handle) => format!("{} {handle}", self.kind),
            None => self.kind.to_owned(),
        };
        Source { layer: layer_name(text(8).unwrap_or("0")), entity, line: self.line }
    }

    /// The first group with this code.
    pub(super) fn first(&self, code: i32) -> Option<&Group<'a>> {
        self.groups.iter().find(|g| g.code == code)
    }

    /// The first value of a code, if there is one, as a number.
    pub(super) fn number(&self, code: i32) -> Result<Option<f64>, ImportError> {
        self.first(code).map(Group::number).transpose()
    }

    /// The first value of a code as a number, or a default.
    pub(super) fn number_or(&self, code: i32, default: f64) -> Result<f64, ImportError> {
        Ok(self.number(code)?.unwrap_or(default))
    }

    /// The first value of a code as a whole number, or a default.
    pub(super) fn integer_or(&self, code: i32, default: i64) -> Result<i64, ImportError> {
        Ok(self.first(code).map(Group::integer).transpose()?.unwrap_or(default))
    }

    /// The first value of a code, which must be there, as a number.
    pub(super) fn needed(&self, code: i32) -> Result<f64, ImportError> {
        self.number(code)?.ok_or_else(|| {
            let problem = format!("{} lacks its group {code}", self.kind);
            syntax(self.line, &problem, "the entity is damaged; save the drawing again")
        })
    }

    /// The first point whose x has this code; it must be there.
    pub(super) fn point(&self, x_code: i32) -> Result<Point, ImportError> {
        Ok(point(self.needed(x_code)?, self.needed(x_code + 10)?))
    }

    /// Every value of a code that may repeat.
    pub(super) fn numbers(&self, code: i32) -> Result<Vec<f64>, ImportError> {
        self.groups.iter().filter(|g| g.code == code).map(Group::number).collect()
    }

    /// Every point whose x has this code.
    pub(super) fn points(&self, x_code: i32) -> Result<Vec<Point>, ImportError> {
        let (xs, ys) = (self.numbers(x_code)?, self.numbers(x_code + 10)?);
        if xs.len() != ys.len() {
            let problem = format!("{} has {} x coordinates and {} y coordinates", self.kind, xs.len(), ys.len());
            return Err(syntax(self.line, &problem, "the entity is damaged; save the drawing again"));
        }
        Ok(xs.into_iter().zip(ys).map(|(x, y)| point(x, y)).collect())
    }

    /// Whether the entity's plane faces down; an error where it is tilted.
    pub(super) fn faces_down(&self, source: &Source) -> Result<bool, ImportError> {
        let (x, y, z) = (self.number_or(210, 0.0)?, self.number_or(220, 0.0)?, self.number_or(230, 1.0)?);
        let length = x.hypot(y).hypot(z);
        if x.hypot(y) <= tolerance::FLAT_NORMAL * length && z != 0.0 {
            return Ok(z < 0.0);
        }
        Err(source.error("it lies in a tilted plane", "draw the pocket in the XY plane"))
    }

    /// Whether the entity's points lie at different heights.
    pub(super) fn heights_differ(&self) -> Result<bool, ImportError> {
        let mut heights = self.numbers(30)?;
        heights.extend(self.numbers(31)?);
        let (low, high) = heights.iter().fold((f64::MAX, f64::MIN), |(l, h), &z| (l.min(z), h.max(z)));
        Ok(high - low > tolerance::SMALLEST_SIZE || (self.kind == "LINE" && heights.len() == 1 && high != 0.0))
    }
}

/// Block names are compared without regard to case.
pub(super) fn block_key(name: &str) -> String {
    name.to_uppercase()
}

/// A layer's name with `\U+XXXX` escapes resolved.
pub(super) fn layer_name(text: &str) -> String {
    let mut parts = text.split("\\U+");
    let mut name = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let code = part.get(..4).and_then(|hex| u32::from_str_radix(hex, 16).ok()).and_then(char::from_u32);
        if let Some(c) = code {
            name.push(c);
            name.push_str(&part[4..]);
        } else {
            name.push_str("\\U+");
            name.push_str(part);
        }
    }
    name
}
