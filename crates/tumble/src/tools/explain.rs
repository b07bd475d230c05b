//! `tumble explain CODE`: what a code of a mistake means, an example that has it, and the cure.

use tumble_expr::language;
use tumble_scene::Code;

use super::say::{say, tell, width, wrapped};
use crate::commands::Ending;

/// One entry a code: what it means, mostly an example, and the cure.
const FILES: &[&str] = &[
    include_str!("explanations/text.md"),
    include_str!("explanations/units.md"),
    include_str!("explanations/names.md"),
    include_str!("explanations/dimensions.md"),
    include_str!("explanations/scene.md"),
    include_str!("explanations/model.md"),
    include_str!("explanations/files.md"),
];

/// Lines of an explanation are no longer than a person reads with ease.
const WIDEST: usize = 100;

/// Every code there is, in order.
fn codes() -> impl Iterator<Item = Code> {
    language::Code::ALL.iter().copied().map(Code::from).chain(Code::ALL.iter().copied())
}

/// The explanation of a code, in Markdown.
fn explanation(code: &str) -> Option<&'static str> {
    let entries = FILES.iter().flat_map(|file| file.split("\n## ").skip(1));
    entries
        .filter_map(|entry| entry.split_once('\n'))
        .find(|(of, _)| *of == code)
        .map(|(_, text)| text.trim())
}

/// Explains one code, or lists all.
pub(crate) fn run(code: Option<&str>) -> Ending {
    let Some(asked) = code else { return list() };
    let Some(code) = codes().find(|code| code.as_str().eq_ignore_ascii_case(asked.trim())) else {
        let nearest = nearest(asked).map_or_else(String::new, |near| format!(": did you mean {near}?"));
        tell!("error: there is no code `{asked}`{nearest}\n`tumble explain` lists all of them");
        return Ending::Mistake;
    };
    say!("{code}: {}", code.summary());
    let width = width().clamp(40, WIDEST);
    explanation(code.as_str()).into_iter().for_each(|text| say!("\n{}", for_a_terminal(text, width)));
    Ending::Success
}

fn list() -> Ending {
    let lines: Vec<_> = codes().map(|code| format!("{code}  {}", code.summary())).collect();
    say!("{}\n\n`tumble explain {}` says more.", lines.join("\n"), language::Code::Number);
    Ending::Success
}

/// The code fewest slips away, and among those the one that is next in order; its letter may be left out.
fn nearest(asked: &str) -> Option<&'static str> {
    let number = |code: &str| code.trim_start_matches(char::is_alphabetic).parse::<i64>().unwrap_or_default();
    let digits = asked.trim().trim_start_matches(['e', 'E']);
    let asked = if digits.starts_with(|c: char| c.is_ascii_digit()) {
        format!("E{digits}")
    } else {
        asked.to_owned()
    };
    let mut all: Vec<_> = codes().map(|code| code.as_str()).collect();
    all.sort_by_key(|code| number(code).abs_diff(number(&asked)));
    language::nearest(asked.trim(), all)
}

/// Paragraphs wrapped, examples indented and files named.
fn for_a_terminal(markdown: &str, width: usize) -> String {
    let (mut shown, mut example) = (vec![], false);
    for block in markdown.split("```") {
        if example {
            let (kind, text) = block.split_once('\n').unwrap_or((block, ""));
            let name = kind.strip_prefix("csv ").map(|name| format!("in the file {name}:\n\n"));
            let lines: Vec<_> =
                text.trim_end().lines().map(|line| format!("    {line}").trim_end().to_owned()).collect();
            shown.push(name.unwrap_or_default() + &lines.join("\n"));
        } else {
            let paragraphs = block.split("\n\n").map(str::trim).filter(|text| !text.is_empty());
            shown.extend(paragraphs.map(|text| wrapped(text, width)));
        }
        example = !example;
    }
    shown.retain(|block| !block.is_empty());
    shown.join("\n\n")
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::io;

    use tumble_scene::{Diagnostics, Files};

    use super::super::scaffold::completed;
    use super::*;

    /// Codes that a short example cannot show, and what has them.
    fn made(code: &str) -> Option<Vec<u8>> {
        let parameter = |formula: String| completed(&format!("[parameters]\nx = \"{formula}\"")).into_bytes();
        Some(match code {
            "E0102" => parameter("1 + ".repeat(20_000) + "1"),
            "E0103" => parameter(format!("{}1{}", "(".repeat(101), ")".repeat(101))),
            "E0305" => chain_of_functions(70, |next| format!("f{next}(x)")),
            "E0306" => chain_of_functions(40, |next| format!("f{next}(2*x) + f{next}(3*x)")),
            "E0503" => b"title = \"\xff\"".to_vec(),
            "E0504" => vec![b' '; tumble_scene::MAX_BYTES + 1],
            _ => return None,
        })
    }

    /// Codes that reading a scene does not give: no scene is known to have the first, as the codes before it name every
    /// mistake that is known; the others come from a run, or are warnings.
    const NOT_READ: [&str; 15] = [
        "E0538", "E0545", "E0546", "E0560", "E0561", "W0601", "W0602", "W0603", "W0604", "W0605", "W0606",
        "W0607", "W0608", "W0609", "W0610",
    ];

    fn chain_of_functions(count: usize, body: impl Fn(usize) -> String) -> Vec<u8> {
        let functions: Vec<_> = (0..count).map(|i| format!("\"f{i}(x)\" = \"{}\"", body(i + 1))).collect();
        let text = format!(
            "[functions]\n{}\n\"f{count}(x)\" = \"x\"\n[parameters]\na = \"f0(1)\"",
            functions.join("\n")
        );
        completed(&text).into_bytes()
    }

    struct Beside(BTreeMap<String, String>);

    impl Files for Beside {
        fn read(&self, name: &str) -> io::Result<Vec<u8>> {
            self.0.get(name).map(|text| text.clone().into_bytes()).ok_or(io::ErrorKind::NotFound.into())
        }
    }

    /// The fenced blocks of a text with their kinds.
    fn blocks(text: &str) -> Vec<(&str, &str)> {
        let fenced = text.split("```").skip(1).step_by(2);
        fenced.map(|block| block.split_once('\n').expect("a kind and a text")).collect()
    }

    fn mistakes(code: &str, text: &str) -> Diagnostics {
        let blocks = blocks(text);
        let files = blocks.iter().filter_map(|(kind, text)| Some((kind.strip_prefix("csv ")?, *text)));
        let files = Beside(files.map(|(name, text)| (name.to_owned(), text.to_owned())).collect());
        let scene = made(code).unwrap_or_else(|| match blocks[..] {
            [("toml whole", scene), ..] => scene.trim().as_bytes().to_vec(),
            [("toml", scene), ..] => completed(scene).into_bytes(),
            _ => panic!("{code} has no example"),
        });
        tumble_scene::read_bytes_in("scene.toml", &scene, &[], &files)
            .err()
            .unwrap_or_else(|| panic!("{code}: no mistake"))
    }

    #[test]
    fn every_code_has_an_explanation_with_its_cure() {
        for code in codes() {
            let text = explanation(code.as_str()).unwrap_or_else(|| panic!("{code} has no explanation"));
            let prose: Vec<_> =
                text.split("```").step_by(2).filter(|prose| !prose.trim().is_empty()).collect();
            let paragraphs =
                prose.iter().flat_map(|prose| prose.split("\n\n")).filter(|p| !p.trim().is_empty());
            assert!(paragraphs.count() >= 2, "{code}: what it means, and the cure");
            assert_eq!(text.matches("```").count() % 2, 0, "{code}: a block is not closed");
        }
    }

    #[test]
    fn every_explanation_is_of_a_code() {
        let entries = FILES.iter().flat_map(|file| file.lines()).filter_map(|line| line.strip_prefix("## "));
        let mut found: Vec<_> = entries.collect();
        found.sort_unstable();
        let mut known: Vec<_> = codes().map(Code::as_str).collect();
        known.sort_unstable();
        assert_eq!(found, known);
    }

    #[test]
    fn every_example_has_the_mistake_it_is_for() {
        for code in codes().map(Code::as_str).filter(|code| !NOT_READ.contains(code)) {
            let mistakes = mistakes(code, explanation(code).unwrap_or_default());
            let found: Vec<_> = mistakes.list.iter().map(|mistake| mistake.code.as_str()).collect();
            assert!(
                found.iter().all(|found| *found == code),
                "{code}: {found:?}\n{}",
                mistakes.render(false, 100)
            );
        }
    }

    #[test]
    fn examples_have_no_mistake_but_their_own() {
        let empty = Beside(BTreeMap::new());
        let base = completed("");
        assert!(tumble_scene::read_in("scene.toml", &base, &[], &empty).is_ok(), "{base}");
    }

    #[test]
    fn a_slip_finds_its_code() {
        assert_eq!(nearest("e0203x"), Some("E0203"));
        assert_eq!(nearest("0410"), Some("E0410"));
        assert_eq!(nearest("E0206"), Some("E0205"));
        assert_eq!(nearest("mistake"), None);
    }
}
