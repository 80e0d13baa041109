//! DXF: one small drawing for each kind of entity and each rule.

use pocketry_geom::{Segment, point};
use pocketry_io::import::{self, Drawing, ImportError, ImportOptions, Origin, Units};
use std::f64::consts::PI;
use std::path::Path;

/// Group codes and values parted by commas, as `0,LINE,8,POCKET`, one on a line of a DXF file.
fn pairs(text: &str) -> String {
    text.split(',').flat_map(|part| [part.trim(), "\n"]).collect()
}

fn file(header: &str, tables: &str, blocks: &str, entities: &str) -> String {
    let section = |name: &str, body: &str| format!("0\nSECTION\n2\n{name}\n{body}0\nENDSEC\n");
    let part = |body: &str| if body.is_empty() { String::new() } else { pairs(body) };
    let tables =
        if tables.is_empty() { String::new() } else { format!("0\nTABLE\n2\nLAYER\n{}0\nENDTAB\n", pairs(tables)) };
    [
        section("HEADER", &part(header)),
        section("TABLES", &tables),
        section("BLOCKS", &part(blocks)),
        section("ENTITIES", &part(entities)),
        "0\nEOF\n".to_owned(),
    ]
    .concat()
}

const MM: &str = "9,$INSUNITS,70,4";

fn parse(text: &str, options: &ImportOptions) -> Result<Drawing, ImportError> {
    import::parse(Path::new("part.dxf"), text.as_bytes(), options)
}

fn read(entities: &str) -> Drawing {
    let drawing = parse(&file(MM, "", "", entities), &ImportOptions::default()).unwrap();
    assert!(drawing.warnings.is_empty(), "{:?}", drawing.warnings);
    drawing
}

fn read_blocks(blocks: &str, entities: &str) -> Drawing {
    parse(&file(MM, "", blocks, entities), &ImportOptions::default()).unwrap()
}

fn assert_area(drawing: &Drawing, expected: f64, off: f64) {
    let area = drawing.region.area();
    assert!((area - expected).abs() <= off, "area {area}, expected {expected}");
}

const SQUARE: &str = "0,LWPOLYLINE,8,0,90,4,70,1,10,0,20,0,10,10,20,0,10,10,20,10,10,0,20,10";

const SQUARE_LINES: &str = "0,LINE,8,0,10,0,20,0,11,10,21,0,0,LINE,8,0,10,10,20,0,11,10,21,10,
    0,LINE,8,0,10,10,20,10,11,0,21,10,0,LINE,8,0,10,0,20,10,11,0,21,0";

#[test]
fn lines_and_arcs_in_any_order_and_direction_are_chained() {
    let drawing = read(
        "0,LINE,8,A,10,10,20,10,11,0,21,10, 0,ARC,8,A,10,10,20,5,40,5,50,270,51,90,
         0,LINE,8,A,10,0,20,0,11,10,21,0, 0,ARC,8,A,10,0,20,5,40,5,50,90,51,270",
    );
    assert_area(&drawing, 100.0 + 25.0 * PI, 1e-9);
    assert_eq!(drawing.region.edge_count(), 4);
    assert_eq!(drawing.sources[0].layer, "A");
}

#[test]
fn a_circle_is_two_exact_arcs() {
    let drawing = read("0,CIRCLE,8,0,10,1,20,2,40,3");
    assert_area(&drawing, 9.0 * PI, 1e-12);
    for segment in drawing.region.segments() {
        let Segment::Arc(arc) = segment else { panic!("{segment:?}") };
        assert_eq!((arc.center, arc.radius), (point(1.0, 2.0), 3.0));
    }
}

#[test]
fn bulges_of_both_kinds_of_polyline_are_arcs() {
    let light = read("0,LWPOLYLINE,8,0,90,2,70,1,10,0,20,0,42,1,10,4,20,0,42,1");
    assert_area(&light, 4.0 * PI, 1e-12);
    let heavy =
        read("0,POLYLINE,8,0,66,1,70,1, 0,VERTEX,8,0,10,0,20,0,42,1, 0,VERTEX,8,0,10,4,20,0,42,1, 0,SEQEND,8,0");
    assert_eq!(heavy.region, light.region);
}

#[test]
fn bulges_next_to_nothing_are_straight_or_flat_arcs() {
    for bulge in ["1e-14", "-1e-8", "1e-300"] {
        let text = format!("0,LWPOLYLINE,8,0,90,4,70,1,10,0,20,0,42,{bulge},10,900,20,0,10,900,20,900,10,0,20,900");
        assert_area(&read(&text), 810_000.0, 0.01);
    }
}

#[test]
fn ellipses_whole_and_in_pieces() {
    let whole = read("0,ELLIPSE,8,0,10,0,20,0,11,0,21,20,40,0.5,41,0,42,6.283185307179586");
    assert_area(&whole, 200.0 * PI, 0.05);
    let half = "0,ELLIPSE,8,0,10,0,20,0,11,20,21,0,40,0.5,41,0,42,3.141592653589793, 0,LINE,8,0,10,20,20,0,11,-20,21,0";
    let half = read(half);
    assert_area(&half, 100.0 * PI, 0.03);
    assert!(half.region.bbox().max.y > 9.99 && half.region.bbox().min.y > -1e-9);
}

#[test]
fn an_ellipse_that_faces_down_runs_the_other_way() {
    let text = "0,ELLIPSE,8,0,10,0,20,0,11,20,21,0,40,0.5,41,0,42,3.141592653589793,210,0,220,0,230,-1,
                0,LINE,8,0,10,20,20,0,11,-20,21,0";
    assert!(read(text).region.bbox().min.y < -9.99);
}

#[test]
fn splines_clamped_rational_and_unclamped() {
    let knots = "40,0,40,0,40,0,40,0,40,1,40,1,40,1,40,1";
    let clamped = format!(
        "0,SPLINE,8,0,70,8,71,3,72,8,73,4,{knots},10,0,20,0,10,0,20,12,10,12,20,12,10,12,20,0,
         0,LINE,8,0,10,0,20,0,11,12,21,0"
    );
    assert_area(&read(&clamped), 0.6 * 144.0, 0.02);
    let rational = "0,SPLINE,8,0,70,12,71,2,40,0,40,0,40,0,40,1,40,1,40,1,41,1,41,0.7071067811865476,41,1,
                    10,5,20,0,10,5,20,5,10,0,20,5, 0,LINE,8,0,10,0,20,5,11,0,21,0, 0,LINE,8,0,10,0,20,0,11,5,21,0";
    assert_area(&read(rational), 25.0 * PI / 4.0, 1e-6);
    let knots: Vec<String> = (0..12).map(|k| format!("40,{k}")).collect();
    let angles = (0..8).map(|k| f64::from(k % 5) * 0.4 * PI);
    let points: Vec<String> = angles.map(|a| format!("10,{},20,{}", 30.0 * a.cos(), 30.0 * a.sin())).collect();
    let drawing = read(&format!("0,SPLINE,8,0,70,11,71,3,{},{}", knots.join(","), points.join(",")));
    assert_eq!(drawing.region.contours().len(), 1);
    assert!(drawing.region.area() > 1000.0 && drawing.region.area() < 900.0 * PI);
}

#[test]
fn blocks_are_scaled_turned_mirrored_and_stretched() {
    let block = format!("0,BLOCK,8,0,2,part,10,1,20,1,{SQUARE},0,ENDBLK,8,0");
    let placed = read_blocks(&block, "0,INSERT,8,0,2,PART,10,100,20,50,41,2,42,2,50,90");
    assert_area(&placed, 400.0, 1e-9);
    let bbox = placed.region.bbox();
    assert!(bbox.min.distance(point(82.0, 48.0)) < 1e-12 && bbox.max.distance(point(102.0, 68.0)) < 1e-12, "{bbox:?}");
    let mirrored = read_blocks(&block, "0,INSERT,8,0,2,PART,10,0,20,0,41,-1,42,3");
    assert_area(&mirrored, 300.0, 1e-9);
    assert!(mirrored.region.bbox().min.distance(point(-9.0, -3.0)) < 1e-12);
    let flipped = read_blocks(&block, "0,INSERT,8,0,2,PART,10,100,20,0,210,0,220,0,230,-1");
    assert!(flipped.region.bbox().min.distance(point(-109.0, -1.0)) < 1e-12, "{:?}", flipped.region.bbox());
}

#[test]
fn a_circle_stretched_is_an_ellipse_and_mirrored_still_a_circle() {
    let block = "0,BLOCK,8,0,2,C,10,0,20,0,0,CIRCLE,8,0,10,3,20,0,40,2,0,ENDBLK,8,0";
    let stretched = read_blocks(block, "0,INSERT,8,0,2,C,10,0,20,0,41,5,42,1");
    assert_area(&stretched, 20.0 * PI, 0.02);
    let mirrored = read_blocks(block, "0,INSERT,8,0,2,C,10,0,20,0,41,-1,42,1,50,30");
    assert_eq!(mirrored.region.edge_count(), 2);
    assert_area(&mirrored, 4.0 * PI, 1e-12);
}

#[test]
fn arrays_repeat_along_the_turned_axes() {
    let block = format!("0,BLOCK,8,0,2,P,10,0,20,0,{SQUARE},0,ENDBLK,8,0");
    let drawing = read_blocks(&block, "0,INSERT,8,0,2,P,10,0,20,0,50,90,70,3,71,2,44,20,45,30");
    assert_eq!(drawing.region.contours().len(), 6);
    let bbox = drawing.region.bbox();
    assert!(bbox.min.distance(point(-40.0, 0.0)) < 1e-12 && bbox.max.distance(point(0.0, 50.0)) < 1e-12, "{bbox:?}");
}

#[test]
fn nested_blocks_hand_their_layer_down() {
    let blocks = format!(
        "0,BLOCK,8,0,2,IN,10,0,20,0,{SQUARE},0,ENDBLK,8,0, 0,BLOCK,8,0,2,OUT,10,0,20,0,0,INSERT,8,0,2,IN,10,5,20,5,0,ENDBLK,8,0"
    );
    let text = file(MM, "", &blocks, "0,INSERT,8,DEEP,2,OUT,10,0,20,0, 0,CIRCLE,8,OTHER,10,99,20,99,40,1");
    let options = ImportOptions { layers: vec!["deep".to_owned()], ..ImportOptions::default() };
    let drawing = parse(&text, &options).unwrap();
    assert_area(&drawing, 100.0, 1e-12);
    assert_eq!(drawing.sources[0].layer, "DEEP");
    assert!(drawing.region.bbox().min.distance(point(5.0, 5.0)) < 1e-12);
}

#[test]
fn entities_that_face_down_are_mirrored() {
    let drawing = read("0,CIRCLE,8,0,10,-5,20,2,40,3,210,0,220,0,230,-1");
    assert!(drawing.region.bbox().center().distance(point(5.0, 2.0)) < 1e-12);
}

#[test]
fn hidden_layers_and_paper_space_are_left_out() {
    let layers = "0,LAYER,2,OFF,70,0,62,-7,0,LAYER,2,ICE,70,1,62,7";
    let circle = |layer: &str, more: &str| format!("0,CIRCLE,8,{layer},10,0,20,0,40,5{more}");
    let entities = [SQUARE.to_owned(), circle("off", ""), circle("ICE", ""), circle("0", ",67,1")].join(",");
    let drawing = parse(&file(MM, layers, "", &entities), &ImportOptions::default()).unwrap();
    assert_area(&drawing, 100.0, 1e-12);
    let only_hidden = parse(&file(MM, layers, "", &circle("off", "")), &ImportOptions::default()).unwrap_err();
    assert!(only_hidden.to_string().contains("off or frozen: off"), "{only_hidden}");
    let asked_for = ImportOptions { layers: vec!["OFF".to_owned()], ..ImportOptions::default() };
    assert!(parse(&file(MM, layers, "", &entities), &asked_for).is_ok());
}

#[test]
fn an_unknown_layer_is_an_error_that_lists_the_layers() {
    let options = ImportOptions { layers: vec!["POKET".to_owned()], ..ImportOptions::default() };
    let text = file(MM, "", "", "0,CIRCLE,8,POCKET,10,0,20,0,40,5,0,CIRCLE,8,HOLES,10,50,20,0,40,5");
    let error = parse(&text, &options).unwrap_err();
    assert_eq!(error.kind(), "layer");
    let message = error.to_string();
    assert!(message.contains("POKET") && message.contains("HOLES, POCKET"), "{message}");
}

#[test]
fn units_come_from_the_file_or_the_options() {
    let inch = parse(&file("9,$INSUNITS,70,1", "", "", SQUARE), &ImportOptions::default()).unwrap();
    assert_area(&inch, 100.0 * 25.4 * 25.4, 1e-9);
    assert_eq!(inch.units, Units::INCH);
    let unsaid = parse(&file("", "", "", SQUARE), &ImportOptions::default()).unwrap();
    assert!(unsaid.warnings.len() == 1 && unsaid.warnings[0].message.contains("millimetres"));
    let options = ImportOptions { units: Some(Units::INCH), ..ImportOptions::default() };
    let told = parse(&file("", "", "", SQUARE), &options).unwrap();
    assert!(told.warnings.is_empty());
    assert_eq!(told.region, inch.region);
}

#[test]
fn the_origin_moves_the_region() {
    let at = |origin| {
        let options = ImportOptions { origin, ..ImportOptions::default() };
        parse(&file(MM, "", "", "0,CIRCLE,8,0,10,7,20,8,40,3"), &options).unwrap().region.bbox()
    };
    assert!(at(Origin::LowerLeft).min.distance(point(0.0, 0.0)) < 1e-12);
    assert!(at(Origin::Center).center().distance(point(0.0, 0.0)) < 1e-12);
    assert!(at(Origin::Keep).center().distance(point(7.0, 8.0)) < 1e-12);
}

#[test]
fn an_almost_closed_island_is_never_milled_over() {
    let island = "0,LWPOLYLINE,8,0,5,2F,90,4,70,0,10,2,20,2,10,8,20,2,10,8,20,8,10,2,20,2.5";
    let error = parse(&file(MM, "", "", &format!("{SQUARE},{island}")), &ImportOptions::default()).unwrap_err();
    assert_eq!(error.kind(), "open-contour");
    let message = error.to_string();
    assert!(message.contains("LWPOLYLINE 2F") && message.contains("layer 0"), "{message}");
}

#[test]
fn text_and_dimensions_are_silent() {
    let entities = format!("{SQUARE},0,TEXT,8,NOTES,10,0,20,0,40,5,1,DEPTH 10, 0,DIMENSION,8,NOTES,10,0,20,0");
    assert_area(&read(&entities), 100.0, 1e-12);
}

#[test]
fn details_finer_than_the_join_tolerance_survive() {
    let corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 0.005), (10.004, 0.005), (10.004, 10.0), (0.0, 10.0)];
    let line = |k: usize| {
        let ((x, y), (to_x, to_y)) = (corners[k], corners[(k + 1) % corners.len()]);
        format!("0,LINE,8,0,10,{x},20,{y},11,{to_x},21,{to_y}")
    };
    let lines: Vec<String> = [3, 0, 4, 2, 5, 1].map(line).to_vec();
    assert_eq!(read(&lines.join(",")).region.edge_count(), 6);
}

#[test]
fn a_gap_within_the_join_tolerance_is_closed_aloud() {
    let text = "0,LWPOLYLINE,8,0,90,4,70,0,10,0,20,0,10,10,20,0,10,10,20,10,10,0,20,10,10,0,20,0.01";
    let drawing = parse(&file(MM, "", "", text), &ImportOptions::default()).unwrap();
    assert_eq!(drawing.warnings.len(), 1, "{:?}", drawing.warnings);
    let strict = ImportOptions { join_tolerance: 0.001, ..ImportOptions::default() };
    assert_eq!(parse(&file(MM, "", "", text), &strict).unwrap_err().kind(), "open-contour");
}

#[test]
fn a_line_across_the_pocket_is_not_guessed_about() {
    let across = format!("{SQUARE_LINES},0,LINE,8,0,10,10,20,0,11,0,21,10");
    let error = parse(&file(MM, "", "", &across), &ImportOptions::default()).unwrap_err();
    assert_eq!(error.kind(), "open-contour");
}

#[test]
fn a_file_cut_anywhere_never_loses_an_island_silently() {
    let text = file(MM, "", "", &format!("{SQUARE},0,CIRCLE,8,0,10,5,20,5,40,2"));
    let whole = parse(&text, &ImportOptions::default()).unwrap().region;
    for end in 0..text.len() {
        if let Ok(drawing) = parse(&text[..end], &ImportOptions::default()) {
            assert_eq!(drawing.region, whole, "cut after {end} bytes");
        }
    }
}

#[test]
fn the_example_is_what_the_readme_says() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/bracket.dxf");
    let drawing = import::read(&path, &ImportOptions::default()).unwrap();
    assert!(drawing.warnings.is_empty(), "{:?}", drawing.warnings);
    assert_eq!(drawing.region.contours().len(), 3);
    assert!((drawing.region.bbox().width() - 120.0).abs() < 1e-9);
    assert!((drawing.region.bbox().height() - 80.0).abs() < 1e-9);
    assert!(drawing.sources.iter().all(|s| s.layer == "POCKET"));
}
