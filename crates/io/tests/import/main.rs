//! Drawings read as a user gives them.

mod corpus;
mod dxf;
mod garbled;
mod json;
mod mesh;
mod svg;
