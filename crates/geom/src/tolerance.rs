//! Every tolerance of the program, named and argued. No other module holds an epsilon literal.
//!
//! Lengths marked *relative* are fractions of the region's size (the larger extent of its box, but not below its
//! largest coordinate's own rounding); all others are millimetres or radians.

/// Written programs may gouge by no more than this, mm (rounded decimals included).
pub const GOUGE: f64 = 0.002;

/// How far apart two ends of a drawing's curves may lie and still be joined, mm.
pub const JOIN: f64 = 0.011;

/// How far an arc that replaces a free-form curve may lie from it, mm.
pub const FIT: f64 = 0.001;

/// Ends, crossings and tangencies closer than this are one point: a touch. *Relative.* Ten times what the last digits of
/// polyline bulges and of rotated coordinates cost, and a tenth of the narrowest gap that drawings are known to mean.
pub const TOUCH: f64 = 1e-11;

/// Arcs lie on one circle where centre and radius agree to this; they then share both exactly. *Relative.*
pub const SAME_CIRCLE: f64 = 1e-9;

/// Two contours that nowhere lie farther apart than this are one curve drawn twice, and a sliver no wider than this
/// between two curves that cross is what rounding made of a tangency. *Relative*, and never above the join tolerance:
/// a channel as narrow holds no tool, so nothing that can be milled is lost.
pub const NARROW: f64 = 1e-5;

/// Directions that differ by less are compared by where their curves lead, rad: a touch point known to [`TOUCH`] leaves
/// the tangent of a curve there uncertain by the square root of it at worst.
pub const TANGENT: f64 = 1e-3;

/// Coordinates beyond this are no drawing of a part, mm (ten thousand kilometres).
pub const ABSURD: f64 = 1e10;

/// Nothing smaller than this can be a region, mm (a thousandth of a micrometre).
pub const SMALLEST_SIZE: f64 = 1e-6;

/// Multiples of the unit roundoff that a coordinate after a few operations is known to.
pub const COORDINATE_ROUNDOFF: f64 = 8.0 * f64::EPSILON;

/// The length below which two places in geometry of this box are one: [`TOUCH`] of the size, but not below the rounding
/// of its largest coordinate.
pub fn touch_length(bbox: crate::BBox) -> f64 {
    let largest = [bbox.min.x, bbox.min.y, bbox.max.x, bbox.max.y].into_iter().fold(0.0, |m: f64, c| m.max(c.abs()));
    (TOUCH * bbox.size()).max(COORDINATE_ROUNDOFF * largest)
}
