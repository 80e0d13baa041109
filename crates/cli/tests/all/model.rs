//! Models from outside: slices and roughing programs.

use crate::support::{Sandbox, pocketry, stderr};

type Facet = [[f32; 3]; 3];

/// A plate with a boss on it.
fn boss_facets() -> Vec<Facet> {
    let mut facets = Vec::new();
    for (low, high) in [([0.0, 0.0, -9.0], [40.0, 30.0, -8.0]), ([14.0, 10.0, -8.0], [26.0, 20.0, 0.0])] {
        let c = |k: usize| [0, 1, 2].map(|a| if k >> a & 1 == 1 { high[a] } else { low[a] });
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        facets.extend(quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).map(|t| t.map(c)));
    }
    facets
}

/// STL in words: seven lines a facet, its corners on the third to the fifth.
fn ascii(facets: &[Facet]) -> String {
    let corner = |[x, y, z]: [f32; 3]| format!("vertex {x} {y} {z}\n");
    let facet = |f: &Facet| format!("facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n", f.map(corner).concat());
    format!("solid boss\n{}endsolid boss\n", facets.iter().map(facet).collect::<String>())
}

fn binary(facets: &[Facet]) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend((facets.len() as u32).to_le_bytes());
    for f in facets {
        bytes.extend([0; 12]);
        bytes.extend(f.iter().flatten().flat_map(|c| c.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn boss() -> String {
    ascii(&boss_facets())
}

#[test]
fn slices_come_as_dxf_svg_and_region_json_that_can_be_read_again() {
    let folder = Sandbox::new();
    folder.write("boss.stl", boss());
    for (file, area) in [("s.dxf", 120.0), ("s.svg", 120.0), ("s.jsonl", 120.0)] {
        let path = folder.path(file);
        let run = pocketry().args(["slice", &folder.path("boss.stl"), "--z", "-2.5", "-o", &path]).output().unwrap();
        assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
        let again = if file.ends_with("jsonl") { folder.path("s.json") } else { path };
        if file.ends_with("jsonl") {
            folder.write("s.json", folder.read(file));
        }
        let info = pocketry().args(["info", "--json", &again]).output().unwrap();
        assert_eq!(info.status.code(), Some(0), "{}", stderr(&info));
        let info: serde_json::Value = serde_json::from_slice(&info.stdout).unwrap();
        assert!((info["area"].as_f64().unwrap() - area).abs() < 1e-3, "{file}: {info}");
    }
    let run = pocketry().args(["slice", &folder.path("boss.stl"), "--z=-8.5,-3,5"]).output().unwrap();
    assert_eq!(String::from_utf8_lossy(&run.stdout).lines().count(), 2);
    assert!(stderr(&run).contains("at z 5 mm: the plane cuts nothing"), "{}", stderr(&run));
}

#[test]
fn a_model_becomes_a_proven_roughing_program_with_pictures_and_a_report() {
    let folder = Sandbox::new();
    folder.write("boss.stl", boss());
    let run = pocketry()
        .args(["rough", &folder.path("boss.stl"), "--tool", "6", "--cutter", "bull:1", "--stepdown", "3"])
        .args(["--stock-to-leave", "0.3", "--margin", "0.5", "-o", &folder.path("a.ngc")])
        .args(["--report", &folder.path("a.json"), "--plot", &folder.path("a.svg")])
        .output()
        .unwrap();
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    let report: serde_json::Value = serde_json::from_str(&folder.read("a.json")).unwrap();
    assert_eq!(report["status"], "proven");
    assert!(report["proof"]["levels"].as_array().unwrap().len() == 4, "{report}");
    assert!(folder.read("a.ngc").contains("bull-nose end mill"));
    assert!(folder.read("a.svg").contains("</svg>") && folder.read("a-01.svg").contains("where the tool"));
}

#[test]
fn every_engine_roughs_a_boss() {
    let folder = Sandbox::new();
    folder.write("boss.stl", boss());
    for engine in ["voronoi", "pairwise", "bisector"] {
        let run = pocketry()
            .args(["rough", &folder.path("boss.stl"), "--tool", "6", "--stepdown", "3", "--engine", engine])
            .args(["-o", &folder.path("a.ngc"), "--report", &folder.path("a.json")])
            .output()
            .unwrap();
        assert_eq!(run.status.code(), Some(0), "{engine}: {}", stderr(&run));
        let report: serde_json::Value = serde_json::from_str(&folder.read("a.json")).unwrap();
        assert_eq!(report["status"], "proven");
        assert!(report["job"]["engine"].as_str().unwrap().eq_ignore_ascii_case(engine), "{report}");
    }
}

#[test]
fn malformed_models_are_refused_at_their_facet_or_line() {
    let folder = Sandbox::new();
    let mut nan = boss_facets();
    nan[9][1][1] = f32::NAN;
    let whole = binary(&boss_facets());
    let cases: [(&str, Vec<u8>, &str); 6] = [
        ("cut.stl", boss()[..700].into(), "the file ends before the solid does"),
        ("cut-binary.stl", whole[..84 + 50 * 9 + 20].into(), "promises 24 facets and ends within facet 10"),
        ("nan.stl", ascii(&nan).into(), "nan.stl:68, facet 10: the corner ("),
        ("nan-binary.stl", binary(&nan), "nan-binary.stl, facet 10: the corner ("),
        ("empty.stl", Vec::new(), "the file is empty"),
        ("none.stl", binary(&[]), "there is no facet in it"),
    ];
    for (file, bytes, told) in &cases {
        folder.write(file, bytes);
        for command in [&["rough", "--tool", "6"][..], &["slice", "--z", "-2"]] {
            let run = pocketry().args(command).arg(folder.path(file)).output().unwrap();
            assert_eq!(run.status.code(), Some(2), "{file}: {}", stderr(&run));
            assert!(stderr(&run).contains(file) && stderr(&run).contains(told), "{told:?}: {}", stderr(&run));
        }
    }
    assert_eq!(folder.files().len(), cases.len(), "nothing is written");
}

#[test]
fn models_that_are_no_solids_are_sliced_with_a_warning_that_says_where() {
    let folder = Sandbox::new();
    let mut fin = boss_facets();
    fin.push([[14.0, 10.0, 0.0], [26.0, 10.0, 0.0], [20.0, 5.0, 1.0]]);
    let mut turned = boss_facets();
    turned[16].swap(0, 1);
    let inside_out: Vec<Facet> = boss_facets().into_iter().map(|[a, b, c]| [a, c, b]).collect();
    for (file, facets, told) in [
        ("open.stl", &boss_facets()[1..], "edges with a facet on one side only: 3, the first at ("),
        ("fin.stl", &fin, "more than two facets meet at edges: 1, the first at (20.0000, 10.0000, 0.0000)"),
        ("turned.stl", &turned, "neighbours disagree about the outside at edges: 3, the first at ("),
        ("inside-out.stl", &inside_out, "the model was inside out and has been turned over"),
    ] {
        folder.write(file, binary(facets));
        let run = pocketry().args(["slice", "--z", "-2", &folder.path(file)]).output().unwrap();
        assert_eq!(run.status.code(), Some(0), "{file}: {}", stderr(&run));
        assert!(stderr(&run).contains(file) && stderr(&run).contains(told), "{told:?}: {}", stderr(&run));
    }
}

#[test]
fn bad_jobs_return_2_and_write_nothing() {
    let folder = Sandbox::new();
    folder.write("boss.stl", boss());
    for typed in [&["--cutter", "bull:9"][..], &["--cutter", "drill"], &["--stock", "0,0,0,1,1"], &["--tool", "600"]] {
        let tool: &[&str] = if typed[0] == "--tool" { &[] } else { &["--tool", "6"] };
        let run =
            pocketry().args(["rough", &folder.path("boss.stl"), "--margin=0"]).args(tool).args(typed).output().unwrap();
        assert_eq!(run.status.code(), Some(2), "{typed:?}: {}", stderr(&run));
    }
    assert_eq!(folder.files(), ["boss.stl"]);
}
