//! Steps 3 and 4: the shortest path in each tree that leaves nothing, and its tour.

use super::forest::{Forest, NONE};
use pocketry_geom::{Line, Point, Segment, Vec2};

/// What a stop must serve: the disk about `at` that the tool, from where it stops, has to cover.
#[derive(Clone, Copy, Debug)]
struct Duty {
    at: Point,
    /// The tool's radius less the reach: how far the stop may be.
    within: f64,
}

impl Duty {
    fn served_from(&self, stop: Point) -> bool {
        stop.distance(self.at) <= self.within
    }
}

/// A closed path from a root, straight to its farthest tip and back by all others.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Tour {
    /// From the root to the tip; empty where nothing is uncut.
    pub(super) out: Vec<Segment>,
    /// From there to the root.
    pub(super) back: Vec<Segment>,
}

/// The tour of each root.
pub(super) fn tours(forest: &Forest, radius: f64) -> Vec<Tour> {
    let kept = kept(forest, radius);
    let mut depths = vec![0.0_f64; forest.nodes.len()];
    let mut children: Vec<Vec<u32>> = vec![Vec::new(); forest.nodes.len()];
    for &n in forest.order.iter().rev() {
        let parent = forest.nodes[n as usize].parent;
        if let (true, Some(way)) = (parent != NONE, &kept[n as usize]) {
            children[parent as usize].push(n);
            depths[parent as usize] = depths[parent as usize].max(depths[n as usize] + way.length());
        }
    }
    let depth = |n: u32| depths[n as usize] + kept[n as usize].map_or(0.0, |s| s.length());
    for c in &mut children {
        c.sort_by(|&a, &b| depth(b).total_cmp(&depth(a)));
    }
    forest.roots.iter().map(|&root| tour(root, &children, &kept)).collect()
}

/// For each node the part of the way from its parent that the tool has to travel. A duty is handed on towards the root as long
/// as it is served there, and past what does not serve it to a node that does: it asks for a visit there, but not here.
fn kept(forest: &Forest, radius: f64) -> Vec<Option<Segment>> {
    let mut kept: Vec<Option<Segment>> = vec![None; forest.nodes.len()];
    let mut travelled = vec![false; forest.nodes.len()];
    let mut duties: Vec<Vec<Duty>> = vec![Vec::new(); forest.nodes.len()];
    for &n in forest.order.iter().rev() {
        let node = &forest.nodes[n as usize];
        let mut own = std::mem::take(&mut duties[n as usize]);
        let (Some(way), true) = (node.way, node.parent != NONE) else { continue };
        if node.place.reach >= 0.0 {
            own.push(Duty { at: node.place.at, within: (radius - node.place.reach).max(0.0) });
        }
        let parent = node.parent as usize;
        if !travelled[n as usize] {
            own.retain(|d| match server(forest, node.parent, d) {
                Some(ancestor) if ancestor != node.parent => {
                    duties[ancestor as usize].push(*d);
                    false
                }
                _ => true,
            });
        }
        let stop = if travelled[n as usize] { None } else { last_stop(&way, &own) };
        match stop {
            Some(Stop::Start) => duties[parent].append(&mut own),
            Some(Stop::Inside(p)) => {
                kept[n as usize] = Some(way.split_at(p).0);
                travelled[parent] = true;
            }
            None => {
                kept[n as usize] = Some(way);
                travelled[parent] = true;
            }
        }
        if travelled[parent] {
            duties[parent].clear();
        }
    }
    kept
}

/// The first of a node and those on its way to the root from which a duty is served.
fn server(forest: &Forest, from: u32, duty: &Duty) -> Option<u32> {
    let mut at = from;
    while at != NONE {
        let node = &forest.nodes[at as usize];
        if duty.served_from(node.place.at) {
            return Some(at);
        }
        at = node.parent;
    }
    None
}

/// Where on a way from the root the tool may stop.
enum Stop {
    /// It need not enter it.
    Start,
    /// Here.
    Inside(Point),
}

/// The stop nearest to the start of a way that still serves all duties, which are served from its end; `None` for the end.
fn last_stop(way: &Segment, duties: &[Duty]) -> Option<Stop> {
    if duties.iter().all(|d| d.served_from(way.start())) {
        return Some(Stop::Start);
    }
    let Segment::Line(line) = way else { return None };
    let length = line.start.distance(line.end);
    let back = duties.iter().map(|d| room(line, length, *d)).fold(length, f64::min);
    (back > 0.0).then(|| Stop::Inside(line.end.lerp(line.start, back / length))).filter(|_| back < length)
}

/// How far back from the end of a line a duty is served.
fn room(line: &Line, length: f64, duty: Duty) -> f64 {
    let back: Vec2 = (line.start - line.end) / length;
    let to = duty.at - line.end;
    let (along, aside) = (to.dot(back), to.cross(back));
    let half = ((duty.within - aside) * (duty.within + aside)).max(0.0).sqrt();
    (along + half).clamp(0.0, length)
}

/// Depth first through what is kept, there and back.
fn tour(root: u32, children: &[Vec<u32>], kept: &[Option<Segment>]) -> Tour {
    let mut tour = Tour::default();
    let mut stack: Vec<(u32, usize)> = vec![(root, 0)];
    while let Some((node, next)) = stack.last_mut() {
        if let Some(&child) = children[*node as usize].get(*next) {
            *next += 1;
            let path = if tour.back.is_empty() { &mut tour.out } else { &mut tour.back };
            path.extend(kept[child as usize]);
            stack.push((child, 0));
        } else {
            tour.back.extend(kept[*node as usize].map(|s| s.reversed()).filter(|_| stack.len() > 1));
            stack.pop();
        }
    }
    tour
}
