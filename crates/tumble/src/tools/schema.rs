//! `tumble schema`: the shape of scene files as a JSON schema, so that editors complete keys and mark misspelt ones.
//!
//! It is made of what the sections of the language declare of their keys. Formulas are texts to it: names, units and dimensions are
//! what `tumble check` looks at.

#[cfg(test)]
mod tests;

use serde_json::{Map, Value, json};
use tumble_expr::Dimension;
use tumble_scene::keys::{self, Declared, Keys, Takes};

use super::say::say;
use crate::commands::Ending;

/// Prints the schema.
pub(crate) fn run() -> Ending {
    say!("{:#}", schema());
    Ending::Success
}

/// The schema of a whole scene file.
fn schema() -> Value {
    let mut schema = table("a scene", keys::of_scene(), &[]);
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["description"] =
        json!("A scene of tumble: bodies, forces, and what to find out about their motion.");
    schema["$defs"] = definitions();
    schema
}

/// A table of these keys and no others.
fn table(title: &str, keys: impl Iterator<Item = &'static Declared> + Clone, one_of: &[&[&str]]) -> Value {
    let properties: Map<String, Value> =
        keys.clone().map(|key| (key.name.to_owned(), property(key))).collect();
    let required: Vec<_> = keys.filter(|key| key.default.is_none()).map(|key| key.name).collect();
    let mut table = json!({
        "title": title,
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": false,
    });
    if !one_of.is_empty() {
        let one = |keys: &&[&str]| json!({ "oneOf": keys.iter().map(|key| json!({ "required": [key] })).collect::<Vec<_>>() });
        table["allOf"] = one_of.iter().map(one).collect();
    }
    table
}

/// What a key takes, with its meaning.
fn property(key: &Declared) -> Value {
    let mut value = of(&key.takes);
    let default = key.default.filter(|default| !default.is_empty());
    let without = default.map_or_else(String::new, |default| format!(" Without it: {default}."));
    value["description"] = json!(format!("{}.{without}", capital(key.says.trim_end_matches('.'))));
    if key.name == "play" {
        value["properties"] =
            json!({ "presets": { "type": "object", "additionalProperties": of(&keys::PRESETS) } });
    }
    value
}

fn of(takes: &Takes) -> Value {
    match takes {
        Takes::Text | Takes::Name(_) => named("text"),
        Takes::Formula => named("formula"),
        Takes::Quantity(dimension) if *dimension == Dimension::NONE => named("formula"),
        Takes::Quantity(_) | Takes::Angle(_) => named("quantity"),
        Takes::Vector(dimension) if *dimension == Dimension::NONE => pair(named("formula")),
        Takes::Vector(_) => named("vector"),
        Takes::Instant => named("quantity"),
        Takes::Flag => json!({ "type": "boolean" }),
        Takes::True => json!({ "const": true }),
        Takes::Exactly(number) => json!({ "const": number }),
        Takes::Number(least, most) => json!({ "type": "number", "minimum": least, "maximum": most }),
        Takes::Count(least, most) => json!({ "type": "integer", "minimum": least, "maximum": most }),
        Takes::Word(words) => json!({ "enum": words }),
        Takes::Pair(inner) => pair(of(inner)),
        Takes::List(least, most, inner) => list(*least, *most, inner),
        Takes::Table(keys) => of_table(keys),
        Takes::Named(inner) => json!({ "type": "object", "additionalProperties": of(inner) }),
        Takes::Open => json!({ "type": "object" }),
        Takes::Either(all) => json!({ "anyOf": all.iter().map(of).collect::<Vec<_>>() }),
    }
}

fn of_table(keys: &Keys) -> Value {
    table(keys.title, keys.iter(), keys.one_of)
}

fn list(least: usize, most: usize, inner: &Takes) -> Value {
    let mut list = json!({ "type": "array", "minItems": least, "items": of(inner) });
    if most != Takes::MOST {
        list["maxItems"] = json!(most);
    }
    list
}

/// A list of two.
fn pair(element: Value) -> Value {
    json!({ "type": "array", "items": element, "minItems": 2, "maxItems": 2 })
}

/// A definition by its name.
fn named(definition: &str) -> Value {
    json!({ "$ref": format!("#/$defs/{definition}") })
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// What stands in many places.
fn definitions() -> Value {
    json!({
        "text": { "type": "string" },
        "formula": {
            "description": "A formula in quotes; a pure number may stand without them.",
            "type": ["string", "number"],
        },
        "quantity": {
            "description": "A quantity with its unit, or a formula, in quotes; only 0 may stand without them.",
            "anyOf": [{ "type": "string" }, { "const": 0 }],
        },
        "vector": pair(named("quantity")),
    })
}
