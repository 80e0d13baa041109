//! The order of loops: the paper's recursion with a stack in its place.

use super::tree::{Forest, Part};
use crate::plan::LinkKind;
use pocketry_geom::{Contour, Point, Segment};

/// Loops that are cut one after the other without a lift.
#[derive(Clone, Debug, Default)]
pub(super) struct Chain {
    /// In the order of cutting.
    pub(super) cuts: Vec<Cut>,
    /// The part of the first erosion that holds them, numbered from 0.
    pub(super) pocket: usize,
}

/// A loop and the way to it.
#[derive(Clone, Debug)]
pub(super) struct Cut {
    /// The way from where the loop before it ends, with what it is; none for the first one of a chain.
    pub(super) link: Option<(Segment, LinkKind)>,
    /// The loop, from where the tool comes to it.
    pub(super) segments: Vec<Segment>,
    pub(super) level: usize,
}

impl Cut {
    /// Where the loop starts and ends.
    pub(super) fn start(&self) -> Point {
        self.segments[0].start()
    }
}

/// All loops of the forest, innermost first.
///
/// The stack holds the parts from a root down to where the walk is, each with the number of its parts that are done: what the
/// recursion would remember. A part that has none left is unstacked and its loops are cut.
pub(super) fn chains(forest: &Forest) -> Vec<Chain> {
    let mut chains = Vec::new();
    for (pocket, &root) in forest.roots.iter().enumerate() {
        let mut stack = vec![(root, 0)];
        while let Some((part, done)) = stack.last_mut() {
            let part = &forest.parts[*part as usize];
            if let Some(&child) = part.children.get(*done) {
                *done += 1;
                stack.push((child, 0));
                continue;
            }
            stack.pop();
            if part.children.is_empty() {
                chains.push(Chain { cuts: Vec::new(), pocket });
            }
            cut(forest, part, pocket, &mut chains);
        }
    }
    chains
}

/// Cuts a part's loops, always the nearest one next.
fn cut(forest: &Forest, part: &Part, pocket: usize, chains: &mut Vec<Chain>) {
    let mut left: Vec<&Contour> = part.contours.iter().collect();
    // From the part inside, the way to the nearest point of the outline crosses nothing.
    let mut kind = LinkKind::SideStep;
    while !left.is_empty() {
        let at = chains.last().and_then(|c| c.cuts.last()).map(Cut::start);
        let Some(at) = at else {
            push(chains, Cut { link: None, segments: left.remove(0).segments.clone(), level: part.level });
            kind = LinkKind::Medial;
            continue;
        };
        let (k, nearest) = nearest(&left, at);
        let segments = from(left.remove(k), nearest);
        let way = Segment::line(at, segments[0].start());
        let free = kind == LinkKind::SideStep || is_free(forest, &way);
        let link = (at != segments[0].start()).then_some((way, kind));
        if free {
            push(chains, Cut { link, segments, level: part.level });
        } else {
            chains.push(Chain { cuts: vec![Cut { link: None, segments, level: part.level }], pocket });
        }
        kind = LinkKind::Medial;
    }
}

fn push(chains: &mut [Chain], cut: Cut) {
    if let Some(chain) = chains.last_mut() {
        chain.cuts.push(cut);
    }
}

/// Whether a way from a loop to another one keeps within the first erosion: it starts inside, and crosses its outline nowhere. Ways
/// along the outline itself don't count as free.
fn is_free(forest: &Forest, way: &Segment) -> bool {
    let middle = way.at(0.5);
    if !forest.limit.contains(middle) {
        return false;
    }
    let (near, far) = (way.at(WAY_ENDS), way.at(1.0 - WAY_ENDS));
    forest.limit.distance_to(&Segment::line(near, far)) > 0.0
}

/// Shares of a way next to its ends that lie on loops, where it cannot cross them: the way to a nearest point leaves the loop there.
const WAY_ENDS: f64 = 1.0 / 4096.0;

/// The contour nearest to a point, and its segment there.
fn nearest(contours: &[&Contour], at: Point) -> (usize, (usize, Point)) {
    let mut best = (f64::INFINITY, 0, (0, at));
    for (k, contour) in contours.iter().enumerate() {
        for (s, segment) in contour.segments.iter().enumerate() {
            let p = segment.nearest(at);
            let apart = p.distance_squared(at);
            if apart < best.0 {
                best = (apart, k, (s, p));
            }
        }
    }
    (best.1, best.2)
}

/// A contour travelled from a point of one of its segments; from that segment's end where the point lies by it.
fn from(contour: &Contour, (k, p): (usize, Point)) -> Vec<Segment> {
    let mut segments = contour.segments.clone();
    let own = segments[k];
    let snap = SNAP * own.length();
    if p.distance(own.start()) <= snap {
        segments.rotate_left(k);
    } else if p.distance(own.end()) <= snap {
        let next = (k + 1) % segments.len();
        segments.rotate_left(next);
    } else {
        let (before, after) = own.split_at(p);
        segments.rotate_left(k);
        segments[0] = after;
        segments.push(before);
    }
    segments
}

/// A landing within this share of a segment's length of its end is moved there: a shorter piece of an arc would be a risk to the
/// post, and the way there still is one to the loop, if not quite to its nearest point.
const SNAP: f64 = 1.0 / 1024.0;
