//! What schemas are put together from.

use serde_json::{Map, Value, json};

/// A key of a table: its name, the schema of its value, and whether the table must have it.
pub(super) struct Key {
    name: &'static str,
    value: Value,
    needed: bool,
}

/// A key that its table must have.
pub(super) fn must(name: &'static str, value: Value, description: &str) -> Key {
    Key { needed: true, ..may(name, value, description) }
}

/// A key that its table may have.
pub(super) fn may(name: &'static str, mut value: Value, description: &str) -> Key {
    value["description"] = json!(description);
    Key { name, value, needed: false }
}

/// A table of these keys and no others; a section may have a text beside them.
pub(super) fn closed(title: &str, keys: &[Key]) -> Value {
    let mut properties: Map<String, Value> =
        keys.iter().map(|key| (key.name.to_owned(), key.value.clone())).collect();
    if title.starts_with('[') {
        let text = may("text", named("text"), "What the report says of it; empty lines part paragraphs.");
        properties.insert(text.name.to_owned(), text.value);
    }
    let required: Vec<_> = keys.iter().filter(|key| key.needed).map(|key| key.name).collect();
    json!({
        "title": title,
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": false,
    })
}

/// A table whose keys are the user's names.
pub(super) fn open(value: Value) -> Value {
    json!({ "type": "object", "additionalProperties": value })
}

/// A section for each of the user's names, `[body.rod]`.
pub(super) fn each(section: Value) -> Value {
    open(section)
}

/// One of a few words.
pub(super) fn choice(words: &[&str]) -> Value {
    json!({ "enum": words })
}

/// A list of two.
pub(super) fn pair(element: Value) -> Value {
    json!({ "type": "array", "items": element, "minItems": 2, "maxItems": 2 })
}

/// A definition by its name.
pub(super) fn named(definition: &str) -> Value {
    json!({ "$ref": format!("#/$defs/{definition}") })
}

/// What stands in many places.
pub(super) fn definitions() -> Value {
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
        "end": {
            "description": "A named point such as \"rod.tip\", or a place in the world.",
            "anyOf": [
                named("text"),
                closed("end of a spring", &[must("world", named("vector"), "A place; it may depend on the time.")]),
            ],
        },
    })
}
