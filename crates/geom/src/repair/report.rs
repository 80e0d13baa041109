//! What repair has to say: errors and notes, in the words of who draws and mills.

use crate::point::Point;
use std::fmt;

/// Why no region can be made of the loops; loops are named by their places in the input, counted from 0 in the fields
/// and from 1 in the text.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RegionError {
    /// A coordinate is not a number or infinite.
    #[error("contour {} has a coordinate that is no finite number, at vertex {}; correct or delete that entity", .contour + 1, .vertex + 1)]
    NotFinite {
        /// The loop.
        contour: u32,
        /// The edge that starts with the bad number.
        vertex: u32,
    },
    /// A coordinate or radius is far beyond any part.
    #[error("contour {} reaches to {}: no drawing of a part is that large; check the units or delete that entity", .contour + 1, Place(*.at))]
    Absurd {
        /// The loop.
        contour: u32,
        /// A point of it.
        at: Point,
    },
    /// Everything together is smaller than can be told from one point.
    #[error("all contours together measure {size:e} mm at {}, too small to be told from a point; check the units", Place(*.at))]
    TooSmall {
        /// The larger extent, mm.
        size: f64,
        /// Where it is.
        at: Point,
    },
    /// An edge doesn't start where the one before it ends.
    #[error("contour {} is open: a gap of {gap:.6} mm at {}; close it in the drawing", .contour + 1, Place(*.at))]
    Open {
        /// The loop.
        contour: u32,
        /// Where the gap begins.
        at: Point,
        /// Its width, mm.
        gap: f64,
    },
    /// Edges cross.
    #[error("{} at {}; trim or move one of them so that inside and outside are clear", Crossed(*.first, *.second), Place(*.at))]
    Crossing {
        /// One loop.
        first: u32,
        /// The other one, perhaps the same.
        second: u32,
        /// Where they cross.
        at: Point,
    },
    /// Nothing encloses an area.
    #[error("{}: nothing to mill", Empty(*.loops))]
    Nothing {
        /// How many loops there were.
        loops: usize,
        /// Where they were.
        at: Point,
    },
}

/// Something that was changed on the way to a region; loops are named as in [`RegionError`].
#[derive(Clone, Debug, PartialEq)]
pub enum Note {
    /// Edges of no length were dropped.
    ZeroLength {
        /// The loop.
        contour: u32,
        /// How many.
        count: usize,
        /// The first of them.
        at: Point,
    },
    /// A small gap between two edges was closed.
    Closed {
        /// The loop.
        contour: u32,
        /// Where.
        at: Point,
        /// Its width, mm.
        gap: f64,
    },
    /// A loop that encloses nothing was dropped.
    ZeroArea {
        /// The loop.
        contour: u32,
        /// A point of it.
        at: Point,
    },
    /// A loop that repeats another one was dropped.
    Duplicate {
        /// The loop that was dropped.
        contour: u32,
        /// The one that was kept.
        kept: u32,
        /// A point of it.
        at: Point,
    },
    /// A piece of a loop that runs back on itself was cut off.
    Spike {
        /// The loop.
        contour: u32,
        /// Where.
        at: Point,
    },
    /// A loop crossed itself and came back to the same place at once: what lay between was cut off.
    Curl {
        /// The loop.
        contour: u32,
        /// Where.
        at: Point,
        /// How large it was, mm.
        size: f64,
    },
    /// Two loops run along one another: the shared piece is no wall, the areas on its two sides join.
    Shared {
        /// One loop.
        first: u32,
        /// The other one.
        second: u32,
        /// The start of the shared piece.
        at: Point,
    },
    /// Loops overlap by next to nothing, as tangent curves with rounded numbers do: they were cut where they cross and the
    /// sliver between was dropped.
    Overlap {
        /// One loop.
        first: u32,
        /// The other one, perhaps the same.
        second: u32,
        /// Where the sliver begins.
        at: Point,
        /// How long it is, mm.
        length: f64,
    },
    /// Loops touch in a single point, which became a corner of both.
    Touch {
        /// One loop.
        first: u32,
        /// The other one, perhaps the same.
        second: u32,
        /// Where.
        at: Point,
    },
}

impl Note {
    /// Where it is.
    pub const fn at(&self) -> Point {
        match *self {
            Self::ZeroLength { at, .. }
            | Self::Closed { at, .. }
            | Self::ZeroArea { at, .. }
            | Self::Duplicate { at, .. }
            | Self::Spike { at, .. }
            | Self::Curl { at, .. }
            | Self::Shared { at, .. }
            | Self::Overlap { at, .. }
            | Self::Touch { at, .. } => at,
        }
    }

    /// The loop that it is about, and the other one where two are.
    pub const fn contours(&self) -> (u32, Option<u32>) {
        match *self {
            Self::ZeroLength { contour, .. }
            | Self::Closed { contour, .. }
            | Self::ZeroArea { contour, .. }
            | Self::Spike { contour, .. }
            | Self::Curl { contour, .. } => (contour, None),
            Self::Duplicate { contour, kept, .. } => (contour, Some(kept)),
            Self::Shared { first, second, .. }
            | Self::Overlap { first, second, .. }
            | Self::Touch { first, second, .. } => (first, Some(second)),
        }
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let at = Place(self.at());
        match *self {
            Self::ZeroLength { contour, count, .. } => {
                write!(f, "contour {}: dropped {count} edge(s) without length, the first at {at}", contour + 1)
            }
            Self::Closed { contour, gap, .. } => {
                write!(f, "contour {}: closed a gap of {gap:e} mm at {at}", contour + 1)
            }
            Self::ZeroArea { contour, .. } => {
                write!(f, "contour {} at {at} encloses no area: dropped", contour + 1)
            }
            Self::Duplicate { contour, kept, .. } => {
                write!(f, "contour {} at {at} repeats contour {}: dropped", contour + 1, kept + 1)
            }
            Self::Spike { contour, .. } => {
                write!(f, "contour {} runs back on itself at {at}: the spike was cut off", contour + 1)
            }
            Self::Curl { contour, size, .. } => {
                write!(f, "contour {} crosses itself at {at}: a curl of {size:.3e} mm was cut off", contour + 1)
            }
            Self::Shared { first, second, .. } => {
                let (first, second) = (first + 1, second + 1);
                write!(f, "contours {first} and {second} share an edge at {at}: the areas on its sides were joined")
            }
            Self::Overlap { first, second, length, .. } if first == second => {
                write!(f, "contour {} overlaps itself by a sliver of {length:.3e} mm at {at}: dropped", first + 1)
            }
            Self::Overlap { first, second, length, .. } => {
                let (first, second) = (first + 1, second + 1);
                write!(f, "contours {first} and {second} overlap by a sliver of {length:.3e} mm at {at}: dropped")
            }
            Self::Touch { first, second, .. } if first == second => {
                write!(f, "contour {} touches itself at {at}: taken as it is", first + 1)
            }
            Self::Touch { first, second, .. } => {
                write!(f, "contours {} and {} touch at {at}: taken as they are", first + 1, second + 1)
            }
        }
    }
}

/// A place in the drawing.
struct Place(Point);

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({:.4}, {:.4})", self.0.x, self.0.y)
    }
}

/// Who crosses whom.
struct Crossed(u32, u32);

impl fmt::Display for Crossed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0 == self.1 {
            write!(f, "contour {} crosses itself", self.0 + 1)
        } else {
            write!(f, "contours {} and {} cross each other", self.0 + 1, self.1 + 1)
        }
    }
}

/// Why there is nothing.
struct Empty(usize);

impl fmt::Display for Empty {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            0 => f.write_str("there is no closed contour"),
            1 => f.write_str("the only closed contour encloses no area"),
            n => write!(f, "none of the {n} closed contours encloses an area"),
        }
    }
}
