//! The schema against scenes: those of the repository are valid, and a misspelt key or a value of another kind is caught.

use serde_json::Value;

use super::super::scaffold::completed;
use super::schema;

/// Whether a value is as the schema says, for the keywords that the schema uses.
fn is_valid(root: &Value, schema: &Value, value: &Value) -> bool {
    let keywords = schema.as_object().expect("a schema");
    keywords.iter().all(|(keyword, rule)| match keyword.as_str() {
        "$ref" => {
            let pointer = rule.as_str().and_then(|rule| rule.strip_prefix('#')).expect("a pointer");
            is_valid(root, root.pointer(pointer).expect("a definition"), value)
        }
        "type" => match rule {
            Value::Array(types) => types.iter().any(|rule| is_of_type(rule, value)),
            rule => is_of_type(rule, value),
        },
        "const" => rule == value || rule.as_f64().is_some_and(|rule| Some(rule) == value.as_f64()),
        "enum" => rule.as_array().expect("words").contains(value),
        "anyOf" => rule.as_array().expect("schemas").iter().any(|rule| is_valid(root, rule, value)),
        "oneOf" => {
            let one = |rule: &&Value| is_valid(root, rule, value);
            rule.as_array().expect("schemas").iter().filter(one).count() == 1
        }
        "allOf" => rule.as_array().expect("schemas").iter().all(|rule| is_valid(root, rule, value)),
        "items" => value.as_array().is_none_or(|items| items.iter().all(|item| is_valid(root, rule, item))),
        "required" => value.as_object().is_none_or(|map| {
            rule.as_array().expect("keys").iter().all(|key| map.contains_key(key.as_str().expect("a key")))
        }),
        "additionalProperties" => value.as_object().is_none_or(|map| {
            let others = map.iter().filter(|(key, _)| schema["properties"].get(key).is_none());
            others.map(|(_, value)| value).all(|value| rule != false && is_valid(root, rule, value))
        }),
        "properties" => value.as_object().is_none_or(|map| {
            map.iter().all(|(key, value)| rule.get(key).is_none_or(|rule| is_valid(root, rule, value)))
        }),
        "minItems" => {
            value.as_array().is_none_or(|items| items.len() as u64 >= rule.as_u64().expect("a count"))
        }
        "maxItems" => {
            value.as_array().is_none_or(|items| items.len() as u64 <= rule.as_u64().expect("a count"))
        }
        "minimum" => value.as_f64().is_none_or(|number| number >= rule.as_f64().expect("a number")),
        "maximum" => value.as_f64().is_none_or(|number| number <= rule.as_f64().expect("a number")),
        "$schema" | "$defs" | "title" | "description" => true,
        other => panic!("the schema uses `{other}`, which this does not know"),
    })
}

fn is_of_type(rule: &Value, value: &Value) -> bool {
    match rule.as_str().expect("a type") {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "number" => value.is_number(),
        "integer" => value.is_i64() || value.is_u64(),
        "boolean" => value.is_boolean(),
        other => panic!("no type {other}"),
    }
}

/// The scenes of the repository, as JSON.
fn scenes() -> Vec<(String, Value)> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let folders = std::fs::read_dir(folder).expect("scenes").map(|entry| entry.expect("readable").path());
    let files = folders.map(|folder| folder.join("scene.toml")).filter(|file| file.is_file());
    let read = |file: std::path::PathBuf| {
        let text = std::fs::read_to_string(&file).expect("readable");
        (file.display().to_string(), toml::from_str(&text).expect("TOML"))
    };
    files.map(read).collect()
}

/// Every way to misspell one key of a value, names that are the user's left out.
fn misspelt(value: &Value, users: bool) -> Vec<(String, Value)> {
    let mut all = vec![];
    let map = value.as_object().into_iter().flatten();
    for (key, inner) in map {
        if !users {
            let mut changed = value.clone();
            let object = changed.as_object_mut().expect("a table");
            let moved = object.remove(key).expect("there");
            object.insert(format!("{key}x"), moved);
            all.push((key.clone(), changed));
        }
        const NAMED: &[&str] = &[
            "parameters",
            "functions",
            "table",
            "body",
            "pin",
            "weld",
            "pivot",
            "event",
            "force",
            "impulse",
            "drag",
            "lift",
            "spring",
            "damper",
            "torsion",
            "surface",
            "contact",
            "balance",
            "free_body",
            "sweep",
            "plot",
            "stroboscope",
            "find",
            "check",
            "points",
            "set",
        ];
        // What is named so in a section is a key of it, as `body` of a pivot is.
        let by_user = !users && inner.is_object() && NAMED.contains(&key.as_str());
        if !["symbols", "meaning"].contains(&key.as_str()) {
            let wrapped = misspelt(inner, by_user);
            all.extend(wrapped.into_iter().map(|(what, inner)| {
                let mut changed = value.clone();
                changed[key] = inner;
                (format!("{key}.{what}"), changed)
            }));
        }
    }
    for (index, inner) in value.as_array().into_iter().flatten().enumerate() {
        all.extend(misspelt(inner, false).into_iter().map(|(what, inner)| {
            let mut changed = value.clone();
            changed[index] = inner;
            (format!("{index}.{what}"), changed)
        }));
    }
    all
}

#[test]
fn the_scenes_are_valid_and_a_misspelt_key_is_caught() {
    let schema = schema();
    let scenes = scenes();
    assert!(!scenes.is_empty());
    for (name, scene) in scenes {
        assert!(is_valid(&schema, &schema, &scene), "{name}");
        let slips = misspelt(&scene, false);
        assert!(slips.len() > 10, "{name}");
        for (what, slip) in slips {
            assert!(!is_valid(&schema, &schema, &slip), "{name}: {what}");
        }
    }
}

#[test]
fn values_of_another_type_are_caught() {
    let schema = schema();
    let valid = |text: &str| {
        let scene: Value = toml::from_str(&completed(text)).expect("TOML");
        is_valid(&schema, &schema, &scene)
    };
    assert!(valid("") && valid("[parameters]\na = 2\nb = \"2 m\""));
    for text in [
        "version = 2",
        "plane = \"tilted\"",
        "[world]\ngravity = 9.81",
        "[run]\nuntil = \"1 s\"\naccuracy = 1",
        "[body.a]\nrod = { from = [0], to = [0, 0] }\nmass = \"1 kg\"",
        "[body.a]\npoint = {}",
        "[force.a]\non = \"rod\"\nforce = [0, 0]\nat = { body = [0, 0], world = [0, 0] }",
        "[sweep]\na = []",
        "[drag.a]\nat = \"rod.cm\"\non = \"rod\"",
        "[surface.a]\nthrough = [0, 0]",
        "[play.presets.a]\nlabel = \"slow\"",
        "[stroboscope.a]\nevery = \"1 s\"\ntrace = \"no\"",
    ] {
        assert!(!valid(text), "{text}");
    }
}
