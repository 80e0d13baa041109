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

/// A bulge below this is none: the edge bows by less than a billionth of its length.
pub const FLAT_BULGE: f64 = 1e-9;

/// The least weight of a spline's control point, as a share of the largest: below it the curve is a number's accident.
pub const LEAST_WEIGHT: f64 = 1e-9;

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
/// Tolerances of the skeleton's construction, *relative*: it computes in a frame scaled to size 0.5 … 1.
pub mod skeleton {
    /// A disk is empty if no site reaches deeper into it than this. Some ten times the rounding of a distance.
    pub const EMPTY: f64 = 1e-12;
    /// Residual of a vertex at which no refinement can gain any more: a few units of rounding.
    pub const EXACT: f64 = 1e-15;
    /// Residual up to which a closed-form vertex is believed; above it the bracketed search takes over.
    pub const RESIDUAL: f64 = 3e-13;
    /// How far outside its element's extent the foot of a vertex may fall: feet are the worst-conditioned
    /// numbers (an error of the clearance by `e` moves a foot by `sqrt(e)` at nearly tangent contacts).
    pub const FOOT: f64 = 1e-9;
    /// The same for vertices in closed form; where their feet are worse, the bracketed search looks again.
    pub const EXTENT: f64 = 1e-11;
    /// Contacts nearer to one another than this count as being in order around the disk.
    pub const ORDER: f64 = 1e-18;
    /// Newton steps on the three gaps of a vertex.
    pub const NEWTON_STEPS: usize = 2;
    /// Turn between two lines, radians, below which their joint is smooth: the clearance on its normal is then off by
    /// at most an eighth of the square.
    pub const SMOOTH_LINES: f64 = 1e-5;
    /// Turn, radians, below which a joint with an arc is smooth.
    pub const SMOOTH_ARCS: f64 = 1e-9;
    /// Turn from a cusp of angle 0 or 2π, radians, below which curvature and not direction tells which it is.
    pub const CUSP: f64 = 1e-9;
    /// Two disks nearer to one another than this are one vertex of higher degree, verified already.
    pub const SAME_DISK: f64 = 1e-14;
    /// Where the growth of a disk from a contact starts, and where it is given up: nothing is larger than the frame.
    pub const FIRST_PROBE: f64 = 1.0 / 1024.0;
    /// No disk inside the region is as large as this.
    pub const LARGEST_DISK: f64 = 2.0;
    /// Corrections of a guess before the bracketed search takes over; two or three are usual.
    pub const GUESSES: usize = 200;
    /// Width, of an interval from 0 to 1, at which a bisection has converged.
    pub const BISECTION: f64 = 1e-18;
}
