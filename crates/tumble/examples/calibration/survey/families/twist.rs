//! Bodies that turn on a wire.
//!
//! # Law
//!
//! I theta'' = -k (theta - rest) - c theta', with the moment of inertia of a disk, a ring, a ball, a shell or a rod.
//!
//! # Closed form
//!
//! That of a damped swing, [`Oscillator`].
//!
//! # Source
//!
//! Landau and Lifshitz, Mechanics, §§ 25 and 32.

use super::super::oscillator::{Oscillator, State};
use super::super::real::Real;
use super::super::setup::{At, Problem, Setup};
use super::super::units::{ENERGY, LENGTH, MASS, Measure, NUMBER, RATE, TIME};

/// N m s
const DAMPING: Measure = Measure([2, -1, 1]);
/// Round shapes, and their moments of inertia in units of m r^2 as a fraction.
const ROUND: [(&str, [i64; 2]); 4] =
    [("disk", [1, 2]), ("ring", [1, 1]), ("ball", [2, 5]), ("shell", [2, 3])];
/// Radians of a run.
const PHASES: [f64; 2] = [0.5, 100.0];
/// Damping in parts of the critical.
const DAMPINGS: [f64; 2] = [0.003, 2.0];

pub(super) fn make(mut setup: Setup) -> Problem {
    let mass = setup.given("mass", 1.0, MASS);
    let (shape, arm) = shape(&mut setup);
    let inertia = &mass.value * arm;
    let stiffness = setup.given("stiffness", 1.0, ENERGY);
    let critical = (&stiffness.value * &inertia).sqrt() * 2;
    let part = setup.draw.pick(&[0.0, 1.0]) * setup.draw.log_between(DAMPINGS[0], DAMPINGS[1]);
    let damping = setup.near("damping", &(critical * Real::of(part)), DAMPING);
    let phases = Real::of(setup.draw.log_between(PHASES[0], PHASES[1]));
    let pace = (&stiffness.value / &inertia).sqrt();
    let until = setup.near("until", &(phases / &pace), TIME);
    let sizes = [3.0, 2.0, 2.0].map(|most| setup.draw.between(-most, most));
    let rest = setup.angle("rest", sizes[0]);
    let start = setup.angle("start", sizes[1]);
    let rate = sizes[2] * pace.to_f64() * setup.units.size(TIME);
    let omega = setup.omega("omega", rate);
    setup.write(&format!(
        "[body.p]
        {shape}
        mass = \"{mass}\"
        start = {{ angle = \"{start}\", omega = \"{omega}\" }}
        [torsion.wire]
        on = \"p\"
        stiffness = \"{stiffness}\"
        rest_angle = \"{rest}\"
        damping = \"{damping}\""
    ));
    let system = Oscillator { stiffness: &stiffness.value / &inertia, damping: &damping.value / &inertia };
    let begin = State { x: &start.value - &rest.value, v: omega.value.clone() };
    let then = setup.moment("then", &until);
    for (at, time) in [(At::End, &until), (At::After(then.word.clone()), &then)] {
        let State { x, v } = system.free(&begin, &time.value);
        setup.ask("p.angle", at.clone(), &(x + &rest.value), NUMBER);
        setup.ask("p.omega", at, &v, RATE);
    }
    let energy = |state: &State| &inertia * state.v.squared() / 2;
    let end = system.free(&begin, &until.value);
    setup.ask("p.kinetic", At::End, &energy(&end), ENERGY);
    setup.ask("wire.work", At::End, &(energy(&end) - energy(&begin)), ENERGY);
    setup.problem("0 m/s^2", &until)
}

/// The line of a shape, and its moment of inertia for a mass of one.
fn shape(setup: &mut Setup) -> (String, Real) {
    let size = setup.given("size", 1.0, LENGTH);
    if setup.draw.chance(0.3) {
        let line = format!("rod = {{ from = [\"-{size}\", 0], to = [\"{size}\", 0] }}");
        return (line, size.value.squared() / 3);
    }
    let (name, [above, below]) = setup.draw.pick(&ROUND);
    (format!("{name} = {{ radius = \"{size}\" }}"), size.value.squared() * above / below)
}
