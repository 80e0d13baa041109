//! From profiles to the loops of one offset: attempts until everything is decided.
//!
//! The first attempt takes the corners as they are. Where that is degenerate, each further one moves every corner by a
//! little (the same in every run), in a range that grows tenfold, and offsets by a little more than the range, so that
//! channels exactly as wide as the tool close everywhere.

use super::corner::Joint;
use super::covered::Covered;
use super::crossings::{Arrangement, Undecided};
use super::profile::Profiles;
use super::raw::{Raw, Trust};
use super::{trace, unproven};
use crate::point::{Point, Vec2, vec2};
use crate::tolerance::bisector::{ATTEMPTS, FIRST_RANGE, RANGE_GROWTH, SLIVER, STRIP_SLACK};
use crate::tolerance::{OFFSET_DROP, touch_length};

/// Rounds of edges left out on trust: nearly always one is enough, or two.
const ROUNDS: usize = 8;

/// The corners of the loops at `distance`; an error is the place that can't be decided.
pub(super) fn polygons(profiles: &Profiles, distance: f64, limit: Option<f64>) -> Result<Vec<Vec<Point>>, Point> {
    let size = profiles.bbox.size();
    let slack = touch_length(profiles.bbox);
    let mut range = 0.0;
    let mut place = profiles.bbox.center();
    for attempt in 0..ATTEMPTS {
        let sliver = slack.max(SLIVER * range);
        match at_range(profiles, distance, limit, range, attempt) {
            Ok(loops) => {
                let drop = OFFSET_DROP * size;
                return Ok(loops.into_iter().filter_map(|l| cleaned(l, drop, sliver)).collect());
            }
            Err(Undecided(at)) => place = at,
        }
        range = if attempt == 0 { FIRST_RANGE * slack.max(size) } else { range * RANGE_GROWTH };
    }
    Err(place)
}

/// Edges that were left out but turn out not to be covered stay in the next round; after some rounds all do that are not
/// proven.
fn at_range(
    profiles: &Profiles,
    distance: f64,
    limit: Option<f64>,
    range: f64,
    seed: u64,
) -> Result<Vec<Vec<Point>>, Undecided> {
    let distance = distance + 2.0 * range;
    let bbox = profiles.bbox;
    let far = bbox.width() + bbox.height() + distance;
    let joint = Joint { distance, limit: limit.unwrap_or(f64::INFINITY), far };
    let mut marked = Vec::new();
    for _ in 0..ROUNDS {
        let mut raw = Raw::new(&profiles.loops, &joint, Trust::Check(&marked));
        shake(&mut raw.points, range, seed);
        if Arrangement::is_crowded(&raw) {
            return uncrowded(profiles, &joint, range, seed);
        }
        let loops = trace::loops(&Arrangement::new(&raw)?)?;
        let uncovered = unproven::uncovered(&raw.unproven, &loops, &joint, bbox);
        if uncovered.is_empty() {
            return Ok(loops);
        }
        marked.resize(profiles.loops.iter().map(Vec::len).sum(), false);
        for name in uncovered {
            marked[name as usize] = true;
        }
    }
    let mut raw = Raw::new(&profiles.loops, &joint, Trust::Prove);
    shake(&mut raw.points, range, seed);
    trace::loops(&Arrangement::new(&raw)?)
}

/// The loops of a raw curve that is mostly covered: crossings are found where it is not. Nothing may be left out on trust, since
/// coverage is that of all strips.
fn uncrowded(profiles: &Profiles, joint: &Joint, range: f64, seed: u64) -> Result<Vec<Vec<Point>>, Undecided> {
    let mut raw = Raw::new(&profiles.loops, joint, Trust::Prove);
    shake(&mut raw.points, range, seed);
    let nominal = Joint { distance: joint.distance - 2.0 * range, ..*joint };
    let covered = Covered::new(&profiles.loops, &nominal, profiles.bbox, STRIP_SLACK * profiles.bbox.size());
    trace::uncovered_loops(&Arrangement::of_uncovered(&raw, &covered)?, &covered)
}

/// Moves every point by up to `range` along either axis.
fn shake(points: &mut [Point], range: f64, seed: u64) {
    if range == 0.0 {
        return;
    }
    let mut state = seed;
    let mut step = || {
        // SplitMix64's output function over a counter.
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)).cast_signed() as f64 / i64::MAX as f64
    };
    for p in points {
        let by: Vec2 = vec2(step(), step()) * range;
        *p += by;
    }
}

/// A loop without edges shorter than `drop`; `None` if it is nowhere wider than about `sliver`.
fn cleaned(mut points: Vec<Point>, drop: f64, sliver: f64) -> Option<Vec<Point>> {
    points.dedup_by(|b, a| a.distance_squared(*b) <= drop * drop);
    while points.len() > 1 && points[0].distance(points[points.len() - 1]) <= drop {
        points.pop();
    }
    if points.len() < 3 {
        return None;
    }
    let (mut twice_area, mut length) = (0.0, 0.0);
    for k in 0..points.len() {
        let (a, b) = (points[k] - points[0], points[(k + 1) % points.len()] - points[0]);
        twice_area += a.cross(b);
        length += (b - a).length();
    }
    (twice_area.abs() > sliver * length).then_some(points)
}
