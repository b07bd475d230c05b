//! Cones of friction in free-body diagrams, as wide as the coefficient that counts: the kinetic one where a contact slides, else the static one.

use tumble_drawing::free_body::{FreeBodyDiagram, FrictionCone};
use tumble_mech::{Force, Grip, Impulse, Law, Run, Source};
use tumble_ode::Side;

use crate::figures::symbols;
use crate::results::CaseError;

/// The cones of the contacts that press on the body of a diagram.
pub(super) fn of_forces(
    run: &Run,
    panel: &FreeBodyDiagram,
    own: &[Force],
    time: f64,
) -> Result<Vec<FrictionCone>, CaseError> {
    let place = panel.pose.centre();
    let normals = own.iter().filter(|force| force.law == Law::Contact && force.force != [0.0; 2]);
    let cone = |normal: &Force| {
        let Some(index) = run.equations.pairs().iter().position(|pair| pair.name == normal.load) else {
            return Ok(None);
        };
        let is_of_it =
            |force: &&Force| force.law == Law::Friction && symbols::rubbed(&force.load) == normal.load;
        let friction = own.iter().find(is_of_it).map_or([0.0; 2], |force| force.force);
        let coefficient = coefficient(run, index, time, slides(run, index, time))?;
        let point = [place[0] + normal.arm[0], place[1] + normal.arm[1]];
        Ok(coefficient.map(|coefficient| FrictionCone { point, normal: normal.force, friction, coefficient }))
    };
    normals.filter_map(|normal| cone(normal).transpose()).collect()
}

/// The same of an impact, by impulses.
pub(super) fn of_impulses(
    run: &Run,
    panel: &FreeBodyDiagram,
    own: &[&Impulse],
    time: f64,
) -> Result<Vec<FrictionCone>, CaseError> {
    let place = panel.pose.centre();
    let mut cones = vec![];
    for normal in own {
        let Source::Pair(index) = normal.source else { continue };
        let friction = own.iter().find(|one| one.source == Source::Friction(index));
        let friction = friction.map_or([0.0; 2], |friction| friction.impulse);
        let point = [place[0] + normal.arm[0], place[1] + normal.arm[1]];
        let coefficient = coefficient(run, index, time, false)?;
        cones.extend(coefficient.map(|coefficient| FrictionCone {
            point,
            normal: normal.impulse,
            friction,
            coefficient,
        }));
    }
    Ok(cones)
}

/// The coefficient of a contact with friction.
fn coefficient(run: &Run, pair: usize, time: f64, slides: bool) -> Result<Option<f64>, CaseError> {
    let Some(friction) = &run.equations.pairs()[pair].friction else { return Ok(None) };
    let formula = if slides { &friction.kinetic } else { &friction.of_rest };
    let found = run.observe(std::slice::from_ref(formula))?.at(time, Side::After);
    Ok(found.map(|values| values[0]))
}

fn slides(run: &Run, pair: usize, time: f64) -> bool {
    let own = run.of_body(run.equations.pairs()[pair].body);
    let motion = own.trajectory();
    let mode = motion.place_at(time, Side::After).map(|place| &motion.modes[place.mode]);
    mode.and_then(|mode| mode.grip(pair)).is_some_and(|grip| !Grip::is_still(grip))
}
