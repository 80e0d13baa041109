//! The cutter's lower outline: height above the tip as a function of the distance from the axis.
//!
//! Flat out to `flat`, an arc of radius `corner` out to `shoulder`, a flank of slope `slope` out to `radius`; beyond, nothing
//! passes. It is convex and does not fall, which is all that the contacts rely on. Flat, ball, bull-nose and cone are
//! special cases, and so are all of them grown by the stock to leave.

use pocketry_motion::Cutter;

/// A cutter's lower outline, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Profile {
    flat: f64,
    corner: f64,
    shoulder: f64,
    /// Infinite where the corner runs into the shaft.
    slope: f64,
    radius: f64,
    /// How far the outline's tip lies below the real cutter's.
    below: f64,
}

impl Profile {
    /// The outline of a cutter grown by `leave` in every direction: where the grown cutter touches the model, the real one
    /// leaves just that. A cone's rim is not rounded but prolonged, which leaves a little more above the rim.
    pub(crate) fn new(cutter: Cutter, radius: f64, leave: f64) -> Self {
        let (flat, corner, slope) = match cutter {
            Cutter::Flat => (radius, 0.0, f64::INFINITY),
            Cutter::Ball => (0.0, radius, f64::INFINITY),
            Cutter::Bull { corner } => (radius - corner, corner, f64::INFINITY),
            Cutter::Cone { angle } => (0.0, 0.0, 1.0 / (0.5 * angle).tan()),
        };
        let (corner, radius) = (corner + leave, radius + leave);
        let shoulder = if slope.is_finite() { flat + corner * slope / slope.hypot(1.0) } else { radius };
        Self { flat, corner, shoulder, slope, radius, below: leave }
    }

    /// How far from the axis it reaches, mm.
    pub(crate) const fn radius(&self) -> f64 {
        self.radius
    }

    /// How much higher the real cutter's tip is than the outline's, mm.
    pub(crate) const fn below(&self) -> f64 {
        self.below
    }

    /// Height above the tip at distance `rho` from the axis, mm; `rho` must not exceed the radius.
    pub(crate) fn height(&self, rho: f64) -> f64 {
        if rho <= self.flat {
            return 0.0;
        }
        let arc = rho.min(self.shoulder) - self.flat;
        let rise = self.corner - (self.corner * self.corner - arc * arc).max(0.0).sqrt();
        if rho <= self.shoulder { rise } else { rise + self.slope * (rho - self.shoulder) }
    }

    /// How far from the axis the outline has risen by `height` (mm), at most the radius.
    pub(crate) fn reach(&self, height: f64) -> f64 {
        let at_shoulder = self.height(self.shoulder);
        let rho = if height < at_shoulder {
            self.flat + (self.corner * self.corner - (self.corner - height).powi(2)).max(0.0).sqrt()
        } else if self.slope.is_finite() {
            self.shoulder + (height - at_shoulder) / self.slope
        } else {
            self.radius
        };
        rho.min(self.radius)
    }

    /// Slope at distance `rho`; infinite at the end of a corner that runs into the shaft.
    pub(crate) fn slope(&self, rho: f64) -> f64 {
        if rho <= self.flat {
            return 0.0;
        }
        if rho > self.shoulder {
            return self.slope;
        }
        let arc = rho - self.flat;
        let rest = (self.corner * self.corner - arc * arc).max(0.0).sqrt();
        if rest > 0.0 { arc / rest } else { self.slope }
    }

    /// Distance from the axis at which a plane of this slope (not negative) touches.
    pub(crate) fn contact(&self, slope: f64) -> f64 {
        if slope == 0.0 {
            0.0
        } else if slope < self.slope {
            self.flat + self.corner * slope / slope.hypot(1.0)
        } else {
            self.radius
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outlines_are_those_of_the_cutters() {
        let ball = Profile::new(Cutter::Ball, 5.0, 0.0);
        assert_eq!((ball.height(0.0), ball.height(3.0), ball.height(5.0)), (0.0, 1.0, 5.0));
        let flat = Profile::new(Cutter::Flat, 5.0, 0.0);
        assert_eq!((flat.height(5.0), flat.contact(0.3)), (0.0, 5.0));
        let grown = Profile::new(Cutter::Flat, 5.0, 1.0);
        assert_eq!((grown.radius(), grown.height(5.0), grown.height(6.0)), (6.0, 0.0, 1.0));
        let cone = Profile::new(Cutter::Cone { angle: std::f64::consts::FRAC_PI_2 }, 5.0, 0.0);
        assert!((cone.height(2.0) - 2.0).abs() < 1e-12);
        assert_eq!((cone.contact(0.5), cone.contact(2.0)), (0.0, 5.0));
    }

    #[test]
    fn slopes_are_derivatives_and_contacts_their_inverse() {
        for cutter in [Cutter::Ball, Cutter::Bull { corner: 2.0 }, Cutter::Cone { angle: 1.0 }] {
            let p = Profile::new(cutter, 5.0, 0.5);
            for k in 1..50 {
                let (rho, step) = (0.1 * f64::from(k), 1e-6);
                let rate = (p.height(rho + step) - p.height(rho - step)) / (2.0 * step);
                assert!((rate - p.slope(rho)).abs() < 1e-3 * (1.0 + rate), "{cutter:?} {rho}");
                assert!(p.height(rho) == 0.0 || (p.reach(p.height(rho)) - rho).abs() < 1e-6, "{cutter:?} {rho}");
                if p.slope(rho) > 0.0 && p.slope(rho) < p.slope {
                    assert!((p.contact(p.slope(rho)) - rho).abs() < 1e-9, "{cutter:?} {rho}");
                }
            }
        }
    }
}
