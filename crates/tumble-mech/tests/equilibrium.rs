//! Poses of equilibrium, their reactions and the frequencies about them: closed forms.

use crate::common::{close, hinged_rod};
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{
    Anchor, Body, ContactLaw, Equations, Equilibrium, Gravity, Joint, Load, Model, NoEquilibrium, Place,
    Release, Shape, Spring, Stability, Start, Surface, Torsion,
};

const G: f64 = 9.81;

fn world() -> Model {
    Model { gravity: Gravity::Vertical(G * M / (S * S)), ..Model::new() }
}

fn found(model: &Model) -> Result<Equilibrium, NoEquilibrium> {
    Equations::new(model.clone()).expect("a model that fits together").equilibrium(&model.parameters)
}

fn equilibrium(model: &Model) -> Equilibrium {
    found(model).map_err(|error| error.to_string()).expect("an equilibrium")
}

fn turned(mut model: Model, body: &Body, angle: f64) -> Model {
    model.starts.push((body.name.clone(), Start { angle: Some(angle.into()), ..Start::default() }));
    model
}

#[track_caller]
fn force_of(found: &Equilibrium, name: &str) -> [f64; 2] {
    found.reactions.iter().find(|reaction| reaction.name == name).expect("a reaction of that name").force
}

#[track_caller]
fn all_close(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    found.iter().zip(expected).for_each(|(found, expected)| close(*found, *expected, tolerance));
}

/// A rod of 1 kg and 1 m hung up at its end: `w^2 = 3 g/(2 L)`, and the hinge carries the weight.
#[test]
fn a_hanging_pendulum() {
    let (model, rod) = hinged_rod();
    let found = equilibrium(&turned(model, &rod, 0.6));
    close(found.poses[0].angle, 0.0, 1e-11);
    all_close(&force_of(&found, "hinge"), &[0.0, G], 1e-11);
    assert_eq!(found.small_motions.stability(), Stability::Stable);
    all_close(&found.small_motions.frequencies, &[(1.5 * G).sqrt()], 1e-12);
}

/// A torsion spring holds a pendulum upright where k is above m g L/2: `w^2 = (k - m g L/2)/I`.
#[test]
fn an_inverted_pendulum() {
    let upright = std::f64::consts::PI;
    let with = |stiffness: f64| {
        let (mut model, rod) = hinged_rod();
        model.interact(Torsion {
            name: "wire".into(),
            body: rod.kinematics(),
            stiffness: stiffness * N * M,
            rest_angle: Expr::pi(),
            damping: 0 * N * M * S,
        });
        equilibrium(&turned(model, &rod, upright - 0.05))
    };
    let critical = G / 2.0;
    for stiffness in [0.0, 0.9 * critical, 1.1 * critical, 40.0] {
        let found = with(stiffness);
        close(found.poses[0].angle, upright, 1e-11);
        let square = (stiffness - critical) * 3.0;
        match square < 0.0 {
            true => {
                assert_eq!(found.small_motions.stability(), Stability::Unstable);
                close(found.small_motions.growing[0].rate, (-square).sqrt(), 1e-11);
            }
            false => all_close(&found.small_motions.frequencies, &[square.sqrt()], 1e-11),
        }
    }
}

/// A rod of mass m on two springs k that hang down from h above: it sags by m g/(2 k), bounces with `w^2 = 2 k/m`, rocks with
/// `6 k/m`, and swings with `g/h'` where h' is the length of the springs then.
#[test]
fn a_rod_on_two_springs() {
    let (mass, k) = (2.0, 150.0);
    let mut model = world();
    let rod = model.add(Body::rod("rod", [-1 * M, 0 * M], [1 * M, 0 * M]).mass(mass * KG));
    for side in [-1.0, 1.0] {
        let end = rod.at(&Vector::planar(side * M, 0 * M));
        model.interact(Spring {
            name: if side < 0.0 { "left" } else { "right" }.into(),
            ends: [Anchor::Material(end), Anchor::World(Vector::planar(side * M, 3 * M))],
            stiffness: k * N / M,
            rest_length: 3 * M,
            damping: 0 * KG / S,
        });
    }
    let found = equilibrium(&turned(model, &rod, 0.1));
    let sag = mass * G / (2.0 * k);
    all_close(&[found.poses[0].at[0], found.poses[0].at[1], found.poses[0].angle], &[0.0, -sag, 0.0], 1e-10);
    let expected = [G / (3.0 + sag), 2.0 * k / mass, 6.0 * k / mass].map(f64::sqrt);
    all_close(&found.small_motions.frequencies, &expected, 1e-9);
}

/// Three rods of mass m and length L pinned to a triangle that hangs from a corner: `w^2 = 2 g/(sqrt(3) L)`, the hinge carries all.
#[test]
fn a_triangle_of_rods() {
    let (mass, angle) = (0.7, 0.3_f64);
    let corners: Vec<[f64; 2]> = (0..3)
        .map(|corner| {
            let [x, y] = [[0.0, 0.0], [-0.5, -(0.75_f64.sqrt())], [0.5, -(0.75_f64.sqrt())]][corner];
            [x * angle.cos() - y * angle.sin(), x * angle.sin() + y * angle.cos()]
        })
        .collect();
    let place = |[x, y]: [f64; 2]| [x * M, y * M];
    let vector = |[x, y]: [f64; 2]| Vector::planar(x * M, y * M);
    let mut model = world();
    let sides: Vec<Body> = (0..3)
        .map(|side| {
            let ends = [corners[side], corners[(side + 1) % 3]].map(place);
            let [from, to] = ends;
            model.add(Body::rod(["a", "b", "c"][side], from, to).mass(mass * KG))
        })
        .collect();
    for corner in 0..3 {
        let at = |body: &Body| Anchor::Material(body.at(&vector(corners[corner])));
        let ends = [at(&sides[(corner + 2) % 3]), at(&sides[corner])];
        model.join(Joint { assemble: true, ..Joint::pin(["top", "left", "right"][corner], ends) });
    }
    model.join(Joint::pin(
        "nail",
        [Anchor::Material(sides[0].at(&vector(corners[0]))), Anchor::World(vector(corners[0]))],
    ));
    let found = equilibrium(&model);
    all_close(&force_of(&found, "nail"), &[0.0, 3.0 * mass * G], 1e-10);
    close(found.poses[1].at[0], 0.0, 1e-10);
    close(found.poses[1].at[1], -(0.75_f64.sqrt()), 1e-10);
    assert_eq!(found.small_motions.stability(), Stability::Stable);
    all_close(&found.small_motions.frequencies, &[(2.0 * G / 3.0_f64.sqrt()).sqrt()], 1e-10);
    // The lower rod hangs on both others alike, and each carries half of it and of what pulls at its own end.
    let left = force_of(&found, "left");
    close(left[1].abs(), mass * G / 2.0, 1e-10);
}

fn floor(law: ContactLaw) -> Surface {
    Surface::floor("floor", 0 * M, law)
}

/// A box on a floor, its centre of mass a third from the left: the left corner carries two thirds.
#[test]
fn a_loaded_box_on_a_floor() {
    let mut model = world();
    let shape = Shape::Box { centre: Vector::planar(0 * M, 0.5 * M), width: 3 * M, height: 1 * M };
    let crate_ = model.add(Body::of_shape("box", shape).mass(1 * KG));
    let at = Place::Material(crate_.at(&Vector::planar(-1.5 * M, 0.5 * M)));
    model.loads.push(Load::force("load", "box", at, Vector::planar(0 * N, -G * N)));
    model.surface(floor(ContactLaw::Rigid { restitution: Expr::zero() }));
    let found = equilibrium(&model);
    let forces: Vec<f64> = found.reactions.iter().map(|reaction| reaction.force[1]).collect();
    all_close(&forces, &[1.5 * G, 0.5 * G], 1e-11);
    assert_eq!((found.small_motions.stability(), found.small_motions.neutral), (Stability::Neutral, 1));
}

/// It sinks in by m g/k and bounces with `w^2 = k/m`; along the floor and in turning nothing pulls back.
#[test]
fn a_ball_on_a_soft_floor() {
    let mut model = world();
    let ball = model.add(Body::ball("ball", 0.5 * M).mass(2 * KG));
    model.starts.push((ball.name, Start::default().at([0 * M, 0.5 * M])));
    let (stiffness, damping) = (1000 * N / M, 3 * KG / S);
    model.surface(floor(ContactLaw::Spring { stiffness, damping, release: Release::AtSurface }));
    let found = equilibrium(&model);
    close(found.poses[0].at[1], 0.5 - 2.0 * G / 1000.0, 1e-12);
    all_close(&force_of(&found, "floor.ball.rim"), &[0.0, 2.0 * G], 1e-11);
    all_close(&found.small_motions.frequencies, &[(1000.0_f64 / 2.0).sqrt()], 1e-12);
    assert_eq!(found.small_motions.neutral, 2);
}

#[test]
fn what_falls_has_no_equilibrium() {
    let mut model = world();
    model.add(Body::ball("ball", 0.5 * M).mass(2 * KG));
    match found(&model) {
        Err(NoEquilibrium::NotFound { body, residual, unit }) => {
            assert_eq!((body.as_str(), unit), ("`ball`", "m/s^2"));
            close(residual, G, 1e-12);
        }
        other => panic!("{other:?}"),
    }
}

/// A force that follows the body, of a pendulum of two rods: with torsion springs it flutters beyond a load, and energy is no help.
#[test]
fn a_follower_force_makes_flutter() {
    let with = |load: f64| {
        let mut model = Model::new();
        let mut before: Option<Body> = None;
        for (name, from) in [("lower", 0.0), ("upper", 1.0)] {
            let rod = Body::rod(name, [from * M, 0 * M], [(from + 1.0) * M, 0 * M]);
            let rod = model.add(rod.mass(1 * KG));
            let near = Anchor::Material(rod.at(&Vector::planar(from * M, 0 * M)));
            let far = match &before {
                None => Anchor::World(Vector::planar(0 * M, 0 * M)),
                Some(before) => Anchor::Material(before.at(&Vector::planar(from * M, 0 * M))),
            };
            model.join(Joint::pin(format!("{name}.pin"), [near, far]));
            let bend = rod.kinematics().angle()
                - before.as_ref().map_or_else(Expr::zero, |before| before.kinematics().angle());
            model.torque(format!("{name}.spring"), &rod, -(1 * N * M) * &bend);
            if let Some(before) = &before {
                model.torque(format!("{name}.back"), before, 1 * N * M * bend);
            }
            before = Some(rod);
        }
        let tip = before.expect("two rods");
        let along = Vector::planar(
            -(load * N) * tip.kinematics().angle().cos(),
            -(load * N) * tip.kinematics().angle().sin(),
        );
        model.force("thrust", &tip.at(&Vector::planar(2 * M, 0 * M)), along);
        equilibrium(&model).small_motions
    };
    assert_eq!(with(1.0).stability(), Stability::Stable);
    let flutters = with(4.0);
    assert_eq!(flutters.stability(), Stability::Unstable);
    assert!(flutters.growing.iter().all(|growth| growth.frequency > 0.1), "{flutters:?}");
}
