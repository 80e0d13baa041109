//! Models: what is read, what is healed, and what bad files are told.

use pocketry_io::import::mesh::{MeshOptions, Model, parse_mesh};
use proptest::prelude::*;
use std::io::Write;
use std::path::Path;

type Triangle = [[f32; 3]; 3];

/// The triangles of a cube of edge 10, facing outwards.
fn cube() -> Vec<Triangle> {
    let c = |k: usize| [0, 1, 2].map(|a| if k >> a & 1 == 1 { 10.0 } else { 0.0 });
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    quads.iter().flat_map(|q| [[c(q[0]), c(q[1]), c(q[2])], [c(q[0]), c(q[2]), c(q[3])]]).collect()
}

fn binary(triangles: &[Triangle]) -> Vec<u8> {
    let mut bytes = vec![b'-'; 80];
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for t in triangles {
        bytes.extend([0; 12]);
        bytes.extend(t.iter().flatten().flat_map(|c| c.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn ascii(triangles: &[Triangle]) -> String {
    let corner = |c: &[f32; 3]| format!("      vertex {} {} {:e}\n", c[0], c[1], c[2]);
    let facet = |t: &Triangle| {
        format!(
            "  facet normal 0 0 0\n    outer loop\n{}    endloop\n  endfacet\n",
            t.iter().map(corner).collect::<String>()
        )
    };
    format!("solid cube\n{}endsolid cube\n", triangles.iter().map(facet).collect::<String>())
}

fn read(name: &str, bytes: &[u8]) -> Result<Model, String> {
    parse_mesh(Path::new(name), bytes, &MeshOptions::default()).map_err(|e| e.to_string())
}

fn is_the_cube(model: &Model) -> bool {
    model.mesh.flaws().is_sound() && (model.mesh.volume() - 1000.0).abs() < 1e-9
}

#[test]
fn the_same_cube_comes_out_of_every_format() {
    assert!(is_the_cube(&read("a.stl", &binary(&cube())).unwrap()));
    assert!(is_the_cube(&read("a.stl", ascii(&cube()).as_bytes()).unwrap()));
    assert!(is_the_cube(&read("a", &binary(&cube())).unwrap()), "told by its content");
    let mut solid = binary(&cube());
    solid[..5].copy_from_slice(b"solid");
    assert!(is_the_cube(&read("a.stl", &solid).unwrap()), "binary files may begin with solid");
    let obj = "o cube\nv 0 0 0\nv 10 0 0\nv 0 10 0\nv 10 10 0 1.0\nv 0 0 10\nv 10 0 10\nv 0 10 10\nv 10 10 10\nvn 0 0 1\n\
               f 1 3 4 2\nf 5/1 6/1 8/2 7/3\nf 1//1 2//1 6//1 5//1\nf -6 -2 -1 -5\nf 1 5 7 3\nf 2 4 8 6\n";
    assert!(is_the_cube(&read("a.obj", obj.as_bytes()).unwrap()));
    assert!(is_the_cube(&read("a.3mf", &package(&threemf("1 0 0 0 1 0 0 0 1 5 5 5"))).unwrap()));
    assert!(is_the_cube(&read("a.3mf", &package(&threemf("-1 0 0 0 1 0 0 0 1 0 0 0"))).unwrap()), "mirrored");
}

/// A cube of 1 cm made of an object and a component.
fn threemf(transform: &str) -> String {
    let vertices: String = (0..8)
        .map(|k| format!("<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>", k & 1, k >> 1 & 1, k >> 2 & 1))
        .collect::<Vec<_>>()
        .concat();
    let triangles: String = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
        .iter()
        .flat_map(|q: &[u8; 4]| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]])
        .map(|t| format!("<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>", t[0], t[1], t[2]))
        .collect::<Vec<_>>()
        .concat();
    format!(
        "<model unit=\"centimeter\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources>\
         <object id=\"1\"><mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh></object>\
         <object id=\"2\"><components><component objectid=\"1\"/></components></object></resources>\
         <build><item objectid=\"2\" transform=\"{transform}\"/></build></model>"
    )
}

fn package(model: &str) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let rels = "<Relationships><Relationship Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\" \
                Target=\"/3D/m.model\" Id=\"r\"/></Relationships>";
    for (name, text) in [("_rels/.rels", rels), ("3D/m.model", model)] {
        zip.start_file(name, zip::write::SimpleFileOptions::default()).unwrap();
        zip.write_all(text.as_bytes()).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

#[test]
fn bad_models_are_told_what_and_where() {
    let whole = binary(&cube());
    let mut nan = cube();
    nan[4][1][2] = f32::NAN;
    let mut far = cube();
    far[2][0][0] = 1e30;
    let flat: Vec<Triangle> = cube().into_iter().map(|t| t.map(|c| [c[0], c[1], 0.0])).collect();
    let point = vec![[[1.0; 3]; 3]; 4];
    let mut cut_text = ascii(&cube());
    cut_text.truncate(700);
    let cases: Vec<(&str, Vec<u8>, &[&str])> = vec![
        ("a.stl", Vec::new(), &["a.stl", "empty"]),
        ("a.stl", whole[..40].to_vec(), &["too few"]),
        ("a.stl", whole[..84 + 50 * 7 + 13].to_vec(), &["promises 12 facets", "within facet 8"]),
        ("a.stl", binary(&[]), &["no facet"]),
        ("a.stl", binary(&nan), &["facet 5", "NaN"]),
        ("a.stl", binary(&far), &["facet 3"]),
        ("a.stl", binary(&flat), &["flat"]),
        ("a.stl", binary(&point), &["no facet with an area"]),
        ("a.stl", cut_text.into_bytes(), &["ends before"]),
        ("a.stl", b"solid x\nendsolid x\n".to_vec(), &["no facet"]),
        (
            "a.stl",
            ascii(&cube()).replacen("vertex 10 10 0e0", "vertex 10 ten 0", 1).into_bytes(),
            &["a.stl:", "not a corner"],
        ),
        ("a.stl", ascii(&nan).into_bytes(), &["a.stl:33, facet 5", "NaN"]),
        ("a.stl", ascii(&far).into_bytes(), &["a.stl:18, facet 3", "no place of a part"]),
        ("a.obj", b"v 0 0 0\nv 1 inf 0\nv 0 1 0\nf 1 2 3\n".to_vec(), &["a.obj:2", "inf"]),
        ("a.obj", b"v 0 0 0\nv 1 0 0\nf 1 2 3\n".to_vec(), &["a.obj:3", "known vertices"]),
        ("a.obj", b"v 0 0\n".to_vec(), &["a.obj:1"]),
        ("a.3mf", b"PK\x03\x04 and no more".to_vec(), &["not a 3MF package"]),
        ("a.3mf", package("<model><build><item objectid=\"7\"/></build></model>"), &["not in the file"]),
        (
            "a.3mf",
            package(
                "<model><resources><object id=\"1\"><components><component objectid=\"1\"/></components></object></resources><build><item objectid=\"1\"/></build></model>",
            ),
            &["component of itself"],
        ),
        ("a.txt", b"hello".to_vec(), &["known kind"]),
    ];
    for (name, bytes, words) in cases {
        let told = read(name, &bytes).expect_err("it is no model");
        for word in words {
            assert!(told.contains(word), "{told:?} lacks {word:?}");
        }
    }
}

#[test]
fn models_that_are_no_solids_are_read_with_warnings() {
    let told = |triangles: &[Triangle]| -> String {
        let model = read("a.stl", &binary(triangles)).unwrap();
        model.warnings.iter().map(|w| format!("{w}\n")).collect::<Vec<_>>().concat()
    };
    assert_eq!(told(&cube()), "");
    assert!(told(&cube()[1..]).contains("open: edges with a facet on one side only: 3, the first at ("));
    let inside_out: Vec<Triangle> = cube().into_iter().map(|[a, b, c]| [a, c, b]).collect();
    assert!(told(&inside_out).contains("inside out"));
    assert!(read("a.stl", &binary(&inside_out)).unwrap().mesh.volume() > 0.0);
    let mut fin = cube();
    fin.push([[0.0; 3], [10.0, 0.0, 0.0], [5.0, -9.0, 0.0]]);
    assert!(
        told(&fin).contains("more than two facets meet at edges: 1, the first at (5.0000, 0.0000, 0.0000)"),
        "{}",
        told(&fin)
    );
    let mut turned = cube();
    turned[0].swap(0, 1);
    assert!(told(&turned).contains("turned over: neighbours disagree about the outside at edges: 3, the first at ("));
    let mut longer = binary(&cube());
    longer.extend([1, 2, 3]);
    assert!(read("a.stl", &longer).unwrap().warnings[0].message.contains("3 bytes"));
}

#[test]
fn a_million_facets_are_read() {
    let side = 708;
    let z = |i: usize, j: usize| ((i * 31 + j * 17) % 11) as f32 * 0.1;
    let p = |i: usize, j: usize| [i as f32, j as f32, z(i, j)];
    let mut triangles: Vec<Triangle> = Vec::new();
    for i in 0..side {
        for j in 0..side {
            triangles.push([p(i, j), p(i + 1, j), p(i + 1, j + 1)]);
            triangles.push([p(i, j), p(i + 1, j + 1), p(i, j + 1)]);
        }
    }
    assert!(triangles.len() > 1_000_000);
    let model = read("a.stl", &binary(&triangles)).unwrap();
    assert_eq!(model.mesh.vertices().len(), (side + 1) * (side + 1));
    assert_eq!(model.mesh.flaws().open.unwrap().count, 4 * side);
}

proptest! {
    #[test]
    fn garbled_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..400), at in 0_usize..600, with in any::<u8>()) {
        for name in ["a.stl", "a.obj", "a.3mf", "a"] {
            let _ = read(name, &bytes);
            for mut good in [binary(&cube()), ascii(&cube()).into_bytes(), package(&threemf("1 0 0 0 1 0 0 0 1 0 0 0"))] {
                let place = at % good.len();
                good[place] = with;
                let _ = read(name, &good);
                good.truncate(place);
                let _ = read(name, &good);
            }
        }
    }
}
