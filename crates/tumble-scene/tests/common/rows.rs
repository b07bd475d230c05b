//! Tables of mistakes.

use tumble_scene::{Diagnostic, Diagnostics, read_in};

use crate::beside::Beside;

/// (what to replace, by what, code and underlined words, part of what is said)
pub(crate) type Row = (&'static str, &'static str, &'static str, &'static str);

/// Code and underlined words.
fn line(mistakes: &Diagnostics, mistake: &Diagnostic) -> String {
    let text = &mistakes.sources[mistake.source].text;
    let words: Vec<_> = mistake.labels.iter().map(|label| &text[label.span.clone()]).collect();
    let code = mistake.code.as_str();
    if words.is_empty() { code.to_owned() } else { format!("{code} {}", words.join(" | ")) }
}

/// What is not as expected.
pub(crate) fn difference(mistakes: &Diagnostics, underlined: &str, says: &str) -> Option<String> {
    let found: Vec<_> = mistakes.list.iter().map(|mistake| line(mistakes, mistake)).collect();
    let found = found.join(" && ");
    let rendered = mistakes.render(false, 100);
    let said = |m: &Diagnostic| {
        let labels: Vec<_> = m.labels.iter().map(|label| label.text.as_str()).collect();
        format!("{}; {}; {}", m.message, m.help.as_deref().unwrap_or_default(), labels.join("; "))
    };
    let all: Vec<_> = mistakes.list.iter().map(said).collect();
    let is_said = all.iter().any(|said| said.contains(says));
    let is_shown = rendered.contains(mistakes.list[0].code.as_str());
    let same = found == underlined && is_said && is_shown;
    (!same).then(|| format!("found `{found}`, not `{underlined}`; `{says}` is said: {is_said}\n{rendered}"))
}

/// Every row of a table, each in the scene alone.
pub(crate) fn table(scene: &str, rows: &[Row]) {
    let differences: Vec<_> = rows.iter().filter_map(|row| different(scene, row)).collect();
    assert!(differences.is_empty(), "\n{}", differences.join("\n"));
}

fn different(scene: &str, (old, new, underlined, says): &Row) -> Option<String> {
    assert_eq!(scene.matches(old).count(), 1, "`{old}` is not one place of the scene");
    match read_in("scene.toml", &scene.replace(old, new), &[], &Beside) {
        Ok(_) => Some(format!("`{new}` is no mistake\n")),
        Err(mistakes) => difference(&mistakes, underlined, says),
    }
}
