//! Whether a program makes sense by itself, before anyone looks at the drawing.

use crate::program::{Move, Point3, Program};
use crate::setup::Stock;
use pocketry_geom::tolerance;
use thiserror::Error;

/// Why a program can't be run. Moves are counted from 0.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ProgramFault {
    /// There is nothing in it.
    #[error("the program has no moves")]
    Empty,
    /// A coordinate is infinite or not a number.
    #[error("move {index}: a coordinate is not a finite number")]
    NotFinite {
        /// Which move.
        index: usize,
    },
    /// A tool that turns has no direction for each move.
    #[error("the program has {headings} directions of the tool for {moves} moves")]
    Headings {
        /// How many directions.
        headings: usize,
        /// How many moves.
        moves: usize,
    },
    /// The program must begin in the air.
    #[error("the program must begin with a rapid move at or above the stock's top, z = {top} mm")]
    StartsInStock {
        /// Z of the stock's upper face, mm.
        top: f64,
    },
    /// The program must end in the air.
    #[error("the program ends at z = {z} mm, below the stock's top, z = {top} mm")]
    EndsInStock {
        /// Where it ends, mm.
        z: f64,
        /// Z of the stock's upper face, mm.
        top: f64,
    },
    /// A rapid move other than straight up would run through material.
    #[error("move {index}: a rapid move below the stock's top, to ({}, {}, {})", to.x, to.y, to.z)]
    RapidInStock {
        /// Which move.
        index: usize,
        /// Where it ends.
        to: Point3,
    },
    /// The two ends of an arc lie on different circles about its centre.
    #[error("move {index}: the arc starts {start_radius} mm and ends {end_radius} mm from its centre")]
    ArcRadii {
        /// Which move.
        index: usize,
        /// Distance from the centre to the start, mm.
        start_radius: f64,
        /// Distance from the centre to the end, mm.
        end_radius: f64,
    },
}

impl Program {
    /// Checks that all numbers are finite, that the program begins and ends in the air, that both ends of each arc
    /// lie on one circle, that a tool that turns has a direction for each move, and that nothing below the stock's top runs at rapid speed, straight lifts excepted.
    ///
    /// # Errors
    /// The first fault found.
    pub fn check(&self, stock: &Stock) -> Result<(), ProgramFault> {
        let (headings, moves) = (self.headings.len(), self.moves.len());
        if headings > 0 && headings != moves {
            return Err(ProgramFault::Headings { headings, moves });
        }
        let turns_well = |k: usize| self.headings.get(k).is_none_or(|h| h.is_finite());
        if let Some(index) = (0..moves).find(|&k| !is_finite(&self.moves[k]) || !turns_well(k)) {
            return Err(ProgramFault::NotFinite { index });
        }
        let (Some(first), Some(last)) = (self.moves.first(), self.moves.last()) else {
            return Err(ProgramFault::Empty);
        };
        if first.to().z < stock.top || !matches!(first, Move::Rapid { .. }) {
            return Err(ProgramFault::StartsInStock { top: stock.top });
        }
        if last.to().z < stock.top {
            return Err(ProgramFault::EndsInStock { z: last.to().z, top: stock.top });
        }
        self.steps().enumerate().try_for_each(|(k, (from, step))| check_step(k + 1, from, step, stock.top))
    }
}

fn is_finite(step: &Move) -> bool {
    let center = match *step {
        Move::Arc { center, .. } => center,
        _ => step.to().xy(),
    };
    step.to().is_finite() && center.is_finite()
}

fn check_step(index: usize, from: Point3, step: &Move, top: f64) -> Result<(), ProgramFault> {
    match *step {
        Move::Rapid { to } => {
            let lift = from.xy() == to.xy() && to.z >= from.z;
            let in_air = from.z.min(to.z) >= top;
            if lift || in_air { Ok(()) } else { Err(ProgramFault::RapidInStock { index, to }) }
        }
        Move::Line { .. } => Ok(()),
        Move::Arc { to, center, .. } => {
            let (start_radius, end_radius) = (from.xy().distance(center), to.xy().distance(center));
            let reach = start_radius.max(center.x.abs()).max(center.y.abs());
            let allowed = tolerance::ARC_RADII + tolerance::ARC_RADII_RELATIVE * reach;
            // Written so that NaN is a fault.
            if (start_radius - end_radius).abs() <= allowed {
                Ok(())
            } else {
                Err(ProgramFault::ArcRadii { index, start_radius, end_radius })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::FeedKind;
    use pocketry_geom::point;

    const STOCK: Stock = Stock { top: 0.0, depth: 5.0 };

    fn at(x: f64, y: f64, z: f64) -> Point3 {
        Point3 { x, y, z }
    }

    fn good() -> Program {
        Program {
            moves: vec![
                Move::Rapid { to: at(1.0, 0.0, 5.0) },
                Move::Line { to: at(1.0, 0.0, -5.0), feed: FeedKind::Plunge },
                Move::Arc { to: at(-1.0, 0.0, -5.0), center: point(0.0, 0.0), ccw: true, feed: FeedKind::Cut },
                Move::Rapid { to: at(-1.0, 0.0, 5.0) },
            ],
            ..Program::default()
        }
    }

    #[test]
    fn a_sound_program_passes() {
        assert_eq!(good().check(&STOCK), Ok(()));
    }

    #[test]
    fn each_fault_is_found() {
        assert_eq!(Program::default().check(&STOCK), Err(ProgramFault::Empty));
        let broken = |index: usize, with: Move| {
            let mut program = good();
            program.moves[index] = with;
            program.check(&STOCK).unwrap_err()
        };
        let nan = Move::Rapid { to: at(f64::NAN, 0.0, 5.0) };
        assert_eq!(broken(0, nan), ProgramFault::NotFinite { index: 0 });
        let low = Move::Rapid { to: at(1.0, 0.0, -1.0) };
        assert_eq!(broken(0, low), ProgramFault::StartsInStock { top: 0.0 });
        assert!(matches!(broken(1, low), ProgramFault::RapidInStock { index: 1, .. }));
        assert!(matches!(broken(3, low), ProgramFault::EndsInStock { .. }));
        let off = Move::Arc { to: at(-1.1, 0.0, -5.0), center: point(0.0, 0.0), ccw: true, feed: FeedKind::Cut };
        assert!(matches!(broken(2, off), ProgramFault::ArcRadii { index: 2, .. }));
        let across = Move::Rapid { to: at(-2.0, 0.0, 5.0) };
        assert!(matches!(broken(3, across), ProgramFault::RapidInStock { index: 3, .. }));
    }
}
