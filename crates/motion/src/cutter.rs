//! Shapes of cutters: what a tool's lower end looks like.

use serde::Serialize;
use std::fmt;
use std::str::FromStr;

/// The lower end of a round tool; its diameter stands in [`crate::Tool`]. Above it the tool is a cylinder.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub enum Cutter {
    /// Flat, with a sharp corner.
    #[default]
    Flat,
    /// A half sphere.
    Ball,
    /// Flat, with a rounded corner.
    Bull {
        /// The corner's radius, mm.
        corner: f64,
    },
    /// A cone with a sharp tip.
    Cone {
        /// Angle between the flanks, radians.
        angle: f64,
    },
}

impl Cutter {
    /// Whether a tool of this radius (mm) can have this shape.
    pub fn fits(self, radius: f64) -> bool {
        match self {
            Self::Flat | Self::Ball => true,
            Self::Bull { corner } => 0.0 < corner && corner <= radius,
            Self::Cone { angle } => 0.0 < angle && angle < std::f64::consts::PI,
        }
    }
}

impl FromStr for Cutter {
    type Err = String;

    /// `flat`, `ball`, `bull:CORNER` (mm) or `cone:ANGLE` (degrees between the flanks).
    fn from_str(text: &str) -> Result<Self, String> {
        let number = |t: &str| t.trim().parse::<f64>().ok().filter(|v| *v > 0.0 && v.is_finite());
        let cutter = match text.split_once(':') {
            None if text == "flat" => Some(Self::Flat),
            None if text == "ball" => Some(Self::Ball),
            Some(("bull", corner)) => number(corner).map(|corner| Self::Bull { corner }),
            Some(("cone", angle)) => number(angle).filter(|a| *a < 180.0).map(|a| Self::Cone { angle: a.to_radians() }),
            _ => None,
        };
        cutter.ok_or_else(|| {
            "expected flat, ball, bull:CORNER (its radius in mm) or cone:ANGLE (degrees between the flanks)".to_owned()
        })
    }
}

impl fmt::Display for Cutter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Flat => f.write_str("flat end mill"),
            Self::Ball => f.write_str("ball end mill"),
            Self::Bull { corner } => write!(f, "bull-nose end mill, corner {corner} mm"),
            Self::Cone { angle } => write!(f, "cone of {:.1} degrees", angle.to_degrees()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cutters_are_read() {
        assert_eq!("bull:2".parse(), Ok(Cutter::Bull { corner: 2.0 }));
        assert_eq!("flat".parse(), Ok(Cutter::Flat));
        assert_eq!("ball".parse(), Ok(Cutter::Ball));
        let cone: Cutter = "cone:90".parse().unwrap();
        assert!(matches!(cone, Cutter::Cone { angle } if (angle - std::f64::consts::FRAC_PI_2).abs() < 1e-12));
        for bad in ["", "bull", "bull:-1", "bull:nan", "cone:180", "cone:x", "drill"] {
            assert!(bad.parse::<Cutter>().is_err(), "{bad}");
        }
        assert!(!Cutter::Bull { corner: 6.0 }.fits(5.0) && Cutter::Bull { corner: 5.0 }.fits(5.0));
    }
}
