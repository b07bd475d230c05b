//! What the documents show is what the program does: scenes, messages and outputs in README.md, in docs/ and in the
//! lessons of scenes/. The kinds of blocks are described in docs/README.md.

use std::collections::BTreeSet;
use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::{available_parallelism, scope};

use crate::common::{copy_scenes, failures, folder, gallery, read, repository, scenes, text, tumble, write};
use tumble::gallery::completed;
use tumble::pipeline::{self, Options};

/// Columns of the messages in the documents, the width of a page.
const WIDTH: usize = 100;

/// A fenced block.
#[derive(Clone, Debug)]
struct Block {
    /// What stands behind the opening fence.
    kind: String,
    text: String,
    /// Where it begins, for messages: `docs/output.md:12`.
    place: String,
}

/// Every document whose blocks are tested.
fn documents() -> Vec<PathBuf> {
    let mut found = vec![repository("README.md")];
    collect(&repository("docs"), &mut found);
    found.extend(scenes().into_iter().map(|(_, scene)| scene.with_file_name("README.md")));
    found.into_iter().filter(|document| document.is_file()).collect()
}

fn collect(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("readable").path();
        if path.is_dir() {
            collect(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "md") {
            found.push(path);
        }
    }
}

fn blocks(document: &Path) -> Vec<Block> {
    let name = document.strip_prefix(repository("")).unwrap_or(document).display().to_string();
    let (text, mut found, mut open) = (read(document), vec![], None::<Block>);
    for (line, number) in text.lines().zip(1..) {
        match (line.strip_prefix("```"), open.as_mut()) {
            (Some(_), Some(_)) => found.extend(open.take()),
            (Some(kind), None) => {
                let place = format!("{name}:{number}");
                open = Some(Block { kind: kind.to_owned(), text: String::new(), place });
            }
            (None, Some(block)) => block.text.extend([line, "\n"]),
            (None, None) => {}
        }
    }
    assert!(open.is_none(), "{name}: a block is not closed");
    found
}

/// The blocks of that kind in all documents.
fn of_kind(kind: &str) -> Vec<Block> {
    let found: Vec<_> = documents().iter().flat_map(|document| blocks(document)).collect();
    let found: Vec<_> = found.into_iter().filter(|block| block.kind == kind).collect();
    assert!(!found.is_empty(), "no document has a block `{kind}`");
    found
}

/// Runs a text as a scene; all its checks have to hold.
fn succeeds(scene: &str, place: &str) {
    let folder = folder();
    let path = folder.path().join("scene.toml");
    write(&path, scene);
    let options = Options { out: folder.path().join("out"), ..Options::default() };
    match pipeline::run(&path, &options) {
        Ok(outcome) => {
            assert!(outcome.is_success(), "{place}: {:#?}", failures(&outcome));
        }
        Err(pipeline::PipelineError::Case(tumble::CaseError::Scene(mistakes))) => {
            panic!("{place}:\n{}", mistakes.render(false, WIDTH))
        }
        Err(error) => panic!("{place}: {error}"),
    }
}

#[test]
fn only_known_kinds_of_blocks() {
    let known = [
        "toml",
        "toml scaffold",
        "toml fragment",
        "toml error",
        "text",
        "console",
        "diff",
        "sh",
        "rust",
        "json",
    ];
    for block in documents().iter().flat_map(|document| blocks(document)) {
        assert!(known.contains(&block.kind.as_str()), "{}: `{}`", block.place, block.kind);
    }
}

#[test]
fn scenes_run() {
    for block in of_kind("toml").iter().chain(&of_kind("toml scaffold")) {
        succeeds(&block.text, &block.place);
    }
}

#[test]
fn fragments_run_within_the_scaffold() {
    let scaffold = of_kind("toml scaffold");
    assert_eq!(scaffold.len(), 1, "there is one scaffold");
    for block in of_kind("toml fragment") {
        succeeds(&completed(&block.text, &scaffold[0].text), &block.place);
    }
}

#[test]
fn mistakes_are_reported_as_shown() {
    let mut count = 0;
    for document in documents() {
        let blocks = blocks(&document);
        for pair in blocks.windows(2).filter(|pair| pair[0].kind == "toml error") {
            assert_eq!(pair[1].kind, "text", "{}: no message follows", pair[0].place);
            let mistakes = tumble_scene::read("scene.toml", &pair[0].text, &[]).expect_err(&pair[0].place);
            same(&mistakes.render(false, WIDTH), &pair[1]);
            count += 1;
        }
    }
    assert_eq!(count, of_kind("toml error").len(), "each mistake has its message");
}

/// `UPDATE_BOOK=1` writes them anew.
#[test]
fn outputs_are_as_shown() {
    of_kind("console");
    let (documents, next) = (documents(), AtomicUsize::new(0));
    let some = || {
        while let Some(document) = documents.get(next.fetch_add(1, Ordering::Relaxed)) {
            commands(document);
        }
    };
    let threads = available_parallelism().map_or(1, NonZero::get);
    scope(|of| (0..threads).for_each(|_| _ = of.spawn(some)));
}

/// Runs the commands of one document, each where the scene files it names stand.
fn commands(document: &Path) {
    let (mut scene, mut edits) = (String::new(), vec![]);
    for block in blocks(document) {
        match block.kind.as_str() {
            "toml" => scene = block.text,
            "diff" => edits.push(block),
            "console" => {
                let (command, expected) = block.text.split_once('\n').expect("a command and its output");
                let place = prepare(document, &edits, command, &scene);
                let output = said(place.path(), command, &block.place);
                let shown = Block { text: expected.to_owned(), ..block.clone() };
                match std::env::var_os("UPDATE_BOOK") {
                    Some(_) => update(document, &output, &shown),
                    None => same(&output, &shown),
                }
                edits.clear();
            }
            _ => {}
        }
    }
}

/// Writes an output into its document. Where the document leaves out lines, those that it shows become the lines that
/// begin most like them.
fn update(document: &Path, found: &str, shown: &Block) {
    let found: Vec<&str> = found.trim().lines().map(str::trim_end).collect();
    let alike = |line: &str, other: &str| line.bytes().zip(other.bytes()).take_while(|(a, b)| a == b).count();
    let nearest = |line: &str| match line {
        "..." => Some(line.to_owned()),
        _ => found.iter().max_by_key(|other| alike(line, other)).map(|&other| other.to_owned()),
    };
    let leaves_out = shown.text.lines().any(|line| line == "...");
    let lines: Vec<String> = match leaves_out {
        true => shown.text.lines().filter_map(nearest).collect(),
        false => found.iter().map(|&line| line.to_owned()).collect(),
    };
    assert!(
        !shown.text.is_empty(),
        "{}: write a word into the empty block, so that its place is known",
        document.display()
    );
    write(document, &read(document).replacen(&shown.text, &(lines.join("\n") + "\n"), 1));
}

/// A folder with the scenes of the repository, the lesson's own with its edits, and the scene of the document by the
/// name that the command gives it.
fn prepare(document: &Path, edits: &[Block], command: &str, scene: &str) -> tempfile::TempDir {
    let folder = folder();
    copy_scenes(&folder.path().join("scenes"));
    for (name, source) in scenes() {
        if source.with_file_name("README.md") == document {
            let text = edits.iter().fold(read(&source), edited);
            write(&folder.path().join("scenes").join(name).join("scene.toml"), &text);
        }
    }
    let files =
        command.split(' ').filter(|word| word.ends_with(".toml")).map(|name| folder.path().join(name));
    files.filter(|file| !file.exists()).for_each(|file| write(&file, scene));
    folder
}

/// The scene with each line behind a `-` replaced by the line behind a `+` that follows it.
fn edited(scene: String, edit: &Block) -> String {
    let mut lines = edit.text.lines();
    let mut scene = scene;
    while let (Some(old), Some(new)) = (lines.next(), lines.next()) {
        let (old, new) = (old.strip_prefix('-'), new.strip_prefix('+'));
        let (old, new) = old.zip(new).unwrap_or_else(|| panic!("{}: - and + in turn", edit.place));
        assert_eq!(scene.matches(old).count(), 1, "{}: `{old}` is in the scene once", edit.place);
        scene = scene.replace(old, new);
    }
    scene
}

/// Both streams of `$ tumble ...`, without the lines of progress: only a slow machine writes them.
fn said(folder: &Path, command: &str, place: &str) -> String {
    let arguments =
        command.strip_prefix("$ tumble ").unwrap_or_else(|| panic!("{place}: not `$ tumble ...`"));
    let words: Vec<&str> = arguments.split(' ').collect();
    let output = tumble(folder, &words);
    let errors = text(&output.stderr);
    let errors = errors.lines().filter(|line| !is_progress(line));
    text(&output.stdout) + &errors.map(|line| line.to_owned() + "\n").collect::<String>()
}

/// Whether a line says how much is done: `title: 2 of 4, 5 s left`, `title: 40 % of the time`.
fn is_progress(line: &str) -> bool {
    let words = line.rsplit_once(": ").map_or("", |(_, words)| words);
    let done = words.split_once(", ").map_or(words, |(done, _)| done);
    let is_count = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let is_of_runs = done.split_once(" of ").is_some_and(|(some, all)| is_count(some) && is_count(all));
    is_of_runs || done.strip_suffix(" % of the time").is_some_and(is_count)
}

/// Whether a text is the one shown, of which a line `...` leaves out any number of lines.
fn same(found: &str, shown: &Block) {
    let clean = |text: &str| text.lines().map(|line| line.trim_end().to_owned()).collect::<Vec<_>>();
    let (found_lines, shown_lines) = (clean(found.trim()), clean(shown.text.trim()));
    assert!(
        matches(&found_lines, &shown_lines),
        "{} is stale; it is now\n{found}\nand was\n{}",
        shown.place,
        shown.text
    );
}

fn matches(found: &[String], shown: &[String]) -> bool {
    match shown.split_first() {
        None => found.is_empty(),
        Some((line, rest)) if line == "..." => (0..=found.len()).any(|skip| matches(&found[skip..], rest)),
        Some((line, rest)) => found.first() == Some(line) && matches(&found[1..], rest),
    }
}

/// `cargo xtask bless figures` makes them new.
#[test]
fn figures_are_those_of_the_gallery() {
    let mut drawn = BTreeSet::new();
    for (_, outcome) in gallery() {
        let files = outcome.figures.iter().map(|figure| outcome.folder.join(format!("{figure}.svg")));
        drawn.extend(files.map(|file| read(&file)));
    }
    for entry in fs::read_dir(repository("docs/images")).expect("a folder") {
        let image = entry.expect("readable").path();
        assert!(
            drawn.contains(&read(&image)),
            "{} is stale: run `cargo xtask bless figures`",
            image.display()
        );
    }
}
