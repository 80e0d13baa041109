//! Does the profile enter a wall?

use super::pose::Part;
use super::shape::Shape;
use crate::options::Budget;
use crate::report::Gouge;
use crate::tree::Tree;
use crate::walls::Walls;
use pocketry_geom::{Point, Segment};
use rayon::prelude::*;

/// Bounds of the depth are tried from this part of the tolerance on, each twice the one before.
const FIRST_SHARE: f64 = 0.125;

/// Points of a piece at which a gouge is measured.
const SAMPLES: u32 = 32;

/// What is said about the walls.
pub(crate) struct Judged {
    /// The bound of the depth that could be shown, or a gouge.
    pub(crate) gouge: Option<Gouge>,
    /// Length of curves with the tool outside the region, and the first line.
    pub(crate) outside: Option<(f64, u32)>,
}

/// Bounds how deep walls come into the profile along the pieces of path below the stock's top.
pub(crate) fn judge(walls: &Walls, below: &[Part], shape: &Shape, budget: &Budget) -> Judged {
    let islands = one_point_each(walls);
    let mut suspects: Vec<usize> = (0..below.len()).collect();
    let mut bound = FIRST_SHARE * budget.gouge;
    let mut last = None;
    loop {
        let sweeper =
            Sweeper { walls, islands: &islands, shape, smaller: Smaller::new(shape, bound), rounding: budget.rounding };
        suspects = suspects.into_par_iter().filter(|&k| sweeper.is_entered(&below[k])).collect();
        let Some(&first) = suspects.first() else { break };
        last = Some((first, bound));
        if bound >= budget.gouge {
            break;
        }
        bound = (2.0 * bound).min(budget.gouge);
    }
    let outside = suspects.is_empty().then_some(()).and_then(|()| leaves(walls, below, shape));
    // Even where no wall comes near, no more is shown than that.
    let gouge = last.or((!below.is_empty()).then_some((0, bound))).map(|(first, _)| {
        let (at, depth) = measured(walls, shape, &below[first]);
        let line = below[first].line;
        // What is not shown to stay within the tolerance counts as beyond it.
        if suspects.is_empty() {
            Gouge { depth: bound, at, line }
        } else {
            Gouge { depth: depth.max(2.0 * bound), at, line }
        }
    });
    Judged { gouge, outside }
}

/// The smaller profile whose sweep no wall may enter.
struct Smaller {
    segments: Vec<Segment>,
    shape: Shape,
}

impl Smaller {
    fn new(shape: &Shape, depth: f64) -> Self {
        let segments = shape.shrunk(depth);
        let shape = Shape::new(&pocketry_geom::Contour::new(segments.clone()));
        Self { segments, shape }
    }
}

struct Sweeper<'a> {
    walls: &'a Walls,
    islands: &'a Tree,
    shape: &'a Shape,
    smaller: Smaller,
    rounding: f64,
}

impl Sweeper<'_> {
    /// Whether a wall may come into the sweep of the smaller profile along a piece: it crosses the sweep's outline, or lies
    /// within it as a whole.
    fn is_entered(&self, part: &Part) -> bool {
        let margin = part.slack + self.rounding;
        if self.walls.tree.nearest_to_curve(&part.curve, self.shape.reach + margin).is_none() {
            return false;
        }
        let mut outline = Vec::new();
        for edge in &self.smaller.segments {
            outline.clear();
            part.outline(edge, &mut outline);
            if outline.iter().any(|c| self.walls.tree.nearest_to_curve(c, margin).is_some()) {
                return true;
            }
        }
        let mut within = false;
        self.islands.near(&part.curve, self.shape.reach, |island| {
            within = within || self.smaller.shape.depth_along(&part.seen(island.start())) >= 0.0;
            !within
        });
        within
    }
}

/// A point of every contour of the walls.
fn one_point_each(walls: &Walls) -> Tree {
    let mut points = Vec::new();
    for (k, &next) in walls.next.iter().enumerate() {
        if next as usize <= k {
            let p = walls.segments[k].end();
            points.push(Segment::line(p, p));
        }
    }
    Tree::new(&points)
}

/// No sweep touches a wall: so the tool is inside with one point as with all.
fn leaves(walls: &Walls, below: &[Part], shape: &Shape) -> Option<(f64, u32)> {
    let point = |part: &Part| part.curve.start() + shape.deepest.to_vec().rotated(part.angle);
    let out: Vec<&Part> = below.iter().filter(|part| !walls.contain(point(part))).collect();
    out.first().map(|first| (out.iter().map(|part| part.curve.length()).sum(), first.line))
}

/// The deepest entry at some places of a piece.
fn measured(walls: &Walls, shape: &Shape, part: &Part) -> (Point, f64) {
    let depth = |k: u32| {
        let share = f64::from(k) / f64::from(SAMPLES);
        let (p, angle) = (part.curve.at(share), part.angle_at(share));
        let mut deepest = 0.0_f64;
        walls.tree.near(&Segment::line(p, p), shape.reach, |wall| {
            deepest = deepest.max(shape.depth_along(&wall.translated(-p.to_vec()).rotated(-angle)));
            true
        });
        (p, deepest)
    };
    (0..=SAMPLES).map(depth).fold((part.curve.start(), 0.0), |a, b| if b.1 > a.1 { b } else { a })
}
