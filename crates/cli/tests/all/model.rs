//! Models from outside: slices and roughing programs.

use crate::support::{Sandbox, pocketry, stderr};

/// A plate with a boss on it as ASCII STL.
fn boss() -> String {
    let mut text = "solid boss\n".to_owned();
    for (low, high) in [([0, 0, -9], [40, 30, -8]), ([14, 10, -8], [26, 20, 0])] {
        let c = |k: usize| [0, 1, 2].map(|a| if k >> a & 1 == 1 { high[a] } else { low[a] });
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        for t in quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]) {
            text += "facet normal 0 0 0\nouter loop\n";
            text.extend(t.map(c).map(|[x, y, z]| format!("vertex {x} {y} {z}\n")));
            text += "endloop\nendfacet\n";
        }
    }
    text + "endsolid boss\n"
}

#[test]
fn slices_come_as_dxf_svg_and_region_json_that_can_be_read_again() {
    let folder = Sandbox::new();
    folder.write("boss.stl", &boss());
    for (file, area) in [("s.dxf", 120.0), ("s.svg", 120.0), ("s.jsonl", 120.0)] {
        let path = folder.path(file);
        let run = pocketry().args(["slice", &folder.path("boss.stl"), "--z", "-2.5", "-o", &path]).output().unwrap();
        assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
        let again = if file.ends_with("jsonl") { folder.path("s.json") } else { path };
        if file.ends_with("jsonl") {
            folder.write("s.json", &folder.read(file));
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
    folder.write("boss.stl", &boss());
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
    folder.write("boss.stl", &boss());
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
fn bad_models_and_bad_jobs_return_2_and_write_nothing() {
    let folder = Sandbox::new();
    folder.write("boss.stl", &boss());
    folder.write("cut.stl", &boss()[..700]);
    folder.write("nan.stl", &boss().replacen("vertex 40 30 -9", "vertex 40 nan -9", 1));
    folder.write("empty.stl", "");
    for file in ["cut.stl", "nan.stl", "empty.stl"] {
        let run = pocketry().args(["rough", &folder.path(file), "--tool", "6"]).output().unwrap();
        assert_eq!(run.status.code(), Some(2), "{file}: {}", stderr(&run));
        assert!(stderr(&run).contains(file), "{}", stderr(&run));
    }
    for typed in [&["--cutter", "bull:9"][..], &["--cutter", "drill"], &["--stock", "0,0,0,1,1"], &["--tool", "600"]] {
        let tool: &[&str] = if typed[0] == "--tool" { &[] } else { &["--tool", "6"] };
        let run =
            pocketry().args(["rough", &folder.path("boss.stl"), "--margin=0"]).args(tool).args(typed).output().unwrap();
        assert_eq!(run.status.code(), Some(2), "{typed:?}: {}", stderr(&run));
    }
    assert_eq!(folder.files(), ["boss.stl", "cut.stl", "empty.stl", "nan.stl"]);
}
