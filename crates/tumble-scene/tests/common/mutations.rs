//! Scenes with slips in them: the scenes of the gallery, changed the way people, editors and accidents change texts.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use tumble_scene::{Files, Folder, read_in};

#[path = "awkward.rs"]
mod awkward;

use awkward::{LINES, SECTIONS, VALUES, WORDS};

/// More changes than this leave nothing of a scene.
const MOST_CHANGES: usize = 4;
/// A scene that grew to more bytes is not changed further.
const LARGE: usize = 64 << 10;

/// The scenes that are changed, and their parts.
pub(crate) struct Corpus {
    scenes: Vec<String>,
    lines: Vec<String>,
    sections: Vec<String>,
    words: Vec<String>,
    values: Vec<String>,
    /// The files beside the scenes.
    pub(crate) files: Memory,
}

/// Files by their names.
#[derive(Default)]
pub(crate) struct Memory(BTreeMap<String, Vec<u8>>);

impl Files for Memory {
    fn read(&self, relative: &str) -> io::Result<Vec<u8>> {
        self.0.get(relative).cloned().ok_or_else(|| io::ErrorKind::NotFound.into())
    }
}

impl Corpus {
    /// The scenes of the gallery.
    pub(crate) fn of_gallery() -> io::Result<Self> {
        let gallery = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
        let folders = std::fs::read_dir(gallery)?.collect::<io::Result<Vec<_>>>()?;
        let mut scenes: Vec<PathBuf> = folders
            .iter()
            .map(|folder| folder.path().join("scene.toml"))
            .filter(|path| path.exists())
            .collect();
        scenes.sort();
        let texts = scenes.iter().map(std::fs::read_to_string).collect::<io::Result<Vec<_>>>()?;
        let mut files = Memory::default();
        for scene in scenes {
            for name in ["gust.csv", "wind.csv"] {
                files.0.extend(Folder::of(&scene).read(name).ok().map(|bytes| (name.to_owned(), bytes)));
            }
        }
        Ok(Self::new(texts, files))
    }

    fn new(scenes: Vec<String>, files: Memory) -> Self {
        let owned = |words: Vec<&str>| -> Vec<String> { words.into_iter().map(str::to_owned).collect() };
        let lines: Vec<&str> = scenes.iter().flat_map(|scene| scene.lines()).collect();
        let words: Vec<&str> = lines.iter().flat_map(|line| words(line)).collect();
        let values = lines.iter().filter_map(|line| Some(line.split_once(" = ")?.1));
        let sections = scenes.iter().flat_map(|scene| sections(scene)).chain(SECTIONS.iter().copied());
        Self {
            lines: owned(lines.iter().chain(LINES).copied().collect()),
            words: owned(words.into_iter().chain(WORDS.iter().copied()).collect()),
            values: owned(values.chain(VALUES.iter().copied()).collect()),
            sections: owned(sections.collect()),
            scenes,
            files,
        }
    }

    /// One of the scenes with a few changes.
    pub(crate) fn scene(&self, random: &mut Random) -> String {
        let mut text = random.choose(&self.scenes).clone();
        for _ in 0..=random.below(MOST_CHANGES) {
            if text.len() < LARGE {
                text = self.changed(&text, random);
            }
        }
        text
    }

    fn changed(&self, text: &str, random: &mut Random) -> String {
        match random.below(24) {
            0 => bytes(text, random),
            1 => in_lines(text, random, |lines, at, _| {
                lines.remove(at);
            }),
            2 => in_lines(text, random, |lines, at, _| lines.insert(at, lines[at])),
            3 => in_lines(text, random, |lines, at, random| {
                let other = random.below(lines.len());
                lines.swap(at, other);
            }),
            4 => in_lines(text, random, |lines, at, random| {
                lines.insert(at, random.choose::<String>(&self.lines))
            }),
            5..=7 => replaced_value(text, random, random_of(&self.values)),
            8 => section_left_out(text, random),
            9..=11 => format!("{text}\n{}", random.choose(&self.sections)),
            12 => text[..random.boundary(text)].to_owned(),
            13 => in_word(text, random, nested),
            14 => in_word(text, random, |word, random| format!("{word}{}", random.choose(&self.words))),
            15 => in_word(text, random, |_, _| String::new()),
            16 => renamed(text, random),
            17 => in_number(text, random),
            _ => in_word(text, random, |_, random| random.choose(&self.words).clone()),
        }
    }
}

/// Reads a scene and, if asked to, shows its mistakes; panics where they point outside of the text or are none.
pub(crate) fn survives(text: &str, files: &dyn Files, shown: bool) {
    let Err(mistakes) = read_in("scene.toml", text, &[], files) else { return };
    assert!(!mistakes.list.is_empty(), "refused without a mistake");
    for mistake in &mistakes.list {
        let source = &mistakes.sources[mistake.source].text;
        let inside = mistake.labels.iter().all(|label| source.get(label.span.clone()).is_some());
        assert!(inside, "{mistake:?}");
        assert!(!mistake.message.is_empty(), "{mistake:?}");
    }
    assert!(!shown || !mistakes.render(false, 80).is_empty());
}

/// Numbers that a seed decides.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next of the sequence that Weyl's increments make when their bits are mixed.
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    fn below(&mut self, most: usize) -> usize {
        (self.next() % most.max(1) as u64) as usize
    }

    fn choose<'l, T>(&mut self, list: &'l [T]) -> &'l T {
        &list[self.below(list.len())]
    }

    fn boundary(&mut self, text: &str) -> usize {
        let at = self.below(text.len() + 1);
        (0..=at).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0)
    }
}

fn random_of(list: &[String]) -> impl Fn(&mut Random) -> String + '_ {
    |random| random.choose(list).clone()
}

fn bytes(text: &str, random: &mut Random) -> String {
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..=random.below(3) {
        let at = random.below(bytes.len() + 1);
        let end = (at + random.below(4)).min(bytes.len());
        let new: Vec<u8> = (0..random.below(4)).map(|_| random.next() as u8).collect();
        bytes.splice(at..end, new);
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

fn in_lines<'t>(
    text: &'t str,
    random: &mut Random,
    change: impl Fn(&mut Vec<&'t str>, usize, &mut Random),
) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    if !lines.is_empty() {
        let at = random.below(lines.len());
        change(&mut lines, at, random);
    }
    lines.join("\n")
}

fn replaced_value(text: &str, random: &mut Random, value: impl Fn(&mut Random) -> String) -> String {
    let keyed: Vec<usize> = text.match_indices(" = ").map(|(at, _)| at + 3).collect();
    if keyed.is_empty() {
        return text.to_owned();
    }
    let start = *random.choose(&keyed);
    let end = text[start..].find('\n').map_or(text.len(), |end| start + end);
    [&text[..start], &value(random), &text[end..]].concat()
}

fn sections(scene: &str) -> Vec<&str> {
    let starts = scene.match_indices("\n[").map(|(at, _)| at + 1);
    let starts: Vec<usize> = starts.chain([scene.len()]).collect();
    starts.windows(2).map(|ends| &scene[ends[0]..ends[1]]).collect()
}

fn section_left_out(text: &str, random: &mut Random) -> String {
    let sections = sections(text);
    if sections.is_empty() { text.to_owned() } else { text.replace(*random.choose(&sections), "") }
}

/// A run of letters and digits, or one other character.
fn words(text: &str) -> Vec<&str> {
    let mut found = vec![];
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let of_word = |c: char| c.is_alphanumeric() || c == '_';
        let end = match of_word(first) {
            true => rest.find(|c| !of_word(c)).unwrap_or(rest.len()),
            false => first.len_utf8(),
        };
        found.extend((!first.is_whitespace()).then_some(&rest[..end]));
        rest = &rest[end..];
    }
    found
}

fn in_word(text: &str, random: &mut Random, change: impl Fn(&str, &mut Random) -> String) -> String {
    change_one(text, random, &words(text), change)
}

fn change_one(
    text: &str,
    random: &mut Random,
    parts: &[&str],
    change: impl Fn(&str, &mut Random) -> String,
) -> String {
    if parts.is_empty() {
        return text.to_owned();
    }
    let word = *random.choose(parts);
    let start = word.as_ptr() as usize - text.as_ptr() as usize;
    [&text[..start], &change(word, random), &text[start + word.len()..]].concat()
}

fn in_number(text: &str, random: &mut Random) -> String {
    let numbers: Vec<&str> =
        words(text).into_iter().filter(|word| word.starts_with(|c: char| c.is_ascii_digit())).collect();
    change_one(text, random, &numbers, |number, random| match random.below(4) {
        0 => format!("-{number}"),
        1 => format!("{number}e{}", random.below(700) as i64 - 350),
        2 => "0".to_owned(),
        _ => random.choose(WORDS).to_string(),
    })
}

fn renamed(text: &str, random: &mut Random) -> String {
    let known = words(text);
    let names: Vec<&str> =
        known.iter().copied().filter(|word| word.starts_with(char::is_alphabetic)).collect();
    if names.is_empty() {
        return text.to_owned();
    }
    let [old, new] = [random.choose(&names), random.choose(&names)].map(|name: &&str| *name);
    text.replace(old, new)
}

/// The word in many brackets, or behind many signs or powers.
fn nested(word: &str, random: &mut Random) -> String {
    let depth = 1 << random.below(10);
    match random.below(5) {
        0 => format!("{}{word}{}", "(".repeat(depth), ")".repeat(depth)),
        1 => format!("{}{word}{}", "[".repeat(depth), "]".repeat(depth)),
        2 => format!("{}{word}", "-".repeat(depth)),
        3 => format!("{word}{}", "^2".repeat(depth)),
        _ => format!("{}{word}{}", "sin(".repeat(depth), ")".repeat(depth)),
    }
}
