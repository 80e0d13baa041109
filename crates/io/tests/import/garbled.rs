//! Files damaged at random: an error or a region, never a panic.

use pocketry_io::import::{self, ImportOptions};
use proptest::prelude::*;
use std::fs;
use std::path::Path;

const SVG: &str = "<svg xmlns='http://www.w3.org/2000/svg' width='90mm' height='60mm' viewBox='0 0 90 60'>\
    <style>.a{fill:none;stroke:red}</style><defs><g id='d'><circle cx='4' cy='5' r='3'/></g></defs>\
    <path class='a' d='M10 10C20 0 40 0 50 10S80 20 80 30Q70 60 40 50T10 10Z'/>\
    <g transform='translate(3 4) rotate(30)'><use href='#d' x='9'/><rect width='5' height='4' rx='1'/></g>\
    <path d='M30 30a5 4 20 1 0 9 0z' fill-rule='evenodd'/></svg>";

const JSON: &str = r#"{"id": "x", "units": "mm", "tool_radius": 1.5, "interval": 1e0, "loops":
    [[[0, 0, 0], [40, 0, 0.41], [50, 10, 0], [50, 60, -0.2], [0, 60, 0]], [[20, 20, 1], [30, 20, 1]]]}"#;

/// One edit of a file: at a share of its length, that many bytes give way to others.
type Edit = (f64, usize, Vec<u8>);

fn edits() -> impl Strategy<Value = Vec<Edit>> {
    let bytes = prop::collection::vec(
        prop_oneof![prop::sample::select(b"0123456789.-eE<>/&\n ,[]{}\"".to_vec()), any::<u8>()],
        0..6,
    );
    prop::collection::vec((0.0..1.0_f64, 0..9_usize, bytes), 1..4)
}

fn damaged(text: &[u8], edits: &[Edit]) -> Vec<u8> {
    let mut bytes = text.to_vec();
    for (share, count, new) in edits {
        let at = (share * bytes.len() as f64) as usize;
        let end = (at + count).min(bytes.len());
        bytes.splice(at..end, new.iter().copied());
    }
    bytes
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn nothing_panics(edits in edits()) {
        let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/bracket.dxf");
        let dxf = fs::read(example).unwrap();
        for (name, text) in [("a.dxf", dxf.as_slice()), ("a.svg", SVG.as_bytes()), ("a.json", JSON.as_bytes())] {
            match import::parse(Path::new(name), &damaged(text, &edits), &ImportOptions::default()) {
                Ok(drawing) => prop_assert!(drawing.region.area() > 0.0),
                Err(error) => prop_assert!(!error.is_io() && !error.to_string().is_empty()),
            }
        }
    }
}
