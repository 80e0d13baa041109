//! Figures of a program and the moves that no program may make: rapids below the stock's top, and the like.

use crate::gcode::{Kind, Motion, Trace};
use crate::report::{Figures, Violation};

/// Figures and violations of one pass over the motions.
#[derive(Clone, Debug, Default)]
pub(crate) struct Limits {
    pub(crate) figures: Figures,
    /// Rapid moves below the stock's top, other than straight up.
    pub(crate) rapids_below: Vec<Violation>,
    /// Moves across while the height is not known yet.
    pub(crate) unknown_height: Vec<Violation>,
}

impl Limits {
    /// Looks at every motion.
    pub(crate) fn new(trace: &Trace, top: f64) -> Self {
        let mut limits = Self::default();
        limits.figures.lowest_z = f64::INFINITY;
        for motion in &trace.motions {
            limits.figures.count(motion, top);
            let violation = || Violation { line: motion.line, at: motion.to.xy(), z: motion.low() };
            let across = !motion.is_vertical() || motion.to.z < motion.from.z;
            if motion.kind == Kind::Rapid && motion.low() < top && across {
                limits.rapids_below.push(violation());
            }
            if motion.from.z.is_infinite() && motion.to.z.is_infinite() {
                limits.unknown_height.push(violation());
            }
        }
        limits
    }
}

impl Figures {
    fn count(&mut self, motion: &Motion, top: f64) {
        self.blocks += 1;
        self.arcs += usize::from(motion.kind == Kind::Arc);
        if motion.kind == Kind::Rapid {
            self.rapid_length += if motion.known { motion.length } else { 0.0 };
        } else {
            self.cut_length += motion.length;
        }
        self.retracts += usize::from(motion.from.z < top && motion.to.z >= top);
        self.plunges += usize::from(motion.is_vertical() && motion.from.z >= top && motion.to.z < top);
        self.entries += usize::from(motion.from.z >= top && motion.to.z < top);
        self.lowest_z = self.lowest_z.min(motion.low());
    }
}
