//! Boundary elements in the form that the construction computes with.

use crate::point::{Point, Vec2};
use crate::tolerance::skeleton as tol;

/// A disk of the plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disk {
    pub(super) center: Point,
    pub(super) radius: f64,
}

/// What kind of curve carries an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Carrier {
    /// A line: one inner normal.
    Line,
    /// A circle seen from outside, or a point (radius 0): normals turn clockwise with travel.
    Outside,
    /// A circle seen from inside: normals turn counter-clockwise with travel.
    Inside,
}

/// A site, or the piece of one between two cuts, in the construction's frame.
///
/// A circular element lies at `center + rho * n` for its inner unit normals `n`, whose signed radius `rho` is positive
/// for a circle seen from outside, negative from inside and 0 for a point; a disk `(x, r)` touches its carrier where
/// `|x - center| = |r + rho|`. Powers are taken relative to `start`, so that nothing cancels for radii far above the
/// region's size.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element {
    pub(super) start: Point,
    pub(super) end: Point,
    /// Inner unit normal at the start of the extent.
    pub(super) n0: Vec2,
    /// Inner unit normal at its end.
    pub(super) n1: Vec2,
    /// Centre of the circle; for a line its start.
    pub(super) center: Point,
    /// Signed radius.
    pub(super) rho: f64,
    /// Length of a line.
    pub(super) length: f64,
    /// The site that it is (a piece of).
    pub(super) site: u32,
    pub(super) carrier: Carrier,
    /// Whether the normals turn by more than π.
    pub(super) wide: bool,
}

impl Element {
    /// An open segment from `start` to `end` with the pocket to the left.
    pub(super) fn line(start: Point, end: Point, site: u32) -> Self {
        let along = end - start;
        let length = along.length();
        let n = (along / length).left();
        Self { start, end, n0: n, n1: n, center: start, rho: 0.0, length, site, carrier: Carrier::Line, wide: false }
    }

    /// An open arc with the pocket to the left.
    pub(super) fn arc(start: Point, end: Point, center: Point, radius: f64, ccw: bool, site: u32) -> Self {
        let (mut n0, mut n1) = ((start - center).normalized(), (end - center).normalized());
        let wide = if ccw { n0.cross(n1) < 0.0 } else { n0.cross(n1) > 0.0 };
        let (carrier, rho) = if ccw {
            (n0, n1) = (-n0, -n1);
            (Carrier::Inside, -radius)
        } else {
            (Carrier::Outside, radius)
        };
        Self { start, end, n0, n1, center, rho, length: 0.0, site, carrier, wide }
    }

    /// A reflex vertex whose normals fan clockwise from `n0` to `n1`.
    pub(super) fn point(p: Point, n0: Vec2, n1: Vec2, site: u32) -> Self {
        let (carrier, wide) = (Carrier::Outside, n0.cross(n1) > 0.0);
        Self { start: p, end: p, n0, n1, center: p, rho: 0.0, length: 0.0, site, carrier, wide }
    }

    pub(super) fn is_line(&self) -> bool {
        self.carrier == Carrier::Line
    }

    /// Unit direction of travel along a line.
    #[inline]
    pub(super) fn along(&self) -> Vec2 {
        self.n0.right()
    }

    /// `|p - center|² - rho²` of a circular element, free of cancellation near its start.
    #[inline]
    pub(super) fn power(&self, p: Point) -> f64 {
        let from_start = p - self.start;
        from_start.dot(from_start + self.n0 * (2.0 * self.rho))
    }

    /// Signed distance from the carrier, positive on the pocket's side.
    #[inline]
    pub(super) fn gap(&self, p: Point) -> f64 {
        match self.carrier {
            Carrier::Line => (p - self.start).dot(self.n0),
            Carrier::Outside => self.power(p) / ((p - self.center).length() + self.rho),
            Carrier::Inside => -self.power(p) / ((p - self.center).length() - self.rho),
        }
    }

    /// Unit inner normal at the foot of `p` on the carrier: the gradient of [`Self::gap`].
    #[inline]
    pub(super) fn normal_at(&self, p: Point) -> Vec2 {
        match self.carrier {
            Carrier::Line => self.n0,
            Carrier::Outside => unit_or(p - self.center, self.n0),
            Carrier::Inside => unit_or(self.center - p, self.n0),
        }
    }

    /// The point of the carrier with inner normal `n` (of a circular element).
    #[inline]
    pub(super) fn foot_with_normal(&self, n: Vec2) -> Point {
        self.start + (n - self.n0) * self.rho
    }

    /// Where `p` projects onto the carrier.
    #[inline]
    pub(super) fn foot(&self, p: Point) -> Point {
        match self.carrier {
            Carrier::Line => self.start + self.along() * (p - self.start).dot(self.along()),
            _ => self.foot_with_normal(self.normal_at(p)),
        }
    }

    /// How far the foot of `p` lies outside the extent: before its start, after its end. Positive means outside.
    #[inline]
    pub(super) fn overshoot(&self, p: Point) -> (f64, f64) {
        if self.is_line() {
            let s = (p - self.start).dot(self.along());
            return (-s, s - self.length);
        }
        let (v, scale) = match self.carrier {
            Carrier::Inside => {
                let v = self.center - p;
                let length = v.length();
                if length <= tol::FOOT {
                    // in the centre every foot will do
                    return (0.0, 0.0);
                }
                (v / length, -self.rho)
            }
            _ => (p - self.center, 1.0),
        };
        let (mut before, mut after) = (v.cross(self.n0), self.n1.cross(v));
        if self.carrier == Carrier::Outside {
            (before, after) = (-before, -after);
        }
        if self.wide {
            // outside only where both half-planes are left; the nearer end counts
            (before, after) = if before < after { (before, after.min(0.0)) } else { (before.min(0.0), after) };
        } else if self.is_behind(v) {
            let far = v.length() * scale;
            return (far, far);
        }
        (before * scale, after * scale)
    }

    /// Whether the foot of `p` lies in the extent, but for `slack`.
    #[inline]
    pub(super) fn faces(&self, p: Point, slack: f64) -> bool {
        let (before, after) = self.overshoot(p);
        before <= slack && after <= slack
    }

    /// Where the foot of `p` lies outside the extent: whether it is the start that it has left.
    pub(super) fn is_left_at_start(&self, p: Point) -> bool {
        if self.start == self.end {
            let v = p - self.center;
            v.dot(self.n0) >= v.dot(self.n1)
        } else {
            p.distance_squared(self.start) <= p.distance_squared(self.end)
        }
    }

    /// Distance from `p` to the closed element.
    #[inline]
    pub(super) fn distance(&self, p: Point) -> f64 {
        match self.carrier {
            Carrier::Line => {
                let from = p - self.start;
                let s = from.dot(self.along());
                if s <= 0.0 {
                    from.length()
                } else if s >= self.length {
                    p.distance(self.end)
                } else {
                    from.dot(self.n0).abs()
                }
            }
            Carrier::Outside if self.rho == 0.0 => p.distance(self.start),
            _ => {
                let v = if self.carrier == Carrier::Inside { self.center - p } else { p - self.center };
                if self.covers(v) {
                    (self.power(p) / (v.length() + self.rho.abs())).abs()
                } else {
                    p.distance_squared(self.start).min(p.distance_squared(self.end)).sqrt()
                }
            }
        }
    }

    /// Whether the direction `v` of a normal lies in the extent's closed range.
    #[inline]
    pub(super) fn covers(&self, v: Vec2) -> bool {
        let (mut after_start, mut before_end) = (self.n0.cross(v), v.cross(self.n1));
        if self.carrier == Carrier::Outside {
            (after_start, before_end) = (-after_start, -before_end);
        }
        if self.wide {
            after_start >= 0.0 || before_end >= 0.0
        } else {
            after_start >= 0.0 && before_end >= 0.0 && !self.is_behind(v)
        }
    }

    /// Whether `v` looks away from a narrow extent, whose two half-planes alone can't tell front from back.
    #[inline]
    fn is_behind(&self, v: Vec2) -> bool {
        self.n0.dot(self.n1) > 0.0 && v.dot(self.n0 + self.n1) < 0.0
    }

    /// Radius of the disk that touches some curve at `foot` with inner normal `n` there and this carrier too:
    /// one division. Negative, infinite or NaN where there is none.
    #[inline]
    pub(super) fn pencil_radius(&self, foot: Point, n: Vec2) -> f64 {
        self.pencil_radius_near(foot, Vec2::ZERO, n)
    }

    /// The same for the foot `base + offset`. Near a corner that the two curves share, `base`, everything follows from
    /// the offset: an almost smooth corner would be lost in the rounding of coordinates.
    #[inline]
    pub(super) fn pencil_radius_near(&self, base: Point, offset: Vec2, n: Vec2) -> f64 {
        if self.carrier == Carrier::Inside {
            let apart = base + (offset - n * self.rho) - self.center;
            if apart.length_squared() <= tol::EMPTY * tol::EMPTY {
                // the same circle: its own disk
                return -self.rho;
            }
        }
        // powers from the nearer end: nothing cancels where the two curves meet
        let (from_start, from_end) = (base - self.start + offset, base - self.end + offset);
        let (from, n_end) = if from_start.length_squared() <= from_end.length_squared() {
            (from_start, self.n0)
        } else {
            (from_end, self.n1)
        };
        let difference = (n - n_end).length_squared();
        if self.is_line() {
            2.0 * from.dot(n_end) / difference
        } else {
            from.dot(from + n_end * (2.0 * self.rho)) / (self.rho * difference - 2.0 * from.dot(n))
        }
    }

    /// The turn from the normal at the start to the normal `n`, in the direction of travel, in [0, 2π).
    pub(super) fn turn_to(&self, n: Vec2) -> f64 {
        turn(self.carrier, self.n0, n)
    }

    /// The turn from the normal in the middle of a wide extent to the normal `n`, in the direction of travel, in (-π, π].
    pub(super) fn turn_from_middle(&self, n: Vec2) -> f64 {
        let chord = (self.n1 - self.n0).right();
        let ahead = if self.carrier == Carrier::Outside { -chord } else { chord };
        let middle = if self.n0.dot(self.n1) > 0.0 { -(self.n0 + self.n1) } else { ahead };
        let turn = middle.angle_to(n);
        if self.carrier == Carrier::Outside { -turn } else { turn }
    }

    /// The same curve seen from its other side.
    pub(super) fn flipped(&self) -> Self {
        let carrier = match self.carrier {
            Carrier::Line => Carrier::Line,
            Carrier::Outside if self.rho == 0.0 => return *self,
            Carrier::Outside => Carrier::Inside,
            Carrier::Inside => Carrier::Outside,
        };
        let (start, end, center) = (self.end, self.start, if self.is_line() { self.end } else { self.center });
        Self { start, end, center, n0: -self.n1, n1: -self.n0, rho: -self.rho, carrier, ..*self }
    }

    /// The piece between two feet with their normals.
    pub(super) fn piece(&self, from: (Point, Vec2), to: (Point, Vec2)) -> Self {
        let ((start, n0), (end, n1)) = (from, to);
        let wide = self.wide && !self.is_line() && turn(self.carrier, n0, n1) > std::f64::consts::PI;
        let (center, length) = if self.is_line() { (start, start.distance(end)) } else { (self.center, 0.0) };
        Self { start, end, n0, n1, center, length, wide, ..*self }
    }
}

fn turn(carrier: Carrier, from: Vec2, to: Vec2) -> f64 {
    let angle = if carrier == Carrier::Outside { to.angle_to(from) } else { from.angle_to(to) };
    if angle < 0.0 { angle + std::f64::consts::TAU } else { angle }
}

#[inline]
fn unit_or(v: Vec2, other: Vec2) -> Vec2 {
    let length = v.length();
    if length > 0.0 { v / length } else { other }
}
