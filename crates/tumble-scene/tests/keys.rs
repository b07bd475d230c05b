//! What is declared of keys: the page of the language shows it, every table is called by one title, and the reader reads all of it.

use std::collections::BTreeMap;
use std::path::Path;

use tumble_scene::keys::{self, Declared, Takes};

/// A table of the page stands behind this, after an empty line.
const MARK: &str = "<!-- keys: ";

/// `UPDATE_BOOK=1` writes the page.
#[test]
fn the_page_of_the_language_has_the_keys_that_are_declared() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/scene-language.md");
    let page = std::fs::read_to_string(&path).expect("the page");
    let mut parts = page.split(MARK);
    let first = parts.next().unwrap_or_default().to_owned();
    let now = parts.fold(first, |page, part| {
        let (title, rest) = part.split_once(" -->\n\n").expect("a title and an empty line");
        let text = rest.find("\n\n").map_or("", |end| &rest[end..]);
        format!("{page}{MARK}{title} -->\n\n{}{text}", table(title))
    });
    if std::env::var_os("UPDATE_BOOK").is_some() {
        std::fs::write(&path, &now).expect("the page can be written");
    }
    assert!(page == now, "docs/scene-language.md is stale: run this test with UPDATE_BOOK=1");
}

/// A text beside a section's own keys is told of once, at the top.
fn table(title: &str) -> String {
    let top = || keys::of_scene().filter(|key| !matches!(key.takes, Takes::Table(_) | Takes::Named(_)));
    let of = |keys: &'static keys::Keys| keys.iter().filter(|key| key.name != "text");
    let found = keys::tables().into_iter().find(|(_, keys)| keys.title == title);
    let rows: Vec<_> = match found {
        Some((_, keys)) => of(keys).map(row).collect(),
        None if title == "the top of a scene" => top().map(row).collect(),
        None => panic!("no table has the title {title}"),
    };
    format!("| key | default | meaning |\n|---|---|---|\n{}", rows.join("\n"))
}

fn row(key: &'static Declared) -> String {
    format!("| `{}` | {} | {} |", key.name, key.default.unwrap_or("needed"), key.says)
}

#[test]
fn a_title_is_that_of_one_table() {
    let mut titles: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (_, table) in keys::tables() {
        let names: Vec<_> = table.iter().map(|key| key.name).collect();
        let before = titles.entry(table.title).or_insert_with(|| names.clone());
        assert_eq!(*before, names, "{}", table.title);
        let mut once = names.clone();
        once.sort_unstable();
        once.dedup();
        assert_eq!(once.len(), names.len(), "a key stands twice in {}", table.title);
    }
    assert!(titles.len() > 40);
}

/// Every key that is declared is looked at: what is left over when a table has been read is unknown, also if it is declared.
#[test]
fn every_key_is_read() {
    for (behind, table) in keys::tables() {
        for key in table.iter() {
            let scene = scene(&behind, table.title, key);
            let refused = format!("has no key `{}`", key.name);
            let mistakes = tumble_scene::read("scene.toml", &scene, &[]).err().map(|mistakes| mistakes.list);
            let unknown = mistakes.into_iter().flatten().find(|one| one.message.contains(&refused));
            assert!(
                unknown.is_none(),
                "{} of {behind}: {:?}\n{scene}",
                key.name,
                unknown.map(|one| one.message)
            );
        }
    }
}

/// A scene with this key, and others that let its table be read so far.
fn scene(behind: &str, title: &str, key: &Declared) -> String {
    let entry = format!("{} = {}", key.name, plain(key.example));
    let inner = format!("{{ {entry} }}");
    let own = match title {
        "part of a body" => format!("[body.a]\nparts = [{inner}]"),
        "start" => format!("[body.a]\nstart = {inner}"),
        "place of a force" => format!("[force.a]\non = \"rod\"\nforce = [0, 0]\nat = {inner}"),
        "labelled instant" => format!("[free_body.a]\nat = {inner}"),
        "labelled formula" => format!("[plot.a]\ny = {inner}"),
        "action" => format!("[event.a]\naction = {inner}"),
        "end at rest" => format!("[run]\nuntil = {inner}"),
        "end in the world" => format!("[spring.a]\nbetween = [{inner}, \"rod.tip\"]"),
        "rigid of bodies" => format!("[contact.a]\nbetween = \"all\"\nrigid = {inner}"),
        "friction" => format!("[surface.a]\nrigid = {{ restitution = 1, friction = {inner} }}"),
        "circle" | "rigid" | "hertz" => format!("[surface.a]\n{behind} = {inner}"),
        "spring of a surface" => format!("[surface.a]\nspring = {inner}"),
        "value of a sweep" => format!("[parameters]\nT = 1\n[sweep]\nT = [{inner}]"),
        "range of a sweep" => format!("[parameters]\nT = 1\n[sweep]\nT = {inner}"),
        "range of a slider" => format!("[parameters]\nT = 1\n[play]\nT = {{ from = 0, {entry} }}")
            .replace("from = 0, from", "from"),
        "[play.presets.NAME]" => format!("[play.presets.a]\n{entry}"),
        _ if !behind.starts_with('[') => format!("[body.a]\n{behind} = {inner}"),
        _ => format!("{}\n{entry}", title.replace("NAME", "a")),
    };
    let world = if own.starts_with("[world]") { "" } else { "[world]\ngravity = 0\n" };
    format!(
        "version = 1\n{world}[body.rod]\nrod = {{ from = [0, 0], to = [\"1 m\", 0] }}\nmass = \"1 kg\"\npoints.tip = [0, 0]\n{own}\n"
    )
}

/// The first of the values that an example has.
fn plain(example: &'static str) -> &'static str {
    example.split_once('`').map_or(example, |(first, _)| first)
}
