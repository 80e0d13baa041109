//! What the HEADER and TABLES sections say: units and layers.

use super::expect;
use super::groups::{Group, Groups};
use crate::import::ImportOptions;
use crate::import::error::{FaultKind, ImportError, Place};
use crate::import::sketch::Sketch;
use crate::import::units::Units;
use pocketry_geom::tolerance;
use std::collections::BTreeMap;

/// The header variables that matter.
#[derive(Debug, Default)]
pub(super) struct Header {
    units: Option<i64>,
    measurement: Option<i64>,
}

impl Header {
    pub(super) fn read(&mut self, groups: &mut Groups<'_>) -> Result<(), ImportError> {
        const NAME: i32 = 9;
        const INTEGER: i32 = 70;
        let mut variable = "";
        loop {
            let group = expect(groups, "HEADER")?;
            match (group.code, variable) {
                (0, _) if group.value == "ENDSEC" => return Ok(()),
                (NAME, _) => variable = group.value,
                (INTEGER, "$INSUNITS") => self.units = Some(group.integer()?),
                (INTEGER, "$MEASUREMENT") => self.measurement = Some(group.integer()?),
                _ => {}
            }
        }
    }

    /// The drawing's unit, with a warning where it is a guess.
    pub(super) fn units(&self, options: &ImportOptions, sketch: &mut Sketch) -> Result<Units, ImportError> {
        if let Some(units) = options.units {
            return Ok(units);
        }
        let code = self.units.unwrap_or(0);
        let Some(units) = Units::from_dxf(code) else {
            let why = match self.units {
                None => "the drawing doesn't say its units ($INSUNITS)".to_owned(),
                Some(0) => "the drawing is unitless ($INSUNITS 0)".to_owned(),
                Some(code) => format!("the drawing's unit code $INSUNITS {code} means nothing"),
            };
            sketch.warn(Place::default(), format!("{why}; millimetres are assumed (give the units if that is wrong)"));
            return Ok(Units::MILLIMETER);
        };
        if units.millimeters() > tolerance::ABSURD {
            let problem = format!("the drawing's unit is {units}, {:e} mm", units.millimeters());
            return Err(ImportError::new(
                FaultKind::Limit,
                Place::default(),
                problem,
                "correct $INSUNITS or give the units",
            ));
        }
        let imperial = ["in", "ft", "mil", "yd", "mi", "uin", "ftUS"].contains(&units.name());
        if self.measurement.is_some_and(|m| (m == 0) != imperial) {
            let problem = format!("$MEASUREMENT and $INSUNITS disagree; $INSUNITS ({units}) is taken");
            sketch.warn(Place::default(), problem);
        }
        Ok(units)
    }
}

/// What the LAYER table says of one layer.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Visibility {
    /// Not shown, and what is inserted on it isn't either.
    pub(super) frozen: bool,
    /// Not shown.
    pub(super) off: bool,
}

/// The layers of a drawing by their names in lower case.
#[derive(Debug, Default)]
pub(super) struct Layers {
    table: BTreeMap<String, Visibility>,
}

impl Layers {
    pub(super) fn read(&mut self, groups: &mut Groups<'_>) -> Result<(), ImportError> {
        let mut group = expect(groups, "TABLES")?;
        loop {
            match (group.code, group.value) {
                (0, "ENDSEC") => return Ok(()),
                (0, "LAYER") => group = self.layer(groups)?,
                _ => group = expect(groups, "TABLES")?,
            }
        }
    }

    fn layer<'a>(&mut self, groups: &mut Groups<'a>) -> Result<Group<'a>, ImportError> {
        let (mut name, mut visibility) = (None, Visibility::default());
        loop {
            let group = expect(groups, "TABLES")?;
            match group.code {
                0 => {
                    if let Some(name) = name {
                        self.table.insert(name, visibility);
                    }
                    return Ok(group);
                }
                2 => name = Some(super::raw::layer_name(group.value).to_lowercase()),
                70 => visibility.frozen = group.integer()? & 1 != 0,
                62 => visibility.off = group.integer()? < 0,
                _ => {}
            }
        }
    }

    /// Whether a layer is shown; layers that the table doesn't know are.
    pub(super) fn visibility(&self, layer: &str) -> Visibility {
        self.table.get(&layer.to_lowercase()).copied().unwrap_or_default()
    }

    /// Whether the table knows the layer.
    pub(super) fn contains(&self, layer: &str) -> bool {
        self.table.contains_key(&layer.to_lowercase())
    }
}
