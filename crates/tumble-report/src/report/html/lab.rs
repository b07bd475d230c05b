//! The panel of a page that plays, the engine and its scripts.

use tumble_expr::language::{BUILTINS, UNITS};
use tumble_scene::keys;

use super::page::joined;
use crate::report::Lab;
use crate::report::json::{list, object, string};

pub(super) const STYLE: &str = include_str!("../assets/lab.css");

/// Scripts in the order in which they run.
const SCRIPTS: [&str; 9] = [
    include_str!("../assets/lab-runs.js"),
    include_str!("../assets/lab-page.js"),
    include_str!("../assets/lab-drag.js"),
    include_str!("../assets/lab-complete.js"),
    include_str!("../assets/lab-scene.js"),
    include_str!("../assets/address.js"),
    include_str!("../assets/lab-save.js"),
    include_str!("../assets/lab-knobs.js"),
    include_str!("../assets/lab.js"),
];

/// What runs beside the page.
const WORKER: [&str; 2] = [include_str!("../assets/lab-worker.js"), include_str!("../assets/lab-unpack.js")];

/// Where the controls will be: what makes them is a script, and paper has none.
pub(super) const PANEL: &str = "<section id=\"play\" aria-labelledby=\"play-heading\" hidden></section>\n";

/// The engine, what it runs, and the scripts.
pub(super) fn scripts(lab: &Lab) -> String {
    let (data, scripts, worker) = (data(lab), joined(&SCRIPTS), joined(&WORKER));
    format!(
        "<script type=\"text/plain\" id=\"lab-engine\">{}</script>\n\
         <script type=\"application/json\" id=\"lab-data\">{data}</script>\n\
         <script type=\"text/plain\" id=\"lab-worker\">\n{worker}</script>\n\
         <script>\n{{\n{scripts}}}\n</script>\n",
        in_letters(lab.engine)
    )
}

/// Signs that a text of HTML may have and no parser changes.
const LETTERS: usize = 91;
/// Bits of two of them.
const BITS: u32 = 13;

/// Bytes as text: two signs for 13 bits, the lowest first, which is shorter than base64 by a twelfth.
fn in_letters(bytes: &[u8]) -> String {
    let letters: Vec<char> = ('!'..='~').filter(|c| !matches!(c, '<' | '&' | '\\')).collect();
    let mut text = String::with_capacity(bytes.len() * 16 / 13 + 2);
    let (mut bits, mut have) = (0_usize, 0);
    let pair = |value: usize| [letters[value % LETTERS], letters[value / LETTERS]];
    for byte in bytes {
        bits |= usize::from(*byte) << have;
        have += 8;
        if have >= BITS {
            text.extend(pair(bits % (1 << BITS)));
            (bits, have) = (bits >> BITS, have - BITS);
        }
    }
    if have > 0 {
        text.extend(pair(bits));
    }
    text
}

fn data(lab: &Lab) -> String {
    let set = lab.set.iter().map(|(name, text)| list([string(name), string(text)]));
    let files =
        lab.files.iter().map(|(name, bytes)| list([string(name), string(&String::from_utf8_lossy(bytes))]));
    let templates = lab.templates.iter().map(|(name, scene)| list([string(name), string(scene)]));
    object([
        ("name", string(&lab.name)),
        ("scene", string(&lab.scene)),
        ("files", list(files)),
        ("set", list(set)),
        ("play", lab.play.clone()),
        ("templates", list(templates)),
        ("words", words()),
    ])
}

/// What the text of a scene is completed to: the program's own lists.
fn words() -> String {
    let units = UNITS.iter().map(|unit| string(unit.symbol));
    let tables = keys::tables().into_iter().map(|(behind, keys)| {
        let names = keys.iter().map(|key| string(key.name));
        list([string(&behind), list(names)])
    });
    object([
        ("sections", list(keys::of_scene().map(|section| string(section.name)))),
        ("keys", list(tables)),
        ("units", list(units)),
        ("functions", list(BUILTINS.iter().map(|function| string(function.name)))),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As the script of pages does it.
    fn bytes(text: &str) -> Vec<u8> {
        let place =
            |c: u8| ('!'..='~').filter(|c| !matches!(c, '<' | '&' | '\\')).position(|l| l == char::from(c));
        let (mut found, mut bits, mut have) = (vec![], 0, 0);
        for pair in text.as_bytes().chunks(2) {
            bits |= (place(pair[0]).expect("a letter") + LETTERS * place(pair[1]).expect("a letter")) << have;
            have += BITS;
            while have >= 8 {
                found.push((bits % 256) as u8);
                (bits, have) = (bits / 256, have - 8);
            }
        }
        found
    }

    #[test]
    fn bytes_come_back_from_their_letters() {
        for length in [0, 1, 2, 12, 13, 14, 1000] {
            let all: Vec<u8> = (0..length).map(|i: u32| (i * i * 7 + i / 3) as u8).collect();
            let text = in_letters(&all);
            assert!(text.bytes().all(|c| c.is_ascii_graphic() && c != b'<' && c != b'&'));
            assert_eq!(bytes(&text)[..all.len()], all);
            assert!(text.len() <= all.len() * 16 / 13 + 2);
        }
        assert_eq!(bytes(&in_letters(&[255; 26]))[..26], [255; 26]);
    }
}
