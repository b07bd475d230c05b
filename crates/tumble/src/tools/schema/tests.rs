//! The schema against the reader: the same keys everywhere, and a misspelt one is caught.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

use super::super::scaffold::completed;
use super::schema;

/// A key that no section has, and that none is near to.
const KEY: &str = "quxquxquxqux";

/// (title of a table in the schema, a scene with the key in such a table)
const TABLES: &[(&str, &str)] = &[
    ("[table.NAME]", "[table.gust]\nKEY = 1"),
    ("[world]", "[world]\ngravity = \"9.81 m/s^2\"\nKEY = 1"),
    ("[event.NAME]", "[event.apex]\nKEY = 1"),
    ("action", "[event.apex]\naction = { KEY = 1 }"),
    ("value of a sweep", "[parameters]\nT = 1\n[sweep]\nT = [{ KEY = 1 }]"),
    ("range of a sweep", "[parameters]\nT = 1\n[sweep]\nT = { KEY = 1 }"),
    ("range of a slider", "[parameters]\nT = 1\n[play]\nT = { from = 0, KEY = 1 }"),
    ("[play.presets.NAME]", "[play.presets.a]\nKEY = 1"),
    ("[run]", "[run]\nuntil = \"1 s\"\nKEY = 1"),
    ("end at rest", "[run]\nuntil = { rest = true, at_most = \"1 s\", KEY = 1 }"),
    ("[equilibrium]", "[equilibrium]\nKEY = 1"),
    ("[output]", "[output]\nKEY = 1"),
    ("[plot.NAME]", "[plot.a]\nKEY = 1"),
    ("labelled formula", "[plot.a]\ny = { KEY = 1 }"),
    ("[stroboscope.NAME]", "[stroboscope.a]\nKEY = 1"),
    ("[balance.NAME]", "[balance.a]\nKEY = 1"),
    ("[free_body.NAME]", "[free_body.a]\nKEY = 1"),
    ("labelled instant", "[free_body.a]\nat = { KEY = 1 }"),
    ("[surface.NAME]", "[surface.a]\nKEY = 1"),
    ("circle", "[surface.a]\ncircle = { KEY = 1 }"),
    ("[contact.NAME]", "[contact.a]\nKEY = 1"),
    ("rigid", "[surface.a]\nrigid = { KEY = 1 }"),
    ("spring of a surface", "[surface.a]\nspring = { KEY = 1 }"),
    ("hertz", "[surface.a]\nhertz = { KEY = 1 }"),
    ("[find.NAME]", "[find.a]\nKEY = 1"),
    ("[check.NAME]", "[check.a]\nKEY = 1"),
    ("[body.NAME]", "[body.a]\nKEY = 1"),
    ("part of a body", "[body.a]\nparts = [{ KEY = 1 }]"),
    ("start", "[body.a]\nstart = { KEY = 1 }"),
    ("point", "[body.a]\npoint = { KEY = 1 }"),
    ("rod", "[body.a]\nrod = { KEY = 1 }"),
    ("disk", "[body.a]\ndisk = { KEY = 1 }"),
    ("ring", "[body.a]\nring = { KEY = 1 }"),
    ("ball", "[body.a]\nball = { KEY = 1 }"),
    ("shell", "[body.a]\nshell = { KEY = 1 }"),
    ("box", "[body.a]\nbox = { KEY = 1 }"),
    ("polygon", "[body.a]\npolygon = { KEY = 1 }"),
    (
        "friction",
        "[surface.a]\nthrough = [0, 0]\nrigid = { restitution = 0, friction = { static = 0.4, kinetic = 0.3, KEY = 1 } }",
    ),
    ("[pivot.NAME]", "[pivot.a]\nKEY = 1"),
    ("[pin.NAME]", "[pin.a]\nKEY = 1"),
    ("end of a joint", "[pin.a]\nbetween = [{ KEY = 1 }, \"rod.tip\"]"),
    ("[weld.NAME]", "[weld.a]\nKEY = 1"),
    ("[force.NAME]", "[force.a]\ntorque = \"1 N*m\"\nKEY = 1"),
    ("place of a force", "[force.a]\non = \"rod\"\nforce = [0, 0]\nat = { KEY = 1 }"),
    ("[impulse.NAME]", "[impulse.a]\ntorque = \"1 N*m*s\"\nKEY = 1"),
    ("[drag.NAME]", "[drag.a]\nKEY = 1"),
    ("[lift.NAME]", "[lift.a]\nKEY = 1"),
    ("[spring.NAME]", "[spring.a]\nKEY = 1"),
    ("end of a spring", "[spring.a]\nbetween = [{ KEY = 1 }, \"rod.tip\"]"),
    ("[damper.NAME]", "[damper.a]\nKEY = 1"),
    ("[torsion.NAME]", "[torsion.a]\nKEY = 1"),
];

/// Every table of the schema that has a fixed set of keys, by its title.
fn closed_tables(schema: &Value) -> BTreeMap<String, BTreeSet<String>> {
    let (mut found, mut pending) = (BTreeMap::new(), vec![schema]);
    while let Some(part) = pending.pop() {
        if part["additionalProperties"] == false {
            let keys = part["properties"].as_object().expect("keys").keys().cloned().collect();
            let title = part["title"].as_str().expect("a title").to_owned();
            // A shape stands in bodies and in their parts, alike.
            let before = found.insert(title, keys);
            assert!(before.is_none_or(|before: BTreeSet<String>| found.values().any(|keys| *keys == before)));
        }
        pending.extend(part.as_object().into_iter().flat_map(|map| map.values()));
        pending.extend(part.as_array().into_iter().flatten());
    }
    found
}

/// The keys that the reader says it knows where it refuses one that it does not know.
fn known_to_the_reader(scene: &str, says: &str) -> BTreeSet<String> {
    let scene = completed(&scene.replace("KEY", KEY));
    let mistakes = tumble_scene::read("scene.toml", &scene, &[]).expect_err("an unknown key");
    let of_key = |message: &str| message.contains(KEY);
    let mistake = mistakes.list.iter().find(|mistake| of_key(&mistake.message)).expect("the key is noted");
    let help = mistake.help.as_deref().unwrap_or_default();
    let list = help.strip_prefix(says).unwrap_or_else(|| panic!("{scene}\n{help}"));
    list.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

#[test]
fn every_table_has_the_keys_that_the_reader_knows() {
    let tables = closed_tables(&schema());
    for (title, scene) in TABLES {
        let keys = tables.get(*title).unwrap_or_else(|| panic!("the schema has no table `{title}`"));
        assert_eq!(*keys, known_to_the_reader(scene, "the keys are "), "{title}");
    }
    let compared: BTreeSet<_> = TABLES.iter().map(|(title, _)| *title).chain(["a scene"]).collect();
    assert_eq!(tables.keys().map(String::as_str).collect::<BTreeSet<_>>(), compared);
}

#[test]
fn the_sections_are_those_of_the_reader() {
    let tables = closed_tables(&schema());
    assert_eq!(tables["a scene"], known_to_the_reader("[KEY.a]\nb = 1", "a scene is made of "));
}

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
        "minProperties" => {
            value.as_object().is_none_or(|map| map.len() as u64 >= rule.as_u64().expect("a count"))
        }
        "maxProperties" => {
            value.as_object().is_none_or(|map| map.len() as u64 <= rule.as_u64().expect("a count"))
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
        if key != "symbols" {
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
    ] {
        assert!(!valid(text), "{text}");
    }
}
