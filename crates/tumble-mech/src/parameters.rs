//! Parameters: named quantities that may depend on each other, and their values in one run.

use std::collections::{BTreeSet, HashMap};
use std::convert::Infallible;
use std::sync::{Arc, OnceLock};

use tumble_expr::{
    Binary, Branches, CompileError, Expr, Formulas, Jets, Kernels, LEFT_OUT, Layout, Node, Rounded, Rounding,
    Symbol, Tape, Unary, rounded_sum,
};

use crate::cache::Cache;
use crate::error::{ModelError, ModelErrors};
use crate::fixed::Fixed;
use crate::kinematics::time;

/// Parameters in an order in which each depends on earlier ones only.
#[derive(Clone, Debug, Default)]
pub struct Parameters {
    list: Vec<(Symbol, Expr)>,
    /// Where each name stands in the list.
    places: HashMap<Arc<str>, usize>,
    rounding: Rounding,
    /// What formulas run on that may hold so many of them.
    tapes: Cache<((Formulas, usize), Rounding), FixedTape>,
    /// What is fixed in each formula.
    parts: Cache<Formulas, Vec<Fixed>>,
}

/// A tape of formulas of the parameters.
#[derive(Debug)]
struct FixedTape {
    tape: Arc<Tape>,
    /// Which parameters are its inputs.
    places: Vec<usize>,
    /// The values, where there are none.
    constants: OnceLock<Vec<f64>>,
}

impl FixedTape {
    fn rounded(&self, rounding: Rounding) -> Self {
        Self::new(self.tape.rounded(rounding), self.places.clone())
    }

    fn new(tape: Tape, places: Vec<usize>) -> Self {
        Self { tape: Arc::new(tape), places, constants: OnceLock::new() }
    }
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
        // A formula of its own is nothing to those that use it.
        if self.symbol(name) != Some(&symbol) {
            (self.tapes, self.parts) = (Cache::default(), Cache::default());
        }
        match self.places.get(name) {
            Some(place) => self.list[*place] = (symbol.clone(), formula),
            None => {
                self.places.insert(Arc::clone(&symbol.name), self.list.len());
                self.list.push((symbol.clone(), formula));
            }
        }
        Ok(symbol.into())
    }

    /// Symbols in order.
    pub fn symbols(&self) -> Vec<Symbol> {
        self.list.iter().map(|(symbol, _)| symbol.clone()).collect()
    }

    /// The parameter of that name.
    pub fn symbol(&self, name: &str) -> Option<&Symbol> {
        self.places.get(name).map(|place| &self.list[*place].0)
    }

    /// Whether this is one of the parameters.
    pub fn contains(&self, symbol: &Symbol) -> bool {
        self.symbol(&symbol.name) == Some(symbol)
    }

    /// What is fixed in a formula.
    pub(crate) fn parts_of(&self, formula: &Expr) -> Arc<Vec<Fixed>> {
        let formula = std::slice::from_ref(formula);
        let found =
            self.parts.get(&Formulas::new(formula), || Ok::<_, Infallible>(self.fixed_parts(formula)));
        found.unwrap_or_else(|never| match never {})
    }

    /// Whether others have the same symbols in the same order.
    pub(crate) fn has_symbols_of(&self, others: &Self) -> bool {
        let [own, other] = [self, others].map(|parameters| parameters.list.iter().map(|(symbol, _)| symbol));
        own.eq(other)
    }

    /// Formulas in order.
    pub fn formulas(&self) -> impl Iterator<Item = (&Symbol, &Expr)> {
        self.list.iter().map(|(symbol, formula)| (symbol, formula))
    }

    /// Values in order, SI units.
    pub fn values(&self) -> Result<Vec<f64>, ModelError> {
        self.known().map(|known| known.values).map_err(ModelErrors::into_first)
    }

    /// Values of formulas of the parameters, SI units. Whoever asks more than once keeps [`Parameters::known`].
    pub fn evaluate(&self, formulas: &[Expr]) -> Result<Vec<f64>, ModelError> {
        self.known().map_err(ModelErrors::into_first)?.evaluate(formulas)
    }

    /// The parameters with their values, or every one that has none by a mistake of its own.
    pub fn known(&self) -> Result<Known<'_>, ModelErrors> {
        let mut known = Known { parameters: self, values: Vec::with_capacity(self.list.len()) };
        let mut mistakes = vec![];
        for (index, (symbol, formula)) in self.list.iter().enumerate() {
            let value = known.next(symbol, formula);
            let moved = |value: f64| known.rounded(&[value], std::slice::from_ref(formula), index)[0].0;
            let rounded = value.as_ref().ok().copied().flatten().map_or(f64::NAN, moved);
            known.values.push(rounded);
            mistakes.extend(value.err());
        }
        if mistakes.is_empty() { Ok(known) } else { Err(ModelErrors(mistakes)) }
    }
}

/// Nested deeper than this, a formula is not looked through: its parts may be shared, and as many as you like.
const DEEPEST: usize = 8;
/// Moves by less than this part of the spacing of doubles are of an error before the last operation: that one is moved by more.
const HIDDEN: f64 = 0.25;

/// Whether a formula is arithmetic with numbers alone, which is exact.
fn is_arithmetic(formula: &Expr, depth: usize) -> bool {
    match formula.node() {
        Node::Number(_) => true,
        Node::Unary(Unary::Neg, a) => depth > 0 && is_arithmetic(a, depth - 1),
        Node::Binary(Binary::Add | Binary::Sub | Binary::Mul | Binary::Div, a, b) => {
            depth > 0 && is_arithmetic(a, depth - 1) && is_arithmetic(b, depth - 1)
        }
        _ => false,
    }
}

/// Parameters with their values, for many formulas to be evaluated with.
#[derive(Clone, Debug)]
pub struct Known<'p> {
    parameters: &'p Parameters,
    /// In order; not a number where there is none.
    values: Vec<f64>,
}

impl Known<'_> {
    /// The parameters with values that were found before.
    pub(crate) fn of<'p>(parameters: &'p Parameters, values: &[f64]) -> Known<'p> {
        Known { parameters, values: values.to_vec() }
    }

    /// The parameters that are known.
    pub fn parameters(&self) -> &Parameters {
        self.parameters
    }

    /// The same after some have been set to values of formulas of the parameters as they were before.
    pub(crate) fn after(&self, settings: &[(String, Expr)]) -> Result<After<'_>, ModelError> {
        let formulas: Vec<Expr> = settings.iter().map(|(_, formula)| formula.clone()).collect();
        let values = settings.iter().zip(self.evaluate(&formulas)?);
        let set = values
            .filter_map(|((name, _), value)| Some((*self.parameters.places.get(name.as_str())?, value)));
        Ok(After { before: self, set: set.collect() })
    }

    /// Values of the parameters in order, SI units.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Values of formulas of the parameters, SI units. The work grows with the formulas, not with the parameters.
    pub fn evaluate(&self, formulas: &[Expr]) -> Result<Vec<f64>, ModelError> {
        self.evaluate_but(&HashMap::new(), formulas)
    }

    /// The same with some values replaced, by the places of their parameters.
    fn evaluate_but(&self, set: &HashMap<usize, f64>, formulas: &[Expr]) -> Result<Vec<f64>, ModelError> {
        let tape = self.tape(formulas, self.parameters.rounding);
        let tape = tape
            .map_err(|mistake| ModelError::Compile { what: "a formula of the parameters".into(), mistake })?;
        Ok(self.numbers(&tape, set))
    }

    /// Value of the next parameter; `None` where one that it uses has none.
    fn next(&self, symbol: &Symbol, formula: &Expr) -> Result<Option<f64>, ModelError> {
        let what = || format!("parameter `{}`", symbol.name);
        let tape = match self.tape(std::slice::from_ref(formula), self.parameters.rounding) {
            Ok(tape) if tape.places.iter().any(|place| self.values[*place].is_nan()) => return Ok(None),
            Err(_) if self.uses_none(formula) => return Ok(None),
            Ok(tape) => tape,
            Err(mistake) => return Err(ModelError::Compile { what: what(), mistake }),
        };
        match self.numbers(&tape, &HashMap::new())[0] {
            value if value.is_finite() => Ok(Some(value)),
            value => Err(ModelError::NotFinite { what: what(), value }),
        }
    }

    /// Whether a formula uses a parameter that has no value.
    fn uses_none(&self, formula: &Expr) -> bool {
        let used = formula.symbols();
        used.iter().filter_map(|used| self.place_of(used)).any(|place| self.values[place].is_nan())
    }

    /// Where a parameter that has been evaluated stands.
    fn place_of(&self, symbol: &Symbol) -> Option<usize> {
        let place = *self.parameters.places.get(&symbol.name)?;
        let is_same = self.parameters.list[place].0 == *symbol;
        (is_same && place < self.values.len()).then_some(place)
    }

    /// Values with the rounding errors that computing them from numbers and parameters makes, and what rounding leaves out of these; the
    /// first has that index.
    ///
    /// Beside those that numbers and parameters have: a lone number has one already, and the two might take each other away.
    pub(crate) fn rounded(&self, values: &[f64], formulas: &[Expr], first: usize) -> Vec<(f64, f64)> {
        let rounding = self.parameters.rounding;
        if rounding.is_nearest() {
            return values.iter().map(|value| (*value, 0.0)).collect();
        }
        // Formulas that have values compile.
        let nearest = self.tape(formulas, Rounding::NEAREST).map(|tape| self.numbers(&tape, &HashMap::new()));
        let found = self.tape(formulas, rounding).map(|tape| self.run::<Rounded>(&tape, &HashMap::new()));
        let moved = |(index, (value, formula)): (usize, (&f64, &Expr))| {
            if matches!(formula.node(), Node::Symbol(_) | Node::Pi) {
                return (*value, 0.0);
            }
            if is_arithmetic(formula, DEEPEST) {
                // Moved on the tape already; what that left out is found from the number itself.
                let number = nearest.as_ref().map_or(*value, |nearest| nearest[index]);
                return if number == *value { (*value, 0.0) } else { rounding.moved(number) };
            }
            let error = found.as_ref().map_or(0.0, |found| found[index].noise());
            let error = if error.is_finite() { LEFT_OUT * error } else { 0.0 };
            moved_visibly(*value, rounding.computed(*value, error, (first + index) as u64))
        };
        values.iter().zip(formulas).enumerate().map(moved).collect()
    }

    /// Values of the formulas of a tape.
    fn numbers(&self, tape: &FixedTape, set: &HashMap<usize, f64>) -> Vec<f64> {
        match tape.places.is_empty() {
            true => tape.constants.get_or_init(|| self.run(tape, set)).clone(),
            false => self.run(tape, set),
        }
    }

    /// The same in any numbers.
    fn run<S: Kernels>(
        &self,
        FixedTape { tape, places, .. }: &FixedTape,
        set: &HashMap<usize, f64>,
    ) -> Vec<S> {
        let value = |place: &usize| S::splat(set.get(place).copied().unwrap_or(self.values[*place]));
        let values: Vec<S> = places.iter().map(value).collect();
        let mut jets = Jets::new(Arc::clone(tape), 0, &values);
        // A formula of the parameters has no time: whatever uses it shows as not a number.
        jets.start(S::splat(f64::NAN), &[], Branches::Free);
        (0..tape.outputs().len()).map(|index| jets.value_of(index)).collect()
    }

    /// The tape of some formulas.
    fn tape(&self, formulas: &[Expr], rounding: Rounding) -> Result<Arc<FixedTape>, CompileError> {
        let key = (Formulas::new(formulas), self.values.len());
        self.parameters.tapes.get_rounded(key, rounding, |_| self.compile(formulas), FixedTape::rounded)
    }

    /// Only the symbols that are used become inputs, in the order of the parameters: a tape has no more leaves than its
    /// formulas need, and the same ones in every run.
    fn compile(&self, formulas: &[Expr]) -> Result<FixedTape, CompileError> {
        let list = &self.parameters.list;
        let used = Expr::symbols_of(formulas);
        let places: BTreeSet<usize> = used.iter().filter_map(|symbol| self.place_of(symbol)).collect();
        let inputs = places.iter().map(|place| list[*place].0.clone()).collect();
        let tape = Tape::compile(&Layout::new(vec![], time_symbol(), inputs), formulas)?;
        Ok(FixedTape::new(tape, places.into_iter().collect()))
    }
}

/// A value moved by so much, and what the double leaves out of that. A move that rounding would take back goes to the next double
/// all the same: forces are evaluated at the double alone.
fn moved_visibly(value: f64, by: f64) -> (f64, f64) {
    let (moved, left_out) = rounded_sum(value, by);
    let next = if by > 0.0 { value.next_up() } else { value.next_down() };
    let is_hidden = moved == value && by.abs() > HIDDEN * (next - value).abs();
    if is_hidden { (next, by - (next - value)) } else { (moved, left_out) }
}

/// Parameters after some have been set. What is not set is not copied: there may be as many events as parameters.
pub(crate) struct After<'k> {
    before: &'k Known<'k>,
    /// New values, by the places of their parameters.
    set: HashMap<usize, f64>,
}

impl After<'_> {
    /// Values of formulas of the parameters, SI units.
    pub(crate) fn evaluate(&self, formulas: &[Expr]) -> Result<Vec<f64>, ModelError> {
        self.before.evaluate_but(&self.set, formulas)
    }
}

pub(crate) fn time_symbol() -> Symbol {
    match time().node() {
        tumble_expr::Node::Symbol(symbol) => symbol.clone(),
        _ => unreachable!("the time is a symbol"),
    }
}
