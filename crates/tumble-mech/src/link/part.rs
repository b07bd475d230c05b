//! What there are equations of, and those equations, prepared once.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use tumble_expr::{
    Code, CompileError, Expr, FastMap, Formulas, Fragment, Node, Skeleton, Substitution, Symbol, Vector,
};
use tumble_ode::Watched;

use super::names::{Name, Names, totals};
use crate::cache::Cache;
use crate::coordinates::Measure;
use crate::equations::Equations;
use crate::feedback;
use crate::laws::compliant;
use crate::parameters::time_symbol;
use crate::row::{Row, Wrench, torque_on};
use crate::term::Term;

/// What there are equations of. None of them depends on a mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Part {
    /// x, y, vx and vy of a body on a pivot.
    Place(usize),
    /// ax, ay and alpha of a body, in what all terms on it do.
    Acceleration(usize),
    /// Force of a body's pivot.
    Reaction(usize),
    /// What each velocity of a body takes to be changed; whether it has no moment of inertia and joints turn it.
    Masses(usize, bool),
    /// What an impulse does to each velocity of a body.
    InverseMasses(usize),
    /// Force along x and y of a term, and its torque about what the body turns about.
    Term(TermOf),
    /// The force of a pair that is pressed.
    Pressed(usize),
    /// The gap of a pair.
    Gap(usize),
    /// How far it is from leaving where there may be a contact, by each of its limits.
    Leaving(usize),
    /// The same with the tolerance of what touches, by limits of any kind.
    Holding(usize),
    /// The rate at which it slips.
    Slip(usize),
    /// How fast it can change with each coordinate; nothing where there is no bound.
    Slopes(usize),
    /// What a unit of force does to a body.
    Lightness(usize),
    /// The length that a body's places are measured against.
    Size(usize),
    /// What a unit of something does to a row's acceleration.
    Response(RowOf, Pusher),
    /// Acceleration of a row, in the accelerations of its bodies.
    RowAcceleration(RowOf),
    /// Torque of a unit of something on a body about its centre.
    Torque(Pusher, usize),
    /// How a row's acceleration follows that of the angle of a body.
    Turning(RowOf, usize),
    /// What a unit of something on a body does to the force of its pivot, along x and y.
    Recoil(usize, Pusher),
    /// What is zero while a row holds: its position, then its rate, each with its slopes by states.
    Kept(RowOf),
    /// What is zero while the root of a pair's depth is a state, with its slopes.
    Root(usize),
}

/// A term of the model, by its index; of a joint by the joint's and its own there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum TermOf {
    Load(usize),
    /// By the pair, then by its body.
    Pair(usize, usize),
    /// Friction of a pair.
    Friction(usize, usize),
    Joint(usize, usize),
    /// What a brake does that holds, by its own order there.
    Brake(usize, usize),
}

/// A row, by the index of its pair, or of its joint and its own there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum RowOf {
    Joint(usize, usize),
    /// That its gap stays closed.
    Pair(usize),
    /// That it does not slip.
    Slip(usize),
    /// That the rate of a brake stays zero.
    Brake(usize),
}

/// What acts on bodies in proportion to something unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Pusher {
    /// What keeps a row, for each unit of its multiplier.
    Row(RowOf),
    /// A load, by its index, for each unit of a force that it reads.
    Load(usize, Name),
}

/// Formulas, ready to be linked.
#[derive(Debug)]
pub(crate) struct Piece {
    /// What those have in common that differ by names alone.
    pub(crate) class: Arc<Class>,
    /// What is in the place of each symbol of the class.
    symbols: Vec<Import>,
    /// Of functions that are kept zero: kind of each, and the states that its slopes are by, which follow it.
    pub(crate) kept: Vec<(Measure, Vec<Name>)>,
}

/// Formulas that were prepared first among those that differ by names alone.
#[derive(Debug)]
pub(crate) struct Class {
    /// What they are found by.
    signature: Vec<Expr>,
    outline: Skeleton,
    /// What is computed, in the symbols of the first.
    pub(crate) formulas: Vec<Expr>,
    pub(crate) code: Result<Arc<Code>, CompileError>,
    /// Indices of imports, and of the states that slopes are by, among the symbols of the outline.
    imports: Vec<usize>,
    kept: Vec<(Measure, Vec<usize>)>,
}

#[derive(Debug)]
pub(crate) struct Import {
    pub(crate) symbol: Symbol,
    /// `None` where the model does not have it.
    pub(crate) name: Option<Name>,
}

/// All pieces that have been asked for.
#[derive(Debug, Default)]
pub(crate) struct Library {
    names: OnceLock<Arc<Names>>,
    parts: Mutex<FastMap<Part, Arc<Piece>>>,
    /// Those of formulas from elsewhere: of observers, events and changes.
    written: Cache<Formulas, Piece>,
    /// Classes of parts, by outline.
    classes: Mutex<HashMap<u64, Vec<Arc<Class>>>>,
    /// By pair and what has changed parameters.
    watched: Cache<(usize, Vec<usize>), Arc<Watched>>,
}

impl Equations {
    pub(super) fn library(&self) -> &Library {
        &self.built().library
    }

    pub(crate) fn names(&self) -> Arc<Names> {
        Arc::clone(self.library().names.get_or_init(|| Arc::new(Names::of(self))))
    }

    /// The equations of a part.
    pub(super) fn piece(&self, part: Part) -> Arc<Piece> {
        let library = self.library();
        if let Some(known) = locked(&library.parts).get(&part) {
            return Arc::clone(known);
        }
        let piece = match part {
            Part::Kept(row) => self.kept(row),
            Part::Root(pair) => {
                let formula = compliant::root_invariant(&self.pairs()[pair]);
                self.sorted(vec![formula], &[Measure::Length])
            }
            part => self.sorted(self.formulas_of(part), &[]),
        };
        // Not under the lock: two threads may both prepare it, and one of the two is kept.
        Arc::clone(locked(&library.parts).entry(part).or_insert_with(|| Arc::new(piece)))
    }

    /// The piece of formulas, of their class; of functions that are kept zero where kinds are given.
    fn sorted(&self, signature: Vec<Expr>, kept: &[Measure]) -> Piece {
        let (names, classes) = (self.names(), &self.library().classes);
        let signature: Vec<Expr> = match kept {
            [] => signature,
            _ => signature.iter().map(|function| self.in_coordinates(function)).collect(),
        };
        let outline = Skeleton::of(&signature);
        let is_this = |class: &&Arc<Class>| {
            let is_state = |symbol: &Symbol| names.find(symbol).is_some_and(|name| names.is_state(name));
            let mut symbols = outline.symbols().iter().zip(class.outline.symbols());
            class.kept.iter().map(|(measure, _)| measure).eq(kept)
                && (kept.is_empty() || symbols.all(|(own, its)| is_state(own) == is_state(its)))
                && outline.is_renamed(&signature, &class.outline, &class.signature)
        };
        let known = locked(classes).get(&outline.hash()).cloned().unwrap_or_default();
        let class = known.iter().find(is_this).cloned().unwrap_or_else(|| {
            let class = Arc::new(Class::of(signature, &outline, kept, &names));
            locked(classes).entry(outline.hash()).or_default().push(Arc::clone(&class));
            class
        });
        Piece::of(class, outline.symbols(), &names)
    }

    /// Formulas from elsewhere.
    pub(super) fn written_piece(&self, formulas: &[Expr]) -> Arc<Piece> {
        let build = || {
            let (names, outline) = (self.names(), Skeleton::of(formulas));
            let class = Class::of(formulas.to_vec(), &outline, &[], &names);
            Ok::<_, std::convert::Infallible>(Piece::of(Arc::new(class), outline.symbols(), &names))
        };
        let found = self.library().written.get(&Formulas::new(formulas), build);
        found.unwrap_or_else(|never| match never {})
    }

    /// The gap of a pair, to be watched while it is open.
    pub(super) fn watched_gap(&self, pair: usize, changes: &[usize]) -> Arc<Watched> {
        let build = || {
            let of = &self.pairs()[pair];
            let mut changed = Substitution::default();
            self.changes_by(changes).for_each(|(symbol, formula)| changed.insert(symbol, formula));
            let formulas = std::iter::once(of.watched()).chain(of.conditions());
            let formulas = formulas.map(|formula| changed.apply(&self.in_coordinates(&formula))).collect();
            let states = of.bodies().flat_map(|body| &self.body_equations(body).states);
            let states: Vec<Symbol> = states.map(|state| state.symbol.clone()).collect();
            let inputs = self.model().parameters.symbols();
            Ok::<_, std::convert::Infallible>(Watched::where_positive(
                formulas,
                &states,
                &time_symbol(),
                &inputs,
            ))
        };
        let found = self.library().watched.get(&(pair, changes.to_vec()), build);
        let found = found.unwrap_or_else(|never| match never {});
        Arc::clone(&found)
    }

    pub(crate) fn term(&self, of: TermOf) -> &Term {
        match of {
            TermOf::Load(index) => &self.loads()[index],
            TermOf::Pair(pair, side) => &self.pair_list().terms(pair)[side],
            TermOf::Friction(pair, side) => &self.pair_list().friction_terms(pair)[side],
            TermOf::Joint(joint, index) => &self.joints()[joint].terms[index],
            TermOf::Brake(brake, index) => &self.brakes()[brake].terms[index],
        }
    }

    pub(crate) fn row(&self, of: RowOf) -> Row {
        match of {
            RowOf::Pair(pair) => self.pairs()[pair].row(),
            RowOf::Slip(pair) => self.pairs()[pair].slip_row(),
            RowOf::Joint(joint, row) => self.joints()[joint].rows[row].clone(),
            RowOf::Brake(brake) => self.brakes()[brake].row.clone(),
        }
    }

    fn formulas_of(&self, part: Part) -> Vec<Expr> {
        match part {
            Part::Place(body) => {
                let own = &self.body_equations(body).kinematics;
                let places = [own.position(), own.velocity()];
                places.iter().flat_map(Vector::components).map(|place| self.in_coordinates(place)).collect()
            }
            Part::Acceleration(body) => self.body_equations(body).accelerations(),
            Part::Reaction(body) => self.body_equations(body).reaction_to_all(),
            Part::Masses(body, is_light) => {
                let body = self.body_equations(body);
                body.coordinates.masses(&body.mass, is_light)
            }
            Part::InverseMasses(body) => {
                let body = self.body_equations(body);
                body.coordinates.inverse_masses(&body.mass)
            }
            Part::Term(of) => {
                let term = self.term(of);
                let body = self.body_equations(term.body);
                let torque = body.coordinates.torque(&body.kinematics, term);
                vec![term.force.x().clone(), term.force.y().clone(), torque]
            }
            Part::Pressed(pair) => {
                vec![compliant::normal_force(&self.pairs()[pair]).unwrap_or_else(Expr::zero)]
            }
            Part::Gap(pair) => vec![self.pairs()[pair].gap()],
            Part::Leaving(pair) => self.pairs()[pair].leaving(),
            Part::Holding(pair) => self.pairs()[pair].within(),
            Part::Slip(pair) => vec![self.pairs()[pair].slip_rate()],
            Part::Slopes(pair) => self.gap_slopes(pair).unwrap_or_default(),
            Part::Lightness(body) => vec![1 / &self.mass_properties(body).mass],
            Part::Size(body) => vec![self.model().bodies[body].reach() * 2],
            Part::Response(row, pusher) => vec![self.row_response(&self.row(row), &self.wrenches(pusher))],
            Part::RowAcceleration(row) => vec![self.row(row).acceleration],
            Part::Torque(pusher, body) => vec![torque_on(&self.wrenches(pusher), body)],
            Part::Turning(row, body) => vec![torque_on(&self.row(row).wrenches, body)],
            Part::Recoil(body, pusher) => self.recoil(body, &self.wrenches(pusher)),
            Part::Kept(_) | Part::Root(_) => unreachable!("they are prepared with their slopes"),
        }
    }

    fn kept(&self, of: RowOf) -> Piece {
        let row = self.row(of);
        match of {
            RowOf::Slip(_) | RowOf::Brake(_) => self.sorted(vec![row.rate], &[row.measure.rate()]),
            _ => self.sorted(vec![row.position, row.rate], &[row.measure, row.measure.rate()]),
        }
    }

    /// How fast the gap of a pair can change with each coordinate of its bodies, where that is bounded.
    fn gap_slopes(&self, pair: usize) -> Option<Vec<Expr>> {
        let pair = &self.pairs()[pair];
        let model = self.model();
        let of = |index: usize| {
            let body = &model.bodies[index];
            pair.slopes(index, model.pivot_of(&body.name), body)
        };
        let all: Option<Vec<Vec<Expr>>> = pair.bodies().map(of).collect();
        all.map(|all| all.concat())
    }

    /// What a unit of something is on bodies.
    fn wrenches(&self, of: Pusher) -> Vec<Wrench> {
        match of {
            Pusher::Row(RowOf::Brake(brake)) => self.brakes()[brake].pushes.clone(),
            Pusher::Row(row) => self.row(row).wrenches,
            Pusher::Load(load, name) => {
                let names = self.names();
                vec![feedback::for_each_unit(&self.loads()[load], names.get(name).0)]
            }
        }
    }

    fn recoil(&self, body: usize, wrenches: &[Wrench]) -> Vec<Expr> {
        let own = wrenches.iter().filter(|wrench| wrench.body == body);
        let none = Vector::planar(Expr::zero(), Expr::zero());
        let sum = own.fold(none, |sum, wrench| sum + self.body_equations(body).recoil(wrench));
        sum.components().to_vec()
    }

    fn row_response(&self, row: &Row, pushed: &[Wrench]) -> Expr {
        let both = row.wrenches.iter().flat_map(|own| pushed.iter().map(move |other| (own, other)));
        let shared = both.filter(|(own, other)| own.body == other.body);
        let each = shared.map(|(own, other)| self.body_equations(own.body).response(own, other));
        each.fold(Expr::zero(), |sum, response| sum + response)
    }
}

impl Class {
    /// Of what is computed, or of functions that are kept zero, with their slopes by the states that they depend on.
    fn of(signature: Vec<Expr>, outline: &Skeleton, kept: &[Measure], names: &Names) -> Self {
        let place = |symbol: &Symbol| outline.symbols().iter().position(|known| known == symbol);
        let (mut formulas, mut slopes) = (vec![], vec![]);
        for (function, measure) in signature.iter().zip(kept) {
            let used = function.symbols();
            let is_own = |symbol: &Symbol| {
                used.contains(symbol) && names.find(symbol).is_some_and(|name| names.is_state(name))
            };
            let states = outline.symbols().iter().enumerate().filter(|(_, symbol)| is_own(symbol));
            formulas.push(function.clone());
            formulas.extend(states.clone().map(|(_, state)| function.derivative(state)));
            slopes.push((*measure, states.map(|(place, _)| place).collect()));
        }
        if kept.is_empty() {
            formulas.clone_from(&signature);
        }
        let (code, imports) = match Fragment::new(&formulas) {
            Ok(Fragment { code, imports }) => (Ok(code), imports.iter().filter_map(place).collect()),
            Err(mistake) => (Err(mistake), (0..outline.symbols().len()).collect()),
        };
        Self { signature, outline: outline.clone(), formulas, code, imports, kept: slopes }
    }
}

impl Piece {
    /// The one of a class that has these symbols in its outline.
    fn of(class: Arc<Class>, symbols: &[Symbol], names: &Names) -> Self {
        let import = |symbol: &Symbol| Import { name: names.find(symbol), symbol: symbol.clone() };
        let states =
            |places: &Vec<usize>| places.iter().filter_map(|place| names.find(&symbols[*place])).collect();
        let kept = class.kept.iter().map(|(measure, places)| (*measure, states(places))).collect();
        Self { class, symbols: symbols.iter().map(import).collect(), kept }
    }

    /// In the order of the code.
    pub(crate) fn imports(&self) -> impl ExactSizeIterator<Item = &Import> {
        self.class.imports.iter().map(|place| &self.symbols[*place])
    }

    /// The formulas, for values of the imports.
    pub(crate) fn written(&self, imports: &[Expr]) -> Vec<Expr> {
        let own: HashMap<usize, &Expr> = self.class.imports.iter().copied().zip(imports).collect();
        let mut substitution = Substitution::default();
        for (place, symbol) in self.class.outline.symbols().iter().enumerate() {
            // What is no import has no part in any value.
            let value = own.get(&place).copied().cloned();
            let value = value.unwrap_or_else(|| self.symbols[place].symbol.clone().into());
            if !matches!(value.node(), Node::Symbol(own) if own == symbol) {
                substitution.insert(symbol.clone(), value);
            }
        }
        substitution.apply_all(&self.class.formulas)
    }
}

fn locked<T>(of: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    of.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Symbols for all that acts on a body, as a force and a torque.
pub(crate) fn total(body: &str) -> (Vector, Expr) {
    let [x, y, torque] = totals(body).map(Expr::from);
    (Vector::planar(x, y), torque)
}

#[cfg(test)]
mod tests {
    use tumble_expr::units::{KG, M};

    use super::*;
    use crate::{Anchor, Body, Joint, Model};

    /// Rods, each pinned to the one before; the last is heavier.
    fn chain() -> Equations {
        let mut model = Model::new();
        let mut above = Anchor::World(Vector::planar(0 * M, 0 * M));
        for (index, mass) in [1, 1, 1, 2].into_iter().enumerate() {
            let rod = Body::rod(format!("rod{index}"), [0 * M, 0 * M], [0 * M, -1 * M]).mass(mass * KG);
            let rod = rod.with_point("top", [0 * M, 0 * M]).with_point("tip", [0 * M, -1 * M]);
            let body = model.add(rod);
            let end = |point| Anchor::Material(body.named_point(point).expect("given"));
            model.join(Joint::pin(format!("joint{index}"), [above, end("top")]));
            above = end("tip");
        }
        Equations::new(model).expect("a model")
    }

    #[test]
    fn what_differs_by_names_alone_is_prepared_once() {
        let equations = chain();
        let class = |part: Part| Arc::as_ptr(&equations.piece(part).class);
        let row = |joint: usize| RowOf::Joint(joint, 0);
        assert_eq!(class(Part::Kept(row(1))), class(Part::Kept(row(2))));
        assert_eq!(class(Part::RowAcceleration(row(1))), class(Part::RowAcceleration(row(3))));
        let response = |i: usize, j: usize| Part::Response(row(i), Pusher::Row(row(j)));
        assert_eq!(class(response(0, 1)), class(response(0, 1)));
        assert_eq!(class(Part::Acceleration(0)), class(Part::Acceleration(2)));
        assert_ne!(class(Part::Acceleration(0)), class(Part::Acceleration(3)));
        // The hook holds the first: there is one body less.
        assert_ne!(class(Part::Kept(row(0))), class(Part::Kept(row(1))));
        let [own, other] = [1, 2].map(|joint| equations.piece(Part::Kept(row(joint))));
        let names =
            |piece: &Piece| piece.imports().map(|import| import.symbol.name.to_string()).collect::<Vec<_>>();
        let renamed = |name: &String| name.replace("rod1", "rod2").replace("rod0", "rod1");
        assert_eq!(names(&own).iter().map(renamed).collect::<Vec<_>>(), names(&other));
    }
}
