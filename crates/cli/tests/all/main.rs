//! The command from outside, and the rules of the workspace.

mod batch;
mod command;
mod model;
mod support;
mod workspace;
