//! Parameters: named quantities that may depend on each other, and their values in one run.

use std::sync::Arc;

use tumble_expr::{Branches, CompileError, Expr, Jets, Layout, Node, Rounding, Symbol, Tape};

use crate::error::ModelError;
use crate::kinematics::time;

/// Parameters in an order in which each depends on earlier ones only.
#[derive(Clone, Debug, Default)]
pub struct Parameters {
    list: Vec<(Symbol, Expr)>,
    rounding: Rounding,
}

impl Parameters {
    /// The same with numbers rounded in another way.
    pub fn rounded(&self, rounding: Rounding) -> Self {
        Self { rounding, ..self.clone() }
    }

    /// How numbers in them are rounded.
    pub(crate) fn rounding(&self) -> Rounding {
        self.rounding
    }

    /// Adds a parameter, or gives the one of that name another formula.
    ///
    /// The formula may use the parameters before it. Returns the parameter as a formula.
    pub fn set(&mut self, name: &str, formula: Expr) -> Result<Expr, ModelError> {
        let dimension = formula
            .dimension()
            .map_err(|mistake| ModelError::Type { what: format!("parameter `{name}`"), mistake })?;
        let symbol = Symbol::new(name, dimension);
        match self.list.iter_mut().find(|(known, _)| *known.name == *name) {
            Some(entry) => *entry = (symbol.clone(), formula),
            None => self.list.push((symbol.clone(), formula)),
        }
        Ok(symbol.into())
    }

    /// Symbols in order.
    pub fn symbols(&self) -> Vec<Symbol> {
        self.list.iter().map(|(symbol, _)| symbol.clone()).collect()
    }

    /// Formulas in order.
    pub fn formulas(&self) -> impl Iterator<Item = (&Symbol, &Expr)> {
        self.list.iter().map(|(symbol, formula)| (symbol, formula))
    }

    /// Values in order, SI units.
    pub fn values(&self) -> Result<Vec<f64>, ModelError> {
        let mut values: Vec<f64> = vec![];
        for (index, (symbol, formula)) in self.list.iter().enumerate() {
            let what = format!("parameter `{}`", symbol.name);
            let known: Vec<Symbol> = self.list[..index].iter().map(|(symbol, _)| symbol.clone()).collect();
            let value = evaluate(&known, &values, std::slice::from_ref(formula), self.rounding)
                .map_err(|mistake| ModelError::Compile { what: what.clone(), mistake })?[0];
            if !value.is_finite() {
                return Err(ModelError::NotFinite { what, value });
            }
            values.push(if is_computed(formula) {
                self.rounding.computed(value, index as u64)
            } else {
                value
            });
        }
        Ok(values)
    }

    /// Values of formulas of the parameters, SI units.
    pub fn evaluate(&self, formulas: &[Expr]) -> Result<Vec<f64>, ModelError> {
        let values = self.values()?;
        evaluate(&self.symbols(), &values, formulas, self.rounding)
            .map_err(|mistake| ModelError::Compile { what: "a formula of the parameters".into(), mistake })
    }
}

/// Whether a value has a rounding error of its own, beside those of the numbers in its formula.
fn is_computed(formula: &Expr) -> bool {
    !matches!(formula.node(), Node::Number(_) | Node::Symbol(_) | Node::Pi)
}

fn evaluate(
    symbols: &[Symbol],
    values: &[f64],
    formulas: &[Expr],
    rounding: Rounding,
) -> Result<Vec<f64>, CompileError> {
    let layout = Layout { rounding, ..Layout::new(vec![], time_symbol(), symbols.to_vec()) };
    let mut tape = Jets::new(Arc::new(Tape::compile(&layout, formulas)?), 0, values);
    // A formula of the parameters has no time: whatever uses it shows as not a number.
    tape.start(f64::NAN, &[], Branches::Free);
    Ok((0..formulas.len()).map(|index| tape.value_of(index)).collect())
}

pub(crate) fn time_symbol() -> Symbol {
    match time().node() {
        tumble_expr::Node::Symbol(symbol) => symbol.clone(),
        _ => unreachable!("the time is a symbol"),
    }
}
