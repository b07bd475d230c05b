//! Numbers that only a run knows, put into formulas in the place of the symbols that stand for them.

use tumble_expr::{Expr, Substitution, Symbol, Unit};

/// A number that only a run knows, in SI units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Known {
    pub(crate) value: f64,
    /// What it may be off by; `None` where nothing is known of that.
    pub(crate) error: Option<f64>,
    /// What rounding alone may have done to it.
    pub(crate) blur: f64,
}

/// Such numbers with the symbols that stand for them.
#[derive(Default)]
pub(crate) struct AllKnown(pub(crate) Vec<(Symbol, Known)>);

impl AllKnown {
    /// Whether all errors are known.
    pub(crate) fn is_sure(&self) -> bool {
        self.0.iter().all(|(_, known)| known.error.is_some())
    }

    /// A formula with the numbers that were found.
    pub(crate) fn put_into(&self, formula: &Expr) -> Expr {
        self.with(formula, |_| 0.0)
    }

    /// For each number, the formula with that one off by its error.
    pub(crate) fn variants(&self, formula: &Expr) -> Vec<Expr> {
        self.each(formula, |known| known.error.unwrap_or(0.0))
    }

    /// For each number, the formula with that one off by what rounding alone may have done to it.
    pub(crate) fn blurred(&self, formula: &Expr) -> Vec<Expr> {
        self.each(formula, |known| known.blur)
    }

    fn each(&self, formula: &Expr, by: impl Fn(&Known) -> f64) -> Vec<Expr> {
        let off = |index: usize| {
            self.with(formula, |other| if other == index { by(&self.0[index].1) } else { 0.0 })
        };
        (0..self.0.len()).map(off).collect()
    }

    fn with(&self, formula: &Expr, off: impl Fn(usize) -> f64) -> Expr {
        let mut found = Substitution::default();
        for (index, (symbol, known)) in self.0.iter().enumerate() {
            found.insert(symbol.clone(), Expr::from(known.value + off(index)) * Unit(symbol.dimension));
        }
        found.apply(formula)
    }
}
