//! Forces, laws and equations of motion, as they were integrated.

use crate::report::{BodyModel, ModelPart, Picture, Text, Typeset};
use tumble_mech::{Application, Change, Happening, MultipleImpacts, Painleve, Record};
use tumble_ode::Occurrence;
use tumble_scene::{FreeBody, Study};

use super::alike::{self, Kind};
use super::names::Names;
use super::once::{self, BY_LAWS, BY_NAME};
use super::passed::{self, Passed};
use super::{equations, forces, impacts, laws};
use crate::figures::{captions, free_bodies, instants, symbols};
use crate::results::{Case, CaseError};

/// Runs of a sweep among which one is looked for whose diagrams show most.
const MOST_LOOKED_AT: usize = 12;
pub(super) fn of(study: &Study, names: &Names, cases: &[Case]) -> Result<ModelPart, CaseError> {
    let drawn = if cases.len() > 1 { fullest(study, cases)? } else { &cases[0] };
    let passed = passed::by_body(cases);
    let kinds = alike::kinds(study, &passed);
    let mut said = vec![];
    let bodies =
        kinds.iter().map(|kind| one(study, names, (cases, drawn, &passed[kind.shown]), kind, &mut said));
    let bodies: Vec<BodyModel> = bodies.collect::<Result<_, _>>()?;
    let mut modes = equations::modes(study, names, cases, &kinds);
    // What the laws have said the equations do not say again.
    let rows = bodies.iter().flat_map(|body| body.forces.iter().chain(&body.impulses));
    let rows = rows.flat_map(|row| row.law.iter().chain(&row.torque));
    let laws = bodies.iter().flat_map(|body| &body.laws).flat_map(|law| &law.definitions);
    let said: Vec<&Typeset> = rows.chain(laws.map(|definition| &definition.symbol)).collect();
    let equations = modes.iter_mut().flat_map(|mode| &mut mode.equations);
    equations.for_each(|block| block.definitions.retain(|definition| !said.contains(&&definition.symbol)));
    let laws: Vec<&Typeset> = bodies.iter().flat_map(|body| &body.laws).flat_map(|law| &law.lines).collect();
    let acts = bodies.iter().any(|body| !(body.forces.is_empty() && body.impulses.is_empty()));
    once::say_once(&mut modes, &laws, if acts { BY_NAME } else { BY_LAWS });
    Ok(ModelPart {
        intro: vec![],
        assumptions: assumptions(study, cases),
        bodies,
        modes,
        impacts: impacts::laws(study, names, cases),
    })
}

/// How many contacts strike at an instant.
fn impacts_of(event: &Occurrence<Record>) -> usize {
    let strikes =
        |happening: &&Happening| matches!(happening, Happening::Contact { change: Change::Impact, .. });
    event.record.happened.iter().filter(strikes).count()
}

/// What the laws in use take for granted.
fn assumptions(study: &Study, cases: &[Case]) -> Vec<Text> {
    let model = &study.model;
    let most_at_once = cases.iter().flat_map(|case| case.run.events().map(impacts_of)).max().unwrap_or(0);
    let (surfaces, contacts) = (model.surfaces.iter(), model.contacts.iter());
    let of_bodies = model.bodies.iter().any(|body| body.friction.is_some());
    let of_pairs = contacts.clone().any(|contact| contact.friction.is_some());
    let is_rough = of_bodies || of_pairs || surfaces.clone().any(|surface| surface.friction.is_some());
    let frictions =
        surfaces.clone().map(|surface| &surface.friction).chain(contacts.clone().map(|own| &own.friction));
    let resists = frictions.flatten().any(|friction| friction.rolling.is_some());
    // A torque may be what rubs in a pivot.
    let is_turned = model.loads.iter().any(|load| matches!(load.application, Application::Torque(_)));
    let none = if is_turned { "no friction but for the torques that are stated." } else { "no friction." };
    let [pivots, joints] =
        ["Pivots have", "Pivots and joints are rigid and have"].map(|words| format!("{words} {none}"));
    // Else there is one only who could say it.
    let is_said_by_several = of_bodies
        || model.bodies.iter().any(|body| body.restitution.is_some())
        || contacts.clone().any(|contact| contact.surfaces(model).next().is_some());
    let (is_hard, are_many) = (most_at_once > 0, most_at_once > 1);
    let said = [
        (true, "The bodies are rigid and move in one plane."),
        (
            matches!(model.gravity, tumble_mech::Gravity::Horizontal(_)),
            "The plane is horizontal: weight and support cancel out of it.",
        ),
        (!model.pivots.is_empty() && model.joints.is_empty(), &*pivots),
        (!model.joints.is_empty(), &*joints),
        (
            model.joints.iter().any(|joint| joint.from.is_some()),
            "Bodies that are joined on the way are joined in an instant, by an impact without rebound.",
        ),
        (
            !model.surfaces.is_empty() && !is_rough,
            "Surfaces have no friction: they push along their normals only.",
        ),
        (
            is_rough,
            "Friction is dry: its coefficients do not depend on the speed, the pressure or the time at rest.",
        ),
        (resists, "Rolling resistance is a couple of lasting contacts; impacts know nothing of it."),
        (
            is_said_by_several,
            "Restitution and friction are those said for the pair; where nothing is, a body's own (of two bodies the lesser), else the surface's.",
        ),
        (
            surfaces.clone().any(|s| !s.law.is_rigid())
                || contacts.clone().any(|own| own.compliant.is_some()),
            "A compliant contact is a spring, with a damper where one is stated; the bodies keep their shapes.",
        ),
        (is_hard, "An impact takes no time."),
        (
            are_many && model.multiple_impacts == MultipleImpacts::Simultaneous,
            "Impacts of several contacts at one instant are one: all of them push until nothing approaches any more.",
        ),
        (
            is_hard && model.multiple_impacts == MultipleImpacts::Sequential,
            "Impacts of several contacts at one instant follow on each other, the fastest first; each is one of two bodies, and lets them part \
             before the next.",
        ),
        (
            model.painleve == Painleve::Impact,
            "Where friction leaves no forces that hold what slips (Painlevé's paradox), an impulse stops it: an impact without collision.",
        ),
    ];
    said.into_iter().filter(|(holds, _)| *holds).map(|(_, words)| words.into()).collect()
}

fn one(
    study: &Study,
    names: &Names,
    (cases, drawn, passed): (&[Case], &Case, &[Passed<'_>]),
    kind: &Kind,
    said: &mut Vec<String>,
) -> Result<BodyModel, CaseError> {
    let body = kind.shown;
    let names = &names.of_body(body);
    Ok(BodyModel {
        name: Text::from(kind.name(study)).capitalised(),
        diagrams: diagrams(study, drawn, body, said)?,
        forces: forces::of(study, names, passed, body),
        impulses: forces::impulses(study, names, body),
        laws: std::iter::once(laws::of(study, names, passed, body, said))
            .chain(impacts::of_body(study, names, cases, body, said))
            .collect(),
    })
}

/// Those that the scene asks for, else at instants that tell something.
fn diagrams(
    study: &Study,
    case: &Case,
    body: usize,
    said: &mut Vec<String>,
) -> Result<Vec<Picture>, CaseError> {
    let name = &study.model.bodies[body].name;
    let asked: Vec<&FreeBody> = study.free_bodies.iter().filter(|sheet| sheet.body == body).collect();
    let own = FreeBody {
        name: String::new(),
        title: Some(format!("Forces on {}", symbols::the(name))),
        body,
        at: if asked.is_empty() { instants::of(study, case, body)? } else { vec![] },
    };
    let sheets = if asked.is_empty() { vec![&own] } else { asked };
    let mut picture = |asked: &FreeBody| -> Result<Picture, CaseError> {
        let mut sheet = free_bodies::sheet(study, case, asked)?;
        // Below the figure they are read however narrow the page is.
        let notes = std::mem::take(&mut sheet.captions);
        let caption = captions::free_bodies(study, &sheet, name, said);
        let caption = notes.into_iter().fold(caption, |all, note| all.and(" ").and(note));
        let picture = Picture::new(sheet.svg(), caption);
        Ok(if asked.name.is_empty() { picture } else { picture.stored(format!("{}.svg", asked.name)) })
    };
    sheets.into_iter().map(&mut picture).collect()
}

/// The run for the diagrams: of those in which most loads are there the one that answers the scene's first question by the greatest value.
fn fullest<'a>(study: &Study, cases: &'a [Case]) -> Result<&'a Case, CaseError> {
    let mut best = (0, f64::NEG_INFINITY, &cases[0]);
    for case in cases.iter().take(MOST_LOOKED_AT) {
        let loads = instants::loads(case, study.model.bodies.len())?;
        let answer = case.finds.first().map(|find| find.value).filter(|value| value.is_finite());
        let answer = answer.unwrap_or(f64::NEG_INFINITY);
        if (loads, answer) > (best.0, best.1) {
            best = (loads, answer, case);
        }
    }
    Ok(best.2)
}

#[cfg(test)]
mod tests;
