//! From bytes to a parsed XML document, nothing outside the file read and nothing multiplied without bound.

use crate::import::error::{FaultKind, ImportError, Place};
use roxmltree::{Document, ParsingOptions};
use std::borrow::Cow;

/// More text than this may not come out of a document's entities, bytes.
const MAX_ENTITY_TEXT: usize = 1 << 24;

/// XML documents of more nodes than this are refused.
const MAX_NODES: u32 = 4_000_000;

/// Elements nested deeper than this are refused before they are parsed.
const MAX_NESTING: usize = 10_000;

fn refuse(kind: FaultKind, problem: impl Into<String>, hint: &str) -> ImportError {
    ImportError::new(kind, Place::default(), problem, hint)
}

/// The document's text.
pub(super) fn decode(bytes: &[u8]) -> Result<Cow<'_, str>, ImportError> {
    if bytes.starts_with(&[0x1f, 0x8b]) {
        return Err(refuse(FaultKind::Format, "the SVG is compressed (svgz)", "decompress it with gunzip first"));
    }
    if let Some((first, rest)) = bytes.split_first_chunk::<2>() {
        let unit: Option<fn([u8; 2]) -> u16> = match first {
            [0xff, 0xfe] => Some(u16::from_le_bytes),
            [0xfe, 0xff] => Some(u16::from_be_bytes),
            _ => None,
        };
        if let Some(unit) = unit {
            let units = rest.chunks_exact(2).map(|c| unit([c[0], c[1]]));
            let text: Result<String, _> = char::decode_utf16(units).collect();
            return text
                .map(Cow::Owned)
                .map_err(|_| refuse(FaultKind::Syntax, "the file begins as UTF-16 and isn't", "save it as UTF-8"));
        }
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    std::str::from_utf8(bytes).map(Cow::Borrowed).or_else(|e| {
        if declares_latin1(bytes) {
            return Ok(Cow::Owned(bytes.iter().map(|&b| char::from(b)).collect()));
        }
        let line = bytes[..e.valid_up_to()].split(|&b| b == b'\n').count();
        let problem = "the file is not UTF-8 text, as it claims to be";
        Err(ImportError::new(FaultKind::Syntax, Place::line(line), problem, "save it as UTF-8"))
    })
}

fn declares_latin1(bytes: &[u8]) -> bool {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(200)]).to_ascii_lowercase();
    head.starts_with("<?xml") && ["iso-8859-1", "windows-1252", "latin1"].iter().any(|name| head.contains(name))
}

/// The document, whose root is an `svg` element.
pub(super) fn parse(text: &str) -> Result<Document<'_>, ImportError> {
    check_entities(text)?;
    check_nesting(text)?;
    let options = ParsingOptions { allow_dtd: true, nodes_limit: MAX_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|e| {
        let line = e.pos().row as usize;
        ImportError::new(FaultKind::Syntax, Place::line(line), format!("not well-formed XML: {e}"), "export it again")
    })?;
    let root = document.root_element().tag_name().name();
    if root == "svg" {
        Ok(document)
    } else {
        Err(refuse(FaultKind::Format, format!("the file is a <{root}> document, not an SVG"), "give an SVG file"))
    }
}

/// Refuses entities that point outside the file, refer to each other, or would multiply into too much text.
fn check_entities(text: &str) -> Result<(), ImportError> {
    let mut rest = text;
    let mut longest = 0;
    while let Some((_, after)) = rest.split_once("<!ENTITY") {
        let quote = after.find(['"', '\'']).unwrap_or(after.len());
        let (head, value) = after.split_at(quote);
        if head.contains("SYSTEM") || head.contains("PUBLIC") {
            return Err(refuse(
                FaultKind::Syntax,
                "the file wants other files read (an external entity)",
                "nothing outside a drawing is read; export it again without a DTD",
            ));
        }
        let mark = value.chars().next().unwrap_or('"');
        let value = value.get(1..).and_then(|v| v.split(mark).next()).unwrap_or_default();
        let nested = value.split('&').skip(1).any(|r| !r.starts_with('#'));
        if nested {
            let hint = "export it again without a DTD";
            return Err(refuse(FaultKind::Limit, "the file's entities refer to one another", hint));
        }
        longest = longest.max(value.len());
        rest = after;
    }
    let references = if longest > 0 { text.bytes().filter(|&b| b == b'&').count() } else { 0 };
    if references.saturating_mul(longest) > MAX_ENTITY_TEXT {
        let problem = format!("the file's entities expand to more than {} MB", MAX_ENTITY_TEXT >> 20);
        return Err(refuse(FaultKind::Limit, problem, "export it again without a DTD"));
    }
    Ok(())
}

/// Refuses documents nested so deep that walking them is no reading of a drawing; counts tags without parsing them.
fn check_nesting(text: &str) -> Result<(), ImportError> {
    let bytes = text.as_bytes();
    let (mut depth, mut deepest, mut tag) = (0_usize, 0_usize, None);
    for (k, &byte) in bytes.iter().enumerate() {
        match byte {
            b'<' => tag = Some(k),
            b'>' => match tag.take().map(|start| (bytes[start + 1], bytes[k - 1])) {
                Some((b'/', _)) => depth = depth.saturating_sub(1),
                Some((b'!' | b'?', _) | (_, b'/')) | None => {}
                Some(_) => {
                    depth += 1;
                    deepest = deepest.max(depth);
                }
            },
            _ => {}
        }
    }
    if deepest > MAX_NESTING {
        let problem = format!("its elements are nested {deepest} deep");
        return Err(refuse(FaultKind::Limit, problem, "ungroup the drawing"));
    }
    Ok(())
}

/// Where the lines of a text begin.
pub(super) struct Lines {
    starts: Vec<usize>,
}

impl Lines {
    /// The lines of `text`.
    pub(super) fn new(text: &str) -> Self {
        let starts = std::iter::once(0).chain(text.match_indices('\n').map(|(k, _)| k + 1)).collect();
        Self { starts }
    }

    /// The line, from 1, that holds the byte at `position`.
    pub(super) fn of(&self, position: usize) -> usize {
        self.starts.partition_point(|&start| start <= position)
    }
}
