//! What is known of lazily evaluated guards by their formulas.

use std::collections::{HashMap, HashSet};
use std::sync::{Arc, OnceLock};

use tumble_expr::{CompileError, Expr, Layout, Rounding, Symbol, Tape};

use crate::hybrid::{Direction, LazyGuard};

/// What is known of a lazily evaluated guard by its formula.
#[derive(Debug)]
pub(crate) struct WatchPlan {
    formula: Expr,
    /// With the states and inputs that it depends on, and numbers to the nearest.
    layout: Layout,
    /// Index of each of those states and inputs among all.
    pub(super) states: Vec<usize>,
    pub(super) inputs: Vec<usize>,
    /// The states that it has a bound for its change by.
    pub(super) slopes: Option<Vec<usize>>,
    pub(super) group: usize,
    pub(super) direction: Direction,
    tape: OnceLock<Arc<Tape>>,
}

impl WatchPlan {
    pub(crate) fn of_all(lazy_guards: &[LazyGuard], layout: &Layout) -> Vec<Self> {
        let places = Places::of(layout);
        lazy_guards.iter().map(|lazy_guard| Self::of(lazy_guard, layout, &places)).collect()
    }

    fn of(lazy_guard: &LazyGuard, layout: &Layout, places: &Places) -> Self {
        let used = lazy_guard.guard.formula.symbols();
        let (states, inputs) = (places.states(&used), places.inputs(&used));
        let pick = |symbols: &[Symbol], which: &[usize]| which.iter().map(|i| symbols[*i].clone()).collect();
        let slopes = lazy_guard.slopes.as_ref();
        Self {
            formula: lazy_guard.guard.formula.clone(),
            layout: Layout {
                states: pick(&layout.states, &states),
                inputs: pick(&layout.inputs, &inputs),
                ..layout.clone()
            },
            states,
            inputs,
            slopes: slopes.map(|slopes| slopes.iter().map(|(state, _)| *state).collect()),
            group: lazy_guard.group,
            direction: lazy_guard.guard.direction,
            tape: OnceLock::new(),
        }
    }

    /// Built when it is first asked for.
    fn tape(&self) -> Result<Arc<Tape>, CompileError> {
        if let Some(known) = self.tape.get() {
            return Ok(Arc::clone(known));
        }
        let tape = Arc::new(Tape::compile(&self.layout, std::slice::from_ref(&self.formula))?);
        Ok(Arc::clone(self.tape.get_or_init(|| tape)))
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
        let nearest = self.plan.tape()?;
        Ok(Arc::clone(self.tape.get_or_init(|| match self.rounding.is_nearest() {
            true => nearest,
            false => Arc::new(nearest.rounded(self.rounding)),
        })))
    }
}

/// Where each symbol stands in a layout.
struct Places {
    states: HashMap<Symbol, usize>,
    inputs: HashMap<Symbol, usize>,
}

impl Places {
    fn of(layout: &Layout) -> Self {
        let places = |symbols: &[Symbol]| symbols.iter().cloned().zip(0..).collect();
        Self { states: places(&layout.states), inputs: places(&layout.inputs) }
    }

    /// Indices of the states among these symbols, in order.
    fn states(&self, used: &HashSet<Symbol>) -> Vec<usize> {
        in_order(&self.states, used)
    }

    fn inputs(&self, used: &HashSet<Symbol>) -> Vec<usize> {
        in_order(&self.inputs, used)
    }
}

fn in_order(places: &HashMap<Symbol, usize>, used: &HashSet<Symbol>) -> Vec<usize> {
    let mut found: Vec<usize> = used.iter().filter_map(|symbol| places.get(symbol).copied()).collect();
    found.sort_unstable();
    found
}
