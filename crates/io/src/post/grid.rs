//! The grid of numbers that can be written: integer multiples of the last decimal.

use super::PostError;
use pocketry_geom::Point;

/// The unit of a written program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OutputUnit {
    /// Millimetres (G21).
    #[default]
    Millimetre,
    /// Inches (G20).
    Inch,
}

impl OutputUnit {
    /// How many millimetres one of it is.
    pub const fn millimetres(self) -> f64 {
        match self {
            Self::Millimetre => 1.0,
            Self::Inch => 25.4,
        }
    }

    /// Digits after the point where the tool asks for no more.
    pub const fn usual_decimals(self) -> usize {
        match self {
            Self::Millimetre => 4,
            Self::Inch => 5,
        }
    }

    /// Its sign, as in "12 mm".
    pub const fn sign(self) -> &'static str {
        match self {
            Self::Millimetre => "mm",
            Self::Inch => "in",
        }
    }
}

/// A point of the grid, in steps.
pub(crate) type Steps = [i64; 2];

/// Converts between millimetres and steps of the last written decimal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    unit: OutputUnit,
    decimals: usize,
    per_unit: f64,
}

impl Grid {
    pub(crate) fn new(unit: OutputUnit, decimals: usize) -> Self {
        Self { unit, decimals, per_unit: (0..decimals).fold(1.0, |power, _| 10.0 * power) }
    }

    /// One step, mm.
    pub(crate) fn step(&self) -> f64 {
        self.unit.millimetres() / self.per_unit
    }

    /// The nearest step.
    pub(crate) fn steps(&self, mm: f64) -> Result<i64, PostError> {
        /// Beyond this, neighbouring integers are no longer different numbers.
        const LARGEST: f64 = (1u64 << 53) as f64;
        let steps = (mm / self.unit.millimetres() * self.per_unit).round();
        if steps.abs() < LARGEST {
            Ok(steps as i64)
        } else {
            Err(PostError::TooLarge { value: mm, decimals: self.decimals })
        }
    }

    pub(crate) fn point_steps(&self, p: Point) -> Result<Steps, PostError> {
        Ok([self.steps(p.x)?, self.steps(p.y)?])
    }

    /// The length in mm of a number of steps.
    pub(crate) fn mm(&self, steps: i64) -> f64 {
        steps as f64 / self.per_unit * self.unit.millimetres()
    }

    pub(crate) fn point(&self, at: Steps) -> Point {
        Point::new(self.mm(at[0]), self.mm(at[1]))
    }

    /// The displacement between two grid points, mm; exact to rounding, however far they lie from the origin.
    pub(crate) fn distance(&self, a: Steps, b: Steps) -> f64 {
        self.mm(a[0] - b[0]).hypot(self.mm(a[1] - b[1]))
    }

    /// The decimal number, with at least one digit after the point and no superfluous zeros.
    pub(crate) fn text(&self, steps: i64) -> String {
        let digits = format!("{:0width$}", steps.unsigned_abs(), width = self.decimals + 1);
        let (whole, fraction) = digits.split_at(digits.len() - self.decimals);
        let fraction = fraction.trim_end_matches('0');
        let sign = if steps < 0 { "-" } else { "" };
        format!("{sign}{whole}.{}", if fraction.is_empty() { "0" } else { fraction })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_without_superfluous_zeros() {
        let grid = Grid::new(OutputUnit::Millimetre, 4);
        let cases = [(0, "0.0"), (1, "0.0001"), (-1, "-0.0001"), (10_000, "1.0"), (-123_400, "-12.34")];
        for (steps, text) in cases {
            assert_eq!(grid.text(steps), text);
        }
        assert_eq!(grid.text(grid.steps(-0.000_01).unwrap()), "0.0");
    }

    #[test]
    fn inches_are_rounded_in_inches() {
        let grid = Grid::new(OutputUnit::Inch, 5);
        assert_eq!(grid.text(grid.steps(25.4).unwrap()), "1.0");
        assert_eq!(grid.text(grid.steps(1.0).unwrap()), "0.03937");
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        assert!(Grid::new(OutputUnit::Millimetre, 9).steps(1e9).is_err());
        assert!(Grid::new(OutputUnit::Millimetre, 4).steps(f64::NAN).is_err());
    }
}
