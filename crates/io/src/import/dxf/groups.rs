//! The lowest layer of a DXF file: pairs of lines, a group code and a value.

use crate::import::error::{FaultKind, ImportError, Place};
use std::borrow::Cow;

/// A group code and its value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Group<'a> {
    /// What the value means.
    pub(super) code: i32,
    /// The value, without surrounding blanks.
    pub(super) value: &'a str,
    /// The value's line in the file, from 1.
    pub(super) line: usize,
}

impl Group<'_> {
    /// The value as a finite number.
    pub(super) fn number(&self) -> Result<f64, ImportError> {
        self.value.parse::<f64>().ok().filter(|x| x.is_finite()).ok_or_else(|| {
            let hint = "numbers are written like 12.5; save the drawing again";
            self.error(&format!("{:?} is not a usable number (group {})", self.value, self.code), hint)
        })
    }

    /// The value as a whole number.
    pub(super) fn integer(&self) -> Result<i64, ImportError> {
        match self.value.parse::<i64>() {
            Ok(n) => Ok(n),
            Err(_) => Ok(self.number()?.round() as i64),
        }
    }

    /// An error about this value.
    pub(super) fn error(&self, problem: &str, hint: &str) -> ImportError {
        ImportError::new(FaultKind::Value, Place::line(self.line), problem, hint)
    }
}

/// Reads groups one by one.
pub(super) struct Groups<'a> {
    rest: &'a str,
    line: usize,
}

impl<'a> Groups<'a> {
    /// A reader of a whole file's text.
    pub(super) fn new(text: &'a str) -> Self {
        Self { rest: text, line: 0 }
    }

    /// The next group that is no comment, or `None` at the end of the file.
    pub(super) fn next(&mut self) -> Result<Option<Group<'a>>, ImportError> {
        const COMMENT: i32 = 999;
        loop {
            let Some(code_line) = self.next_line() else { return Ok(None) };
            if code_line.is_empty() && self.rest.trim().is_empty() {
                return Ok(None);
            }
            let code = code_line.parse::<i32>().ok().filter(|c| (-5..=1071).contains(c)).ok_or_else(|| {
                let shown: String = code_line.chars().take(30).collect();
                let problem = format!("{shown:?} stands where a group code is due");
                syntax(self.line, &problem, "a line is missing or added above, or this is no ASCII DXF file")
            })?;
            let Some(value) = self.next_line() else {
                return Err(syntax(self.line, "the file ends between a group code and its value", CUT_HINT));
            };
            if code != COMMENT {
                return Ok(Some(Group { code, value, line: self.line }));
            }
        }
    }

    /// The line read last.
    pub(super) fn line(&self) -> usize {
        self.line
    }

    fn next_line(&mut self) -> Option<&'a str> {
        if self.rest.is_empty() {
            return None;
        }
        self.line += 1;
        let (line, rest) = self.rest.split_once('\n').unwrap_or((self.rest, ""));
        self.rest = rest;
        Some(line.trim())
    }
}

/// What to do about a file that stops too early.
pub(super) const CUT_HINT: &str = "the file is cut; copy or save it again";

/// A breach of the format's rules.
pub(super) fn syntax(line: usize, problem: &str, hint: &str) -> ImportError {
    ImportError::new(FaultKind::Syntax, Place::line(line), problem, hint)
}

/// The file as text, or what else it is. The second part says what had to be healed.
pub(super) fn decode(bytes: &[u8]) -> Result<(Cow<'_, str>, Option<&'static str>), ImportError> {
    let refuse = |problem: &str| {
        let hint = "save the drawing as ASCII DXF (any release)";
        Err(ImportError::new(FaultKind::Format, Place::default(), problem, hint))
    };
    if bytes.trim_ascii().is_empty() {
        return refuse("the file is empty");
    }
    if bytes.starts_with(b"AutoCAD Binary DXF") {
        return refuse("binary DXF is not read");
    }
    if bytes.len() > 6 && bytes.starts_with(b"AC10") && bytes[4..6].iter().all(u8::is_ascii_digit) {
        return refuse("this is a DWG file under another name, and DWG is not supported");
    }
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return refuse("the file is UTF-16 text");
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if bytes.contains(&0) {
        return refuse("the file is binary, not a DXF drawing");
    }
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|&b| char::from(b)).collect()),
    };
    if !text.contains('\n') && text.contains('\r') {
        return Ok((Cow::Owned(text.replace('\r', "\n")), Some("lines end as on old Macintoshes; read all the same")));
    }
    Ok((text, None))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_are_trimmed_and_comments_skipped() {
        let mut groups = Groups::new("999\nhello\n  0\r\n SECTION \r\n\n");
        assert_eq!(groups.next().unwrap(), Some(Group { code: 0, value: "SECTION", line: 4 }));
        assert_eq!(groups.next().unwrap(), None);
    }

    #[test]
    fn a_cut_pair_and_a_garbled_code_are_errors_with_their_line() {
        assert!(Groups::new("0").next().unwrap_err().to_string().contains("line 1"));
        let error = Groups::new("0\nSECTION\nten\n0\n");
        let mut groups = error;
        groups.next().unwrap();
        assert!(groups.next().unwrap_err().to_string().starts_with("line 3"));
    }

    #[test]
    fn numbers_must_be_finite() {
        for bad in ["nan", "inf", "-1.#INF", "1e999", "1,5", "three", ""] {
            assert!(Group { code: 10, value: bad, line: 1 }.number().is_err(), "{bad}");
        }
        assert_eq!(Group { code: 10, value: "-1.5e1", line: 1 }.number().unwrap(), -15.0);
    }
}
