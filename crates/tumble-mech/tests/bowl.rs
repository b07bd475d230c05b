//! Circles that bodies meet from inside and outside; against closed forms.

use crate::common::{at, close, rigid, run};
use tumble_expr::units::{KG, M, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{Body, Change, Friction, Gravity, Happening, Model, Run, Shape, Start, Surface};

const G: f64 = 9.81;

/// A disk of 10 cm radius in gravity and a surface.
fn disk_on(surface: Surface, place: [f64; 2], velocity: [f64; 2], omega: f64) -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    let start = Start::default().at(place.map(|x| x * M)).velocity(velocity.map(|v| v * M / S));
    model.starts.push(("disk".into(), start.omega(omega / S)));
    let centre = Vector::planar(0 * M, 0 * M);
    model.add(Body::of_shape("disk", Shape::Disk { centre, radius: 0.1 * M }).mass(2 * KG));
    model.surface(surface);
    model
}

fn state(run: &Run, time: f64) -> [f64; 5] {
    let body = run.equations.model().bodies[0].kinematics();
    let (c, v) = (body.position(), body.velocity());
    at(run, time, [c.x().clone(), c.y().clone(), v.x().clone(), v.y().clone(), body.omega()])
}

fn changes(run: &Run, change: Change) -> Vec<f64> {
    let is_it =
        |happening: &Happening| matches!(happening, Happening::Contact { change: own, .. } if *own == change);
    run.events().filter(|event| event.record.happened.iter().any(is_it)).map(|event| event.time).collect()
}

/// Rolling in a bowl a disk is a pendulum of length L = R - r with the inertia of 3/2 its mass: from rest at an angle the speed at the
/// bottom is `sqrt(4/3 g L (1 - cos))`, small swings have the rate `sqrt(2 g/(3 L))`, and the energy is kept.
#[test]
fn a_disk_rolls_in_a_bowl() {
    let length: f64 = 0.9;
    for angle in [0.01_f64, 1.0] {
        let bowl = Surface::bowl("bowl", [0 * M, 0 * M], 1 * M, rigid(0.0))
            .with_friction(Friction::new(Expr::from(2.0)));
        let place = [length * angle.sin(), -length * angle.cos()];
        let rate = (2.0 * G / (3.0 * length)).sqrt();
        // Of a pendulum of this swing: 2 K(sin(angle/2))/pi, by the mean of arithmetic and geometric means.
        let (mut a, mut b) = (1.0, (angle / 2.0).cos());
        for _ in 0..8 {
            (a, b) = (0.5 * (a + b), (a * b).sqrt());
        }
        let quarter = std::f64::consts::FRAC_PI_2 / (rate * a);
        let run = run(disk_on(bowl, place, [0.0, 0.0], 0.0), 5.0 * quarter, 1e-13);
        assert_eq!(changes(&run, Change::Rolls), [0.0]);
        assert!(changes(&run, Change::End).is_empty() && changes(&run, Change::Slides).is_empty());
        let speed = (4.0 / 3.0 * G * length * (1.0 - angle.cos())).sqrt();
        let [x, y, vx, vy, omega] = state(&run, quarter);
        close(x, 0.0, 1e-11);
        close(y, -length, 1e-12);
        close(vx, -speed, 1e-11);
        close(vy, 0.0, 1e-11);
        // It moves to the left, and the bottom of the bowl turns it to the left.
        close(omega, speed / 0.1, 1e-10);
        let [x, y, ..] = state(&run, 4.0 * quarter);
        close(x, place[0], 1e-11);
        close((x * x + y * y).sqrt(), length, 1e-13);
    }
}

/// From the middle it falls past where the centres meet, and on the bottom bounces.
#[test]
fn a_disk_falls_from_the_centre_of_a_bowl() {
    let bowl = Surface::bowl("bowl", [0 * M, 0 * M], 1 * M, rigid(0.5));
    let run = run(disk_on(bowl, [0.0, 0.0], [0.0, 0.0], 0.0), 0.5, 1e-12);
    let fall = (2.0 * 0.9 / G).sqrt();
    close(changes(&run, Change::Impact)[0], fall, 1e-13);
    let [_, y, _, vy, _] = state(&run, 0.5);
    let left = 0.5 - fall;
    close(vy, 0.5 * G * fall - G * left, 1e-12);
    close(y, -0.9 + 0.5 * G * fall * left - 0.5 * G * left * left, 1e-12);
}

/// Without friction it leaves a circle from outside at the height where `cos = 2/3`.
#[test]
fn a_disk_slides_off_a_circle() {
    let pole = Surface::circle("pole", [0 * M, 0 * M], 0.9 * M, rigid(0.0));
    let tilt: f64 = 1e-3;
    let run = run(disk_on(pole, [tilt.sin(), tilt.cos()], [0.0, 0.0], 0.0), 2.5, 1e-12);
    let ends = changes(&run, Change::End);
    assert_eq!(ends.len(), 1);
    let [x, y, vx, vy, _] = state(&run, ends[0]);
    close(y, 2.0 / 3.0 * tilt.cos(), 1e-11);
    close((x * x + y * y).sqrt(), 1.0, 1e-13);
    close(vx * vx + vy * vy, 2.0 * G * (tilt.cos() - y), 1e-11);
}
