//! The equations of motion of one body in one mode: solved for accelerations, or with what holds it by name.

use std::cell::OnceCell;
use std::collections::HashSet;

use tumble_expr::language::Value;
use tumble_expr::{Expr, Graph, Node, Symbol, Written, is_identically_zero};
use tumble_mech::{Mode, Pivot, Term};
use tumble_notation::{Left, Math, Notation, Printed, monomial_of};
use tumble_scene::Study;

use super::conditions::{self, combined, last_of, shortest};
use super::incline::{self, Incline};
use super::names::Names;
use super::reduced::{self, Reduced, Solved, simple};
use super::{pivots, sum};
use crate::results::Case;

/// Equations of more signs than these are not read by anybody: forces stand in them by name.
const MOST_SIGNS: usize = 800;
/// Formulas of more operations than this come to more signs than are read anywhere: they are not even brought into a short form,
/// which takes long.
const MOST_OPERATIONS: usize = 300;

/// What is told of in a mode of a case.
#[derive(Clone, Copy)]
pub(super) struct Setting<'a> {
    pub(super) study: &'a Study,
    pub(super) names: &'a Names,
    pub(super) case: &'a Case,
    pub(super) mode: &'a Mode,
}

/// The equations of motion of one body in one mode, with the names they are shown by.
///
/// Forces of joints and of several lasting contacts stand in them by name, and what determines them below: solved for, they would
/// be a matrix's inverse.
pub(super) struct Motion {
    pub(super) body: usize,
    /// Ways to write them, of which the shortest is taken.
    notations: Vec<Notation>,
    pub(super) lines: Vec<Line>,
    /// What Newton's laws for it read, where they are meant as the model states them: what is said here is said beside them.
    pub(super) by_law: Vec<Symbol>,
    /// Whether it says what follows from the motion.
    pub(super) follows: bool,
    /// What is shown, once somebody has asked: exact algebra takes longer than anything else in a report.
    shown: OnceCell<Option<Printed>>,
}

/// An equation, solved for what stands on its left side.
pub(super) struct Line {
    pub(super) left: Left,
    pub(super) right: Expr,
    /// What the symbol on the left side is; 0 of a condition. The tests hold the right side against it.
    pub(super) is: Expr,
}

impl Line {
    fn new(left: Left, right: Expr, is: impl Into<Expr>) -> Self {
        Self { left, right, is: is.into() }
    }
}

impl Setting<'_> {
    /// The equations of all bodies in a mode: reduced where joints and contacts allow, and then how their forces follow.
    pub(super) fn motions(&self) -> Vec<Motion> {
        let Self { study, names, case, mode } = *self;
        let conditions: Vec<Expr> = (0..study.model.bodies.len())
            .flat_map(|body| {
                let constraints = case.run.equations.shown_constraints(mode, body);
                constraints.into_iter().filter(move |constraint| last_of(study, constraint) == Some(body))
            })
            .collect();
        let solved = reduced::of(study, case, mode, &conditions);
        let of_body = |body: usize| match &solved {
            Some(solved) if solved.motion.iter().any(|one| one.body == body) => {
                std::iter::once(self.reduced(body, solved)).chain(self.following(body, solved)).collect()
            }
            Some(solved) if solved.follow.iter().any(|(other, ..)| *other == body) => {
                self.following(body, solved).into_iter().collect()
            }
            _ => vec![self.motion(body)],
        };
        let mut motions: Vec<Motion> = (0..study.model.bodies.len()).flat_map(of_body).collect();
        self.add_ties(&mut motions);
        name_alike(&mut motions, names);
        motions
    }

    /// Says of friction that slides what it is, where it is first read of.
    fn add_ties(&self, motions: &mut [Motion]) {
        for (symbol, force) in self.case.run.equations.shown_ties(self.mode) {
            let reads = |motion: &&mut Motion| {
                motion.by_law.contains(&symbol)
                    || motion.lines.iter().any(|line| line.right.symbols().contains(&symbol))
            };
            let left = Left::symbol(Math::symbol(self.names.shown(&symbol.name)));
            let line = Line::new(left, force, symbol.clone());
            if let Some(motion) = motions.iter_mut().find(reads) {
                motion.lines.push(line);
            }
        }
    }

    pub(super) fn motion(&self, body: usize) -> Motion {
        let Self { study, names, case, mode } = *self;
        let equations = &case.run.equations;
        let model_body = &study.model.bodies[body];
        let kinematics = model_body.kinematics();
        let constraints = equations.shown_constraints(mode, body);
        let is_joined = study.model.joints.iter().enumerate().any(|(index, joint)| {
            equations.holds(mode, index) && joint.bodies().any(|name| name == model_body.name)
        });
        let is_solved = constraints.len() < 2 && !is_joined;
        let pivot = study.model.pivot_of(&model_body.name);
        let notation = names.of_body(body).with_mass().notation().clone();
        let (notation, mut lines) = match (pivot, is_solved) {
            (Some(_), true) => {
                let symbol = kinematics.alpha_symbol();
                let alpha = equations.in_states(mode, &symbol.clone().into());
                (notation, vec![Line::new(second(study, names, body), alpha, symbol)])
            }
            (Some(pivot), false) => {
                let inertia = pivots::inertia(case, body, pivot);
                let line = self.turned((body, pivot), &inertia);
                (named_inertia(notation, study, body, &inertia), vec![line])
            }
            (None, _) => (notation, self.free(body, is_solved)),
        };
        let mut by_law = vec![];
        if !is_solved {
            let of_pivots = pivots::accelerations(study, case);
            // What two bodies share stands with the later one.
            let own = constraints.iter().filter(|constraint| last_of(study, constraint) == Some(body));
            let own: Vec<Expr> = own.map(|constraint| of_pivots.apply(constraint)).collect();
            let lies = !is_joined && conditions::lies(study, equations, mode, body);
            let own = if lies { conditions::without_turning(&kinematics, own) } else { own };
            let own: Vec<Expr> =
                own.iter().map(|constraint| shortest(study, &notation, constraint)).collect();
            // At a joint each says where two bodies meet.
            let conditions = if is_joined { own } else { combined(study, &notation, own) };
            if pivot.is_none() && !conditions.is_empty() {
                let laws = lines.extract_if(.., |line| !is_identically_zero(&line.is));
                by_law = laws.flat_map(|line| line.right.symbols()).collect();
            }
            lines.extend(
                conditions.into_iter().map(|condition| Line::new(nothing(), condition, Expr::zero())),
            );
        }
        if let Some(Incline { along, across }) = incline::of(self, body) {
            if is_solved {
                lines.splice(..2, [along, across]);
            } else {
                lines.push(along);
            }
        }
        Motion { by_law, ..Motion::made(body, self.with_parts(body, notation), lines) }
    }

    /// Without the forces of joints and lasting contacts.
    fn reduced(&self, body: usize, solved: &Solved) -> Motion {
        let Self { study, names, .. } = *self;
        let parameters = study.model.parameters.symbols();
        let is_fixed = |formula: &Expr| formula.symbols().iter().all(|symbol| parameters.contains(symbol));
        let is_turning = |symbol: &Symbol| *symbol == study.model.bodies[body].kinematics().alpha_symbol();
        let line = |one: &Reduced| {
            let shown = Math::symbol(names.shown(&one.symbol.name));
            let left = match (is_fixed(&one.inertia), is_turning(&one.symbol)) {
                (true, true) => second(study, names, body),
                (true, false) => Left::times(&one.inertia, shown),
                // What it is a multiple of stands on the other side alone.
                (false, _) => {
                    let before = monomial_of(&one.inertia).unwrap_or_else(Expr::one);
                    Left::times(&(&one.inertia / before), shown)
                }
            };
            Line::new(left, &one.right / &one.inertia, one.symbol.clone())
        };
        let lines = solved.motion.iter().filter(|one| one.body == body).map(line).collect();
        // The moment of inertia becomes a number with those of the conditions.
        Motion::made(body, self.with_parts(body, names.written_notation().clone()), lines)
    }

    /// The accelerations that follow from the motion, and the forces that they tell of.
    fn following(&self, body: usize, solved: &Solved) -> Option<Motion> {
        let Self { study, names, case, mode } = *self;
        let equations = &case.run.equations;
        let own: Vec<_> = solved.follow.iter().filter(|(other, ..)| *other == body).collect();
        let terms = equations.shown_terms(mode);
        let axes = study.model.bodies[body].kinematics().acceleration_symbols();
        let mass = &equations.mass_properties(body).mass;
        let force = |axis: usize| {
            sum(terms.iter().filter(|term| term.body == body).map(|term| term.force[axis].clone()))
        };
        let lines = own.iter().flat_map(|(_, symbol, formula)| {
            let shown = || Math::symbol(names.shown(&symbol.name));
            let axis = usize::from(*symbol == axes[1]);
            let by_force = Line::new(Left::times(mass, shown()), force(axis) / mass, symbol.clone());
            [by_force, Line::new(Left::symbol(shown()), formula.clone(), symbol.clone())]
        });
        let notations = vec![names.of_body(body).notation().clone()];
        let follows = !own.is_empty();
        follows.then(|| Motion { follows, ..Motion::made(body, notations, lines.collect()) })
    }

    /// A notation, and the same with the lengths of vectors by their names, which laws explain: `|u|`.
    fn with_parts(&self, body: usize, notation: Notation) -> Vec<Notation> {
        let statements = self.case.run.equations.shown_statements(self.mode);
        let own = statements.iter().filter(|stated| stated.body == body);
        let mut parts = notation.clone();
        for stated in own {
            for named in stated.force.iter().flat_map(Written::names).filter(|named| named.of.is_none()) {
                let name = self.names.of_law(&named.name, &stated.load);
                if let (Written::Sum(_), Some(Value::Vector(vector))) = (&named.is, named.is.value(1)) {
                    parts = parts.define(format!("|{name}|"), &vector.norm());
                }
            }
        }
        vec![parts, notation]
    }

    /// `M A = sum F` and `I alpha = sum tau`, solved for where nothing stands by its name.
    fn free(&self, body: usize, is_solved: bool) -> Vec<Line> {
        let Self { names, case, mode, .. } = *self;
        let equations = &case.run.equations;
        let kinematics = equations.model().bodies[body].kinematics();
        let mass = equations.mass_properties(body);
        let terms = if is_solved { vec![] } else { equations.shown_terms(mode) };
        let times = |factor: &Expr, symbol: &Symbol, part: fn(&Term) -> Expr| {
            let left = Left::times(factor, Math::symbol(names.shown(&symbol.name)));
            let own = terms.iter().filter(|term| term.body == body);
            let right = match is_solved {
                true => equations.in_states(mode, &symbol.clone().into()),
                false => sum(own.map(part)) / factor,
            };
            Line::new(left, right, symbol.clone())
        };
        let [ax, ay] = kinematics.acceleration_symbols();
        let mut lines = vec![
            times(&mass.mass, &ax, |term| term.force.x().clone()),
            times(&mass.mass, &ay, |term| term.force.y().clone()),
        ];
        let torque = sum(terms.iter().filter(|term| term.body == body).map(Term::torque));
        if !is_identically_zero(&mass.inertia) {
            lines.push(times(&mass.inertia, &kinematics.alpha_symbol(), Term::torque));
        } else if !is_identically_zero(&torque) {
            // A point mass on a massless rod.
            lines.push(Line::new(nothing(), torque, Expr::zero()));
        }
        if is_solved {
            cancel_mass(&mass.mass, &mut lines);
        }
        lines
    }

    /// `I_P alpha = sum tau` of a body about its pivot, with the forces of joints by their names; where the pivot moves, less
    /// `M r x A_P`.
    fn turned(&self, (body, pivot): (usize, &Pivot), inertia: &Expr) -> Line {
        let Self { names, case, mode, .. } = *self;
        let symbol = case.run.equations.model().bodies[body].kinematics().alpha_symbol();
        let terms = case.run.equations.shown_terms(mode);
        let own: Vec<Term> = terms.into_iter().filter(|term| term.body == body).collect();
        let left = Left::times(inertia, Math::symbol(names.shown(&symbol.name)));
        Line::new(left, pivots::torque(case, (body, pivot), &own) / inertia, symbol)
    }
}

impl Motion {
    fn made(body: usize, notations: Vec<Notation>, lines: Vec<Line>) -> Self {
        Self { body, notations, lines, by_law: vec![], follows: false, shown: OnceCell::new() }
    }

    /// In the way that has the shortest equations; what laws have explained is not explained again.
    pub(super) fn shown(&self) -> Option<&Printed> {
        self.shown.get_or_init(|| self.shortest_way()).as_ref()
    }

    fn shortest_way(&self) -> Option<Printed> {
        let sides: Vec<(Left, Expr)> =
            self.lines.iter().map(|line| (line.left.clone(), line.right.clone())).collect();
        let ways = self.notations.iter().filter_map(|notation| notation.equations(&sides).ok());
        let signs = |shown: &Printed| Printed { definitions: vec![], ..shown.clone() }.text().chars().count();
        let mut shown = ways.min_by_key(signs)?;
        shown.definitions.retain(|line| !matches!(line.left, Some(Math::Bars(_))));
        Some(shown)
    }

    /// Whether it is shorter than anybody reads.
    pub(super) fn is_short(&self) -> bool {
        operations(self.lines.iter().map(|line| &line.right)) <= MOST_OPERATIONS
            && self.shown().is_some_and(|shown| shown.text().chars().count() <= MOST_SIGNS)
    }
}

/// Leaves the mass out where all forces are multiples of it, and the moment of inertia where nothing turns the body beside. Where nothing acts
/// at all, Newton's laws stay as they are.
fn cancel_mass(mass: &Expr, lines: &mut [Line]) {
    let rights: Vec<Expr> = lines.iter().map(|line| simple(&line.right)).collect();
    let is_free = |right: &Expr| right.symbols().is_disjoint(&mass.symbols());
    if mass.symbols().is_empty() || rights.iter().all(is_identically_zero) || !rights[..2].iter().all(is_free)
    {
        return;
    }
    let is_along =
        |line: &Line| line.left.factor.as_ref().is_some_and(|factor| is_identically_zero(&(factor - mass)));
    for (line, right) in lines.iter_mut().zip(&rights) {
        if is_along(line) || is_identically_zero(right) {
            line.left.factor = None;
        }
    }
}

/// An angular acceleration that others read is called the same where it is stated.
fn name_alike(motions: &mut [Motion], names: &Names) {
    let equations = motions.iter().filter(|motion| !motion.follows);
    let rights = equations.flat_map(|motion| &motion.lines).map(|line| line.right.symbols());
    let read: HashSet<Symbol> = rights.flatten().collect();
    for line in motions.iter_mut().flat_map(|motion| &mut motion.lines) {
        if let Node::Symbol(symbol) = line.is.node()
            && line.left.factor.is_none()
            && read.contains(symbol)
        {
            line.left = Left::symbol(Math::symbol(names.shown(&symbol.name)));
        }
    }
}

/// How many different operations, numbers and names formulas consist of.
fn operations<'a>(formulas: impl IntoIterator<Item = &'a Expr>) -> usize {
    let formulas: Vec<Expr> = formulas.into_iter().cloned().collect();
    let mut graph = Graph::default();
    graph.import(&formulas);
    graph.nodes().len()
}

fn named_inertia(notation: Notation, study: &Study, body: usize, inertia: &Expr) -> Notation {
    match inertia.symbols().is_empty() {
        true => notation,
        false => notation.define(inertia_name(study, &study.model.bodies[body].name), inertia),
    }
}

/// `I_P`, with the body's name where there are several.
pub(super) fn inertia_name(study: &Study, body: &str) -> String {
    if study.model.bodies.len() > 1 { format!("I_P,{body}") } else { "I_P".to_owned() }
}

/// The left side of what is zero.
pub(super) fn nothing() -> Left {
    Left::symbol(Math::Number("0".to_owned()))
}

/// `theta''`
pub(super) fn second(study: &Study, names: &Names, body: usize) -> Left {
    let angle = study.model.bodies[body].kinematics().angle_symbol();
    Left::symbol(Math::derivative(names.shown(&angle.name), 2))
}
