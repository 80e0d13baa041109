//! What people read: short, on standard error, coloured on a terminal only.

use crate::failure::Failure;
use anstyle::{AnsiColor, Style};
use std::io::Write;

/// More lines of one kind than this are counted instead of shown.
const MOST_SHOWN: usize = 20;

const RED: Style = AnsiColor::Red.on_default().bold();
const YELLOW: Style = AnsiColor::Yellow.on_default().bold();

/// Says what went wrong.
pub(crate) fn failure(failure: &Failure) {
    say(RED, "error", &failure.message);
    for detail in failure.details.iter().take(MOST_SHOWN) {
        let _ = writeln!(anstream::stderr(), "  {detail}");
    }
    more(failure.details.len());
}

/// Says what was changed, healed or left.
pub(crate) fn warnings<T: std::fmt::Display>(warnings: &[T]) {
    for warning in warnings.iter().take(MOST_SHOWN) {
        say(YELLOW, "warning", &warning.to_string());
    }
    more(warnings.len());
}

fn more(count: usize) {
    if count > MOST_SHOWN {
        let _ = writeln!(anstream::stderr(), "  and {} more", count - MOST_SHOWN);
    }
}

fn say(style: Style, what: &str, message: &str) {
    // Standard error may be closed; then nobody listens.
    let _ = writeln!(anstream::stderr(), "{style}{what}:{style:#} {message}");
}

/// A number for people: three decimals where that says something, else four significant digits.
pub(crate) fn figure(value: f64) -> String {
    let size = value.abs();
    let text = if size >= 0.01 || size == 0.0 { format!("{value:.3}") } else { return format!("{value:.3e}") };
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A number of things for people: `1 level`, `2 levels`.
pub(crate) fn counted(count: usize, thing: &str) -> String {
    format!("{count} {thing}{}", if count == 1 { "" } else { "s" })
}

/// A time for people.
pub(crate) fn duration(seconds: f64) -> String {
    let whole = seconds.round().max(0.0);
    let (minutes, rest) = ((whole / 60.0).floor(), whole % 60.0);
    if minutes >= 60.0 {
        format!("{:.0} h {:.0} min", (minutes / 60.0).floor(), minutes % 60.0)
    } else if minutes > 0.0 {
        format!("{minutes:.0} min {rest:.0} s")
    } else {
        format!("{rest:.0} s")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_and_durations_are_short() {
        assert_eq!((figure(12.0).as_str(), figure(0.25).as_str(), figure(0.0).as_str()), ("12", "0.25", "0"));
        assert_eq!(figure(0.000_123_4), "1.234e-4");
        assert_eq!((counted(0, "level"), counted(1, "level")), ("0 levels".into(), "1 level".into()));
        assert_eq!((duration(59.6).as_str(), duration(3725.0).as_str()), ("1 min 0 s", "1 h 2 min"));
    }
}
