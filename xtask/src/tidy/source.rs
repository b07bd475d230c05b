//! Rust text as the rules need it: code without comments and tests, and whole words.

use super::tree::File;

/// The lines of code that ship: without comments, without `#[cfg(test)]` modules, nothing of a file of tests.
///
/// This reads lines, it does not parse: a test module is taken to end where a line `}` stands at its indentation.
pub(super) fn shipped(file: &File) -> Vec<(usize, &str)> {
    if is_test_file(&file.path) {
        return Vec::new();
    }
    let mut skipper = Skipper::default();
    file.lines().filter(|(_, line)| skipper.keeps(line)).map(|(number, line)| (number, code(line))).collect()
}

/// The part of a line before a comment.
pub(super) fn code(line: &str) -> &str {
    line.split_once("//").map_or(line, |(code, _)| code)
}

fn is_test_file(path: &str) -> bool {
    path.ends_with("tests.rs") || path.contains("/tests/") || path.contains("/benches/")
}

#[derive(Default)]
struct Skipper {
    /// The last line was `#[cfg(test)]`.
    announced: bool,
    /// The line that ends the test module we are in.
    until: Option<String>,
}

impl Skipper {
    fn keeps(&mut self, line: &str) -> bool {
        if let Some(end) = &self.until {
            if line == end {
                self.until = None;
            }
            return false;
        }
        let announced = std::mem::replace(&mut self.announced, line.trim() == "#[cfg(test)]");
        if announced && line.trim_end().ends_with('{') {
            let indentation = &line[..line.len() - line.trim_start().len()];
            self.until = Some(format!("{indentation}}}"));
            return false;
        }
        true
    }
}

/// Whether `text` has `word` with no letter, digit or underscore on either side.
pub(super) fn has_word(text: &str, word: &str) -> bool {
    let inside = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(word)
        .any(|(start, _)| !text[..start].ends_with(inside) && !text[start + word.len()..].starts_with(inside))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tidy::tree::Tree;

    fn numbers(path: &str, text: &str) -> Vec<usize> {
        let tree = Tree::from(&[(path, text)]);
        shipped(&tree.files()[0]).into_iter().map(|(number, _)| number).collect()
    }

    #[test]
    fn test_modules_are_skipped_and_code_after_them_is_not() {
        let text = "fn a() {}\n#[cfg(test)]\nmod tests {\n    fn b() {\n    }\n}\nfn c() {}\n";
        assert_eq!(numbers("src/lib.rs", text), [1, 2, 7]);
    }

    #[test]
    fn files_of_tests_do_not_ship() {
        assert!(numbers("crates/a/tests/b.rs", "fn a() {}\n").is_empty());
        assert!(numbers("crates/a/src/tests.rs", "fn a() {}\n").is_empty());
    }

    #[test]
    fn comments_are_cut() {
        assert_eq!(code("a(); // b"), "a(); ");
        assert_eq!(code("/// b"), "");
    }

    #[test]
    fn words_are_whole() {
        assert!(has_word("f64::sin(x)", "f64::sin"));
        assert!(!has_word("f64::sinh(x)", "f64::sin"));
        assert!(!has_word("a_word", "word"));
    }
}
