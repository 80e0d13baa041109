//! SVG: one small drawing for each shape and each rule.

use pocketry_geom::point;
use pocketry_io::import::{self, Drawing, ImportError, ImportOptions, Units};
use std::f64::consts::PI;
use std::path::Path;

fn try_read(root: &str, body: &str, options: &ImportOptions) -> Result<Drawing, ImportError> {
    let text = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' \
         xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' {root}>{body}</svg>"
    );
    import::parse(Path::new("part.svg"), text.as_bytes(), options)
}

/// A drawing of 100 × 100 mm in user units of a millimetre.
fn read(body: &str) -> Drawing {
    let root = "width='100mm' height='100mm' viewBox='0 0 100 100'";
    let drawing = try_read(root, body, &ImportOptions::default()).unwrap();
    assert!(drawing.warnings.is_empty(), "{:?}", drawing.warnings);
    drawing
}

fn area(body: &str) -> f64 {
    read(body).region.area()
}

fn assert_near(found: f64, expected: f64, off: f64) {
    assert!((found - expected).abs() <= off, "{found}, expected {expected}");
}

#[test]
fn basic_shapes() {
    assert_near(area("<rect x='1' y='2' width='10' height='5'/>"), 50.0, 1e-9);
    assert_near(area("<rect width='10' height='6' rx='2'/>"), 60.0 - 4.0 * (4.0 - PI), 1e-9);
    assert_near(area("<rect width='10' height='6' rx='2' ry='1'/>"), 60.0 - 2.0 * (4.0 - PI), 0.02);
    assert_near(area("<circle cx='9' cy='9' r='3'/>"), 9.0 * PI, 1e-9);
    assert_near(area("<ellipse cx='20' cy='20' rx='10' ry='4'/>"), 40.0 * PI, 0.03);
    assert_near(area("<polygon points='0,0 10,0 10,10'/>"), 50.0, 1e-9);
    assert_near(area("<circle cx='9' cy='9' r='0.5cm'/>"), 25.0 * PI * (96.0 / 25.4_f64).powi(2), 1e-6);
}

#[test]
fn circles_are_exact_arcs() {
    assert_eq!(read("<circle cx='50' cy='50' r='30'/>").region.edge_count(), 2);
    assert_eq!(read("<path d='M20 50A30 30 0 0 1 80 50A30 30 0 0 1 20 50Z'/>").region.edge_count(), 2);
}

#[test]
fn y_points_up() {
    let bbox = read("<rect x='10' y='5' width='20' height='10'/>").region.bbox();
    assert!(bbox.min.distance(point(10.0, 85.0)) < 1e-9 && bbox.max.distance(point(30.0, 95.0)) < 1e-9, "{bbox:?}");
}

#[test]
fn stroked_lines_are_chained() {
    let lines = "<g fill='none' stroke='black'><line x1='0' y1='0' x2='10' y2='0'/><path d='M10 10L0 0'/>
                 <polyline points='10,0 10,10'/></g>";
    assert_near(area(lines), 50.0, 1e-9);
}

#[test]
fn what_is_neither_filled_nor_stroked_is_not_there() {
    let bodies = [
        "<path d='M0 0H100V100H0Z' fill='none'/>",
        "<rect width='99' height='99' style='display:none'/>",
        "<g visibility='hidden'><rect width='99' height='99'/></g>",
        "<style>.b{fill:none}</style><rect class='b' width='99' height='99'/>",
    ];
    for body in bodies {
        assert_near(area(&format!("{body}<rect x='1' y='1' width='2' height='2'/>")), 4.0, 1e-9);
    }
}

#[test]
fn fill_rules() {
    let same_way = "M0 0H30V30H0ZM10 10H20V20H10Z";
    assert_near(area(&format!("<path fill-rule='evenodd' d='{same_way}'/>")), 800.0, 1e-9);
    let root = "width='100mm' height='100mm' viewBox='0 0 100 100'";
    let nonzero = try_read(root, &format!("<path d='{same_way}'/>"), &ImportOptions::default()).unwrap();
    assert_near(nonzero.region.area(), 900.0, 1e-9);
    assert_eq!(nonzero.warnings.len(), 1);
    assert_near(area("<path d='M0 0H30V30H0ZM10 10V20H20V10Z'/>"), 800.0, 1e-9);
}

#[test]
fn separate_shapes_nest() {
    assert_near(area("<rect width='30' height='30'/><circle cx='15' cy='15' r='5'/>"), 900.0 - 25.0 * PI, 1e-9);
}

#[test]
fn transforms_nest_and_keep_circles_where_they_can() {
    let turned = "<g transform='translate(50 50) rotate(30)'><g transform='scale(2)'><circle r='4'/></g></g>";
    assert_eq!(read(turned).region.edge_count(), 2);
    assert_near(area(turned), 64.0 * PI, 1e-9);
    assert_near(area("<g transform='translate(30 30) skewX(30)'><circle r='10'/></g>"), 100.0 * PI, 0.05);
    assert_near(area("<rect transform='matrix(-1 0 0 1 50 0)' width='5' height='5'/>"), 25.0, 1e-9);
}

#[test]
fn uses_and_symbols_and_inner_viewports() {
    let defs = "<defs><rect id='r' width='5' height='5'/></defs>";
    let bbox = read(&format!("{defs}<use href='#r' x='10' y='20'/>")).region.bbox();
    assert!(bbox.min.distance(point(10.0, 75.0)) < 1e-9, "{bbox:?}");
    assert_near(
        area(&format!("{defs}<use xlink:href='#r'/><use href='#r' x='20' transform='scale(2)'/>")),
        125.0,
        1e-9,
    );
    let symbol = "<symbol id='s' viewBox='0 0 1 1'><rect width='1' height='1'/></symbol>";
    assert_near(area(&format!("{symbol}<use href='#s' width='7' height='7'/>")), 49.0, 1e-9);
    let inner = "<svg x='5' y='5' width='50' height='50' viewBox='0 0 10 10'><rect width='2' height='2'/></svg>";
    assert_near(area(inner), 100.0, 1e-9);
}

#[test]
fn physical_sizes_scale_the_view_box() {
    let options = ImportOptions::default();
    let inch = try_read("width='1in' height='1in' viewBox='0 0 10 10'", "<rect width='10' height='10'/>", &options);
    assert_near(inch.unwrap().region.area(), 25.4 * 25.4, 1e-9);
    let stretched = "width='20mm' height='10mm' viewBox='0 0 10 10' preserveAspectRatio='none'";
    let stretched = try_read(stretched, "<rect width='10' height='10'/>", &options).unwrap();
    assert_near(stretched.region.area(), 200.0, 1e-9);
    let slice = "width='20mm' height='10mm' viewBox='0 0 10 10' preserveAspectRatio='xMinYMin slice'";
    assert_near(try_read(slice, "<rect width='10' height='10'/>", &options).unwrap().region.area(), 400.0, 1e-9);
}

#[test]
fn pixels_are_assumed_aloud_unless_units_are_given() {
    let body = "<rect width='96' height='96'/>";
    let pixels = try_read("width='96' height='96'", body, &ImportOptions::default()).unwrap();
    assert_near(pixels.region.area(), 25.4 * 25.4, 1e-9);
    assert!(pixels.warnings[0].message.contains("1/96 inch"));
    assert_eq!(pixels.units, Units::PIXEL);
    let options = ImportOptions { units: Some(Units::MILLIMETER), ..ImportOptions::default() };
    let told = try_read("width='96' height='96'", body, &options).unwrap();
    assert_near(told.region.area(), 96.0 * 96.0, 1e-9);
    assert!(told.warnings.is_empty());
}

#[test]
fn groups_are_layers() {
    let body = "<g inkscape:groupmode='layer' inkscape:label='Pocket' id='g1'><g><rect width='5' height='5'/></g></g>
                <g id='notes'><rect x='20' width='9' height='9'/></g>";
    let layer = |name: &str| ImportOptions { layers: vec![name.to_owned()], ..ImportOptions::default() };
    let root = "width='100mm' height='100mm' viewBox='0 0 100 100'";
    assert_near(try_read(root, body, &layer("Pocket")).unwrap().region.area(), 25.0, 1e-9);
    assert_near(try_read(root, body, &layer("notes")).unwrap().region.area(), 81.0, 1e-9);
    let message = try_read(root, body, &layer("nope")).unwrap_err().to_string();
    assert!(message.contains("Pocket") && message.contains("notes"), "{message}");
}

#[test]
fn beziers_become_few_arcs() {
    let blob = read("<path d='M10 50C10 10 90 10 90 50S10 90 10 50Z'/>");
    assert!(blob.region.edge_count() <= 60, "{}", blob.region.edge_count());
}

#[test]
fn messages_name_the_element_and_its_line() {
    let root = "width='100mm' height='100mm' viewBox='0 0 100 100'";
    let body = "\n<g id='walls'>\n<path id='w7' d='M0 0L10 10L10 0L0 10Z'/></g>";
    let message = try_read(root, body, &ImportOptions::default()).unwrap_err().to_string();
    assert!(message.contains("part.svg:3") && message.contains("walls") && message.contains("w7"), "{message}");
}

#[test]
fn deep_nesting_is_refused_not_overflowed() {
    for depth in [290, 400, 9_000, 50_000] {
        let body = format!("{}<rect width='5' height='5'/>{}", "<g>".repeat(depth), "</g>".repeat(depth));
        let outcome = try_read("width='9mm' height='9mm' viewBox='0 0 9 9'", &body, &ImportOptions::default());
        match outcome {
            Ok(drawing) => assert!(depth < 300 && (drawing.region.area() - 25.0).abs() < 1e-9),
            Err(error) => assert_eq!(error.kind(), "limit", "{error}"),
        }
    }
}

#[test]
fn absurdly_large_curves_end_in_bounded_time() {
    let curve = "<path transform='scale(1e7)' d='M0 0C0 90 90 90 90 0Z'/>";
    let options = ImportOptions { fit_tolerance: 1e-6, ..ImportOptions::default() };
    let outcome = try_read("width='9mm' height='9mm' viewBox='0 0 9 9'", curve, &options);
    let area = outcome.unwrap().region.area();
    assert!((area - 4860e14).abs() < 1e12, "{area}");
}
