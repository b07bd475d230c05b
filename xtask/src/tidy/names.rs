//! A public type has a name that no public type of another crate has, so that it says which of them is meant.

use std::collections::BTreeMap;

use super::Finding;
use super::source::shipped;
use super::tree::{File, Tree};

/// Where a name was first found.
type Known<'a> = BTreeMap<&'a str, (&'a str, String)>;

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    let mut known = Known::new();
    tree.below("crates/", ".rs").flat_map(|file| check_file(file, &mut known)).collect()
}

fn check_file<'a>(file: &'a File, known: &mut Known<'a>) -> Vec<Finding> {
    let Some((own, _)) = file.path.split_once("/src/") else { return Vec::new() };
    let public = shipped(file).into_iter().filter_map(|(number, line)| Some((number, declared(line)?)));
    public
        .filter_map(|(number, name)| {
            let here = format!("{}:{number}", file.path);
            let (other, there) = known.entry(name).or_insert((own, here));
            let message = format!(
                "{there} has a public type `{name}` too: give one its better name, or make it private"
            );
            (*other != own).then(|| Finding::refused(&file.path, number, message))
        })
        .collect()
}

/// The name of the public type that this line declares.
fn declared(line: &str) -> Option<&str> {
    let rest = line.trim_start().strip_prefix("pub ")?;
    let keyword = |word: &str| rest.strip_prefix(word)?.strip_prefix(' ');
    let name = ["struct", "enum", "trait", "type", "union"].into_iter().find_map(keyword)?;
    name.split(|c: char| !c.is_alphanumeric() && c != '_').next()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(files: &[(&str, &str)]) -> Vec<(String, usize)> {
        check(&Tree::from(files)).into_iter().map(|finding| (finding.path, finding.line)).collect()
    }

    const A: (&str, &str) = ("crates/a/src/lib.rs", "pub struct Series<'a>(&'a str);\n");

    #[test]
    fn a_public_type_of_two_crates_is_refused_where_it_comes_second() {
        let b = ("crates/b/src/b.rs", "//! Of b.\n\npub enum Series {}\n");
        assert_eq!(places(&[A, b]), [(b.0.to_owned(), 3)]);
    }

    #[test]
    fn one_crate_may_have_a_name_twice_and_private_types_any() {
        let again = ("crates/a/src/other.rs", "pub type Series = f64;\n");
        let private =
            ("crates/b/src/lib.rs", "pub(crate) struct Series;\nstruct Series;\npub struct Series2;\n");
        let tested = ("crates/c/src/lib.rs", "#[cfg(test)]\nmod tests {\n    pub struct Series;\n}\n");
        let test = ("crates/c/tests/common.rs", "pub struct Series;\n");
        assert_eq!(places(&[A, again, private, tested, test]), []);
    }
}
