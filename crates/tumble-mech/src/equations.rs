//! From a model to equations of motion: a hybrid system whose terms are known by law, body and point.

mod acting;
mod states;

use std::sync::{Arc, OnceLock};

use tumble_expr::{Expr, Rounding, Substitution, Tape, Vector, is_identically_zero};
use tumble_ode::Program;

use crate::algebraic::{self, Algebraic, Slopes};
use crate::body_equations::BodyEquations;
use crate::brake::{self, Brake};
use crate::cache::Cache;
use crate::classes::Classes;
use crate::components::{Components, Couplings};
use crate::conditions::Sound;
use crate::constraints::JointEquations;
use crate::contact::{Pairs, moves};
use crate::coordinates::Coordinates;
use crate::error::{ModelError, ModelErrors};
use crate::evaluator::Tapes;
use crate::feedback::{self, Readings};
use crate::interaction::Bodies;
use crate::kinematics::Kinematics;
use crate::laws;
use crate::link::{InstantTapes, Library};
use crate::load::{Load, Moment};
use crate::mass::MassProperties;
use crate::mode::Mode;
use crate::model::Model;
use crate::parameters::Parameters;
use crate::term::Term;
pub(crate) use acting::on_body;

/// The equations of motion of a model, for every mode and every value of the parameters.
///
/// What follows from formulas alone is built once: copies share it, also those with other values of the parameters and with
/// numbers rounded in another way.
#[derive(Clone, Debug)]
pub struct Equations {
    model: Arc<Model>,
    parts: Arc<Parts>,
    rounding: Rounding,
}

/// What the equations are made of, whatever the values of the parameters.
#[derive(Debug)]
struct Parts {
    bodies: Vec<BodyEquations>,
    terms: Vec<Term>,
    /// By term, the forces of contacts and joints that it reads.
    readings: Vec<Readings>,
    brakes: Vec<Brake>,
    algebraic: Vec<Algebraic>,
    windows: Vec<Window>,
    pairs: Pairs,
    joints: Vec<JointEquations>,
    components: Components,
    /// By body, then how many states all have.
    first_states: Vec<usize>,
    /// Kinematic symbols that are not states, in those that are.
    definitions: Substitution,
    built: Built,
}

/// What has been built of them so far.
#[derive(Debug, Default)]
pub(crate) struct Built {
    pub(crate) definitions: Cache<Mode, Definitions>,
    pub(crate) programs: Cache<(Mode, Rounding), Program>,
    pub(crate) tapes: Tapes,
    pub(crate) instant_tapes: InstantTapes,
    pub(crate) slopes: Cache<Mode, Slopes>,
    pub(crate) residuals: Cache<(Mode, Rounding), Tape>,
    /// Events that have set parameters, with the values before them, that leave every value possible.
    pub(crate) sound_changes: Cache<(Vec<usize>, Vec<u64>), ()>,
    pub(crate) sound: Cache<(), Sound>,
    pub(crate) classes: OnceLock<Classes>,
    /// The equations with other numbers of nodes along lines.
    pub(crate) by_nodes: Cache<usize, Equations>,
    pub(crate) library: Library,
}

/// What symbols stand for in a mode: parameters that were changed, and kinematic ones that are not states, in parameters as they
/// are then.
pub(crate) struct Definitions {
    kinematic: Substitution,
    changes: Substitution,
}

impl Definitions {
    /// A formula of any kinematic symbols, in the states of the mode.
    pub(crate) fn apply(&self, formula: &Expr) -> Expr {
        self.kinematic.apply(&self.changes.apply(formula))
    }
}

/// When a load acts.
#[derive(Clone, Debug)]
pub struct Window {
    /// Name of the load.
    pub load: String,
    /// Index of the body it acts on.
    pub body: usize,
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

impl Equations {
    /// The equations of a model whose names and dimensions are in order.
    pub fn new(mut model: Model) -> Result<Self, ModelErrors> {
        model.add_captures();
        model.check()?;
        let bodies: Vec<BodyEquations> =
            (0..model.bodies.len()).map(|body| BodyEquations::of(&model, body)).collect();
        let mut definitions = Substitution::default();
        for body in &bodies {
            body.coordinates.define(&body.kinematics, &mut definitions);
        }
        let (windows, mut terms) = terms(&model, &bodies);
        let pairs = Pairs::of(&model);
        let joints = JointEquations::all(&model);
        let mut components = Components::of(&Couplings {
            model: &model,
            terms: &terms,
            pairs: &pairs.all,
            joints: joints.iter().map(|joint| (&joint.bodies[..], joint.symbols())).collect(),
        });
        let motions: Vec<&Kinematics> = bodies.iter().map(|body| &body.kinematics).collect();
        let forces = feedback::forces(&model, &pairs.all, &joints);
        let brakes = brake::all(&mut terms, &motions, &forces);
        for brake in &brakes {
            let sign = definitions.apply(&brake.rate.sign());
            definitions.insert(brake.sign.clone(), sign);
        }
        let algebraic = algebraic::all(&mut terms, &forces);
        let jumps = algebraic::jumps(&terms, &algebraic, |body| components.group_of(body));
        if !jumps.is_empty() {
            return Err(ModelErrors(jumps));
        }
        for known in &algebraic {
            components.own(known.state.clone(), known.body);
            definitions.insert(known.state.clone(), known.force.clone().into());
        }
        let readings = feedback::readings(&model, &terms, &pairs.all, &joints)?;
        let states = bodies.iter().map(|body| body.coordinates.count());
        let first_states = std::iter::once(0).chain(states.scan(0, |before, states| {
            *before += states;
            Some(*before)
        }));
        let first_states = first_states.collect();
        let built = Built::default();
        let parts = Parts {
            bodies,
            terms,
            readings,
            brakes,
            algebraic,
            windows,
            pairs,
            joints,
            components,
            first_states,
            definitions,
            built,
        };
        let equations = Self { model: Arc::new(model), parts: Arc::new(parts), rounding: Rounding::NEAREST };
        equations.check_points_turn()?;
        Ok(equations)
    }

    /// The same equations with numbers rounded in another way.
    pub fn rounded(&self, rounding: Rounding) -> Self {
        Self { rounding, ..self.clone() }
    }

    /// The equations of the same model with these parameters.
    pub fn with(&self, parameters: &Parameters) -> Result<Self, ModelErrors> {
        let model = Model { parameters: parameters.clone(), ..(*self.model).clone() };
        // Formulas hold the parameters by their symbols: their values are nothing to them.
        match self.model.parameters.has_symbols_of(parameters) {
            true => Ok(Self { model: Arc::new(model), ..self.clone() }),
            false => Ok(Self::new(model)?.rounded(self.rounding)),
        }
    }

    /// The equations of the same model with so many Gauss nodes along each line.
    pub(crate) fn with_nodes(&self, nodes: usize) -> Result<Self, ModelErrors> {
        let build = || Self::new(Model { nodes, ..(*self.model).clone() });
        let found = self.parts.built.by_nodes.get(&nodes, build)?;
        Ok(found.with(&self.model.parameters)?.rounded(self.rounding))
    }

    /// How numbers in them are rounded.
    pub(crate) fn rounding(&self) -> Rounding {
        self.rounding
    }

    /// The model these are the equations of.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Formulas of the scheduled times of a mode, in the order in which causes count them.
    pub fn scheduled_times(&self, mode: &Mode) -> Vec<Expr> {
        self.schedule(mode).map(|(_, _, time)| time.clone()).collect()
    }

    /// The same, each with its window and whether it is the end.
    pub(crate) fn schedule(&self, mode: &Mode) -> impl Iterator<Item = (usize, bool, &Expr)> {
        let windows = self.parts.windows.iter().enumerate().filter(|(_, window)| mode.has(window.body));
        windows.flat_map(|(index, window)| window.times().map(move |(ends, time)| (index, ends, time)))
    }

    /// Events that are watched for in a mode, by index.
    pub(crate) fn events(&self, mode: &Mode) -> Vec<usize> {
        (0..self.model.events.len()).filter(|event| self.parts.components.watches(mode, *event)).collect()
    }

    /// What belongs together of the bodies.
    pub(crate) fn components(&self) -> &Components {
        &self.parts.components
    }

    /// When loads act that do not always.
    pub fn windows(&self) -> &[Window] {
        &self.parts.windows
    }

    /// Mass properties of a body, by its index.
    pub fn mass_properties(&self, body: usize) -> &MassProperties {
        &self.parts.bodies[body].mass
    }

    /// Whether a body, by its index, is held at a point.
    pub(crate) fn is_pivoted(&self, body: usize) -> bool {
        matches!(self.parts.bodies[body].coordinates, Coordinates::Pivoted { .. })
    }

    /// The terms on a body that are not of contacts or joints.
    pub(crate) fn terms_of(&self, body: usize) -> impl Iterator<Item = &Term> {
        self.parts.terms.iter().filter(move |term| term.body == body)
    }

    /// Whether a formula reads a force of a contact, a pivot or a joint, or an acceleration.
    pub(crate) fn reads_forces(&self, formula: &Expr) -> bool {
        let of_body = |body: &BodyEquations| {
            let motion = &body.kinematics;
            motion.acceleration_symbols().into_iter().chain([motion.alpha_symbol()])
        };
        let bodies = self.parts.bodies.iter().flat_map(of_body);
        let pivots = self.model.pivots.iter().flat_map(|pivot| pivot.force_symbols());
        let joints = self.parts.joints.iter().flat_map(JointEquations::symbols);
        let pairs =
            self.parts.pairs.all.iter().flat_map(|pair| [pair.force_symbol(), pair.friction_symbol()]);
        let read = formula.symbols();
        bodies.chain(pivots).chain(joints).chain(pairs).any(|symbol| read.contains(&symbol))
    }

    /// Signs of rates in loads, that may stay zero.
    pub(crate) fn brakes(&self) -> &[Brake] {
        &self.parts.brakes
    }

    /// Forces that loads read otherwise than linearly.
    pub(crate) fn algebraic(&self) -> &[Algebraic] {
        &self.parts.algebraic
    }

    pub(crate) fn joints(&self) -> &[JointEquations] {
        &self.parts.joints
    }

    pub(crate) fn body_equations(&self, body: usize) -> &BodyEquations {
        &self.parts.bodies[body]
    }

    pub(crate) fn pair_list(&self) -> &Pairs {
        &self.parts.pairs
    }

    pub(crate) fn built(&self) -> &Built {
        &self.parts.built
    }

    /// Whether a body is held at a place that moves.
    pub(crate) fn is_carried(&self, body: usize) -> bool {
        self.model.pivot_of(&self.model.bodies[body].name).is_some_and(|pivot| moves(&pivot.world))
    }

    /// Index of a body's pivot, and where it is from the body's centre of mass, m, world axes.
    pub(crate) fn pivot_arm(&self, body: usize) -> Option<(usize, Vector)> {
        let body = &self.model.bodies[body];
        let index = self.model.pivots.iter().position(|pivot| pivot.body == body.name)?;
        Some((index, body.at(&self.model.pivots[index].point).world_arm()))
    }

    fn check_points_turn(&self) -> Result<(), ModelErrors> {
        let is_point = |(index, body): (usize, &BodyEquations)| {
            matches!(body.coordinates, Coordinates::Free { is_point: true })
                && !self.joints().iter().any(|joint| joint.bodies.contains(&index))
        };
        let points: Vec<bool> = self.parts.bodies.iter().enumerate().map(is_point).collect();
        let turned = |term: &&Term| points[term.body] && !is_identically_zero(&term.torque());
        let mistakes = self.parts.terms.iter().filter(turned).map(|term| ModelError::PointTurned {
            body: self.model.bodies[term.body].name.clone(),
            load: term.load.clone(),
        });
        let mistakes: Vec<ModelError> = mistakes.collect();
        if mistakes.is_empty() { Ok(()) } else { Err(ModelErrors(mistakes)) }
    }
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
        let window = window(load, body, &mut windows);
        terms.push(laws::applied::term(load, body, &bodies[body].kinematics, window));
    }
    terms.extend(model.interactions.iter().flat_map(|interaction| interaction.terms(&Bodies::of(model))));
    (windows, terms)
}

fn window(load: &Load, body: usize, windows: &mut Vec<Window>) -> Option<usize> {
    let during = load.during.clone()?;
    windows.push(Window { load: load.name.clone(), body, during });
    Some(windows.len() - 1)
}
