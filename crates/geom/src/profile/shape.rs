//! The words for a tool's cross-section.

use super::ToolProfile;
use std::f64::consts::PI;
use std::fmt;
use std::str::FromStr;

/// A tool's cross-section as a machinist says it; lengths in mm.
///
/// [`FromStr`] reads the words and [`fmt::Display`] writes them. A shape from a drawing (`file:tool.svg`) is made with
/// [`ToolShape::Drawn`] by whoever reads files.
#[derive(Clone, Debug, PartialEq)]
pub enum ToolShape {
    /// `circle:D`: diameter.
    Circle(f64),
    /// `rect:WxH`: width along x and height along y.
    Rectangle(f64, f64),
    /// `rounded:WxHrR`: a rectangle with corners of radius R.
    Rounded(f64, f64, f64),
    /// `stadium:LxW`: a slot's shape, of length L over all and width W.
    Stadium(f64, f64),
    /// `ellipse:AxB`: its axes along x and y.
    Ellipse(f64, f64),
    /// `polygon:NxD`: N equal sides, corners on a circle of diameter D, one of them on the x axis.
    Polygon(u32, f64),
    /// `cone:A` or `cone:AxD`: A degrees between the flanks, no wider than D; its profile is a circle that grows with depth.
    Cone {
        /// Angle between the flanks, radians.
        angle: f64,
        /// Largest diameter.
        diameter: f64,
    },
    /// `ball:D`: a ball of diameter D, a cylinder above its middle.
    Ball(f64),
    /// A closed contour from a drawing, and the drawing's name.
    Drawn(String, ToolProfile),
    /// Another shape turned about its reference point (`rect:12x4@30`), radians counter-clockwise.
    Turned(Box<ToolShape>, f64),
}

/// What is wrong with a word for a tool's cross-section.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ToolShapeError {
    /// No such kind of shape.
    #[error(
        "\"{0}\" is no tool profile; say circle:D, rect:WxH, rounded:WxHrR, stadium:LxW, ellipse:AxB, polygon:NxD, cone:ANGLE, \
         ball:D or file:DRAWING (mm; @DEGREES at the end turns it)"
    )]
    Kind(String),
    /// The numbers don't make sense.
    #[error("{kind}: expected {expected}, for example {example}; got \"{got}\"")]
    Numbers {
        /// The kind of shape.
        kind: &'static str,
        /// What it needs.
        expected: &'static str,
        /// How that looks.
        example: &'static str,
        /// What was typed.
        got: String,
    },
    /// Corners that are rounder than the sides are long.
    #[error(
        "rounded: a corner radius of {radius} mm does not fit a side of {side} mm; it can be {} mm at most, which is a stadium",
        0.5 * .side
    )]
    Corner {
        /// The radius, mm.
        radius: f64,
        /// The lesser side, mm.
        side: f64,
    },
}

impl ToolShape {
    /// Its cross-section in the plane of the stock's top when the tip stands `depth` mm below it (only `cone` and `ball` depend
    /// on that).
    pub fn section(&self, depth: f64) -> ToolProfile {
        match *self {
            Self::Circle(d) => ToolProfile::circle(0.5 * d),
            Self::Rectangle(w, h) => ToolProfile::rounded(w, h, 0.0),
            Self::Rounded(w, h, r) => ToolProfile::rounded(w, h, r),
            Self::Stadium(l, w) => ToolProfile::rounded(l, w, 0.5 * l.min(w)),
            Self::Ellipse(a, b) => ToolProfile::ellipse(a, b),
            Self::Polygon(n, d) => ToolProfile::regular(n, d),
            Self::Cone { angle, diameter } => ToolProfile::circle((depth * (0.5 * angle).tan()).min(0.5 * diameter)),
            Self::Ball(d) => {
                let below_middle = (0.5 * d - depth).max(0.0);
                ToolProfile::circle((0.25 * d * d - below_middle * below_middle).sqrt())
            }
            Self::Drawn(_, ref profile) => profile.clone(),
            Self::Turned(ref shape, angle) => shape.section(depth).rotated(angle),
        }
    }

    /// Whether its cross-section depends on the depth.
    pub fn is_tapered(&self) -> bool {
        match self {
            Self::Cone { .. } | Self::Ball(_) => true,
            Self::Turned(shape, _) => shape.is_tapered(),
            _ => false,
        }
    }
}

impl FromStr for ToolShape {
    type Err = ToolShapeError;

    fn from_str(text: &str) -> Result<Self, ToolShapeError> {
        if let Some((shape, degrees)) = text.rsplit_once('@') {
            let turn = degrees.trim().parse::<f64>().ok().filter(|d| d.is_finite());
            let turn = turn.ok_or_else(|| numbers("turn", "degrees after @", "rect:12x4@30", text))?;
            return Ok(Self::Turned(Box::new(shape.parse()?), turn.to_radians()));
        }
        let (kind, size) = text.split_once(':').ok_or_else(|| ToolShapeError::Kind(text.to_owned()))?;
        match kind.trim() {
            "circle" => one(size).map(Self::Circle).ok_or_else(|| numbers("circle", "a diameter", "circle:6", size)),
            "rect" => pair(size)
                .map(|(w, h)| Self::Rectangle(w, h))
                .ok_or_else(|| numbers("rect", "width x height", "rect:12x4", size)),
            "rounded" => rounded(size),
            "stadium" => pair(size)
                .map(|(l, w)| Self::Stadium(l, w))
                .ok_or_else(|| numbers("stadium", "length over all x width", "stadium:12x4", size)),
            "ellipse" => pair(size)
                .map(|(a, b)| Self::Ellipse(a, b))
                .ok_or_else(|| numbers("ellipse", "axis along x x axis along y", "ellipse:12x4", size)),
            "polygon" => polygon(size),
            "cone" => cone(size),
            "ball" => one(size).map(Self::Ball).ok_or_else(|| numbers("ball", "a diameter", "ball:6", size)),
            _ => Err(ToolShapeError::Kind(text.to_owned())),
        }
    }
}

fn numbers(kind: &'static str, expected: &'static str, example: &'static str, got: &str) -> ToolShapeError {
    ToolShapeError::Numbers { kind, expected, example, got: got.to_owned() }
}

/// A length above 0.
fn one(text: &str) -> Option<f64> {
    text.trim().parse().ok().filter(|v: &f64| *v > 0.0 && v.is_finite())
}

/// Two lengths above 0 with an x between them.
fn pair(text: &str) -> Option<(f64, f64)> {
    let (a, b) = text.split_once(['x', 'X', '×'])?;
    Some((one(a)?, one(b)?))
}

fn rounded(size: &str) -> Result<ToolShape, ToolShapeError> {
    let read = || {
        let (sides, radius) = size.split_once(['r', 'R'])?;
        Some((pair(sides)?, one(radius)?))
    };
    let expected = "width x height r corner radius";
    let ((w, h), r) = read().ok_or_else(|| numbers("rounded", expected, "rounded:12x4r1", size))?;
    let side = w.min(h);
    if 2.0 * r > side { Err(ToolShapeError::Corner { radius: r, side }) } else { Ok(ToolShape::Rounded(w, h, r)) }
}

/// The most sides that a polygon may have; more is a circle.
const MOST_SIDES: u32 = 1000;

fn polygon(size: &str) -> Result<ToolShape, ToolShapeError> {
    let read = || {
        let (n, d) = size.split_once(['x', 'X', '×'])?;
        let n = n.trim().parse::<u32>().ok().filter(|n| (3..=MOST_SIDES).contains(n))?;
        Some(ToolShape::Polygon(n, one(d)?))
    };
    let expected = "a number of sides (3 to 1000) x the diameter across corners";
    read().ok_or_else(|| numbers("polygon", expected, "polygon:6x10", size))
}

fn cone(size: &str) -> Result<ToolShape, ToolShapeError> {
    let (angle, diameter) = size.split_once(['x', 'X', '×']).map_or((size, None), |(a, d)| (a, Some(d)));
    let angle = one(angle).filter(|a| *a < 180.0).map(f64::to_radians);
    let diameter = diameter.map_or(Some(f64::INFINITY), one);
    let expected = "degrees between the flanks, below 180, and perhaps x the largest diameter";
    let wrong = || numbers("cone", expected, "cone:90 or cone:90x12", size);
    Ok(ToolShape::Cone { angle: angle.ok_or_else(wrong)?, diameter: diameter.ok_or_else(wrong)? })
}

impl fmt::Display for ToolShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Circle(d) => write!(f, "circle:{d}"),
            Self::Rectangle(w, h) => write!(f, "rect:{w}x{h}"),
            Self::Rounded(w, h, r) => write!(f, "rounded:{w}x{h}r{r}"),
            Self::Stadium(l, w) => write!(f, "stadium:{l}x{w}"),
            Self::Ellipse(a, b) => write!(f, "ellipse:{a}x{b}"),
            Self::Polygon(n, d) => write!(f, "polygon:{n}x{d}"),
            Self::Cone { angle, diameter } if *diameter < f64::INFINITY => {
                write!(f, "cone:{:.6}x{diameter}", angle * 180.0 / PI)
            }
            Self::Cone { angle, .. } => write!(f, "cone:{:.6}", angle * 180.0 / PI),
            Self::Ball(d) => write!(f, "ball:{d}"),
            Self::Drawn(name, _) => write!(f, "file:{name}"),
            Self::Turned(shape, angle) => write!(f, "{shape}@{:.6}", angle * 180.0 / PI),
        }
    }
}
