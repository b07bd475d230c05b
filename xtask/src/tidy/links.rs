//! Relative links of documents lead to files that exist.

use super::Finding;
use super::tree::{File, Tree};

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    tree.below("", ".md").flat_map(|file| check_file(tree, file)).collect()
}

fn check_file(tree: &Tree, file: &File) -> Vec<Finding> {
    let links = links(file).into_iter().filter(|(_, target)| is_relative(target));
    let dead = links.filter(|(_, target)| resolve(&file.path, target).is_none_or(|path| !tree.has(&path)));
    dead.map(|(line, target)| Finding::refused(&file.path, line, format!("`{target}` does not exist")))
        .collect()
}

/// Targets of links and pictures with their lines, outside blocks of code.
fn links(file: &File) -> Vec<(usize, &str)> {
    let mut in_code = false;
    let mut links = Vec::new();
    for (number, line) in file.lines() {
        if line.trim_start().starts_with("```") {
            in_code = !in_code;
        } else if !in_code {
            links.extend(inline(line).chain(definition(line)).map(|target| (number, target)));
        }
    }
    links
}

/// `[text](target "title")`; what stands in backquotes is code.
fn inline(line: &str) -> impl Iterator<Item = &str> {
    let starts =
        line.match_indices("](").filter(|(at, _)| line[..*at].matches('`').count().is_multiple_of(2));
    starts.filter_map(|(at, mark)| line[at + mark.len()..].split([')', ' ']).next())
}

/// `[name]: target`
fn definition(line: &str) -> Option<&str> {
    let (_, target) = line.strip_prefix('[')?.split_once("]: ")?;
    target.split_whitespace().next()
}

fn is_relative(target: &str) -> bool {
    let elsewhere = target.contains("://") || target.starts_with("mailto:") || target.starts_with('#');
    !target.is_empty() && !elsewhere
}

/// The path from the root; nothing if it leaves the repository.
fn resolve(document: &str, target: &str) -> Option<String> {
    let target = target.split('#').next().unwrap_or(target).trim_matches(['<', '>']);
    let folder = document.rsplit_once('/').map_or("", |(folder, _)| folder);
    let mut parts: Vec<&str> = Vec::new();
    for part in folder.split('/').chain(target.split('/')) {
        match part {
            "" | "." => {}
            ".." => drop(parts.pop()?),
            name => parts.push(name),
        }
    }
    Some(parts.join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dead(text: &str) -> Vec<String> {
        let tree = Tree::from(&[("docs/page.md", text), ("docs/other.md", ""), ("ABOUT.md", "")]);
        check(&tree).into_iter().map(|finding| finding.message).collect()
    }

    #[test]
    fn living_links() {
        assert!(dead("[a](other.md#part) [b](../ABOUT.md \"title\") ![c](../docs/) [d](#here)").is_empty());
        assert!(dead("[a](https://example.org/x) [b](mailto:a@example.org)").is_empty());
        assert!(dead("[name]: other.md").is_empty());
    }

    #[test]
    fn dead_links() {
        assert_eq!(dead("see [a](missing.md)"), ["`missing.md` does not exist"]);
        assert_eq!(dead("[a](../../outside.md)"), ["`../../outside.md` does not exist"]);
        assert_eq!(dead("[name]: missing.md"), ["`missing.md` does not exist"]);
    }

    #[test]
    fn code_is_not_a_link() {
        assert!(dead("`x[0](y)`\n```rust\na[0](b)\n```\n").is_empty());
    }
}
