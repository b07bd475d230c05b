//! A step asks for no memory but for what stays of it: the numbers of its piece.

use std::sync::Arc;

use allocation_counter::measure;
use tumble_expr::{Dimension, Expr, Rounding, Symbol, Unary};
use tumble_ode::{
    Accuracy, Crossing, Flow, Hybrid, InitialState, Jump, Program, Reason, ScaleGroup, StateVariable, Work,
    solve,
};

/// Allocations that stay in the motion: the coefficients of a piece are one piece of memory, which its owner may keep alone.
const KEPT_A_STEP: u64 = 1;
/// The list of pieces is moved whenever it has doubled: once from 20 s to 40 s.
const DOUBLINGS: u64 = 1;

/// A rod in gusts across it: `u = w cos(theta) - L omega`, torque `L D |u| u - m g (L/2) sin(theta)`.
struct WindPendulum(Arc<Program>);

const INPUTS: [(&str, f64); 6] = [("m", 1.0), ("L", 1.0), ("D", 0.03), ("g", 9.81), ("w1", 20.0), ("T", 2.0)];

fn leaf(name: &str) -> Expr {
    Expr::symbol(name, Dimension::NONE)
}

fn symbol(name: &str) -> Symbol {
    Symbol::new(name, Dimension::NONE)
}

impl WindPendulum {
    /// The wind comes and goes by this function of a cosine, from -1 to 1.
    fn new(gusts: impl Fn(Expr) -> Expr) -> Self {
        let gust = gusts((2 * Expr::pi() * leaf("t") / leaf("T")).cos());
        let program = Program::new(&Self::equations(leaf("w1") / 2 * (1 + gust)));
        Self(Arc::new(program.expect("pure numbers")))
    }

    fn equations(wind: Expr) -> Flow {
        let u = wind * leaf("theta").cos() - leaf("L") * leaf("omega");
        let weight = leaf("m") * leaf("g") * leaf("L") / 2 * leaf("theta").sin();
        let torque = leaf("L") * leaf("D") * u.clone().abs() * u - weight;
        let rates = [("theta", leaf("omega")), ("omega", torque / (leaf("m") * leaf("L").powi(2) / 3))];
        let states = rates.into_iter().enumerate();
        Flow {
            states: states
                .map(|(group, (name, rate))| StateVariable {
                    symbol: symbol(name),
                    rate,
                    group,
                    per_parameter: false,
                })
                .collect(),
            time: symbol("t"),
            inputs: INPUTS.map(|(name, _)| symbol(name)).to_vec(),
            rounding: Rounding::NEAREST,
            groups: ["angle", "rate"]
                .map(|name| ScaleGroup { name: name.into(), floor: Expr::one(), per_run: false })
                .to_vec(),
            schedule: vec![],
            guards: vec![],
            lazy_guards: vec![],
            invariants: vec![],
            time_transformation: None,
        }
    }

    /// Allocations of a run of that length, s, and what it did.
    fn cost(&self, until: f64, rounding: Rounding) -> (u64, Work) {
        let start = InitialState {
            time: 0.0,
            mode: (),
            states: vec![0.0; 2],
            compensation: vec![0.0; 2],
            inputs: INPUTS.map(|(_, value)| value).to_vec(),
            causes: vec![],
            rounding,
            is_proved: true,
            stride: 1.0,
        };
        let accuracy = Accuracy::new(1e-9).expect("allowed");
        let mut work = Work::default();
        let counted = measure(|| work = solve(self, start, until, accuracy).expect("smooth").work);
        (counted.count_total, work)
    }
}

impl Hybrid for WindPendulum {
    type Mode = ();
    type Record = ();

    fn flow(&self, (): &()) -> Result<Flow, Reason> {
        unreachable!("it is compiled")
    }

    fn program(&self, (): &()) -> Result<Arc<Program>, Reason> {
        Ok(Arc::clone(&self.0))
    }

    fn jump(&self, at: &Crossing<'_, ()>) -> Result<Jump<()>, Reason> {
        Ok(Jump::to((), at.states.to_vec()))
    }
}

/// Finds the work of the later half of a run, which is to need no memory but for what stays. What a run needs once cancels in the
/// difference of two runs.
fn later_half(system: &WindPendulum, rounding: Rounding) -> Work {
    let [(short, first), (long, all)] = [20.0, 40.0].map(|until| system.cost(until, rounding));
    let steps = all.steps - first.steps;
    assert_eq!(long - short, KEPT_A_STEP * steps + DOUBLINGS, "{steps} steps, {all:?} after {first:?}");
    Work {
        steps,
        flips: all.flips - first.flips,
        enclosures: all.enclosures - first.enclosures,
        ..Work::default()
    }
}

#[test]
fn a_smooth_step_needs_no_memory_but_that_of_its_piece() {
    let system = WindPendulum::new(|cosine| cosine);
    for rounding in [Rounding::NEAREST, Rounding::perturbed(1)] {
        let work = later_half(&system, rounding);
        assert!(work.steps > 100 && work.flips > 0 && work.enclosures == 0, "{work:?}");
    }
}

/// Where gusts are steep, steps are looked at by intervals.
#[test]
fn nor_do_enclosures() {
    let system = WindPendulum::new(|cosine| Expr::unary(Unary::Tanh, 4 * cosine));
    for rounding in [Rounding::NEAREST, Rounding::perturbed(1)] {
        let work = later_half(&system, rounding);
        assert!(work.steps > 100 && work.flips > 0 && work.enclosures > 100, "{work:?}");
    }
}
