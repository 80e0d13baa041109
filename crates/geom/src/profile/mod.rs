//! Cross-sections of tools in the machining plane: the structuring elements of R. Molina-Carmona, A. Jimeno and M. Davia,
//! *Contour pocketing computation using mathematical morphology*, Int. J. Adv. Manuf. Technol. 36, 2008.
//!
//! A [`ToolProfile`] is any closed contour of lines and arcs, convex or not, drawn about its reference point, the origin: where
//! the program says that the tool is. A [`ToolShape`] is what a machinist types (`rect:12x4`, `rounded:12x4r1`, `cone:90`, …);
//! it has a profile at every depth, and only for conical and ball tools does that depend on the depth.
//!
//! Lines and arcs are exact but for the ellipse, which becomes biarcs within the fit tolerance ([`crate::tolerance::FIT`]).

mod ellipse;
mod shape;
mod sum;
pub mod turning;

pub use shape::{ToolShape, ToolShapeError};
pub use sum::convex_sum;

use crate::contour::Contour;
use crate::point::{Point, Vec2};
use crate::repair::{RegionError, RepairOptions, build};
use crate::segment::Segment;
use crate::tolerance::TANGENT;

/// A tool's cross-section: a closed contour of lines and arcs about its reference point, the origin.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolProfile {
    contour: Contour,
}

/// Why a contour is no tool's profile.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ProfileError {
    /// It encloses no area, crosses itself, is open or has bad numbers.
    #[error("the tool profile is no closed outline: {0}")]
    Outline(#[from] RegionError),
    /// There is more than one outline, or a hole.
    #[error("the tool profile must be one closed outline without holes, there are {count}; delete the others")]
    Several {
        /// How many there are.
        count: usize,
    },
    /// The reference point lies outside.
    #[error(
        "X0 Y0, where the program places the tool, lies outside the tool profile (X{:.3} to X{:.3}, Y{:.3} to Y{:.3}); draw the \
         profile around X0 Y0",
        .min.x, .max.x, .min.y, .max.y
    )]
    Reference {
        /// Lower left corner of the profile's box.
        min: Point,
        /// Upper right corner of the profile's box.
        max: Point,
    },
}

impl ToolProfile {
    /// The profile that a closed contour encloses; its reference point is the origin, which must lie within it. The direction
    /// of the contour carries no meaning.
    ///
    /// # Errors
    /// When the contour is no simple closed curve, or the origin lies outside it.
    pub fn new(contour: Contour) -> Result<Self, ProfileError> {
        let region = build(vec![contour], &RepairOptions::default())?.region;
        let [contour] = region.contours() else {
            return Err(ProfileError::Several { count: region.contours().len() });
        };
        if contour.distance(Point::ORIGIN) > 0.0 && !region.contains(Point::ORIGIN) {
            let b = contour.bbox();
            return Err(ProfileError::Reference { min: b.min, max: b.max });
        }
        Ok(Self { contour: contour.clone() })
    }

    /// A circle of this radius (mm, positive).
    pub fn circle(radius: f64) -> Self {
        Self::rounded(2.0 * radius, 2.0 * radius, radius)
    }

    /// A rectangle with corners rounded by `radius` (mm): sharp where that is 0, a stadium where it is half the lesser side, a
    /// circle where it is half of both.
    pub fn rounded(width: f64, height: f64, radius: f64) -> Self {
        let (x, y) = (0.5 * width, 0.5 * height);
        let (u, v) = ((x - radius).max(0.0), (y - radius).max(0.0));
        let bulge = if radius > 0.0 { std::f64::consts::FRAC_PI_8.tan() } else { 0.0 };
        let corners = [
            [[u, -y, bulge], [x, -v, 0.0]],
            [[x, v, bulge], [u, y, 0.0]],
            [[-u, y, bulge], [-x, v, 0.0]],
            [[-x, -v, bulge], [-u, -y, 0.0]],
        ];
        Self { contour: Contour::from_vertices(&corners.concat()) }
    }

    /// An ellipse with these axes (mm): tangent arcs within the fit tolerance.
    pub fn ellipse(width: f64, height: f64) -> Self {
        Self { contour: ellipse::contour(0.5 * width, 0.5 * height) }
    }

    /// A regular polygon whose corners lie on a circle of this diameter (mm), one of them on the x axis.
    pub fn regular(sides: u32, diameter: f64) -> Self {
        let corner = |k: u32| {
            let p = Vec2::from_angle(std::f64::consts::TAU * f64::from(k) / f64::from(sides)) * (0.5 * diameter);
            [p.x, p.y, 0.0]
        };
        Self { contour: Contour::from_vertices(&(0..sides).map(corner).collect::<Vec<_>>()) }
    }

    /// Its outline about the reference point, counter-clockwise.
    pub fn contour(&self) -> &Contour {
        &self.contour
    }

    /// Its area, mm².
    pub fn area(&self) -> f64 {
        self.contour.area()
    }

    /// The largest distance of a point of it from the reference point, mm: the radius of what it covers when it turns.
    pub fn reach(&self) -> f64 {
        let farthest = |s: &Segment| {
            let ends = s.start().to_vec().length().max(s.end().to_vec().length());
            match s {
                Segment::Arc(a) if a.spans(a.center.to_vec()) => ends.max(a.center.to_vec().length() + a.radius),
                _ => ends,
            }
        };
        self.contour.segments.iter().map(farthest).fold(0.0, f64::max)
    }

    /// The largest extent of the profile along a direction (of length 1) from the reference point, mm.
    pub fn support(&self, direction: Vec2) -> f64 {
        let along = |s: &Segment| {
            let ends = s.start().to_vec().dot(direction).max(s.end().to_vec().dot(direction));
            match s {
                Segment::Arc(a) if a.spans(direction) => ends.max(a.center.to_vec().dot(direction) + a.radius),
                _ => ends,
            }
        };
        self.contour.segments.iter().map(along).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The same tool turned about its reference point by `angle` radians, counter-clockwise.
    #[must_use]
    pub fn rotated(&self, angle: f64) -> Self {
        Self { contour: Contour::new(self.contour.segments.iter().map(|s| s.rotated(angle)).collect()) }
    }

    /// Whether it bends to the left only.
    pub fn is_convex(&self) -> bool {
        let segments = &self.contour.segments;
        segments.iter().all(|s| s.curvature() >= 0.0)
            && segments.iter().zip(segments.iter().cycle().skip(1)).all(|(s, next)| {
                // Smooth joints turn by rounding to either side.
                s.end_tangent().angle_to(next.start_tangent()) > -TANGENT
            })
    }
}

#[cfg(test)]
mod tests;
