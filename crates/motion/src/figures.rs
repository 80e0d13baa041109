//! What a program amounts to: lengths, lifts and time.

use crate::program::{FeedKind, Move, Program};
use crate::setup::{Feeds, Stock};
use serde::Serialize;

/// Sums over a program's moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Figures {
    /// Length at feed, mm, descents included.
    pub cut_length: f64,
    /// Length at rapid speed, mm, from the first position on.
    pub rapid_length: f64,
    /// Lifts from below the stock's top to its top or above, the last one included.
    pub retracts: usize,
    /// Number of moves.
    pub moves: usize,
    /// How many of them are arcs.
    pub arcs: usize,
    /// Time at the programmed speeds, s. The machine's acceleration is not accounted for, so it will take longer.
    pub machine_seconds: f64,
}

impl Figures {
    pub(crate) fn of(program: &Program, feeds: &Feeds, stock: &Stock) -> Self {
        let mut sum = Self { moves: program.moves.len(), ..Self::default() };
        for (from, step) in program.steps() {
            let length = step.length(from);
            match step.feed() {
                None => sum.rapid_length += length,
                Some(_) => sum.cut_length += length,
            }
            sum.machine_seconds += 60.0 * length / feeds.speed(step.feed());
            sum.retracts += usize::from(from.z < stock.top && step.to().z >= stock.top);
            sum.arcs += usize::from(matches!(step, Move::Arc { .. }));
        }
        sum
    }
}

impl Feeds {
    /// The speed of a move, mm/min: `None` stands for rapid.
    pub const fn speed(&self, kind: Option<FeedKind>) -> f64 {
        match kind {
            None => self.rapid,
            Some(FeedKind::Cut) => self.cut,
            Some(FeedKind::Ramp) => self.ramp,
            Some(FeedKind::Plunge) => self.plunge,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::Point3;

    #[test]
    fn lengths_lifts_and_time_add_up() {
        let at = |x, z| Point3 { x, y: 0.0, z };
        let program = Program {
            moves: vec![
                Move::Rapid { to: at(0.0, 10.0) },
                Move::Rapid { to: at(0.0, 2.0) },
                Move::Line { to: at(0.0, -3.0), feed: FeedKind::Plunge },
                Move::Line { to: at(60.0, -3.0), feed: FeedKind::Cut },
                Move::Rapid { to: at(60.0, 10.0) },
            ],
            ..Program::default()
        };
        let feeds = Feeds { cut: 600.0, plunge: 100.0, rapid: 2100.0, ..Feeds::default() };
        let sum = program.figures(&feeds, &Stock { top: 0.0, depth: 3.0 });
        assert_eq!((sum.cut_length, sum.rapid_length), (65.0, 21.0));
        assert_eq!((sum.retracts, sum.moves, sum.arcs), (1, 5, 0));
        assert!((sum.machine_seconds - (6.0 + 3.0 + 0.6)).abs() < 1e-12);
    }
}
