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

/// The largest coordinate that a drawing may have, mm: beyond it doubles are spaced by more than a thousandth of the
/// gouge tolerance.
pub const LARGEST_COORDINATE: f64 = 1e10;

/// The smallest size that a drawing may have, mm; less is no drawing but a mistaken unit.
pub const SMALLEST_EXTENT: f64 = 1e-6;

/// The steepest bulge that a drawing may have: the arc then lacks less than 1/400 of a degree of a full turn and
/// its radius is a guess.
pub const LARGEST_BULGE: f64 = 1e5;

/// How far a drawing's normal may lean from the z axis, as the sine of the angle, and still be flat.
pub const FLAT_NORMAL: f64 = 1e-6;
