//! LinuxCNC (2.8 and later).
//!
//! The interpreter's rules that matter here: arc centres relative to the start (G91.1); an arc's two radii may differ
//! by the set tolerance only; a sweep below 1e-6 is read as a full turn; a plain G64 would cut corners without bound,
//! so exact path (G61) is said unless a blending tolerance is asked for; comments can't hold brackets. The rotary axis of a tool
//! that turns is C, in degrees; it goes along linearly with lines and arcs, and F stays the speed along the path.

use super::words::{Blocks, plain};
use super::{Dialect, PathControl, PostError, PostOptions};
use crate::post::OutputUnit;
use pocketry_motion::Program;

/// The LinuxCNC dialect.
#[derive(Clone, Copy, Debug, Default)]
pub struct LinuxCnc;

impl Dialect for LinuxCnc {
    fn name(&self) -> &'static str {
        "LinuxCNC"
    }

    fn write(&self, program: &Program, options: &PostOptions) -> Result<String, PostError> {
        check_speeds(options)?;
        let mut blocks = Blocks::new(options);
        header(&mut blocks, options, self.name());
        for (k, step) in program.moves.iter().enumerate() {
            blocks.step(step, program.headings.get(k).copied())?;
        }
        for word in ["M5", "M9", "M2"] {
            blocks.line(word);
        }
        Ok(blocks.finish())
    }
}

fn check_speeds(options: &PostOptions) -> Result<(), PostError> {
    let feeds = &options.feeds;
    let speeds = [
        ("cutting feed", feeds.cut),
        ("ramp feed", feeds.ramp),
        ("plunge feed", feeds.plunge),
        ("spindle speed", feeds.spindle),
    ];
    match speeds.into_iter().find(|&(_, value)| !(value > 0.0 && value.is_finite())) {
        Some((what, value)) => Err(PostError::BadSpeed { what, value }),
        None => Ok(()),
    }
}

fn header(blocks: &mut Blocks, options: &PostOptions, name: &str) {
    for line in &options.header {
        blocks.comment(line);
    }
    let unit = options.unit.sign();
    blocks.comment(&format!("{name}, {unit}, {} decimals", options.decimals));
    let units_word = match options.unit {
        OutputUnit::Millimetre => "G21",
        OutputUnit::Inch => "G20",
    };
    blocks.line(&format!("G17 {units_word} G40 G49 G80 G90 G91.1 G94"));
    match options.path_control {
        PathControl::Exact => blocks.line("G61"),
        PathControl::Blend(mm) => {
            blocks.line(&format!("G64 P{:.width$}", mm / options.unit.millimetres(), width = options.decimals + 1));
        }
    }
    blocks.line(&format!("T{} M6", options.tool.number));
    blocks.line(&format!("S{} M3", plain(options.feeds.spindle)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use pocketry_geom::point;
    use pocketry_motion::{FeedKind, Feeds, Move, Point3, Tool};

    fn at(x: f64, y: f64, z: f64) -> Point3 {
        Point3 { x, y, z }
    }

    fn options(unit: OutputUnit) -> PostOptions {
        PostOptions::for_tool(Tool { diameter: 6.0, number: 1 }, Feeds::default(), unit)
    }

    fn lines_after_setup(program: &Program, unit: OutputUnit) -> Vec<String> {
        let text = LinuxCnc.write(program, &options(unit)).unwrap();
        text.lines().skip_while(|l| !l.starts_with('S')).skip(1).map(str::to_owned).collect()
    }

    fn small_program() -> Program {
        Program {
            moves: vec![
                Move::Rapid { to: at(5.0, 0.0, 10.0) },
                Move::Rapid { to: at(5.0, 0.0, 2.0) },
                Move::Arc { to: at(5.0, 0.0, -1.0), center: point(0.0, 0.0), ccw: true, feed: FeedKind::Ramp },
                Move::Line { to: at(5.0, 3.0, -1.0), feed: FeedKind::Cut },
                Move::Line { to: at(5.000_01, 3.000_01, -1.0), feed: FeedKind::Cut },
                Move::Line { to: at(6.0, 3.0, -1.0), feed: FeedKind::Cut },
                Move::Rapid { to: at(6.0, 3.0, 10.0) },
            ],
            ..Program::default()
        }
    }

    #[test]
    fn modal_words_are_left_out_and_empty_moves_skipped() {
        let expected = [
            "G0 Z10.0",
            "X5.0 Y0.0",
            "Z2.0",
            "G3 X-5.0 Y0.0 Z0.5 I-5.0 J0.0 F300",
            "X5.0 Y0.0 Z-1.0 I5.0 J0.0",
            "G1 Y3.0 F600",
            "X6.0",
            "G0 Z10.0",
            "M5",
            "M9",
            "M2",
        ];
        assert_eq!(lines_after_setup(&small_program(), OutputUnit::Millimetre), expected);
    }

    #[test]
    fn inches_divide_lengths_and_feeds() {
        let lines = lines_after_setup(&small_program(), OutputUnit::Inch);
        assert_eq!(lines[0], "G0 Z0.3937");
        assert!(lines[3].ends_with(" F11.811"), "{}", lines[3]);
    }

    #[test]
    fn a_rapid_goes_up_before_it_goes_across_and_down_after() {
        let program = Program {
            moves: vec![
                Move::Rapid { to: at(0.0, 0.0, 2.0) },
                Move::Rapid { to: at(1.0, 1.0, 9.0) },
                Move::Rapid { to: at(2.0, 2.0, 3.0) },
            ],
            ..Program::default()
        };
        let lines = lines_after_setup(&program, OutputUnit::Millimetre);
        assert_eq!(lines[2..6], ["Z9.0", "X1.0 Y1.0", "X2.0 Y2.0", "Z3.0"]);
    }

    #[test]
    fn a_tool_that_turns_has_c_words() {
        let turn = std::f64::consts::FRAC_PI_2;
        let headings = vec![0.0, 0.0, 4.0 * turn, 4.0 * turn, 4.0 * turn, 4.0 * turn, 5.0 * turn];
        let program = Program { headings, ..small_program() };
        let expected = [
            "G0 Z10.0",
            "X5.0 Y0.0 C0.0000",
            "Z2.0",
            "G3 X-5.0 Y0.0 Z0.5 C180.0000 I-5.0 J0.0 F300",
            "X5.0 Y0.0 Z-1.0 C360.0000 I5.0 J0.0",
            "G1 Y3.0 F600",
            "X6.0",
            "G0 Z10.0",
            "C450.0000",
        ];
        assert_eq!(lines_after_setup(&program, OutputUnit::Millimetre)[..9], expected);
        let inches = lines_after_setup(&program, OutputUnit::Inch);
        assert!(inches[3].contains("C180.0000"), "{}", inches[3]);
    }

    #[test]
    fn small_tools_get_more_decimals() {
        let decimals =
            |diameter, unit| PostOptions::for_tool(Tool { diameter, number: 1 }, Feeds::default(), unit).decimals;
        assert_eq!(decimals(6.0, OutputUnit::Millimetre), 4);
        assert_eq!(decimals(6.0, OutputUnit::Inch), 5);
        assert_eq!(decimals(0.002, OutputUnit::Millimetre), 6);
    }

    #[test]
    fn comments_cannot_break_out() {
        let mut options = options(OutputUnit::Millimetre);
        options.header = vec!["a (b) ü\nM3".to_owned()];
        let text = LinuxCnc.write(&small_program(), &options).unwrap();
        assert_eq!(text.lines().next(), Some("(a [b] ??M3)"));
    }

    #[test]
    fn feeds_must_be_positive() {
        let mut options = options(OutputUnit::Millimetre);
        options.feeds.cut = 0.0;
        assert!(matches!(LinuxCnc.write(&small_program(), &options), Err(PostError::BadSpeed { .. })));
    }
}
