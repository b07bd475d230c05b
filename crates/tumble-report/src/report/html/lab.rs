//! The panel of a page that plays, the engine and its scripts.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use tumble_expr::language::{BUILTINS, UNITS};
use tumble_scene::keys;

use crate::report::json::{list, object, string};
use crate::report::{Lab, live};

pub(super) const STYLE: &str = include_str!("../assets/lab.css");

/// Scripts in the order in which they run.
const SCRIPTS: [&str; 6] = [
    include_str!("../assets/lab-runs.js"),
    include_str!("../assets/lab-page.js"),
    include_str!("../assets/lab-drag.js"),
    include_str!("../assets/lab-complete.js"),
    include_str!("../assets/lab-scene.js"),
    include_str!("../assets/lab.js"),
];

/// What runs beside the page.
const WORKER: [&str; 2] = [include_str!("../assets/lab-worker.js"), include_str!("../assets/lab-unpack.js")];

/// Where the controls will be: what makes them is a script, and paper has none.
pub(super) const PANEL: &str = "<section id=\"play\" aria-labelledby=\"play-heading\" hidden></section>\n";

/// The engine, what it runs, and the scripts.
pub(super) fn scripts(lab: &Lab) -> String {
    let (data, scripts, worker) = (data(lab), SCRIPTS.concat(), WORKER.concat());
    format!(
        "<script type=\"text/plain\" id=\"lab-engine\">{}</script>\n\
         <script type=\"application/json\" id=\"lab-data\">{data}</script>\n\
         <script type=\"text/plain\" id=\"lab-worker\">\n{worker}</script>\n\
         <script>\n{{\n{scripts}}}\n</script>\n",
        STANDARD.encode(lab.engine)
    )
}

fn data(lab: &Lab) -> String {
    let set = lab.set.iter().map(|(name, text)| list([string(name), string(text)]));
    let files =
        lab.files.iter().map(|(name, bytes)| list([string(name), string(&String::from_utf8_lossy(bytes))]));
    object([
        ("name", string(&lab.name)),
        ("scene", string(&lab.scene)),
        ("files", list(files)),
        ("set", list(set)),
        ("play", live::play(&lab.play)),
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
