//! Contours with the interior to the left, each wedge of it at a touch walked by itself.

use super::arrangement::Piece;
use super::fans::{Dart, Fans, outgoing};
use super::report::Note;
use crate::contour::Contour;

/// The contours, in the order of their first pieces, and for each piece the contour that it became part of.
pub(super) fn contours(pieces: &[Piece], fans: &Fans, left: &[bool]) -> (Vec<Contour>, Vec<u32>) {
    let dart_of = |k: usize| 2 * k as u32 + u32::from(!left[k]);
    let mut owners = vec![u32::MAX; pieces.len()];
    let mut contours = Vec::new();
    for first in 0..pieces.len() {
        if owners[first] != u32::MAX {
            continue;
        }
        let mut segments = Vec::new();
        let mut dart = dart_of(first);
        while owners[dart as usize / 2] == u32::MAX {
            owners[dart as usize / 2] = contours.len() as u32;
            segments.push(outgoing(pieces, dart));
            dart = following(pieces, fans, dart);
        }
        contours.push(Contour::new(segments));
    }
    (contours, owners)
}

/// The dart that bounds the wedge to the left of where this one arrives: the next one clockwise from its own reverse.
fn following(pieces: &[Piece], fans: &Fans, dart: Dart) -> Dart {
    let piece = &pieces[dart as usize / 2];
    let vertex = if dart & 1 == 0 { piece.to } else { piece.from };
    let fan = fans.at(vertex);
    fan[(fans.place(dart ^ 1, vertex) + fan.len() - 1) % fan.len()]
}

/// One note for every point where loops touch.
pub(super) fn touch_notes(pieces: &[Piece], fans: &Fans, notes: &mut Vec<Note>) {
    for vertex in fans.touches() {
        let loops = || fans.at(vertex).iter().map(|&d| pieces[d as usize / 2].contour);
        let first = loops().min().unwrap_or(0);
        let second = loops().filter(|&l| l != first).min().unwrap_or(first);
        notes.push(Note::Touch { first, second, at: outgoing(pieces, fans.at(vertex)[0]).start() });
    }
}
