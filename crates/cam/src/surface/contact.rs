//! How high the tip must be for the outline to clear a facet or an edge: the inverse cutter's Minkowski sum at one place.
//!
//! A point of the model at height `z` and distance `rho` from the axis asks for a tip at `z - height(rho)` or above.
//! Over a facet's plane that is highest where the outline's slope is the plane's; along an edge it is a concave function of the
//! place, so its highest point is an end of the part within reach, or the only zero of its derivative. Edges hold their ends, so
//! vertices need no test of their own.

use super::profile::Profile;
use pocketry_geom::mesh::{Corner, above};
use pocketry_geom::tolerance::surface::{CONTACT, CONTACT_STEPS, INSIDE};
use pocketry_geom::{Point, Vec2, vec2};

/// A facet that is not vertical, and where a given outline touches its plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facet {
    corners: [Point; 3],
    /// A corner's height and place.
    at: Corner,
    /// Uphill, as steep as the plane.
    gradient: Vec2,
    /// Twice the area seen from above; negative where it runs clockwise.
    area: f64,
    /// From the axis to where the outline touches the plane.
    touch: Vec2,
    /// How much higher than the plane below the axis the tip then stands, mm.
    rise: f64,
}

impl Facet {
    /// `None` for a vertical one: its upper edges do its work.
    pub(super) fn new(corners: [Corner; 3], profile: &Profile) -> Option<Self> {
        let [a, b, c] = corners;
        let (u, v) = (above(b) - above(a), above(c) - above(a));
        let area = u.cross(v);
        let (du, dv) = (b[2] - a[2], c[2] - a[2]);
        let gradient = vec2((du * v.y - dv * u.y) / area, (dv * u.x - du * v.x) / area);
        let slope = gradient.length();
        let rho = profile.contact(slope);
        let touch = if slope > 0.0 { gradient * (rho / slope) } else { vec2(0.0, 0.0) };
        let rise = slope * touch.length() - profile.height(rho);
        let sound = gradient.x.is_finite() && gradient.y.is_finite();
        sound.then(|| Self { corners: corners.map(above), at: a, gradient, area, touch, rise })
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

    /// The tip's height at `c` where the outline touches the facet's inside, if it does, and if above `known`.
    pub(super) fn tip(&self, c: Point, known: f64) -> Option<f64> {
        let tip = self.plane(c) + self.rise;
        (tip > known && self.holds(c + self.touch)).then_some(tip)
    }
}

/// The tip's height at `c` where the outline touches an edge, if it is within reach, and if above `known`.
pub(super) fn edge_tip(profile: &Profile, c: Point, [a, b]: [Corner; 2], known: f64) -> Option<f64> {
    let (from, to) = (above(a) - c, above(b) - c);
    let along = to - from;
    let length = along.length();
    let radius = profile.radius();
    if length == 0.0 {
        let rho = from.length();
        return (rho <= radius).then(|| a[2].max(b[2]) - profile.height(rho));
    }
    let direction = along / length;
    let (start, off) = (from.dot(direction), from.cross(direction));
    let half = radius * radius - off * off;
    if half < 0.0 {
        return None;
    }
    let half = half.sqrt();
    // Places along the edge are measured from the foot of the axis.
    let (low, high) = (start.max(-half), (start + length).min(half));
    let rise = (b[2] - a[2]) / length;
    let edge = Edge { profile, off_squared: off * off, rise, foot: a[2] - rise * start };
    (low <= high).then(|| edge.highest(low, high, known))
}

/// The tip that each place along an edge asks for: a concave function.
struct Edge<'a> {
    profile: &'a Profile,
    off_squared: f64,
    rise: f64,
    /// Height of the edge's line at the foot of the axis, mm.
    foot: f64,
}

impl Edge<'_> {
    fn rho(&self, s: f64) -> f64 {
        (self.off_squared + s * s).sqrt().min(self.profile.radius())
    }

    fn tip(&self, s: f64) -> f64 {
        self.foot + self.rise * s - self.profile.height(self.rho(s))
    }

    /// How fast the tip rises along the edge; a shaft's infinite slope tells only on which side of the axis it stands.
    fn rate(&self, s: f64) -> f64 {
        let rho = self.rho(s);
        let slope = self.profile.slope(rho);
        self.rise - if slope == 0.0 || s == 0.0 { 0.0 } else { slope * (s / rho) }
    }

    /// The highest tip in `low..=high`, or one not above `known` where there is none: by the Illinois method, halving where a rate is infinite. A tangent
    /// bounds a concave function, which tells early where there is nothing to be found, and when it has been.
    fn highest(&self, mut low: f64, mut high: f64, known: f64) -> f64 {
        let (mut at_low, mut at_high) = (self.rate(low), self.rate(high));
        if at_low <= 0.0 {
            return self.tip(low);
        }
        if at_high >= 0.0 {
            return self.tip(high);
        }
        let mut best = f64::NEG_INFINITY;
        let (mut low_weight, mut high_weight) = (1.0, 1.0);
        for _ in 0..CONTACT_STEPS {
            let (u, v) = (at_low * low_weight, at_high * high_weight);
            let part = u / (u - v);
            let part = if part > 0.0 && part < 1.0 && v.is_finite() { part } else { 0.5 };
            let s = low + part * (high - low);
            if s <= low || s >= high {
                break;
            }
            let (tip, at) = (self.tip(s), self.rate(s));
            best = best.max(tip);
            let room = if at > 0.0 { at * (high - s) } else { at * (low - s) };
            if room <= CONTACT || tip + room <= known {
                break;
            }
            if at > 0.0 {
                (low, at_low, low_weight, high_weight) = (s, at, 1.0, 0.5 * high_weight);
            } else {
                (high, at_high, high_weight, low_weight) = (s, at, 1.0, 0.5 * low_weight);
            }
        }
        best
    }
}
