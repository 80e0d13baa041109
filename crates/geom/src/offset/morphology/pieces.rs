//! The trajectory: every contact of the profile with the boundary from inside, as lines and arcs of the reference point.
//!
//! A boundary element and a profile element that have directions in common touch along them. The piece that
//! this makes runs forwards, with the erosion to its left, where the profile bends at least as much as the wall; other contacts
//! bound nothing. Where a boundary edge and a profile edge have one direction, the boundary's comes first: which of
//! two equal directions is the smaller one is decided once, so that every piece has one successor at most.

use super::elements::{Direction, Element, Elements, Turn};
use crate::point::Point;
use crate::segment::{Arc, Segment};
use crate::skeleton::NONE;
use crate::tolerance::profile::SLIGHT;
use std::f64::consts::PI;

/// The end of a contact: the elements before it and those after it, of which one or (at the cut of directions) both are new.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Gate {
    boundary: [u32; 2],
    profile: [u32; 2],
}

impl Gate {
    const fn back(self) -> Self {
        let ([a, b], [c, d]) = (self.boundary, self.profile);
        Self { boundary: [b, a], profile: [d, c] }
    }
}

/// The places of the reference point while one element of the profile touches one of the boundary.
#[derive(Clone, Copy, Debug)]
struct Contact {
    profile: u32,
    /// `None` where the reference rests while directions sweep.
    path: Option<Segment>,
    enters: Gate,
    leaves: Gate,
}

/// A piece of the trajectory.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) segment: Segment,
    /// The piece that starts where this one ends, [`NONE`] where the next contact is none from inside.
    pub(super) next: u32,
}

/// All pieces, in the order of the boundary.
pub(super) fn trajectory(boundary: &Elements, profile: &Elements) -> Vec<Piece> {
    let ranges = Ranges::new(profile);
    let (mut contacts, mut bounds) = (Vec::with_capacity(2 * boundary.all.len()), vec![0_u32]);
    for (k, wall) in boundary.all.iter().enumerate() {
        let first = contacts.len();
        ranges.overlapping(wall, |j| contacts.extend(touch((boundary, k as u32), (profile, j))));
        contacts[first..].sort_unstable_by_key(|c: &Contact| c.profile);
        bounds.push(contacts.len() as u32);
    }
    let chain = Chain { contacts: &contacts, bounds: &bounds, boundary, profile };
    let mut names = vec![NONE; contacts.len()];
    for (name, (k, _)) in (0..).zip(contacts.iter().enumerate().filter(|(_, c)| c.path.is_some())) {
        names[k] = name;
    }
    let pieces = contacts.iter().enumerate().filter_map(|(k, c)| Some((k as u32, c.path?)));
    pieces.map(|(k, segment)| Piece { segment, next: chain.follow(k).map_or(NONE, |n| names[n as usize]) }).collect()
}

/// The profile's elements in the order of their least directions.
struct Ranges<'a> {
    profile: &'a Elements,
    order: Vec<u32>,
    /// The greatest direction of all elements up to this one.
    reach: Vec<f64>,
}

impl<'a> Ranges<'a> {
    fn new(profile: &'a Elements) -> Self {
        let of = |k: u32| &profile.all[k as usize];
        let mut order: Vec<u32> = (0..profile.all.len() as u32).collect();
        order.sort_by(|&a, &b| of(a).low.angle.total_cmp(&of(b).low.angle));
        let reach = order.iter().scan(f64::NEG_INFINITY, |r, &k| {
            *r = r.max(of(k).high.angle);
            Some(*r)
        });
        Self { profile, reach: reach.collect(), order }
    }

    /// The profile's elements that have a direction in common with a wall.
    fn overlapping(&self, wall: &Element, mut found: impl FnMut(u32)) {
        let of = |k: u32| &self.profile.all[k as usize];
        let (low, high) = (wall.low.angle, wall.high.angle);
        let end = self.order.partition_point(|&k| of(k).low.angle < high);
        for place in (0..end).rev().take_while(|&p| self.reach[p] >= low) {
            if of(self.order[place]).high.angle >= low {
                found(self.order[place]);
            }
        }
    }
}

/// How one element of the profile touches one of the boundary, if from inside.
fn touch((boundary, k): (&Elements, u32), (profile, j): (&Elements, u32)) -> Option<Contact> {
    let (wall, tool) = (&boundary.all[k as usize], &profile.all[j as usize]);
    if tool.curvature() < wall.curvature() {
        return None;
    }
    let wall_to = |forwards: bool| if forwards { boundary.next(k) } else { boundary.previous(k) };
    let tool_to = |forwards: bool| if forwards { profile.next(j) } else { profile.previous(j) };
    let along_wall = |forwards: bool| Gate { boundary: [k, wall_to(forwards)], profile: [j, j] };
    let along_tool = |forwards: bool| Gate { boundary: [k, k], profile: [j, tool_to(forwards)] };
    let across_cut = |upwards: bool| Gate {
        boundary: [k, wall_to((wall.turn == Turn::Left) == upwards)],
        profile: [j, tool_to((tool.turn == Turn::Left) == upwards)],
    };
    match (wall.is_line(), tool.is_line()) {
        (true, true) => None,
        (true, false) => {
            let b = tool.point_at(wall.low).to_vec();
            let path = Some(Segment::line(wall.start - b, wall.end - b));
            Some(Contact { profile: j, path, enters: along_wall(false), leaves: along_wall(true) })
        }
        (false, true) => {
            let x = wall.point_at(tool.low);
            let path = Some(Segment::line(x - tool.end.to_vec(), x - tool.start.to_vec()));
            Some(Contact { profile: j, path, enters: along_tool(true), leaves: along_tool(false) })
        }
        (false, false) => {
            let upper = if wall.high.is_cut() && tool.high.is_cut() {
                (wall.high, across_cut(true))
            } else if wall.high.angle <= tool.high.angle {
                (wall.high, along_wall(wall.turn == Turn::Left))
            } else {
                (tool.high, along_tool(tool.turn == Turn::Left))
            };
            let lower = if wall.low.is_cut() && tool.low.is_cut() {
                (wall.low, across_cut(false))
            } else if tool.low.angle >= wall.low.angle {
                (tool.low, along_tool(tool.turn == Turn::Right))
            } else {
                (wall.low, along_wall(wall.turn == Turn::Right))
            };
            let excess = wall.radius - tool.radius;
            let rises = excess > 0.0 || (excess == 0.0 && (wall.turn, tool.turn) != (Turn::Right, Turn::Left));
            let (from, to) = if rises { (lower, upper) } else { (upper, lower) };
            let path = if lower.0.angle < upper.0.angle { sweep(wall, tool, from.0, to.0, rises) } else { None };
            Some(Contact { profile: j, path, enters: from.1, leaves: to.1 })
        }
    }
}

/// The path of the reference while two round elements touch from one direction to another.
fn sweep(wall: &Element, tool: &Element, from: Direction, to: Direction, ccw: bool) -> Option<Segment> {
    let place = |d: Direction| -> Point { wall.point_at(d) - tool.point_at(d).to_vec() };
    let (start, end) = (place(from), place(to));
    let radius = (wall.radius - tool.radius).abs();
    let center = wall.center() - tool.center().to_vec();
    let arc = Arc { start, end, center, radius, ccw };
    // Where slight bends were straightened the ends of a tiny arc may have changed places.
    let turning = (to.angle - from.angle).abs();
    let runs = radius > 0.0 && start != end && arc.sweep().abs() < turning + PI;
    runs.then_some(Segment::Arc(arc))
}

struct Chain<'a> {
    contacts: &'a [Contact],
    /// For each boundary element its first contact; one more at the end.
    bounds: &'a [u32],
    boundary: &'a Elements,
    profile: &'a Elements,
}

impl Chain<'_> {
    /// The next contact with a path.
    fn follow(&self, from: u32) -> Option<u32> {
        let mut at = from;
        for _ in 0..self.contacts.len() {
            let leaves = self.contacts[at as usize].leaves;
            at = self.entered(leaves).or_else(|| self.bridged(leaves))?;
            if self.contacts[at as usize].path.is_some() {
                return Some(at);
            }
        }
        None
    }

    /// The contacts of a boundary element, and the first one's number.
    fn of(&self, boundary: u32) -> (u32, &[Contact]) {
        let (first, end) = (self.bounds[boundary as usize], self.bounds[boundary as usize + 1]);
        (first, &self.contacts[first as usize..end as usize])
    }

    /// The contact that is entered where another one is left.
    fn entered(&self, leaves: Gate) -> Option<u32> {
        let (first, group) = self.of(leaves.boundary[1]);
        let place = group.binary_search_by_key(&leaves.profile[1], |c| c.profile).ok()?;
        (group[place].enters == leaves.back()).then_some(first + place as u32)
    }

    /// The contact beyond bends so slight that their sides cross no one knows where, although the profile touches nothing there.
    fn bridged(&self, leaves: Gate) -> Option<u32> {
        let ([mut before, mut wall], [from, mut tool]) = (leaves.boundary, leaves.profile);
        let mut turned = 0.0;
        if before == wall {
            let forwards = self.profile.next(from) == tool;
            loop {
                let bend = &self.profile.all[tool as usize];
                turned += bend.turning();
                if bend.is_line() || turned > SLIGHT {
                    return None;
                }
                let beyond = if forwards { self.profile.next(tool) } else { self.profile.previous(tool) };
                let leaves = Gate { boundary: [wall, wall], profile: [tool, beyond] };
                if let Some(found) = self.entered(leaves) {
                    return Some(found);
                }
                tool = beyond;
            }
        }
        loop {
            let bend = &self.boundary.all[wall as usize];
            turned += bend.turning();
            if bend.is_line() || turned > SLIGHT {
                return None;
            }
            (before, wall) = (wall, self.boundary.next(wall));
            let (first, group) = self.of(wall);
            let enters = |c: &&(u32, &Contact)| c.1.enters.boundary == [wall, before];
            let nearest = |c: &(u32, &Contact)| c.1.profile.abs_diff(tool);
            if let Some((found, _)) = (first..).zip(group).filter(|c| enters(&c)).min_by_key(nearest) {
                return Some(found);
            }
        }
    }
}
