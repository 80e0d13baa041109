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

/// How far the start and end radii of a planned arc may differ, mm: a tenth of what control units check, so that
/// rounding has room.
pub const ARC_RADII: f64 = 1e-4;

/// The same for parts far from the origin: fraction of the largest coordinate, some thousand times its rounding.
pub const ARC_RADII_RELATIVE: f64 = 1e-12;

/// Arcs of a smaller radius are written as chords, mm: control units refuse arcs whose radius is about their own
/// tolerance (LinuxCNC: 0.00127 mm by default, often set to 0.002 mm).
pub const ARC_RADIUS_MIN: f64 = 0.005;

/// Arcs of a smaller sweep are written as chords, radians: LinuxCNC takes what sweeps less than 1e-6 for a full turn.
pub const ARC_SWEEP_MIN: f64 = 1e-5;

/// How far the start and end radii of a *written* arc may differ, mm: half of the strictest setting in use.
pub const ARC_RADII_WRITTEN: f64 = 0.001;

/// Share of the gouge budget that one step of the written decimals may take: rounding moves a point of the path by
/// up to three steps (end, centre, radius), which leaves more than half of the budget.
pub const ROUNDING_SHARE: f64 = 0.15;
