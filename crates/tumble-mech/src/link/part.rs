//! What there are equations of, and those equations, prepared once.

use std::collections::{HashMap, HashSet};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use tumble_expr::{Code, CompileError, Expr, Formulas, Fragment, Substitution, Symbol, Vector};
use tumble_ode::Watched;

use super::names::{Name, Names, totals};
use crate::cache::Cache;
use crate::coordinates::Measure;
use crate::equations::Equations;
use crate::laws::compliant;
use crate::parameters::time_symbol;
use crate::row::Row;
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
    /// Force along x and y of a term, and its torque about what the body turns about.
    Term(TermOf),
    /// The force of a pair that is pressed.
    Pressed(usize),
    /// The gap of a pair.
    Gap(usize),
    /// How fast it can change with each coordinate; nothing where there is no bound.
    Slopes(usize),
    /// What a unit of force does to a body.
    Lightness(usize),
    /// The length that a body's places are measured against.
    Size(usize),
    /// What a unit of one row's multiplier does to another's acceleration.
    Response(RowOf, RowOf),
    /// Acceleration of a row, in the accelerations of its bodies.
    RowAcceleration(RowOf),
    /// Torque of a unit of a row's multiplier on a body about its centre.
    Torque(RowOf, usize),
    /// What is zero while a row holds: its position, then its rate, each with its slopes by states.
    Kept(RowOf),
    /// What is zero while the root of a pair's depth is a state, with its slopes.
    Root(usize),
}

/// A term of the model, by its index; of a joint by the joint's and its own there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum TermOf {
    Load(usize),
    Pair(usize),
    Joint(usize, usize),
}

/// A row, by the index of its pair, or of its joint and its own there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum RowOf {
    Joint(usize, usize),
    Pair(usize),
}

/// Formulas, ready to be linked.
#[derive(Debug)]
pub(crate) struct Piece {
    pub(crate) formulas: Vec<Expr>,
    /// In the order of the code.
    pub(crate) imports: Vec<Import>,
    pub(crate) code: Result<Arc<Code>, CompileError>,
    /// Of functions that are kept zero: kind of each, and the states that its slopes are by, which follow it.
    pub(crate) kept: Vec<(Measure, Vec<Name>)>,
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
    parts: Mutex<HashMap<Part, Arc<Piece>>>,
    /// Those of formulas from elsewhere: of observers, events and changes.
    written: Cache<Formulas, Piece>,
    /// Code of parts, which those that differ by names alone share.
    codes: Mutex<HashSet<Arc<Code>>>,
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
        // Not under the lock: two threads may both prepare it, and one of the two is kept.
        let mut piece = match part {
            Part::Kept(row) => self.kept(&self.row(row)),
            Part::Root(pair) => {
                let formula = compliant::root_invariant(&self.pairs()[pair]);
                self.kept_zero(&[(formula, Measure::Length)])
            }
            part => Piece::of(self.formulas_of(part), &self.names()),
        };
        if let Ok(code) = &mut piece.code {
            let mut codes = locked(&library.codes);
            match codes.get(&*code) {
                Some(known) => *code = Arc::clone(known),
                None => _ = codes.insert(Arc::clone(code)),
            }
        }
        Arc::clone(locked(&library.parts).entry(part).or_insert_with(|| Arc::new(piece)))
    }

    /// Formulas from elsewhere.
    pub(super) fn written_piece(&self, formulas: &[Expr]) -> Arc<Piece> {
        let build = || Ok::<_, std::convert::Infallible>(Piece::of(formulas.to_vec(), &self.names()));
        let found = self.library().written.get(&Formulas::new(formulas), build);
        found.unwrap_or_else(|never| match never {})
    }

    /// The gap of a pair, to be watched while it is open.
    pub(super) fn watched_gap(&self, pair: usize, changes: &[usize]) -> Arc<Watched> {
        let build = || {
            let of = &self.pairs()[pair];
            let mut changed = Substitution::default();
            self.changes_by(changes).for_each(|(symbol, formula)| changed.insert(symbol, formula));
            let gap = changed.apply(&self.in_coordinates(&of.gap()));
            let body = self.body_equations(of.body);
            let states = body.coordinates.states(&body.kinematics);
            let states: Vec<Symbol> = states.into_iter().map(|state| state.symbol).collect();
            let inputs = self.model().parameters.symbols();
            Ok::<_, std::convert::Infallible>(Watched::new(gap, &states, &time_symbol(), &inputs))
        };
        let found = self.library().watched.get(&(pair, changes.to_vec()), build);
        let found = found.unwrap_or_else(|never| match never {});
        Arc::clone(&found)
    }

    pub(crate) fn term(&self, of: TermOf) -> &Term {
        match of {
            TermOf::Load(index) => &self.loads()[index],
            TermOf::Pair(pair) => &self.pair_list().terms[pair],
            TermOf::Joint(joint, index) => &self.joints()[joint].terms[index],
        }
    }

    pub(super) fn row(&self, of: RowOf) -> Row {
        match of {
            RowOf::Pair(pair) => self.pairs()[pair].row(),
            RowOf::Joint(joint, row) => self.joints()[joint].rows[row].clone(),
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
            Part::Slopes(pair) => self.gap_slopes(pair).unwrap_or_default(),
            Part::Lightness(body) => vec![1 / &self.mass_properties(body).mass],
            Part::Size(body) => vec![self.model().bodies[body].reach() * 2],
            Part::Response(i, j) => vec![self.row_response(&self.row(i), &self.row(j))],
            Part::RowAcceleration(row) => vec![self.row(row).acceleration],
            Part::Torque(row, body) => vec![self.row(row).torque_on(body)],
            Part::Kept(_) | Part::Root(_) => unreachable!("they are prepared with their slopes"),
        }
    }

    fn kept(&self, row: &Row) -> Piece {
        let [position, rate] = [&row.position, &row.rate].map(Expr::clone);
        self.kept_zero(&[(position, row.measure), (rate, row.measure.rate())])
    }

    /// Functions that are kept zero, with their slopes by the states that they depend on.
    fn kept_zero(&self, functions: &[(Expr, Measure)]) -> Piece {
        let names = self.names();
        let (mut formulas, mut kept) = (vec![], vec![]);
        for (function, measure) in functions {
            let function = self.in_coordinates(function);
            let used = function.symbols();
            let states = used.into_iter().filter_map(|symbol| Some((names.find(&symbol)?, symbol)));
            let mut states: Vec<(Name, Symbol)> = states.filter(|(name, _)| names.is_state(*name)).collect();
            states.sort_unstable_by_key(|(name, _)| *name);
            formulas.push(function.clone());
            formulas.extend(states.iter().map(|(_, state)| function.derivative(state)));
            kept.push((*measure, states.into_iter().map(|(name, _)| name).collect()));
        }
        Piece { kept, ..Piece::of(formulas, &names) }
    }

    /// How fast the gap of a pair can change with each coordinate of its body, where that is bounded.
    fn gap_slopes(&self, pair: usize) -> Option<Vec<Expr>> {
        let pair = &self.pairs()[pair];
        let body = &self.model().bodies[pair.body];
        pair.slopes(self.model().pivot_of(&body.name), body)
    }

    fn row_response(&self, i: &Row, j: &Row) -> Expr {
        let both = i.wrenches.iter().flat_map(|own| j.wrenches.iter().map(move |other| (own, other)));
        let shared = both.filter(|(own, other)| own.body == other.body);
        let each = shared.map(|(own, other)| self.body_equations(own.body).response(own, other));
        each.fold(Expr::zero(), |sum, response| sum + response)
    }
}

impl Piece {
    fn of(formulas: Vec<Expr>, names: &Names) -> Self {
        let import = |symbol: Symbol| Import { name: names.find(&symbol), symbol };
        let (code, imports) = match Fragment::new(&formulas) {
            Ok(Fragment { code, imports }) => (Ok(code), imports),
            Err(mistake) => (Err(mistake), Expr::symbols_of(&formulas).into_iter().collect()),
        };
        Self { formulas, imports: imports.into_iter().map(import).collect(), code, kept: vec![] }
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
