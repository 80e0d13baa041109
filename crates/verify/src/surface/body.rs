//! The cutter as a body: how deep a point lies inside it, and where it reaches deepest below a plane.
//!
//! A flat of radius `flat`, rounded by `corner` out to the shaft of radius `radius`, or a cone. Everything here is written for the proof:
//! the planner has a cutter of its own.

use pocketry_geom::mesh::Corner;
use pocketry_motion::Cutter;

#[derive(Clone, Copy, Debug)]
pub(super) struct Body {
    pub(super) radius: f64,
    flat: f64,
    corner: f64,
    /// How far the tip of a cone is drawn apart.
    spread: f64,
    /// Sine and cosine of half the angle of a cone.
    cone: Option<(f64, f64)>,
}

impl Body {
    pub(super) fn new(cutter: Cutter, radius: f64) -> Self {
        let round = |corner: f64| Self { radius, flat: radius - corner, corner, spread: 0.0, cone: None };
        match cutter {
            Cutter::Flat => round(0.0),
            Cutter::Ball => round(radius),
            Cutter::Bull { corner } => round(corner),
            Cutter::Cone { angle } => Self { cone: Some((0.5 * angle).sin_cos()), ..round(0.0) },
        }
    }

    /// The same body drawn apart from its axis by `by`, mm.
    pub(super) fn wider(&self, by: f64) -> Self {
        Self { radius: self.radius + by, flat: self.flat + by, spread: self.spread + by, ..*self }
    }

    /// How deep a point lies inside, `rho` from the axis and `y` above the tip, mm: its distance from the surface. Outside
    /// it is negative, and no farther below zero than the point is away. Concave, and it changes no faster than the point moves.
    pub(super) fn depth(&self, rho: f64, y: f64) -> f64 {
        if let Some((sin, cos)) = self.cone {
            let off = (rho - self.spread).max(0.0);
            // Below the flanks' normals at the tip, the tip is the nearest point.
            let flank = if off * sin + y * cos < 0.0 { -off.hypot(y) } else { y * sin - off * cos };
            return (self.radius - rho).min(flank);
        }
        if rho > self.flat && y < self.corner {
            return self.corner - (rho - self.flat).hypot(self.corner - y);
        }
        (self.radius - rho).min(y)
    }

    /// A bound of [`Body::depth`] for points no higher than `y` above the tip.
    pub(super) fn depth_below(&self, y: f64) -> f64 {
        match self.cone {
            Some((sin, _)) if y > 0.0 => y * sin,
            _ => y,
        }
    }

    /// Height above the tip of the body's surface at `rho`, mm; infinite beyond the shaft.
    pub(super) fn floor(&self, rho: f64) -> f64 {
        if rho > self.radius {
            return f64::INFINITY;
        }
        if let Some((sin, cos)) = self.cone {
            return (rho - self.spread).max(0.0) * cos / sin;
        }
        let arc = (rho - self.flat).max(0.0);
        self.corner - (self.corner * self.corner - arc * arc).max(0.0).sqrt()
    }

    /// The body's point, relative to the tip, that reaches deepest below a plane with this unit normal, which points up.
    pub(super) fn deepest(&self, [nx, ny, nz]: Corner) -> Corner {
        let level = nx.hypot(ny);
        if level == 0.0 {
            return [0.0; 3];
        }
        let (rho, y) = match self.cone {
            Some((sin, cos)) if level * sin > nz * cos => (self.radius, self.floor(self.radius)),
            Some(_) => (self.spread, 0.0),
            None => (self.flat + self.corner * level, self.corner * (1.0 - nz)),
        };
        [-nx / level * rho, -ny / level * rho, y]
    }
}
