//! Motions with known answers, and what they cost.

use tumble_expr::{Dimension, Expr, Symbol};
use tumble_ode::{
    Accuracy, Cause, Crossing, Flow, Hybrid, InitialState, Jump, Reason, ScaleGroup, Side, StateVariable,
    Stopped, Trajectory, solve,
};

fn leaf(name: &str) -> Expr {
    Expr::symbol(name, Dimension::NONE)
}

/// A system of pure numbers. Each scheduled time adds one to the mode, and the mode's rates are shifted by mode * on.
#[derive(Default)]
struct Toy {
    rates: Vec<(&'static str, Expr)>,
    schedule: Vec<Expr>,
    time_transformation: Option<Expr>,
}

impl Hybrid for Toy {
    /// How many scheduled times have passed, modulo two.
    type Mode = i32;
    /// How many passed at once.
    type Record = i32;

    fn flow(&self, mode: &i32) -> Result<Flow, Reason> {
        let symbol = |name: &str| Symbol::new(name, Dimension::NONE);
        let states = self.rates.iter().map(|(name, rate)| StateVariable {
            symbol: symbol(name),
            rate: if *mode == 0 { rate.clone() } else { rate + leaf("on") },
            group: 0,
            per_parameter: false,
        });
        Ok(Flow {
            states: states.collect(),
            time: symbol("t"),
            inputs: vec![symbol("p"), symbol("on")],
            rounding: tumble_expr::Rounding::NEAREST,
            groups: vec![ScaleGroup { name: "size".into(), floor: Expr::one(), per_run: false }],
            schedule: self.schedule.clone(),
            guards: vec![],
            lazy_guards: vec![],
            invariants: vec![],
            time_transformation: self.time_transformation.clone(),
        })
    }

    fn jump(&self, at: &Crossing<'_, i32>) -> Result<Jump<i32, i32>, Reason> {
        let passed = at.causes.iter().filter(|cause| matches!(cause, Cause::Scheduled(_))).count() as i32;
        Ok(Jump { record: passed, ..Jump::to((at.mode + passed) % 2, at.states.to_vec()) })
    }
}

type Ran = Result<Trajectory<i32, i32>, Box<Stopped<i32, i32>>>;

fn run(toy: &Toy, start: &[f64], until: f64, accuracy: f64) -> Ran {
    let start = InitialState {
        time: 0.0,
        mode: 0,
        states: start.to_vec(),
        compensation: vec![0.0; start.len()],
        inputs: vec![2.0, 1.0],
        causes: vec![],
        rounding: tumble_expr::Rounding::NEAREST,
        is_proved: true,
        stride: 1.0,
    };
    solve(toy, start, until, Accuracy::new(accuracy).expect("allowed")).map_err(Box::new)
}

fn oscillator() -> Toy {
    Toy { rates: vec![("x", leaf("v")), ("v", -leaf("x"))], ..Toy::default() }
}

/// Point mass on a massless rod of 1 m, g = 9.81 m/s^2, from the lowest point counter-clockwise.
fn pendulum() -> Toy {
    Toy { rates: vec![("theta", leaf("omega")), ("omega", -9.81 * leaf("theta").sin())], ..Toy::default() }
}

#[test]
fn the_oscillator_is_a_cosine() {
    let motion = run(&oscillator(), &[1.0, 0.0], 100.0, 1e-12).expect("smooth");
    for t in [0.0, 0.1, 12.345, 77.7, 100.0] {
        let states = motion.states_at(t, Side::After).expect("inside");
        assert!((states[0] - t.cos()).abs() < 1e-13, "x({t}) = {}", states[0]);
        assert!((states[1] + t.sin()).abs() < 1e-13, "v({t}) = {}", states[1]);
    }
    assert_eq!(motion.states_at(100.1, Side::After), None);
}

#[test]
fn the_error_follows_the_accuracy() {
    for accuracy in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
        let motion = run(&oscillator(), &[1.0, 0.0], 50.0, accuracy).expect("smooth");
        let error = (motion.last_states().expect("ran")[0] - 50.0_f64.cos()).abs();
        assert!(error < accuracy, "{error:e} at {accuracy:e}");
    }
}

/// Released from exactly 90 degrees only every fourth coefficient is nonzero: a rule that reads two of them reads
/// zeros.
#[test]
fn release_at_a_right_angle() {
    let motion = run(&pendulum(), &[std::f64::consts::FRAC_PI_2, 0.0], 10.0, 1e-12).expect("smooth");
    let theta = motion.last_states().expect("ran")[0];
    assert!((theta.sin().abs() - 0.275_087_462_576_116_9).abs() < 1e-13, "x = {}", theta.sin());
    assert!((-theta.cos() + 0.961_419_205_099_125_1).abs() < 1e-13, "y = {}", -theta.cos());
}

#[test]
fn there_and_back() {
    let there = run(&pendulum(), &[2.5, 1.0], 7.0, 1e-13).expect("smooth").last_states().expect("ran");
    let back =
        run(&pendulum(), &[there[0], -there[1]], 7.0, 1e-13).expect("smooth").last_states().expect("ran");
    assert!((back[0] - 2.5).abs() < 1e-12 && (back[1] + 1.0).abs() < 1e-12, "{back:?}");
}

/// Of a time and the way to a later one the sum may be an ulp less than that: what is scheduled then is not passed over.
#[test]
fn what_is_scheduled_happens_wherever_the_step_before_began() {
    for (first, second) in (1..60).flat_map(|i| (1..60).map(move |j| (f64::from(i), f64::from(j)))) {
        let times = [0.11 + 0.0071 * first, 0.61 + 0.0173 * second];
        let schedule = times.map(Expr::from).to_vec();
        let toy =
            Toy { rates: vec![("x", leaf("v")), ("v", leaf("t"))], schedule, time_transformation: None };
        let motion = run(&toy, &[0.0, 0.0], 2.0, 1e-9).expect("polynomials");
        assert_eq!(motion.events.iter().map(|event| event.time).collect::<Vec<_>>(), times);
    }
}

#[test]
fn a_polynomial_takes_one_exact_step_a_phase() {
    // x'' = t, plus the constant 1 on both rates from t = 1/2 to t = 3/4.
    let toy = Toy {
        rates: vec![("x", leaf("v")), ("v", leaf("t"))],
        schedule: vec![Expr::from(0.5), leaf("p") * 0.375],
        time_transformation: None,
    };
    let motion = run(&toy, &[0.0, 0.0], 2.0, 1e-9).expect("polynomials");
    assert_eq!((motion.work.steps, motion.work.exact_steps, motion.work.rejected), (3, 3, 0));
    let times: Vec<f64> = motion.events.iter().map(|event| event.time).collect();
    assert_eq!(times, [0.5, 0.75]);
    // v gains 1/4; x gains 1/4 from its own rate, 1/32 within the window from v's and 1/4 for each of 5/4 s after it.
    let end = motion.last_states().expect("ran");
    assert!((end[1] - (2.0 + 0.25)).abs() < 1e-15);
    assert!((end[0] - (8.0 / 6.0 + 0.25 + 1.0 / 32.0 + 1.25 * 0.25)).abs() < 1e-15, "{}", end[0]);
}

#[test]
fn both_sides_of_an_event_are_kept() {
    let toy = Toy { schedule: vec![Expr::one()], ..oscillator() };
    let motion = run(&toy, &[1.0, 0.0], 2.0, 1e-9).expect("smooth");
    let event = &motion.events[0];
    assert_eq!((event.time, event.mode_before, event.mode_after), (1.0, 0, 1));
    assert_eq!(event.before, event.after);
    assert_eq!(event.record, 1);
    let before = motion.piece_at(1.0, Side::Before).expect("inside");
    let after = motion.piece_at(1.0, Side::After).expect("inside");
    assert_eq!((before.end, after.start), (1.0, 1.0));
    assert_eq!((motion.modes[before.mode], motion.modes[after.mode]), (0, 1));
}

#[test]
fn an_event_at_the_very_end_happens() {
    let toy = Toy { schedule: vec![Expr::from(2)], ..oscillator() };
    let motion = run(&toy, &[1.0, 0.0], 2.0, 1e-9).expect("smooth");
    assert_eq!(motion.events.len(), 1);
}

/// None is stepped over, however short the window; and times an ulp apart (0.1 + 0.2 and 0.3) are one instant.
#[test]
fn short_windows_and_simultaneous_times() {
    let short = Toy { schedule: vec![Expr::from(0.7), Expr::from(0.7 + 1e-9)], ..oscillator() };
    let motion = run(&short, &[1.0, 0.0], 2.0, 1e-6).expect("smooth");
    assert_eq!(motion.events.len(), 2);
    let p = leaf("p");
    let one_ulp_apart = vec![&p * 0.15, &p * 0.05 + &p * 0.1];
    let simultaneous = Toy { schedule: one_ulp_apart, ..oscillator() };
    let motion = run(&simultaneous, &[1.0, 0.0], 2.0, 1e-6).expect("smooth");
    assert_eq!(motion.events.len(), 1);
    assert_eq!(motion.events[0].causes, [Cause::Scheduled(0), Cause::Scheduled(1)]);
}

#[test]
fn a_piece_runs_in_a_transformed_time() {
    // dt = x ds along x' = 1/x: in s, x' = 1, so t = s + s^2/2 from x(0) = 1.
    let toy =
        Toy { rates: vec![("x", 1 / leaf("x"))], time_transformation: Some(leaf("x")), ..Toy::default() };
    let motion = run(&toy, &[1.0], 10.0, 1e-12).expect("smooth");
    for t in [0.5_f64, 3.0, 10.0] {
        let x = motion.states_at(t, Side::After).expect("inside")[0];
        assert!((x - (1.0 + 2.0 * t).sqrt()).abs() < 1e-13, "x({t}) = {x}");
    }
    assert_eq!(motion.end(), Some(10.0));
}

#[test]
fn a_hidden_bump_is_seen() {
    // exp(-((t-5)/0.2)^2) and all its coefficients underflow to zero at t = 0.
    let bump = (-(((leaf("t") - 5) / 0.2).powi(2))).exp();
    let toy = Toy { rates: vec![("x", bump)], ..Toy::default() };
    let x = run(&toy, &[0.0], 20.0, 1e-10).expect("smooth").last_states().expect("ran")[0];
    assert!((x - 0.2 * std::f64::consts::PI.sqrt()).abs() < 1e-10, "{x}");
}

#[test]
fn a_singularity_is_refused_with_its_time() {
    let toy = Toy { rates: vec![("x", leaf("x").powi(2))], ..Toy::default() };
    let stopped = run(&toy, &[1.0], 2.0, 1e-9).expect_err("1/(1-t) ends at 1");
    assert!((stopped.refusal.time - 1.0).abs() < 1e-6, "{}", stopped.refusal);
    assert!(stopped.trajectory.pieces.len() > 3);
}

#[test]
fn bad_starts_and_ends_are_refused() {
    let refusal =
        |start: &[f64], until| run(&oscillator(), start, until, 1e-9).expect_err("bad").refusal.reason;
    assert!(matches!(refusal(&[1.0, f64::NAN], 1.0), Reason::BadStart { .. }));
    assert_eq!(refusal(&[1.0, 0.0], 0.0), Reason::BadEnd { until: 0.0 });
    assert!(matches!(refusal(&[1.0, 0.0], f64::INFINITY), Reason::BadEnd { .. }));
    let divides = Toy { rates: vec![("x", 1 / leaf("x"))], ..Toy::default() };
    let stopped = run(&divides, &[0.0], 1.0, 1e-9).expect_err("divides by zero");
    assert_eq!(stopped.refusal.reason, Reason::NotFinite { state: "x".into() });
}

/// A measured rate: every knot ends a step, and the integral of straight lines is exact.
#[test]
fn knots_of_a_table_are_met_exactly() {
    let rows: Vec<[f64; 2]> = (0..=100).map(|i| [0.1 * f64::from(i), f64::from(i % 3)]).collect();
    let table = |outside| {
        let linear = tumble_expr::Interpolation::Linear;
        std::sync::Arc::new(
            tumble_expr::Table::new("gust", [Dimension::NONE; 2], &rows, linear, outside).expect("a table"),
        )
    };
    let hold = table(tumble_expr::Outside::Hold);
    let toy = Toy { rates: vec![("x", Expr::table(&hold, leaf("t")))], ..Toy::default() };
    let motion = run(&toy, &[0.0], 12.0, 1e-9).expect("piecewise polynomials");
    let trapezoids: f64 = rows.windows(2).map(|pair| 0.05 * (pair[0][1] + pair[1][1])).sum();
    let last = rows[100][1];
    assert!((motion.last_states().expect("ran")[0] - (trapezoids + 2.0 * last)).abs() < 1e-13);
    assert_eq!((motion.work.knots, motion.work.exact_steps), (100, 101));
    // A table that says nothing outside refuses, with the time.
    let refuse = table(tumble_expr::Outside::Refuse);
    let toy = Toy { rates: vec![("x", Expr::table(&refuse, leaf("t")))], ..Toy::default() };
    let stopped = run(&toy, &[0.0], 12.0, 1e-9).expect_err("not measured after 10");
    assert_eq!(
        stopped.refusal.to_string(),
        "stopped at t = 10 s: `gust` is not measured at 10 (SI units), and says nothing outside its range"
    );
}

/// The last knot is measured: a motion that rests on it is neither refused nor taken for outside.
#[test]
fn the_last_knot_is_inside() {
    for outside in [tumble_expr::Outside::Refuse, tumble_expr::Outside::Zero, tumble_expr::Outside::Hold] {
        let rows = [[-1.0, 1.0], [0.0, 0.0], [1.0, -1.0]];
        let linear = tumble_expr::Interpolation::Linear;
        let table = tumble_expr::Table::new("pull", [Dimension::NONE; 2], &rows, linear, outside);
        let force = Expr::table(&std::sync::Arc::new(table.expect("a table")), leaf("x"));
        let toy = Toy { rates: vec![("x", leaf("v")), ("v", force)], ..Toy::default() };
        let motion = run(&toy, &[1.0, 0.0], 2.0, 1e-12).expect("inside");
        assert!((motion.last_states().expect("ran")[0] - 2.0_f64.cos()).abs() < 1e-12, "{outside:?}");
    }
}

/// A pulse that would end before it begins never acts.
#[test]
fn a_pulse_that_ends_first_is_none() {
    let pulse = |from: f64, to: f64| Expr::pulse(&leaf("t"), &Expr::from(from), &Expr::from(to));
    for (from, to, expected) in [(0.5, 0.7, 0.2), (0.7, 0.5, 0.0)] {
        let toy = Toy { rates: vec![("x", pulse(from, to))], ..Toy::default() };
        let x = run(&toy, &[0.0], 1.0, 1e-9).expect("constant pieces").last_states().expect("ran")[0];
        assert!((x - expected).abs() < 1e-15, "{x}");
    }
}

/// A force that depends on the place through a table, there and back over its knots.
#[test]
fn a_table_of_the_state() {
    // A potential valley of straight walls: x'' = -sign(x), as a table, and as the function.
    let rows = [[-2.0, 1.0], [0.0, -1.0], [2.0, -1.0]];
    let constant = tumble_expr::Interpolation::Constant;
    let table =
        tumble_expr::Table::new("force", [Dimension::NONE; 2], &rows, constant, tumble_expr::Outside::Hold);
    let force = Expr::table(&std::sync::Arc::new(table.expect("a table")), leaf("x"));
    let by_table = Toy { rates: vec![("x", leaf("v")), ("v", force)], ..Toy::default() };
    let by_sign = Toy { rates: vec![("x", leaf("v")), ("v", -leaf("x").sign())], ..Toy::default() };
    let [a, b] = [by_table, by_sign].map(|toy| run(&toy, &[1.0, 0.0], 30.0, 1e-12).expect("bounded"));
    assert_eq!(a.work.knots, b.work.flips);
    // Half parabolas, a quarter of the swing each in sqrt(2).
    let quarter = 2.0_f64.sqrt();
    let phase: f64 = 30.0 % (4.0 * quarter);
    let x = match (phase / quarter) as u32 {
        0 => 1.0 - phase * phase / 2.0,
        1 | 2 => (phase - 2.0 * quarter).powi(2) / 2.0 - 1.0,
        _ => 1.0 - (phase - 4.0 * quarter).powi(2) / 2.0,
    };
    for motion in [a, b] {
        assert!((motion.last_states().expect("ran")[0] - x).abs() < 1e-12);
    }
}

/// Counts of work, so that a change that makes steps shorter or longer is seen.
#[test]
fn work_counts() {
    let mut report = String::new();
    for (name, toy, start) in [("oscillator", oscillator(), [1.0, 0.0]), ("pendulum", pendulum(), [1.5, 0.0])]
    {
        for accuracy in [1e-6, 1e-9, 1e-12] {
            let motion = run(&toy, &start, 100.0, accuracy).expect("smooth");
            report += &format!("{name} {accuracy:e}: order {}, {:?}\n", motion.order, motion.work);
        }
    }
    insta::assert_snapshot!(report);
}
