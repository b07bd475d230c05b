//! Bodies that meet each other: cradles, collisions off the centre, pi from collisions; against closed forms.

use crate::common::{at, close, rigid, run};
use tumble_expr::units::{KG, M, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{Body, BodyContact, Friction, Model, MultipleImpacts, Run, Shape, Start, Surface};

fn disk(name: &str, radius: f64, mass: f64) -> Body {
    let centre = Vector::planar(0 * M, 0 * M);
    Body::of_shape(name, Shape::Disk { centre, radius: radius * M }).mass(mass * KG)
}

fn start(place: [f64; 2], velocity: [f64; 2]) -> Start {
    Start::default().at(place.map(|x| x * M)).velocity(velocity.map(|v| v * M / S))
}

/// Disks of 10 cm radius, of these masses, at these places with these velocities, that all meet.
fn disks(all: &[(f64, [f64; 2], [f64; 2])], contact: BodyContact) -> Model {
    let mut model = Model::new();
    for (index, (mass, place, velocity)) in all.iter().enumerate() {
        let name = format!("d{index}");
        model.starts.push((name.clone(), start(*place, *velocity)));
        model.add(disk(&name, 0.1, *mass));
    }
    model.contact(contact);
    model
}

/// vx, vy, omega
fn motion(run: &Run, body: usize, time: f64) -> [f64; 3] {
    let body = run.equations.model().bodies[body].kinematics();
    let v = body.velocity();
    at(run, time, [v.x().clone(), v.y().clone(), body.omega()])
}

/// One disk meets two at rest that touch.
fn cradle(rule: MultipleImpacts) -> Run {
    let all = [(1.0, [-0.5, 0.0], [1.0, 0.0]), (1.0, [0.0, 0.0], [0.0, 0.0]), (1.0, [0.2, 0.0], [0.0, 0.0])];
    let mut model = disks(&all, BodyContact::of_all("hit", 1));
    model.multiple_impacts = rule;
    run(model, 1.0, 1e-12)
}

#[test]
fn a_cradle_passes_the_impact_on_sequentially() {
    let run = cradle(MultipleImpacts::Sequential);
    for (body, speed) in [0.0, 0.0, 1.0].into_iter().enumerate() {
        close(motion(&run, body, 0.9)[0], speed, 1e-13);
    }
}

#[test]
fn a_cradle_parts_in_thirds_simultaneously() {
    let run = cradle(MultipleImpacts::Simultaneous);
    for (body, speed) in [-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0].into_iter().enumerate() {
        close(motion(&run, body, 0.9)[0], speed, 1e-13);
    }
}

/// A disk hits one at rest, its centre passing by the other's by half a diameter: the impulse is along the line of centres, 30 degrees
/// off.
#[test]
fn off_the_centre_without_friction() {
    let e = 0.5;
    let all = [(1.0, [-1.0, 0.1], [2.0, 0.0]), (3.0, [0.0, 0.0], [0.0, 0.0])];
    let run = run(disks(&all, BodyContact::of_all("hit", Expr::from(e))), 1.0, 1e-12);
    // n from the second to the first.
    let (nx, ny) = (-0.75_f64.sqrt(), 0.5);
    let push = (1.0 + e) * (-2.0 * nx) * 0.75;
    let [first, second] = [0, 1].map(|body| motion(&run, body, 0.9));
    close(first[0], 2.0 + push * nx, 1e-13);
    close(first[1], push * ny, 1e-13);
    close(second[0], -push * nx / 3.0, 1e-13);
    close(second[1], -push * ny / 3.0, 1e-13);
    assert_eq!([first[2], second[2]], [0.0, 0.0]);
    let hits = run.contacts();
    assert_eq!(hits.len(), 1);
    close(hits[0].start, (1.0 - 0.03_f64.sqrt()) / 2.0, 1e-14);
}

/// The same with friction. Of the tangential impulse a unit changes the slip by `1/m1 + 1/m2` and by twice as much through the turning
/// of both disks: it sticks for `s/(3 (1/m1 + 1/m2))`, where that is within the cone.
#[test]
fn off_the_centre_with_friction() {
    let all = [(1.0, [-1.0, 0.1], [2.0, 0.0]), (3.0, [0.0, 0.0], [0.0, 0.0])];
    let (e, m): (f64, f64) = (0.5, 0.75);
    let (nx, ny) = (-0.75_f64.sqrt(), 0.5);
    let (tx, ty) = (ny, -nx);
    let push = (1.0 + e) * (-2.0 * nx) * m;
    let slip = 2.0 * tx;
    for (mu, rub) in [(0.05, -0.05 * push), (0.9, -slip * m / 3.0)] {
        let contact = BodyContact::of_all("hit", Expr::from(e)).with_friction(Friction::new(Expr::from(mu)));
        let run = run(disks(&all, contact), 1.0, 1e-12);
        let [first, second] = [0, 1].map(|body| motion(&run, body, 0.9));
        close(first[0], 2.0 + push * nx + rub * tx, 1e-13);
        close(first[1], push * ny + rub * ty, 1e-13);
        close(second[0], -(push * nx + rub * tx) / 3.0, 1e-13);
        close(second[1], -(push * ny + rub * ty) / 3.0, 1e-13);
        // Torque of the tangential impulse at -r n on the first, I = m r^2/2.
        close(first[2], 0.1 * rub / (0.5 * 0.01), 1e-12);
        close(second[2], 0.1 * rub / (0.5 * 3.0 * 0.01), 1e-12);
    }
}

/// A heavy ball drives a light one against a wall: collisions of both kinds count the digits of pi.
#[test]
fn collisions_count_pi() {
    for (ratio, count) in [(1.0, 3), (100.0, 31), (1e4, 314)] {
        let all = [(1.0, [0.5, 0.0], [0.0, 0.0]), (ratio, [1.0, 0.0], [-1.0, 0.0])];
        let mut model = disks(&all, BodyContact::of_all("hit", 1));
        let wall = Surface::new("wall", [0 * M, 0 * M], [Expr::one(), Expr::zero()], rigid(1.0));
        model.surface(Surface { on: Some(vec!["d0".into()]), ..wall });
        let run = run(model, 10.0, 1e-12);
        assert_eq!(run.contacts().len(), count, "mass ratio {ratio}");
        let energy: f64 =
            [1.0, ratio].iter().enumerate().map(|(body, m)| m * motion(&run, body, 9.9)[0].powi(2)).sum();
        close(energy, ratio, 1e-12);
    }
}

/// Two of four disks meet, the others fly by: no motion is of more than the two, and each is alone before and after.
#[test]
fn bodies_are_one_motion_only_where_they_meet() {
    let all = [
        (1.0, [-1.0, 0.0], [1.0, 0.0]),
        (1.0, [1.0, 0.05], [-1.0, 0.0]),
        (1.0, [0.0, 3.0], [0.3, 0.0]),
        (1.0, [2.0, 3.0], [0.3, 0.1]),
    ];
    let run = run(disks(&all, BodyContact::of_all("hit", 1)), 3.0, 1e-12);
    assert_eq!(run.contacts().len(), 1);
    let bodies = |track: &tumble_ode::Motion<tumble_mech::Equations>| track.modes[0].bodies.clone();
    let of: Vec<Vec<usize>> = run.tracks().map(bodies).collect();
    assert_eq!(of.iter().filter(|own| own[..] == [0, 1]).count(), 1, "{of:?}");
    assert!([0, 1].into_iter().all(|body| of.iter().filter(|own| own[..] == [body]).count() == 2), "{of:?}");
    assert!([2, 3].into_iter().all(|body| of.iter().filter(|own| own[..] == [body]).count() == 1), "{of:?}");
}

/// Far from the origin places are rounded at every step, and each disk takes several: when they meet does not depend on it.
#[test]
fn when_they_meet_does_not_depend_on_where() {
    let far = [1.4e7, 1e10];
    let place = |[x, y]: [f64; 2]| [far[0] + x, far[1] + y];
    // Places and speeds that are exact there.
    let all =
        [(1.0, place([-7334.0, 1000.0]), [646.8125, 120.5]), (4.0, place([0.0, 0.0]), [-201.25, -90.0])];
    let mut model = Model::new();
    for (index, (mass, place, velocity)) in all.into_iter().enumerate() {
        let name = format!("d{index}");
        model.starts.push((name.clone(), start(place, velocity)));
        model.add(disk(&name, [400.0, 2850.5][index], mass));
    }
    model.contact(BodyContact::of_all("hit", Expr::from(0.5)));
    let run = run(model, 15.19, 1e-9);
    let ([x, y], [u, v], reach) = ([-7334.0, 1000.0], [848.0625, 210.5], 3250.5);
    let (a, b, c): (f64, f64, f64) = (u * u + v * v, x * u + y * v, x * x + y * y - reach * reach);
    let (found, known) = (run.contacts()[0].start, (-b - (b * b - a * c).sqrt()) / a);
    assert!(run.tracks().len() > 2 && (found - known).abs() < 4e-15 * known, "{found} {known}");
}
