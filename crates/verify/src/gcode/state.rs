//! The control's modal state, and the walk through a program.

use super::arcs::ArcMove;
use super::words::{Word, words};
use super::{Kind, Motion, ProgramError, Trace};
use pocketry_geom::{Point, Segment, point};
use pocketry_motion::Point3;

/// Millimetres in an inch.
const INCH: f64 = 25.4;

/// No machine goes farther, mm: no drawing does.
const LARGEST: f64 = pocketry_geom::tolerance::ABSURD;

/// No rotary axis goes farther, degrees.
const MOST_DEGREES: f64 = 1e7;

/// The modal motion.
#[derive(Clone, Copy, PartialEq)]
enum Mode {
    Rapid,
    Line,
    Arc { ccw: bool },
}

/// How the control rounds the corners of the path.
#[derive(Clone, Copy, PartialEq)]
enum Blending {
    /// Within this distance, mm; 0 for G61.
    Within(f64),
    /// As far as speed asks for.
    Unbounded,
}

/// What coordinates count from.
#[derive(Clone, Copy, PartialEq)]
enum Frame {
    Absolute,
    /// The place where the move starts.
    Relative,
}

struct State {
    mode: Option<Mode>,
    unit: f64,
    targets: Frame,
    centers: Frame,
    blending: Blending,
    feed: bool,
    spindle: bool,
    at: [Option<f64>; 3],
    /// The rotary axis C, degrees.
    turn: Option<f64>,
}

/// Reads a program.
pub(crate) fn read(text: &str) -> Result<Trace, ProgramError> {
    let mut state = State {
        mode: None,
        unit: 1.0,
        targets: Frame::Absolute,
        centers: Frame::Relative,
        blending: Blending::Unbounded,
        feed: false,
        spindle: false,
        at: [None; 3],
        turn: None,
    };
    let mut trace = Trace { resolution: f64::INFINITY, ..Trace::default() };
    let mut buffer = Vec::new();
    for (line, text) in (1..).zip(text.lines()) {
        if text.trim() == "%" {
            continue;
        }
        words(text, line, &mut buffer)?;
        let block = Block::new(&buffer, line)?;
        state.run(&block, &mut trace)?;
        if trace.ended {
            break;
        }
    }
    Ok(trace)
}

/// The words of one line, sorted out.
struct Block {
    line: u32,
    codes: Vec<Word>,
    /// Words with a value, by letter.
    values: [Option<Word>; 26],
}

impl Block {
    fn new(words: &[Word], line: u32) -> Result<Self, ProgramError> {
        let mut block = Self { line, codes: Vec::new(), values: [None; 26] };
        for &word in words {
            match word.letter {
                'G' | 'M' => block.codes.push(word),
                'C' | 'F' | 'H' | 'I' | 'J' | 'K' | 'N' | 'P' | 'Q' | 'R' | 'S' | 'T' | 'X' | 'Y' | 'Z' => {
                    let slot = &mut block.values[word.letter as usize - 'A' as usize];
                    if slot.replace(word).is_some() {
                        return Err(ProgramError::Clash { line, word: word.text() });
                    }
                }
                _ => return Err(ProgramError::Unsupported { line, code: word.text() }),
            }
        }
        Ok(block)
    }

    fn word(&self, letter: char) -> Option<Word> {
        self.values[letter as usize - 'A' as usize]
    }

    fn value(&self, letter: char) -> Option<f64> {
        self.word(letter).map(|w| w.value)
    }

    fn has_any(&self, letters: &str) -> bool {
        letters.chars().any(|c| self.word(c).is_some())
    }

    /// A length in millimetres.
    fn length(&self, letter: char, unit: f64) -> Result<Option<f64>, ProgramError> {
        let Some(word) = self.word(letter) else { return Ok(None) };
        let value = word.value * unit;
        if value.abs() > LARGEST {
            return Err(ProgramError::Range { line: self.line, word: word.text() });
        }
        Ok(Some(value))
    }
}

impl State {
    /// Runs one block: settings first, then the motion, then the end of the program, as the control does.
    fn run(&mut self, block: &Block, trace: &mut Trace) -> Result<(), ProgramError> {
        let line = block.line;
        let mut groups = 0u32;
        let mut motion_named = false;
        let (mut dwell, mut stop) = (false, false);
        for word in &block.codes {
            let (group, effect) = self.effect(word, block)?;
            if group != 0 && groups & (1 << group) != 0 {
                return Err(ProgramError::Clash { line, word: word.text() });
            }
            groups |= 1 << group;
            match effect {
                Effect::None => {}
                Effect::Motion => motion_named = true,
                Effect::Dwell => dwell = true,
                Effect::Stop => stop = true,
            }
        }
        self.feed |= block.value('F').is_some_and(|f| f > 0.0);
        let moves = block.has_any("CXYZIJKR");
        if moves && (!dwell || motion_named) {
            self.motion(block, trace)?;
        }
        trace.ended |= stop;
        Ok(())
    }

    /// Applies one G or M code; gives its modal group (0 for none) and what else it does.
    fn effect(&mut self, word: &Word, block: &Block) -> Result<(u32, Effect), ProgramError> {
        let unsupported = || ProgramError::Unsupported { line: block.line, code: word.text() };
        let code = word.code().ok_or_else(unsupported)?;
        if word.letter == 'M' {
            return self.machine(code).ok_or_else(unsupported);
        }
        let mut mode = |m| {
            self.mode = m;
            Ok((1, Effect::Motion))
        };
        match code {
            0 => return mode(Some(Mode::Rapid)),
            10 => return mode(Some(Mode::Line)),
            20 => return mode(Some(Mode::Arc { ccw: false })),
            30 => return mode(Some(Mode::Arc { ccw: true })),
            40 => return Ok((15, Effect::Dwell)),
            800 => {
                self.mode = None;
                return Ok((1, Effect::None));
            }
            _ => {}
        }
        let group = match code {
            170 => 2,
            200 | 210 => {
                self.unit = if code == 200 { INCH } else { 1.0 };
                6
            }
            400 => 7,
            490 => 8,
            540 => 12,
            610 | 611 => {
                self.blending = Blending::Within(0.0);
                13
            }
            640 => {
                self.blending = self.tolerance(block);
                13
            }
            900 | 910 => {
                self.targets = if code == 910 { Frame::Relative } else { Frame::Absolute };
                3
            }
            901 | 911 => {
                self.centers = if code == 911 { Frame::Relative } else { Frame::Absolute };
                4
            }
            940 => 5,
            _ => return Err(unsupported()),
        };
        Ok((group, Effect::None))
    }

    /// What G64 allows: P off the corners, and Q (P where it is not given) where short lines are joined.
    fn tolerance(&self, block: &Block) -> Blending {
        match block.value('P') {
            Some(p) if p > 0.0 => Blending::Within((p + block.value('Q').unwrap_or(p).max(0.0)) * self.unit),
            _ => Blending::Unbounded,
        }
    }

    fn machine(&mut self, code: u32) -> Option<(u32, Effect)> {
        match code {
            0 | 10 => Some((20, Effect::None)),
            20 | 300 => Some((20, Effect::Stop)),
            30 | 40 => {
                self.spindle = true;
                Some((21, Effect::None))
            }
            50 => {
                self.spindle = false;
                Some((21, Effect::None))
            }
            60 => Some((22, Effect::None)),
            70 | 80 | 90 => Some((0, Effect::None)),
            480 | 490 => Some((24, Effect::None)),
            _ => None,
        }
    }

    fn motion(&mut self, block: &Block, trace: &mut Trace) -> Result<(), ProgramError> {
        let line = block.line;
        let mode = self.mode.ok_or(ProgramError::NoMotionMode { line })?;
        let kind = match mode {
            Mode::Rapid => Kind::Rapid,
            Mode::Line => Kind::Line,
            Mode::Arc { .. } => Kind::Arc,
        };
        if kind != Kind::Arc && block.has_any("IJKR") || block.has_any("K") {
            return Err(ProgramError::Unsupported { line, code: "I, J, K or R here".into() });
        }
        if kind != Kind::Rapid && !self.feed {
            return Err(ProgramError::NoFeed { line });
        }
        let end = self.target(block, trace)?;
        let (start, turn) = (self.at, (self.turn, self.turn_target(block, trace)?));
        if kind != Kind::Rapid && (start.contains(&None) || end.contains(&None)) {
            return Err(ProgramError::UnknownStart { line });
        }
        let known = start[0].is_some() && start[1].is_some();
        let place = |at: [Option<f64>; 3], other: [Option<f64>; 3]| {
            let axis = |k: usize| at[k].or(other[k]).unwrap_or(0.0);
            Point3 { x: axis(0), y: axis(1), z: at[2].unwrap_or(f64::INFINITY) }
        };
        let (from, to) = (place(start, end), place(end, start));
        let first = trace.curves.len() as u32;
        let (slack, flat_length) = if let Mode::Arc { ccw } = mode {
            self.arc(block, (from.xy(), to.xy(), ccw), trace)?
        } else {
            trace.curves.push(Segment::line(from.xy(), to.xy()));
            (0.0, from.xy().distance(to.xy()))
        };
        let rise = if from.z.is_finite() { to.z - from.z } else { 0.0 };
        let blending = self.blend(kind, line, trace);
        trace.motions.push(Motion {
            line,
            kind,
            from,
            to,
            first,
            count: trace.curves.len() as u32 - first,
            length: flat_length.hypot(rise),
            slack: slack + blending,
            known,
            turn: [turn.0.or(turn.1), turn.1].map(|c| c.unwrap_or(0.0).to_radians()),
            turn_known: turn.0.is_some(),
        });
        if kind != Kind::Rapid && !self.spindle {
            trace.spindle_stopped.get_or_insert(line);
        }
        self.at = end;
        self.turn = turn.1;
        Ok(())
    }

    /// Where the block's C word turns the rotary axis, degrees.
    fn turn_target(&self, block: &Block, trace: &mut Trace) -> Result<Option<f64>, ProgramError> {
        let Some(word) = block.word('C') else { return Ok(self.turn) };
        let base = match self.targets {
            Frame::Absolute => 0.0,
            Frame::Relative => self.turn.ok_or(ProgramError::UnknownStart { line: block.line })?,
        };
        let turn = base + word.value;
        if turn.abs() > MOST_DEGREES {
            return Err(ProgramError::Range { line: block.line, word: word.text() });
        }
        if turn % 360.0 != 0.0 {
            trace.turned.get_or_insert(block.line);
        }
        Ok(Some(turn))
    }

    /// How far blending may take the tool off this move.
    fn blend(&self, kind: Kind, line: u32, trace: &mut Trace) -> f64 {
        match self.blending {
            Blending::Within(d) => d,
            Blending::Unbounded => {
                if kind != Kind::Rapid {
                    trace.unbounded_blending.get_or_insert(line);
                }
                0.0
            }
        }
    }

    /// Where the block's axis words lead.
    fn target(&self, block: &Block, trace: &mut Trace) -> Result<[Option<f64>; 3], ProgramError> {
        let mut end = self.at;
        for (slot, letter) in end.iter_mut().zip(['X', 'Y', 'Z']) {
            if let Some(value) = block.length(letter, self.unit)? {
                let base = if self.targets == Frame::Relative {
                    slot.ok_or(ProgramError::UnknownStart { line: block.line })?
                } else {
                    0.0
                };
                *slot = Some(base + value);
                if letter != 'Z' {
                    let decimals = block.word(letter).map_or(0, |w| w.decimals);
                    trace.resolution = trace.resolution.min(self.unit * 10f64.powi(-decimals));
                }
            }
        }
        Ok(end)
    }

    /// Adds an arc's curves; gives its slack and its length in the plane.
    fn arc(
        &self,
        block: &Block,
        (start, end, ccw): (Point, Point, bool),
        trace: &mut Trace,
    ) -> Result<(f64, f64), ProgramError> {
        let line = block.line;
        let failed = |reason: &str| ProgramError::Arc { line, reason: reason.into() };
        let center = if let Some(radius) = block.length('R', self.unit)? {
            if block.has_any("IJ") {
                return Err(ProgramError::Clash { line, word: "R".into() });
            }
            ArcMove::center_of_radius(start, end, radius, ccw, line)?
        } else {
            let (i, j) = (block.length('I', self.unit)?, block.length('J', self.unit)?);
            match (self.centers, i, j) {
                (Frame::Absolute, Some(i), Some(j)) => point(i, j),
                (Frame::Absolute, ..) => return Err(failed("G90.1 needs both I and J")),
                (Frame::Relative, None, None) => return Err(failed("I, J and R are missing")),
                (Frame::Relative, i, j) => point(start.x + i.unwrap_or(0.0), start.y + j.unwrap_or(0.0)),
            }
        };
        let turns = block.value('P').unwrap_or(1.0);
        if turns.fract() != 0.0 || !(1.0..=1e6).contains(&turns) {
            return Err(failed("P must be a whole number of turns"));
        }
        let swept =
            ArcMove { start, end, center, ccw, extra_turns: turns as u32 - 1, line }.sweep(&mut trace.curves)?;
        Ok((swept.slack, swept.length))
    }
}

/// What a code does beside changing the modal state.
#[derive(Clone, Copy, PartialEq)]
enum Effect {
    None,
    Motion,
    Dwell,
    Stop,
}
