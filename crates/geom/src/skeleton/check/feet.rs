//! Feet of an edge's ends on the sites beside it.

use super::{Judge, Skeleton};
use crate::point::Point;
use crate::skeleton::{EdgeId, SiteId};
use crate::tolerance;

/// Which end of a half-edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    Origin,
    Target,
}

impl End {
    const fn other(self) -> Self {
        match self {
            Self::Origin => Self::Target,
            Self::Target => Self::Origin,
        }
    }
}

impl Judge<'_> {
    /// The parameter, on the site to the right of `e`, of the foot of one of its ends.
    ///
    /// At a boundary vertex it is the site's own end. Where the vertex is (almost) the site's centre of curvature its
    /// foot is that of the site on the other side, or else that of the edge's other end: the edge is radial there.
    pub(super) fn foot(&self, e: EdgeId, end: End) -> f64 {
        let s = self.skeleton;
        let site = s.site(e);
        let element = &self.elements[site as usize];
        if let Some(foot) = self.fixed_or_plain_foot(e, end) {
            return foot;
        }
        let x = self.end_point(e, end);
        let other = s.site(Skeleton::twin(e));
        if !self.is_floating(other, x) {
            let across = &self.elements[other as usize];
            let normal = across.at(across.foot(x)).normal;
            return element.foot_towards(-normal, x).clamp(0.0, element.extent());
        }
        self.fixed_or_plain_foot(e, end.other()).unwrap_or(0.5 * element.extent())
    }

    fn fixed_or_plain_foot(&self, e: EdgeId, end: End) -> Option<f64> {
        let s = self.skeleton;
        let site = s.site(e);
        let element = &self.elements[site as usize];
        let first = s.sites()[site as usize].first;
        match end {
            End::Origin if e == first => Some(0.0),
            End::Target if s.next(e) == first => Some(element.extent()),
            _ => {
                let x = self.end_point(e, end);
                (!self.is_floating(site, x)).then(|| element.steady_foot(x))
            }
        }
    }

    pub(super) fn end_point(&self, e: EdgeId, end: End) -> Point {
        match end {
            End::Origin => self.origin_point(e),
            End::Target => self.target_point(e),
        }
    }

    fn is_floating(&self, site: SiteId, x: Point) -> bool {
        self.elements[site as usize].distance_to_center(x) <= tolerance::CHECK_FLOATING * self.size()
    }
}
