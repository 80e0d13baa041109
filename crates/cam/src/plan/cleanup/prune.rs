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

/// The tours: for each root a closed path from it; empty where nothing is uncut.
pub(super) fn tours(forest: &Forest, radius: f64) -> Vec<Vec<Segment>> {
    let kept = kept(forest, radius);
    let mut children: Vec<Vec<u32>> = vec![Vec::new(); forest.nodes.len()];
    for &n in forest.order.iter().rev() {
        let parent = forest.nodes[n as usize].parent;
        if parent != NONE && kept[n as usize].is_some() {
            children[parent as usize].push(n);
        }
    }
    forest.roots.iter().map(|&root| tour(root, &children, &kept)).collect()
}

/// For each node the part of the way from its parent that the tool has to travel.
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
        let stop = if travelled[n as usize] { None } else { last_stop(&way, &own) };
        let parent = node.parent as usize;
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
fn tour(root: u32, children: &[Vec<u32>], kept: &[Option<Segment>]) -> Vec<Segment> {
    let mut tour = Vec::new();
    let mut stack: Vec<(u32, usize)> = vec![(root, 0)];
    while let Some((node, next)) = stack.last_mut() {
        if let Some(&child) = children[*node as usize].get(*next) {
            *next += 1;
            tour.extend(kept[child as usize]);
            stack.push((child, 0));
        } else {
            tour.extend(kept[*node as usize].map(|s| s.reversed()).filter(|_| stack.len() > 1));
            stack.pop();
        }
    }
    tour
}
