//! The command from outside, and the rules of the workspace.

mod batch;
mod command;
mod model;
mod profile;
mod support;
mod workspace;
