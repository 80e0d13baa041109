//! Successive erosions, each of the drawing itself.
//!
//! Eroding by `B` and then `k` times by a convex step `T` is eroding once by `B ⊕ kT`. For a convex `B` this sum is made ([`convex_sum`]) and the
//! drawing eroded by it, so that no level inherits another one's rounding. The sum of a hollow profile and a circle may have a hole; there
//! the first erosion is eroded by circles of growing radius.

use pocketry_geom::offset::morphology::{MorphologyError, eroded};
use pocketry_geom::profile::convex_sum;
use pocketry_geom::{Contour, Point, Region, ToolProfile};

/// Shares of a step that are tried where a whole one is refused: any part of the step leaves nothing either, and where one runs
/// into places that coincide within rounding, another doesn't.
const SHARES: [f64; 4] = [1.0, 0.97, 0.93, 0.88];

/// A region that is eroded by a profile and then step by step.
pub(super) struct Levels<'a> {
    region: &'a Region,
    profile: &'a ToolProfile,
    /// Centre of the profile's inscribed circle.
    center: Point,
    stepover: f64,
    kind: Kind,
}

enum Kind {
    /// With the step.
    Convex(Contour),
    /// With the first erosion.
    Hollow(Region),
}

impl<'a> Levels<'a> {
    /// The stepover is at most the radius of the profile's inscribed circle, which is about `center`.
    pub(super) fn new(
        region: &'a Region,
        profile: &'a ToolProfile,
        (center, radius): (Point, f64),
        stepover: f64,
    ) -> Result<Self, MorphologyError> {
        let kind = if profile.is_convex() {
            Kind::Convex(step(profile, stepover / radius))
        } else {
            Kind::Hollow(eroded(region, profile.contour(), center)?)
        };
        Ok(Self { region, profile, center, stepover, kind })
    }

    pub(super) const fn stepover(&self) -> f64 {
        self.stepover
    }

    /// The places at which the profile lies in the region.
    pub(super) fn first(&self) -> Result<Region, MorphologyError> {
        match &self.kind {
            Kind::Convex(_) => eroded(self.region, self.profile.contour(), self.center),
            Kind::Hollow(first) => Ok(first.clone()),
        }
    }

    /// What is left of them a step after `depth`, which is counted in steps and moves on: by one, or somewhat less.
    pub(super) fn after(&self, depth: &mut f64) -> Result<Region, MorphologyError> {
        let mut refused = None;
        for next in SHARES.map(|share| *depth + share) {
            match self.at(next) {
                Ok(region) => {
                    *depth = next;
                    return Ok(region);
                }
                Err(error) => refused = refused.or(Some(error)),
            }
        }
        refused.map_or_else(|| Ok(Region::default()), Err)
    }

    fn at(&self, depth: f64) -> Result<Region, MorphologyError> {
        match &self.kind {
            Kind::Convex(step) => {
                let grown = convex_sum(self.profile.contour(), &scaled(step, depth));
                eroded(self.region, &grown, self.center)
            }
            Kind::Hollow(first) => eroded(first, ToolProfile::circle(depth * self.stepover).contour(), Point::ORIGIN),
        }
    }
}

/// The step of a convex profile: `σ(b − B)`.
fn step(profile: &ToolProfile, share: f64) -> Contour {
    let vertices = profile.contour().to_vertices();
    let sum = vertices.iter().fold([0.0; 2], |[x, y], v| [x + v[0], y + v[1]]);
    let [x, y] = sum.map(|s| s / vertices.len() as f64);
    let moved = |v: &[f64; 3]| [share * (x - v[0]), share * (y - v[1]), v[2]];
    Contour::from_vertices(&vertices.iter().map(moved).collect::<Vec<_>>())
}

/// A contour scaled about the origin.
fn scaled(contour: &Contour, share: f64) -> Contour {
    let vertices = contour.to_vertices();
    Contour::from_vertices(&vertices.into_iter().map(|[x, y, bulge]| [share * x, share * y, bulge]).collect::<Vec<_>>())
}
