//! The rules that a program can check: the invariants of ARCHITECTURE.md and the house rules of CONTRIBUTING.md.
//!
//! A rule is a function from the [`Tree`] to findings, with its own tests, in a module of its own. A new rule is a
//! new entry of [`RULES`].

mod crates;
mod engine;
mod kernel;
mod laws;
mod length;
mod links;
mod names;
mod programs;
mod scenes;
mod source;
mod surroundings;
mod tree;
mod unsafe_code;
mod workshop;

use anyhow::{Result, bail};

use crate::workspace::Workspace;
pub(crate) use tree::{File, Tree};

type Rule = fn(&Tree) -> Vec<Finding>;

const RULES: &[(&str, Rule)] = &[
    ("crate dependencies", crates::check),
    ("unchecked code", unsafe_code::check),
    ("files, threads and times", surroundings::check),
    ("elementary functions", kernel::check),
    ("engine of pages", engine::check),
    ("length of files", length::check),
    ("headers of laws", laws::check),
    ("names of public types", names::check),
    ("scene folders", scenes::check),
    ("programs of tests", programs::check),
    ("links of documents", links::check),
    ("words of the workshop", workshop::check),
];

/// Applies every rule to the tracked files; warnings are printed, refusals fail.
pub(crate) fn run(workspace: &Workspace) -> Result<()> {
    let tree = Tree::of(workspace)?;
    let refusals: usize = RULES.iter().map(|(name, rule)| report(name, &rule(&tree))).sum();
    if refusals > 0 {
        bail!("{refusals} refused");
    }
    println!("{} rules hold for {} files", RULES.len(), tree.files().len());
    Ok(())
}

/// Prints the findings of one rule and counts those that refuse.
fn report(rule: &str, findings: &[Finding]) -> usize {
    for finding in findings {
        println!("{}", finding.line(rule));
    }
    findings.iter().filter(|finding| finding.refuses).count()
}

/// What a rule says about a place.
#[derive(Debug, PartialEq, Eq)]
struct Finding {
    path: String,
    /// Counted from 1; 0 for the file as a whole.
    line: usize,
    message: String,
    refuses: bool,
}

impl Finding {
    fn refused(path: &str, line: usize, message: impl Into<String>) -> Self {
        Self { path: path.to_owned(), line, message: message.into(), refuses: true }
    }

    fn warning(path: &str, line: usize, message: impl Into<String>) -> Self {
        Self { refuses: false, ..Self::refused(path, line, message) }
    }

    fn line(&self, rule: &str) -> String {
        let word = if self.refuses { "refused" } else { "warning" };
        let Self { path, line, message, .. } = self;
        if *line == 0 {
            format!("{word}: {path}: {message} [{rule}]")
        } else {
            format!("{word}: {path}:{line}: {message} [{rule}]")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_refusals_count() {
        let findings = [Finding::warning("a", 0, "long"), Finding::refused("b", 3, "wrong")];
        assert_eq!(report("rule", &findings), 1);
        assert_eq!(findings[0].line("rule"), "warning: a: long [rule]");
        assert_eq!(findings[1].line("rule"), "refused: b:3: wrong [rule]");
    }
}
