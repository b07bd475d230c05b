//! From a model to equations of motion: a hybrid system whose terms are known by law, body and point.

use tumble_expr::{Expr, Substitution, Symbol, Vector, is_identically_zero};
use tumble_ode::ScaleGroup;

use crate::coordinates::{Coordinates, StateRate};
use crate::error::{ModelError, ModelErrors};
use crate::event::Action;
use crate::interaction::Bodies;
use crate::kinematics::Kinematics;
use crate::laws;
use crate::load::{Load, Moment};
use crate::mass::MassProperties;
use crate::mode::Mode;
use crate::model::Model;
use crate::term::Term;

/// The equations of motion of a model, for every mode and every value of the parameters.
#[derive(Clone, Debug)]
pub struct Equations {
    model: Model,
    bodies: Vec<BodyEquations>,
    terms: Vec<Term>,
    windows: Vec<Window>,
    /// Kinematic symbols that are not states, in those that are.
    definitions: Substitution,
}

/// What symbols stand for in a mode: first the kinematic ones that are not states, then parameters that were changed.
pub(crate) struct Definitions {
    kinematic: Substitution,
    changes: Substitution,
}

impl Definitions {
    /// A formula of any kinematic symbols, in the states of the mode.
    pub(crate) fn apply(&self, formula: &Expr) -> Expr {
        self.changes.apply(&self.kinematic.apply(formula))
    }
}

/// When a load acts.
#[derive(Clone, Debug)]
pub struct Window {
    /// Name of the load.
    pub load: String,
    /// Start and end.
    pub during: [Moment; 2],
}

impl Window {
    /// The ends that are times, each with whether it is the end.
    pub(crate) fn times(&self) -> impl Iterator<Item = (bool, &Expr)> {
        let ends = self.during.iter().enumerate();
        ends.filter_map(|(end, moment)| match moment {
            Moment::Time(time) => Some((end == 1, time)),
            Moment::Event(_) => None,
        })
    }
}

#[derive(Clone, Debug)]
struct BodyEquations {
    kinematics: Kinematics,
    mass: MassProperties,
    coordinates: Coordinates,
}

impl Equations {
    /// The equations of a model whose names and dimensions are in order.
    pub fn new(model: Model) -> Result<Self, ModelErrors> {
        model.check()?;
        let bodies: Vec<BodyEquations> = (0..model.bodies.len()).map(|body| of_body(&model, body)).collect();
        let mut definitions = Substitution::default();
        for body in &bodies {
            body.coordinates.define(&body.kinematics, &mut definitions);
        }
        let (windows, terms) = terms(&model, &bodies);
        let equations = Self { model, bodies, terms, windows, definitions };
        equations.check_points_turn()?;
        Ok(equations)
    }

    /// The model these are the equations of.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// When loads act that do not always.
    pub fn windows(&self) -> &[Window] {
        &self.windows
    }

    /// Mass properties of a body, by its index.
    pub fn mass_properties(&self, body: usize) -> &MassProperties {
        &self.bodies[body].mass
    }

    /// The terms that act in a mode, reactions of pivots included, in the states of the mode.
    pub fn terms(&self, mode: &Mode) -> Vec<Term> {
        let (acting, definitions) = (self.acting(mode), self.definitions_of(mode));
        let in_mode = |formula: &Expr| definitions.apply(formula);
        let reactions = self.bodies.iter().enumerate().filter_map(|(index, body)| {
            let terms = on_body(&acting, index);
            body.coordinates.reaction(index, &body.kinematics, &body.mass, &terms)
        });
        let terms = acting.iter().map(|term| (*term).clone()).chain(reactions);
        let vector = |v: &Vector| v.map(&in_mode);
        let in_states = terms.map(|term| Term {
            arm: vector(&term.arm),
            force: vector(&term.force),
            couple: in_mode(&term.couple),
            ..term
        });
        in_states.collect()
    }

    /// The states of a mode in order.
    pub fn states(&self, _: &Mode) -> Vec<Symbol> {
        self.state_rates().into_iter().map(|state| state.symbol).collect()
    }

    /// A formula of any kinematic symbols, accelerations included, in the states of a mode.
    pub fn in_states(&self, mode: &Mode, formula: &Expr) -> Expr {
        self.definitions_of(mode).apply(formula)
    }

    /// What every kinematic symbol stands for in a mode.
    pub(crate) fn definitions_of(&self, mode: &Mode) -> Definitions {
        Definitions { kinematic: self.definitions_in(mode), changes: self.changes(mode) }
    }

    /// Formulas for all kinematic symbols that are not states.
    ///
    /// Positions and velocities are found first: an acceleration's formula holds them.
    pub(crate) fn definitions_in(&self, mode: &Mode) -> Substitution {
        let acting = self.acting(mode);
        let mut all = self.definitions.clone();
        for (index, body) in self.bodies.iter().enumerate() {
            let terms = on_body(&acting, index);
            let (a, alpha) = body.coordinates.accelerations(&body.kinematics, &body.mass, &terms);
            for (symbol, formula) in body.kinematics.acceleration_symbols().into_iter().zip(a.components()) {
                all.insert(symbol, self.definitions.apply(formula));
            }
            all.insert(body.kinematics.alpha_symbol(), self.definitions.apply(&alpha));
        }
        all
    }

    /// Parameters that events have given other formulas.
    pub(crate) fn changes(&self, mode: &Mode) -> Substitution {
        let mut changes = Substitution::default();
        for event in &mode.changes {
            let Action::Set(settings) = &self.model.events[*event].action else { continue };
            for (name, formula) in settings {
                if let Some(symbol) =
                    self.model.parameters.symbols().into_iter().find(|symbol| *symbol.name == **name)
                {
                    changes.insert(symbol, formula.clone());
                }
            }
        }
        changes
    }

    fn acting(&self, mode: &Mode) -> Vec<&Term> {
        self.terms.iter().filter(|term| term.window.is_none_or(|window| mode.windows[window])).collect()
    }

    pub(crate) fn state_rates(&self) -> Vec<StateRate> {
        self.bodies.iter().flat_map(|body| body.coordinates.states(&body.kinematics)).collect()
    }

    /// What each kind of state is measured against; the order is [`Measure`]'s.
    pub(crate) fn groups(&self) -> Vec<ScaleGroup> {
        let reaches = self.model.bodies.iter().map(|body| body.reach() * 2);
        let size = reaches.reduce(|far, next| Expr::binary(tumble_expr::Binary::Max, far, next));
        let size = size.unwrap_or_else(Expr::zero);
        let group = |name: &str, floor: &Expr, per_run| ScaleGroup {
            name: name.to_owned(),
            floor: floor.clone(),
            per_run,
        };
        vec![
            group("length", &size, false),
            group("angle", &Expr::one(), false),
            group("speed", &size, true),
            group("angular rate", &Expr::one(), true),
        ]
    }

    fn check_points_turn(&self) -> Result<(), ModelError> {
        let is_point = |body: &BodyEquations| {
            matches!(body.coordinates, Coordinates::Free) && is_identically_zero(&body.mass.inertia)
        };
        let turned = |term: &&Term| is_point(&self.bodies[term.body]) && !is_identically_zero(&term.torque());
        if let Some(term) = self.terms.iter().find(turned) {
            let body = self.model.bodies[term.body].name.clone();
            return Err(ModelError::PointTurned { body, load: term.load.clone() });
        }
        Ok(())
    }
}

fn of_body(model: &Model, index: usize) -> BodyEquations {
    let body = &model.bodies[index];
    let mass = body.mass_properties();
    let coordinates = Coordinates::of(model.pivot_of(&body.name), &mass);
    BodyEquations { kinematics: body.kinematics(), mass, coordinates }
}

/// Every term of the model, and the windows that some of them act in.
fn terms(model: &Model, bodies: &[BodyEquations]) -> (Vec<Window>, Vec<Term>) {
    let mut windows: Vec<Window> = vec![];
    let mut terms = vec![];
    if let Some(gravity) = model.gravity.in_plane() {
        let weights = bodies.iter().enumerate();
        terms.extend(weights.map(|(index, body)| laws::weight::term(index, &body.mass, &gravity)));
    }
    for load in &model.loads {
        let body = model.body_index(&load.body).expect("the model was checked");
        let window = window(load, &mut windows);
        terms.push(laws::applied::term(load, body, &bodies[body].kinematics, window));
    }
    let names: Vec<String> = model.bodies.iter().map(|body| body.name.clone()).collect();
    let context = Bodies { names: &names, wind: &model.wind, nodes: model.nodes };
    terms.extend(model.interactions.iter().flat_map(|interaction| interaction.terms(&context)));
    (windows, terms)
}

fn window(load: &Load, windows: &mut Vec<Window>) -> Option<usize> {
    let during = load.during.clone()?;
    windows.push(Window { load: load.name.clone(), during });
    Some(windows.len() - 1)
}

fn on_body<'a>(terms: &[&'a Term], body: usize) -> Vec<&'a Term> {
    terms.iter().copied().filter(|term| term.body == body).collect()
}
