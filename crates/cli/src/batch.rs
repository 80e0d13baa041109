//! `pocketry pocket` for JSON lines: one program and one report line for each region, on all cores.

use crate::args::PocketArgs;
use crate::console;
use crate::drawing;
use crate::failure::{Exit, Failure};
use crate::job;
use crate::output::{print, write_file};
use crate::report::{JobReport, Status};
use crate::settings::Settings;
use indicatif::{ProgressBar, ProgressStyle};
use pocketry_io::import::{self, BatchLine};
use rayon::prelude::*;
use std::collections::HashSet;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Whether a drawing is a batch.
pub(crate) fn is_batch(input: &Path) -> bool {
    input.extension().is_some_and(|e| e.eq_ignore_ascii_case("jsonl") || e.eq_ignore_ascii_case("ndjson"))
}

/// Runs every line; the exit code is the highest of them.
pub(crate) fn run(args: &PocketArgs) -> Result<Exit, Failure> {
    let Some(folder) = &args.out_dir else {
        return Err(Failure::arguments("a batch needs a folder for its programs: --out-dir DIR"));
    };
    if args.output.is_some() || args.plot.is_some() {
        return Err(Failure::arguments("-o and --plot are for single drawings; a batch writes into --out-dir"));
    }
    let lines = import::read_batch(&args.input).map_err(|e| drawing::failure(&e))?;
    if lines.is_empty() {
        return Err(Failure::new(Exit::BadInput, "empty", format!("{}: no region in it", args.input.display())));
    }
    std::fs::create_dir_all(folder).map_err(|e| Failure::write(folder, e))?;
    let ids = unique_ids(&lines);
    let profile = args.tool_profile.as_ref().map(|p| p.shape(&args.drawing)).transpose()?;
    let settings = Settings::new(args.tool, args.cut.clone(), args.machine.clone()).with_profile(profile, args.turning);
    let bar = progress(lines.len());
    let done: Vec<(JobReport, Exit)> = lines
        .par_iter()
        .zip(&ids)
        .map(|(line, id)| {
            let result = one(line, id, folder, args, &settings);
            bar.inc(1);
            result
        })
        .collect();
    bar.finish_and_clear();

    if let Some(path) = &args.report {
        write_file(path, &done.iter().map(|(report, _)| report.to_line()).collect::<String>())?;
    }
    summarise(&done)?;
    Ok(done.iter().map(|(_, exit)| *exit).max().unwrap_or(Exit::Done))
}

/// One line, whatever happens in it.
fn one(line: &BatchLine, id: &str, folder: &Path, args: &PocketArgs, settings: &Settings) -> (JobReport, Exit) {
    let begun = Instant::now();
    let mut report = JobReport::named(id.to_owned());
    let result = catch_unwind(AssertUnwindSafe(|| program(line, folder, args, settings, &mut report)))
        .unwrap_or_else(|payload| Err(Failure::panicked(&*payload)));
    let exit = match result {
        Ok(()) => Exit::Done,
        Err(failure) => {
            report.fail(&failure);
            failure.exit
        }
    };
    report.details = None;
    report.seconds = begun.elapsed().as_secs_f64();
    (report, exit)
}

fn program(
    line: &BatchLine,
    folder: &Path,
    args: &PocketArgs,
    settings: &Settings,
    report: &mut JobReport,
) -> Result<(), Failure> {
    let mut drawing = drawing::parse(&line.text, &args.drawing).map_err(|mut failure| {
        failure.message = format!("{}:{}: {}", args.input.display(), line.line, failure.message);
        failure
    })?;
    let proven = job::run(&mut drawing, settings, report)?;
    let path: PathBuf = folder.join(file_name(&report.id));
    write_file(&path, &proven.text)?;
    report.program = Some(path.display().to_string());
    Ok(())
}

/// `<id with every character outside [A-Za-z0-9._-] replaced by _>.ngc`
fn file_name(id: &str) -> String {
    let clean: String =
        id.chars().map(|c| if c.is_ascii_alphanumeric() || "._-".contains(c) { c } else { '_' }).collect();
    format!("{clean}.ngc")
}

/// Ids whose files are different: a missing or clashing one gets `-<line number>`.
fn unique_ids(lines: &[BatchLine]) -> Vec<String> {
    let mut taken = HashSet::new();
    lines
        .iter()
        .map(|line| {
            let mut id = line.id.clone().filter(|id| !id.is_empty()).unwrap_or_default();
            while id.is_empty() || !taken.insert(file_name(&id)) {
                id = format!("{}-{}", if id.is_empty() { "region" } else { &id }, line.line);
            }
            id
        })
        .collect()
}

fn progress(count: usize) -> ProgressBar {
    // Hidden by itself where standard error is no terminal.
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} regions, {eta} left");
    ProgressBar::new(count as u64).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

fn summarise(done: &[(JobReport, Exit)]) -> Result<(), Failure> {
    let count = |status| done.iter().filter(|(r, _)| r.status == status).count();
    let troubles: Vec<String> =
        done.iter().filter_map(|(r, _)| r.error.as_ref().map(|e| format!("{}: {e}", r.id))).collect();
    console::warnings(&troubles);
    let (proven, refused, failed) = (count(Status::Proven), count(Status::Refused), count(Status::Failed));
    print(&format!("{} regions: {proven} proven and written, {refused} refused, {failed} failed\n", done.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_become_distinct_file_names() {
        let line = |line, id: Option<&str>| BatchLine { line, id: id.map(str::to_owned), text: String::new() };
        let lines =
            [line(1, Some("a/b")), line(2, None), line(4, Some("a_b")), line(5, Some("a/b")), line(6, Some("é-1.x"))];
        assert_eq!(unique_ids(&lines), ["a/b", "region-2", "a_b-4", "a/b-5", "é-1.x"]);
        assert_eq!(file_name("é-1.x /"), "_-1.x__.ngc");
    }
}
