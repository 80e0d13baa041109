//! Contours as drawings for other programs: DXF, SVG and JSON. Lines and arcs stay what they are.

mod dxf;
mod json;
mod svg;

pub use dxf::to_dxf;
pub use json::{to_json, to_region_json};
pub use svg::to_svg;

use pocketry_geom::Contour;

/// Closed contours that belong together: the loops of one offset, or the walls.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// Name of the layer (DXF) or group (SVG).
    pub name: String,
    /// Distance from the walls, mm, where the contours are an offset.
    pub distance: Option<f64>,
    /// The contours.
    pub loops: Vec<Contour>,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet() -> Sheet {
        let loops =
            vec![Contour::from_vertices(&[[0.0, 0.0, 0.0], [10.0, 0.0, 0.25], [10.0, 4.0, 0.0], [0.0, 4.0, 0.0]])];
        Sheet { name: "offset 3".to_owned(), distance: Some(3.0), loops }
    }

    #[test]
    fn dxf_holds_closed_polylines_with_bulges() {
        let text = to_dxf(&[sheet()]);
        assert_eq!(text.matches("\nVERTEX\n").count(), 4);
        assert!(
            text.contains("\n8\noffset_3\n") && text.contains("\n70\n1\n") && text.contains("\n42\n0.25\n"),
            "{text}"
        );
        assert!(text.ends_with("0\nEOF\n"));
    }

    #[test]
    fn svg_is_in_millimetres_with_y_up() {
        let text = to_svg(&[sheet()]);
        assert!(text.contains("width=\"10.5mm\"") && text.contains(" 0 0 0 10 -4"), "{text}");
    }

    #[test]
    fn json_holds_vertices_that_can_be_read_again() {
        let value: serde_json::Value = serde_json::from_str(&to_json(&[sheet()])).unwrap();
        assert_eq!(value["offsets"][0]["loops"][0][1], serde_json::json!([10.0, 0.0, 0.25]));
        assert_eq!(value["units"], "mm");
    }
}
