//! Crates depend on each other in one direction only.

use toml::{Table, Value};

use super::Finding;
use super::tree::{File, Tree};

/// Every crate of the workspace and what it may use of the others, in any kind of dependency.
const MAY_USE: &[(&str, &[&str])] = &[
    ("tumble-expr", &[]),
    ("tumble-ode", &["tumble-expr"]),
    ("tumble-mech", &["tumble-expr", "tumble-ode"]),
    ("tumble-scene", &["tumble-expr", "tumble-ode", "tumble-mech"]),
    ("tumble-drawing", &["tumble-notation"]),
    ("tumble-notation", &["tumble-expr"]),
    (
        "tumble-report",
        &["tumble-expr", "tumble-ode", "tumble-mech", "tumble-scene", "tumble-notation", "tumble-drawing"],
    ),
    (
        "tumble",
        &[
            "tumble-expr",
            "tumble-ode",
            "tumble-mech",
            "tumble-scene",
            "tumble-notation",
            "tumble-drawing",
            "tumble-report",
        ],
    ),
    (
        "tumble-lab",
        &[
            "tumble-expr",
            "tumble-ode",
            "tumble-mech",
            "tumble-scene",
            "tumble-notation",
            "tumble-drawing",
            "tumble-report",
        ],
    ),
    ("xtask", &[]),
];

const SECTIONS: [&str; 3] = ["dependencies", "dev-dependencies", "build-dependencies"];

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    let manifests = tree.files().iter().filter(|file| is_manifest(&file.path));
    manifests.flat_map(check_manifest).collect()
}

/// A manifest of a member, not the one of the workspace.
fn is_manifest(path: &str) -> bool {
    path == "xtask/Cargo.toml" || (path.starts_with("crates/") && path.ends_with("/Cargo.toml"))
}

fn check_manifest(file: &File) -> Vec<Finding> {
    let refuse = |message: String| vec![Finding::refused(&file.path, 0, message)];
    let Ok(manifest) = file.text().parse::<Table>() else {
        return refuse("is not TOML".to_owned());
    };
    let name = package_name(&manifest);
    let Some((_, allowed)) = MAY_USE.iter().find(|(member, _)| *member == name) else {
        return refuse(format!("crate `{name}` has no place in the order of crates"));
    };
    let used = dependencies(&manifest).into_iter().filter(|used| is_member(used));
    let wrong = used.filter(|used| !allowed.contains(&used.as_str()));
    wrong.map(|used| Finding::refused(&file.path, 0, format!("`{name}` must not use `{used}`"))).collect()
}

fn package_name(manifest: &Table) -> &str {
    manifest.get("package").and_then(|package| package.get("name")).and_then(Value::as_str).unwrap_or("")
}

fn is_member(name: &str) -> bool {
    MAY_USE.iter().any(|(member, _)| *member == name)
}

/// The packages of all dependency sections, those for certain targets included.
fn dependencies(manifest: &Table) -> Vec<String> {
    let targets = manifest.get("target").and_then(Value::as_table).into_iter().flat_map(Table::values);
    let tables = targets.filter_map(Value::as_table).chain([manifest]);
    tables
        .flat_map(|table| SECTIONS.iter().filter_map(|section| table.get(*section)))
        .flat_map(packages)
        .collect()
}

fn packages(section: &Value) -> Vec<String> {
    let entries = section.as_table().into_iter().flatten();
    entries
        .map(|(key, value)| value.get("package").and_then(Value::as_str).unwrap_or(key).to_owned())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn messages(path: &str, text: &str) -> Vec<String> {
        check(&Tree::from(&[(path, text)])).into_iter().map(|finding| finding.message).collect()
    }

    #[test]
    fn downwards_is_allowed() {
        let text =
            "[package]\nname = \"tumble-ode\"\n[dependencies]\ntumble-expr.workspace = true\nlibm = \"1\"\n";
        assert!(messages("crates/tumble-ode/Cargo.toml", text).is_empty());
    }

    #[test]
    fn upwards_is_refused_in_every_section_and_under_another_name() {
        let text = "[package]\nname = \"tumble-ode\"\n[dev-dependencies]\ntumble-mech.workspace = true\n\
                    [target.'cfg(unix)'.dependencies]\nother = { package = \"tumble-scene\", path = \"x\" }\n";
        let found = messages("crates/tumble-ode/Cargo.toml", text);
        assert_eq!(found.len(), 2);
        assert!(found.contains(&"`tumble-ode` must not use `tumble-mech`".to_owned()));
        assert!(found.contains(&"`tumble-ode` must not use `tumble-scene`".to_owned()));
    }

    #[test]
    fn report_takes_plain_data() {
        let text = "[package]\nname = \"tumble-drawing\"\n[dependencies]\ntumble-expr.workspace = true\n";
        assert_eq!(messages("crates/tumble-drawing/Cargo.toml", text).len(), 1);
    }

    #[test]
    fn a_new_crate_needs_a_place() {
        let found = messages("crates/tumble-new/Cargo.toml", "[package]\nname = \"tumble-new\"\n");
        assert_eq!(found, ["crate `tumble-new` has no place in the order of crates"]);
    }
}
