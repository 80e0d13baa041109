//! The command from outside: what it writes, says and returns.

use crate::support::{Sandbox, bracket, pocketry, stderr};

#[test]
fn a_drawing_becomes_a_proven_program_a_picture_and_a_report() {
    let folder = Sandbox::new();
    let (program, plot, report) = (folder.path("a.ngc"), folder.path("a.svg"), folder.path("a.json"));
    let run = pocketry()
        .args(["pocket", &bracket(), "--tool", "6", "--depth", "4", "--stepdown", "2", "-o", &program])
        .args(["--plot", &plot, "--plot-skeleton", "--report", &report])
        .output()
        .unwrap();
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    let text = folder.read("a.ngc");
    assert!(text.starts_with("(Pocketry ") && text.ends_with("M5\nM9\nM2\n"));
    assert!(text.contains("\nG17 G21 G40 G49 G80 G90 G91.1 G94\nG61\nT1 M6\nS12000 M3\nG0 Z10.0\nX"), "retract first");
    assert!(folder.read("a.svg").contains("</svg>"));
    let report: serde_json::Value = serde_json::from_str(&folder.read("a.json")).unwrap();
    assert_eq!(report["status"], "proven");
    assert_eq!(report["passes"], 2);
    assert!(report["gouge"].as_f64().unwrap() <= 0.002 && report["uncut_area"] == 0.0);
    assert_eq!(folder.files(), ["a.json", "a.ngc", "a.svg"], "no temporary file is left");

    let judged = pocketry().args(["verify", &bracket(), &program, "--tool", "6"]).output().unwrap();
    assert_eq!(judged.status.code(), Some(0), "{}", stderr(&judged));
    let too_large = pocketry().args(["verify", &bracket(), &program, "--tool", "6.2"]).output().unwrap();
    assert_eq!(too_large.status.code(), Some(1), "the same program gouges with a larger tool");
}

#[test]
fn inches_and_conventional_milling_are_proven_too() {
    let folder = Sandbox::new();
    let program = folder.path("a.ngc");
    let run = pocketry()
        .args([
            "pocket",
            &bracket(),
            "--tool",
            "5",
            "--inch",
            "--conventional",
            "--stock-to-leave",
            "0.2",
            "-o",
            &program,
        ])
        .output()
        .unwrap();
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    assert!(folder.read("a.ngc").contains("G20"));
}

#[test]
fn bad_arguments_and_bad_drawings_return_2_and_write_nothing() {
    let folder = Sandbox::new();
    let output = folder.path("out.ngc");
    folder.write("open.dxf", "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n0\n10\n0\n20\n0\n11\n9\n21\n9\n0\nENDSEC\n0\nEOF\n");
    folder.write("empty.dxf", "");
    folder.write("noise.svg", "\u{1}\u{2}\u{3}");
    folder.write("huge.json", format!("{}{}", "[".repeat(100_000), "]".repeat(100_000)));
    folder.write("zero.json", r#"{"units":"mm","tool_radius":0,"loops":[[[0,0,0],[9,0,0],[9,9,0]]]}"#);
    for file in ["open.dxf", "empty.dxf", "noise.svg", "huge.json", "zero.json"] {
        let run = pocketry().args(["pocket", &folder.path(file), "--tool", "2", "-o", &output]).output().unwrap();
        assert_eq!(run.status.code(), Some(2), "{file}: {}", stderr(&run));
        assert!(stderr(&run).contains("error:") && stderr(&run).contains(file), "{file}: {}", stderr(&run));
    }
    for typed in
        [&["--tool", "-1"][..], &["--tool", "nan"], &["--tool", "2", "--stepover", "0"], &[], &["--tool", "900"]]
    {
        let run = pocketry().args(["pocket", &bracket(), "-o", &output]).args(typed).output().unwrap();
        assert_eq!(run.status.code(), Some(2), "{typed:?}: {}", stderr(&run));
    }
    assert!(!folder.files().contains(&"out.ngc".to_owned()));
}

#[test]
fn a_tool_that_fits_nowhere_is_told_the_largest_that_does() {
    let run = pocketry().args(["pocket", &bracket(), "--tool", "500", "-o", "/nonexistent.ngc"]).output().unwrap();
    assert_eq!(run.status.code(), Some(2));
    assert!(stderr(&run).contains("largest that fits"), "{}", stderr(&run));
}

#[test]
fn files_that_cannot_be_read_or_written_return_3() {
    let folder = Sandbox::new();
    let missing = pocketry().args(["info", &folder.path("missing.dxf")]).output().unwrap();
    assert_eq!(missing.status.code(), Some(3), "{}", stderr(&missing));
    let nowhere = folder.path("no/such/folder/a.ngc");
    let run = pocketry().args(["pocket", &bracket(), "--tool", "6", "-o", &nowhere]).output().unwrap();
    assert_eq!(run.status.code(), Some(3), "{}", stderr(&run));
    let plot = folder.path("no/a.svg");
    let program = folder.path("a.ngc");
    let run = pocketry().args(["pocket", &bracket(), "--tool", "6", "-o", &program, "--plot", &plot]).output().unwrap();
    assert_eq!(run.status.code(), Some(3), "{}", stderr(&run));
    assert!(folder.files().is_empty(), "all outputs or none: {:?}", folder.files());
}

#[test]
fn outputs_do_not_overwrite_one_another_or_the_drawing() {
    let folder = Sandbox::new();
    folder.write("a.json", r#"{"tool_radius":1,"loops":[[[0,0,0],[9,0,0],[9,9,0]]]}"#);
    let run = pocketry().args(["pocket", &folder.path("a.json"), "--report", &folder.path("a.json")]).output().unwrap();
    assert_eq!(run.status.code(), Some(2), "{}", stderr(&run));
    assert_eq!(folder.files(), ["a.json"]);
}

#[test]
fn offsets_come_as_dxf_svg_and_json_that_can_be_read_again() {
    let folder = Sandbox::new();
    for file in ["o.dxf", "o.svg"] {
        let path = folder.path(file);
        let run = pocketry().args(["offset", &bracket(), "-d", "1", "-o", &path]).output().unwrap();
        assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
        let info = pocketry().args(["info", "--json", &path]).output().unwrap();
        assert_eq!(info.status.code(), Some(0), "{}", stderr(&info));
        let info: serde_json::Value = serde_json::from_slice(&info.stdout).unwrap();
        assert!(info["area"].as_f64().unwrap() > 0.0, "{file}");
    }
    let run = pocketry().args(["offset", &bracket(), "-d", "1,2.5"]).output().unwrap();
    let json: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(json["offsets"][1]["distance"], 2.5);
}

#[test]
fn the_skeleton_comes_as_svg_and_json() {
    let folder = Sandbox::new();
    let run = pocketry().args(["skeleton", &bracket(), "-o", &folder.path("s.svg")]).output().unwrap();
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    assert!(folder.read("s.svg").contains("skeleton"));
    let run = pocketry().args(["skeleton", &bracket()]).output().unwrap();
    let json: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    let count = json["vertices"].as_array().unwrap().len() as u64;
    let ends = json["edges"].as_array().unwrap().iter().flat_map(|e| e["vertices"].as_array().unwrap());
    assert!(ends.clone().count() > 0 && ends.into_iter().all(|v| v.as_u64().unwrap() < count));
}

#[test]
fn the_origin_can_be_moved() {
    let corner = |typed: &[&str]| {
        let run = pocketry().args(["info", "--json", &bracket()]).args(typed).output().unwrap();
        let info: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
        [info["lower_left"][0].as_f64().unwrap(), info["lower_left"][1].as_f64().unwrap()]
    };
    let drawn = corner(&[]);
    assert_eq!(corner(&["--origin", "lower-left"]), [0.0, 0.0]);
    let moved = corner(&["--origin", "-7,5"]);
    assert!((moved[0] - drawn[0] - 7.0).abs() < 1e-9 && (moved[1] - drawn[1] + 5.0).abs() < 1e-9);
}

#[test]
fn strategies_are_compared_and_each_can_be_asked_for() {
    let folder = Sandbox::new();
    let (program, report) = (folder.path("a.ngc"), folder.path("a.json"));
    let mut taken = Vec::new();
    for strategy in ["auto", "contour", "subpockets"] {
        let run = pocketry()
            .args(["pocket", &bracket(), "--tool", "6", "-o", &program, "--report", &report, "--strategy", strategy])
            .output()
            .unwrap();
        assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
        let report: serde_json::Value = serde_json::from_str(&folder.read("a.json")).unwrap();
        let costs = report["strategies"].as_array().unwrap();
        let seconds: Vec<f64> = costs.iter().map(|c| c["machine_seconds"].as_f64().unwrap()).collect();
        assert_eq!(seconds.len(), if strategy == "auto" { 2 } else { 1 });
        assert_eq!(report["machine_seconds"].as_f64().unwrap(), seconds[0]);
        assert!(seconds.is_sorted(), "the best first: {seconds:?}");
        taken.push((strategy, report["strategy"].as_str().unwrap().to_owned()));
    }
    assert!(taken[1].1 == "contour" && taken[2].1 == "subpockets", "{taken:?}");
}

#[test]
fn the_largest_tool_that_leaves_little_is_chosen() {
    let folder = Sandbox::new();
    // A square: a tool of diameter d leaves 0.207 d in its corners.
    folder.write("a.json", r#"{"id": "a", "units": "mm", "loops": [[[0,0,0], [40,0,0], [40,40,0], [0,40,0]]]}"#);
    let (input, program, report) = (folder.path("a.json"), folder.path("a.ngc"), folder.path("r.json"));
    for (scallop, radius) in [("0.7", 1.5), ("0.9", 2.0), ("1.3", 3.0), ("50", 5.0)] {
        let run = pocketry()
            .args(["pocket", &input, "--tool", "auto", "--scallop", scallop, "--tools", "3,4,6,8,10"])
            .args(["-o", &program, "--report", &report])
            .output()
            .unwrap();
        assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
        let report: serde_json::Value = serde_json::from_str(&folder.read("r.json")).unwrap();
        assert_eq!(report["tool_radius"].as_f64(), Some(radius), "scallop {scallop}");
    }
    let none =
        pocketry().args(["pocket", &input, "--tool", "auto", "--scallop", "0.1", "-o", &program]).output().unwrap();
    assert_eq!(none.status.code(), Some(2));
    let why = stderr(&none);
    for said in ["3 mm: leaves 0.621 mm at X", "10 mm: leaves 2.071 mm at X"] {
        assert!(why.contains(said), "{why}");
    }
}

#[test]
fn a_neck_that_no_tool_passes_is_named_with_its_place_and_width() {
    let folder = Sandbox::new();
    folder.write(
        "a.json",
        r#"{"id": "a", "units": "mm", "loops": [[[0,0,0], [20,0,0], [20,9,0], [30,9,0], [30,0,0], [50,0,0], [50,20,0], [30,20,0],
            [30,11,0], [20,11,0], [20,20,0], [0,20,0]]]}"#,
    );
    let (input, program) = (folder.path("a.json"), folder.path("a.ngc"));
    let run = pocketry()
        .args(["pocket", &input, "--tool", "auto", "--scallop", "1", "--tools", "3,24", "-o", &program])
        .output()
        .unwrap();
    assert_eq!(run.status.code(), Some(2));
    let why = stderr(&run);
    for said in ["can't pass the neck at X25.000 Y10.000, 2 mm wide", "24 mm: fits nowhere: the widest place, at X"] {
        assert!(why.contains(said), "{why}");
    }
    let table = pocketry().args(["info", "--json", "--tools", "2,3", &input]).output().unwrap();
    let info: serde_json::Value = serde_json::from_slice(&table.stdout).unwrap();
    let (narrow, wide) = (&info["tools"][0], &info["tools"][1]);
    assert!(narrow["neck"].is_null() && wide["neck"]["width"].as_f64() == Some(2.0));
    let corners = 8.0 * (1.0 - std::f64::consts::FRAC_PI_4);
    assert!((narrow["leftover"].as_f64().unwrap() - corners).abs() < 1e-9);
    assert!((narrow["reachable"].as_f64().unwrap() - (1.0 - corners / 820.0)).abs() < 1e-9);
}

#[test]
fn a_tool_that_reaches_everything_leaves_nothing_and_not_minus_nothing() {
    let table = pocketry().args(["info", "--tools", "6", &bracket()]).output().unwrap();
    let text = String::from_utf8(table.stdout).unwrap();
    assert!(text.contains(" 0 mm²") && !text.contains("-0"), "{text}");
}

#[test]
fn subpockets_are_written_in_every_form() {
    let folder = Sandbox::new();
    for form in ["dxf", "svg", "json"] {
        let output = folder.path(&format!("s.{form}"));
        let run = pocketry().args(["subpockets", &bracket(), "-o", &output]).output().unwrap();
        assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    }
    let file: serde_json::Value = serde_json::from_str(&folder.read("s.json")).unwrap();
    let subpockets = file["subpockets"].as_array().unwrap();
    assert!(subpockets.len() > 1 && subpockets.iter().all(|s| s["area"].as_f64().unwrap() > 0.0));
    assert!(file["passes"].as_array().unwrap().iter().all(|p| p["width"].as_f64().unwrap() > 0.0));
}

#[test]
fn the_pairwise_engine_proves_its_programs_at_wide_stepovers() {
    let folder = Sandbox::new();
    let program = folder.path("a.ngc");
    let run = |more: &[&str]| {
        let typed = ["pocket", &bracket(), "--tool", "6", "--engine", "pairwise", "-o", &program];
        pocketry().args(typed).args(more).output().unwrap()
    };
    for stepover in ["40%", "75%", "5.7mm", "98%"] {
        let proven = run(&["--stepover", stepover]);
        assert_eq!(proven.status.code(), Some(0), "{stepover}: {}", stderr(&proven));
    }
    let uncut = run(&["--stepover", "98%", "--no-cleanup"]);
    assert_ne!(uncut.status.code(), Some(0), "loops alone leave something");
    assert!(stderr(&uncut).contains("uncut"), "{}", stderr(&uncut));
    assert!(stderr(&run(&["--strategy", "subpockets"])).contains("--engine voronoi"));
}
