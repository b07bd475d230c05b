//! The files the rules look at: those of the repository, with their text.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

use crate::command::Process;
use crate::workspace::Workspace;

/// A file by its path from the root, with `/` between folders.
pub(crate) struct File {
    pub(crate) path: String,
    /// `None` for what is not text.
    text: Option<String>,
}

impl File {
    /// The text; empty for a file that is not text.
    pub(crate) fn text(&self) -> &str {
        self.text.as_deref().unwrap_or_default()
    }

    /// The lines with their numbers, counted from 1.
    pub(crate) fn lines(&self) -> impl Iterator<Item = (usize, &str)> {
        (1..).zip(self.text().lines())
    }
}

/// All files that are tracked, or would be after `git add --all`.
pub(crate) struct Tree {
    files: Vec<File>,
}

impl Tree {
    /// Reads the files of the repository.
    pub(crate) fn of(workspace: &Workspace) -> Result<Self> {
        let list = ["ls-files", "-z", "--cached", "--others", "--exclude-standard", "--deduplicate"];
        let names = Process::new("git", workspace.root()).args(list).output()?;
        let mut files = Vec::new();
        for name in names.split_terminator('\0') {
            files.extend(read(workspace.root(), name)?);
        }
        Ok(Self { files })
    }

    /// A tree for the test of a rule.
    #[cfg(test)]
    pub(crate) fn from(files: &[(&str, &str)]) -> Self {
        let file = |&(path, text): &(&str, &str)| File { path: path.to_owned(), text: Some(text.to_owned()) };
        Self { files: files.iter().map(file).collect() }
    }

    pub(crate) fn files(&self) -> &[File] {
        &self.files
    }

    pub(crate) fn file(&self, path: &str) -> Option<&File> {
        self.files.iter().find(|file| file.path == path)
    }

    /// Whether there is such a file, or a folder with files in it.
    pub(crate) fn has(&self, path: &str) -> bool {
        let path = path.trim_end_matches('/');
        let inside = |file: &File| file.path.strip_prefix(path).is_some_and(|rest| rest.starts_with('/'));
        path.is_empty() || self.files.iter().any(|file| file.path == path || inside(file))
    }

    /// The files below a folder, written with a final `/`, whose name ends so.
    pub(crate) fn below<'a>(&'a self, folder: &'a str, ending: &'a str) -> impl Iterator<Item = &'a File> {
        self.files.iter().filter(move |file| file.path.starts_with(folder) && file.path.ends_with(ending))
    }
}

/// Reads one file; nothing for a tracked file that has been deleted.
fn read(root: &Path, name: &str) -> Result<Option<File>> {
    let path = root.join(name);
    if !path.is_file() {
        return Ok(None);
    }
    let bytes = fs::read(&path).with_context(|| format!("cannot read {}", path.display()))?;
    let text = String::from_utf8(bytes).ok().filter(|text| !text.contains('\0'));
    Ok(Some(File { path: name.to_owned(), text }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_exist_through_their_files() {
        let tree = Tree::from(&[("docs/images/a.svg", "")]);
        assert!(tree.has("docs/images/a.svg") && tree.has("docs") && tree.has("docs/images/"));
        assert!(!tree.has("doc") && !tree.has("docs/images/a"));
    }

    #[test]
    fn below_looks_at_both_ends() {
        let tree = Tree::from(&[("a/x.rs", ""), ("a/b/y.rs", ""), ("a/z.md", ""), ("c/x.rs", "")]);
        let paths: Vec<_> = tree.below("a/", ".rs").map(|file| file.path.as_str()).collect();
        assert_eq!(paths, ["a/x.rs", "a/b/y.rs"]);
    }
}
