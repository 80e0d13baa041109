//! Batches from outside: names, report lines, exit codes, determinism.

use crate::support::{Sandbox, pocketry, stderr};
use serde_json::Value;

const FIELDS: [&str; 15] = [
    "id",
    "status",
    "error",
    "program",
    "tool_radius",
    "stepover",
    "cut_length",
    "rapid_length",
    "retracts",
    "loops",
    "control_vertices",
    "gouge",
    "uncut_area",
    "unreachable_area",
    "seconds",
];

/// A slot with an island, and an L.
const GOOD: [&str; 2] = [
    r#"{"id":"slot/1","units":"mm","tool_radius":2,"interval":1.5,"loops":[[[0,0,0],[40,0,1],[40,20,0],[0,20,1]],[[15,10,1],[25,10,1]]]}"#,
    r#"{"id":"ell","units":"mm","tool_radius":1.5,"interval":2.5,"loops":[[[0,0,0],[30,0,0],[30,12,0],[12,12,0],[12,30,0],[0,30,0]]]}"#,
];

fn run(folder: &Sandbox, lines: &str, threads: &str) -> (i32, Vec<Value>) {
    folder.write("parts.jsonl", lines);
    let run = pocketry()
        .env("RAYON_NUM_THREADS", threads)
        .args([
            "pocket",
            &folder.path("parts.jsonl"),
            "--out-dir",
            &folder.path("out"),
            "--report",
            &folder.path("report.jsonl"),
        ])
        .output()
        .unwrap();
    let code = run.status.code().unwrap();
    assert!(!stderr(&run).contains("panicked"), "{}", stderr(&run));
    let report = folder.read("report.jsonl").lines().map(|l| serde_json::from_str(l).unwrap()).collect();
    (code, report)
}

#[test]
fn each_region_gets_a_program_and_a_line() {
    let folder = Sandbox::new();
    let (code, report) = run(&folder, &format!("{}\n\n{}\n", GOOD[0], GOOD[1]), "2");
    assert_eq!((code, report.len()), (0, 2), "{report:?}");
    for line in &report {
        assert!(FIELDS.iter().all(|f| line.get(f).is_some()), "{line}");
        assert_eq!(line["status"], "proven");
        assert!(std::path::Path::new(line["program"].as_str().unwrap()).exists());
        assert!(line["retracts"].as_u64() <= line["control_vertices"].as_u64());
    }
    assert!(report[0]["program"].as_str().unwrap().ends_with("slot_1.ngc"));
    assert_eq!(report[1]["stepover"], 2.5, "above the radius, with clean-up");
}

#[test]
fn failures_are_collected_and_the_highest_code_is_returned() {
    let folder = Sandbox::new();
    let bad = r#"{"id":"thin","tool_radius":50,"loops":[[[0,0,0],[9,0,0],[9,9,0]]]}"#;
    let (code, report) = run(&folder, &format!("{}\n{bad}\nnot json\n{}\n", GOOD[0], GOOD[0]), "2");
    assert_eq!(code, 2);
    let told: Vec<_> = report.iter().map(|l| (l["id"].as_str().unwrap(), l["status"].as_str().unwrap())).collect();
    assert_eq!(told, [("slot/1", "proven"), ("thin", "failed"), ("region-3", "failed"), ("slot/1-4", "proven")]);
    assert_eq!(report[1]["error"]["kind"], "does-not-fit");
    assert!(report[2]["error"]["message"].as_str().unwrap().contains("parts.jsonl:3"));
    assert!(report[1]["program"].is_null());
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let lines: String =
        (0..12).map(|k| GOOD[k % 2].replacen("\"id\":\"", &format!("\"id\":\"{k}-"), 1) + "\n").collect();
    let outcome = |threads| {
        let folder = Sandbox::new();
        let (_, mut report) = run(&folder, &lines, threads);
        let programs: Vec<String> =
            report.iter().map(|l| std::fs::read_to_string(l["program"].as_str().unwrap()).unwrap()).collect();
        for line in &mut report {
            line["seconds"] = Value::Null;
            line["program"] = Value::Null;
        }
        (programs, report)
    };
    let first = outcome("1");
    assert_eq!(first, outcome("3"));
}

#[test]
fn a_batch_wants_a_folder_and_no_single_files() {
    let folder = Sandbox::new();
    folder.write("parts.jsonl", GOOD[0]);
    let parts = folder.path("parts.jsonl");
    for typed in [&[][..], &["--out-dir", "x", "-o", "y.ngc"], &["--out-dir", "x", "--plot", "y.svg"]] {
        let run = pocketry().current_dir(folder.path("")).arg("pocket").arg(&parts).args(typed).output().unwrap();
        assert_eq!(run.status.code(), Some(2), "{typed:?}");
    }
    assert_eq!(folder.files(), ["parts.jsonl"]);
}
