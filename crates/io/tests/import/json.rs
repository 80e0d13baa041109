//! Region JSON and batches.

use pocketry_io::import::{self, ImportOptions, parse_region_json};
use std::fs;

const SQUARE: &str = "[[0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 0]]";

fn parse(text: &str) -> Result<import::Drawing, import::ImportError> {
    parse_region_json(text, &ImportOptions::default())
}

#[test]
fn fields_are_read_and_converted() {
    let text =
        format!(r#"{{"id": "a", "units": "in", "tool_radius": 1, "interval": 0.5, "note": [], "loops": [{SQUARE}]}}"#);
    let drawing = parse(&text).unwrap();
    assert_eq!(drawing.id.as_deref(), Some("a"));
    assert_eq!((drawing.tool_radius, drawing.interval), (Some(25.4), Some(12.7)));
    assert!((drawing.region.area() - 64516.0).abs() < 1e-6);
}

#[test]
fn loops_fill_even_odd_whatever_their_direction() {
    let hole = "[[2, 2, 0], [4, 2, 0], [4, 4, 0], [2, 4, 0]]";
    let hole_back = "[[2, 2, 0], [2, 4, 0], [4, 4, 0], [4, 2, 0]]";
    for hole in [hole, hole_back] {
        let drawing = parse(&format!(r#"{{"loops": [{hole}, {SQUARE}]}}"#)).unwrap();
        assert_eq!(drawing.region.area(), 96.0);
    }
}

#[test]
fn bad_values_are_refused() {
    for field in
        ["\"tool_radius\": 0", "\"tool_radius\": -1", "\"interval\": 0", "\"interval\": 1e-9", "\"units\": \"ell\""]
    {
        let error = parse(&format!(r#"{{{field}, "loops": [{SQUARE}]}}"#)).unwrap_err();
        assert!(!error.is_io(), "{field}");
    }
}

#[test]
fn one_bad_line_does_not_spoil_a_batch() {
    let path = std::env::temp_dir().join(format!("pocketry-batch-{}.jsonl", std::process::id()));
    let text = format!("{{\"id\": \"a\", \"loops\": [{SQUARE}]}}\n\nnonsense\n{{\"loops\": [{SQUARE}]}}\n");
    fs::write(&path, text).unwrap();
    let lines = import::read_batch(&path).unwrap();
    fs::remove_file(&path).unwrap();
    let numbered: Vec<(usize, Option<&str>)> = lines.iter().map(|l| (l.line, l.id.as_deref())).collect();
    assert_eq!(numbered, [(1, Some("a")), (3, None), (4, None)]);
    let read: Vec<bool> = lines.iter().map(|l| parse(&l.text).is_ok()).collect();
    assert_eq!(read, [true, false, true]);
}
