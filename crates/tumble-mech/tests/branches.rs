//! Singular configurations from which more than one motion goes on, or next to which nobody can tell: refused in time, with the joints
//! and the branches; and what looks like them and is passed.

use crate::common;

use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{
    Action, Anchor, Application, AppliedImpulse, Body, Event, Gravity, Happening, Joint, Model, Run,
    RunError, Start, time,
};
use tumble_ode::{Accuracy, Direction};

const G: f64 = 9.81;

fn named(body: &Body, point: &str) -> Anchor {
    Anchor::Material(body.named_point(point).expect("a named point"))
}

/// Bars on a smooth table or in a plane that stands, joined at their ends.
struct Linkage {
    model: Model,
    accuracy: f64,
}

impl Linkage {
    fn new(gravity: f64) -> Self {
        let mut model = Model::new();
        model.gravity = Gravity::Vertical(gravity * M / (S * S));
        Self { model, accuracy: 1e-12 }
    }

    /// A bar of 1 kg between two places, which turns at a rate about the first.
    fn bar(&mut self, name: &str, [from, to]: [[f64; 2]; 2], omega: f64) -> Body {
        let [x, y] = [to[0] - from[0], to[1] - from[1]];
        let length = x.hypot(y);
        let bar = Body::rod(name, [0 * M, 0 * M], [length * M, 0 * M]).mass(1 * KG);
        let bar = bar.with_point("start", [0 * M, 0 * M]).with_point("end", [length * M, 0 * M]);
        let start = Start::default().at([(from[0] + x / 2.0) * M, (from[1] + y / 2.0) * M]);
        let start = start.angle(Expr::from(y.atan2(x))).omega(omega / S);
        let start = start.velocity([-y / 2.0 * omega * M / S, x / 2.0 * omega * M / S]);
        self.model.starts.push((name.into(), start));
        self.model.add(bar)
    }

    fn pin(&mut self, name: &str, ends: [Anchor; 2]) {
        self.model.join(Joint { assemble: true, ..Joint::pin(name, ends) });
    }

    fn hinge(&mut self, name: &str, bar: &Body, [x, y]: [f64; 2]) {
        self.pin(name, [Anchor::World(Vector::planar(x * M, y * M)), named(bar, "start")]);
    }

    /// A loop of crank, coupler and rocker, with its four corners; the rate is the crank's, and those of the others follow.
    fn four_bar(&mut self, [a0, a, b, b0]: [[f64; 2]; 4], omega: f64) -> [Body; 3] {
        let crank = self.bar("crank", [a0, a], omega);
        let coupler = self.bar("coupler", [a, b], 0.0);
        let rocker = self.bar("rocker", [b0, b], 0.0);
        self.hinge("A0", &crank, a0);
        self.hinge("B0", &rocker, b0);
        self.pin("A", [named(&crank, "end"), named(&coupler, "start")]);
        self.pin("B", [named(&coupler, "end"), named(&rocker, "end")]);
        [crank, coupler, rocker]
    }

    fn run(&self, until: f64) -> Result<Run, RunError> {
        self.model.simulate_to(&[], until * S, Accuracy::new(self.accuracy).expect("an accuracy"))
    }

    #[track_caller]
    fn refused(&self, until: f64) -> (f64, String) {
        common::refused(self.run(until))
    }
}

#[track_caller]
fn says(text: &str, words: &[&str]) {
    words.iter().for_each(|words| assert!(text.contains(words), "`{words}` is not in: {text}"));
}

fn passed(run: &Run) -> Vec<f64> {
    let events = run.trajectory().events.iter();
    let singular = events.filter(|event| event.record.happened == [Happening::Singular]);
    singular.map(|event| event.time).collect()
}

/// m: of the cranks, and of coupler and base.
const CRANK: f64 = 0.3;
const BASE: f64 = 0.5;
/// kg m^2 and N m, of two cranks and a coupler of 1 kg each: `INERTIA theta'' = -WEIGHT cos(theta)`.
const INERTIA: f64 = (2.0 / 3.0 + 1.0) * CRANK * CRANK;
const WEIGHT: f64 = 2.0 * CRANK * G;

/// Parallel cranks at an angle, on a base in some direction.
fn parallelogram(base: f64, angle: f64, omega: f64) -> (Linkage, Vec<Body>) {
    let mut linkage = Linkage::new(G);
    let far = [BASE * base.cos(), BASE * base.sin()];
    let up = [CRANK * angle.cos(), CRANK * angle.sin()];
    let ends = [up, [far[0] + up[0], far[1] + up[1]]];
    let cranks = [("crank0", [0.0, 0.0]), ("crank1", far)].into_iter().zip(ends);
    let cranks: Vec<Body> = cranks.map(|((name, at), end)| linkage.bar(name, [at, end], omega)).collect();
    let coupler = linkage.bar("coupler", ends, 0.0);
    let moves = [-up[1] * omega * M / S, up[0] * omega * M / S];
    let (_, start) = linkage.model.starts.pop().expect("of the coupler");
    linkage.model.starts.push(("coupler".into(), start.velocity(moves)));
    linkage.hinge("A0", &cranks[0], [0.0, 0.0]);
    linkage.hinge("A1", &cranks[1], far);
    linkage.pin("B0", [named(&cranks[0], "end"), named(&coupler, "start")]);
    linkage.pin("B1", [named(&cranks[1], "end"), named(&coupler, "end")]);
    (linkage, cranks)
}

/// A pendulum, by small steps of fourth order; the angle at the end, rad.
fn pendulum(angle: f64, omega: f64, damping: f64, until: f64) -> f64 {
    const STEPS: usize = 20_000;
    let rates = |[angle, omega]: [f64; 2]| [omega, (-WEIGHT * angle.cos() - damping * omega) / INERTIA];
    let h = until / STEPS as f64;
    let mut now = [angle, omega];
    for _ in 0..STEPS {
        let moved = |[a, b]: [f64; 2], by: f64| [now[0] + by * a, now[1] + by * b];
        let first = rates(now);
        let second = rates(moved(first, h / 2.0));
        let third = rates(moved(second, h / 2.0));
        let fourth = rates(moved(third, h));
        now = std::array::from_fn(|i| {
            now[i] + h / 6.0 * (first[i] + 2.0 * second[i] + 2.0 * third[i] + fourth[i])
        });
    }
    now[0]
}

/// What came of a parallelogram is the pendulum, or refused with both ways on: cranks that stay parallel, and cranks that do not.
#[track_caller]
fn is_right_or_refused(linkage: &Linkage, cranks: &[Body], until: f64, expected: f64, off: f64) -> bool {
    match linkage.run(until) {
        Err(error) => {
            println!("{error}");
            says(
                &error.to_string(),
                &["singular configuration", "`B0`, `B1`", "`crank0` and `crank1` turn one way", "1 : 1 : 0"],
            );
            false
        }
        Ok(found) => {
            let end = found.at(until).expect("within");
            for crank in cranks {
                let angle = end.angle(crank).expect("finite");
                assert!((angle - expected).abs() < off, "{angle} is not {expected}");
            }
            true
        }
    }
}

/// Thrown up so that they come to their flat pose with ever less speed, or turn back ever nearer before it: with none left they may go
/// on either way.
#[test]
fn what_all_but_comes_to_rest_in_a_flat_pose_is_right_or_refused() {
    let angle: f64 = -1.0;
    for (speed, sign) in
        [(0.0, 1.0), (1e-7, -1.0), (1e-4, 1.0), (1e-2, 1.0), (0.1, -1.0), (0.5, 1.0), (0.5, -1.0), (1.0, 1.0)]
    {
        let omega = (sign * speed * speed - 2.0 * WEIGHT / INERTIA * angle.sin()).sqrt();
        let (linkage, cranks) = parallelogram(0.0, angle, omega);
        println!("{speed:e} {sign}");
        let expected = pendulum(angle, omega, 0.0, 0.5);
        let is_found = is_right_or_refused(&linkage, &cranks, 0.5, expected, 1e-9);
        assert!(is_found == (speed > 0.05), "{speed} {sign}");
    }
}

/// With so little speed that both instants at which they are flat are one as far as it can be told, they are at rest there.
#[test]
fn what_comes_to_rest_is_told_so() {
    let omega = (1e-4 - 2.0 * WEIGHT / INERTIA * f64::sin(-1.0)).sqrt();
    let (time, text) = parallelogram(0.0, -1.0, omega).0.refused(0.5);
    assert!(time < 0.23, "{time}");
    says(&text, &["the bodies come to rest in a singular configuration", "`B0`, `B1`", "0.25 : -1 : -0.75"]);
}

/// A ball that spins on the coupler is not at rest when all else is: that says nothing of how the cranks go on.
#[test]
fn what_spins_on_does_not_tell_the_cranks_where_to_go() {
    let (inertia, weight) = (INERTIA + CRANK * CRANK, WEIGHT + CRANK * G);
    let (angle, omega) = (-1.0_f64, (2.5e-3 - 2.0 * weight / inertia * f64::sin(-1.0)).sqrt());
    let (mut linkage, _) = parallelogram(0.0, angle, omega);
    let coupler = linkage.model.bodies[2].clone();
    let disk = linkage.model.add(Body::ball("disk", 0.1 * M).mass(1 * KG));
    let at = [CRANK * angle.cos() + BASE / 2.0, CRANK * angle.sin()];
    let moves = [-CRANK * angle.sin() * omega, CRANK * angle.cos() * omega];
    let start = Start::default().at(at.map(|x| x * M)).velocity(moves.map(|v| v * M / S)).omega(50.0 / S);
    linkage.model.starts.push(("disk".into(), start));
    linkage.pin("D", [named(&coupler, "cm"), named(&disk, "cm")]);
    let (_, text) = linkage.refused(0.5);
    says(
        &text,
        &["velocities that more than one motion goes on with: its branches touch there", "`B0`, `B1`"],
    );
}

/// Struck just before they are flat, cranks go on as they were struck, or no step leads there.
#[test]
fn an_impulse_just_before_a_flat_pose_is_right_or_refused() {
    let mut refused = vec![];
    for before in [0.3, 1e-2, 1e-3, 1e-4, 3e-5, 1e-5, 1e-6] {
        let (mut linkage, cranks) = parallelogram(0.0, -0.5, 6.0);
        linkage.model.gravity = Gravity::Vertical(0 * M / (S * S));
        linkage.model.events.push(Event {
            name: "strike".into(),
            when: cranks[0].kinematics().angle() + before,
            direction: Direction::Rising,
            action: Action::Record,
        });
        linkage.model.impulses.push(AppliedImpulse {
            name: "kick".into(),
            body: cranks[0].name.clone(),
            when: "strike".into(),
            application: Application::Torque(0.15 * N * M * S),
        });
        println!("{before:e}");
        let expected = -before + (6.0 + 0.15 / INERTIA) * (0.5 - (0.5 - before) / 6.0);
        if !is_right_or_refused(&linkage, &cranks, 0.5, expected, 1e-9) {
            refused.push(before);
        }
    }
    println!("{refused:?}");
    assert!(refused.iter().all(|before| *before < 2e-3) && refused.contains(&1e-6), "{refused:?}");
}

/// Thrown so that they come to their upper flat pose after for ever: from where it cannot be told any more whether the cranks stay
/// parallel, nothing is said.
#[test]
fn what_creeps_up_to_a_flat_pose_is_refused_in_time() {
    let (up, angle) = (std::f64::consts::FRAC_PI_2, -1.0_f64);
    let omega = (2.0 * WEIGHT / INERTIA * (1.0 - angle.sin())).sqrt();
    let (linkage, cranks) = parallelogram(up, angle, omega);
    let expected = pendulum(angle, omega, 0.0, 2.0);
    assert!(is_right_or_refused(&linkage, &cranks, 2.0, expected, 1e-8));
    let (time, text) = linkage.refused(10.0);
    assert!((2.0..3.0).contains(&time), "{time}");
    says(
        &text,
        &["nearer than 1e-5", "either `crank0` and `crank1` turn one way", "1 : 1 : 0", "0.25 : -1 : -0.75"],
    );
}

/// Cranks that hang are in a flat pose in the middle of each swing. Swings that die out end in a refusal, and those that were
/// small from the start.
#[test]
fn swings_through_a_flat_pose_are_right_until_they_are_too_small() {
    let down = -std::f64::consts::FRAC_PI_2;
    for until in [1.0, 4.0, 8.0, 30.0] {
        let (mut linkage, cranks) = parallelogram(-down, -1.0, 0.0);
        let omega = cranks[0].kinematics().omega().clone();
        linkage.model.torque("brake", &cranks[0], -(0.3 * N * M * S) * omega);
        let is_found = is_right_or_refused(&linkage, &cranks, until, pendulum(-1.0, 0.0, 0.3, until), 1e-9);
        assert_eq!(is_found, until < 5.0, "{until}");
    }
    for (away, is_large) in
        [(0.1, true), (1e-2, true), (1e-3, false), (1e-4, false), (1e-5, false), (1e-7, false)]
    {
        let (linkage, cranks) = parallelogram(-down, down + away, 0.0);
        let is_found =
            is_right_or_refused(&linkage, &cranks, 2.0, pendulum(down + away, 0.0, 0.0, 2.0), 1e-9 * away);
        assert!(is_found || !is_large, "{away}");
    }
}

/// A kite whose crank lies on the base, with coupler and rocker on each other, driven through a dead point in its flat pose: at the
/// dead point the crank may stay where it is, or turn with the square of the time.
#[test]
fn branches_that_touch_are_refused() {
    let (long, drive, link) = (0.5, 0.1, 0.4);
    let hinge = [CRANK + long, -(drive + link)];
    let turned = std::f64::consts::FRAC_PI_2 - 0.25;
    let end = [hinge[0] + drive * turned.cos(), hinge[1] + drive * turned.sin()];
    // The rocker's angle at which the link fits.
    let tip = |angle: f64| [CRANK + long * angle.cos(), long * angle.sin()];
    let (mut low, mut high) = (-0.5, 0.0);
    for _ in 0..60 {
        let angle = 0.5 * (low + high);
        let [x, y] = tip(angle);
        if (x - end[0]).hypot(y - end[1]) < link { low = angle } else { high = angle }
    }
    let mut linkage = Linkage { accuracy: 1e-9, ..Linkage::new(0.0) };
    let [_, _, rocker] = linkage.four_bar([[0.0, 0.0], [CRANK, 0.0], tip(low), [CRANK, 0.0]], 0.0);
    let driver = linkage.bar("driver", [hinge, end], 8.0);
    let link = linkage.bar("link", [end, tip(low)], 0.0);
    linkage.hinge("C0", &driver, hinge);
    linkage.pin("C", [named(&driver, "end"), named(&link, "start")]);
    linkage.pin("D", [named(&link, "end"), named(&rocker, "end")]);
    let (time, text) = linkage.refused(1.0);
    assert!((0.01..0.2).contains(&time), "{time}");
    says(
        &text,
        &[
            "`A`, `B`",
            "they begin alike: `driver` turns one way and `link` the other, without a turn of `crank`",
        ],
    );
}

/// Bars of one length, the crank on the base and the others on each other: flat, a parallelogram and two that turn as one meet. The
/// velocities say that the crank stays, and it does.
#[test]
fn a_rhombus_turns_on_as_it_comes() {
    let mut linkage = Linkage::new(0.0);
    let (turned, omega, length) = (0.7_f64, -3.0, 0.4);
    let tip = [length + length * turned.cos(), length * turned.sin()];
    let corners = [[0.0, 0.0], [length, 0.0], tip, [length, 0.0]];
    let [crank, coupler, rocker] = linkage.four_bar(corners, 0.0);
    for name in ["coupler", "rocker"] {
        let start = linkage.model.starts.iter_mut().find(|(own, _)| own == name).expect("given");
        let half = [length / 2.0 * turned.cos(), length / 2.0 * turned.sin()];
        let moves = [-half[1] * omega * M / S, half[0] * omega * M / S];
        start.1 = start.1.clone().omega(omega / S).velocity(moves);
    }
    let found = linkage.run(3.0).map_err(|error| error.to_string()).expect("a motion");
    let end = found.at(3.0).expect("within");
    assert!(end.angle(&crank).expect("finite").abs() < 1e-11);
    for bar in [&coupler, &rocker] {
        assert!((end.angle(bar).expect("finite") - (turned + 3.0 * omega)).abs() < 1e-10);
    }
    // Flat at each half turn: at 0, -pi, -2 pi.
    let flat = passed(&found);
    assert_eq!(flat.len(), 3, "{flat:?}");
    for (index, at) in flat.iter().enumerate() {
        assert!((at - (turned + index as f64 * std::f64::consts::PI) / 3.0).abs() < 1e-11, "{at}");
    }
}

/// Where the joints of a four-bar are whose crank has turned so far, from its pivot to that of the rocker: crank, coupler, rocker, base.
fn open_four_bar([a, b, c, d]: [f64; 4], turned: f64) -> [[f64; 2]; 4] {
    let end = [a * turned.cos(), a * turned.sin()];
    let [x, y] = [d - end[0], -end[1]];
    let reach = x.hypot(y);
    let inner = ((b * b + reach * reach - c * c) / (2.0 * b * reach)).acos();
    let towards = y.atan2(x) + inner;
    let tip = [end[0] + b * towards.cos(), end[1] + b * towards.sin()];
    [[0.0, 0.0], end, tip, [d, 0.0]]
}

/// Crank and base as long as coupler and rocker together: once a turn they lie in one line, where two branches cross. The rates are
/// those of the branch that leads on, which solve `sum of l_i w_i = 0` and `sum of l_i w_i^2 = 0` along that line.
#[test]
fn a_change_point_is_passed_on_the_branch_of_the_velocities() {
    let [a, b, c, d] = [0.2, 0.4, 0.3, 0.5];
    let turned = 2.0_f64;
    let mut linkage = Linkage::new(0.0);
    let bars = linkage.four_bar(open_four_bar([a, b, c, d], turned), 4.0);
    let found = linkage.run(2.0).map_err(|error| error.to_string()).expect("a motion");
    let flat = passed(&found);
    assert!(!flat.is_empty());
    for at in flat {
        let now = found.at(at).expect("within");
        let [crank, coupler, rocker] = bars.each_ref().map(|bar| now.omega(bar).expect("finite"));
        // Crank to the left, coupler and rocker from both ends towards each other.
        let first = -a * crank + b * coupler + c * rocker;
        let second = -a * crank * crank + b * coupler * coupler + c * rocker * rocker;
        println!("{at}: {crank} {coupler} {rocker}, {first:e} {second:e}");
        assert!(
            first.abs() < 1e-9 * crank.abs() && second.abs() < 1e-8 * crank * crank,
            "{first:e} {second:e}"
        );
    }
}

/// Where crank and coupler lie in one line the rocker turns back: its joints say all they say elsewhere, and nobody is told anything.
#[test]
fn a_dead_point_is_not_singular() {
    let [a, b, c, d] = [0.2, 0.5, 0.4, 0.5];
    let turned = 1.4_f64;
    let mut linkage = Linkage::new(0.0);
    let [crank, _, rocker] = linkage.four_bar(open_four_bar([a, b, c, d], turned), 9.0);
    let back = Event {
        name: "back".into(),
        when: rocker.kinematics().omega().clone(),
        direction: Direction::Both,
        action: Action::Record,
    };
    linkage.model.events.push(back);
    let found = linkage.run(6.0).map_err(|error| error.to_string()).expect("a motion");
    let turns = found.at(6.0).expect("within").angle(&crank).expect("finite") / std::f64::consts::TAU;
    assert!(turns > 2.0 && found.trajectory().events.len() >= 4, "{turns}");
    assert!(passed(&found).is_empty());
}

/// Bars of 2 m and 1 m along one of 3 m: they cannot move against each other, though their pins let them begin to.
#[test]
fn a_triangle_without_height_is_refused_at_its_start() {
    let mut linkage = Linkage::new(G);
    let [first, second] = [("first", 0.0, 2.0), ("second", 2.0, 3.0)]
        .map(|(name, from, to)| linkage.bar(name, [[from, 0.0], [to, 0.0]], 0.0));
    let whole = linkage.bar("whole", [[0.0, 0.0], [3.0, 0.0]], 0.0);
    linkage.hinge("O", &whole, [0.0, 0.0]);
    linkage.pin("P", [named(&whole, "start"), named(&first, "start")]);
    linkage.pin("Q", [named(&first, "end"), named(&second, "start")]);
    linkage.pin("R", [named(&second, "end"), named(&whole, "end")]);
    let (_, text) = linkage.refused(1.0);
    says(
        &text,
        &[
            "start in a singular",
            "`P`, `Q`, `R`",
            "they begin alike: `first`, `second` and `whole` turn one way",
        ],
    );
}

/// A parallelogram that is not closed until it is flat, and one that is hit when it is.
#[test]
fn joints_and_impulses_in_a_flat_pose_are_refused() {
    /// s
    const AT: f64 = 0.5 / 6.0;
    for joined in [true, false] {
        // What is joined lies still until then.
        let [angle, omega] = if joined { [0.0, 0.0] } else { [-0.5, 6.0] };
        let (mut linkage, cranks) = parallelogram(0.0, angle, omega);
        linkage.model.gravity = Gravity::Vertical(0 * M / (S * S));
        let flat = if joined { time() - AT * S } else { cranks[0].kinematics().angle().clone() };
        linkage.model.events.push(Event {
            name: "flat".into(),
            when: flat,
            direction: Direction::Rising,
            action: Action::Record,
        });
        match joined {
            true => {
                let joint = linkage.model.joints.iter_mut().find(|joint| joint.name == "B1").expect("given");
                (joint.from, joint.assemble) = (Some("flat".into()), false);
            }
            false => {
                linkage.model.impulses.push(AppliedImpulse {
                    name: "kick".into(),
                    body: cranks[0].name.clone(),
                    when: "flat".into(),
                    application: Application::Torque(0.1 * N * M * S),
                });
            }
        }
        let (time, text) = linkage.refused(0.5);
        assert!((time - AT).abs() < 1e-9, "{time}");
        let what = if joined { "joints begin to hold" } else { "an impulse acts" };
        says(&text, &[what, "singular configuration", "`B1`", "either `crank0` and `crank1` turn one way"]);
    }
}
