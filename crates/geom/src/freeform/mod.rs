//! Regions with free-form boundaries: closed contours of cubic Bézier and B-spline curves, sampled at a step.
//!
//! R. Molina-Carmona, A. Jimeno and M. Davia, *Contour pocketing computation using mathematical morphology*, section 2, take parametric cubic
//! curves and discretise them "in a set of ordered points along the length of the curve using a step s". So does [`FreeRegion::sampled`],
//! with points no more than the step apart, and no arcs are fitted.
//!
//! **Error.** A chord between two parameters `h` apart lies within `h² max|C''| / 8` of a curve `C`. With `n = ⌈max|C'| / s⌉` chords a
//! cubic, of which no one is longer than `s`, that is
//!
//! `e(s) = max|C''| / (8 n²) ≤ s² max|C''| / (8 max|C'|²)`,
//!
//! of second order in the step. Both maxima are bounds from the control points, so that `e` is one, too: [`Sampled::error`].
//! The boundary of the sampled region and that of the region are never farther apart. Hence, for any profile `B` and `D` the disk of
//! radius `e`: the places of `B` in the sampled region hold those of `B ⊕ D` in the region, and `B` enters no wall there by more than
//! `e`. Where the outline of the places is smooth it is no farther than `e` from the true one; at a corner of angle φ, 1/sin(φ/2) times that.
//!
//! Departure from the paper: points are equally far apart in the parameter of a cubic, not in its length.

mod cubic;
mod spline;

pub use cubic::Cubic;
pub use spline::{SplineError, bspline, closed_bspline};

use crate::contour::Contour;
use crate::region::Region;
use crate::repair::{RegionError, RepairOptions, build};
use crate::segment::Segment;
use crate::tolerance;

/// More chords of one cubic are a slip of the finger.
const MOST_CHORDS: f64 = 1e6;

/// Closed contours of cubics, islands among them: filled even-odd.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FreeRegion {
    /// Each contour's cubics, the end of each the start of the next one, and of the last that of the first.
    pub contours: Vec<Vec<Cubic>>,
}

/// A region that stands for one with free-form boundaries.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sampled {
    /// Its boundary is made of chords.
    pub region: Region,
    /// How far the two boundaries may be apart, mm.
    pub error: f64,
}

/// Why free-form contours bound no region.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FreeformError {
    /// The step makes no sense.
    #[error("a step of {step} mm: it must be above 0, and no curve may have more than a million chords")]
    Step {
        /// mm.
        step: f64,
    },
    /// The chords bound no region.
    #[error("the sampled curves bound no region: {0}")]
    Region(#[from] RegionError),
}

impl FreeRegion {
    /// The region sampled at points no more than `step` (mm) apart.
    ///
    /// # Errors
    /// Where the step makes no sense, or the contours are open, cross or enclose nothing.
    pub fn sampled(&self, step: f64) -> Result<Sampled, FreeformError> {
        let mut error = 0.0_f64;
        let mut contours = Vec::with_capacity(self.contours.len());
        for contour in &self.contours {
            let mut chords = Vec::new();
            for cubic in contour {
                let count = (cubic.speed_bound() / step).ceil().max(1.0);
                if !(step > 0.0 && count <= MOST_CHORDS) {
                    return Err(FreeformError::Step { step });
                }
                error = error.max(cubic.chord_error(1.0 / count));
                let at = |k: u32| cubic.at(f64::from(k) / count);
                chords.extend((0..count as u32).map(|k| Segment::line(at(k), at(k + 1))));
            }
            contours.push(Contour::new(chords));
        }
        let region = build(contours, &RepairOptions::default())?.region;
        Ok(Sampled { region, error })
    }

    /// The step at which no chord leaves its curve by more than a tolerance (mm), such as [`tolerance::FIT`].
    pub fn step_for(&self, tolerance: f64) -> f64 {
        let of = |c: &Cubic| (c.speed_bound() * (tolerance / c.chord_error(1.0)).sqrt()).min(c.speed_bound());
        self.contours.iter().flatten().map(of).fold(f64::INFINITY, f64::min)
    }

    /// Sampled within the fit tolerance, [`tolerance::FIT`].
    ///
    /// # Errors
    /// See [`FreeRegion::sampled`].
    pub fn fitted(&self) -> Result<Sampled, FreeformError> {
        self.sampled(self.step_for(tolerance::FIT))
    }
}

#[cfg(test)]
mod tests;
