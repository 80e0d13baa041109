//! Mitre offsets against their definition and against an independent implementation.

mod corpus;
mod definition;
mod peer;
mod shapes;
