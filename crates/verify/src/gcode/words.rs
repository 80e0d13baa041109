//! Splits a line of G-code into words.

use super::ProgramError;

/// A letter and its number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Word {
    pub(super) letter: char,
    pub(super) value: f64,
    /// Digits after the point.
    pub(super) decimals: i32,
}

impl Word {
    /// As it would be written.
    pub(super) fn text(&self) -> String {
        format!("{}{}", self.letter, self.value)
    }

    /// Ten times the value of a G or M code, which has one decimal at most.
    pub(super) fn code(&self) -> Option<u32> {
        let tenfold = (self.value * 10.0).round();
        ((0.0..10_000.0).contains(&tenfold) && tenfold / 10.0 == self.value).then_some(tenfold as u32)
    }
}

/// Reads the words of one line into `out`; spaces mean nothing, case neither, comments are left out.
pub(super) fn words(text: &str, line: u32, out: &mut Vec<Word>) -> Result<(), ProgramError> {
    out.clear();
    let failed = || ProgramError::Syntax { line, text: text.trim().chars().take(60).collect() };
    let bytes = text.as_bytes();
    let mut at = 0;
    loop {
        at = skip(bytes, at).ok_or_else(failed)?;
        let Some(&letter) = bytes.get(at) else { return Ok(()) };
        if !letter.is_ascii_alphabetic() {
            return Err(failed());
        }
        let letter = letter.to_ascii_uppercase() as char;
        let (value, decimals, after) = number(bytes, at + 1).ok_or_else(failed)?;
        out.push(Word { letter, value, decimals });
        at = after;
    }
}

/// The next place that holds neither blanks nor a comment; `None` in a comment that does not end.
fn skip(bytes: &[u8], mut at: usize) -> Option<usize> {
    while let Some(b) = bytes.get(at) {
        match b {
            b'(' => at += bytes[at..].iter().position(|&b| b == b')')? + 1,
            b';' => return Some(bytes.len()),
            b if b.is_ascii_whitespace() => at += 1,
            _ => break,
        }
    }
    Some(at)
}

/// A decimal number with optional sign from `at`: value, digits after the point, where it ends.
fn number(bytes: &[u8], at: usize) -> Option<(f64, i32, usize)> {
    let mut digits = [0u8; 40];
    let (mut length, mut at) = (0, skip(bytes, at)?);
    let (mut point, mut decimals, mut any) = (false, 0, false);
    while let Some(&b) = bytes.get(at) {
        match b {
            b'+' | b'-' if length == 0 => {}
            b'.' if !point => point = true,
            b'0'..=b'9' => {
                any = true;
                decimals += i32::from(point);
            }
            b' ' | b'\t' | b'\r' => {
                at += 1;
                continue;
            }
            _ => break,
        }
        *digits.get_mut(length)? = b;
        length += 1;
        at += 1;
    }
    let value = std::str::from_utf8(&digits[..length]).ok()?.parse().ok()?;
    any.then_some((value, decimals, at))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<(char, f64)>, ProgramError> {
        let mut out = Vec::new();
        words(text, 7, &mut out)?;
        Ok(out.iter().map(|w| (w.letter, w.value)).collect())
    }

    #[test]
    fn blanks_case_and_comments_mean_nothing() {
        assert_eq!(read("g 1x-1 .5(to Y9)y+.25 ; Z4").unwrap(), [('G', 1.0), ('X', -1.5), ('Y', 0.25)]);
        assert_eq!(read("  (all) \r").unwrap(), []);
    }

    #[test]
    fn what_is_not_a_word_is_refused_with_its_line() {
        for text in ["X", "X[1+2]", "#1=3", "1", "X--1", "X1.2.3", "X(1", "/G1", "O100 sub"] {
            assert!(matches!(read(text), Err(ProgramError::Syntax { line: 7, .. })), "{text}");
        }
    }
}
