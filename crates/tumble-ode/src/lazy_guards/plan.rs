//! What is known of lazily evaluated guards by their formulas.

use std::collections::{HashMap, HashSet};
use std::sync::{Arc, OnceLock};

use tumble_expr::{CompileError, Expr, Layout, Rounding, Symbol, Tape};

use crate::flow::LazyGuard;
use crate::hybrid::Direction;

/// A function with the states and inputs that it depends on, compiled when it is first asked for. Flows may share it.
#[derive(Debug)]
pub struct Watched {
    /// The function, then what must not be negative for its zeros to count.
    formulas: Vec<Expr>,
    /// Numbers to the nearest.
    layout: Layout,
    tape: OnceLock<Arc<Tape>>,
}

impl Watched {
    /// A function of these states, the time and these inputs, or some of them.
    pub fn new(formula: Expr, states: &[Symbol], time: &Symbol, inputs: &[Symbol]) -> Arc<Self> {
        Self::where_positive(vec![formula], states, time, inputs)
    }

    /// A function, and others that must not be negative for its zeros to count.
    pub fn where_positive(
        formulas: Vec<Expr>,
        states: &[Symbol],
        time: &Symbol,
        inputs: &[Symbol],
    ) -> Arc<Self> {
        let used: HashSet<Symbol> = formulas.iter().flat_map(Expr::symbols).collect();
        let own =
            |symbols: &[Symbol]| symbols.iter().filter(|symbol| used.contains(*symbol)).cloned().collect();
        let layout = Layout::new(own(states), time.clone(), own(inputs));
        Arc::new(Self { formulas, layout, tape: OnceLock::new() })
    }

    /// The function.
    pub fn formula(&self) -> &Expr {
        &self.formulas[0]
    }

    /// How many conditions its zeros have.
    pub(super) fn conditions(&self) -> usize {
        self.formulas.len() - 1
    }

    fn tape(&self) -> Result<Arc<Tape>, CompileError> {
        if let Some(known) = self.tape.get() {
            return Ok(Arc::clone(known));
        }
        let tape = Arc::new(Tape::compile(&self.layout, &self.formulas)?);
        Ok(Arc::clone(self.tape.get_or_init(|| tape)))
    }
}

/// What is known of a lazily evaluated guard by its formula.
#[derive(Debug)]
pub(crate) struct WatchPlan {
    pub(super) of: Arc<Watched>,
    /// Index of each of its states and inputs among all.
    pub(super) states: Vec<usize>,
    pub(super) inputs: Vec<usize>,
    /// The states that it has a bound for its change by.
    pub(super) slopes: Option<Vec<usize>>,
    /// Whether that holds up to a certain size only.
    pub(super) has_reach: bool,
    pub(super) group: usize,
    pub(super) direction: Direction,
}

impl WatchPlan {
    pub(crate) fn of_all<F>(
        lazy_guards: &[LazyGuard<F>],
        layout: &Layout,
    ) -> Result<Vec<Self>, CompileError> {
        if lazy_guards.is_empty() {
            return Ok(vec![]);
        }
        let [states, inputs] = [&layout.states, &layout.inputs].map(|symbols| places(symbols));
        let plan = |lazy_guard: &LazyGuard<F>| {
            let own = &lazy_guard.of.layout;
            let slopes = lazy_guard.slopes.as_ref();
            Ok(Self {
                of: Arc::clone(&lazy_guard.of),
                states: found(&states, &own.states)?,
                inputs: found(&inputs, &own.inputs)?,
                slopes: slopes.map(|slopes| slopes.iter().map(|(state, _)| *state).collect()),
                has_reach: lazy_guard.reach.is_some(),
                group: lazy_guard.group,
                direction: lazy_guard.direction,
            })
        };
        lazy_guards.iter().map(plan).collect()
    }
}

/// The tape of a lazily evaluated guard, compiled when it is first near zero.
#[derive(Debug)]
pub(crate) struct WatchTape {
    pub(super) plan: Arc<WatchPlan>,
    rounding: Rounding,
    tape: OnceLock<Arc<Tape>>,
}

impl WatchTape {
    pub(crate) fn new(plan: WatchPlan) -> Self {
        Self { plan: Arc::new(plan), rounding: Rounding::NEAREST, tape: OnceLock::new() }
    }

    pub(crate) fn rounded(&self, rounding: Rounding) -> Self {
        Self { plan: Arc::clone(&self.plan), rounding, tape: OnceLock::new() }
    }

    pub(crate) fn tape(&self) -> Result<Arc<Tape>, CompileError> {
        if let Some(known) = self.tape.get() {
            return Ok(Arc::clone(known));
        }
        let nearest = self.plan.of.tape()?;
        Ok(Arc::clone(self.tape.get_or_init(|| match self.rounding.is_nearest() {
            true => nearest,
            false => Arc::new(nearest.rounded(self.rounding)),
        })))
    }
}

/// Where each symbol stands among these.
fn places(symbols: &[Symbol]) -> HashMap<&Symbol, usize> {
    symbols.iter().zip(0..).collect()
}

fn found(places: &HashMap<&Symbol, usize>, symbols: &[Symbol]) -> Result<Vec<usize>, CompileError> {
    let place = |symbol: &Symbol| places.get(symbol).copied();
    let unknown = |symbol: &Symbol| CompileError::UnknownSymbol(symbol.name.to_string());
    symbols.iter().map(|symbol| place(symbol).ok_or_else(|| unknown(symbol))).collect()
}
