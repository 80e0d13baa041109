//! Drawings read as a user gives them.

mod corpus;
mod dxf;
mod json;
mod svg;
