//! DXF of release 12: the one that every program reads.

use super::Sheet;
use std::fmt::{Display, Write};

/// Closed POLYLINEs with bulges, one layer a sheet, in millimetres.
pub fn to_dxf(sheets: &[Sheet]) -> String {
    let mut text = String::new();
    let mut pair = |code: u16, value: &dyn Display| {
        let _ = write!(text, "{code}\n{value}\n");
    };
    pair(0, &"SECTION");
    pair(2, &"HEADER");
    pair(9, &"$ACADVER");
    pair(1, &"AC1009");
    pair(9, &"$INSUNITS");
    pair(70, &4);
    pair(0, &"ENDSEC");
    pair(0, &"SECTION");
    pair(2, &"ENTITIES");
    for sheet in sheets {
        let layer = layer_name(&sheet.name);
        for contour in &sheet.loops {
            pair(0, &"POLYLINE");
            pair(8, &layer);
            pair(66, &1);
            pair(70, &1);
            for [x, y, bulge] in contour.to_vertices() {
                pair(0, &"VERTEX");
                pair(8, &layer);
                pair(10, &x);
                pair(20, &y);
                if bulge != 0.0 {
                    pair(42, &bulge);
                }
            }
            pair(0, &"SEQEND");
            pair(8, &layer);
        }
    }
    pair(0, &"ENDSEC");
    pair(0, &"EOF");
    text
}

/// Release 12 allows letters, digits, `_`, `-` and `$`; points are kept since readers take them.
fn layer_name(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() || "_-$.".contains(c) { c } else { '_' }).collect()
}
