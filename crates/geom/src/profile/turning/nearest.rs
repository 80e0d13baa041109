//! As near to a wall as a profile fits where it can't touch it: beside walls that bend inwards, and where others are in its way.
//!
//! From a place of a wall's parallel the profile is shifted straight away from the wall, as far as that is the nearest one. Where it is first
//! free is found like the ends of runs, in closed form. Along the wall these places are sampled: halves, until the middle lies between
//! what the ends say within [`Turning::sag`], or a jump is narrower than that. A piece of path through the samples keeps that much more from the
//! walls, and is tested as a whole like any other.

use super::{Course, Turning, along, part};
use crate::point::Vec2;
use crate::segment::Segment;

/// By how much a path that follows samples may lie farther from the walls than it could, as a multiple of what it keeps from walls.
const SAG: f64 = 4.0;

/// Samples lie no farther apart than this share of the profile's reach.
const WIDEST: f64 = 0.25;

/// A place of a parallel, as a share of its length, and how much farther from the wall the profile is free; `None` where it is not.
#[derive(Clone, Copy)]
struct Sample {
    share: f64,
    further: Option<f64>,
}

impl Turning<'_> {
    /// How far a path through samples may miss the nearest places, mm.
    pub(super) fn sag(&self) -> f64 {
        SAG * self.spare
    }

    /// The free pieces along a wall's parallel at the touching distance and what is spared, and instead of what is not free of it, further from
    /// the wall; in order.
    pub(super) fn beside_as_near_as_can_be(&self, parallel: &Segment) -> Vec<Course> {
        let whole = along(parallel);
        let mut courses = Vec::new();
        let mut from = 0.0;
        for [start, end] in self.free_shares(&whole) {
            self.stand_off(parallel, [from, start], &mut courses);
            courses.push(part(&whole, [start, end]));
            from = end;
        }
        self.stand_off(parallel, [from, 1.0], &mut courses);
        courses
    }

    /// Adds pieces further from a wall than a part of its parallel.
    fn stand_off(&self, parallel: &Segment, [from, to]: [f64; 2], out: &mut Vec<Course>) {
        if self.spare <= 0.0 || (to - from) * parallel.length() <= self.sag() {
            return;
        }
        let count = ((to - from) * self.extent(parallel) / (WIDEST * self.reach)).ceil().max(1.0);
        let mut before = self.sample(parallel, from);
        let mut spans = Vec::new();
        for k in 0..count as u32 {
            let after = self.sample(parallel, from + (to - from) * f64::from(k + 1) / count);
            self.divide(parallel, before, after, &mut spans);
            before = after;
        }
        for [a, b] in spans {
            let (Some(first), Some(last)) = (a.further, b.further) else { continue };
            let course = raised(parallel, [a.share, b.share], [first, last]);
            out.extend(self.free(&course));
        }
    }

    /// Length of a parallel, or of the way of the profile's far end where it turns.
    fn extent(&self, parallel: &Segment) -> f64 {
        let whole = along(parallel);
        parallel.length().max((whole.to - whole.from).abs() * self.reach)
    }

    /// Adds the spans between two samples along which the nearest places go on smoothly.
    fn divide(&self, parallel: &Segment, a: Sample, b: Sample, spans: &mut Vec<[Sample; 2]>) {
        let middle = self.sample(parallel, 0.5 * (a.share + b.share));
        match (a.further, middle.further, b.further) {
            (None, None, None) => return,
            (Some(first), Some(between), Some(last)) if (between - 0.5 * (first + last)).abs() <= 0.5 * self.sag() => {
                return spans.push([a, b]);
            }
            _ => {}
        }
        if (b.share - a.share) * self.extent(parallel) > self.sag() {
            self.divide(parallel, a, middle, spans);
            self.divide(parallel, middle, b, spans);
        }
    }

    /// How much further from the wall than its parallel the profile is free first.
    fn sample(&self, parallel: &Segment, share: f64) -> Sample {
        let (angle, start) = (along(parallel).direction(share), parallel.at(share));
        let away = Vec2::from_angle(angle).left();
        let distance = self.touch + self.spare;
        let disks = [distance, self.reach];
        let (highest, _) = self.walls.largest_disk(start - away * distance, away, disks, self.entered);
        let none = Sample { share, further: None };
        if highest <= distance {
            return none;
        }
        let way = Course { path: Segment::line(start, start + away * (highest - distance)), from: angle, to: angle };
        let Some(&[first, last]) = self.free_shares(&way).first() else { return none };
        let [low, high] = [first, last].map(|s| s * (highest - distance));
        let further = low + self.sag();
        Sample { share, further: (further <= high).then_some(further) }
    }
}

/// A part of a parallel moved away from its wall by a length at each end. Beside an arc the profile turns about a pole, as a rigid body does from
/// any place and direction to any other.
fn raised(parallel: &Segment, shares: [f64; 2], further: [f64; 2]) -> Course {
    let whole = along(parallel);
    let [from, to] = shares.map(|share| whole.direction(share));
    let place = |k: usize| parallel.at(shares[k]) + Vec2::from_angle([from, to][k]).left() * further[k];
    Course { path: Segment::from_bulge(place(0), place(1), (0.25 * (to - from)).tan()), from, to }
}
