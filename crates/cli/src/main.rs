//! The `pocketry` command: typed arguments become settings, settings become a run. Only this crate touches files and clock.

mod args;
mod batch;
mod console;
mod drawing;
mod failure;
mod info;
mod job;
mod model;
mod offset;
mod output;
mod picture;
mod pocket;
mod report;
mod rough;
mod rough_picture;
mod settings;
mod skeleton;
mod slice;
mod study;
mod subpockets;
mod tool_profile;
mod toolbox;
mod verify;

use args::{Cli, Command};
use clap::Parser;
use failure::{Exit, Failure};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;

fn main() -> ExitCode {
    let cli = Cli::parse();
    let result = catch_unwind(AssertUnwindSafe(|| run(&cli.command)))
        .unwrap_or_else(|payload| Err(Failure::panicked(&*payload)));
    let exit = result.unwrap_or_else(|failure| {
        console::failure(&failure);
        failure.exit
    });
    ExitCode::from(exit as u8)
}

fn run(command: &Command) -> Result<Exit, Failure> {
    match command {
        Command::Pocket(args) if batch::is_batch(&args.input) => return batch::run(args),
        Command::Pocket(args) => pocket::run(args)?,
        Command::Offset(args) => offset::run(args)?,
        Command::Skeleton(args) => skeleton::run(args)?,
        Command::Subpockets(args) => subpockets::run(args)?,
        Command::Verify(args) => verify::run(args)?,
        Command::Study(args) => study::run(args)?,
        Command::Rough(args) => rough::run(args)?,
        Command::Slice(args) => slice::run(args)?,
        Command::Info(args) => info::run(args)?,
    }
    Ok(Exit::Done)
}
