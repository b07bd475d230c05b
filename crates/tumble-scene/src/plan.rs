//! A study of a model that was made in Rust: what a scene says behind its model, by methods.

use std::collections::BTreeSet;

use tumble_expr::{Dimension, Expr, Symbol, units};
use tumble_mech::{Body, Equations, Extreme, Model};
use tumble_ode::{Accuracy, Side};

use crate::code::Code;
use crate::curve;
use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::draft::Draft;
use crate::file_names::{file_name_fault, folded};
use crate::printable::one_line;
use crate::study::{
    BalancePlot, Check, Curve, FreeBody, Instant, Plot, Question, Sheet, Stroboscope, Study, When,
};
use crate::{model_mistakes, quantities, values};

/// What to do with a model: how long it runs, what is drawn and what is asked for.
///
/// All formulas may hold every kinematic symbol of the model, accelerations and forces of joints included. Mistakes are told all at
/// once by [`Plan::study`].
#[must_use]
pub struct Plan {
    draft: Draft,
    /// Every instant that something is looked at.
    instants: Vec<Instant>,
}

impl Plan {
    /// Runs a model from time 0 to `until`, s, a formula of its parameters.
    pub fn of(title: impl AsRef<str>, mut model: Model, until: Expr) -> Self {
        model.add_captures();
        let title = one_line(title.as_ref());
        let mut draft = Draft::begin(&title, "", &[]);
        draft.names.bodies = model.bodies.iter().map(|body| body.name.clone()).collect();
        draft.names.surfaces = model.surfaces.iter().map(|surface| surface.name.clone()).collect();
        draft.names.contacts = model.contacts.iter().map(|contact| contact.name.clone()).collect();
        draft.names.events = model.events.iter().map(|event| event.name.clone()).collect();
        let pivots = model.pivots.iter().map(|pivot| pivot.name.clone());
        draft.names.joints = pivots.chain(model.joints.iter().map(|joint| joint.name.clone())).collect();
        for body in &model.bodies {
            quantities::define(&mut draft.names, &model.gravity, body);
        }
        quantities::define_contacts(&mut draft.names, &model);
        quantities::define_meetings(&mut draft.names, &model);
        for pivot in &model.pivots {
            quantities::define_joint(&mut draft.names, &pivot.name, pivot.force_symbols().into());
        }
        for joint in &model.joints {
            quantities::define_joint(&mut draft.names, &joint.name, joint.multipliers());
        }
        quantities::define_works(&mut draft.names, &model);
        Self { draft: Draft { title, model, until: Some(until), ..draft }, instants: vec![] }
    }

    /// What the motion is held to; 1e-9 where nothing is said.
    pub fn accuracy(mut self, accuracy: Accuracy) -> Self {
        self.draft.accuracy = accuracy;
        self
    }

    /// Time between lines of the tables, s; a thousandth of the run where nothing is said.
    pub fn every(mut self, every: Expr) -> Self {
        self.draft.output_every = Some(every);
        self
    }

    /// Curves over the time, each with its label; they must measure alike.
    pub fn plot<'l>(mut self, name: &str, curves: impl IntoIterator<Item = (&'l str, Expr)>) -> Self {
        let y: Vec<Curve> = curves.into_iter().map(|(label, formula)| self.curve(label, formula)).collect();
        self.figure(name);
        let unlike = y.windows(2).any(|pair| pair[0].quantity.dimension != pair[1].quantity.dimension);
        if unlike || y.is_empty() {
            self.mistake(Code::UnlikeCurves, format!("the plot `{name}` needs curves that measure alike"));
        }
        self.draft.plots.push(Plot { name: name.to_owned(), title: None, x: None, y, during: None });
        self
    }

    /// All bodies at equal steps of time, s, in one picture.
    pub fn stroboscope(mut self, name: &str, every: Expr) -> Self {
        self.figure(name);
        let bodies = (0..self.draft.model.bodies.len()).collect();
        let picture = Stroboscope { name: name.to_owned(), title: None, bodies, every, trace: true };
        self.draft.stroboscopes.push(picture);
        self
    }

    /// A figure of the balance.
    pub fn balance(mut self, name: &str, show: Sheet) -> Self {
        self.figure(name);
        self.draft.balances.push(BalancePlot { name: name.to_owned(), title: None, show });
        self
    }

    /// Free-body diagrams of one body.
    pub fn free_body(mut self, name: &str, body: &Body, at: impl IntoIterator<Item = Instant>) -> Self {
        self.figure(name);
        let at: Vec<Instant> = at.into_iter().collect();
        self.instants.extend(at.iter().cloned());
        let at = at.into_iter().map(|at| (at.clone(), at.text)).collect();
        match self.draft.model.body_index(&body.name) {
            Some(body) => {
                self.draft.free_bodies.push(FreeBody { name: name.to_owned(), title: None, body, at });
            }
            None => self.mistake(Code::UnknownBody, format!("there is no body \"{}\"", body.name)),
        }
        self
    }

    /// Asks for a value.
    pub fn find(mut self, name: &str, that: Expr, at: When) -> Self {
        let question = self.question("find", name, that, at);
        self.draft.finds.push(question);
        self
    }

    /// Claims a value, to within a difference.
    pub fn check(mut self, name: &str, that: Expr, at: When, equals: Expr, within: Expr) -> Self {
        let question = self.question("check", name, that, at);
        for formula in [&equals, &within] {
            if formula.expect(question.that.quantity.dimension).is_err() {
                self.mistake(Code::Model, format!("the check `{name}` compares what does not measure alike"));
            }
        }
        self.draft.checks.push(Check { question, equals, within });
        self
    }

    /// Asks for the pose of equilibrium near the start.
    pub fn equilibrium(mut self) -> Self {
        self.draft.equilibrium = true;
        self
    }

    /// How figures and equations write a name: `rod.angle` as `theta`.
    pub fn symbol(mut self, name: &str, symbol: &str) -> Self {
        self.draft.symbols.insert(name.to_owned(), symbol.to_owned());
        self
    }

    /// The study, if nothing is wrong with it.
    pub fn study(mut self) -> Result<Study, Diagnostics> {
        model_mistakes::check(&mut self.draft);
        values::check(&mut self.draft);
        self.refuse_unknown();
        self.draft.finish()
    }

    fn mistake(&mut self, code: Code, message: String) {
        self.draft.note(Diagnostic::new(code, 0..0, message).nowhere());
    }

    /// The name of a figure is that of a file.
    fn figure(&mut self, name: &str) {
        if let Some(fault) = file_name_fault(name) {
            self.mistake(Code::FileName, format!("`{name}` cannot be the name of a file: {fault}"));
        }
        if self.draft.figures.insert(folded(name), (name.to_owned(), 0..0)).is_some() {
            self.mistake(Code::NameTaken, format!("two figures have the name `{name}`"));
        }
    }

    fn curve(&mut self, label: &str, formula: Expr) -> Curve {
        if let Err(mistake) = formula.dimension() {
            self.mistake(Code::Model, format!("`{label}`: {mistake}"));
        }
        let text = one_line(label);
        let (angle, label) = (curve::is_angular(&formula), Some(text.clone()));
        Curve { text, angle, size: Expr::one(), label, quantity: curve::quantity(formula, []) }
    }

    fn question(&mut self, kind: &str, name: &str, that: Expr, at: When) -> Question {
        match &at {
            When::At(at) => self.instants.push(at.clone()),
            When::Extreme { during: Some(ends), .. } => self.instants.extend(ends.iter().cloned()),
            When::Extreme { during: None, .. } | When::End => {}
        }
        let (name, that) = (one_line(name), self.curve(name, that));
        Question { title: format!("the {kind} `{name}`"), name, that, at, side: Side::After }
    }

    /// Notes the instants that nothing of the model has.
    fn refuse_unknown(&mut self) {
        // A model with mistakes has no equations; whether others lack as well can mostly be said all the same.
        let built = || Equations::new(self.draft.model.clone()).ok();
        let Some(equations) = self.draft.equations.clone().or_else(built) else { return };
        let model = &self.draft.model;
        let is_rest =
            |name: &str| name.strip_suffix(".rest").is_some_and(|body| model.body_index(body).is_some());
        let is_known = |symbol: &Symbol| match symbol.name.rsplit_once(".contact[") {
            Some((place, _)) => self.draft.names.touching.contains(place),
            None => match symbol.name.split_once('[') {
                Some((event, _)) => equations.named(event).is_some() || is_rest(event),
                None => model.parameters.contains(symbol),
            },
        };
        let symbols = self.instants.iter().flat_map(|at| at.time.symbols());
        let unknown: BTreeSet<String> =
            symbols.filter(|symbol| !is_known(symbol)).map(|symbol| symbol.name.to_string()).collect();
        let no_times = self.instants.iter().filter(|at| at.time.expect(Dimension::TIME).is_err());
        let no_times: Vec<String> = no_times.map(|at| at.text.clone()).collect();
        for name in unknown {
            self.mistake(Code::UnknownEvent, format!("there is no event or contact for `{name}`"));
        }
        for text in no_times {
            self.mistake(Code::Model, format!("`{text}` is no time"));
        }
    }
}

impl Instant {
    /// A time, s.
    pub fn at(seconds: f64) -> Self {
        Self::of(&format!("{seconds} s"), Expr::from(seconds) * units::S)
    }

    /// A time, s, a formula of the parameters, with what figures call it.
    pub fn of(text: &str, time: Expr) -> Self {
        Self { text: one_line(text), time }
    }

    /// When an event of the model happens for the first time; so are the start and end of a load, `push.start`, and where a body has
    /// come to rest, `rod.rest`.
    pub fn event(name: &str) -> Self {
        Self::said(name, format!("{name}[1]"))
    }

    /// When a contact of that count, from 1, begins: of a surface, of a body with it or of one of its points, `floor.rod.tip`.
    pub fn contact_start(place: &str, count: usize) -> Self {
        Self::of_contact(place, count, "start")
    }

    /// When such a contact ends.
    pub fn contact_end(place: &str, count: usize) -> Self {
        Self::of_contact(place, count, "end")
    }

    fn of_contact(place: &str, count: usize, part: &str) -> Self {
        let name = format!("{place}.contact[{count}].{part}");
        Self::said(&name, name.clone())
    }

    fn said(text: &str, symbol: String) -> Self {
        Self::of(text, Symbol::new(symbol, Dimension::TIME).into())
    }
}

impl When {
    /// Where what is looked at is greatest.
    pub fn greatest() -> Self {
        Self::Extreme { which: Extreme::Greatest, during: None }
    }

    /// Where it is least.
    pub fn least() -> Self {
        Self::Extreme { which: Extreme::Least, during: None }
    }
}
