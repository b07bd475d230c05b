//! Loads that depend on forces of contacts and joints, found together with these; against closed forms and an independent integration.

use crate::common;

use crate::common::{at, close, rigid, run};
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{
    Action, Anchor, Body, BodyContact, Equations, Event, Friction, Gravity, Joint, Load, Model, Part, Place,
    Run, RunBalance, RunError, Shape, Start, Surface, time,
};
use tumble_ode::{Accuracy, Direction};

const G: f64 = 9.81;

fn plate(name: &str, width: f64, height: f64, mass: f64) -> Body {
    let centre = Vector::planar(0 * M, 0 * M);
    Body::of_shape(name, Shape::Box { centre, width: width * M, height: height * M }).mass(mass * KG)
}

fn in_gravity() -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    model
}

/// The force of all points of a body on the surface.
fn normal(model: &Model, surface: &str, body: &str) -> Expr {
    let place = format!("{surface}.{body}.");
    let own = model.pairs().into_iter().filter(|pair| pair.name.starts_with(&place));
    own.map(|pair| Expr::from(pair.force_symbol())).reduce(|a, b| a + b).expect("they may touch")
}

/// A block of 2 kg that moves to the right on a floor, pulled upwards at an angle, and rubbed at its foot by `-mu N`.
fn pulled(pull: f64, angle: f64, mu: f64, speed: f64) -> Model {
    let mut model = in_gravity();
    let block = model.add(plate("block", 0.4, 0.2, 2.0));
    let start = Start::default().at([0 * M, 0.1 * M]).velocity([speed * M / S, 0 * M / S]);
    model.starts.push(("block".into(), start));
    model.surface(Surface::new("floor", [0 * M, 0 * M], [0.into(), 1.into()], rigid(0.0)));
    let (sin, cos) = angle.sin_cos();
    model.force("pull", &block.cm(), Vector::planar(pull * cos * N, pull * sin * N));
    let rub = -mu * normal(&model, "floor", "block") * block.kinematics().velocity().x().sign();
    let foot = Place::FromCentre(Vector::planar(0 * M, -0.1 * M));
    model.loads.push(Load::force("rub", "block", foot, Vector::planar(rub, 0 * N)));
    model
}

fn vx(run: &Run) -> Expr {
    run.equations.model().bodies[0].kinematics().velocity().x().clone()
}

/// `N = m g - F sin a` and `m a = F cos a - mu N`, all of it from the first instant on.
#[test]
fn a_block_that_is_pulled_upwards_is_rubbed_less() {
    for (pull, angle, mu) in [(8.0, 0.5, 0.3), (8.0, -0.5, 0.3), (3.0, 1.2, 0.9), (0.0, 0.0, 0.2)] {
        let run = run(pulled(pull, angle, mu, 5.0), 0.3, 1e-13);
        let force = 2.0 * G - pull * f64::sin(angle);
        let found = at(&run, 0.2, [normal(run.equations.model(), "floor", "block"), vx(&run)]);
        close(found[0], force, 1e-14);
        close(found[1], 5.0 + 0.2 * (pull * f64::cos(angle) - mu * force) / 2.0, 1e-14);
    }
}

fn tried(model: &Model, until: f64) -> Result<Run, RunError> {
    model.simulate_to(&[], until * S, Accuracy::new(1e-12).expect("an accuracy"))
}

/// When a motion is refused, and what is said.
#[track_caller]
fn refused(model: &Model, until: f64) -> (f64, String) {
    common::refused(tried(model, until))
}

/// The same block with the friction that surfaces have, of which the law is the same.
#[test]
fn a_users_friction_is_that_of_surfaces() {
    let (pull, angle, mu) = (8.0, 0.5, 0.3);
    let own = run(pulled(pull, angle, mu, 1.0), 0.4, 1e-13);
    let mut model = pulled(pull, angle, mu, 1.0);
    model.loads.truncate(1);
    let surface = model.surfaces.remove(0);
    model.surface(surface.with_friction(Friction::new(Expr::from(mu))));
    let built_in = run(model, 0.4, 1e-13);
    let place = |run: &Run| run.equations.model().bodies[0].kinematics().position().x().clone();
    let motion =
        |run: &Run| at(run, 0.4, [place(run), vx(run), normal(run.equations.model(), "floor", "block")]);
    for (own, built_in) in motion(&own).into_iter().zip(motion(&built_in)) {
        close(own, built_in, 2e-15);
    }
}

/// A load that lasts a while and grows, whose friction is counted from a normal force that falls: `N = m g - k t`.
#[test]
fn friction_falls_with_a_load_that_grows() {
    let mut model = pulled(0.0, 0.0, 0.25, 4.0);
    let (k, mass, mu) = (6.0, 2.0, 0.25);
    let block = model.bodies[0].clone();
    model.force("lift", &block.cm(), Vector::planar(0 * N, k * N / S * time()));
    let run = run(model, 1.0, 1e-13);
    let t = 0.8;
    close(at(&run, t, [vx(&run)])[0], 4.0 - mu * (G * t - k * t * t / (2.0 * mass)), 1e-14);
}

/// On a slope, a drag that grows with the weight on it: `m s'' = m g sin - c N s'`, with `N = m g cos`.
#[test]
fn a_drag_that_grows_with_the_normal_force() {
    let (slope, c) = (0.4_f64, 0.3);
    let (sin, cos) = slope.sin_cos();
    let mut model = in_gravity();
    let start = Start::default().at([-0.1 * sin * M, 0.1 * cos * M]).angle(Expr::from(slope));
    model.starts.push(("block".into(), start));
    let block = model.add(plate("block", 0.4, 0.2, 3.0));
    model.surface(Surface::sloping("floor", [0 * M, 0 * M], &Expr::from(slope), rigid(0.0)));
    let drag = -c * S / M * normal(&model, "floor", "block") * block.kinematics().velocity();
    model.force("drag", &block.cm(), drag);
    let run = run(model, 2.0, 1e-13);
    let rate = c * G * cos;
    let speed = -G * sin / rate * (1.0 - libm::exp(-rate * 2.0));
    close(at(&run, 2.0, [vx(&run)])[0], speed * cos, 1e-13);
}

/// A disk pushes another, which is held back by a part of the force between the two: `N (1 + m1 (1 - c)/m2) = F`.
#[test]
fn two_bodies_in_contact() {
    let (push, c, masses) = (5.0, 0.4, [1.0, 3.0]);
    let mut model = Model::new();
    for (name, mass, x) in [("first", masses[0], 0.0), ("second", masses[1], 0.2)] {
        let disk = Shape::Disk { centre: Vector::planar(0 * M, 0 * M), radius: 0.1 * M };
        model.add(Body::of_shape(name, disk).mass(mass * KG));
        model.starts.push((name.into(), Start::default().at([x * M, 0 * M])));
    }
    model.contact(BodyContact::of_all("touch", 0));
    let [first, second] = [0, 1].map(|body| model.bodies[body].clone());
    model.force("push", &first.cm(), Vector::planar(push * N, 0 * N));
    let between = Expr::from(model.pairs()[0].force_symbol());
    model.force("back", &second.cm(), Vector::planar(-c * &between, 0 * N));
    let run = run(model, 1.0, 1e-13);
    let force = push / (1.0 + masses[0] * (1.0 - c) / masses[1]);
    let speed = first.kinematics().velocity().x().clone();
    let found = at(&run, 0.7, [between, speed]);
    close(found[0], force, 1e-14);
    close(found[1], 0.7 * (push - force) / masses[0], 1e-14);
}

/// Fourth-order steps of a motion.
fn stepped(mut now: [f64; 2], until: f64, steps: usize, rates: impl Fn([f64; 2]) -> [f64; 2]) -> [f64; 2] {
    let h = until / steps as f64;
    for _ in 0..steps {
        let moved = |[a, b]: [f64; 2], by: f64| [now[0] + by * a, now[1] + by * b];
        let first = rates(now);
        let second = rates(moved(first, h / 2.0));
        let third = rates(moved(second, h / 2.0));
        let fourth = rates(moved(third, h));
        now = std::array::from_fn(|i| {
            now[i] + h / 6.0 * (first[i] + 2.0 * second[i] + 2.0 * third[i] + fourth[i])
        });
    }
    now
}

/// A rod of 1 m and 1 kg that swings about its upper end, held by a pivot or by a pin, under a torque that its hinge's force makes.
fn swinging(by_pivot: bool, torque: impl Fn(&Body, [Expr; 2]) -> Expr) -> (Model, Body) {
    let mut model = in_gravity();
    let rod =
        Body::rod("rod", [0 * M, 0 * M], [0 * M, -1 * M]).mass(1 * KG).with_point("top", [0 * M, 0 * M]);
    let rod = model.add(rod);
    let place = [0 * M, 0 * M];
    let forces = if by_pivot {
        model.pivot_at("hinge", &rod, place.clone(), place);
        model.pivots[0].force_symbols().to_vec()
    } else {
        let top = Anchor::Material(rod.named_point("top").expect("given"));
        let joint = Joint {
            assemble: true,
            ..Joint::pin("hinge", [top, Anchor::World(Vector::planar(0 * M, 0 * M))])
        };
        let forces = joint.multipliers();
        model.join(joint);
        forces
    };
    model.torque("drag", &rod, torque(&rod, [forces[0].clone().into(), forces[1].clone().into()]));
    model.starts.push(("rod".into(), Start::default().angle(Expr::from(1.2))));
    (model, rod)
}

/// `(I - c m r cos) omega' = -m g r sin - c m r sin omega^2`, from `R_x = m (r cos omega' - r sin omega^2)`.
#[test]
fn a_torque_by_the_force_of_a_hinge_across() {
    let (c, r, inertia) = (0.15, 0.5, 1.0 / 3.0);
    let expected = stepped([1.2, 0.0], 2.0, 20_000, |[angle, omega]| {
        let (sin, cos) = angle.sin_cos();
        [omega, (-G * r * sin - c * r * sin * omega * omega) / (inertia - c * r * cos)]
    });
    for by_pivot in [true, false] {
        let (model, rod) = swinging(by_pivot, |_, [fx, _]| c * M * fx);
        let run = run(model, 2.0, 1e-13);
        let found = at(&run, 2.0, [rod.kinematics().angle(), rod.kinematics().omega()]);
        found.iter().zip(expected).for_each(|(found, expected)| close(*found, expected, 1e-11));
    }
}

/// Friction of a hinge that bears the weight, as long as it turns one way: `-c R_y sign(omega)`, with `R_y = m (g + r sin omega' + r cos omega^2)`.
#[test]
fn friction_of_a_hinge_by_its_upward_force() {
    let (c, r, inertia) = (0.05, 0.5, 1.0 / 3.0);
    // It swings down from the right with omega < 0.
    let expected = stepped([1.2, 0.0], 0.7, 20_000, |[angle, omega]| {
        let (sin, cos) = angle.sin_cos();
        [omega, (-G * r * sin + c * (G + r * cos * omega * omega)) / (inertia - c * r * sin)]
    });
    for by_pivot in [true, false] {
        let (model, rod) = swinging(by_pivot, |rod, [_, fy]| -c * M * fy * rod.kinematics().omega().sign());
        let run = run(model, 0.7, 1e-13);
        let found = at(&run, 0.7, [rod.kinematics().angle(), rod.kinematics().omega()]);
        found.iter().zip(expected).for_each(|(found, expected)| close(*found, expected, 1e-11));
    }
}

/// A block that a part c of its normal force presses down: `N (1 - c) = m g`.
fn pressed(part: Expr) -> Model {
    let mut model = pulled(0.0, 0.0, 0.0, 0.0);
    model.loads.clear();
    let block = model.bodies[0].clone();
    let press = -part * normal(&model, "floor", "block");
    model.force("press", &block.cm(), Vector::planar(0 * N, press));
    model
}

/// Up to the part of one the force grows, and there it is refused; so is a larger part from the start on, however it begins.
#[test]
fn a_part_that_comes_to_one_is_refused() {
    let model = pressed(time() / (2.0 * S));
    let run = run(model.clone(), 1.9, 1e-12);
    close(at(&run, 1.8, [normal(&model, "floor", "block")])[0], 2.0 * G / 0.1, 1e-12);
    let (time, text) = refused(&model, 3.0);
    assert!((time - 2.0).abs() < 1e-5, "{time}");
    for words in ["is not determined", "`press` depends on it", "floor.block"] {
        assert!(text.contains(words), "{text}");
    }
    for part in [1.0, 1.5, 1e6] {
        let (time, text) = refused(&pressed(Expr::from(part)), 1.0);
        assert!(time == 0.0 && text.contains("is not determined"), "{text}");
    }
    // What lifts it takes some of the weight and never all of it.
    let lifted = common::run(pressed(Expr::from(-1e3)), 1.0, 1e-12);
    close(at(&lifted, 0.5, [normal(&model, "floor", "block")])[0], 2.0 * G / 1001.0, 1e-14);
}

/// A parameter that an event gives another formula at 1 s.
fn changed(model: &mut Model, value: f64, to: impl Fn(&Expr) -> Expr) -> Expr {
    let part = model.parameters.set("c", Expr::from(value)).expect("a name");
    let action = Action::Set(vec![("c".into(), to(&part))]);
    let when = time() - 1 * S;
    model.events.push(Event { name: "change".into(), when, direction: Direction::Rising, action });
    part
}

/// A part of 0.3 to which an event adds 0.4 leaves a force; if 0.4 were added twice it would not.
#[test]
fn what_an_event_sets_is_fed_back_once() {
    let mut named = Model::new();
    let part = changed(&mut named, 0.3, |part| part + 0.4);
    let model = Model { parameters: named.parameters, events: named.events, ..pressed(part) };
    let run = run(model.clone(), 2.0, 1e-12);
    close(at(&run, 1.5, [normal(&model, "floor", "block")])[0], 2.0 * G / 0.3, 1e-12);
}

/// A load reads one of three feet from 1.5 s on, with a coefficient of which an event makes `1 - c`: refused where that is not zero.
#[test]
fn what_an_event_sets_of_a_force_that_is_not_unique_counts_once() {
    for (before, is_open) in [(0.0, true), (1.0, false)] {
        let mut model = bench_of_three();
        let part = changed(&mut model, before, |part| 1 - part);
        let force = part * Expr::from(model.pairs()[1].force_symbol());
        let cm = Place::Material(model.bodies[0].cm());
        let load = Load::force("push", "bench", cm, Vector::planar(force, 0 * N));
        model.loads.push(load.during(1.5 * S, 3 * S));
        match tried(&model, 2.0) {
            Ok(_) => assert!(!is_open, "{before}"),
            Err(_) => {
                let (time, text) = refused(&model, 2.0);
                assert!(is_open && time == 1.5 && text.contains("more contacts or joints bear"), "{text}");
            }
        }
    }
}

/// What a hinge's own force turns so that it need not turn at all: `I = c m r cos`.
#[test]
fn a_hinge_that_feeds_itself_is_refused() {
    let (c, r, inertia) = (1.0, 0.5, 1.0 / 3.0);
    for by_pivot in [true, false] {
        // It would come to the angle at which `cos = I/(c m r)` from a larger one.
        let (model, rod) = swinging(by_pivot, |_, [fx, _]| c * M * fx);
        let (time, text) = refused(&model, 3.0);
        let Err(RunError::Refused { partial, .. }) = tried(&model, 3.0) else { panic!("a motion") };
        let end = partial.end().expect("a motion up to there");
        let [angle] = at(&partial, end, [rod.kinematics().angle()]);
        assert!(time > 0.1 && (angle.cos() - inertia / (c * r)).abs() < 1e-4, "{time} {angle}");
        assert!(text.contains("hinge.fx") && text.contains("`drag`"), "{text}");
    }
}

/// A bench of 3 kg on three feet, sliding without friction.
fn bench_of_three() -> Model {
    let foot = |x: f64| Part {
        shape: Shape::Disk { centre: Vector::planar(x * M, 0 * M), radius: 0.1 * M },
        mass: 1 * KG,
    };
    let mut model = in_gravity();
    model.add(Body::from_parts("bench", [-1.0, 0.0, 1.0].map(foot).to_vec()));
    let start = Start::default().at([0 * M, 0.1 * M]).velocity([1 * M / S, 0 * M / S]);
    model.starts.push(("bench".into(), start));
    model.surface(Surface::floor("floor", 0 * M, rigid(0.0)));
    model
}

/// What each foot bears is open, what all bear is not.
#[test]
fn what_is_not_unique_is_refused_and_its_sum_is_not() {
    let bench = |of: &dyn Fn(&[Expr]) -> Expr| {
        let mut model = bench_of_three();
        let feet: Vec<Expr> = model.pairs().iter().map(|pair| pair.force_symbol().into()).collect();
        let body = model.bodies[0].clone();
        model.force("drag", &body.cm(), Vector::planar(-0.1 * of(&feet), 0 * N));
        model
    };
    for of_one in [|feet: &[Expr]| feet[1].clone(), |feet: &[Expr]| (&feet[1] * (1 * N)).sqrt()] {
        let text = refused(&bench(&of_one), 1.0).1;
        assert!(
            text.contains("`drag` depends on") && text.contains("more contacts or joints bear"),
            "{text}"
        );
    }
    let sum = |feet: &[Expr]| &feet[0] + &feet[1] + &feet[2];
    let run_of_sum = run(bench(&sum), 1.0, 1e-13);
    close(at(&run_of_sum, 1.0, [vx(&run_of_sum)])[0], 1.0 - 0.1 * G, 1e-14);
    let run_of_square = run(bench(&|feet| sum(feet).powi(2) / (100 * N)), 1.0, 1e-13);
    close(at(&run_of_square, 1.0, [vx(&run_of_square)])[0], 1.0 - 0.1 * 3.0 * G * G / 100.0, 1e-13);
}

/// A contact that is open pushes with nothing: what reads it is nothing too, until it closes and after it opens.
#[test]
fn an_open_contact_is_read_as_nothing() {
    let mut model = in_gravity();
    let ball = model.add(Body::ball("ball", 0.1 * M).mass(2 * KG));
    let start = Start::default().at([0 * M, 1.1 * M]).velocity([1 * M / S, 0 * M / S]);
    model.starts.push(("ball".into(), start));
    model.surface(Surface::new("floor", [0 * M, 0 * M], [0.into(), 1.into()], rigid(0.0)));
    let drag = -0.5 * normal(&model, "floor", "ball");
    model.force("drag", &ball.cm(), Vector::planar(drag, 0 * N));
    let run = run(model.clone(), 1.0, 1e-12);
    let fall = (2.0 / G).sqrt();
    assert_eq!(at(&run, 0.9 * fall, [vx(&run)])[0], 1.0);
    close(at(&run, 1.0, [vx(&run)])[0], 1.0 - 0.5 * G * (1.0 - fall), 1e-13);
    // An impact is no force.
    close(at(&run, fall * (1.0 + 1e-9), [vx(&run)])[0], 1.0, 1e-7);
}

/// A joint that an event releases does nothing from then on, and what reads it neither.
#[test]
fn a_joint_that_is_released_is_read_as_nothing() {
    let (mut model, rod) = swinging(false, |_, _| 0 * N * M);
    let free = model.add(Body::ball("free", 0.1 * M).mass(1 * KG));
    model.gravity = Gravity::Vertical(G * M / (S * S));
    model.starts.push(("free".into(), Start::default().at([5 * M, 0 * M])));
    let fy = model.joints[0].multipliers().remove(1);
    model.joints[0].until = Some("low".into());
    model.events.push(Event {
        name: "low".into(),
        when: rod.kinematics().angle().clone(),
        direction: Direction::Falling,
        action: Action::Record,
    });
    model.force("pull", &free.cm(), Vector::planar(Expr::from(fy), 0 * N));
    let run = run(model, 2.0, 1e-12);
    let low =
        run.events().find(|event| !event.record.happened.is_empty()).expect("it comes to hang down").time;
    let speed = free.kinematics().velocity().x().clone();
    let [before] = at(&run, low, [speed.clone()]);
    let [after] = at(&run, 1.9, [speed]);
    assert!(before > 1.0 && (after - before).abs() < 1e-13, "{before} {after}");
}

/// Two blocks each of which is driven by the force of the other's floor, and one by its own, all at once.
#[test]
fn loads_that_read_each_others_contacts() {
    let mut model = in_gravity();
    for (name, mass, x) in [("a", 1.0, 0.0), ("b", 1.0, 3.0)] {
        model.add(plate(name, 0.4, 0.2, mass));
        model.starts.push((name.into(), Start::default().at([x * M, 0.1 * M])));
    }
    model.surface(Surface::new("floor", [0 * M, 0 * M], [0.into(), 1.into()], rigid(0.0)));
    let [a, b] = ["a", "b"].map(|name| normal(&model, "floor", name));
    let bodies = model.bodies.clone();
    // N_a = g - N_b/2 and N_b = g - N_a/4.
    model.force("on a", &bodies[0].cm(), Vector::planar(0.1 * &a, 0.5 * &b));
    model.force("on b", &bodies[1].cm(), Vector::planar(0.1 * &a, 0.25 * &a));
    let run = run(model, 1.0, 1e-12);
    let force_a = (G - G / 2.0) / (1.0 - 0.125);
    let force_b = G - force_a / 4.0;
    let found = at(&run, 0.5, [a, b]);
    close(found[0], force_a, 1e-13);
    close(found[1], force_b, 1e-13);
}

/// Units of loads by forces are looked at, and so is where they act.
#[test]
fn what_cannot_be_read_is_refused_by_name() {
    let mut model = pulled(0.0, 0.0, 0.1, 1.0);
    let (block, force) = (model.bodies[0].clone(), normal(&model, "floor", "block"));
    let place = Place::FromCentre(Vector::planar(&force * 1 * M / (1 * N), 0 * M));
    model.loads.push(Load::force("push", "block", place, Vector::planar(1 * N, 0 * N)));
    let text = refused(&model, 1.0).1;
    assert!(text.contains("place of `push` depends on `floor.block"), "{text}");
    let mut torque = pulled(0.0, 0.0, 0.1, 1.0);
    torque.torque("twist", &block, force);
    assert!(refused(&torque, 1.0).1.contains("torque of `twist`"));
}

/// A load by the friction of a surface: while it slides that is tied to the normal force, `N (1 + c mu) = m g`; while it sticks it is
/// what the pull takes, `N = m g - c P`.
#[test]
fn a_load_by_the_friction_of_a_surface() {
    let (mu, c, pull) = (0.5, 0.4, 3.0);
    for speed in [4.0, 0.0] {
        let mut model = pulled(pull, 0.0, 0.0, speed);
        model.loads.truncate(1);
        let surface = model.surfaces.remove(0);
        model.surface(surface.with_friction(Friction::new(Expr::from(mu))));
        let friction = model.pairs().into_iter().filter(|pair| pair.friction.is_some() && !pair.is_rolling());
        let friction =
            friction.map(|pair| Expr::from(pair.friction_symbol())).reduce(|a, b| a + b).expect("corners");
        let block = model.bodies[0].clone();
        model.force("lift", &block.cm(), Vector::planar(0 * N, -c * &friction));
        let run = run(model.clone(), 0.2, 1e-13);
        let [normal, along, v] = at(&run, 0.1, [normal(&model, "floor", "block"), friction, vx(&run)]);
        let (force, rubs) = if speed > 0.0 {
            (2.0 * G / (1.0 + c * mu), -mu * 2.0 * G / (1.0 + c * mu))
        } else {
            (2.0 * G - c * pull, -pull)
        };
        close(normal, force, 1e-13);
        close(along, rubs, 1e-13);
        close(v, if speed > 0.0 { speed + 0.1 * (pull + rubs) / 2.0 } else { 0.0 }, 1e-13);
    }
}

/// A ball is driven by the force of another body's hinge: `m v' = c R_x`, `R_x = M a_x` of the rod's centre.
#[test]
fn a_load_by_the_hinge_of_another_body() {
    for by_pivot in [true, false] {
        let (mut model, rod) = swinging(by_pivot, |_, _| 0 * N * M);
        let forces: Vec<Expr> = match by_pivot {
            true => model.pivots[0].force_symbols().map(Expr::from).to_vec(),
            false => model.joints[0].multipliers().into_iter().map(Expr::from).collect(),
        };
        let ball = model.add(Body::ball("ball", 0.1 * M).mass(4 * KG));
        model.starts.push(("ball".into(), Start::default().at([5 * M, 0 * M])));
        model.force("drive", &ball.cm(), Vector::planar(0.5 * &forces[0], 0 * N));
        let run = run(model, 1.5, 1e-13);
        let speeds = [&rod, &ball].map(|body| body.cm().velocity().x().clone());
        let [rod, ball] = at(&run, 1.5, speeds);
        close(ball, 0.5 * rod / 4.0, 1e-12);
    }
}

/// What the load does to the energy of the block is its work, to the last digits.
#[test]
fn works_of_such_loads_are_counted() {
    let (pull, angle, mu) = (8.0, 0.5, 0.3);
    let run = run(pulled(pull, angle, mu, 5.0), 0.5, 1e-13);
    let balance = RunBalance::of(&run, [0.3, -0.2]).expect("a balance");
    assert!(balance.energy.relative() < 1e-13 && balance.relative() < 1e-13, "{:?}", balance.energy);
    let force = 2.0 * G - pull * f64::sin(angle);
    let way = 5.0 * 0.5 + 0.125 * (pull * f64::cos(angle) - mu * force) / 2.0;
    let works = balance.contributions.iter().filter(|own| own.load == "rub");
    close(works.map(|own| own.work).sum(), -mu * force * way, 1e-13);
}

/// No equilibrium is looked for with them.
#[test]
fn equilibria_with_them_are_refused_by_name() {
    let mut model = pressed(Expr::from(0.5));
    for part in [Expr::from(0.5), 0.01 / N * normal(&model, "floor", "block")] {
        let model = pressed(part);
        let found = Equations::new(model.clone()).expect("a model").equilibrium(&model.parameters);
        assert!(found.expect_err("it depends on a force").to_string().contains("`press` depends on forces"));
    }
    model.loads.clear();
    let block = model.bodies[0].clone();
    let rub = -(1 * N) * block.kinematics().velocity().x().sign();
    model.force("rub", &block.cm(), Vector::planar(rub, 0 * N));
    let found = Equations::new(model.clone()).expect("a model").equilibrium(&model.parameters);
    assert!(found.expect_err("dry friction").to_string().contains("`rub` is dry friction"));
}
