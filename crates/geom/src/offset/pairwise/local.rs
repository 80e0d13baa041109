//! Step 1: local interfering ranges go, from the convex vertices outwards.
//!
//! Elements make a ring. At an open joint the offsets of the elements before and after it are tested as a pair:
//!
//! - they meet, turning left: both are trimmed there, the joint is closed;
//! - the offset of one, as far as it is still there, lies within reach of the other: it is taken out, and its neighbour
//!   takes its place. (What lies within reach of a wall is nowhere on the offset: this is always right.)
//! - neither: the joint stays open and is bridged by a chord, which lies below other curves.
//!
//! Every test closes a joint or takes an element out: O(n).

use super::element::{Element, Joint};
use super::raw::{BRIDGE, RawCurves};
use crate::point::{Point, Vec2};
use crate::segment::Segment;
use crate::tolerance::COORDINATE_ROUNDOFF;
use crate::tolerance::pairwise::{SMOOTH_TURN, WITHIN};

/// A range that was removed from a raw curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct LocalRange {
    /// The piece at whose end is the vertex that it collapsed to.
    pub(super) piece: u32,
    /// The elements before and after it.
    pub(super) elements: [u32; 2],
}

/// Adds the raw curve of a contour at distance `d`, unless it vanishes.
pub(super) fn add_raw_curve(elements: &[Element], d: f64, curves: &mut RawCurves, removed: &mut Vec<LocalRange>) {
    let mut ring = Ring::new(elements, d);
    for k in 0..elements.len() {
        if ring.alive[k] && !ring.closed[k] && ring.close(k).is_none() {
            return;
        }
    }
    ring.add_to(curves, removed);
}

struct Ring<'a> {
    elements: &'a [Element],
    d: f64,
    before: Vec<u32>,
    after: Vec<u32>,
    alive: Vec<bool>,
    /// Whether the joint after an element needs no test (any more).
    closed: Vec<bool>,
    /// Whether that joint is a vertex to which a range collapsed.
    met: Vec<bool>,
    /// Where the offset of each element starts and ends by now.
    starts: Vec<Point>,
    ends: Vec<Point>,
    left: usize,
    /// How far rounding may put a point beyond the end of a piece.
    slack: f64,
}

impl<'a> Ring<'a> {
    fn new(elements: &'a [Element], d: f64) -> Self {
        let n = elements.len() as u32;
        let largest = elements.iter().map(|e| e.start.x.abs().max(e.start.y.abs())).fold(0.0, f64::max);
        let mut ring = Self {
            elements,
            d,
            before: (0..n).map(|k| (k + n - 1) % n).collect(),
            after: (0..n).map(|k| (k + 1) % n).collect(),
            alive: vec![true; elements.len()],
            closed: elements.iter().map(|e| e.joint != Joint::Convex).collect(),
            met: vec![false; elements.len()],
            starts: elements.iter().map(|e| e.offset_start(d)).collect(),
            ends: elements.iter().map(|e| e.offset_end(d)).collect(),
            left: elements.len(),
            slack: COORDINATE_ROUNDOFF * (d + largest),
        };
        ring.smooth();
        ring
    }

    /// At smooth joints the two normals are one.
    fn smooth(&mut self) {
        for k in (0..self.elements.len()).filter(|&k| self.elements[k].joint == Joint::Smooth) {
            let n = self.after[k] as usize;
            if let Some(x) = corner(&self.elements[k], &self.elements[n], self.d) {
                (self.ends[k], self.starts[n]) = (x, x);
            }
        }
    }

    /// Closes the joint after an element, or that of whatever takes its place. `None` if nothing is left.
    fn close(&mut self, mut p: usize) -> Option<()> {
        loop {
            let n = self.after[p] as usize;
            if p == n || self.left < 2 {
                return None;
            }
            if let Some(x) = self.meet(p, n) {
                (self.ends[p], self.starts[n]) = (x, x);
                (self.closed[p], self.met[p]) = (true, true);
                return Some(());
            }
            let (first, second) = (self.is_within(p, n), self.is_within(n, p));
            if first {
                let next = self.before[p] as usize;
                self.remove(p);
                p = next;
            }
            if second && self.alive[n] {
                if p == n {
                    return None;
                }
                self.remove(n);
            }
            if !first && !second {
                (self.closed[p], self.met[p]) = (true, false);
                return Some(());
            }
        }
    }

    fn remove(&mut self, k: usize) {
        let (b, a) = (self.before[k] as usize, self.after[k] as usize);
        (self.after[b], self.before[a]) = (a as u32, b as u32);
        self.alive[k] = false;
        self.left -= 1;
        // The neighbours have their full extent again on this side.
        self.ends[b] = self.elements[b].offset_end(self.d);
        self.starts[a] = self.elements[a].offset_start(self.d);
        (self.closed[b], self.met[b]) = (false, false);
    }

    /// Whether what is left of the offset of `k` lies within reach of element `other`.
    fn is_within(&self, k: usize, other: usize) -> bool {
        let (e, o) = (&self.elements[k], &self.elements[other]);
        let within = |p: Point| o.distance(p) < self.d * (1.0 - WITHIN);
        let far = if self.before[other] as usize == k { self.starts[k] } else { self.ends[k] };
        let middle = || e.piece(self.d, self.starts[k], self.ends[k]).at(0.5);
        within(far) && (!e.is_vertex() || within(middle()))
    }

    /// Where the offsets of `p` and the element after it cross, turning left.
    fn meet(&self, p: usize, n: usize) -> Option<Point> {
        let (e, f) = (&self.elements[p], &self.elements[n]);
        let adjacent = (p + 1) % self.elements.len() == n;
        let x = if adjacent && e.joint != Joint::Reflex { corner(e, f, self.d)? } else { crossing(e, f, self.d)? };
        let on_first = extends(e, self.starts[p], self.ends[p], x, self.slack);
        (on_first && extends(f, self.starts[n], self.ends[n], x, self.slack)).then_some(x)
    }

    fn add_to(&self, curves: &mut RawCurves, removed: &mut Vec<LocalRange>) {
        let Some(first) = self.alive.iter().position(|&a| a) else { return };
        let (begun, kept) = (curves.segments.len() as u32, removed.len());
        let mut k = first;
        loop {
            let (e, n) = (&self.elements[k], self.after[k] as usize);
            let (start, end, next) = (self.starts[k], self.ends[k], self.starts[n]);
            if start != end {
                curves.push(e.piece(self.d, start, end), e.number);
            }
            if end != next {
                curves.push(Segment::line(end, next), BRIDGE);
            }
            if self.met[k] {
                // Before the first piece of a closed curve comes its last.
                let piece = (curves.segments.len() as u32).checked_sub(1).filter(|&p| p >= begun);
                let elements = [e.number, self.elements[n].number];
                removed.push(LocalRange { piece: piece.unwrap_or(u32::MAX), elements });
            }
            k = n;
            if k == first {
                break;
            }
        }
        if curves.close() {
            let last = curves.segments.len() as u32 - 1;
            removed[kept..].iter_mut().for_each(|r| r.piece = r.piece.min(last));
        } else {
            removed.truncate(kept);
        }
    }
}

/// Where the offsets of two segments that share a convex vertex cross.
fn corner(e: &Element, f: &Element, d: f64) -> Option<Point> {
    let share = 1.0 + e.n1.dot(f.n0);
    (share > SMOOTH_TURN).then(|| e.end + (e.n1 + f.n0) * (d / share))
}

/// Where the offset of `e` crosses that of `f` such that going on along `f` turns left.
fn crossing(e: &Element, f: &Element, d: f64) -> Option<Point> {
    match (e.is_vertex(), f.is_vertex()) {
        (false, false) => {
            let (u, v) = (e.along(), f.along());
            let turn = u.cross(v);
            let (a, b) = (e.offset_start(d), f.offset_start(d));
            (turn > SMOOTH_TURN).then(|| a + u * ((b - a).cross(v) / turn))
        }
        (false, true) => line_and_circle(e.offset_start(d), e.along(), f.start, d).map(|p| p.0),
        (true, false) => line_and_circle(f.offset_start(d), f.along(), e.start, d).map(|p| p.1),
        (true, true) => {
            let apart = f.start - e.start;
            let half = 0.5 * apart.length();
            (half > 0.0 && half < d).then(|| {
                let aside = ((d - half) * (d + half)).sqrt();
                e.start.midpoint(f.start) + apart.left() * (aside / (2.0 * half))
            })
        }
    }
}

/// Where a line enters and leaves a circle.
fn line_and_circle(on: Point, along: Vec2, center: Point, radius: f64) -> Option<(Point, Point)> {
    let foot = on + along * (center - on).dot(along);
    let height = (center - on).cross(along).abs();
    (height < radius).then(|| {
        let half = ((radius - height) * (radius + height)).sqrt();
        (foot + along * -half, foot + along * half)
    })
}

/// Whether a point of an element's line or circle lies between two points of its offset.
fn extends(e: &Element, start: Point, end: Point, x: Point, slack: f64) -> bool {
    if e.is_vertex() {
        let [a, b, o] = [start, end, x].map(|p| p - e.start);
        let off = slack * o.length();
        a.cross(o) <= off && o.cross(b) <= off
    } else {
        let u = e.along();
        (x - start).dot(u) >= -slack && (end - x).dot(u) >= -slack
    }
}
