//! Rules of the workspace that the compiler can't see: who may see whom, where epsilons live, how long files are.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// Every Rust file below a folder.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut files = Vec::new();
    for path in entries.map(|e| e.unwrap().path()) {
        if path.is_dir() {
            files.extend(sources(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}

fn all_sources() -> Vec<PathBuf> {
    let crates = fs::read_dir(root().join("crates")).unwrap().map(|e| e.unwrap().path());
    crates.flat_map(|c| sources(&c)).collect()
}

/// The code of a file without comments and without its test module, line by line with line numbers.
fn code(path: &Path) -> Vec<(usize, String)> {
    let text = fs::read_to_string(path).unwrap();
    let numbered = text.lines().enumerate().map(|(k, line)| (k + 1, line.split("//").next().unwrap().to_owned()));
    numbered.take_while(|(_, line)| !line.trim_start().starts_with("#[cfg(test)]")).collect()
}

fn is_test(path: &Path) -> bool {
    path.components().any(|c| ["tests", "benches", "examples", "testkit"].iter().any(|t| c.as_os_str() == *t))
        || path.file_name().is_some_and(|n| n == "tests.rs" || n == "oracle.rs")
}

#[test]
fn crates_see_only_what_they_may() {
    let may: HashMap<&str, &[&str]> = HashMap::from([
        ("geom", &[][..]),
        ("motion", &["geom"]),
        ("cam", &["geom", "motion"]),
        ("verify", &["geom", "motion"]),
        ("io", &["geom", "motion"]),
        ("cli", &["geom", "motion", "cam", "verify", "io"]),
    ]);
    for (name, allowed) in may {
        let manifest = fs::read_to_string(root().join("crates").join(name).join("Cargo.toml")).unwrap();
        let shipped = manifest.split("[dev-dependencies]").next().unwrap();
        let seen = shipped.lines().filter_map(|l| l.strip_prefix("pocketry-")?.split(['.', ' ', '=']).next());
        for dependency in seen {
            assert!(allowed.contains(&dependency), "{name} must not depend on {dependency}");
        }
    }
}

#[test]
fn judges_and_posts_do_not_know_the_planners_geometry() {
    for name in ["verify", "io"] {
        for path in sources(&root().join("crates").join(name).join("src")) {
            for (line, text) in code(&path) {
                for word in ["skeleton::", "offset::", "::skeleton", "::offset", "pocketry_cam"] {
                    assert!(!text.contains(word), "{}:{line} names {word}", path.display());
                }
            }
        }
    }
}

/// Whether a line holds a float literal with a negative exponent, such as 1e-9.
fn has_epsilon(line: &str) -> bool {
    line.split(|c: char| !(c.is_ascii_alphanumeric() || c == '.' || c == '-' || c == '_')).any(|word| {
        let Some((mantissa, exponent)) = word.split_once("e-") else { return false };
        let digits = |s: &str| s.chars().next().is_some_and(|c| c.is_ascii_digit());
        digits(mantissa.trim_start_matches('-')) && digits(exponent)
    })
}

#[test]
fn epsilons_live_in_the_tolerance_module() {
    assert!(has_epsilon("if x < 1e-9 {") && has_epsilon("(2.5e-3)") && !has_epsilon("the-edge e-mail 1.0 e-1"));
    for path in all_sources().into_iter().filter(|p| !is_test(p) && !p.ends_with("geom/src/tolerance.rs")) {
        for (line, text) in code(&path) {
            assert!(!has_epsilon(&text), "{}:{line}: {}", path.display(), text.trim());
        }
    }
}

#[test]
fn files_are_short_enough_to_read() {
    let mut lengths = Vec::new();
    for path in all_sources() {
        let count = fs::read_to_string(&path).unwrap().lines().count();
        assert!(count <= 800, "{} has {count} lines", path.display());
        lengths.push(count);
    }
    lengths.sort_unstable();
    assert!(lengths[lengths.len() / 2] < 250, "the median file has {} lines", lengths[lengths.len() / 2]);
}

#[test]
fn nothing_is_left_undone_or_silenced() {
    for path in all_sources().into_iter().filter(|p| !p.ends_with("all/workspace.rs")) {
        for (line, text) in code(&path) {
            for word in ["todo!(", "unimplemented!(", "dbg!(", "allow(dead_code)", "unsafe {"] {
                assert!(!text.contains(word), "{}:{line} has {word}", path.display());
            }
        }
    }
}

#[test]
fn every_dependency_is_explained() {
    let manifest = fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let explained = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let section = manifest.split("[workspace.dependencies]").nth(1).unwrap().split("\n[").next().unwrap();
    let names = section.lines().filter_map(|l| l.split_once(" = ")).map(|(name, _)| name.trim());
    for name in names.filter(|n| !n.starts_with("pocketry-") && !n.starts_with('#')) {
        assert!(explained.contains(&format!("`{name}`")), "ARCHITECTURE.md does not say what {name} is for");
    }
}
