//! Mitre offsets, and erosions by polygons, against their definitions and against an independent implementation.

mod corpus;
mod definition;
mod peer;
mod shapes;
mod sums;
