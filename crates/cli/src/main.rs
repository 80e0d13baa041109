//! The `pocketry` command.

fn main() {}
