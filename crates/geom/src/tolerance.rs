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

/// Share of the fit tolerance within which a curve counts as straight, or two arcs as one: a line or an arc in its
/// place then costs nothing that the tolerance would notice.
pub const STRAIGHT_SHARE: f64 = 1e-3;

/// Control points of a curve nearer than this share of its extent are one place: rounding, not a direction.
pub const COINCIDENT_CONTROL: f64 = 1e-9;

/// A joint of curves that turns by more than this is a corner that the drawing means, radians; less is a smooth joint
/// written with few decimals.
pub const KINK: f64 = 1e-3;

/// An ellipse whose axes differ by no more than this share of their length, or are no further from square, is a
/// circle: ten times what a chain of rotations and scales in double precision leaves.
pub const CIRCULAR: f64 = 1e-9;

/// Angles of a drawing nearer than this are the same, radians: the last decimals that CAD systems write.
pub const ANGLE: f64 = 1e-9;

/// The steepest bulge that a drawing may have: the arc then lacks less than 1/400 of a degree of a full turn and
/// its radius is a guess.
pub const LARGEST_BULGE: f64 = 1e5;

/// How far a drawing's normal may lean from the z axis, as the sine of the angle, and still be flat.
pub const FLAT_NORMAL: f64 = 1e-6;

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
