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

#[track_caller]
pub(crate) fn expect(mistakes: &Diagnostics, underlined: &str, says: &str) {
    let found: Vec<_> = mistakes.list.iter().map(|mistake| line(mistakes, mistake)).collect();
    let rendered = mistakes.render(false, 100);
    assert_eq!(found.join(" && "), underlined, "\n{rendered}");
    let said = |m: &Diagnostic| {
        let labels: Vec<_> = m.labels.iter().map(|label| label.text.as_str()).collect();
        format!("{}; {}; {}", m.message, m.help.as_deref().unwrap_or_default(), labels.join("; "))
    };
    let all: Vec<_> = mistakes.list.iter().map(said).collect();
    assert!(all.iter().any(|said| said.contains(says)), "`{says}` is not in {all:#?}");
    assert!(rendered.contains(mistakes.list[0].code.as_str()));
}

/// Every row of a table, each in the scene alone.
pub(crate) fn table(scene: &str, rows: &[Row]) {
    for (old, new, underlined, says) in rows {
        assert_eq!(scene.matches(old).count(), 1, "`{old}` is not one place of the scene");
        let changed = scene.replace(old, new);
        let mistakes =
            read_in("scene.toml", &changed, &[], &Beside).expect_err(&format!("`{new}` is a mistake"));
        expect(&mistakes, underlined, says);
    }
}
