//! Builds and checks the skeletons of whole corpus files.
//!
//! ```text
//! cargo run --release -p pocketry-geom --example skeleton_corpus -- [options] FILE.jsonl...
//!   --rotate RADIANS --mirror --scale K --translate X,Y --reverse --start N   transform the input first
//!   --only TEXT      regions whose id contains TEXT      --edges A..B   regions of so many edges
//!   --threads N      how many regions at a time (1)      --limit S      seconds a region may take (10)
//!   --brute N        measure regions of up to N segments against every segment (500)
//!   --samples N      points sampled within each edge (5)
//!   --svg DIR        draw and list failing ones            --all          draw the others too
//!   --json DIR       write failing regions' loops        --minimise DIR write reduced loops that fail alike
//!   --faults N       faults printed for each region (3)  --quiet        only the table
//!   --give-up N      leave a file after N regions that ran into the limit (3)
//! ```

use pocketry_geom::Region;
use pocketry_geom::skeleton::Skeleton;
use pocketry_geom::skeleton::check::{CheckOptions, CheckReport};
use pocketry_testkit::corpus::{self, Record};
use pocketry_testkit::minimise::minimise;
use pocketry_testkit::{Loops, Transform, picture};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::{Duration, Instant};

#[derive(Clone, Debug)]
struct Options {
    files: Vec<PathBuf>,
    transform: Transform,
    only: String,
    edges: std::ops::Range<usize>,
    threads: usize,
    limit: Duration,
    check: CheckOptions,
    svg: Option<PathBuf>,
    all: bool,
    json: Option<PathBuf>,
    minimise: Option<PathBuf>,
    faults: usize,
    give_up: usize,
    quiet: bool,
}

/// How one region fared.
#[derive(Clone, Debug)]
enum Outcome {
    Checked { report: Box<CheckReport>, edges: usize, seconds: f64 },
    Refused(String),
    Failed(String),
    Panicked(String),
    TimedOut,
}

impl Outcome {
    /// A word for each way to fail; `None` where nothing is wrong.
    fn kind(&self) -> Option<String> {
        match self {
            Self::Checked { report, .. } if report.is_ok() => None,
            Self::Checked { report, .. } => report.counts.keys().next().map(|k| format!("{k:?}")),
            Self::Refused(_) => Some("region refused".into()),
            Self::Failed(_) => Some("build error".into()),
            Self::Panicked(_) => Some("panic".into()),
            Self::TimedOut => Some("time limit".into()),
        }
    }
}

#[derive(Default)]
struct Table {
    regions: usize,
    right: usize,
    over_tight: usize,
    vertices: usize,
    worst_vertex: f64,
    worst_edge: f64,
    worst_area: f64,
    slowest: f64,
    slowest_id: String,
    seconds: f64,
    edges: usize,
    kinds: BTreeMap<String, usize>,
}

fn main() {
    let options = match parse(std::env::args().skip(1)) {
        Ok(options) => Arc::new(options),
        Err(message) => {
            eprintln!("{message}");
            std::process::exit(2);
        }
    };
    std::panic::set_hook(Box::new(|_| {}));
    let mut tables = Vec::new();
    for file in &options.files {
        match corpus::read(file) {
            Ok(records) => tables.push((file.clone(), run_file(records, &options))),
            Err(error) => eprintln!("{}: {error}", file.display()),
        }
    }
    print_tables(&tables);
    let wrong: usize = tables.iter().map(|(_, t)| t.regions - t.right).sum();
    // Threads that ran into the time limit may still be at work: leave without waiting for them.
    std::process::exit(i32::from(wrong > 0));
}

fn parse(args: impl Iterator<Item = String>) -> Result<Options, String> {
    let mut o = Options {
        files: Vec::new(),
        transform: Transform::default(),
        only: String::new(),
        edges: 0..usize::MAX,
        threads: 1,
        limit: Duration::from_secs(10),
        check: CheckOptions::default(),
        svg: None,
        all: false,
        json: None,
        minimise: None,
        faults: 3,
        give_up: 3,
        quiet: false,
    };
    let mut args = args;
    while let Some(arg) = args.next() {
        let mut value = || args.next().ok_or(format!("{arg} needs a value"));
        match arg.as_str() {
            "--rotate" => o.transform.rotate = number(&value()?)?,
            "--mirror" => o.transform.mirror = true,
            "--scale" => o.transform.scale = number(&value()?)?,
            "--translate" => {
                let text = value()?;
                let (x, y) = text.split_once(',').ok_or("--translate X,Y")?;
                o.transform.translate = [number(x)?, number(y)?];
            }
            "--reverse" => o.transform.reverse = true,
            "--start" => o.transform.start = number(&value()?)?,
            "--only" => o.only = value()?,
            "--edges" => {
                let text = value()?;
                let (a, b) = text.split_once("..").ok_or("--edges A..B")?;
                o.edges = number(a)?..number(b)?;
            }
            "--threads" => o.threads = number(&value()?)?,
            "--limit" => o.limit = Duration::from_secs_f64(number(&value()?)?),
            "--brute" => o.check.brute_force_up_to = number(&value()?)?,
            "--samples" => o.check.samples = number(&value()?)?,
            "--svg" => o.svg = Some(value()?.into()),
            "--all" => o.all = true,
            "--json" => o.json = Some(value()?.into()),
            "--minimise" => o.minimise = Some(value()?.into()),
            "--faults" => o.faults = number(&value()?)?,
            "--give-up" => o.give_up = number(&value()?)?,
            "--quiet" => o.quiet = true,
            _ if arg.starts_with("--") => return Err(format!("unknown option {arg}")),
            _ => o.files.push(arg.into()),
        }
    }
    Ok(o)
}

fn number<T: std::str::FromStr>(text: &str) -> Result<T, String> {
    text.parse().map_err(|_| format!("not a number: {text}"))
}

fn run_file(records: Vec<Record>, options: &Arc<Options>) -> Table {
    let records: Vec<Record> = records
        .into_iter()
        .filter(|r| r.id.contains(&options.only))
        .filter(|r| options.edges.contains(&r.loops.iter().map(Vec::len).sum()))
        .map(|r| Record { loops: options.transform.apply(&r.loops), ..r })
        .collect();
    let (next, late) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let mut outcomes: Vec<(usize, Outcome)> = std::thread::scope(|scope| {
        let worker = || {
            let mut mine = Vec::new();
            // Threads left behind take the machine's time, so that soon all others would run into the limit too.
            while late.load(Ordering::Relaxed) < options.give_up
                && let Some(record) = records.get(next.fetch_add(1, Ordering::Relaxed))
            {
                let k = (std::ptr::from_ref(record) as usize - records.as_ptr() as usize) / size_of::<Record>();
                let outcome = watched(&record.loops, options);
                if matches!(outcome, Outcome::TimedOut) {
                    late.fetch_add(1, Ordering::Relaxed);
                }
                tell(record, &outcome, options);
                mine.push((k, outcome));
            }
            mine
        };
        let workers: Vec<_> = (0..options.threads.max(1)).map(|_| scope.spawn(worker)).collect();
        workers.into_iter().filter_map(|w| w.join().ok()).flatten().collect()
    });
    outcomes.sort_by_key(|(k, _)| *k);
    let mut table = Table::default();
    for (k, outcome) in &outcomes {
        table.add(&records[*k].id, outcome);
    }
    table
}

/// Builds and checks in a thread of its own, so that a region that takes too long can be left behind.
fn watched(loops: &Loops, options: &Arc<Options>) -> Outcome {
    let (send, receive) = mpsc::channel();
    let (loops, shared) = (loops.clone(), Arc::clone(options));
    std::thread::spawn(move || {
        let outcome = catch_unwind(AssertUnwindSafe(|| judge(&loops, &shared.check))).unwrap_or_else(|panic| {
            let text = panic.downcast_ref::<String>().cloned();
            Outcome::Panicked(text.or(panic.downcast_ref::<&str>().map(|s| (*s).into())).unwrap_or_default())
        });
        let _ = send.send(outcome);
    });
    match receive.recv_timeout(options.limit) {
        Ok(outcome) => outcome,
        Err(RecvTimeoutError::Timeout) => Outcome::TimedOut,
        Err(RecvTimeoutError::Disconnected) => Outcome::Panicked("the thread died".into()),
    }
}

fn judge(loops: &Loops, check: &CheckOptions) -> Outcome {
    let region = match corpus::region(loops) {
        Ok(region) => region,
        Err(error) => return Outcome::Refused(error.to_string()),
    };
    let clock = Instant::now();
    let skeleton = match Skeleton::build(&region) {
        Ok(skeleton) => skeleton,
        Err(error) => return Outcome::Failed(error.to_string()),
    };
    let seconds = clock.elapsed().as_secs_f64();
    Outcome::Checked { report: Box::new(skeleton.check(&region, check)), edges: region.edge_count(), seconds }
}

impl Table {
    fn add(&mut self, id: &str, outcome: &Outcome) {
        self.regions += 1;
        if let Some(kind) = outcome.kind() {
            *self.kinds.entry(kind).or_default() += 1;
        } else {
            self.right += 1;
        }
        if let Outcome::Checked { report, edges, seconds } = outcome {
            self.over_tight += report.over_tight;
            self.vertices += report.vertices;
            self.worst_vertex = self.worst_vertex.max(report.worst_vertex);
            self.worst_edge = self.worst_edge.max(report.worst_edge);
            self.worst_area = self.worst_area.max(report.area_error);
            self.seconds += seconds;
            self.edges += edges;
            let each = seconds / *edges as f64;
            if *edges >= 100 && each > self.slowest {
                self.slowest = each;
                self.slowest_id = id.into();
            }
        }
    }
}

fn tell(record: &Record, outcome: &Outcome, options: &Arc<Options>) {
    let Some(kind) = outcome.kind() else {
        if options.all {
            draw(record, outcome, options);
        }
        return;
    };
    if !options.quiet {
        let n: usize = record.loops.iter().map(Vec::len).sum();
        match outcome {
            Outcome::Checked { report, .. } => {
                println!("{} (n {n}): {report}", record.id);
                for fault in report.faults.iter().take(options.faults) {
                    println!("    {fault}");
                }
            }
            Outcome::Refused(text) | Outcome::Failed(text) | Outcome::Panicked(text) => {
                println!("{} (n {n}): {kind}: {text}", record.id);
            }
            Outcome::TimedOut => println!("{} (n {n}): {kind}", record.id),
        }
    }
    draw(record, outcome, options);
    if let Some(folder) = &options.json {
        write_loops(folder, &record.id, &record.loops);
    }
    if let Some(folder) = &options.minimise {
        let small = minimise(&record.loops, 3000, |l| watched(l, options).kind().as_ref() == Some(&kind));
        write_loops(folder, &record.id, &small);
    }
}

fn draw(record: &Record, outcome: &Outcome, options: &Options) {
    let (Some(folder), Outcome::Checked { report, .. }) = (&options.svg, outcome) else { return };
    let region: Region = match corpus::region(&record.loops) {
        Ok(region) => region,
        Err(_) => return,
    };
    let Ok(skeleton) = Skeleton::build(&region) else { return };
    let marks: Vec<_> = report.faults.iter().map(|f| f.place).collect();
    let drawn = catch_unwind(AssertUnwindSafe(|| picture::svg(&region, &skeleton, &marks)));
    if let Ok(text) = drawn {
        write(folder, &record.id, "svg", &text);
    }
    write(folder, &record.id, "txt", &listing(&skeleton));
}

/// Sites with the walks around their cells, and vertices, to read.
fn listing(skeleton: &Skeleton) -> String {
    let mut out = String::new();
    for (k, site) in skeleton.sites().iter().enumerate() {
        let steps: Vec<String> = skeleton
            .cell(k as u32)
            .take(100)
            .map(|e| format!("v{} -e{e}(s{})-> v{}", skeleton.origin(e), skeleton.site(e ^ 1), skeleton.target(e)))
            .collect();
        let _ = writeln!(out, "s{k} {}/{} {:?}\n    {}", site.contour, site.segment, site.shape, steps.join("; "));
    }
    for (k, v) in skeleton.vertices().iter().enumerate() {
        let _ = writeln!(out, "v{k} {:.17} {:.17} r {:e}", v.point.x, v.point.y, v.clearance);
    }
    out
}

fn write_loops(folder: &Path, id: &str, loops: &Loops) {
    let text = serde_json::json!({ "id": id, "units": "mm", "loops": loops }).to_string();
    write(folder, id, "json", &text);
}

fn write(folder: &Path, id: &str, extension: &str, text: &str) {
    let name: String =
        id.chars().map(|c| if c.is_ascii_alphanumeric() || "._-".contains(c) { c } else { '_' }).collect();
    let path = folder.join(format!("{name}.{extension}"));
    if let Err(error) = std::fs::create_dir_all(folder).and_then(|()| std::fs::write(&path, text)) {
        eprintln!("{}: {error}", path.display());
    }
}

fn print_tables(tables: &[(PathBuf, Table)]) {
    println!(
        "{:<20} {:>7} {:>7} {:>8} {:>9} {:>9} {:>9} {:>8} {:>8}  failures",
        "file", "regions", "right", ">tight", "vertex", "edge", "area", "µs/edge", "worst"
    );
    for (file, t) in tables {
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        let kinds: Vec<String> = t.kinds.iter().map(|(k, n)| format!("{n} {k}")).collect();
        println!(
            "{name:<20} {:>7} {:>7} {:>8} {:>9.1e} {:>9.1e} {:>9.1e} {:>8.2} {:>8.2}  {} [slowest {}]",
            t.regions,
            t.right,
            t.over_tight,
            t.worst_vertex,
            t.worst_edge,
            t.worst_area,
            1e6 * t.seconds / t.edges.max(1) as f64,
            1e6 * t.slowest,
            kinds.join(", "),
            t.slowest_id
        );
    }
}
