//! Cells: feet run forward around each, and their areas add up to the region's.
//!
//! A cell's area is computed from its own site: over a wall it is the integral of h − κh²/2 along the wall, h being
//! the distance from the foot to the edge above it and κ the curvature (positive towards the pocket); about a reflex
//! vertex it is the integral of h²/2 over the angle. Nothing telescopes from one cell to the next, so an edge that is
//! wrong, missing or counted twice shows.

use super::element::{Element, Foot};
use super::feet::End;
use super::report::{Element as Part, FaultKind};
use super::{Judge, Skeleton};
use crate::point::Point;
use crate::quadrature;
use crate::skeleton::{EdgeId, SiteId};
use crate::tolerance;

/// The feet of an edge run unevenly if that of its chord's middle is nearer to an end of their way by this share of it.
const UNEVEN: f64 = 0.4;

/// How often the way to either end of an uneven edge is halved: down to the rounding of coordinates.
const HALVINGS: i32 = 50;

impl Judge<'_> {
    pub(super) fn check_cells(&mut self) {
        let mut total = 0.0;
        for site in 0..self.skeleton.sites().len() as SiteId {
            total += self.check_cell(site);
        }
        let area = self.region.area();
        self.report.area_error = ((total - area) / area).abs();
        if self.report.area_error.is_nan() || self.report.area_error > self.options.area {
            let place = self.region.bbox().center();
            self.fault(FaultKind::Area, Part::Whole, place, self.report.area_error);
        }
    }

    /// Checks that feet run forward, and returns the cell's area.
    fn check_cell(&mut self, site: SiteId) -> f64 {
        let s = self.skeleton;
        let element = self.elements[site as usize];
        let mut area = 0.0;
        let mut at = 0.0;
        for e in s.cell(site) {
            let from = self.foot(e, End::Origin);
            let to = self.foot(e, End::Target);
            self.check_forward(e, End::Origin, at, from);
            self.check_forward(e, End::Target, from, to);
            // At the site's centre of curvature the foot sweeps while the vertex stands still.
            area += flat_area(&element, s.origin_clearance(e), from - at);
            area += self.area_below(e, from, to);
            at = to;
        }
        area
    }

    /// On the way to one end of `e` the foot moved from `before` to `after`.
    fn check_forward(&mut self, e: EdgeId, end: End, before: f64, after: f64) {
        let x = self.end_point(e, end);
        let element = &self.elements[self.skeleton.site(e) as usize];
        let other = if end == End::Target { self.origin_point(e) } else { x };
        let size = self.size();
        let slack = element.foot_slack(x, size).max(element.foot_slack(other, size));
        let back = (before - after) / slack;
        let r = self.skeleton.origin_clearance(e).max(self.skeleton.target_clearance(e));
        self.report.worst_backwards = self.report.worst_backwards.max(back);
        if back > self.options.foot && self.is_felt(back, r) {
            self.fault(FaultKind::FeetBackwards, Part::Edge(e), x, back);
        }
    }

    /// Area between the site right of `e` and this edge, whose feet run from `from` to `to`. The edge is the chord
    /// where that lies on the bisector (spokes at joints that are almost smooth among others), else the bisector.
    fn area_below(&self, e: EdgeId, from: f64, to: f64) -> f64 {
        if from == to {
            return 0.0;
        }
        let s = self.skeleton;
        let element = &self.elements[s.site(e) as usize];
        let across = &self.elements[s.site(Skeleton::twin(e)) as usize];
        let ends = [self.origin_point(e), self.target_point(e)];
        let straight = self.is_straight(e);
        let (u, v) = (s.origin_clearance(e), s.target_clearance(e));
        match element.curvature() {
            None if straight => return 0.5 * (ends[1] - element.ends()[0]).cross(ends[0] - element.ends()[0]),
            Some(0.0) if straight => return 0.5 * (u + v) * (to - from),
            _ => {}
        }
        let slack = self.options.clearance * self.size();
        let height = |p: f64| {
            let foot = element.at(p);
            let h = if straight { chord_height(&foot, ends) } else { across.tangent_radius(&foot) };
            // Clearance is monotone along the edge: outside these bounds it is rounding, or a fault reported elsewhere.
            if h.is_nan() { 0.5 * (u + v) } else { h.clamp(u.min(v) - slack, u.max(v) + slack) }
        };
        let travel = element.length_of(to - from, u.max(v));
        let allowed = tolerance::QUADRATURE * self.size() * travel;
        let stops = if travel <= self.options.tight * self.size() {
            vec![from, to]
        } else {
            self.stops(e, straight, [from, to])
        };
        let piece = |w: &[f64]| quadrature::integrate(w[0], w[1], allowed, |p| density(element, height(p)));
        stops.windows(2).map(piece).sum()
    }

    /// Where to cut the way of the feet below an edge, its ends included. An edge that ends almost in the site's centre
    /// of curvature sweeps nearly all of its feet there and leaves a spike for the rest, which a quadrature that starts
    /// from the whole would not see: such a way is cut at the feet of points of the edge, ever nearer to its ends.
    fn stops(&self, e: EdgeId, straight: bool, [from, to]: [f64; 2]) -> Vec<f64> {
        let element = &self.elements[self.skeleton.site(e) as usize];
        let share = |t: f64| {
            let x = if straight { self.chord_sample(e, t).x } else { self.pencil_sample(Skeleton::twin(e), 1.0 - t).x };
            ((element.foot(x) - from) / (to - from)).clamp(0.0, 1.0)
        };
        let mut shares = vec![0.0];
        if (share(0.5) - 0.5).abs() > UNEVEN {
            let near_start = (1..=HALVINGS).rev().map(|k| 0.5_f64.powi(k));
            let near_end = (2..=HALVINGS).map(|k| 1.0 - 0.5_f64.powi(k));
            for s in near_start.chain(near_end).map(share) {
                if s > shares[shares.len() - 1] {
                    shares.push(s);
                }
            }
        }
        shares.push(1.0);
        shares.into_iter().map(|s| from + (to - from) * s).collect()
    }
}

/// How far along its normal from a foot the chord between two points lies.
fn chord_height(foot: &Foot, [u, v]: [Point; 2]) -> f64 {
    let along = v - u;
    ((u - foot.anchor) - foot.offset).cross(along) / foot.normal.cross(along)
}

/// Area for each unit of the parameter below height h.
fn density(element: &Element, h: f64) -> f64 {
    element.curvature().map_or(0.5 * h * h, |k| h - 0.5 * k * h * h)
}

fn flat_area(element: &Element, h: f64, width: f64) -> f64 {
    density(element, h) * width
}
