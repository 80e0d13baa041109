//! Drawings in, programs and pictures out.

pub mod import;
