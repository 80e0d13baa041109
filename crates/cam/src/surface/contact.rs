//! How high the tip must be for the outline to clear a facet or an edge: the inverse cutter's Minkowski sum at one place.
//!
//! A point of the model at height `z` and distance `rho` from the axis asks for a tip at `z - height(rho)` or above.
//! Over a facet's plane that is highest where the outline's slope is the plane's; along an edge it is a concave function of the
//! place, so its highest point is an end of the part within reach, or the only zero of its derivative. Edges hold their ends, so
//! vertices need no test of their own.

use super::profile::Profile;
use pocketry_geom::mesh::{Corner, above};
use pocketry_geom::tolerance::surface::{CONTACT_STEPS, INSIDE};
use pocketry_geom::{Point, Vec2, vec2};

/// A facet that is not vertical.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facet {
    corners: [Point; 3],
    /// A corner's height and place.
    at: Corner,
    /// Uphill, as steep as the plane.
    gradient: Vec2,
    /// Twice the area seen from above; negative where it runs clockwise.
    area: f64,
}

impl Facet {
    /// `None` for a vertical one: its upper edges do its work.
    pub(super) fn new(corners: [Corner; 3]) -> Option<Self> {
        let [a, b, c] = corners;
        let (u, v) = (above(b) - above(a), above(c) - above(a));
        let area = u.cross(v);
        let (du, dv) = (b[2] - a[2], c[2] - a[2]);
        let gradient = vec2((du * v.y - dv * u.y) / area, (dv * u.x - du * v.x) / area);
        let sound = gradient.x.is_finite() && gradient.y.is_finite();
        sound.then(|| Self { corners: corners.map(above), at: a, gradient, area })
    }

    /// Height of its plane above `p`.
    fn plane(&self, p: Point) -> f64 {
        self.at[2] + self.gradient.dot(p - above(self.at))
    }

    /// By how much `q` lies above the plane.
    pub(super) fn below(&self, q: Corner) -> f64 {
        q[2] - self.plane(above(q))
    }

    fn holds(&self, p: Point) -> bool {
        let [a, b, c] = self.corners;
        let side = |a: Point, b: Point| (b - a).cross(p - a) * self.area.signum();
        let least = -INSIDE * self.area.abs();
        side(a, b) >= least && side(b, c) >= least && side(c, a) >= least
    }

    /// The tip's height at `c` where the outline touches the facet's inside, if it does.
    pub(super) fn tip(&self, profile: &Profile, c: Point) -> Option<f64> {
        let slope = self.gradient.length();
        let rho = profile.contact(slope);
        let touch = if slope > 0.0 { c + self.gradient * (rho / slope) } else { c };
        self.holds(touch).then(|| self.plane(touch) - profile.height(rho))
    }
}

/// The tip's height at `c` where the outline touches an edge, if it is within reach.
pub(super) fn edge_tip(profile: &Profile, c: Point, a: Corner, b: Corner) -> Option<f64> {
    let (from, to) = (above(a) - c, above(b) - c);
    let along = to - from;
    let length = along.length();
    let radius = profile.radius();
    if length == 0.0 {
        let rho = from.length();
        return (rho <= radius).then(|| a[2].max(b[2]) - profile.height(rho));
    }
    let direction = along / length;
    let (start, off) = (from.dot(direction), from.cross(direction).abs());
    let half = radius * radius - off * off;
    if half < 0.0 {
        return None;
    }
    let half = half.sqrt();
    // Places along the edge are measured from the foot of the axis.
    let (low, high) = (start.max(-half), (start + length).min(half));
    if low > high {
        return None;
    }
    let rise = (b[2] - a[2]) / length;
    let place = steepest(profile, off, rise, low, high);
    let rho = off.hypot(place).min(radius);
    let z = if place == start { a[2] } else { a[2] + rise * (place - start) };
    Some(z - profile.height(rho))
}

/// Where `rise * s - height(hypot(off, s))`, concave, is highest in `low..=high`.
fn steepest(profile: &Profile, off: f64, rise: f64, mut low: f64, mut high: f64) -> f64 {
    let rate = |s: f64| {
        let rho = off.hypot(s);
        let slope = profile.slope(rho.min(profile.radius()));
        // A shaft's infinite slope tells only on which side of the axis it stands.
        rise - if slope == 0.0 || s == 0.0 { 0.0 } else { slope * (s / rho) }
    };
    let (mut at_low, mut at_high) = (rate(low), rate(high));
    if at_low <= 0.0 {
        return low;
    }
    if at_high >= 0.0 {
        return high;
    }
    // The Illinois method, halving where a rate is infinite.
    for _ in 0..CONTACT_STEPS {
        let part = at_low / (at_low - at_high);
        let part = if part.is_finite() && part > 0.0 && part < 1.0 && at_high.is_finite() { part } else { 0.5 };
        let s = low + part * (high - low);
        if s <= low || s >= high {
            break;
        }
        let at = rate(s);
        if at == 0.0 {
            return s;
        }
        if at > 0.0 {
            (low, at_low) = (s, at);
            at_high *= 0.5;
        } else {
            (high, at_high) = (s, at);
            at_low *= 0.5;
        }
    }
    0.5 * (low + high)
}
