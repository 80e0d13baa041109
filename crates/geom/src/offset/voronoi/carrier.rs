//! The line, circle or point that carries a site, extended beyond its ends.

use crate::point::{Point, Vec2};
use crate::segment::{Arc, Line};
use crate::skeleton::SiteShape;

/// What a site's distance is measured to.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Carrier {
    /// A line with its unit direction.
    Line(Line, Vec2),
    /// A circle.
    Circle(Arc),
    /// A point.
    Point(Point),
}

/// The curve at one distance from a carrier.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Parallel {
    /// A point and a unit direction.
    Line(Point, Vec2),
    /// Centre and radius.
    Circle(Point, f64),
}

impl Carrier {
    /// The carrier of a site.
    pub(crate) fn of(shape: SiteShape) -> Self {
        match shape {
            SiteShape::Line(l) => Self::Line(l, l.direction()),
            SiteShape::Arc(a) => Self::Circle(a),
            SiteShape::Point(p) => Self::Point(p),
        }
    }

    /// Distance of `x`, positive on the pocket's side.
    pub(crate) fn distance(&self, x: Point) -> f64 {
        match self {
            Self::Line(l, u) => u.cross(x - l.start),
            Self::Circle(a) => {
                if a.ccw {
                    -a.radial_distance(x)
                } else {
                    a.radial_distance(x)
                }
            }
            Self::Point(p) => x.distance(*p),
        }
    }

    /// Direction in which the distance grows, of length 1 (zero at a centre).
    pub(crate) fn gradient(&self, x: Point) -> Vec2 {
        let unit = |v: Vec2| if v == Vec2::ZERO { v } else { v.normalized() };
        match self {
            Self::Line(_, u) => u.left(),
            Self::Circle(a) if a.ccw => unit(a.center - x),
            Self::Circle(a) => unit(x - a.center),
            Self::Point(p) => unit(x - *p),
        }
    }

    /// Where the points at distance `d` on the pocket's side lie.
    pub(crate) fn parallel(&self, d: f64) -> Parallel {
        match self {
            Self::Line(l, u) => Parallel::Line(l.start + u.left() * d, *u),
            Self::Circle(a) => Parallel::Circle(a.center, if a.ccw { (a.radius - d).max(0.0) } else { a.radius + d }),
            Self::Point(p) => Parallel::Circle(*p, d),
        }
    }

    /// Centre and sense of travel along parallels, for circles and points.
    pub(crate) fn center(&self) -> Option<(Point, bool)> {
        match self {
            Self::Line(..) => None,
            Self::Circle(a) => Some((a.center, a.ccw)),
            Self::Point(p) => Some((*p, false)),
        }
    }
}
