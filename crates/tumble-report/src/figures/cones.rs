//! Cones of friction in free-body diagrams, as wide as the coefficient that counts: the kinetic one where a contact slides, else the static one.

use tumble_drawing::free_body::FrictionCone;
use tumble_mech::{Force, Grip, Impulse, Law, Run, Source};
use tumble_ode::Side;

use crate::figures::{free_bodies::size, symbols};
use crate::results::CaseError;

/// An impulse along the surface is no more than the kinetic coefficient gives, but for this part of it: rounding.
const ROUNDING: f64 = 1e-9;

/// What presses and rubs at a contact, by the index of its pair.
struct Pressed {
    pair: usize,
    arm: [f64; 2],
    normal: [f64; 2],
    friction: [f64; 2],
}

/// The cones of the contacts that press on a body with this centre, m.
pub(super) fn of_forces(
    run: &Run,
    centre: [f64; 2],
    own: &[Force],
    time: f64,
) -> Result<Vec<FrictionCone>, CaseError> {
    let pressed = own.iter().filter(|force| force.law == Law::Contact).filter_map(|normal| {
        let pair = run.equations.pairs().iter().position(|pair| pair.name == normal.load)?;
        let rubs = |force: &&Force| force.law == Law::Friction && symbols::rubbed(&force.load) == normal.load;
        let friction = own.iter().find(rubs).map_or([0.0; 2], |force| force.force);
        Some(Pressed { pair, arm: normal.arm, normal: normal.force, friction })
    });
    cones(run, centre, pressed, time, |pressed, _| slides(run, pressed.pair, time))
}

/// The same of an impact, by impulses: what the kinetic coefficient gives may have slid all along.
pub(super) fn of_impulses(
    run: &Run,
    centre: [f64; 2],
    own: &[&Impulse],
    time: f64,
) -> Result<Vec<FrictionCone>, CaseError> {
    let pressed = own.iter().filter_map(|normal| {
        let Source::Pair(pair) = normal.source else { return None };
        let friction = own.iter().find(|one| one.source == Source::Friction(pair));
        let friction = friction.map_or([0.0; 2], |friction| friction.impulse);
        Some(Pressed { pair, arm: normal.arm, normal: normal.impulse, friction })
    });
    cones(run, centre, pressed, time, |Pressed { normal, friction, .. }, kinetic| {
        size(*friction) <= kinetic * size(*normal) * (1.0 + ROUNDING)
    })
}

/// The cones of contacts with friction, by whether they slide, which the kinetic coefficient may tell.
fn cones(
    run: &Run,
    centre: [f64; 2],
    all: impl Iterator<Item = Pressed>,
    time: f64,
    slides: impl Fn(&Pressed, f64) -> bool,
) -> Result<Vec<FrictionCone>, CaseError> {
    let mut cones = vec![];
    for pressed in all {
        let Some(friction) = &run.equations.pairs()[pressed.pair].friction else { continue };
        let coefficients = [friction.of_rest.clone(), friction.kinetic.clone()];
        let Some(found) = run.observe(&coefficients)?.at(time, Side::After) else { continue };
        let coefficient = found[usize::from(slides(&pressed, found[1]))];
        let Pressed { arm, normal, friction, .. } = pressed;
        let point = [centre[0] + arm[0], centre[1] + arm[1]];
        cones.push(FrictionCone { point, normal, friction, coefficient });
    }
    Ok(cones)
}

fn slides(run: &Run, pair: usize, time: f64) -> bool {
    let own = run.of_body(run.equations.pairs()[pair].body);
    let motion = own.trajectory();
    let mode = motion.place_at(time, Side::After).map(|place| &motion.modes[place.mode]);
    mode.and_then(|mode| mode.grip(pair)).is_some_and(|grip| !Grip::is_still(grip))
}
