//! Tools that are not round, from outside.

use crate::support::{Sandbox, bracket, pocketry, stderr};

const POCKET: &str = r#"{"id": "pocket", "units": "mm", "loops": [[[0, 0, 0], [60, 0, 0], [60, 36, 0], [0, 36, 0]], [[26, 18, 1], [34, 18, 1]]]}"#;

#[test]
fn a_rectangular_tool_makes_a_proven_program_and_a_picture() {
    let folder = Sandbox::new();
    folder.write("pocket.json", POCKET);
    let (drawing, program, plot) = (folder.path("pocket.json"), folder.path("a.ngc"), folder.path("a.svg"));
    for profile in ["rect:12x4", "rounded:12x4r1", "stadium:8x4", "ellipse:10x5", "polygon:6x10", "rect:8x4@30"] {
        let run = pocketry()
            .args(["pocket", &drawing, "--tool-profile", profile, "--depth", "2", "-o", &program, "--plot", &plot])
            .output()
            .unwrap();
        assert_eq!(run.status.code(), Some(0), "{profile}: {}", stderr(&run));
        assert!(folder.read("a.ngc").contains("does not turn"), "{profile}");
        let judge = |p: &str| pocketry().args(["verify", &drawing, &program, "--tool-profile", p]).output().unwrap();
        assert_eq!(judge(profile).status.code(), Some(0), "{profile}: {}", stderr(&judge(profile)));
        assert_eq!(judge("rect:13x6").status.code(), Some(1), "{profile}: a larger tool gouges");
        assert_eq!(judge("circle:2").status.code(), Some(1), "{profile}: a smaller tool leaves something");
    }
    assert!(folder.read("a.svg").contains("</svg>"));
}

#[test]
fn a_tool_is_drawn_about_its_reference_point() {
    let folder = Sandbox::new();
    folder.write("pocket.json", POCKET);
    let drawing = folder.path("pocket.json");
    let l = r#"{"id": "tool", "units": "mm", "loops": [[[-2, -2, 0], [4, -2, 0], [4, 1, 0], [1, 1, 0], [1, 4, 0], [-2, 4, 0]]]}"#;
    folder.write("tool.json", l);
    folder.write("away.json", l.replace("-2", "10"));
    let run = |tool: &str| {
        let profile = format!("file:{}", folder.path(tool));
        pocketry().args(["pocket", &drawing, "--tool-profile", &profile, "-o", &folder.path("a.ngc")]).output().unwrap()
    };
    let done = run("tool.json");
    assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
    assert!(folder.read("a.ngc").contains("file:tool.json"));
    let away = run("away.json");
    assert_eq!(away.status.code(), Some(2));
}

#[test]
fn what_a_profile_cannot_do_is_said() {
    let folder = Sandbox::new();
    let said = |more: &[&str]| {
        let run = pocketry().args(["pocket", &bracket(), "-o", &folder.path("a.ngc")]).args(more).output().unwrap();
        (run.status.code(), stderr(&run))
    };
    let (code, text) = said(&["--tool-profile", "rect:12"]);
    assert!(code == Some(2) && text.contains("rect:12x4"), "{text}");
    let (code, text) = said(&["--tool-profile", "rect:900x400"]);
    assert!(code == Some(2) && text.contains("fits nowhere"), "{text}");
    let (code, text) = said(&["--tool-profile", "cone:90"]);
    assert!(code == Some(2) && text.contains("--depth"), "{text}");
    let (code, text) = said(&["--tool-profile", "rect:6x4", "--stock-to-leave", "0.1"]);
    assert!(code == Some(2) && text.contains("profile that much larger"), "{text}");
    assert!(folder.files().is_empty());
}

#[test]
fn a_cone_is_as_wide_as_its_depth_makes_it() {
    let folder = Sandbox::new();
    folder.write("pocket.json", POCKET);
    let (drawing, program) = (folder.path("pocket.json"), folder.path("a.ngc"));
    let run = pocketry()
        .args(["pocket", &drawing, "--tool-profile", "cone:90", "--depth", "3", "-o", &program])
        .output()
        .unwrap();
    assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    let judged = pocketry().args(["verify", &drawing, &program, "--tool", "6"]).output().unwrap();
    assert_eq!(judged.status.code(), Some(0), "a round tool of 6 mm: {}", stderr(&judged));
}

#[test]
fn a_tool_that_turns_with_the_walls_makes_a_proven_program_with_c_words() {
    let folder = Sandbox::new();
    folder.write("pocket.json", POCKET);
    let (drawing, program, plot) = (folder.path("pocket.json"), folder.path("a.ngc"), folder.path("a.svg"));
    for (profile, way) in [("rect:6x2", ""), ("rounded:6x3r1", "--conventional"), ("ellipse:6x3", "")] {
        let mut command = pocketry();
        command.args(["pocket", &drawing, "--tool-profile", profile, "--turning", "--depth", "2", "-o", &program]);
        let run = command.args(["--plot", &plot]).args(Some(way).filter(|w| !w.is_empty())).output().unwrap();
        assert_eq!(run.status.code(), Some(0), "{profile}: {}", stderr(&run));
        let text = folder.read("a.ngc");
        assert!(text.contains("turns with the walls") && text.contains(" C"), "{profile}");
        let judge = |more: &[&str]| {
            let run =
                pocketry().args(["verify", &drawing, &program, "--tool-profile", profile]).args(more).output().unwrap();
            run.status.code()
        };
        assert_eq!(judge(&["--turning"]), Some(0), "{profile}");
        assert_ne!(judge(&[]), Some(0), "{profile}: it does turn");
    }
}

/// Where a wall bends away smoothly, a tool that touches it can go no further, and one with a micrometre to spare can.
#[test]
fn a_turning_tool_follows_smooth_bends_and_fits_channels_of_its_own_width() {
    let folder = Sandbox::new();
    let rounded = r"[[[9.955255383,0,0],[40.4,0,0.414213562373095],[50.355255383,9.955255383,0],[50.355255383,30,0],[0,30,0],
        [0,9.955255383,0.414213562373095]]]";
    let slot = "[[[0,0,0],[20,0,0],[20,4,0],[60,4,0],[60,6,0],[20,6,0],[20,20,0],[0,20,0]]]";
    for loops in [rounded, slot] {
        folder.write("pocket.json", format!(r#"{{"id":"p","loops":{loops}}}"#));
        let (drawing, program) = (folder.path("pocket.json"), folder.path("a.ngc"));
        let args = ["pocket", &drawing, "--tool-profile", "rect:4x2", "--turning", "--depth", "2", "-o", &program];
        let run = pocketry().args(args).output().unwrap();
        assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
    }
    let program = folder.read("a.ngc");
    let places = program.lines().filter_map(|l| l.split_once('X')?.1.split(' ').next()?.parse().ok());
    let deepest = places.fold(0.0, f64::max);
    assert!((57.9..=58.0).contains(&deepest), "it goes to the end of the channel: X{deepest}");
}

#[test]
fn a_tool_is_drawn_in_svg_or_dxf_too() {
    let folder = Sandbox::new();
    folder.write("pocket.json", POCKET);
    folder.write(
        "tool.svg",
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="10mm" height="10mm" viewBox="0 0 10 10"><path d="M-3 8H3V12H-3Z"/></svg>"#,
    );
    let vertex = |x: f64, y: f64| format!("0\nVERTEX\n8\n0\n10\n{x}\n20\n{y}\n");
    let corners = [(-3.0, -2.0), (3.0, -2.0), (3.0, 2.0), (-3.0, 2.0)].map(|(x, y)| vertex(x, y)).concat();
    folder.write(
        "tool.dxf",
        format!("0\nSECTION\n2\nENTITIES\n0\nPOLYLINE\n8\n0\n66\n1\n70\n1\n{corners}0\nSEQEND\n0\nENDSEC\n0\nEOF\n"),
    );
    let drawing = folder.path("pocket.json");
    for name in ["tool.svg", "tool.dxf"] {
        let (profile, program) = (format!("file:{}", folder.path(name)), folder.path("a.ngc"));
        let args = ["--tool-profile", &profile, "-o", &program];
        let run = pocketry().args(["pocket", &drawing]).args(args).output().unwrap();
        assert_eq!(run.status.code(), Some(0), "{name}: {}", stderr(&run));
        let judged = pocketry().args(["verify", &drawing, &program, "--tool-profile", "rect:6x4"]).output().unwrap();
        assert_eq!(judged.status.code(), Some(0), "{name}: {}", stderr(&judged));
    }
}

#[test]
fn the_report_tells_what_a_profile_cannot_reach() {
    let folder = Sandbox::new();
    folder.write("pocket.json", POCKET);
    let (drawing, report) = (folder.path("pocket.json"), folder.path("r.json"));
    let left = |profile: &str| {
        let args = ["--tool-profile", profile, "-o", &folder.path("a.ngc"), "--report", &report];
        let run = pocketry().args(["pocket", &drawing]).args(args).output().unwrap();
        assert_eq!(run.status.code(), Some(0), "{profile}: {}", stderr(&run));
        let read: serde_json::Value = serde_json::from_str(&folder.read("r.json")).unwrap();
        read["unreachable_area"].as_f64().unwrap()
    };
    let corners = (4.0 - std::f64::consts::PI) * 4.0;
    assert!((left("circle:4") - corners).abs() < 1.0, "{}", left("circle:4"));
    assert!(left("rect:4x4") < left("circle:4"));
}
