//! Arcs in rounded numbers.
//!
//! A written arc has a rounded start, end and centre, so its start and end radii differ a little and it no longer runs
//! exactly where it should. [`fit`] chooses the centre among the grid points about the true one and about the one that
//! suits the rounded ends, such that both stay small. It cuts arcs of more than [`LARGEST_SWEEP`] in two, and falls back
//! to chords where an arc would be refused or misread: where it is too small, too flat, or its ends fall on one point.

use super::PostError;
use super::grid::{Grid, Steps};
use pocketry_geom::{Arc, Point, Segment, tolerance};
use std::f64::consts::PI;

/// Arcs that sweep more are written in halves: near a full turn, rounding could make it a full turn more or less.
const LARGEST_SWEEP: f64 = 1.5 * PI;

/// A piece of a rounded path, from where the one before it ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Piece {
    /// To a grid point, straight.
    Line(Steps),
    /// To a grid point, about a centre that lies `offset` steps from the start.
    Arc { to: Steps, offset: Steps, ccw: bool },
}

impl Piece {
    pub(crate) const fn to(&self) -> Steps {
        match *self {
            Self::Line(to) | Self::Arc { to, .. } => to,
        }
    }
}

/// The pieces that stand for `arc` on the grid, `start` being the grid point where the machine is, with the fraction of
/// the arc's length at each piece's end.
pub(crate) fn fit(arc: &Arc, start: Steps, grid: &Grid) -> Result<Vec<(Piece, f64)>, PostError> {
    let sweep = arc.sweep();
    let halves = if sweep.abs() > LARGEST_SWEEP { 2 } else { 1 };
    let mut at = start;
    let mut pieces = Vec::with_capacity(halves);
    for k in 0..halves {
        let (from, to) = (k as f64 / halves as f64, (k + 1) as f64 / halves as f64);
        let part = sub_arc(arc, from, to);
        let fitted = match fit_single(&part, sweep.abs() / halves as f64, at, grid)? {
            Some(piece) => vec![(piece, 1.0)],
            None => chords(&part, sweep / halves as f64, grid)?,
        };
        pieces.extend(fitted.into_iter().map(|(piece, t)| (piece, from + t * (to - from))));
        at = pieces.last().map_or(at, |(piece, _)| piece.to());
    }
    Ok(pieces)
}

fn sub_arc(arc: &Arc, from: f64, to: f64) -> Arc {
    let whole = Segment::Arc(*arc);
    Arc { start: whole.at(from), end: whole.at(to), ..*arc }
}

/// One piece for an arc of at most [`LARGEST_SWEEP`], or `None` where chords have to do.
fn fit_single(arc: &Arc, sweep: f64, start: Steps, grid: &Grid) -> Result<Option<Piece>, PostError> {
    let end = grid.point_steps(arc.end)?;
    let sagitta = arc.radius * (1.0 - (0.5 * sweep.min(PI)).cos());
    if sagitta < 0.25 * grid.step() {
        return Ok(Some(Piece::Line(end)));
    }
    if arc.radius < tolerance::ARC_RADIUS_MIN || sweep < tolerance::ARC_SWEEP_MIN || start == end {
        return Ok(None);
    }
    let (error, offset) = [arc.center, center_over_chord(arc, sweep, grid.point(start), grid.point(end))]
        .into_iter()
        .filter_map(|center| grid.point_steps(center).ok())
        .flat_map(|[x, y]| (-1..=1).flat_map(move |dx| (-1..=1).map(move |dy| [x + dx, y + dy])))
        .map(|c| (misfit(arc, start, end, c, grid), [c[0] - start[0], c[1] - start[1]]))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .unwrap_or((f64::INFINITY, [0, 0]));
    Ok((error < acceptable(grid)).then_some(Piece::Arc { to: end, offset, ccw: arc.ccw }))
}

/// The centre of the arc's own radius that is equally far from the rounded ends: on short arcs, rounding turns the chord,
/// and the true centre would no longer fit.
fn center_over_chord(arc: &Arc, sweep: f64, start: Point, end: Point) -> Point {
    let chord = end - start;
    let height = (arc.radius * arc.radius - 0.25 * chord.length_squared()).max(0.0).sqrt();
    let to_left = arc.ccw == (sweep < PI);
    let side = if to_left { chord.left() } else { chord.right() };
    start.midpoint(end) + side.normalized() * height
}

/// What a fitted arc may be off, mm: rounding leaves less; more means that the rounded numbers describe another arc.
fn acceptable(grid: &Grid) -> f64 {
    (3.0 * grid.step()).min(tolerance::ARC_RADII_WRITTEN)
}

/// How far the arc about grid point `center` runs from the true one, and how far its two radii differ (the larger).
fn misfit(arc: &Arc, start: Steps, end: Steps, center: Steps, grid: &Grid) -> f64 {
    let (r0, r1) = (grid.distance(start, center), grid.distance(end, center));
    // Where rounding has turned the ends past each other, the arc would run the other way round.
    let turned = Arc {
        start: Point::ORIGIN + (grid.point(start) - grid.point(center)),
        end: Point::ORIGIN + (grid.point(end) - grid.point(center)),
        center: Point::ORIGIN,
        radius: r0,
        ccw: arc.ccw,
    };
    if (turned.sweep() - arc.sweep()).abs() > 1.0 || turned.sweep().abs() < tolerance::ARC_SWEEP_MIN {
        return f64::INFINITY;
    }
    let shift = grid.point(center) - arc.center;
    let whole = Segment::Arc(*arc);
    [0.25, 0.5, 0.75]
        .into_iter()
        .map(|t| {
            let outward = whole.at(t) - arc.center;
            ((outward - shift).length() - (r0 + t * (r1 - r0))).abs()
        })
        .fold((r0 - r1).abs(), f64::max)
}

/// Chords whose ends lie on the arc and that leave it by no more than half a step.
fn chords(arc: &Arc, sweep: f64, grid: &Grid) -> Result<Vec<(Piece, f64)>, PostError> {
    let step = 2.0 * (1.0 - (0.5 * grid.step() / arc.radius).min(1.0)).acos();
    let count = (sweep.abs() / step).ceil().clamp(1.0, 1000.0) as usize;
    let whole = Segment::Arc(*arc);
    (1..=count)
        .map(|k| {
            let t = k as f64 / count as f64;
            Ok((Piece::Line(grid.point_steps(whole.at(t))?), t))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::post::OutputUnit;
    use pocketry_geom::{Vec2, point};
    use proptest::prelude::*;

    fn arc_of(center: Point, radius: f64, from: f64, sweep: f64) -> Arc {
        let at = |angle| center + Vec2::from_angle(angle) * radius;
        Arc { start: at(from), end: at(from + sweep), center, radius, ccw: sweep > 0.0 }
    }

    /// The farthest that the written pieces run from the arc, and the largest difference of radii.
    fn judge(arc: &Arc, grid: &Grid) -> (f64, f64) {
        let start = grid.point_steps(arc.start).unwrap();
        let (mut at, mut off, mut radii) = (start, 0f64, 0f64);
        for (piece, _) in fit(arc, start, grid).unwrap() {
            let segment = match piece {
                Piece::Line(to) => Segment::line(grid.point(at), grid.point(to)),
                Piece::Arc { to, offset, ccw } => {
                    let c = [at[0] + offset[0], at[1] + offset[1]];
                    radii = radii.max((grid.distance(at, c) - grid.distance(to, c)).abs());
                    let (start, end, center) = (grid.point(at), grid.point(to), grid.point(c));
                    Segment::Arc(Arc { start, end, center, radius: start.distance(center), ccw })
                }
            };
            off = (0..=16).map(|k| arc.distance(segment.at(f64::from(k) / 16.0))).fold(off, f64::max);
            at = piece.to();
        }
        assert_eq!(at, grid.point_steps(arc.end).unwrap());
        (off, radii)
    }

    #[test]
    fn a_full_circle_becomes_two_halves() {
        let arc = arc_of(point(3.0, 4.0), 5.0, 0.0, 2.0 * PI);
        let arc = Arc { end: arc.start, ..arc };
        let grid = Grid::new(OutputUnit::Millimetre, 4);
        let pieces = fit(&arc, grid.point_steps(arc.start).unwrap(), &grid).unwrap();
        assert!(matches!(pieces[..], [(Piece::Arc { .. }, 0.5), (Piece::Arc { .. }, 1.0)]));
    }

    #[test]
    fn an_arc_flatter_than_the_decimals_is_a_line() {
        let grid = Grid::new(OutputUnit::Millimetre, 4);
        for (radius, sweep) in [(1e7, 1e-6), (5.0, 1e-4), (0.3, 1e-5)] {
            let arc = arc_of(point(0.0, -radius), radius, 1.57, sweep);
            let pieces = fit(&arc, grid.point_steps(arc.start).unwrap(), &grid).unwrap();
            assert!(matches!(pieces[..], [(Piece::Line(_), _)]), "{radius} {sweep}: {pieces:?}");
        }
    }

    #[test]
    fn circles_below_the_smallest_radius_are_chords() {
        let grid = Grid::new(OutputUnit::Millimetre, 6);
        let arc = arc_of(point(0.0, 0.0), 0.002, 0.3, 5.0);
        let pieces = fit(&arc, grid.point_steps(arc.start).unwrap(), &grid).unwrap();
        assert!(pieces.len() > 8 && pieces.iter().all(|(p, _)| matches!(p, Piece::Line(_))));
        assert!(judge(&arc, &grid).0 < 2e-6);
    }

    proptest! {
        #[test]
        fn written_arcs_stay_where_they_should(
            (x, y) in (-1e4..1e4, -1e4..1e4),
            log_radius in -2.5..7.0,
            from in 0.0..6.3,
            log_sweep in -7.0..0.8,
            ccw: bool,
            inch: bool,
        ) {
            let sweep = 10f64.powf(log_sweep).min(2.0 * PI) * if ccw { 1.0 } else { -1.0 };
            let arc = arc_of(point(x, y), 10f64.powf(log_radius), from, sweep);
            let grid = if inch { Grid::new(OutputUnit::Inch, 5) } else { Grid::new(OutputUnit::Millimetre, 4) };
            let (off, radii) = judge(&arc, &grid);
            prop_assert!(off < 4.0 * grid.step(), "off by {off}");
            prop_assert!(radii < 1.5 * grid.step(), "radii differ by {radii}");
        }
    }
}
