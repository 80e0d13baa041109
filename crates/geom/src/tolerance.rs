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

/// Offset segments shorter than this are dropped and their ends merged, *relative*: some thousand times the rounding
/// of coordinates, so that what goes is noise, and a thousandth of what an offset may be off.
pub const OFFSET_DROP: f64 = 1e-12;

/// Skeleton edges whose clearance changes by no more than this are constant, *relative*: above the rounding of
/// clearances, below any taper that a drawing means.
pub const PLATEAU: f64 = 1e-11;

/// One minus the rate at which clearance grows along an edge, below which the edge runs straight away from its sites
/// (a spoke, or the bisector at a joint that is smooth but for rounding).
pub const SPOKE_RATE: f64 = 1e-9;

/// Squared half sum or half difference of two unit gradients below which a Newton step along it says nothing.
pub const GRADIENT: f64 = 1e-14;

/// A crossing whose clearance is off by more than this is sought again by bisection, *relative*: a hundredth of what
/// an offset may be off.
pub const CROSSING: f64 = 1e-9;

/// A tool may enter a channel that is narrower than it by twice this, mm: a twentieth of [`GOUGE`], and more than the
/// rounding of drawings with four decimals moves a wall.
pub const FIT_SLACK: f64 = 1e-4;

/// [`FIT_SLACK`] as a share of the offset distance, for tools so small that it would count.
pub const FIT_SLACK_SHARE: f64 = 1e-4;

/// Ends of degenerate paths shorter than this share of the offset distance are left out: the disk at their root covers
/// their disks but for slivers thinner than what may stay uncut.
pub const SPUR_SHARE: f64 = 1e-3;
