//! Limits of memory, on runs that are small enough for tests.

use tumble_expr::{Dimension, Expr, Rounding, Symbol};

use super::*;
use crate::{Accuracy, Crossing, Flow, InitialState, Jump, ScaleGroup, StateVariable, Trajectory};

/// Far less than a run may hold: some thousand steps.
const SMALL: u64 = 1 << 18;

/// One number with its rate.
struct Toy(Expr);

impl Hybrid for Toy {
    type Mode = ();
    type Record = ();

    fn flow(&self, (): &()) -> Result<Flow, Reason> {
        let symbol = |name: &str| Symbol::new(name, Dimension::NONE);
        Ok(Flow {
            states: vec![StateVariable {
                symbol: symbol("x"),
                rate: self.0.clone(),
                group: 0,
                per_parameter: false,
            }],
            time: symbol("t"),
            inputs: vec![],
            rounding: Rounding::NEAREST,
            groups: vec![ScaleGroup { name: "size".into(), floor: Expr::one(), per_run: false }],
            schedule: vec![],
            guards: vec![],
            lazy_guards: vec![],
            invariants: vec![],
            time_transformation: None,
        })
    }

    fn jump(&self, at: &Crossing<'_, ()>) -> Result<Jump<()>, Reason> {
        Ok(Jump::to((), at.states.to_vec()))
    }
}

/// A square wave of period 1.
fn square_wave() -> Toy {
    Toy((2 * Expr::pi() * Expr::symbol("t", Dimension::NONE)).sin().sign())
}

fn solver(toy: &Toy, until: f64, limit: u64) -> Solver<'_, Toy> {
    let start = InitialState {
        time: 0.0,
        mode: (),
        states: vec![0.0],
        compensation: vec![0.0],
        inputs: vec![],
        causes: vec![],
        rounding: Rounding::NEAREST,
        is_proved: true,
        stride: 1.0,
    };
    let mut solver = Solver::new(toy, start, until, Accuracy::DEFAULT);
    solver.memory = Memory::of(limit);
    solver
}

fn run(toy: &Toy, until: f64, limit: u64) -> (Trajectory<()>, Option<Reason>) {
    finished(solver(toy, until, limit))
}

fn finished(mut solver: Solver<'_, Toy>) -> (Trajectory<()>, Option<Reason>) {
    let mut reason = None;
    while reason.is_none() && !solver.is_done() {
        reason = solver.advance().err().map(|refusal| refusal.reason);
    }
    (solver.finish(), reason)
}

fn held(trajectory: &Trajectory<()>) -> u64 {
    let mut memory = Memory::of(SMALL);
    trajectory.pieces.iter().for_each(|piece| memory.hold_piece(piece));
    memory.held.get().bytes
}

/// A run of some times what is allowed is refused at a quarter of it, with what it would take.
#[test]
fn what_is_foreseen_is_refused_early() {
    let (found, reason) = run(&square_wave(), 1e6, SMALL);
    let Some(Reason::WouldTakeTooMuchMemory { demands, because }) = reason else { panic!("{reason:?}") };
    let quarter = SMALL / 4;
    assert!((quarter..quarter + quarter / 50).contains(&demands.bytes), "{demands:?}");
    assert_eq!((demands.bytes, demands.limit, demands.until), (held(&found), SMALL, 1e6));
    let steps = run(&square_wave(), 100.0, u64::MAX).0.work.steps as f64 * 1e4;
    assert!((demands.steps_in_all / steps - 1.0).abs() < 0.1, "{demands:?}");
    let by_steps = demands.bytes as f64 / demands.steps as f64 * demands.steps_in_all;
    assert!((demands.bytes_in_all / by_steps - 1.0).abs() < 0.2, "{demands:?}");
    assert!(because.contains("sin"), "{because}");
}

/// A run that takes little more than is allowed goes on until it has taken it.
#[test]
fn the_limit_itself_is_kept() {
    let whole = held(&run(&square_wave(), 100.0, u64::MAX).0);
    let (found, reason) = run(&square_wave(), 100.0, whole / 2);
    assert!(matches!(reason, Some(Reason::TooMuchMemory { .. })), "{reason:?}");
    assert!((0.5..0.55).contains(&(held(&found) as f64 / whole as f64)));
    assert_eq!(run(&square_wave(), 100.0, whole + 1).1, None);
}

/// What is quick at first only is not refused for it.
#[test]
fn only_the_latest_steps_count() {
    let t = Expr::symbol("t", Dimension::NONE);
    let slowing = Toy((60 * (1 + &t).log()).sin());
    let whole = held(&run(&slowing, 1e3, u64::MAX).0);
    assert_eq!(run(&slowing, 1e3, whole + 1).1, None);
}

/// Nor is a motion that goes on from one that holds much refused for its own first steps.
#[test]
fn a_motion_that_goes_on_is_judged_by_its_own_steps() {
    let quick_at_first = Toy((60 * (1e-6 + Expr::symbol("t", Dimension::NONE) - 100).log()).sin().sign());
    let wave = square_wave();
    let limit = 3 * held(&run(&wave, 100.0, u64::MAX).0);
    let mut first = solver(&wave, 100.0, limit);
    while !first.is_done() {
        first.advance().expect("a step");
    }
    let (_, handover) = first.hand_over();
    let mut goes_on = Solver::resumed(&quick_at_first, handover, 200.0, Accuracy::DEFAULT);
    goes_on.memory.limit = limit;
    goes_on.memory.next_look = FIRST_LOOK * limit as f64;
    assert_eq!(finished(goes_on).1, None);
}

#[test]
fn messages_name_numbers_and_a_way_out() {
    let reason = run(&square_wave(), 1e6, SMALL).1.expect("refused").to_string();
    for part in ["steps so far hold", "KiB", "2e6 steps", "t = 1000000 s", "a shorter run", "sin"] {
        assert!(reason.contains(part), "{part}: {reason}");
    }
}
