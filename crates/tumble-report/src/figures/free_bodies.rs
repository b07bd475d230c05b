//! Free-body diagrams: the forces that were integrated, at the instants the study asks for.

use tumble_drawing::free_body::{
    AngleMark, Arrow, ArrowKind, Couple, FreeBodyDiagram, FreeBodySheet, Ground, SideView, Velocity,
};
use tumble_drawing::{Label, Pose};
use tumble_expr::Expr;
use tumble_mech::{Body, Force, Forces, Gravity, Impulse, Law, Rule, Run, Shape, Source, joined};
use tumble_ode::Side;
use tumble_scene::{FreeBody, Study};

use crate::figures::{
    air, case_label, cones, heading, joined as with_label, outlines, poses, surfaces, symbols,
};
use crate::results::moments::Moments;
use crate::results::{Case, CaseError};

/// Surfaces farther from the body than this many times its size are left out of its diagrams.
const NEAR: f64 = 1.5;
/// A gap below this part of the body's size is none.
const TOUCHED: f64 = 1e-6;
/// A force or torque below this part of the largest on a sheet is zero but for rounding, and so is an angle below it.
const NOTHING: f64 = 1e-12;
/// A torque below this part of the largest force times the size of the body is rounding of its arm.
const NO_TORQUE: f64 = 1e-9;
/// Speeds below this part of the body's size a second are those of a body at rest.
const AT_REST: f64 = 1e-9;

/// One sheet: every instant that occurs, in order; a rigid impact has its impulses.
pub(crate) fn sheet(study: &Study, case: &Case, asked: &FreeBody) -> Result<FreeBodySheet, CaseError> {
    let study = &study.with(&case.parameters);
    let moments = Moments::of(study, case.solution());
    let drawing = Drawing { study, run: &case.run, body: asked.body };
    let title = heading(study, asked.title.as_deref(), &asked.name);
    let mut sheet = FreeBodySheet { title: with_label(title, case_label(case)), ..FreeBodySheet::default() };
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
fn without_rounding(sheet: &mut FreeBodySheet) {
    let sizes = sheet.panels.iter().flat_map(|panel| &panel.forces).map(|arrow| size(arrow.vector));
    let largest = sizes.fold(0.0, f64::max);
    for panel in &mut sheet.panels {
        panel.cones.retain(|cone| size(cone.normal) >= NOTHING * largest);
        for arrow in panel.forces.iter_mut().filter(|arrow| size(arrow.vector) < NOTHING * largest) {
            arrow.vector = [0.0; 2];
        }
    }
}

pub(super) fn size([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}

struct Drawing<'a> {
    study: &'a Study,
    run: &'a Run,
    body: usize,
}

impl Drawing<'_> {
    fn panel(&self, label: &str, time: f64) -> Result<FreeBodyDiagram, CaseError> {
        let body = &self.study.model.bodies[self.body];
        let pose = poses(self.run, body, [time].into_iter())?.pop().unwrap_or_default();
        let panel =
            FreeBodyDiagram::new(Label::plain(&symbols::bare(&body.name)), pose, outlines(self.study, body)?)
                .heading(Label::markup(label))
                .heading(Label::equation("t", &shown(time), "s"));
        let impulses: Vec<&Impulse> = self.impulses(time).collect();
        let mut panel = match impulses.is_empty() {
            true => self.moving(self.with_forces(panel, time)?, time)?,
            false => self.with_impulses(panel, &impulses, time)?,
        };
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

    fn with_impulses(
        &self,
        panel: FreeBodyDiagram,
        all: &[&Impulse],
        time: f64,
    ) -> Result<FreeBodyDiagram, CaseError> {
        let cones = cones::of_impulses(self.run, panel.pose.centre(), all, time)?;
        let panel = all.iter().fold(panel.impulses(), |panel, one| self.with_impulse(panel, one));
        Ok(FreeBodyDiagram { cones, ..panel })
    }

    fn with_impulse(&self, mut panel: FreeBodyDiagram, impulse: &Impulse) -> FreeBodyDiagram {
        let (kind, name) = self.source_of(impulse);
        let symbol = self.signed(self.run.equations.source_name(impulse.source), &name);
        if impulse.impulse != [0.0; 2] {
            let point = [panel.pose.x + impulse.arm[0], panel.pose.y + impulse.arm[1]];
            panel = panel.force(Arrow::new(kind, symbol.clone(), point, impulse.impulse));
            let load = self.run.equations.source_name(impulse.source);
            panel = panel.arm(Label::symbol(&symbols::arm(&self.of_body(&name, load))), point);
        }
        if impulse.couple != 0.0 {
            panel = panel.couple(Couple::new(kind, symbol, impulse.couple));
        }
        panel
    }

    /// With the velocity of the centre and the angular velocity.
    fn moving(&self, panel: FreeBodyDiagram, time: f64) -> Result<FreeBodyDiagram, CaseError> {
        let body = &self.study.model.bodies[self.body];
        let motion = body.kinematics();
        let formulas = [motion.velocity().components(), &[motion.omega()]].concat();
        let values = self.run.observe(&formulas)?.at(time, Side::After).unwrap_or(vec![0.0; 3]);
        let least = AT_REST * self.study.number(&body.reach())?;
        let velocity = Velocity::new(
            &symbols::velocity(self.study, &body.name),
            panel.pose.centre(),
            [values[0], values[1]],
        );
        let panel = if size(velocity.vector) > least { panel.velocity(velocity) } else { panel };
        Ok(FreeBodyDiagram { rate: (values[2].abs() > AT_REST).then_some(values[2]), ..panel })
    }

    /// Which forces of a diagram may be others.
    fn not_unique(&self, time: f64) -> Result<Option<Label>, CaseError> {
        let open = self.open(time)?;
        let names = open.iter().map(|symbol| format!("${symbol}$")).collect::<Vec<_>>().join(", ");
        let has_forces = !names.is_empty() && self.impulses(time).next().is_none();
        let text = format!(
            "At {} s there are more unknown forces than equations, so these are not unique: {names}.",
            shown(time)
        );
        Ok(has_forces.then(|| Label::markup(&text)))
    }

    /// The symbols of all forces that may be others.
    fn open(&self, time: f64) -> Result<Vec<String>, CaseError> {
        let names = self.run.open_forces(self.body, time, Side::After)?;
        Ok(names.iter().map(|name| self.open_parts(name, time)).collect::<Result<Vec<_>, _>>()?.concat())
    }

    /// Which forces of what keeps a body are open, by their symbols: of a contact its friction alone may be, where two points of the
    /// body stick to one surface.
    fn open_parts(&self, name: &str, time: f64) -> Result<Vec<String>, CaseError> {
        let Some(pair) = self.run.equations.pairs().iter().find(|pair| pair.name == name) else {
            return Ok(vec![symbols::force(self.study, name, Law::Reaction)]);
        };
        let friction = pair.friction.iter().map(|_| (Law::Friction, pair.friction_symbol()));
        let parts: Vec<(Law, Expr)> = std::iter::once((Law::Contact, pair.force_symbol()))
            .chain(friction)
            .map(|(law, symbol)| (law, symbol.into()))
            .collect();
        let formulas: Vec<Expr> = parts.iter().map(|(_, formula)| formula.clone()).collect();
        let spreads = self.run.spreads(&formulas, time, Side::After)?;
        let open = parts.iter().zip(spreads).filter(|(_, spread)| spread.is_some());
        Ok(open.map(|((law, _), _)| symbols::force(self.study, name, *law)).collect())
    }

    /// Where a body points at angle zero, rad: along a rod, else to the right; `None` for one whose turning is not seen.
    fn direction(&self, body: &Body) -> Result<Option<f64>, CaseError> {
        let Some(part) = body.parts.iter().find(|part| !part.shape.edges().is_empty()) else {
            return Ok(None);
        };
        let Shape::Rod { from, to, .. } = &part.shape else { return Ok(Some(0.0)) };
        let along = to - from;
        Ok(Some(self.study.number(along.y())?.atan2(self.study.number(along.x())?)))
    }

    fn with_forces(&self, mut panel: FreeBodyDiagram, time: f64) -> Result<FreeBodyDiagram, CaseError> {
        let all = Forces::of(self.run).at(time, Side::After)?;
        let own: Vec<Force> = joined(&all).into_iter().filter(|force| force.body == self.body).collect();
        let reach = self.study.number(&self.study.model.bodies[self.body].reach())?;
        let largest =
            own.iter().map(|force| size(force.force) * reach + force.couple.abs()).fold(0.0, f64::max);
        for force in &own {
            panel = self.with_force(panel, force, time)?;
            if force.torque().abs() > NO_TORQUE * largest {
                let name = symbols::torque_of(self.study, (&force.load, force.law), self.body);
                panel = panel.couple(Couple::new(kind(force.law), Label::symbol(&name), force.torque()));
            }
        }
        // What is open and was given nothing is none of the motion's forces.
        for symbol in self.open(time)? {
            let symbol = Label::symbol(&symbol);
            if !panel.forces.iter().any(|arrow| arrow.symbol == symbol) {
                let centre = panel.pose.centre();
                panel = panel.force(Arrow::new(kind(Law::Contact), symbol, centre, [0.0; 2]));
            }
        }
        panel.cones = cones::of_forces(self.run, panel.pose.centre(), &own, time)?;
        panel.side = self.side_view(&own)?;
        Ok(panel)
    }

    /// With a force at its point, the arm to it, and the air that makes it.
    fn with_force(
        &self,
        panel: FreeBodyDiagram,
        force: &Force,
        time: f64,
    ) -> Result<FreeBodyDiagram, CaseError> {
        if force.law.is_couple() {
            return Ok(panel);
        }
        let centre = panel.pose.centre();
        let point = [centre[0] + force.arm[0], centre[1] + force.arm[1]];
        let name = symbols::force(self.study, &force.load, force.law);
        let symbol = self.signed(&force.load, &name);
        let mut panel = panel.force(Arrow::new(kind(force.law), symbol, point, force.force));
        if matches!(force.law, Law::Drag | Law::Lift)
            && let Some(stated) = air::stated(self.run, self.body, &force.load, time)
        {
            panel.velocities.extend(air::wind(self.run, &stated, point, time)?);
            panel.spreads.extend(air::spreads(self.run, &stated, centre, time)?);
            if stated.torque.is_some() {
                return Ok(panel);
            }
        }
        let is_there = size(force.force) > 0.0 && size(force.arm) > 0.0;
        let arm = symbols::arm(&self.of_body(&name, &force.load));
        Ok(if is_there { panel.arm(Label::symbol(&arm), point) } else { panel })
    }

    /// The symbol of a force as it is for this body.
    fn of_body(&self, symbol: &str, load: &str) -> String {
        symbols::of_body(self.study, symbol, load, &self.study.model.bodies[self.body].name)
    }

    /// The symbol of a force or impulse; its opposite on the second body of a joint or a contact.
    fn signed(&self, load: &str, name: &str) -> Label {
        let joint = self.study.model.joints.iter().find(|joint| joint.name == load);
        let second = joint.and_then(|joint| joint.ends[1].body());
        let mut pairs = self.run.equations.pairs().iter();
        let is_opposite = second == Some(&*self.study.model.bodies[self.body].name)
            || pairs.any(|pair| pair.name == symbols::rubbed(load) && pair.other == Some(self.body));
        if is_opposite { Label::plain("\u{2212}").then(Label::symbol(name)) } else { Label::symbol(name) }
    }

    /// Weight and support out of a horizontal plane, and what of the other forces is seen from the side.
    fn side_view(&self, forces: &[Force]) -> Result<Option<SideView>, CaseError> {
        let Gravity::Horizontal(g) = &self.study.model.gravity else { return Ok(None) };
        let body = &self.study.model.bodies[self.body];
        let weight = self.study.number(&(body.mass_properties().mass * g))?;
        let height = self.study.number(&body.reach())?;
        let outlines = outlines(self.study, body)?;
        let [down, up] = ["W", "N"].map(|symbol| (Label::symbol(symbol), weight));
        let along = forces.iter().filter(|force| !force.law.is_couple() && force.force[0] != 0.0);
        let along = along.map(|force| {
            let name = symbols::below(&symbols::force(self.study, &force.load, force.law), "x");
            Arrow::new(kind(force.law), Label::symbol(&name), [force.arm[0], height], [force.force[0], 0.0])
        });
        let mut view = SideView::resting(outlines, height, down, up);
        view.forces.extend(along);
        Ok((weight > 0.0).then_some(view))
    }

    /// Impulses on the body of a rigid impact at just this time.
    fn impulses(&self, time: f64) -> impl Iterator<Item = &Impulse> {
        let events = self.run.events().filter(move |event| event.time == time);
        let impulses = events.flat_map(|event| &event.record.impulses);
        impulses.filter(|impulse| impulse.body == self.body)
    }

    fn source_of(&self, impulse: &Impulse) -> (ArrowKind, String) {
        let kind = match impulse.source {
            Source::Pair(_) | Source::Friction(_) => ArrowKind::Contact,
            Source::Pivot(_) | Source::Joint(_) => ArrowKind::Reaction,
            Source::Applied(_) => ArrowKind::Applied,
        };
        let name = self.run.equations.source_name(impulse.source);
        let place = symbols::contact(self.study, symbols::rubbed(name));
        let along = if matches!(impulse.source, Source::Friction(_)) { "_f" } else { "" };
        // One that is a couple alone.
        match matches!(impulse.source, Source::Applied(_)) && impulse.impulse == [0.0; 2] {
            true => (kind, symbols::angular_impulse(&place)),
            false => (kind, symbols::impulse(&format!("{place}{along}"))),
        }
    }

    fn surfaces(&self, body: &Body, pose: Pose, time: f64) -> Result<Vec<Ground>, CaseError> {
        let reach = self.study.number(&body.reach())?;
        let all = surfaces(self.study, self.run, time)?;
        let planes = all.into_iter().filter(|surface| surface.reach.is_none() && surface.round.is_none());
        let is_plane =
            |surface: &&tumble_mech::Surface| surface.circle.is_none() && surface.polygon.is_none();
        let met = planes
            .zip(self.study.model.surfaces.iter().filter(is_plane))
            .filter(|(_, surface)| surface.meets(body));
        let mut found: Vec<Ground> = vec![];
        for Ground { point: [px, py], normal: [nx, ny], name, .. } in met.map(|(drawn, _)| drawn) {
            let distance = nx * (pose.x - px) + ny * (pose.y - py);
            // The point of the surface that is nearest to the body.
            let foot = [pose.x - distance * nx, pose.y - distance * ny];
            if distance.abs() <= 2.0 * NEAR * reach.max(f64::MIN_POSITIVE) {
                found.push(Ground::new(foot, [nx, ny], name));
            }
        }
        found.extend(self.tangents(body, reach, time)?);
        Ok(found)
    }

    /// Circles and polygons that the body nearly touches, as their tangents there.
    fn tangents(&self, body: &Body, reach: f64, time: f64) -> Result<Vec<Ground>, CaseError> {
        let model = &self.study.model;
        let mut found: Vec<Ground> = vec![];
        for pair in self.run.equations.pairs().iter().filter(|pair| !pair.is_rolling()) {
            let Rule::Surface(surface) = pair.rule else { continue };
            let surface = &model.surfaces[surface];
            let is_plane = surface.circle.is_none() && surface.polygon.is_none();
            if is_plane || model.bodies[pair.body].name != body.name {
                continue;
            }
            let formulas =
                [pair.point().components(), pair.normal.components(), &[pair.gap()], &pair.within()].concat();
            let Some(at) = self.run.observe(&formulas)?.at(time, Side::After) else { continue };
            let tangent =
                Ground::new([at[0], at[1]], [at[2], at[3]], Label::plain(&symbols::bare(&surface.name)));
            // Of a polygon only what is touched: its other edges would be drawn beyond their ends.
            let near = if surface.polygon.is_some() { TOUCHED } else { NEAR };
            let is_met = at[4].abs() <= near * reach.max(f64::MIN_POSITIVE)
                && at[5..].iter().all(|limit| *limit >= 0.0);
            // Two corners on one edge have one tangent.
            let is_new = |known: &Ground| known.name != tangent.name || known.normal != tangent.normal;
            if is_met && found.iter().all(is_new) {
                found.push(tangent);
            }
        }
        Ok(found)
    }

    fn symbol(&self, name: &str) -> Label {
        Label::symbol(symbols::all(self.study).get(name).map_or("theta", String::as_str))
    }
}

pub(crate) fn kind(law: Law) -> ArrowKind {
    match law {
        Law::Weight => ArrowKind::Weight,
        Law::Contact | Law::Friction | Law::Rolling => ArrowKind::Contact,
        Law::Drag | Law::Lift => ArrowKind::Air,
        Law::Spring | Law::Torsion => ArrowKind::Spring,
        Law::Reaction => ArrowKind::Reaction,
        Law::Force | Law::Torque => ArrowKind::Applied,
    }
}

/// A time with as many digits as a reader can use.
fn shown(time: f64) -> String {
    let text = format!("{time:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
