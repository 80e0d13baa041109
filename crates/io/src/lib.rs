//! Drawings in, programs and pictures out: importers, posts, plots and exports. Text only; files are the caller's.

pub mod export;
pub mod plot;
pub mod post;

//! Drawings in, programs and pictures out.

pub mod import;
