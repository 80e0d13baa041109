//! The construction from end to end: frame, sites, cycle, recursion, assembly.

use super::assemble::{Component, assemble};
use super::cycle::{Cycle, Junction, Rings};
use super::element::Element;
use super::joints::{Joint, classify};
use super::recursion::{self, Draft};
use super::topology::{NONE, Site, SiteShape, Skeleton, Vertex};
use crate::point::{Point, Vec2};
use crate::region::{Pocket, Region};
use crate::segment::{Arc, Line, Segment};

/// Constructions tried where vertices stay doubtful.
const ATTEMPTS: usize = 8;

/// Why a skeleton can't be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SkeletonError {
    /// The region has no contours, or a contour has fewer than two segments.
    #[error("contour {contour} has fewer than two edges")]
    Degenerate {
        /// Index of the contour.
        contour: usize,
    },
}

/// The frame that the construction computes in: size between 0.5 and 1, the pocket's middle at the origin; scaling is
/// by a power of two and exact.
#[derive(Clone, Copy, Debug)]
struct Frame {
    origin: Point,
    scale: f64,
}

impl Frame {
    fn of(region: &Region, pocket: &Pocket) -> Self {
        let bounds = region.contours()[pocket.outer as usize].bbox();
        let scale = (-bounds.size().log2().ceil()).exp2();
        Self { origin: bounds.center(), scale }
    }

    fn enter(self, p: Point) -> Point {
        ((p - self.origin) * self.scale).to_point()
    }

    fn leave(self, p: Point) -> Point {
        self.origin + p.to_vec() / self.scale
    }
}

impl Skeleton {
    /// The skeleton of a region, in O(n log n) for n boundary segments (observed).
    ///
    /// # Errors
    /// [`SkeletonError`] where a contour isn't one.
    pub fn build(region: &Region) -> Result<Self, SkeletonError> {
        if let Some(contour) = region.contours().iter().position(|c| c.segments.len() < 2) {
            return Err(SkeletonError::Degenerate { contour });
        }
        let mut skeleton = Self::default();
        for pocket in region.pockets() {
            skeleton.add_pocket(region, &pocket);
        }
        Ok(skeleton)
    }

    fn add_pocket(&mut self, region: &Region, pocket: &Pocket) {
        let frame = Frame::of(region, pocket);
        let contours = std::iter::once(pocket.outer).chain(pocket.islands.iter().copied());
        let edges = contours.clone().map(|c| region.contours()[c as usize].segments.len()).sum();
        let mut boundary = Boundary::new(frame, edges);
        for c in contours {
            boundary.add_ring(c, &region.contours()[c as usize].segments);
        }
        let corners: Vec<Point> = boundary.corners.iter().map(|&p| frame.enter(p)).collect();
        let (cycle, draft) = least_doubtful(&boundary.rings, &corners);
        let component = assemble(&cycle, draft, &boundary.rings.elements, &boundary.convex);
        self.append(&component, boundary);
    }

    /// Add a component, back in the drawing's frame; boundary vertices keep their exact places.
    fn append(&mut self, component: &Component, boundary: Boundary) {
        let (vertex_base, edge_base) = (self.vertices.len() as u32, self.half_edges.len() as u32);
        let site_base = self.sites.len() as u32;
        let frame = boundary.frame;
        self.vertices.extend(component.vertices.iter().enumerate().map(|(k, v)| match boundary.corners.get(k) {
            Some(&point) if v.clearance == 0.0 => Vertex { point, clearance: 0.0 },
            _ => Vertex { point: frame.leave(v.point), clearance: v.clearance / frame.scale },
        }));
        let shifted = |e: u32| if e == NONE { NONE } else { e + edge_base };
        self.half_edges.extend(component.half_edges.iter().map(|h| super::HalfEdge {
            origin: h.origin + vertex_base,
            next: shifted(h.next),
            site: h.site + site_base,
        }));
        let firsts = component.first.iter();
        self.sites.extend(boundary.sites.into_iter().zip(firsts).map(|(s, &e)| Site { first: shifted(e), ..s }));
    }
}

/// The first draft without doubts, of cycles that begin elsewhere and have other bridges; else the one with the fewest.
fn least_doubtful(rings: &Rings, corners: &[Point]) -> (Cycle, Draft) {
    let attempt = |number: usize| {
        let cycle = Cycle::new(rings, number);
        let draft = recursion::run(&cycle, corners);
        (cycle, draft)
    };
    let mut best = attempt(0);
    for number in 1..ATTEMPTS {
        if best.1.doubts == 0 {
            break;
        }
        let other = attempt(number);
        if other.1.doubts < best.1.doubts {
            best = other;
        }
    }
    best
}

/// Sites and boundary vertices of one pocket, collected contour by contour.
struct Boundary {
    frame: Frame,
    rings: Rings,
    sites: Vec<Site>,
    /// Boundary vertices in the drawing's frame.
    corners: Vec<Point>,
    convex: Vec<bool>,
}

impl Boundary {
    fn new(frame: Frame, edges: usize) -> Self {
        // reflex vertices are sites too; about half of all corners in what people draw
        let sites = edges + edges / 2;
        let rings =
            Rings { elements: Vec::with_capacity(sites), junctions: Vec::with_capacity(sites), starts: vec![0] };
        Self {
            frame,
            rings,
            sites: Vec::with_capacity(sites),
            corners: Vec::with_capacity(edges),
            convex: Vec::with_capacity(edges),
        }
    }

    /// The elements of one contour; segment by segment, each followed by the reflex vertex at its end, if it is one.
    fn add_ring(&mut self, contour: u32, segments: &[Segment]) {
        let first_corner = self.corners.len() as u32;
        let closing = classify(&segments[segments.len() - 1], &segments[0]);
        let mut joint = closing;
        self.corner(segments[0].start(), joint);
        let mut corner = first_corner;
        for (k, segment) in segments.iter().enumerate() {
            let junction = match joint {
                Joint::Convex => Junction::Convex(corner),
                Joint::Smooth(n) | Joint::Reflex(_, n) => Junction::Spoke(corner, n),
            };
            let element = self.element(segment);
            self.site(shape_of(segment), contour, k as u32);
            self.push(element, junction);
            let next = (k + 1) % segments.len();
            joint = if next == 0 { closing } else { classify(segment, &segments[next]) };
            corner = if next == 0 { first_corner } else { self.corner(segments[next].start(), joint) };
            if let Joint::Reflex(n0, n1) = joint {
                self.push(self.reflex(segment.end(), n0, n1), Junction::Spoke(corner, n0));
                self.site(SiteShape::Point(segment.end()), contour, next as u32);
            }
        }
        self.rings.starts.push(self.rings.elements.len() as u32);
    }

    fn push(&mut self, element: Element, junction: Junction) {
        self.rings.elements.push(element);
        self.rings.junctions.push(junction);
    }

    fn corner(&mut self, p: Point, joint: Joint) -> u32 {
        self.corners.push(p);
        self.convex.push(joint == Joint::Convex);
        self.corners.len() as u32 - 1
    }

    fn site(&mut self, shape: SiteShape, contour: u32, segment: u32) {
        self.sites.push(Site { shape, contour, segment, first: NONE });
    }

    fn element(&self, segment: &Segment) -> Element {
        let site = self.sites.len() as u32;
        let (start, end) = (self.frame.enter(segment.start()), self.frame.enter(segment.end()));
        match segment {
            Segment::Line(_) => Element::line(start, end, site),
            Segment::Arc(a) => {
                Element::arc(start, end, self.frame.enter(a.center), a.radius * self.frame.scale, a.ccw, site)
            }
        }
    }

    fn reflex(&self, p: Point, n0: Vec2, n1: Vec2) -> Element {
        Element::point(self.frame.enter(p), n0, n1, self.sites.len() as u32)
    }
}

fn shape_of(segment: &Segment) -> SiteShape {
    match *segment {
        Segment::Line(Line { start, end }) => SiteShape::Line(Line { start, end }),
        Segment::Arc(a) => SiteShape::Arc(Arc { ..a }),
    }
}
