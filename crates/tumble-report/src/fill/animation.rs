//! The motion as it plays in the page, and the picture of its start.

use std::collections::BTreeMap;

use crate::report::Picture;
use tumble_drawing::curves::Mark;
use tumble_drawing::free_body::{Arrow, NamedPoint};
use tumble_drawing::{
    Animation, Label, LinkKind, MovingBody, MovingCase, MovingForce, MovingLink, Pose, SceneBody,
    SceneDrawing, SceneLink,
};
use tumble_expr::{Vector, is_identically_zero};
use tumble_mech::{Body, Forces, Gravity, Interaction, Law, Record, Run, joined};
use tumble_ode::{Occurrence, Side};
use tumble_scene::{Knob, Study};

use super::names::Names;
use super::{wind_at_origin, words};
use crate::figures::free_bodies::kind;
use crate::figures::{captions, case_label, poses, surfaces, symbols, with_strings};
use crate::report::END_OF_DIGITS;
use crate::results::{Case, CaseError, equal_times};

/// Frames of a run: smooth at the speed at which it first plays.
const FRAMES: usize = 192;
/// Part of a body's reach within which a point of it is where a joint is.
const HELD: f64 = 1e-6;
/// More marks than this cannot be told apart on a slider.
const MOST_MARKS: usize = 40;

pub(super) fn of(study: &Study, cases: &[&Case]) -> Result<Animation, CaseError> {
    let motions = cases.iter().map(|case| motion(&study.with(&case.parameters), case));
    Ok(Animation {
        title: Label::markup(&study.title),
        description: String::new(),
        cases: motions.collect::<Result<_, _>>()?,
        speed: 0.0,
    })
}

fn motion(study: &Study, case: &Case) -> Result<MovingCase, CaseError> {
    let run = &case.run;
    let times: Vec<f64> = equal_times(run, FRAMES).collect();
    let body = |body: &tumble_mech::Body| -> Result<MovingBody, CaseError> {
        Ok(MovingBody {
            name: Label::plain(&symbols::bare(&body.name)),
            outlines: with_strings(study, body)?,
            poses: poses(run, body, times.iter().copied())?,
            trail: study.model.pivot_of(&body.name).is_none(),
        })
    };
    let bodies = study.model.bodies.iter().map(body).collect::<Result<Vec<_>, _>>()?;
    Ok(MovingCase {
        name: case_label(case),
        values: swept(study, case),
        forces: forces(study, run, &times, &bodies)?,
        surfaces: surfaces(study, run, 0.0)?,
        points: pivots(study, run)?,
        events: marks(study, case),
        links: links(study, run, &times)?,
        bodies,
        times,
    })
}

/// What a reader may change and is not as the scene has it in this run, in the units of that.
fn swept(study: &Study, case: &Case) -> Vec<(String, f64)> {
    let values = case.parameters.values().unwrap_or_default();
    let known: BTreeMap<_, _> =
        case.parameters.symbols().into_iter().map(|symbol| symbol.name).zip(values).collect();
    let value = |knob: &Knob| Some((knob.name.clone(), known.get(knob.name.as_str())? / knob.size));
    let all = study.play.knobs.iter().filter_map(|knob| Some((knob, value(knob)?)));
    all.filter(|(knob, (_, value))| *value != knob.value).map(|(_, value)| value).collect()
}

/// Every load that acts at any time, by body and name.
fn forces(
    study: &Study,
    run: &Run,
    times: &[f64],
    bodies: &[MovingBody],
) -> Result<Vec<MovingForce>, CaseError> {
    let nothing = [[f64::NAN; 2]; 2];
    let mut observer = Forces::of(run);
    let mut found: BTreeMap<(usize, String), MovingForce> = BTreeMap::new();
    for (frame, time) in times.iter().enumerate() {
        for force in joined(&observer.at(*time, Side::After)?) {
            let pose: Pose = bodies[force.body].poses.get(frame).copied().unwrap_or_default();
            let entry = found.entry((force.body, force.load.clone())).or_insert_with(|| MovingForce {
                kind: kind(force.law),
                symbol: Label::symbol(&symbols::force(study, &force.load, force.law)),
                samples: vec![nothing; times.len()],
            });
            let point = [pose.x + force.arm[0], pose.y + force.arm[1]];
            entry.samples[frame] = [point, force.force];
        }
    }
    Ok(found
        .into_values()
        .filter(|force| force.samples.iter().any(|[_, f]| f[0].hypot(f[1]) > 0.0))
        .collect())
}

/// Pivots, where they are at the start.
fn pivots(study: &Study, run: &Run) -> Result<Vec<NamedPoint>, CaseError> {
    placed(run, study.model.pivots.iter().map(|pivot| (symbols::bare(&pivot.name), pivot.world.clone())))
}

/// Where named places are at the start.
fn placed(run: &Run, named: impl Iterator<Item = (String, Vector)>) -> Result<Vec<NamedPoint>, CaseError> {
    let mut found = vec![];
    for (name, place) in named {
        let Some(at) = run.observe(place.components())?.at(0.0, Side::After) else { continue };
        found.push(NamedPoint { name: Label::plain(&name), at: [at[0], at[1]] });
    }
    Ok(found)
}

/// What happens, unless that is too much, and where digits end.
fn marks(study: &Study, case: &Case) -> Vec<Mark> {
    let run = &case.run;
    let what = |event: &Occurrence<Record>| words::event(study, run, event);
    let events: Vec<Mark> =
        run.events().map(|event| Mark { at: event.time, label: Label::plain(&what(event)) }).collect();
    let mut marks = if events.len() > MOST_MARKS { vec![] } else { events };
    let at = case.verified_until();
    if at.is_finite() {
        let next = marks.partition_point(|mark| mark.at <= at);
        marks.insert(next, Mark { at, label: Label::plain(END_OF_DIGITS) });
    }
    marks
}

/// Springs and dampers with the places of their ends.
fn links(study: &Study, run: &Run, times: &[f64]) -> Result<Vec<MovingLink>, CaseError> {
    let mut found = vec![];
    for interaction in &study.model.interactions {
        let Some([a, b]) = interaction.ends() else { continue };
        let formulas = [a.components(), b.components()].concat();
        let mut observer = run.observe(&formulas)?;
        let ends = times.iter().map(|time| match observer.at(*time, Side::After) {
            Some(at) => [[at[0], at[1]], [at[2], at[3]]],
            None => [[f64::NAN; 2]; 2],
        });
        found.push(MovingLink {
            name: Label::plain(interaction.name()),
            kind: if is_stiff(&**interaction) { LinkKind::Spring } else { LinkKind::Damper },
            ends: ends.collect(),
        });
    }
    Ok(found)
}

/// Whether it is more than a damper.
fn is_stiff(interaction: &dyn Interaction) -> bool {
    let stiffness = interaction.dimensions().into_iter().find(|(name, ..)| *name == "stiffness");
    stiffness.is_none_or(|(_, value, _)| !is_identically_zero(&value))
}

/// The scene at its start.
pub(super) fn drawing(study: &Study, names: &Names, case: &Case) -> Result<Option<Picture>, CaseError> {
    let run = &case.run;
    let bodies = study.model.bodies.iter().map(|body| scene_body(study, names, run, body));
    let links = links(study, run, &[0.0])?.into_iter().map(|link| SceneLink {
        name: link.name,
        kind: link.kind,
        ends: link.ends.first().copied().unwrap_or_default(),
    });
    let drawing = SceneDrawing {
        title: Label::default(),
        bodies: bodies.collect::<Result<_, _>>()?,
        surfaces: surfaces(study, run, 0.0)?,
        pivots: pivots(study, run)?,
        points: points(study, run)?,
        links: links.collect(),
        forces: applied(study, run)?,
        gravity: gravity(study)?,
        wind: wind(study, run)?,
    };
    Ok(Some(Picture::new(drawing.svg(), captions::scene(&drawing))))
}

/// Joints that hold from the start, and points of bodies that none of them and no pivot holds.
fn points(study: &Study, run: &Run) -> Result<Vec<NamedPoint>, CaseError> {
    let model = &study.model;
    let joints = model.joints.iter().filter(|joint| joint.from.is_none());
    let mut found = placed(run, joints.map(|joint| (symbols::bare(&joint.name), joint.ends[0].position())))?;
    let held = [found.clone(), pivots(study, run)?].concat();
    for body in &model.bodies {
        let near = HELD * study.number(&body.reach())?;
        let is_free = |point: &NamedPoint| {
            held.iter().all(|one| (one.at[0] - point.at[0]).hypot(one.at[1] - point.at[1]) > near)
        };
        let own = body.points.iter().map(|(name, at)| (name.clone(), body.at(at).position()));
        found.extend(placed(run, own)?.into_iter().filter(is_free));
    }
    Ok(found)
}

/// Forces of the scene's own that act at the start.
fn applied(study: &Study, run: &Run) -> Result<Vec<Arrow>, CaseError> {
    let forces = joined(&Forces::of(run).at(0.0, Side::After)?).into_iter();
    let own = forces.filter(|force| force.law == Law::Force && force.force != [0.0; 2]);
    let arrow = |force: tumble_mech::Force| {
        let body = &study.model.bodies[force.body];
        let [x, y] = poses(run, body, [0.0].into_iter())?.pop().unwrap_or_default().centre();
        let symbol = Label::symbol(&symbols::force(study, &force.load, force.law));
        Ok(Arrow::new(kind(force.law), symbol, [x + force.arm[0], y + force.arm[1]], force.force))
    };
    own.map(arrow).collect()
}

fn scene_body(study: &Study, names: &Names, run: &Run, body: &Body) -> Result<SceneBody, CaseError> {
    let motion = body.kinematics();
    let v = motion.velocity();
    let formulas = [v.x().clone(), v.y().clone(), motion.omega()];
    let values = run.observe(&formulas)?.at(0.0, Side::After).unwrap_or(vec![0.0; 3]);
    let moves = values[0].hypot(values[1]) > 0.0 && study.model.pivot_of(&body.name).is_none();
    let rate = (values[2] != 0.0).then(|| (values[2], names.label(&motion.omega_symbol().name)));
    Ok(SceneBody {
        name: Label::plain(&symbols::bare(&body.name)),
        pose: poses(run, body, [0.0].into_iter())?.pop().unwrap_or_default(),
        outlines: with_strings(study, body)?,
        velocity: moves
            .then(|| ([values[0], values[1]], Label::symbol(&symbols::velocity(study, &body.name)))),
        rate,
    })
}

fn gravity(study: &Study) -> Result<Option<([f64; 2], Label)>, CaseError> {
    let Gravity::Vertical(g) = &study.model.gravity else { return Ok(None) };
    let value = study.number(g)?;
    Ok((value != 0.0).then(|| ([0.0, -value], Label::symbol("g"))))
}

/// The air at the start, at the world's origin.
fn wind(study: &Study, run: &Run) -> Result<Option<([f64; 2], Label)>, CaseError> {
    let at = run.observe(wind_at_origin(study).components())?.at(0.0, Side::After).unwrap_or(vec![0.0; 2]);
    Ok((at[0].hypot(at[1]) > 0.0).then(|| ([at[0], at[1]], Label::symbol("w"))))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn described(name: &str) -> String {
        let (study, cases) = crate::scenes::motions_called(name);
        let names = Names::of(&study).expect("names");
        drawing(&study, &names, &cases[0]).expect("a drawing").expect("a picture").svg.description
    }

    #[test]
    fn the_start_shows_joints_by_their_names_and_forces_that_act() {
        let linkage = described("13-four-bar-linkage");
        assert!(linkage.contains("Point A at") && !linkage.contains("Point end"), "{linkage}");
        let kicked = described("04-kicked-ball");
        assert!(kicked.contains("Force F (200, 0) N at (\u{2212}0.09798, 0.05) m."), "{kicked}");
    }
}
