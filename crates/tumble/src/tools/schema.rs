//! `tumble schema`: the shape of scene files as a JSON schema, so that editors complete keys and mark misspelt ones.
//!
//! It knows keys, types and words. Formulas are texts to it: names, units and dimensions are what `tumble check` looks at.

mod bodies;
mod forces;
mod parts;
#[cfg(test)]
mod tests;

use serde_json::{Value, json};

use super::say::say;
use crate::commands::Ending;
use parts::{Key, choice, closed, each, may, must, named, open};

/// Prints the schema.
pub(crate) fn run() -> Ending {
    say!("{:#}", schema());
    Ending::Success
}

/// The schema of a whole scene file.
fn schema() -> Value {
    let mut schema = closed("a scene", &sections());
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["description"] =
        json!("A scene of tumble: bodies, forces, and what to find out about their motion.");
    schema["$defs"] = parts::definitions();
    schema
}

/// Every section and key at the top of a file, in the order of the language's page.
fn sections() -> Vec<Key> {
    let top = [
        must("version", json!({ "const": 1 }), "Version of the scene language."),
        may("title", named("text"), "A line of text."),
        may("text", named("text"), "The problem in words; empty lines part paragraphs."),
        may(
            "plane",
            choice(&["vertical", "horizontal"]),
            "Vertical: the weight acts along -y. Horizontal: seen from above.",
        ),
        may("parameters", open(named("formula")), "Named quantities, `name = \"formula\"`, in any order."),
        may("functions", open(named("text")), "Functions, `\"name(argument, ...)\" = \"formula\"`."),
        may("table", each(table()), "Functions of one variable that were measured."),
        must("world", world(), "What surrounds the bodies."),
    ];
    let bottom = [
        may("event", each(event()), "What happens each time a formula passes a value."),
        may("sweep", open(sweep()), "Parameters that take several values, one run each."),
        must("run", duration(), "How long, and how accurately."),
        may(
            "equilibrium",
            closed("[equilibrium]", &[]),
            "Asks for the pose near the start in which nothing accelerates.",
        ),
        may("output", output(), "How dense the tables are."),
        may("plot", each(plot()), "Curves against the time or another quantity."),
        may("stroboscope", each(stroboscope()), "Bodies at equal steps of time in one picture."),
        may("balance", each(balance()), "Energies and works along the run."),
        may("find", each(find()), "What is asked for: values at an instant, or the greatest and least."),
        may("free_body", each(free_body()), "Free-body diagrams of one body at some instants."),
        may("check", each(check()), "Claims; if one does not hold, the command ends with 1."),
        may("play", play(), "What a reader of the report may change."),
        may("symbols", open(json!({ "type": ["string", "object"] })), "How names are written in figures."),
    ];
    top.into_iter().chain(bodies::sections()).chain(forces::sections()).chain(bottom).collect()
}

fn table() -> Value {
    closed(
        "[table.NAME]",
        &[
            must("file", named("text"), "A CSV file in the folder of the scene or below it."),
            must(
                "columns",
                parts::pair(named("text")),
                "Headers of the variable and of the value, with their units.",
            ),
            must("interpolation", choice(&["constant", "linear", "cubic"]), "What holds between the values."),
            must(
                "outside",
                choice(&["hold", "zero", "refuse"]),
                "What holds before the first and after the last value.",
            ),
        ],
    )
}

fn world() -> Value {
    closed(
        "[world]",
        &[
            must("gravity", named("quantity"), "Acceleration of free fall; without gravity \"0 m/s^2\"."),
            may(
                "wind",
                named("vector"),
                "Velocity of the air, a formula of `t`, `x` and `y`; at rest without it.",
            ),
            may(
                "impacts",
                choice(&["simultaneous", "sequential"]),
                "How impacts at several points at once are taken.",
            ),
        ],
    )
}

fn event() -> Value {
    let set =
        closed("action", &[must("set", open(named("formula")), "Parameters and their values from then on.")]);
    closed(
        "[event.NAME]",
        &[
            must(
                "when",
                named("text"),
                "\"A rises through B\", \"A falls through B\" or \"A passes through B\".",
            ),
            may(
                "action",
                json!({ "anyOf": [choice(&["record", "stop"]), set] }),
                "What is done; only recorded without it.",
            ),
        ],
    )
}

fn sweep() -> Value {
    let labelled = closed(
        "value of a sweep",
        &[must("value", named("formula"), "A value."), must("label", named("text"), "How figures call it.")],
    );
    let range = closed(
        "range of a sweep",
        &[
            must("from", named("formula"), "The first value."),
            must("to", named("formula"), "The last value."),
            must(
                "count",
                json!({ "type": "integer", "minimum": 2, "maximum": 10_000 }),
                "How many, both ends included.",
            ),
            may("spacing", choice(&["linear", "log"]), "Equal distances, or equal ratios."),
        ],
    );
    let list = json!({ "type": "array", "minItems": 1, "items": { "anyOf": [named("formula"), labelled] } });
    json!({ "anyOf": [list, range] })
}

fn play() -> Value {
    let range = closed(
        "range of a slider",
        &[
            must("from", named("formula"), "The least value."),
            must("to", named("formula"), "The greatest value."),
            may("spacing", choice(&["linear", "log"]), "Equal distances, or equal ratios."),
        ],
    );
    // Starts have dots in their names, which TOML reads as tables.
    let mut section = open(json!({ "anyOf": [parts::pair(named("formula")), range, { "type": "object" }] }));
    let preset = closed(
        "[play.presets.NAME]",
        &[
            may("label", named("text"), "What its button says."),
            must("set", json!({ "type": "object" }), "Values by their names."),
        ],
    );
    section["properties"] = json!({ "presets": each(preset) });
    section
}

fn duration() -> Value {
    let at_rest = closed(
        "end at rest",
        &[
            must(
                "rest",
                json!({ "const": true }),
                "The run ends where all bodies have come to rest for good.",
            ),
            must("at_most", named("quantity"), "The latest end."),
        ],
    );
    let until = json!({ "anyOf": [named("quantity"), at_rest] });
    closed(
        "[run]",
        &[
            must("until", until, "End of the run; it starts at 0."),
            may(
                "accuracy",
                json!({ "type": "number", "minimum": 1e-14, "maximum": 1e-3 }),
                "1e-9 without it.",
            ),
        ],
    )
}

fn output() -> Value {
    closed("[output]", &[must("every", named("quantity"), "Time between lines of the tables.")])
}

fn plot() -> Value {
    let labelled = closed(
        "labelled formula",
        &[
            must("value", named("formula"), "The formula."),
            must("label", named("text"), "How figures call it."),
        ],
    );
    let curve = json!({ "anyOf": [named("formula"), labelled] });
    let curves = json!({ "type": "array", "minItems": 1, "items": curve });
    closed(
        "[plot.NAME]",
        &[
            must("y", json!({ "anyOf": [curve, curves] }), "A formula, or several of one dimension."),
            may("x", curve, "The time without it."),
            may(
                "during",
                parts::pair(named("quantity")),
                "`[from, to]`: times, events or contacts; all without it.",
            ),
            may(
                "title",
                named("text"),
                "Above the figure; the scene's title and the figure's name without it.",
            ),
        ],
    )
}

fn balance() -> Value {
    closed(
        "[balance.NAME]",
        &[
            may(
                "show",
                choice(&tumble_scene::Sheet::ALL.map(tumble_scene::Sheet::word)),
                "Kinetic, potential and total energy, which is shown without it; the work of each load; what is left.",
            ),
            may(
                "title",
                named("text"),
                "Above the figure; the scene's title and the figure's name without it.",
            ),
        ],
    )
}

fn stroboscope() -> Value {
    let names = json!({ "type": "array", "items": named("text") });
    closed(
        "[stroboscope.NAME]",
        &[
            must("every", named("quantity"), "Time between two instants."),
            may(
                "body",
                json!({ "anyOf": [named("text"), names] }),
                "A body or a list of bodies; all without it.",
            ),
            may(
                "trace",
                json!({ "type": "boolean" }),
                "Whether the paths of the centres are drawn; they are without it.",
            ),
            may(
                "title",
                named("text"),
                "Above the picture; the scene's title and the picture's name without it.",
            ),
        ],
    )
}

fn free_body() -> Value {
    let labelled = closed(
        "labelled instant",
        &[
            must("at", named("quantity"), "A time, an event or a contact."),
            may("label", named("text"), "How the diagram is called; by its instant without it."),
        ],
    );
    let instant = json!({ "anyOf": [named("quantity"), labelled] });
    let instants = json!({ "type": "array", "minItems": 1, "maxItems": 12, "items": instant });
    closed(
        "[free_body.NAME]",
        &[
            must("body", named("text"), "Name of the body."),
            must("at", json!({ "anyOf": [instant, instants] }), "An instant or a list of instants."),
            may(
                "title",
                named("text"),
                "Above the diagrams; the scene's title and the sheet's name without it.",
            ),
        ],
    )
}

fn find() -> Value {
    closed("[find.NAME]", &question())
}

fn check() -> Value {
    let claim = [
        must("equals", named("formula"), "What it must be, a formula of the parameters."),
        must("within", named("formula"), "The largest difference allowed."),
    ];
    closed("[check.NAME]", &question().into_iter().chain(claim).collect::<Vec<_>>())
}

fn question() -> [Key; 4] {
    [
        must("that", named("formula"), "A formula of the motion."),
        may(
            "at",
            named("quantity"),
            "A time, an event such as \"apex[2]\", \"its greatest\" or \"its least\"; the end of the run without it.",
        ),
        may(
            "during",
            parts::pair(named("quantity")),
            "`[from, to]`, between which it is greatest or least; the whole run without it.",
        ),
        may("side", choice(&["before", "after"]), "Of what happens then; after it without it."),
    ]
}
