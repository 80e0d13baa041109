//! Fibres: straight ways from a wall to the place of the skeleton whose disk touches the wall there.

use pocketry_geom::distance::Boundary;
use pocketry_geom::offset::PairwiseOffsetter;
use pocketry_geom::skeleton::{SiteId, SiteShape};
use pocketry_geom::{Point, Vec2};

/// By how much longer than the last one a fibre is taken to be, at first.
const GUESS: f64 = 1.03125;

/// The end of a fibre.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fibre {
    /// The wall.
    pub(super) site: SiteId,
    /// Where it begins.
    pub(super) foot: Point,
    /// Unit vector away from the wall.
    pub(super) normal: Vec2,
    /// Where it ends.
    pub(super) end: Point,
    /// Clearance there, mm.
    pub(super) clearance: f64,
    /// Whether it stands for the fibre that comes from the other wall, too: of both, that of the wall with the lower number.
    pub(super) first: bool,
}

/// Finds fibres.
pub(super) struct Fibres<'a> {
    offsetter: &'a PairwiseOffsetter<'a>,
    walls: &'a Boundary,
    /// Clearances of no interest below and above, mm.
    low: f64,
    high: f64,
}

impl<'a> Fibres<'a> {
    pub(super) fn new(offsetter: &'a PairwiseOffsetter<'a>, low: f64, high: f64) -> Self {
        Self { offsetter, walls: offsetter.boundary(), low, high }
    }

    /// The fibre through a point of the offset at the lower clearance that belongs to a site. It is found sooner with the
    /// one before it on the offset.
    pub(super) fn through(&self, at: Point, site: SiteId, before: Option<&Fibre>) -> Fibre {
        let normal = match self.offsetter.shape(site) {
            SiteShape::Line(l) => l.direction().left(),
            SiteShape::Point(p) => (at - p).normalized(),
            SiteShape::Arc(a) => (a.center - at).normalized(),
        };
        let foot = at - normal * self.low;
        let guess = before.map_or(self.high, |f| (GUESS * f.clearance).min(self.high));
        let (mut clearance, mut other) = self.disk(foot, normal, guess);
        if other.is_none() && guess < self.high {
            (clearance, other) = self.disk(foot, normal, self.high);
        }
        let end = foot + normal * clearance;
        let own = self.walls.index().nearest(foot).map(|n| n.0);
        Fibre { site, foot, normal, end, clearance, first: other.is_none() || own <= other }
    }

    /// The radius of the largest disk, none larger than `most`, that touches the wall at the foot and has nothing in it, from
    /// above; and the other wall that it touches.
    fn disk(&self, foot: Point, normal: Vec2, most: f64) -> (f64, Option<usize>) {
        self.walls.largest_disk(foot, normal, [self.low, most], self.slack())
    }

    fn slack(&self) -> f64 {
        0.01 * pocketry_geom::offset::degenerate_slack(self.low)
    }
}
