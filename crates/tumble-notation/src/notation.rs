//! What a reader is shown of formulas: which names, which parts explained below.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use tumble_expr::{Expr, Formulas, Symbol};

use crate::algebra::{Algebra, Id, Imported, Leaf};
use crate::known::{self, Key};
use crate::layout::Math;
use crate::print::Printer;
use crate::spelling::shown_leaves;
use crate::{MathError, order};

/// The name of the time, by whose powers sums are ordered.
const TIME: &str = "t";

/// How formulas are shown.
#[derive(Clone, Debug)]
pub struct Notation {
    symbols: BTreeMap<String, String>,
    positive: BTreeSet<String>,
    definitions: Vec<(String, Expr)>,
    automatic: bool,
}

impl Default for Notation {
    fn default() -> Self {
        Self { symbols: BTreeMap::new(), positive: BTreeSet::new(), definitions: vec![], automatic: true }
    }
}

/// The left side of an equation: a symbol, and what both sides are multiplied by.
#[derive(Clone, Debug)]
pub struct Left {
    /// The symbol, such as a derivative.
    pub symbol: Math,
    /// A mass or moment of inertia that stands before it; the right side is multiplied by it.
    pub factor: Option<Expr>,
}

/// One formula or equation.
#[derive(Clone, Debug)]
pub struct Line {
    /// Its left side; a formula has none.
    pub left: Option<Math>,
    /// Its right side.
    pub right: Math,
    /// The right side as a formula, with every definition written out: what is shown, for evaluation.
    pub formula: Expr,
}

/// Equations, and below them what the names in them stand for.
#[derive(Clone, Debug)]
pub struct Printed {
    /// The equations in the order in which they were given.
    pub lines: Vec<Line>,
    /// Definitions in the order in which a reader meets their names.
    pub definitions: Vec<Line>,
}

impl Left {
    /// A symbol alone.
    pub fn symbol(symbol: Math) -> Self {
        Self { symbol, factor: None }
    }

    /// `factor symbol`, such as `M A`.
    pub fn times(factor: &Expr, symbol: Math) -> Self {
        Self { symbol, factor: Some(factor.clone()) }
    }
}

impl Line {
    /// The whole line; what is zero stands on the left: `A_y = 0`.
    pub fn math(&self) -> Math {
        match &self.left {
            Some(Math::Number(zero)) if zero == "0" => {
                Math::equation(self.right.clone(), Math::Number(zero.clone()))
            }
            Some(left) => Math::equation(left.clone(), self.right.clone()),
            None => self.right.clone(),
        }
    }
}

impl Printed {
    /// Everything as text, a line each.
    pub fn text(&self) -> String {
        let lines = self.lines.iter().map(|line| crate::text(&line.math()));
        let wheres = self.definitions.iter().map(|line| format!("where {}", crate::text(&line.math())));
        lines.chain(wheres).collect::<Vec<_>>().join("\n")
    }
}

impl Notation {
    /// No names, nothing known to be positive.
    pub fn new() -> Self {
        Self::default()
    }

    /// Shows a symbol under another name: `theta` for `rod.angle`.
    #[must_use]
    pub fn name(mut self, symbol: impl Into<String>, shown: impl Into<String>) -> Self {
        self.symbols.insert(symbol.into(), shown.into());
        self
    }

    /// Says that symbols of these names are never negative, as masses and lengths are.
    #[must_use]
    pub fn positive<Name: Into<String>>(mut self, names: impl IntoIterator<Item = Name>) -> Self {
        self.positive.extend(names.into_iter().map(Into::into));
        self
    }

    /// Gives a formula a name that stands for it wherever it occurs. A name between bars, such as `|u|`, is a length.
    #[must_use]
    pub fn define(mut self, name: impl Into<String>, formula: &Expr) -> Self {
        self.definitions.push((name.into(), formula.clone()));
        self
    }

    /// Without names of its own making for long parts that repeat. Parts too long to work with still get one.
    #[must_use]
    pub fn without_automatic_names(mut self) -> Self {
        self.automatic = false;
        self
    }

    /// What a symbol of that name shows.
    pub fn symbol(&self, name: &str) -> Math {
        Math::symbol(self.symbols.get(name).map_or(name, String::as_str))
    }

    /// One formula.
    pub fn formula(&self, formula: &Expr) -> Result<Printed, MathError> {
        self.show(&[(None, formula.clone())])
    }

    /// One equation.
    pub fn equation(&self, left: Left, right: &Expr) -> Result<Printed, MathError> {
        self.show(&[(Some(left), right.clone())])
    }

    /// Equations that share their definitions.
    pub fn equations(&self, equations: &[(Left, Expr)]) -> Result<Printed, MathError> {
        let sides: Vec<_> =
            equations.iter().map(|(left, right)| (Some(left.clone()), right.clone())).collect();
        self.show(&sides)
    }

    fn show(&self, sides: &[(Option<Left>, Expr)]) -> Result<Printed, MathError> {
        known::or_else(self.key(sides), || self.worked_out(sides))
    }

    fn key(&self, sides: &[(Option<Left>, Expr)]) -> Key {
        let factors = sides.iter().filter_map(|(left, _)| left.as_ref()?.factor.as_ref());
        let rights = sides.iter().map(|(_, right)| right);
        let definitions = self.definitions.iter().map(|(_, formula)| formula);
        let formulas: Vec<Expr> = definitions.chain(rights).chain(factors).cloned().collect();
        let left = |left: &Left| (left.symbol.clone(), left.factor.is_some());
        Key {
            symbols: self.symbols.clone(),
            positive: self.positive.clone(),
            automatic: self.automatic,
            names: self.definitions.iter().map(|(name, formula)| (name.clone(), size(formula))).collect(),
            lefts: sides.iter().map(|(side, _)| side.as_ref().map(left)).collect(),
            formulas: Formulas::new(&formulas),
        }
    }

    fn worked_out(&self, sides: &[(Option<Left>, Expr)]) -> Result<Printed, MathError> {
        let mut algebra = Algebra::default();
        let mut imported = Imported::default();
        let factors = sides.iter().filter_map(|(left, _)| left.as_ref()?.factor.as_ref());
        let all: Vec<&Expr> = sides.iter().map(|(_, right)| right).chain(factors).collect();
        self.leaves(&mut algebra, &all);
        for (name, formula) in self.small_first() {
            let body = algebra.import(&mut imported, formula)?;
            let dimension = formula.dimension()?;
            algebra.define(Some(name.clone()), body, dimension);
            imported.forget(formula);
        }
        let mut roots = vec![];
        for (left, right) in sides {
            let mut id = algebra.import(&mut imported, right)?;
            if let Some(factor) = left.as_ref().and_then(|left| left.factor.as_ref()) {
                let factor = algebra.import(&mut imported, factor)?;
                id = algebra.multiplied(id, factor);
                roots.push(factor);
            }
            roots.push(id);
        }
        algebra.check()?;
        if self.automatic {
            algebra.pull_out(&mut roots);
        }
        Ok(self.printed(&mut algebra, sides, &roots))
    }

    /// Definitions in an order in which those that others use come first.
    fn small_first(&self) -> Vec<&(String, Expr)> {
        let mut all: Vec<&(String, Expr)> = self.definitions.iter().collect();
        all.sort_by_cached_key(|(_, formula)| size(formula));
        all
    }

    /// Adds all symbols in the order of people, which later decides between equally good forms.
    fn leaves(&self, algebra: &mut Algebra, formulas: &[&Expr]) {
        let mut symbols: BTreeSet<(u8, (String, String))> = BTreeSet::new();
        let mut by_name: HashMap<String, Symbol> = HashMap::new();
        let definitions = self.definitions.iter().map(|(_, formula)| formula);
        for formula in formulas.iter().copied().chain(definitions) {
            for symbol in formula.symbols() {
                symbols.insert((order::rank(symbol.dimension), order::alphabetical(&symbol.name)));
                by_name.insert(order::alphabetical(&symbol.name).1, symbol);
            }
        }
        for (_, (_, key)) in symbols {
            let symbol = &by_name[&key];
            let name = symbol.name.to_string();
            let positive = self.positive.contains(&name);
            algebra.leaf(Leaf { name, dimension: symbol.dimension, positive, definition: None });
        }
    }

    fn printed(&self, algebra: &mut Algebra, sides: &[(Option<Left>, Expr)], roots: &[Id]) -> Printed {
        let used = algebra.used(roots);
        let automatic = self.automatic_names(algebra, &used);
        let bodies: Vec<Id> = used.iter().map(|index| algebra.definitions[*index].body).collect();
        let formulas: Vec<Expr> = roots.iter().chain(&bodies).map(|id| algebra.export(*id)).collect();
        let time = algebra.symbols.iter().position(|leaf| leaf.name == TIME);
        let time = time.map(|index| algebra.leaf(algebra.symbols[index].clone()));
        let shown = shown_leaves(algebra, &self.symbols, &automatic);
        let printer = Printer::new(algebra, shown, time);
        let mut next = roots.iter().zip(&formulas);
        let mut lines = vec![];
        for (left, _) in sides {
            let mut take = || next.next().expect("one root for each side and each factor");
            let left = left.as_ref().map(|left| match left.factor {
                Some(_) => {
                    let factor = printer.print(*take().0);
                    multiplied(factor, left.symbol.clone())
                }
                None => left.symbol.clone(),
            });
            let (id, formula) = take();
            lines.push(Line { left, right: printer.print(*id), formula: formula.clone() });
        }
        let definitions = used.iter().zip(bodies.iter().zip(&formulas[roots.len()..]));
        let definitions = definitions.map(|(index, (body, formula))| Line {
            left: Some(printer.print(printer.algebra.definitions[*index].symbol)),
            right: printer.print(*body),
            formula: formula.clone(),
        });
        // The length of what has a name needs no words: |u| is |u|.
        let definitions = definitions.filter(|line| line.left.as_ref() != Some(&line.right));
        Printed { lines, definitions: definitions.collect() }
    }

    /// Names that no symbol and no other definition has: u1, u2, ...
    fn automatic_names(&self, algebra: &Algebra, used: &[usize]) -> HashMap<usize, String> {
        let given = algebra.definitions.iter().filter_map(|definition| definition.name.clone());
        let shown = algebra.symbols.iter().map(|leaf| self.symbols.get(&leaf.name).unwrap_or(&leaf.name));
        let taken: HashSet<String> = given.chain(shown.cloned()).collect();
        let mut free = (1..).map(|number: u32| format!("u{number}")).filter(|name| !taken.contains(name));
        let unnamed = used.iter().filter(|index| algebra.definitions[**index].name.is_none());
        unnamed.filter_map(|index| Some((*index, free.next()?))).collect()
    }
}

/// A factor before a symbol: sums and signs stand in brackets.
fn multiplied(factor: Math, symbol: Math) -> Math {
    match factor {
        Math::Product(mut factors) => {
            factors.push(symbol);
            Math::Product(factors)
        }
        Math::Number(one) if one == "1" => symbol,
        other => Math::Product(vec![other.into_term(), symbol]),
    }
}

/// How many parts a formula has, those that are shared counted once.
fn size(formula: &Expr) -> usize {
    let (mut seen, mut pending) = (HashSet::new(), vec![formula]);
    while let Some(next) = pending.pop() {
        if seen.insert(std::ptr::from_ref(next.node())) {
            pending.extend(next.children());
        }
    }
    seen.len()
}
