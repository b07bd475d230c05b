//! Elementary functions come from the pinned kernel, so that results have the same bits on every machine.
//!
//! The standard library leaves their accuracy open. Square roots are exact by IEEE 754 and allowed. The rule reads
//! text and cannot know types: it refuses the path form (`f64::` and the name) in every crate that computes, and the
//! method form except where the receiver is known to be a formula or a scalar with the kernel's own methods.

use super::Finding;
use super::source::{has_word, shipped};
use super::tree::{File, Tree};

/// The crates whose numbers are results.
const COMPUTING: [&str; 3] = ["crates/tumble-expr/src/", "crates/tumble-ode/src/", "crates/tumble-mech/src/"];

/// Where the method form is refused too.
const NUMBERS_ONLY: [&str; 2] = ["crates/tumble-expr/src/", "crates/tumble-ode/src/"];

/// Files and folders of those crates with methods of the same names on other types than numbers: formulas, and
/// scalars whose methods are the kernel's.
const OTHER_TYPES: &[&str] = &[
    "crates/tumble-expr/src/differentiate.rs",
    "crates/tumble-expr/src/expr.rs",
    "crates/tumble-expr/src/operators.rs",
    "crates/tumble-expr/src/ops.rs",
    "crates/tumble-expr/src/ops/",
    "crates/tumble-expr/src/typing.rs",
    "crates/tumble-expr/src/vector.rs",
];

const OF_ONE: [&str; 21] = [
    "sin", "cos", "tan", "sin_cos", "asin", "acos", "atan", "sinh", "cosh", "tanh", "asinh", "acosh",
    "atanh", "exp", "exp2", "exp_m1", "ln", "ln_1p", "log2", "log10", "cbrt",
];
const OF_TWO: [&str; 5] = ["powf", "powi", "atan2", "hypot", "log"];

pub(super) fn check(tree: &Tree) -> Vec<Finding> {
    COMPUTING.iter().flat_map(|folder| tree.below(folder, ".rs")).flat_map(check_file).collect()
}

fn check_file(file: &File) -> Vec<Finding> {
    let starts = |folders: &[&str]| folders.iter().any(|folder| file.path.starts_with(folder));
    let methods = starts(&NUMBERS_ONLY) && !starts(OTHER_TYPES);
    let found = |line: &str| path_form(line).or_else(|| if methods { method_form(line) } else { None });
    let lines = shipped(file).into_iter().filter_map(|(number, line)| Some((number, found(line)?)));
    lines.map(|(number, text)| Finding::refused(&file.path, number, advice(&text))).collect()
}

fn advice(text: &str) -> String {
    format!("`{text}` is the standard library's: use the pinned kernel")
}

fn names() -> impl Iterator<Item = &'static str> {
    OF_ONE.into_iter().chain(OF_TWO)
}

fn path_form(line: &str) -> Option<String> {
    let paths = names().flat_map(|name| [format!("f64::{name}"), format!("f32::{name}")]);
    paths.into_iter().find(|path| has_word(line, path))
}

fn method_form(line: &str) -> Option<String> {
    let of_one = OF_ONE.into_iter().map(|name| format!(".{name}()"));
    of_one.chain(OF_TWO.map(|name| format!(".{name}("))).find(|call| line.contains(call.as_str()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(path: &str, line: &str) -> usize {
        check(&Tree::from(&[(path, line)])).len()
    }

    #[test]
    fn paths_are_refused_wherever_results_are_computed() {
        assert_eq!(count("crates/tumble-mech/src/a.rs", "let y = f64::sin(x);"), 1);
        assert_eq!(count("crates/tumble-expr/src/expr.rs", "let y = f64::powf(x, 2.5);"), 1);
        assert_eq!(count("crates/tumble-drawing/src/a.rs", "let y = f64::sin(x);"), 0);
    }

    #[test]
    fn methods_are_refused_on_numbers() {
        assert_eq!(count("crates/tumble-ode/src/step.rs", "let y = x.exp();"), 1);
        assert_eq!(count("crates/tumble-expr/src/values.rs", "let y = x.powf(0.5);"), 1);
        assert_eq!(count("crates/tumble-expr/src/expr.rs", "let y = x.sin();"), 0);
        assert_eq!(count("crates/tumble-mech/src/drag.rs", "let y = angle.sin();"), 0);
    }

    #[test]
    fn roots_the_kernel_comments_and_tests_are_allowed() {
        let text = "let y = x.sqrt();\nlet z = kernel::sin(x);\n// x.sin()\n#[cfg(test)]\nmod tests {\n    x.sin()\n}\n";
        assert_eq!(count("crates/tumble-ode/src/step.rs", text), 0);
    }
}
