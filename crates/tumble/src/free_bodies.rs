//! Free-body diagrams: the forces that were integrated, at the instants the study asks for.

use tumble_mech::{Body, Force, Forces, Gravity, Impulse, Law, Run, Shape, Source, joined};
use tumble_ode::Side;
use tumble_report::free_body::{AngleMark, Arrow, Couple, FreeBody, Kind, Sheet, SideView, Surface};
use tumble_report::{Label, Pose};
use tumble_scene::{FreeBody as Asked, Study};

use crate::case::Case;
use crate::figures::{heading, outlines, poses, surfaces};
use crate::moments::Moments;
use crate::pipeline::PipelineError;
use crate::symbols;

/// Surfaces farther from the body than this many times its size are left out of its diagrams.
const NEAR: f64 = 1.5;
/// A couple below this part of the largest torque in a diagram is rounding of a resultant.
const ROUNDING: f64 = 1e-9;
/// A force below this part of the largest on a sheet, or an angle below it, is zero but for rounding.
const NOTHING: f64 = 1e-12;

/// One sheet: every instant that occurs, in order; a rigid impact has its impulses.
pub(crate) fn sheet(study: &Study, case: &Case, asked: &Asked) -> Result<Sheet, PipelineError> {
    let study = &study.with(&case.parameters);
    let moments = Moments::of(study, case.solution());
    let drawing = Drawing { study, run: &case.run, body: asked.body };
    let mut sheet = Sheet { title: heading(study, asked.title.as_deref(), &asked.name), ..Sheet::default() };
    let end = case.run.end().unwrap_or(0.0);
    let mut missing = vec![];
    for (instant, label) in &asked.at {
        match moments.time(instant)? {
            Some((time, _)) if (0.0..=end).contains(&time) => {
                sheet.panels.push(drawing.panel(label, time)?);
                sheet.captions.extend(drawing.not_unique(time)?);
            }
            _ => missing.push(instant.text.as_str()),
        }
    }
    without_rounding(&mut sheet);
    if !missing.is_empty() {
        sheet.captions.push(Label::plain(&format!("Not in this motion: {}.", missing.join(", "))));
    }
    Ok(sheet)
}

/// Makes forces zero that are so but for rounding: nobody is to look for what pulls with 1e-14 N.
fn without_rounding(sheet: &mut Sheet) {
    let sizes = sheet.panels.iter().flat_map(|panel| &panel.forces).map(|arrow| size(arrow.vector));
    let largest = sizes.fold(0.0, f64::max);
    let forces = sheet.panels.iter_mut().flat_map(|panel| &mut panel.forces);
    for arrow in forces.filter(|arrow| size(arrow.vector) < NOTHING * largest) {
        arrow.vector = [0.0; 2];
    }
}

fn size([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}

struct Drawing<'a> {
    study: &'a Study,
    run: &'a Run,
    body: usize,
}

impl Drawing<'_> {
    fn panel(&self, label: &str, time: f64) -> Result<FreeBody, PipelineError> {
        let body = &self.study.model.bodies[self.body];
        let pose = poses(self.run, body, [time].into_iter())?.pop().unwrap_or_default();
        let mut panel = FreeBody::new(Label::plain(&body.name), pose, outlines(self.study, body)?)
            .heading(Label::markup(label))
            .heading(Label::equation("t", &shown(time), "s"));
        let impulses: Vec<&Impulse> = self.impulses(time).collect();
        if impulses.is_empty() {
            self.add_forces(&mut panel, pose, time)?;
        } else {
            panel = panel.impulses();
            for impulse in impulses {
                let (kind, symbol) = self.source_of(impulse);
                if impulse.impulse != [0.0; 2] {
                    let point = [pose.x + impulse.arm[0], pose.y + impulse.arm[1]];
                    panel.forces.push(Arrow::new(kind, symbol.clone(), point, impulse.impulse));
                }
                if impulse.couple != 0.0 {
                    panel.couples.push(Couple::new(kind, symbol, impulse.couple));
                }
            }
        }
        for surface in self.surfaces(body, pose, time)? {
            panel = panel.surface(surface);
        }
        if let Some(reference) = self.direction(body)? {
            let symbol = self.symbol(&format!("{}.angle", body.name));
            let angle = if pose.angle.abs() < NOTHING { 0.0 } else { pose.angle };
            panel = panel.angle(AngleMark { reference, ..AngleMark::horizontal(symbol, angle) });
        }
        Ok(panel)
    }

    /// Which forces of a diagram may be others.
    fn not_unique(&self, time: f64) -> Result<Option<Label>, PipelineError> {
        let names = self.run.open_forces(self.body, time, Side::After)?.join(", ");
        let has_forces = !names.is_empty() && self.impulses(time).next().is_none();
        let text = format!("Not unique at {} s, more bear than are needed: {names}.", shown(time));
        Ok(has_forces.then(|| Label::plain(&text)))
    }

    /// Where a body points at angle zero, rad: along a rod, else to the right; `None` for one whose turning is not seen.
    fn direction(&self, body: &Body) -> Result<Option<f64>, PipelineError> {
        let Some(part) = body.parts.iter().find(|part| !part.shape.edges().is_empty()) else {
            return Ok(None);
        };
        let Shape::Rod { from, to, .. } = &part.shape else { return Ok(Some(0.0)) };
        let along = to - from;
        Ok(Some(self.study.number(along.y())?.atan2(self.study.number(along.x())?)))
    }

    fn add_forces(&self, panel: &mut FreeBody, pose: Pose, time: f64) -> Result<(), PipelineError> {
        let all = Forces::of(self.run).at(time, Side::After)?;
        let own: Vec<Force> = joined(&all).into_iter().filter(|force| force.body == self.body).collect();
        let largest = own.iter().map(|force| force.torque().abs()).fold(0.0, f64::max);
        for force in &own {
            let (kind, symbol) = (kind(force.law), symbols::force_label(self.study, &force.load, force.law));
            let is_force = !force.law.is_couple();
            if is_force {
                let point = [pose.x + force.arm[0], pose.y + force.arm[1]];
                panel.forces.push(Arrow::new(kind, symbol.clone(), point, force.force));
            }
            if !is_force || force.couple.abs() > ROUNDING * largest {
                let symbol = if is_force { Label::symbol(&format!("tau_{}", force.load)) } else { symbol };
                panel.couples.push(Couple::new(kind, symbol, force.couple));
            }
        }
        panel.side = self.side_view()?;
        Ok(())
    }

    /// Weight and support out of a horizontal plane.
    fn side_view(&self) -> Result<Option<SideView>, PipelineError> {
        let Gravity::Horizontal(g) = &self.study.model.gravity else { return Ok(None) };
        let body = &self.study.model.bodies[self.body];
        let weight = self.study.number(&(body.mass_properties().mass * g))?;
        let height = self.study.number(&body.reach())?;
        let outlines = outlines(self.study, body)?;
        let names = (symbols::weight(), weight);
        Ok((weight > 0.0).then(|| SideView::resting(outlines, height, names, (Label::symbol("N"), weight))))
    }

    /// Impulses on the body of a rigid impact at just this time.
    fn impulses(&self, time: f64) -> impl Iterator<Item = &Impulse> {
        let events = self.run.events().filter(move |event| event.time == time);
        let impulses = events.flat_map(|event| &event.record.impulses);
        impulses.filter(|impulse| impulse.body == self.body)
    }

    fn source_of(&self, impulse: &Impulse) -> (Kind, Label) {
        let kind = match impulse.source {
            Source::Pair(_) | Source::Friction(_) => Kind::Contact,
            Source::Pivot(_) | Source::Joint(_) => Kind::Reaction,
            Source::Applied(_) => Kind::Applied,
        };
        let name = self.run.equations.source_name(impulse.source);
        let place = symbols::contact(self.study, symbols::rubbed(name));
        let along = if matches!(impulse.source, Source::Friction(_)) { "_f" } else { "" };
        (kind, Label::symbol(&format!("J_{place}{along}")))
    }

    fn surfaces(&self, body: &Body, pose: Pose, time: f64) -> Result<Vec<Surface>, PipelineError> {
        let reach = self.study.number(&body.reach())?;
        let all = surfaces(self.study, self.run, time)?;
        let of_model = self.study.model.surfaces.iter();
        let met = all.into_iter().zip(of_model).filter(|(_, surface)| surface.meets(body));
        let mut found: Vec<Surface> = vec![];
        for Surface { point: [px, py], normal: [nx, ny], name } in met.map(|(drawn, _)| drawn) {
            let distance = nx * (pose.x - px) + ny * (pose.y - py);
            // The point of the surface that is nearest to the body.
            let foot = [pose.x - distance * nx, pose.y - distance * ny];
            if distance.abs() <= 2.0 * NEAR * reach.max(f64::MIN_POSITIVE) {
                found.push(Surface::new(foot, [nx, ny], name));
            }
        }
        Ok(found)
    }

    fn symbol(&self, name: &str) -> Label {
        let symbols = self.study.symbols.iter().map(|(name, symbol)| (&**name, &**symbol));
        match name.rsplit_once('.') {
            Some((_, "angle")) if !self.study.symbols.contains_key(name) => Label::symbol("theta"),
            _ => Label::name(name, &symbols.collect::<Vec<_>>()),
        }
    }
}

pub(crate) fn kind(law: Law) -> Kind {
    match law {
        Law::Weight => Kind::Weight,
        Law::Contact | Law::Friction => Kind::Contact,
        Law::Drag | Law::Lift => Kind::Air,
        Law::Spring | Law::Torsion => Kind::Spring,
        Law::Reaction => Kind::Reaction,
        Law::Force | Law::Torque => Kind::Applied,
    }
}

/// A time with as many digits as a reader can use.
fn shown(time: f64) -> String {
    let text = format!("{time:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
