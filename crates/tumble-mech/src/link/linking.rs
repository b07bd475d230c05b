//! What the symbols of the motion stand for in a mode, found when they are asked for.

use std::collections::HashMap;
use std::sync::Arc;

use tumble_expr::{Binary, Expr, FastMap, Symbol};

use super::algebra::Algebra;
use super::island::Islands;
use super::names::{Meaning, Name, Names};
use super::part::{Part, Piece, TermOf};
use crate::equations::Equations;
use crate::mode::Mode;

/// A mode being put together.
pub(crate) struct Linking<'a, A: Algebra> {
    pub(super) equations: &'a Equations,
    pub(super) mode: &'a Mode,
    pub(super) names: Arc<Names>,
    pub(super) algebra: A,
    values: FastMap<Name, A::Value>,
    /// By body that is in the mode.
    acting: FastMap<usize, Acting>,
    pub(super) islands: Islands,
    /// Parameters that events have changed.
    changed: HashMap<Symbol, Expr>,
}

/// Terms that act on a body, in order.
#[derive(Default)]
struct Acting {
    /// Those that follow from the states.
    given: Vec<TermOf>,
    /// Those by which rows are kept.
    keeping: Vec<TermOf>,
}

impl<'a, A: Algebra> Linking<'a, A> {
    pub(crate) fn new(equations: &'a Equations, mode: &'a Mode, algebra: A) -> Self {
        let mut acting: FastMap<usize, Acting> =
            mode.bodies.iter().map(|body| (*body, Acting::default())).collect();
        for (term, keeps) in equations.acting_terms(mode) {
            let own = acting.entry(equations.term(term).body).or_default();
            if keeps { own.keeping.push(term) } else { own.given.push(term) }
        }
        let changed = equations.changes_by(&mode.changes).collect();
        Self {
            equations,
            mode,
            names: equations.names(),
            algebra,
            values: FastMap::default(),
            acting,
            islands: Islands::of(equations, mode),
            changed,
        }
    }

    /// What the algebra has become.
    pub(crate) fn into_algebra(self) -> A {
        self.algebra
    }

    /// The value of a formula of any symbols.
    pub(super) fn formula(&mut self, formula: &Expr) -> A::Value {
        if let tumble_expr::Node::Symbol(symbol) = formula.node() {
            return match self.names.find(symbol) {
                Some(name) => self.value(name),
                None => self.algebra.leaf(symbol),
            };
        }
        self.formulas(std::slice::from_ref(formula)).remove(0)
    }

    /// The values of some formulas, which may have much in common: that is prepared once.
    pub(crate) fn formulas(&mut self, formulas: &[Expr]) -> Vec<A::Value> {
        let piece = self.equations.written_piece(formulas);
        self.exports(&piece)
    }

    /// The values of a part.
    pub(super) fn part(&mut self, part: Part) -> Vec<A::Value> {
        let piece = self.equations.piece(part);
        self.exports(&piece)
    }

    pub(super) fn exports(&mut self, piece: &Piece) -> Vec<A::Value> {
        self.exports_with(piece, |_, _| None)
    }

    /// The same where some imports have other values.
    pub(super) fn exports_with(
        &mut self,
        piece: &Piece,
        other: impl Fn(Name, Meaning) -> Option<A::Value>,
    ) -> Vec<A::Value> {
        let names = Arc::clone(&self.names);
        let mut imports = Vec::with_capacity(piece.imports().len());
        for import in piece.imports() {
            imports.push(match import.name {
                None => self.algebra.leaf(&import.symbol),
                Some(name) => other(name, names.get(name).1).unwrap_or_else(|| self.value(name)),
            });
        }
        self.algebra.link(piece, &imports)
    }

    /// What a symbol stands for.
    pub(crate) fn value(&mut self, name: Name) -> A::Value {
        if let Some(known) = self.values.get(&name) {
            return known.clone();
        }
        let names = Arc::clone(&self.names);
        let (symbol, meaning) = names.get(name);
        let leaf = self.algebra.leaf(symbol);
        // What is asked for while it is being found has no value: whoever needs it is told that.
        self.values.insert(name, leaf.clone());
        let found = match meaning {
            Meaning::Leaf => leaf,
            Meaning::Parameter => self.parameter(symbol).unwrap_or(leaf),
            Meaning::Place { body, which } => match self.equations.is_pivoted(body) {
                true => self.part(Part::Place(body)).swap_remove(which),
                false => leaf,
            },
            Meaning::Acceleration { body, which } if self.mode.has(body) => self.acceleration(body, which),
            Meaning::Total { body, which } => self.total(body)[which].clone(),
            Meaning::Reaction { body, which } if self.mode.has(body) => {
                if self.islands.unknowns.contains(&name) {
                    self.solve_about(body);
                    return self.values[&name].clone();
                }
                self.part(Part::Reaction(body)).swap_remove(which)
            }
            Meaning::Multiplier { joint, row } => self.multiplier(joint, row).unwrap_or(leaf),
            Meaning::Normal { pair } => self.normal(pair).unwrap_or(leaf),
            Meaning::Friction { pair } => self.friction(pair).unwrap_or(leaf),
            Meaning::Sign { brake } => self.sign(brake),
            Meaning::Brake { brake } => self.braking(brake).unwrap_or(leaf),
            Meaning::Rate { index } => self.rate_of_algebraic(index),
            Meaning::Acceleration { .. } | Meaning::Reaction { .. } => leaf,
        };
        self.values.insert(name, found.clone());
        found
    }

    /// Says what a symbol stands for.
    pub(super) fn settle(&mut self, name: Name, value: A::Value) {
        self.values.insert(name, value);
    }

    /// What a parameter has been changed to, in parameters as they were at the start.
    fn parameter(&mut self, symbol: &Symbol) -> Option<A::Value> {
        let formula = self.changed.get(symbol)?;
        let piece = self.equations.written_piece(std::slice::from_ref(formula));
        let imports: Vec<_> = piece.imports().map(|import| self.algebra.leaf(&import.symbol)).collect();
        Some(self.algebra.link(&piece, &imports).remove(0))
    }

    /// Of the centre of a body along x and y, and of its angle.
    fn acceleration(&mut self, body: usize, which: usize) -> A::Value {
        let names = self.names.of_body(body).accelerations;
        if which == 2 && self.islands.is_light(body) {
            self.solve_about(body);
            return self.values[&names[2]].clone();
        }
        let found = self.part(Part::Acceleration(body));
        for (name, value) in names.into_iter().zip(&found) {
            if !(name == names[2] && self.islands.is_light(body)) {
                self.values.insert(name, value.clone());
            }
        }
        found[which].clone()
    }

    /// What all terms on a body do.
    fn total(&mut self, body: usize) -> [A::Value; 3] {
        let mut total = self.given_total(body);
        for term in self.acting.get(&body).map(|acting| acting.keeping.clone()).unwrap_or_default() {
            total = Some(self.with(total, term));
        }
        self.or_nothing(total)
    }

    /// What the terms do that are not there to keep rows; of loads that read forces, what they do without them.
    pub(super) fn given(&mut self, body: usize) -> [A::Value; 3] {
        let given = self.acting.get(&body).map(|acting| acting.given.clone()).unwrap_or_default();
        let total = given.into_iter().fold(None, |total, term| {
            let own = self.without_feedback(term);
            Some(self.plus(total, own))
        });
        self.or_nothing(total)
    }

    fn given_total(&mut self, body: usize) -> Option<[A::Value; 3]> {
        let given = self.acting.get(&body).map(|acting| acting.given.clone()).unwrap_or_default();
        given.into_iter().fold(None, |total, term| Some(self.with(total, term)))
    }

    fn with(&mut self, total: Option<[A::Value; 3]>, term: TermOf) -> [A::Value; 3] {
        let own = self.part(Part::Term(term));
        self.plus(total, own)
    }

    fn plus(&mut self, total: Option<[A::Value; 3]>, own: Vec<A::Value>) -> [A::Value; 3] {
        let mut own = own.into_iter();
        let mut next = || own.next().expect("a force and a torque");
        match total {
            None => [next(), next(), next()],
            Some(total) => total.map(|sum| self.algebra.binary(Binary::Add, sum, next())),
        }
    }

    /// All terms on a body.
    pub(super) fn terms_on(&self, body: usize) -> Vec<TermOf> {
        let own = self.acting.get(&body);
        own.map(|acting| [&acting.given[..], &acting.keeping].concat()).unwrap_or_default()
    }

    fn or_nothing(&mut self, total: Option<[A::Value; 3]>) -> [A::Value; 3] {
        total.unwrap_or_else(|| [(); 3].map(|()| self.algebra.zero()))
    }
}
