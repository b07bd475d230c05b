//! What contacts are made of: lazy_guards, invariants, zeros that are known, wakes, causes at the start.

use tumble_expr::{Dimension, Expr, Symbol};
use tumble_ode::{
    Accuracy, AtZero, Cause, Crossing, Direction, Flow, Guard, Hybrid, InitialState, Invariant, Jump,
    LazyGuard, Reason, ScaleGroup, Side, StateVariable, Stopped, Trajectory, Watched, solve,
};

const G: f64 = 10.0;

fn leaf(name: &str) -> Expr {
    Expr::symbol(name, Dimension::NONE)
}

fn symbol(name: &str) -> Symbol {
    Symbol::new(name, Dimension::NONE)
}

fn guard(name: &str, formula: Expr) -> Guard {
    Guard { name: name.into(), formula, direction: Direction::Falling, at_zero: AtZero::Begins }
}

fn lazy_guard(name: &str, formula: Expr, slopes: Option<Vec<(usize, Expr)>>) -> LazyGuard {
    LazyGuard {
        name: name.into(),
        of: Watched::new(formula, &["x", "v"].map(symbol), &symbol("t"), &[]),
        direction: Direction::Falling,
        at_zero: AtZero::Ends,
        group: 0,
        slopes,
        reach: None,
    }
}

/// A system of pure numbers; what a jump does is a function of the crossing.
struct Toy {
    rates: Vec<(&'static str, Expr)>,
    guards: Vec<Guard>,
    lazy_guards: Vec<LazyGuard>,
    invariants: Vec<Invariant>,
    jump: fn(&Crossing<'_, i32>) -> Jump<i32>,
}

impl Hybrid for Toy {
    /// How many jumps there were.
    type Mode = i32;
    type Record = ();

    fn flow(&self, _: &i32) -> Result<Flow, Reason> {
        let states = self.rates.iter().map(|(name, rate)| StateVariable {
            symbol: symbol(name),
            rate: rate.clone(),
            group: 0,
            per_parameter: false,
        });
        Ok(Flow {
            states: states.collect(),
            time: symbol("t"),
            inputs: vec![],
            rounding: tumble_expr::Rounding::NEAREST,
            groups: vec![ScaleGroup { name: "size".into(), floor: Expr::one(), per_run: false }],
            schedule: vec![],
            guards: self.guards.clone(),
            lazy_guards: self.lazy_guards.clone(),
            invariants: self.invariants.clone(),
            time_transformation: None,
        })
    }

    fn jump(&self, at: &Crossing<'_, i32>) -> Result<Jump<i32>, Reason> {
        Ok((self.jump)(at))
    }
}

type Ran = Result<Trajectory<i32>, Box<Stopped<i32>>>;

fn run_with(toy: &Toy, start: &[f64], until: f64, causes: Vec<Cause>) -> Ran {
    let start = InitialState {
        time: 0.0,
        mode: 0,
        states: start.to_vec(),
        compensation: vec![0.0; start.len()],
        inputs: vec![],
        causes,
        rounding: tumble_expr::Rounding::NEAREST,
        is_proved: true,
        stride: 1.0,
    };
    solve(toy, start, until, Accuracy::new(1e-12).expect("allowed")).map_err(Box::new)
}

fn run(toy: &Toy, start: &[f64], until: f64) -> Trajectory<i32> {
    run_with(toy, start, until, vec![]).expect("a motion")
}

/// Falls with G, height x.
fn falling(jump: fn(&Crossing<'_, i32>) -> Jump<i32>) -> Toy {
    let rates = vec![("x", leaf("v")), ("v", Expr::from(-G))];
    Toy { rates, guards: vec![], lazy_guards: vec![], invariants: vec![], jump }
}

/// Turns the speed round.
fn bounce(at: &Crossing<'_, i32>) -> Jump<i32> {
    Jump::to(*at.mode, vec![at.states[0], -at.states[1]])
}

fn times(motion: &Trajectory<i32>) -> Vec<f64> {
    motion.events.iter().map(|event| event.time).collect()
}

#[test]
fn a_lazy_guard_is_a_guard_that_costs_less() {
    let tape = Toy { guards: vec![guard("floor", leaf("x"))], ..falling(bounce) };
    let bounded = Some(vec![(0, Expr::one())]);
    let beside = Toy { lazy_guards: vec![lazy_guard("floor", leaf("x"), bounded)], ..falling(bounce) };
    let unbounded = Toy { lazy_guards: vec![lazy_guard("floor", leaf("x"), None)], ..falling(bounce) };
    let [tape, beside, unbounded] = [tape, beside, unbounded].map(|toy| run(&toy, &[5.0, 0.0], 99.5));
    assert_eq!(tape.events.len(), 50);
    assert_eq!(
        (tape.events[0].causes[0], beside.events[0].causes[0]),
        (Cause::Guard(0), Cause::LazyGuard(0))
    );
    for (n, ((a, b), c)) in times(&tape).iter().zip(times(&beside)).zip(times(&unbounded)).enumerate() {
        let exact = 1.0 + 2.0 * n as f64;
        assert!((a - exact).abs() < 1e-13 && (b - exact).abs() < 1e-13, "{a} {b} {exact}");
        assert_eq!(b, c);
    }
}

#[test]
fn what_is_far_away_is_not_expanded() {
    let far = |n: usize| {
        lazy_guard(&format!("far{n}"), leaf("x") + (1000 + n) as f64, Some(vec![(0, Expr::one())]))
    };
    let near = lazy_guard("floor", leaf("x"), Some(vec![(0, Expr::one())]));
    let alone = Toy { lazy_guards: vec![near.clone()], ..falling(bounce) };
    let crowded = Toy { lazy_guards: (0..1000).map(far).chain([near]).collect(), ..falling(bounce) };
    let [alone, crowded] = [alone, crowded].map(|toy| run(&toy, &[5.0, 0.0], 20.0));
    assert_eq!(times(&alone), times(&crowded));
    println!("{:?} {:?}", alone.work, crowded.work);
    assert!(alone.work.near >= alone.events.len() as u64);
    // A flight of unknown end may reach all of them once: it is exact, and so is proposed up to the end of the run.
    let once = 1000 * crowded.work.steps;
    assert!(crowded.work.near < once, "{}", crowded.work.near);
}

/// On an ordinary step nothing that the motion cannot reach within it is looked at.
#[test]
fn an_oscillator_never_looks_at_what_it_cannot_reach() {
    let far =
        |n: usize| lazy_guard(&format!("far{n}"), leaf("x") + (100 + n) as f64, Some(vec![(0, Expr::one())]));
    let toy = Toy {
        rates: vec![("x", leaf("v")), ("v", -leaf("x"))],
        lazy_guards: (0..1000).map(far).collect(),
        ..falling(bounce)
    };
    let motion = run(&toy, &[1.0, 0.0], 50.0);
    assert_eq!((motion.work.near, motion.events.len()), (0, 0));
}

/// x^2 + y^2 = 1 for a thousand turns, with a rate that leads outwards.
#[test]
fn an_invariant_is_kept() {
    let (x, y) = (leaf("x"), leaf("y"));
    let circle = &x * &x + &y * &y - 1;
    let outwards = Expr::from(1e-13);
    let toy = |kept: bool| Toy {
        rates: vec![("x", -&y + &outwards * &x), ("y", &x + &outwards * &y)],
        invariants: kept
            .then(|| Invariant::new(circle.clone(), 0, &["x", "y"].map(symbol)))
            .into_iter()
            .collect(),
        ..falling(bounce)
    };
    let off = |kept: bool| {
        let motion = run(&toy(kept), &[1.0, 0.0], 6000.0);
        let parts = (0..=6000).map(|n| {
            let states = motion.states_at(f64::from(n), Side::After).expect("inside");
            (states[0] * states[0] + states[1] * states[1] - 1.0).abs()
        });
        parts.fold(0.0, f64::max)
    };
    let [kept, left] = [off(true), off(false)];
    assert!(kept < 3e-13, "{kept:e}");
    assert!(left > 1e-9, "{left:e}");
}

#[test]
fn a_wake_comes_at_its_time() {
    fn jump(at: &Crossing<'_, i32>) -> Jump<i32> {
        let woken = at.causes.contains(&Cause::Wake);
        let wake = (!woken).then_some(at.time + 0.123_456_789);
        Jump { wake, ..Jump::to(at.mode + 1, vec![at.states[0], if woken { 0.0 } else { -at.states[1] }]) }
    }
    let toy = Toy {
        lazy_guards: vec![lazy_guard("floor", leaf("x"), Some(vec![(0, Expr::one())]))],
        ..falling(jump)
    };
    let motion = run(&toy, &[5.0, 0.0], 1.2);
    assert_eq!(times(&motion), [1.0, 1.123_456_789]);
    assert_eq!(motion.events[1].causes, [Cause::Wake]);
    assert_eq!(motion.last_states().expect("ran")[1], -G * (1.2 - 1.123_456_789));
}

#[test]
fn causes_at_the_start_come_before_any_step() {
    let toy = Toy {
        lazy_guards: vec![lazy_guard("floor", leaf("x"), Some(vec![(0, Expr::one())]))],
        ..falling(bounce)
    };
    let motion = run_with(&toy, &[0.0, -5.0], 0.9, vec![Cause::LazyGuard(0)]).expect("a motion");
    assert_eq!(times(&motion), [0.0]);
    assert_eq!(motion.events[0].after, [0.0, 5.0]);
    let end = motion.last_states().expect("ran");
    assert!((end[0] - (4.5 - 5.0 * 0.81)).abs() < 1e-15, "{end:?}");
}

/// Found beyond zero and going on, it crosses now; beyond zero and coming back, it does not.
#[test]
fn what_is_overdue_happens_at_once() {
    let toy = Toy {
        lazy_guards: vec![lazy_guard("floor", leaf("x"), Some(vec![(0, Expr::one())]))],
        ..falling(bounce)
    };
    let motion = run(&toy, &[-1e-17, -1.0], 0.1);
    assert_eq!(times(&motion)[0], 0.0);
    let motion = run(&toy, &[-1e-17, 1.0], 0.1);
    assert_eq!(times(&motion).len(), 0);
}

/// Left a little beyond zero by rounding, an arc too low to come out is still an arc, and its end is seen.
#[test]
fn an_arc_that_starts_beyond_zero_ends() {
    fn jump(at: &Crossing<'_, i32>) -> Jump<i32> {
        Jump { zeros: vec![("floor".into(), 1)], ..Jump::to(at.mode + 1, vec![-1e-17, 1e-9]) }
    }
    let toy = Toy {
        lazy_guards: vec![lazy_guard("floor", leaf("x"), Some(vec![(0, Expr::one())]))],
        ..falling(jump)
    };
    let motion = run(&toy, &[5.0, 0.0], 1.0 + 1e-9);
    assert!((times(&motion)[1] - 1.0 - 2e-10).abs() < 3e-16, "{:?}", &times(&motion)[..2]);
}

/// With two derivatives known to be zero, what rounding leaves of them is not taken for a crossing.
#[test]
fn zeros_that_are_known_are_not_crossed_again() {
    fn jump(at: &Crossing<'_, i32>) -> Jump<i32> {
        let zeros = vec![("ramp".into(), 2)];
        Jump { zeros, ..Jump::to(at.mode + 1, vec![at.states[0], -1e-17]) }
    }
    // From x = -1e-17 and v = -1e-17 it rises with t^3: nothing but the start is a zero.
    let toy = Toy {
        rates: vec![("x", leaf("v")), ("v", leaf("t"))],
        lazy_guards: vec![lazy_guard("ramp", leaf("x"), None)],
        ..falling(jump)
    };
    let motion = run_with(&toy, &[-1e-17, 0.0], 2.0, vec![Cause::LazyGuard(0)]).expect("a motion");
    assert_eq!(times(&motion), [0.0]);
}

/// The speed of what is thrown up, which the flow holds for while it is positive.
fn kept(jump: fn(&Crossing<'_, i32>) -> Jump<i32>) -> Toy {
    let kept = Guard { at_zero: AtZero::Keeps { group: 0 }, ..guard("turn", leaf("v")) };
    Toy { guards: vec![kept], ..falling(jump) }
}

#[test]
fn what_goes_on_beyond_a_guard_that_is_kept_is_refused() {
    // The model says that it begins at zero, and it falls.
    let toy =
        kept(|at| Jump { zeros: vec![("turn".into(), 1)], ..Jump::to(at.mode + 1, vec![at.states[0], 0.0]) });
    let stopped = run_with(&toy, &[0.0, 1.0], 1.0, vec![]).expect_err("it is beyond");
    assert_eq!(stopped.refusal.reason, Reason::Beyond { guard: "turn".into() });
    assert!((stopped.refusal.time - 0.1).abs() < 1e-13, "{}", stopped.refusal.time);
}

#[test]
fn a_guard_that_is_kept_crosses_again_where_its_jump_left_it_away_from_zero() {
    let toy = kept(|at| match at.mode {
        0 => Jump::to(1, vec![at.states[0], 1e-14]),
        _ => Jump { stop: true, ..Jump::to(2, at.states.to_vec()) },
    });
    let motion = run(&toy, &[0.0, 1.0], 1.0);
    let times = times(&motion);
    assert!(times.len() == 2 && times[1] - times[0] < 1e-14, "{times:?}");
}

/// What happens before it is back does not make it a motion that its equations do not hold for.
#[test]
fn what_a_jump_puts_beyond_a_guard_that_is_kept_may_come_back() {
    let at = |name: &str, instant: f64| guard(name, Expr::from(instant) - leaf("t"));
    let turn = Guard { at_zero: AtZero::Keeps { group: 0 }, ..guard("turn", leaf("v")) };
    let toy = Toy {
        rates: vec![("v", Expr::one())],
        guards: vec![turn, at("put", 0.5), at("before it is back", 0.505)],
        lazy_guards: vec![],
        invariants: vec![],
        jump: |at| {
            let v = if *at.mode == 0 { -0.01 } else { at.states[0] };
            Jump { zeros: vec![("turn".into(), 1)], ..Jump::to(at.mode + 1, vec![v]) }
        },
    };
    let motion = run(&toy, &[1.0], 1.0);
    assert_eq!(times(&motion), [0.5, 0.505]);
    assert!((motion.last_states().expect("ran")[0] - 0.49).abs() < 1e-14);
}

/// A force of -1e-60 moves nothing within any step, and no range of it, which has twins cancel, knows its sign: steps need not be
/// shorter for that. What moves something is still located.
#[test]
fn the_sign_of_a_force_that_moves_nothing_need_not_be_known() {
    let rates = || vec![("x", leaf("v")), ("v", -leaf("x")), ("y", leaf("w")), ("w", -leaf("y"))];
    let held = |force: f64, coupling: f64| Guard {
        at_zero: AtZero::EndsIfItMoves { response: Expr::one(), group: 0, again: false },
        ..guard("held", Expr::from(force) + Expr::from(coupling) * (leaf("x") - leaf("y")))
    };
    let jump = |at: &Crossing<'_, i32>| Jump::to(*at.mode, at.states.to_vec());
    let with = |guards| Toy { rates: rates(), guards, lazy_guards: vec![], invariants: vec![], jump };
    let start = [1.0, 0.0, 1.0, 0.0];
    let steps = |toy: &Toy| run(toy, &start, 20.0).work.steps;
    assert_eq!(steps(&with(vec![held(-1e-60, 1e-40)])), steps(&with(vec![])));
    let pulls = run(&with(vec![held(-1e-3, 1e-40)]), &start, 20.0);
    assert_eq!(times(&pulls)[..1], [0.0]);
}

/// The jump that a force led to as it came to zero may leave it there, and it goes on to pull.
#[test]
fn what_goes_on_beyond_zero_that_its_jump_left_there_ends_the_flow_again() {
    let events = |again: bool| {
        let at_zero = AtZero::EndsIfItMoves { response: Expr::one(), group: 0, again };
        let guards = vec![Guard { at_zero, ..guard("force", leaf("v")) }];
        let toy = Toy { guards, ..falling(|at| Jump::to(*at.mode, at.states.to_vec())) };
        run_with(&toy, &[0.0, 1.0], 1.0, vec![]).map(|motion| times(&motion).len())
    };
    assert_eq!(events(false).expect("a motion"), 1);
    let refused = events(true).expect_err("it is left to pull").refusal;
    assert!(matches!(refused.reason, Reason::Chatter { .. }), "{refused:?}");
}
