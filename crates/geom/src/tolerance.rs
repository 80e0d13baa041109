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

/// How far, *relative*, the skeleton's check lets a clearance lie from the distance to the boundary: offsets inherit
/// this error, and it is a tenth of what the exact offset engine promises.
pub const CHECK_CLEARANCE: f64 = 1e-8;

/// Vertices farther off than this, *relative*, are counted by the skeleton's check: what well-conditioned input gives,
/// with three digits to spare above rounding.
pub const CHECK_TIGHT: f64 = 1e-11;

/// How far, *relative*, a foot may miss its site's extent or run backwards in the skeleton's check. Clearance feels
/// only the square of such a slip.
pub const CHECK_FOOT: f64 = 1e-8;

/// By how much, as a part of it, the areas of the Voronoi cells may miss the region's in the skeleton's check.
pub const CHECK_AREA: f64 = 1e-9;

/// The skeleton's check takes joints that turn by no more than this for smooth, radians: treating a joint of turn δ
/// so changes a clearance r by about rδ²/8, which is below 1e-10 r.
pub const CHECK_SMOOTH_TURN: f64 = 2e-5;

/// Nearer than this, *relative*, to an element's centre of curvature the skeleton's check takes the foot there as
/// undefined: an error of a rounding unit would turn it by more than 1e-6.
pub const CHECK_FLOATING: f64 = 1e-9;

/// Relative error of numerical integration: a hundred rounding units.
pub const QUADRATURE: f64 = 1e-14;
