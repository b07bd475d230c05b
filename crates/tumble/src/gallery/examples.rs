//! Examples of the book as scenes: fragments are completed by a scaffold.

use std::collections::BTreeSet;

/// The fragment with every section of the scaffold that it does not have itself.
pub fn completed(fragment: &str, scaffold: &str) -> String {
    let own: BTreeSet<&str> = sections(fragment).into_iter().map(|(name, _)| name).collect();
    let missing = sections(scaffold).into_iter().filter(|(name, _)| !own.contains(name));
    let (top, below): (Vec<_>, Vec<_>) =
        missing.map(|(_, text)| text).partition(|text| !text.starts_with('['));
    [&top[..], &[fragment.to_owned()], &below[..]].concat().join("\n")
}

/// The parts of a scene by the first word of their names: a key at the top, or a header with the lines below it.
fn sections(scene: &str) -> Vec<(&str, String)> {
    let mut found: Vec<(&str, String)> = vec![];
    let mut in_table = false;
    for line in scene.lines().filter(|line| !line.is_empty()) {
        let begins = line.starts_with('[') || (!in_table && line.starts_with(char::is_alphabetic));
        in_table |= line.starts_with('[');
        if begins {
            found.push((first_word(line), String::new()));
        }
        if let Some((_, text)) = found.last_mut() {
            text.extend([line, "\n"]);
        }
    }
    found
}

fn first_word(line: &str) -> &str {
    line.trim_start_matches('[').split(['.', ']', ' ', '=']).next().unwrap_or_default()
}

/// What a command has run: its scene file, and what was set, `NAME=VALUE`; `None` where it is another command.
pub(super) fn command(text: &str) -> Option<(&str, Vec<&str>)> {
    let words: Vec<&str> = text.lines().next()?.strip_prefix("$ tumble run ")?.split(' ').collect();
    let (scene, rest) = words.split_first()?;
    let settings = rest.chunks(2).map(|pair| match pair {
        ["--set", setting] => Some(*setting),
        _ => None,
    });
    Some((*scene, settings.collect::<Option<Vec<_>>>()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fragment_keeps_its_own_sections() {
        let scaffold = "version = 1\n\n[world]\ngravity = \"0 m/s^2\"\n\n[body.rod]\nmass = \"1 kg\"\n";
        let whole = completed("[body.ball]\nmass = \"2 kg\"\n", scaffold);
        assert_eq!(whole, "version = 1\n\n[body.ball]\nmass = \"2 kg\"\n\n[world]\ngravity = \"0 m/s^2\"\n");
    }

    #[test]
    fn commands_say_what_they_set() {
        let said = |text| command(text);
        assert_eq!(said("$ tumble run a/scene.toml\nout"), Some(("a/scene.toml", vec![])));
        let set = "$ tumble run a.toml --set w1=22m/s --set T=2s";
        assert_eq!(said(set), Some(("a.toml", vec!["w1=22m/s", "T=2s"])));
        assert_eq!(said("$ tumble check a.toml"), None);
        assert_eq!(said("$ tumble run a.toml --no-figures --set T=2s"), None);
    }
}
