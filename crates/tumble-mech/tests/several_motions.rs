//! Rigid contacts with friction that leave several motions possible: refused or told with all of them; and those that look like it and are
//! certain.

use crate::common::{at, model, plate, refused, rigid, rod, start};
use tumble_expr::units::{M, N, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{
    BodyContact, Friction, Load, Model, Others, Place, PossibleChange, PossibleContact, Run, Surface,
};
use tumble_ode::{Accuracy, Side};

const G: f64 = 9.81;

fn comes_to(model: &Model, until: f64) -> Result<Run, String> {
    let accuracy = Accuracy::new(1e-12).expect("an accuracy");
    model.simulate_to(&[], until * S, accuracy).map_err(|error| error.to_string())
}

/// What is said of other motions, with its times.
fn others(run: &Run) -> Vec<(f64, Others)> {
    run.events().flat_map(|event| event.record.others.iter().map(|one| (event.time, one.clone()))).collect()
}

/// Two rough walls, 1 m apart.
fn shaft(model: &mut Model, mu: f64) {
    for (name, x, out) in [("left", 0.0, 1), ("right", 1.0, -1)] {
        let wall = Surface::new(name, [x * M, 0 * M], [Expr::from(out), Expr::zero()], rigid(0.0));
        model.surface(wall.with_friction(Friction::new(mu)));
    }
}

/// A rod of 1 kg that fits between them.
fn rod_in_shaft(mu: f64, velocity: f64) -> Model {
    let mut model = model(G, vec![(rod("rod", 1.0, 0.0, 1.0), start([0.5, 0.0], 0.0, [0.0, velocity], 0.0))]);
    shaft(&mut model, mu);
    model
}

fn numbers(text: &str, before: &str) -> Vec<f64> {
    let all =
        text.split(before).skip(1).map(|rest| rest.split(' ').next().and_then(|word| word.parse().ok()));
    all.map(|number| number.expect("a number")).collect()
}

/// It may fall, with no force between the walls and it, or hang, with each end pressed by at least `m g/(2 mu)`, or do anything between. What the
/// walls were pressed with before is nowhere said.
#[test]
fn a_rod_between_rough_walls_may_fall_or_hang() {
    for mu in [0.1, 0.5, 2.0] {
        let text = comes_to(&rod_in_shaft(mu, 0.0), 0.1).map(drop).expect_err("it is not determined");
        assert!(text.contains("2 motions are possible") && text.contains("others between them"), "{text}");
        assert!(text.contains("changing by -9.81 m/s^2") && text.contains("rod.to` sticks"), "{text}");
        let forces = numbers(&text, "the normal force ");
        let (falls, hangs): (Vec<f64>, Vec<f64>) = forces.into_iter().partition(|force| *force == 0.0);
        assert_eq!(falls.len(), 2, "{text}");
        assert!(hangs.iter().all(|force| *force >= G / (2.0 * mu) * (1.0 - 1e-9)), "{hangs:?}");
    }
    // Without friction it falls, and without a second wall.
    assert!(comes_to(&rod_in_shaft(0.0, 0.0), 0.1).is_ok());
    let mut alone = rod_in_shaft(0.5, 0.0);
    alone.surfaces.pop();
    let run = comes_to(&alone, 0.1).expect("one motion");
    let y = run.equations.model().bodies[0].kinematics().position().y().clone();
    assert!((at(&run, 0.1, [y])[0] + 0.5 * G * 0.01).abs() < 1e-13);
}

/// What slides down between walls is slowed down by whatever they press with.
#[test]
fn a_rod_that_slides_between_rough_walls_is_slowed_by_any_force() {
    let text = comes_to(&rod_in_shaft(0.5, -1.0), 0.1).map(drop).expect_err("it is not determined");
    assert!(text.contains("others, with larger forces"), "{text}");
}

/// A box that a force presses against one wall, and that touches the other, hangs; when the force ends it may go on to, if the walls press it, or fall.
#[test]
fn a_box_in_a_shaft_is_refused_when_what_presses_it_ends() {
    let mut model = model(G, vec![(plate("box", [1.0, 1.0], 1.0), start([0.5, 0.0], 0.0, [0.0, 0.0], 0.0))]);
    shaft(&mut model, 0.5);
    push(&mut model, "push", [-40.0, 0.0], [0.0, 0.25]);
    let (time, text) = refused(model.simulate_to(&[], 1 * S, Accuracy::DEFAULT));
    assert_eq!(time, 0.25);
    assert!(text.contains("2 motions are possible") && text.contains("others between them"), "{text}");
    assert!(text.contains("changing by -9.81 m/s^2") && text.contains("corner1` sticks"), "{text}");
}

/// A force on the body that acts between two times.
fn push(model: &mut Model, name: &str, force: [f64; 2], [from, to]: [f64; 2]) {
    let body = &model.bodies[0];
    let force = Vector::planar(force[0] * N, force[1] * N);
    let load = Load::force(name, body.name.clone(), Place::Material(body.cm()), force);
    model.loads.push(load.during(from * S, to * S));
}

/// A rod that leans to the right by `tan = 2`, with friction 2, beyond Painleve's 4/3. Pressed along itself it stands. Then forces leave its foot to
/// itself with `b_t` and `b_n > 0`: with `A_nn = 1.6`, `A_tt = 3.4`, `A_nt = -1.2` (1/kg) it may lift off with b_n; stick, pressed by
/// `-(3.4 b_n + 1.2 b_t)/4`; or slide backward, pressed by `b_n/0.8`. It stuck and goes on to; from rest alone it is refused.
#[test]
fn what_sticks_goes_on_to_and_it_is_said_what_else_is_possible() {
    let (sin, cos) = 2.0_f64.atan().sin_cos();
    let [along, across] = [-5.0, 0.3];
    let of = |rests: bool| {
        let place = start([0.5 * cos, 0.5 * sin], 2.0_f64.atan(), [0.0, 0.0], 0.0);
        let mut model = model(G, vec![(rod("rod", 1.0, 0.0, 1.0), place)]);
        let floor = Surface::floor("floor", 0 * M, rigid(0.0)).with_friction(Friction::new(2.0));
        model.surface(Surface { on: Some(vec!["rod.from".into()]), ..floor });
        let begins = if rests { 0.25 } else { 0.0 };
        if rests {
            push(&mut model, "press", [-2.0 * cos, G - 2.0 * sin], [0.0, begins]);
        }
        push(&mut model, "pull", [along, across + G], [begins, 1.0]);
        model
    };
    let check = |text: &str| {
        assert!(text.contains("3 motions are possible"), "{text}");
        let forces = numbers(text, "the normal force ");
        let expected = [across / 0.8, -(3.4 * across + 1.2 * along) / 4.0];
        assert!(
            expected.iter().all(|known| forces.iter().any(|force| (force - known).abs() < 1e-9)),
            "{text}"
        );
        assert!((numbers(text, "opens with ")[0] - across).abs() < 1e-12, "{text}");
    };
    let run = comes_to(&of(true), 0.26).expect("it goes on");
    let told = others(&run);
    let [(time, Others::Possible(motions))] = &told[..] else { panic!("{told:?}") };
    assert_eq!(*time, 0.25);
    check(&motions.told(&run.equations));
    let taken = &motions.motions[motions.taken.expect("one goes on")];
    assert!(matches!(taken[..], [PossibleContact { does: PossibleChange::Sticks { .. }, .. }]), "{taken:?}");
    // About its foot: `I = m L^2/3`.
    let alpha = at_side(&run, 0.25);
    let expected = 1.5 * (cos * across - sin * along);
    assert!((alpha - expected).abs() < 1e-9, "{alpha} {expected}");
    check(&comes_to(&of(false), 0.01).map(drop).expect_err("nothing says that it sticks"));
}

fn at_side(run: &Run, time: f64) -> f64 {
    let alpha = run.equations.model().bodies[0].kinematics().alpha();
    run.observe(&[alpha]).expect("a formula").at(time, Side::After).expect("within the run")[0]
}

/// A uniform ladder at an angle against a wall.
fn ladder(tan: f64, mu: [f64; 2]) -> Model {
    let (sin, cos) = tan.atan().sin_cos();
    let at = start([0.5 * cos, 0.5 * sin], -tan.atan(), [0.0, 0.0], 0.0);
    let mut model = model(G, vec![(rod("ladder", 1.0, 0.0, 1.0), at)]);
    model.surface(Surface::floor("floor", 0 * M, rigid(0.0)).with_friction(Friction::new(mu[0])));
    let wall = Surface::new("wall", [0 * M, 0 * M], [Expr::one(), Expr::zero()], rigid(0.0));
    model.surface(wall.with_friction(Friction::new(mu[1])));
    model
}

/// The rod in a corner: its forces are not unique where it stands, but its motion is, though friction at both ends is never certain by itself
/// (four rows, three freedoms). It stands from `tan = (1 - mu^2)/(2 mu)` on.
#[test]
fn a_ladder_rough_at_both_ends_stands_or_slips_for_certain() {
    for mu in [0.3_f64, 0.5, 0.8] {
        let least = (1.0 - mu * mu) / (2.0 * mu);
        for (tan, stands) in [(least * (1.0 + 1e-6), true), (least * (1.0 - 1e-6), false)] {
            let run = comes_to(&ladder(tan, [mu; 2]), 0.05).expect("one motion");
            assert_eq!(others(&run), [], "{mu} {tan}");
            let omega = at(&run, 0.05, [run.equations.model().bodies[0].kinematics().omega()])[0];
            assert_eq!(omega == 0.0, stands, "{mu} {tan} {omega}");
            let floor = run.equations.pairs().iter().find(|pair| pair.name.starts_with("floor.ladder.to"));
            let force = floor.expect("its foot").force_symbol().into();
            let open = run.spreads(&[force], 0.0, Side::After).expect("a formula")[0];
            assert_eq!(open.is_some(), stands, "{mu} {tan}");
        }
    }
}

/// A tall box that is pulled at its top: `mu sqrt(1 + 3 h^2/(w^2 + h^2)) < 2` would make it certain, which fails here; all choices show one motion all the
/// same. It tips about its right corner, `(m g w/2 < F h)`, and does not slide.
#[test]
fn a_tall_box_tips_for_certain_though_its_friction_is_large() {
    let (width, height, mu, force) = (0.2, 1.0, 1.5, 0.2 * G);
    assert!(mu * (1.0_f64 + 3.0 * height * height / (width * width + height * height)).sqrt() > 2.0);
    let at_rest = start([0.0, 0.5 * height], 0.0, [0.0, 0.0], 0.0);
    let mut model = model(G, vec![(plate("box", [width, height], 1.0), at_rest)]);
    model.surface(Surface::floor("floor", 0 * M, rigid(0.0)).with_friction(Friction::new(mu)));
    let top = Place::Material(model.bodies[0].at(&Vector::planar(0 * M, 0.5 * height * M)));
    model.loads.push(Load::force("pull", "box", top, Vector::planar(force * N, 0 * N)));
    let run = comes_to(&model, 0.01).expect("one motion");
    assert_eq!(others(&run), []);
    let alpha = at(&run, 0.0, [run.equations.model().bodies[0].kinematics().alpha()])[0];
    let inertia = (width * width + height * height) / 3.0;
    let expected = -(force * height - G * width / 2.0) / inertia;
    assert!((alpha - expected).abs() < 1e-9 * expected.abs(), "{alpha} {expected}");
}

/// Four boxes on each other, eight contacts: too many to try all choices. Little friction is certain by itself; of much it is said that nobody looked.
#[test]
fn of_many_contacts_little_friction_is_certain_and_of_much_it_is_said_that_it_was_not_examined() {
    for (mu, expected) in [(0.05, vec![]), (2.0, vec![(0.0, Others::Unexamined)])] {
        let boxes = (0..4).map(|index| {
            let y = 0.05 + 0.1 * f64::from(index);
            // Each narrower than the one below, so that its corners stand on it.
            let width = 0.5 - 0.1 * f64::from(index);
            (plate(&format!("b{index}"), [width, 0.1], 1.0), start([0.0, y], 0.0, [0.0, 0.0], 0.0))
        });
        let mut model = model(G, boxes.collect());
        model.surface(Surface::floor("floor", 0 * M, rigid(0.0)).with_friction(Friction::new(mu)));
        model.contact(BodyContact::of_all("hit", Expr::zero()).with_friction(Friction::new(mu)));
        let run = comes_to(&model, 0.1).expect("a motion");
        assert_eq!(others(&run), expected, "{mu}");
    }
}
