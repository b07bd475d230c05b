//! What is fixed before a run in a formula that may change during it: numbers that must be finite, and angles that must have
//! digits left.

use std::collections::{HashMap, HashSet};

use tumble_expr::{Expr, Node, Unary};

use crate::error::ModelError;
use crate::parameters::{Known, Parameters};

/// rad; doubles near a larger angle are an eighth of a radian apart, or more: its sine is not known to one digit.
pub(crate) const LARGEST_ARGUMENT: f64 = 1e15;

/// rad; near a larger angle of a body doubles are more than 1e-7 apart, so that its sine has lost half its digits.
pub(crate) const LARGEST_ANGLE: f64 = 1e9;

impl Known<'_> {
    /// What cannot be computed with in formulas, each with what messages call it: a fixed part that is infinite or no number,
    /// or a sine of an angle that has no digits left.
    pub fn mistakes_of<'f>(&self, formulas: impl Iterator<Item = (&'f str, &'f Expr)>) -> Vec<ModelError> {
        let mut search =
            Search { parameters: self.parameters(), fixed: HashMap::new(), seen: HashSet::new() };
        let found: Vec<Part<'f>> = formulas.flat_map(|(what, formula)| search.parts(what, formula)).collect();
        let all: Vec<Expr> = found.iter().map(|part| part.formula.clone()).collect();
        // A formula whose parts do not fit together is reported as that.
        let values = self.evaluate(&all).unwrap_or_default();
        let mut mistakes: Vec<ModelError> = vec![];
        for mistake in found.iter().zip(values).filter_map(|(part, value)| part.mistake(value)) {
            // One formula may hold the same mistake several times.
            let is_new = mistakes.last().is_none_or(|last| last.what() != mistake.what());
            mistakes.extend(is_new.then_some(mistake));
        }
        mistakes
    }
}

/// A formula that is fixed by the parameters and must have a value that can be computed with.
#[derive(Clone, Debug)]
pub(crate) struct Fixed {
    pub(crate) formula: Expr,
    /// Whether a sine or cosine is taken of it.
    is_argument: bool,
}

impl Fixed {
    pub(crate) fn allows(&self, value: f64) -> bool {
        is_fit(value, self.is_argument)
    }
}

fn is_fit(value: f64, is_argument: bool) -> bool {
    value.is_finite() && !(is_argument && value.abs() > LARGEST_ARGUMENT)
}

impl Parameters {
    /// What is fixed in some formulas.
    pub(crate) fn fixed_parts(&self, formulas: &[Expr]) -> Vec<Fixed> {
        let mut search = Search { parameters: self, fixed: HashMap::new(), seen: HashSet::new() };
        let parts = formulas.iter().flat_map(|formula| search.parts("", formula));
        let fixed = |part: Part<'_>| Fixed { formula: part.formula.clone(), is_argument: part.is_argument };
        parts.map(fixed).collect()
    }
}

impl Known<'_> {
    /// Whether all that is fixed in the formulas of the parameters themselves can be computed with.
    pub(crate) fn has_sound_formulas(&self) -> bool {
        let composed = self.parameters().formulas().filter(|(_, formula)| !formula.children().is_empty());
        let parts: Vec<Fixed> =
            composed.flat_map(|(_, formula)| self.parameters().parts_of(formula).to_vec()).collect();
        let formulas: Vec<Expr> = parts.iter().map(|part| part.formula.clone()).collect();
        let values = self.evaluate(&formulas);
        values.is_ok_and(|values| parts.iter().zip(values).all(|(part, value)| part.allows(value)))
    }
}

/// A part of a formula that is fixed.
struct Part<'f> {
    what: &'f str,
    formula: &'f Expr,
    /// Whether a sine or cosine is taken of it.
    is_argument: bool,
}

impl Part<'_> {
    fn mistake(&self, value: f64) -> Option<ModelError> {
        let what = self.what.to_owned();
        match value {
            _ if !value.is_finite() => Some(ModelError::NotFinite { what, value }),
            _ if self.is_argument && value.abs() > LARGEST_ARGUMENT => {
                Some(ModelError::Angle { what, value, most: LARGEST_ARGUMENT })
            }
            _ => None,
        }
    }
}

/// A walk through formulas in which every shared part is looked at once.
struct Search<'p> {
    parameters: &'p Parameters,
    fixed: HashMap<*const Node, bool>,
    seen: HashSet<*const Node>,
}

impl Search<'_> {
    /// The largest parts that are fixed, and what sines and cosines are taken of.
    fn parts<'f>(&mut self, what: &'f str, formula: &'f Expr) -> Vec<Part<'f>> {
        self.mark(formula);
        let mut found = vec![];
        // With whether the part is to be a finite number by itself.
        let mut pending = vec![(formula, true)];
        while let Some((next, counts)) = pending.pop() {
            if !self.seen.insert(std::ptr::from_ref(next.node())) {
                continue;
            }
            let is_value = counts && self.is_fixed(next) && next.dimension().is_ok();
            if is_value && !next.children().is_empty() {
                found.push(Part { what, formula: next, is_argument: false });
            }
            match next.node() {
                Node::Unary(Unary::Sin | Unary::Cos | Unary::Tan, angle) if self.is_fixed(angle) => {
                    found.push(Part { what, formula: angle, is_argument: true });
                }
                _ => {}
            }
            // What a condition leaves out need not have a value.
            let of_branch = matches!(next.node(), Node::Select(..));
            let parts = next.children().into_iter().enumerate();
            pending.extend(parts.map(|(at, part)| (part, counts && !is_value && !(of_branch && at > 0))));
        }
        found
    }

    fn is_fixed(&self, formula: &Expr) -> bool {
        self.fixed.get(&std::ptr::from_ref(formula.node())).copied().unwrap_or(false)
    }

    /// Finds of every part whether it is fixed; the depth of a formula is not bounded by the stack.
    fn mark(&mut self, formula: &Expr) {
        let mut pending = vec![formula];
        while let Some(next) = pending.last().copied() {
            let parts = next.children();
            let missing = |part: &&&Expr| !self.fixed.contains_key(&std::ptr::from_ref(part.node()));
            let unknown: Vec<&Expr> = parts.iter().filter(missing).copied().collect();
            if unknown.is_empty() {
                let fixed = match next.node() {
                    Node::Symbol(symbol) => self.parameters.contains(symbol),
                    _ => parts.iter().all(|part| self.is_fixed(part)),
                };
                self.fixed.insert(std::ptr::from_ref(next.node()), fixed);
                pending.pop();
            } else {
                pending.extend(unknown);
            }
        }
    }
}
