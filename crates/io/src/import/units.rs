//! Units of length of drawings.

use std::fmt;
use std::str::FromStr;

/// A unit of length: what one unit of the drawing measures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    name: &'static str,
    millimeters: f64,
}

/// Names, further names and lengths in millimetres.
const KNOWN: [(&str, &[&str], f64); 20] = [
    ("mm", &["millimeter", "millimeters", "millimetre", "millimetres"], 1.0),
    ("in", &["inch", "inches", "\""], 25.4),
    ("cm", &["centimeter", "centimeters", "centimetre", "centimetres"], 10.0),
    ("m", &["meter", "meters", "metre", "metres"], 1000.0),
    ("um", &["µm", "micrometer", "micrometre", "micron", "microns"], 0.001),
    ("ft", &["foot", "feet"], 304.8),
    ("mil", &["mils", "thou"], 0.0254),
    ("px", &["pixel", "pixels"], 25.4 / 96.0),
    ("pt", &["point", "points"], 25.4 / 72.0),
    ("uin", &["microinch", "microinches"], 0.000_025_4),
    ("yd", &["yard", "yards"], 914.4),
    ("mi", &["mile", "miles"], 1_609_344.0),
    ("dm", &["decimeter", "decimetre"], 100.0),
    ("dam", &["decameter", "decametre"], 1e4),
    ("hm", &["hectometer", "hectometre"], 1e5),
    ("km", &["kilometer", "kilometre"], 1e6),
    ("nm", &["nanometer", "nanometre"], 0.000_001),
    ("Å", &["angstrom", "angstroms"], 0.000_000_1),
    ("Gm", &["gigameter", "gigametre"], 1e12),
    ("ftUS", &["us-survey-foot", "us-survey-feet"], 304_800.0 / 999.998),
];

impl Units {
    /// Millimetres.
    pub const MILLIMETER: Self = Self { name: "mm", millimeters: 1.0 };
    /// Inches.
    pub const INCH: Self = Self { name: "in", millimeters: 25.4 };
    /// CSS pixels, 96 to the inch.
    pub const PIXEL: Self = Self { name: "px", millimeters: 25.4 / 96.0 };

    /// Its short name.
    pub const fn name(self) -> &'static str {
        self.name
    }

    /// How long it is, mm.
    pub const fn millimeters(self) -> f64 {
        self.millimeters
    }

    /// The unit that a DXF file's `$INSUNITS` stands for: `None` for "unitless" and for codes that have no meaning.
    pub(crate) fn from_dxf(code: i64) -> Option<Self> {
        const CODES: [&str; 22] = [
            "", "in", "ft", "mi", "mm", "cm", "m", "km", "uin", "mil", "yd", "Å", "nm", "um", "dm", "dam", "hm", "Gm",
            "au", "ly", "pc", "ftUS",
        ];
        let name = *CODES.get(usize::try_from(code).ok()?)?;
        let astronomic = |name, millimeters| Some(Self { name, millimeters });
        match name {
            "" => None,
            "au" => astronomic("au", 149_597_870_700.0 * 1e3),
            "ly" => astronomic("ly", 9_460_730_472_580_800.0 * 1e3),
            "pc" => astronomic("pc", 30_856_775_814_913_673.0 * 1e3),
            known => known.parse().ok(),
        }
    }
}

impl Default for Units {
    fn default() -> Self {
        Self::MILLIMETER
    }
}

impl fmt::Display for Units {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

/// A unit's name that isn't known.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown unit {0:?}; use mm, cm, m, um, in, ft, mil, px or pt")]
pub struct UnknownUnits(pub String);

impl FromStr for Units {
    type Err = UnknownUnits;

    fn from_str(text: &str) -> Result<Self, UnknownUnits> {
        let wanted = text.trim();
        KNOWN
            .iter()
            .find(|(name, others, _)| *name == wanted || others.iter().any(|o| o.eq_ignore_ascii_case(wanted)))
            .or_else(|| KNOWN.iter().find(|(name, ..)| name.eq_ignore_ascii_case(wanted)))
            .map(|&(name, _, millimeters)| Self { name, millimeters })
            .ok_or_else(|| UnknownUnits(text.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_codes() {
        assert_eq!("Inches".parse(), Ok(Units::INCH));
        assert_eq!("mm".parse(), Ok(Units::MILLIMETER));
        assert!("furlong".parse::<Units>().is_err());
        assert_eq!(Units::from_dxf(4), Some(Units::MILLIMETER));
        assert_eq!(Units::from_dxf(1), Some(Units::INCH));
        assert_eq!(Units::from_dxf(0), None);
        assert_eq!(Units::from_dxf(99), None);
        assert_eq!(Units::from_dxf(-1), None);
        for code in 1..=21 {
            assert!(Units::from_dxf(code).is_some(), "code {code}");
        }
    }
}
