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

/// Arcs lie on one circle where centre and radius agree to this; they then share both exactly. *Relative*, and of the
/// order of rounding: their ends stay, and must lie on the circle as exactly as the skeleton computes.
pub const SAME_CIRCLE: f64 = 1e-13;

/// Two contours that nowhere lie farther apart than this are one curve drawn twice, and a sliver no wider than this
/// between two curves that cross is what rounding made of a tangency. *Relative*, and never above the join tolerance:
/// a channel as narrow holds no tool, so nothing that can be milled is lost.
pub const NARROW: f64 = 1e-5;

/// Where a loop crosses itself, a stretch between that is no larger than this is a slip of the pen, if it strays no farther
/// than the join tolerance from what stays. *Relative.*
pub const CURL: f64 = 2e-3;

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

/// How far, *relative*, a foot may miss its site's extent or run backwards in the skeleton's check, wherever clearance
/// can feel it: it feels a slip s by s²/2r, so that vertices are known no better along a bottleneck.
pub const CHECK_FOOT: f64 = 1e-8;

/// By how much, as a part of it, the areas of the Voronoi cells may miss the region's in the skeleton's check.
pub const CHECK_AREA: f64 = 1e-9;

/// The skeleton's check takes joints that turn by no more than this for smooth, radians: treating a joint of turn δ
/// so changes a clearance r by about rδ²/8, which is below 1e-10 r.
pub const CHECK_SMOOTH_TURN: f64 = 2e-5;

/// Nearer than this, *relative*, to an element's centre of curvature the skeleton's check takes the foot there as
/// undefined: its direction is rounding.
pub const CHECK_FLOATING: f64 = 1e-14;

/// Error of the integrated heights of cells, *relative*: a thousandth of what the cells' areas are held to.
pub const QUADRATURE: f64 = 1e-12;

/// Offset segments shorter than this are dropped and their ends merged, *relative*: some thousand times the rounding
/// of coordinates, so that what goes is noise, and a thousandth of what an offset may be off.
pub const OFFSET_DROP: f64 = 1e-12;

/// Skeleton edges whose clearance changes by no more than this are constant, *relative*: above the rounding of
/// clearances, below any taper that a drawing means.
pub const PLATEAU: f64 = 1e-11;

/// One minus the rate at which clearance grows along an edge, below which the edge runs straight away from its sites
/// (a spoke, or the bisector at a joint that is smooth but for rounding).
pub const SPOKE_RATE: f64 = 1e-9;

/// Along an edge whose clearance changes by no more than this, *relative*, clearance tells no places apart: rounding would
/// misplace them by more than a thousandth of the edge.
pub const FLAT_EDGE: f64 = 1e-9;

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

/// How far chords may lie from the arcs that they stand for in pair-wise offsets, mm: a quarter of [`GOUGE`], which the proof leaves at walls.
pub const CHORDS: f64 = 5e-4;

/// [`CHORDS`] as a share of the offset distance, for tools so small that it would count.
pub const CHORDS_SHARE: f64 = 2.5e-3;

/// Ends of degenerate paths shorter than this share of the offset distance are left out: the disk at their root covers
/// their disks but for slivers thinner than what may stay uncut.
pub const SPUR_SHARE: f64 = 1e-3;

/// How exactly the deepest place of what a tool leaves is found, as a share of its radius: some thousand times the rounding of
/// distances, and far below anything that a tolerance asks for.
pub const DEPTH: f64 = 1e-12;

/// Longest step along a clean-up path where clearance need not be convex, as a share of the tool's radius: between its ends
/// what must be served bows out by less than 1e-4 of the radius, half of what the proof lets pass.
pub const CLEANUP_STEP: f64 = 1.0 / 32.0;

/// How far the end of a straight step towards a wall may miss the loop that it leads to, *relative*: what offsets may be
/// off, ten times over.
pub const LANDING: f64 = 1e-6;

/// A landing this near to the end of a loop's segment is moved there, *relative*: it would leave a piece shorter than what
/// offsets may be off, of which an arc could turn round.
pub const LANDING_SNAP: f64 = 1e-8;

/// Tolerances of the pair-wise offset engine.
pub mod pairwise {
    /// Sine of the turn between segments below which a joint is smooth: its two normals are one.
    pub const SMOOTH_TURN: f64 = 1e-12;

    /// By how much, as a part of the distance, a point must be nearer to a wall to be within its reach: some thousand times the
    /// rounding of distances, so that a point that two offsets share is not taken for one.
    pub const WITHIN: f64 = 1e-12;

    /// Raw curves farther from the boundary than the distance less this are on the offset, *relative*: ten thousand times the
    /// rounding of a point in the middle of a piece, and next to nothing of what raw curves dip below the offset between crossings,
    /// where they are nearly parallel.
    pub const CLEARANCE: f64 = 1e-11;

    /// So many times the length of edges that were left out is added to it.
    pub const STRAYED: f64 = 16.0;

    /// Runs between crossings no longer than this are not asked for their clearance, *relative*: below what an offset may
    /// be off, above the rounding of crossings.
    pub const SHORTEST_RUN: f64 = 2e-8;

    /// Step by which the distance grows where raw curves contradict themselves, *relative*: above the rounding that
    /// makes them, and with all attempts still far below what an offset may be off.
    pub const PERTURBATION: f64 = 1e-9;

    /// Edges no longer are left out, *relative*: a twentieth of [`SHORTEST_RUN`], so that their ends are judged alike.
    pub const WELD: f64 = 1e-9;

    /// How often it may grow.
    pub const ATTEMPTS: u32 = 12;
}

/// Tolerances of the proof of a written program.
pub mod proof {
    /// A program may gouge by no more than this part of the tool's radius, where that is less than [`GOUGE`](super::GOUGE).
    pub const GOUGE_PER_RADIUS: f64 = 0.01;

    /// Material counts as left uncut where the tool stays farther from it than this part of its radius (or [`GOUGE`](super::GOUGE), where that is more).
    pub const COVER_PER_RADIUS: f64 = 2e-4;

    /// Rounding of a distance computed by the proof from coordinates, as a part of the largest coordinate: some 250 units in
    /// the last place, several times what its longest chain of operations loses.
    pub const ROUNDING: f64 = 256.0 * f64::EPSILON;

    /// The share of the cover tolerance by which a profile must keep clear of walls for a place to be expected of it. In a sharp
    /// corner of its admissible places, of angle φ, their outline lies 1/sin(φ/2) times as far from that without any clearance, and
    /// yet must lie within the cover tolerance of the path: so down to some 20 degrees.
    pub const PROFILE_REACH_SHARE: f64 = 0.125;

    /// Arcs that lie nearer than this part of the gouge limit to their chords are judged as their chords (and the limit tightened).
    pub const FLATNESS: f64 = 1e-3;

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

    /// How deep a roughing program may enter the model, or the stock to leave, along the normal, mm.
    pub const ROUGH_GOUGE: f64 = 0.01;

    /// The deepest point of an edge inside a cutter is sought to within this, mm: depth changes no faster, so that is its error
    /// at most, a hundredth of [`ROUGH_GOUGE`].
    pub const NARROWED: f64 = 1e-4;

    /// Two curves that turn back on one another within this angle make a cusp, where the sign of the turn tells nothing.
    pub const CUSP: f64 = 1e-5;
}

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

/// Tolerances of the places at which a tool profile may be, *relative* unless said otherwise.
pub mod profile {
    /// Attempts, the first one with the region as it is.
    pub const ATTEMPTS: i32 = 10;
    /// By how much more walls are moved in every other attempt; the first moves them by the touch length.
    pub const RANGE_GROWTH: f64 = 10.0;
    /// The angle by which a profile is turned to the left at first, radians: what a wall that is parallel to an edge and an arc next to it
    /// are apart then, a part of 5e-16 of the radius, is about rounding for flat arcs and tells for all after another attempt or two. A tool of
    /// 10 mm is off by less than a nanometre.
    pub const FIRST_TURN: f64 = 3e-8;
    /// By how much more in every other attempt.
    pub const TURN_GROWTH: f64 = 4.0;
    /// By how much a wall must come deeper than asked to be deeper, in units of the length asked.
    pub const DECIDED: f64 = 1e-2;
    /// An open chain whose longest part is shorter than this many touch lengths tells nothing.
    pub const LEAST_LENGTH: f64 = 64.0;
    /// Edges of a region shorter than this many touch lengths, or ranges of moved corners, are left out.
    pub const SHORTEST: f64 = 16.0;
    /// Arcs that sweep less are lines, radians.
    pub const FLAT_SWEEP: f64 = 1e-12;
    /// Bends of no more than this, radians, are passed over where the profile touches nothing in them: what its two sides, a distance
    /// `r` away, lack of their crossing is a part of 2.5e-11 of `r`, and where that is rounding would decide. Joints of short arcs with
    /// six decimals bend as much.
    pub const SLIGHT: f64 = 5e-6;
    /// How deep a wall may come into a turning profile and still count as touching.
    pub const ENTERED: f64 = 1e-9;
    /// Directions nearer than this are the same, radians.
    pub const PARALLEL: f64 = 1e-9;
    /// Where a turning profile's direction jumps by less, it goes on: a point 20 mm away then moves by 0.0002 mm, a tenth of the gouge
    /// tolerance. Radians.
    pub const SMOOTH_TURN: f64 = 1e-5;
}

/// Tolerances of the bisector engine, *relative* unless said otherwise.
pub mod bisector {
    /// By how much raw corners are moved where they are degenerate, at first: some thousand times the rounding of
    /// coordinates, so that nearly all orders are certain, and far below what an offset may be off.
    pub const FIRST_RANGE: f64 = 1e-12;
    /// By how much more in each further attempt.
    pub const RANGE_GROWTH: f64 = 10.0;
    /// Attempts, the first one with the corners as they are: the last one moves corners by 1e-8.
    pub const ATTEMPTS: u64 = 6;
    /// Loops nowhere wider than this many ranges are made by the moved corners.
    pub const SLIVER: f64 = 16.0;
    /// Sine of the least turn between two edges that are extended to where they meet: flatter ones meet at a place that
    /// rounding decides.
    pub const EXTENDED_TURN: f64 = 1e-6;
    /// How far a loop may enter the strip of an edge that others are to cover: ten times what moved corners cost.
    pub const STRIP_SLACK: f64 = 1e-8;
    /// How far beyond a cell edges count as passing through it, in cells: far above rounding, and next to no cost.
    pub const GRID_PAD: f64 = 1e-6;
}

/// Tolerances of the skeleton's construction, *relative*: it computes in a frame scaled to size 0.5 … 1.
pub mod skeleton {
    /// A disk is empty if no site reaches deeper into it than this. Some ten times the rounding of a distance.
    pub const EMPTY: f64 = 1e-12;
    /// Residual of a vertex at which no refinement can gain any more: a few units of rounding.
    pub const EXACT: f64 = 1e-15;
    /// Residual up to which a closed-form vertex is believed; above it the bracketed search takes over.
    pub const RESIDUAL: f64 = 3e-13;
    /// The same for a vertex that the search has found, and how deep an element may reach into its disk; above it the
    /// construction starts again from elsewhere.
    pub const SOUND: f64 = 1e-10;
    /// How far outside its element's extent the foot of a vertex may fall: feet are the worst-conditioned
    /// numbers (an error of the clearance by `e` moves a foot by `sqrt(e)` at nearly tangent contacts).
    pub const FOOT: f64 = 1e-9;
    /// The same for vertices in closed form; where their feet are worse, the bracketed search looks again.
    pub const EXTENT: f64 = 1e-11;
    /// Contacts nearer to one another than this count as being in order around the disk.
    pub const ORDER: f64 = 1e-18;
    /// Newton steps on the three gaps of a vertex.
    pub const NEWTON_STEPS: usize = 2;
    /// Turn, radians, below which a joint is smooth: the spoke then stands for both normals, and the feet of the two
    /// cells, whose directions it mixes up, miss by no more than half of it.
    pub const SMOOTH: f64 = 1e-9;
    /// Turn from a cusp of angle 0 or 2π, radians, below which curvature and not direction tells which it is.
    pub const CUSP: f64 = 1e-5;
    /// Two disks nearer to one another than this are one vertex of higher degree, verified already.
    pub const SAME_DISK: f64 = 1e-14;
    /// Where the growth of a disk from a contact starts, and where it is given up: nothing is larger than the frame.
    pub const FIRST_PROBE: f64 = 1.0 / 1024.0;
    /// No disk inside the region is as large as this.
    pub const LARGEST_DISK: f64 = 2.0;
    /// Extrema that stand out by less are none: nearly constant clearance has its apexes anywhere.
    pub const LEVEL: f64 = 1e-10;
    /// A neighbour on the wall may own the contact of a disk that misses it by no more than this.
    pub const REACH: f64 = 1e-7;
    /// Samples of a walk before it is bisected.
    pub const SAMPLES: u32 = 24;
    /// Steps along the wall from an element to the one that owns a contact: reflex vertex and cut pieces between.
    pub const HOPS: usize = 6;
    /// Corrections of a guess before the bracketed search takes over; two or three are usual.
    pub const GUESSES: usize = 200;
    /// Width, of an interval from 0 to 1, at which a bisection has converged.
    pub const BISECTION: f64 = 1e-18;
}

/// Tolerances of the CL-surface and of what is made of it.
pub mod surface {
    /// How far the contour lines of a CL-surface may lie from it in the plane, mm: that of written programs.
    pub const CONTOUR: f64 = super::GOUGE;
    /// How far the simplified contour lines may lie from the full ones, mm.
    pub const SIMPLIFY: f64 = super::GOUGE;
    /// How far inside its contour lines the tool's axis stays in roughing, mm: what both of the above may take.
    pub const INSET: f64 = CONTOUR + SIMPLIFY;
    /// The tip may go this much below the CL-surface, mm, so that rounding does not lose a floor at a level's very height.
    pub const LEVEL: f64 = 1e-6;
    /// A touch point counts as inside a facet up to this share of its area beyond a side: some thousand times the rounding.
    pub const INSIDE: f64 = 1e-12;
    /// The height asked for by an edge is known to this, mm: a thousandth of what levels may be off.
    pub const CONTACT: f64 = 1e-9;
    /// Steps of the search for a contact along an edge; some ten reach rounding.
    pub const CONTACT_STEPS: usize = 60;
    /// Share of the contour tolerance to which a point of a contour line is settled.
    pub const SETTLED: f64 = 0.1;
}
