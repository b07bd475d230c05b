//! Short texts made scenes, for tests.

/// What short texts leave out.
const TOP: &[(&str, &str)] = &[
    ("version", "version = 1"),
    ("world", "world.gravity = \"9.81 m/s^2\""),
    ("run", "run.until = \"5 s\""),
];
const ROD: &str =
    "[body.rod]\nrod = { from = [0, 0], to = [0, \"-1 m\"] }\nmass = \"1 kg\"\npoints.tip = [0, \"-1 m\"]";

/// The text with every section that a scene needs and it does not have.
pub(super) fn completed(text: &str) -> String {
    let above = text.split("\n[").next().filter(|above| !above.starts_with('[')).unwrap_or_default();
    let headers = || text.lines().filter_map(|line| line.strip_prefix('['));
    let names = |line: &str, key: &str| {
        line.strip_prefix(key).is_some_and(|rest| !rest.starts_with(char::is_alphabetic))
    };
    let has = |key: &str| headers().chain(above.lines()).any(|line| names(line, key));
    let top = TOP.iter().filter(|(key, _)| !has(key)).map(|(_, text)| *text);
    let rod = Some(ROD).filter(|_| !has("body"));
    top.chain([text]).chain(rod).collect::<Vec<_>>().join("\n")
}
