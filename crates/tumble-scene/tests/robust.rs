//! Whatever is done to a scene, reading it ends with a study or with mistakes that can be shown.

use proptest::prelude::*;
use tumble_scene::{Override, read, read_bytes};

const SCENES: [&str; 5] = [
    include_str!("../../../scenes/02-thrown-rod/scene.toml"),
    include_str!("../../../scenes/04-kicked-ball/scene.toml"),
    include_str!("../../../scenes/01-pendulum-in-the-wind/scene.toml"),
    include_str!("../../../scenes/05-shuttlecock/scene.toml"),
    include_str!("../../../scenes/06-curve-ball/scene.toml"),
];

/// What mutations put in: pieces of the language, of TOML and of neither.
const PIECES: &[&str] = &[
    "",
    "\"",
    "'''",
    "[",
    "]",
    "[[",
    "]]",
    "{",
    "}",
    "=",
    ".",
    ",",
    "\n",
    "\r\n",
    "#",
    "0",
    "-1",
    "1e400",
    "nan",
    "inf",
    "\"1 m\"",
    "\"t\"",
    "\"rod.x\"",
    "\"ball.ax\"",
    "[0, 0]",
    "true",
    "1979-05-27",
    "0x1f",
    "[body.rod]\n",
    "[[body.rod]]\n",
    "[body]\n",
    "body.rod = 1\n",
    "point = {}\n",
    "parts = [{}]\n",
    "\\u0000",
    "\u{0}",
    "\u{feff}",
    "é",
    "\"w(t)\" = \"w(t)\"\n",
    "polygon = { corners = [] }\n",
    "inertia = 0\n",
    "centre = [0, 0]\n",
    "[sweep]\nL = { from = 0, to = 1, count = 3, spacing = \"log\" }\n",
    "[event.e]\nwhen = \" falls through \"\n",
    "\"e[2]\"",
    "[table.w]\nfile = \"w.csv\"\n",
    "{ world = [\"x\", \"t\"] }",
    "component = \"normal\"\n",
];

fn cut(text: &str, at: usize) -> usize {
    (0..=at % (text.len() + 1)).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0)
}

fn mutated(scene: &str, changes: &[(usize, usize, usize)]) -> String {
    let mut text = scene.to_owned();
    for (at, length, piece) in changes {
        let start = cut(&text, *at);
        let end = cut(&text, (start + length).min(text.len()));
        text.replace_range(start..end.max(start), PIECES[piece % PIECES.len()]);
    }
    text
}

fn survives(text: &str, overrides: &[Override]) {
    if let Err(mistakes) = read("scene.toml", text, overrides) {
        assert!(!mistakes.list.is_empty());
        assert!(!mistakes.render(false, 80).is_empty());
        assert!(!mistakes.to_string().is_empty());
        for mistake in &mistakes.list {
            let source = &mistakes.sources[mistake.source].text;
            assert!(
                mistake.labels.iter().all(|label| source.get(label.span.clone()).is_some()),
                "{mistake:?}"
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutated_scenes(
        which in 0..SCENES.len(),
        changes in prop::collection::vec((any::<usize>(), 0..40usize, any::<usize>()), 1..6),
    ) {
        survives(&mutated(SCENES[which], &changes), &[]);
    }

    #[test]
    fn lines_in_another_order(which in 0..SCENES.len(), swaps in prop::collection::vec((0..100usize, 0..100usize), 1..5)) {
        let mut lines: Vec<&str> = SCENES[which].lines().collect();
        for (a, b) in swaps {
            let count = lines.len();
            lines.swap(a % count, b % count);
        }
        survives(&lines.join("\n"), &[]);
    }

    #[test]
    fn any_settings(name in "[a-zA-Z]{1,3}", text in "\\PC{0,12}") {
        survives(SCENES[1], &[Override { name, text }]);
    }

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        if let Err(mistakes) = read_bytes("scene.toml", &bytes, &[]) {
            prop_assert!(!mistakes.render(false, 80).is_empty());
        }
    }
}

#[test]
fn a_long_scene_is_read_in_time() {
    let many: String = (0..3000).map(|i| format!("p{i} = \"p{}*2\"\n", i + 1)).collect();
    let text = SCENES[1].replace("[parameters]", &format!("[parameters]\n{many}p3000 = \"1 m\""));
    survives(&text, &[]);
}
