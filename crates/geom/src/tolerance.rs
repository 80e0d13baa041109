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

/// A program may gouge by no more than this part of the tool's radius, where that is less than [`GOUGE`].
pub const GOUGE_PER_RADIUS: f64 = 0.01;

/// Material counts as left uncut where the tool stays farther from it than this part of its radius (or [`GOUGE`], where that is more).
pub const COVER_PER_RADIUS: f64 = 2e-4;

/// Rounding of a distance computed by the proof from coordinates, as a part of the largest coordinate: some 250 units in
/// the last place, several times what its longest chain of operations loses.
pub const PROOF_ROUNDING: f64 = 256.0 * f64::EPSILON;

/// Arcs that lie nearer than this part of the gouge limit to their chords are judged as their chords (and the limit tightened).
pub const PROOF_FLATNESS: f64 = 1e-3;

/// A turn between two curves below this angle opens no sector between their parallels: at a radius of 1 m it would be 1 nm wide.
pub const SMOOTH_JOINT: f64 = 1e-9;

/// How far the radii at an arc's start and end may differ in a program, mm, or as a part of the radius where that is more.
pub const ARC_RADII: f64 = 0.005;

/// See [`ARC_RADII`].
pub const ARC_RADII_RELATIVE: f64 = 1e-4;

/// The control takes an arc of less than this angle for the full turn.
pub const FULL_TURN: f64 = 1e-6;

/// Heights nearer than this are the same height, mm.
pub const SAME_HEIGHT: f64 = 1e-6;

/// Two curves that turn back on one another within this angle make a cusp, where the sign of the turn tells nothing.
pub const CUSP: f64 = 1e-6;
