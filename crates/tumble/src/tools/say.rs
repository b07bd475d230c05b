//! Writing to the two streams, so that nothing in a scene, a table or a path is obeyed by a terminal. A reader that went
//! away, as in `tumble units | head -1`, is no mistake.

use std::fmt::Arguments;
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::sync::OnceLock;

use tumble_scene::printable_lines;

/// Why standard output took no more, unless its reader had gone.
static LOST: OnceLock<String> = OnceLock::new();

/// Writes a line to standard output.
macro_rules! say {
    ($($text:tt)*) => { $crate::tools::say::out(format_args!($($text)*)) };
}

/// Writes a line to standard error.
macro_rules! tell {
    ($($text:tt)*) => { $crate::tools::say::error(format_args!($($text)*)) };
}

pub(crate) use {say, tell};

/// Writes a line to standard output; what it does not take is remembered.
pub(crate) fn out(text: Arguments) {
    script(&printable_lines(&text.to_string()));
}

/// Writes a text that has nothing of a user in it to standard output, for programs.
pub(crate) fn script(text: &str) {
    if let Err(error) = line(&mut io::stdout().lock(), text)
        && error.kind() != ErrorKind::BrokenPipe
    {
        LOST.get_or_init(|| error.to_string());
    }
}

/// Writes a line to standard error, behind which nobody is left to be told of a failure.
pub(crate) fn error(text: Arguments) {
    drawn(&printable_lines(&text.to_string()));
}

/// Writes to standard error what a terminal may obey: colours that are our own, around texts that were made printable.
pub(crate) fn drawn(text: &str) {
    let _ = line(&mut io::stderr().lock(), text);
}

fn line(stream: &mut dyn Write, text: &str) -> io::Result<()> {
    writeln!(stream, "{text}")?;
    stream.flush()
}

/// Why something that was said did not arrive, if it did not.
pub(crate) fn lost() -> Option<&'static str> {
    LOST.get().map(String::as_str)
}

/// Whether a stream may be coloured: a terminal that can, and a user who does not say no.
pub(crate) fn colour(stream: &impl IsTerminal) -> bool {
    let unset = |name: &str| std::env::var_os(name).is_none_or(|value| value.is_empty());
    stream.is_terminal() && unset("NO_COLOR") && std::env::var_os("TERM").is_none_or(|term| term != "dumb")
}

/// Columns of the terminal; what is not a terminal is as wide as a page.
pub(crate) fn width() -> usize {
    const PAGE: usize = 100;
    std::env::var("COLUMNS").ok().and_then(|columns| columns.parse().ok()).unwrap_or(PAGE)
}

/// A paragraph in lines of at most `width` columns; a longer word has a line of its own.
pub(crate) fn wrapped(paragraph: &str, width: usize) -> String {
    let mut lines = vec![String::new()];
    for word in paragraph.split_whitespace() {
        let fits =
            |line: &String| line.is_empty() || line.chars().count() + 1 + word.chars().count() <= width;
        match lines.last_mut().filter(|line| fits(line)) {
            Some(line) => *line = format!("{line} {word}").trim_start().to_owned(),
            None => lines.push(word.to_owned()),
        }
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_as_long_as_they_may_be() {
        assert_eq!(wrapped("one two  three", 7), "one two\nthree");
        assert_eq!(wrapped("one two three", 6), "one\ntwo\nthree");
        assert_eq!(wrapped("incomprehensible a", 5), "incomprehensible\na");
        assert_eq!(wrapped("", 5), "");
    }

    #[test]
    fn a_reader_that_went_away_is_no_mistake() {
        struct Gone;
        impl Write for Gone {
            fn write(&mut self, _: &[u8]) -> io::Result<usize> {
                Err(ErrorKind::BrokenPipe.into())
            }
            fn flush(&mut self) -> io::Result<()> {
                Ok(())
            }
        }
        assert_eq!(line(&mut Gone, "x").expect_err("gone").kind(), ErrorKind::BrokenPipe);
    }
}
