//! From one free piece to the next without a lift: the profile backs off from both walls as far as it takes to turn.

use super::{Course, Turning};
use crate::point::Vec2;
use crate::segment::Segment;
use crate::tolerance::profile::SMOOTH_TURN;
use std::f64::consts::{PI, TAU};

/// It backs off by what it may miss the nearest places by, and then by so many times as much each time, up to its reach.
const FARTHER: f64 = 4.0;

impl Turning<'_> {
    /// What follows a piece so that `next` is reached: itself with directions that go on from there, after shifts and a turn on the spot
    /// where it begins elsewhere or with another direction; `None` where it is farther than the profile reaches, or there is no room.
    pub(super) fn joined(&self, last: Course, next: Course) -> Option<Vec<Course>> {
        let gap = last.path.end().distance(next.path.start());
        if gap > self.reach {
            return None;
        }
        let turn = (next.from - last.to + PI).rem_euclid(TAU) - PI;
        let mut next = next.turned(last.to + turn - next.from);
        if gap <= self.entered {
            next.path = super::starting_at(&next.path, last.path.end());
            if turn.abs() <= SMOOTH_TURN {
                return Some(vec![next]);
            }
        }
        let farther = |by: &f64| (*by > 0.0).then_some(by * FARTHER).filter(|by| *by <= self.reach);
        let heights = std::iter::once(0.0).chain(std::iter::successors(Some(self.sag()), farther));
        heights.map(|by| between(&last, &next, by)).find(|way| self.are_free(way)).map(|mut way| {
            way.push(next);
            way
        })
    }

    fn are_free(&self, way: &[Course]) -> bool {
        way.iter().all(|course| self.free_shares(course) == [[0.0, 1.0]])
    }
}

/// The way from the end of one piece to the start of another one, by this far away from their walls.
fn between(last: &Course, next: &Course, by: f64) -> Vec<Course> {
    let [away, towards] = [last.to, next.from].map(|angle| Vec2::from_angle(angle).left() * by);
    let [end, start] = [last.path.end(), next.path.start()];
    let [off, on] = [end + away, start + towards];
    let turning = if by > 0.0 { off.lerp(on, 0.5) + (away + towards) * 0.5 } else { start };
    let shift = |from, to, angle| Course { path: Segment::line(from, to), from: angle, to: angle };
    let spot = Course { path: Segment::line(turning, turning), from: last.to, to: next.from };
    let way = [
        shift(end, off, last.to),
        shift(off, turning, last.to),
        spot,
        shift(turning, on, next.from),
        shift(on, start, next.from),
    ];
    way.into_iter().filter(|c| c.path.start() != c.path.end() || c.from != c.to).collect()
}
