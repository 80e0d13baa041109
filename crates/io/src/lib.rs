//! Drawings in, programs and pictures out: importers, posts, plots and exports. Nothing but the importers touches files.

pub mod export;
pub mod import;
pub mod plot;
pub mod post;
