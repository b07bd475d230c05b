//! Forces that are not unique: between which values they may be, and what of them is unique all the same.

use crate::common;

use crate::common::{close, rigid, run};
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{
    Anchor, Body, ContactMode, Friction, Gravity, Joint, Model, Part, Run, Shape, Spread, Start, Surface,
};
use tumble_ode::Side;

const G: f64 = 9.81;

/// Feet of 1 kg each on a floor, in a line along x.
fn bench(feet: &[f64]) -> Model {
    let foot = |x: &f64| Part {
        shape: Shape::Disk { centre: Vector::planar(*x * M, 0 * M), radius: 0.1 * M },
        mass: 1 * KG,
    };
    let centre = feet.iter().sum::<f64>() / feet.len() as f64;
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    model.starts.push(("bench".into(), Start::default().at([centre * M, 0.1 * M])));
    model.add(Body::from_parts("bench", feet.iter().map(foot).collect()));
    model.surface(Surface::floor("floor", 0 * M, rigid(0.0)));
    model
}

/// Forces of all pairs, in their order.
fn normals(run: &Run) -> Vec<Expr> {
    run.equations.pairs().iter().map(|pair| pair.force_symbol().into()).collect()
}

fn spreads(run: &Run, formulas: &[Expr]) -> Vec<Option<Spread>> {
    run.spreads(formulas, 0.5, Side::After).expect("formulas of the motion")
}

#[track_caller]
fn between(run: &Run, formula: &Expr, least: f64, greatest: f64) {
    let found = spreads(run, std::slice::from_ref(formula))[0].expect("it is not unique");
    for (found, known) in [(found.least, least), (found.greatest, greatest)] {
        if known.is_finite() { close(found, known, 1e-12) } else { assert_eq!(found, known) }
    }
}

#[track_caller]
fn unique(run: &Run, formula: &Expr) {
    assert_eq!(spreads(run, std::slice::from_ref(formula)), [None]);
}

#[test]
fn a_bench_on_three_feet() {
    let run = run(bench(&[-1.0, 0.0, 1.0]), 1.0, 1e-12);
    let feet = normals(&run);
    let weight = 3.0 * G;
    between(&run, &feet[0], 0.0, weight / 2.0);
    between(&run, &feet[1], 0.0, weight);
    between(&run, &feet[2], 0.0, weight / 2.0);
    between(&run, &(2 * &feet[1] + 1 * N), 1.0, 2.0 * weight + 1.0);
    between(&run, &(&feet[1] * &feet[1]), f64::NEG_INFINITY, f64::INFINITY);
    unique(&run, &(&feet[0] + &feet[1] + &feet[2]));
    unique(&run, &(&feet[0] - &feet[2]));
    let sum = &feet[0] + &feet[1] + &feet[2];
    unique(&run, &(&sum * &sum));
    unique(&run, &run.equations.model().bodies[0].kinematics().position().x().clone());
    assert!(run.is_open_within(&feet[0], [0.2, 0.3]).expect("a formula"));
    let open = run.open_forces(0, 0.5, Side::After).expect("forces");
    assert_eq!(open, ["floor.bench.part1.rim", "floor.bench.part2.rim", "floor.bench.part3.rim"]);
}

/// Feet at -1, 0 and 2 m about the centre of mass at 1/3 m: of `N1 + N2 + N3 = W` and `2 N3 - N1 = W / 3`.
#[test]
fn a_beam_on_three_supports_that_are_not_even() {
    let run = run(bench(&[-1.0, 0.0, 2.0]), 1.0, 1e-12);
    let feet = normals(&run);
    let weight = 3.0 * G;
    between(&run, &feet[0], 0.0, weight * 5.0 / 9.0);
    between(&run, &feet[1], 0.0, weight * 5.0 / 6.0);
    between(&run, &feet[2], weight / 6.0, weight * 4.0 / 9.0);
    unique(&run, &(2 * &feet[2] - &feet[0]));
}

/// Of six feet four are more than needed: any but an outer one may bear nothing, or what it bears with one other foot.
#[test]
fn a_bench_on_six_feet() {
    let places = [-2.0, -1.0, -0.5, 0.5, 1.0, 2.0];
    let run = run(bench(&places), 1.0, 1e-12);
    let feet = normals(&run);
    for (foot, place) in feet.iter().zip(places) {
        // As much as possible with the farthest foot of the other side.
        between(&run, foot, 0.0, 6.0 * G * 2.0 / (2.0 + f64::abs(place)));
    }
    unique(&run, &feet.iter().skip(1).fold(feet[0].clone(), |sum, foot| sum + foot));
}

/// All of it stands on the first foot: others could only pull.
#[test]
fn feet_that_nothing_may_load() {
    let mut model = bench(&[-1.0, 0.0, 1.0]);
    let place = tumble_mech::Place::Material(model.bodies[0].at(&Vector::planar(1 * M, 0 * M)));
    // It takes the load off all but the left foot.
    let force = Vector::planar(0 * N, 3.0 / 2.0 * G * N);
    model.loads.push(tumble_mech::Load::force("pull", "bench", place, force));
    let run = run(model, 1.0, 1e-12);
    let feet = normals(&run);
    assert_eq!(spreads(&run, &feet[..2]), [None, None]);
    assert!(!run.is_open_within(&feet[2], [0.0, 1.0]).expect("a formula"));
}

#[test]
fn two_feet_are_unique() {
    let run = run(bench(&[-1.0, 1.0]), 1.0, 1e-12);
    assert_eq!(spreads(&run, &normals(&run)), [None, None]);
}

/// A bench beside a body that rests by itself: that one is not concerned.
#[test]
fn another_body_is_unique() {
    let mut model = bench(&[-1.0, 0.0, 1.0]);
    let ball = Shape::Disk { centre: Vector::planar(0 * M, 0 * M), radius: 0.1 * M };
    model.add(Body::of_shape("ball", ball).mass(2 * KG));
    model.starts.push(("ball".into(), Start::default().at([5 * M, 0.1 * M])));
    let run = run(model, 1.0, 1e-12);
    let feet = normals(&run);
    unique(&run, &feet[3]);
    between(&run, &(&feet[0] + &feet[3]), 2.0 * G, 3.5 * G);
}

/// In a gap of just its width, what presses it from one side presses it from the other, however much.
#[test]
fn squeezed_between_walls() {
    let centre = Vector::planar(0 * M, 0 * M);
    let ball = Shape::Disk { centre, radius: 0.1 * M };
    let mut model = Model::new();
    model.add(Body::of_shape("ball", ball).mass(2 * KG));
    model.starts.push(("ball".into(), Start::default()));
    for (name, x, towards) in [("left", -0.1, 1.0), ("right", 0.1, -1.0)] {
        let normal = [Expr::from(towards), Expr::zero()];
        model.surface(Surface::new(name, [x * M, 0 * M], normal, rigid(0.0)));
    }
    let run = run(model, 1.0, 1e-12);
    let [left, right] = &normals(&run)[..] else { panic!("two pairs") };
    between(&run, left, 0.0, f64::INFINITY);
    unique(&run, &(left - right));
}

/// A rod that turns about one end and lies on two feet: the pivot bears what they do not.
#[test]
fn the_reaction_of_a_pivot_follows() {
    let mut model = bench(&[1.0, 3.0]);
    let bench = model.bodies[0].clone();
    model.starts[0].1 = Start::default();
    model.pivot_at("hinge", &bench, [0 * M, 0 * M], [0 * M, 0.1 * M]);
    let run = run(model, 1.0, 1e-12);
    let [near, far] = &normals(&run)[..] else { panic!("two feet") };
    let [_, up] = run.equations.model().pivots[0].force_symbols().map(Expr::from);
    // W 2 = N1 1 + N2 3, R = W - N1 - N2.
    let weight = 2.0 * G;
    between(&run, near, 0.0, 2.0 * weight);
    between(&run, far, 0.0, weight * 2.0 / 3.0);
    between(&run, &up, -weight, weight / 3.0);
    unique(&run, &(near + far + &up));
    unique(&run, &(near + 3 * far));
    let open = run.open_forces(0, 0.5, Side::After).expect("forces");
    assert_eq!(open, ["floor.bench.part1.rim", "floor.bench.part2.rim", "hinge"]);
}

/// Welded to the world above a floor that it just touches: the floor may push as much as it likes.
#[test]
fn a_foot_that_a_weld_keeps() {
    let mut model = bench(&[-1.0]);
    let ends = [Anchor::Material(model.bodies[0].cm()), Anchor::World(Vector::planar(-1 * M, 0.1 * M))];
    model.join(Joint::weld("weld", ends));
    let run = run(model, 1.0, 1e-12);
    let mode = &run.trajectory().modes[run.trajectory().pieces[0].mode];
    assert_eq!(mode.contact_mode(0), Some(ContactMode::Idle));
    let foot = &normals(&run)[0];
    let [x, y, torque] = run.equations.model().joints[0].multipliers().try_into().expect("three");
    let [x, y, torque] = [x, y, torque].map(Expr::from);
    between(&run, foot, 0.0, f64::INFINITY);
    between(&run, &y, f64::NEG_INFINITY, G);
    unique(&run, &(foot + &y));
    unique(&run, &x);
    unique(&run, &torque);
}

/// Three parallel cranks carry a coupler where two would do: along the cranks nothing says which of them bears how much.
#[test]
fn cranks_beside_each_other() {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    let point = |name: String, x: f64| (name, [x * M, 0 * M]);
    let mut coupler = Body::rod("coupler", [0 * M, 0 * M], [2 * M, 0 * M]).mass(1 * KG);
    for (name, place) in (0..3).map(|index| point(format!("p{index}"), f64::from(index))) {
        coupler = coupler.with_point(name, place);
    }
    for index in 0..3 {
        let crank = Body::rod(format!("crank{index}"), [0 * M, 0 * M], [0 * M, -1 * M]).mass(1 * KG);
        let crank = model.add(crank.with_point("tip", [0 * M, -1 * M]));
        model.pivot_at(format!("pivot{index}"), &crank, [0 * M, 0 * M], [f64::from(index) * M, 0 * M]);
        let ends = [crank.named_point("tip"), coupler.named_point(&format!("p{index}"))];
        model.join(Joint::pin(format!("pin{index}"), ends.map(|end| Anchor::Material(end.expect("given")))));
        model.starts.push((crank.name, Start::default().angle(Expr::from(0.3)).omega(3 / S)));
    }
    model.add(coupler);
    let run = run(model, 1.0, 1e-12);
    let joints = &run.equations.model().joints;
    let pins: Vec<Vec<Expr>> =
        joints.iter().map(|joint| joint.multipliers().into_iter().map(Expr::from).collect()).collect();
    for pin in &pins {
        between(&run, &pin[1], f64::NEG_INFINITY, f64::INFINITY);
    }
    unique(&run, &(&pins[0][1] + &pins[1][1] + &pins[2][1]));
    unique(&run, &(&pins[0][0] + &pins[1][0] + &pins[2][0]));
    // Across the crank its own motion says how much it bears.
    let angle = run.equations.model().bodies[0].kinematics().angle();
    unique(&run, &(&pins[1][0] * angle.cos() + &pins[1][1] * angle.sin()));
    let open = run.open_forces(1, 0.5, Side::After).expect("forces");
    assert_eq!(open, ["pin1", "pivot1"]);
}

/// Two-footed wagons pinned to each other: with each wagon after the first come one freedom and two feet.
fn train(wagons: usize, height: f64, restitution: f64) -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    model.surface(Surface::floor("floor", 0 * M, rigid(restitution)));
    let mut last: Option<Body> = None;
    for index in 0..wagons {
        let foot = |x: f64| Part {
            shape: Shape::Disk { centre: Vector::planar(x * M, 0 * M), radius: 0.1 * M },
            mass: 1 * KG,
        };
        let wagon = Body::from_parts(format!("wagon{index}"), [-0.3, 0.3].map(foot).to_vec());
        let wagon = wagon.with_point("front", [-0.5 * M, 0 * M]).with_point("back", [0.5 * M, 0 * M]);
        let wagon = model.add(wagon);
        if let Some(before) = &last {
            let ends = [before.named_point("back"), wagon.named_point("front")];
            let ends = ends.map(|end| Anchor::Material(end.expect("given")));
            model.join(Joint::pin(format!("coupling{index}"), ends));
        }
        let start = Start::default().at([index as f64 * M, (0.1 + height) * M]);
        model.starts.push((wagon.name.clone(), start));
        last = Some(wagon);
    }
    model
}

/// Many contacts on one island: it bounces, comes to rest on all feet, and they carry its weight.
#[test]
fn a_train_falls_on_its_feet() {
    for (wagons, restitution) in [(2, 0.0), (2, 0.4), (3, 0.4), (8, 0.0)] {
        let run = run(train(wagons, 0.05, restitution), 2.0, 1e-10);
        let mode = &run.trajectory().modes[run.trajectory().pieces.last().expect("a motion").mode];
        assert_eq!(mode.contacts.len(), 2 * wagons);
        // A line of wagons can move in as many ways as it has wagons, and two more, of which one is along the floor.
        let idle = mode.contacts.iter().filter(|(_, how)| *how == ContactMode::Idle).count();
        assert_eq!(idle, wagons - 1);
        let sum = normals(&run).iter().fold(0 * N, |sum, foot| sum + foot);
        close(common::at(&run, 1.9, [sum.clone()])[0], 2.0 * wagons as f64 * G, 1e-10);
        assert!(run.spreads(&[sum], 1.9, Side::After).expect("a formula")[0].is_none());
    }
}

/// The check runs, rounded in another way, let the same feet bear.
#[test]
fn which_feet_bear_is_not_left_to_rounding() {
    let accuracy = tumble_ode::Accuracy::new(1e-10).expect("positive");
    for model in [bench(&[-2.0, -1.0, -0.5, 0.5, 1.0, 2.0]), bench(&[-1.0, 0.0, 1.0]), train(5, 0.05, 0.0)] {
        let progress = |_: f64| std::ops::ControlFlow::Continue(());
        let (_, trust) = Run::trusted(&model, &model.parameters, 2.0, accuracy, progress).expect("a motion");
        assert!(trust.horizon.is_none(), "{:?}", trust.horizon);
    }
}

fn rough(surface: Surface, friction: f64) -> Surface {
    Surface { friction: Some(Friction::new(Expr::from(friction))), ..surface }
}

/// A ladder of 1 kg from a floor to a wall, rough at both ends. With n the push of the wall, the moments about the foot ask for friction of
/// `m g/2 - n b/a` there, which each cone bounds.
#[test]
fn a_ladder_that_is_rough_at_both_ends() {
    let (a, b, weight) = (3.0, 4.0, G);
    for (floor, wall) in [(0.4, 0.9), (0.5, 0.5), (0.9, 0.3)] {
        let mut model = Model::new();
        model.gravity = Gravity::Vertical(G * M / (S * S));
        model.add(Body::rod("ladder", [a * M, 0 * M], [0 * M, b * M]).mass(1 * KG));
        model.surface(rough(Surface::floor("floor", 0 * M, rigid(0.0)), floor));
        let upright = Surface::new("wall", [0 * M, 0 * M], [Expr::from(1), Expr::from(0)], rigid(0.0));
        model.surface(rough(upright, wall));
        let run = run(model, 1.0, 1e-12);
        let bears = |name: &str| {
            let mut own = run.equations.pairs().iter().filter(|pair| pair.name.starts_with(name));
            own.find(|pair| common::at(&run, 0.5, [pair.force_symbol().into()])[0] > 0.0).expect("it bears")
        };
        let least = weight * a / 2.0 / (b + wall * a);
        let by_wall = weight * a / 2.0 / (b - wall * a);
        let by_floor = floor * weight / 2.0 / (1.0 - floor * b / a);
        let most = if by_floor > 0.0 { by_wall.min(by_floor) } else { by_wall };
        between(&run, &bears("wall").force_symbol().into(), least, most);
        between(&run, &bears("floor").friction_symbol().into(), -most, -least);
        // Along the wall downwards.
        let friction = |n: f64| n * b / a - weight / 2.0;
        between(&run, &bears("wall").friction_symbol().into(), friction(least), friction(most));
    }
}

/// A block that sticks to a slope by both corners: what each bears along it is open within both cones, their sum is not.
#[test]
fn corners_share_friction_within_their_cones() {
    let (slope, friction, weight): (f64, f64, f64) = (0.3, 0.5, 2.0 * G);
    let (sin, cos) = slope.sin_cos();
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    let shape = Shape::Box { centre: Vector::planar(0 * M, 0 * M), width: 2 * M, height: 1 * M };
    model.add(Body::of_shape("block", shape).mass(2 * KG));
    let start = Start::default().at([-0.5 * sin * M, 0.5 * cos * M]).angle(Expr::from(slope));
    model.starts.push(("block".into(), start));
    let plane = Surface::new("slope", [0 * M, 0 * M], [Expr::from(-sin), Expr::from(cos)], rigid(0.0));
    model.surface(rough(plane, friction));
    let run = run(model, 1.0, 1e-12);
    let held: Vec<_> = run
        .equations
        .pairs()
        .iter()
        .filter(|pair| common::at(&run, 0.5, [pair.force_symbol().into()])[0] > 0.0)
        .collect();
    let normal: Vec<f64> =
        held.iter().map(|pair| common::at(&run, 0.5, [pair.force_symbol().into()])[0]).collect();
    close(normal[0] + normal[1], weight * cos, 1e-12);
    let forces: Vec<Expr> = held.iter().map(|pair| pair.friction_symbol().into()).collect();
    let all = common::at(&run, 0.5, [&forces[0] + &forces[1]])[0];
    close(all.abs(), weight * sin, 1e-12);
    unique(&run, &(&forces[0] + &forces[1]));
    for (own, other) in [(0, 1), (1, 0)] {
        let [most, others] = [own, other].map(|index| friction * normal[index]);
        between(&run, &forces[own], (-most).max(all - others), most.min(all + others));
    }
}
