//! The equations of motion as they were integrated, in the symbols of the scene.

use std::cell::OnceCell;
use std::collections::HashSet;

use crate::report::{Block, Definition, ModeEquations, Text};
use tumble_expr::language::Value;
use tumble_expr::{Expr, Node, Substitution, Symbol, Vector, Written, is_identically_zero};
use tumble_mech::{Anchor, ContactMode, Joint, Mode, Pivot, Term, rotated};
use tumble_notation::{Left, Math, Notation, Printed};
use tumble_ode::Piece;
use tumble_scene::Study;

use super::alike::Kind;
use super::model::{MOST_OPERATIONS, operations};
use super::names::{Names, math};
use super::once::{BESIDE_LAWS, BY_NAME, OTHERS_BY_NAME, defined_once, told_once};
use super::reduced::{self, Reduced, Solved};
use super::words;
use crate::figures::symbols;
use crate::results::Case;

/// Equations of more signs than these are not read by anybody: forces stand in them by name.
const MOST_SIGNS: usize = 800;
/// Signs that a fraction is worth.
const FRACTION: usize = 10;
/// More modes than this are told of in the table of events only.
const MOST_MODES: usize = 6;

/// The equations of motion in each mode that the motion went through.
pub(super) fn modes(study: &Study, names: &Names, case: &Case, kinds: &[Kind]) -> Vec<ModeEquations> {
    let modes = lasting(case);
    let told: Vec<usize> = kinds.iter().flat_map(Kind::told).copied().collect();
    let shown = modes.iter().take(MOST_MODES).map(|mode| {
        let mut motions = motions(study, names, case, mode);
        motions.retain(|motion| told.contains(&motion.body));
        let blocks: Vec<Block> =
            motions.iter().filter_map(|motion| equations_of(study, names, motion)).collect();
        let is_short = |body: &usize| motions.iter().any(|motion| motion.body == *body && motion.is_short());
        let holds = match (told.iter().all(is_short), blocks.is_empty()) {
            (true, _) => "",
            (false, true) => BY_NAME,
            (false, false) => OTHERS_BY_NAME,
        };
        let blocks = defined_once(blocks);
        ModeEquations {
            name: match modes.len() {
                1 => Text::default(),
                _ => words::mode(study, &case.run.equations, mode).into(),
            },
            holds: holds.into(),
            equations: blocks,
        }
    });
    let told = shown.fold(vec![], told_once).into_iter();
    told.map(|mode| ModeEquations { name: mode.name.capitalised(), ..mode }).collect()
}

/// The modes in which the motion has stayed: at the instant of the start there may be another one, and while impacts end that are too low to be
/// followed it stays for no time that a reader knows of.
fn lasting(case: &Case) -> Vec<&Mode> {
    let trajectory = case.run.trajectory();
    let settles = |mode: &Mode| mode.contacts.iter().any(|(_, contact)| *contact == ContactMode::Settling);
    let lasts = |number: &usize| {
        let stays = |piece: &Piece| piece.mode == *number && piece.end > piece.start;
        trajectory.pieces.iter().any(stays) && !settles(&trajectory.modes[*number])
    };
    (0..trajectory.modes.len()).filter(lasts).map(|number| &trajectory.modes[number]).collect()
}

/// The equations of all bodies in a mode: reduced where joints and contacts allow, and then how their forces follow.
fn motions(study: &Study, names: &Names, case: &Case, mode: &Mode) -> Vec<Motion> {
    let conditions: Vec<Expr> = (0..study.model.bodies.len())
        .flat_map(|body| {
            let constraints = case.run.equations.shown_constraints(mode, body);
            constraints.into_iter().filter(move |constraint| last_of(study, constraint) == Some(body))
        })
        .collect();
    let solved = reduced::of(study, case, mode, &conditions);
    let of_body = |body: usize| match &solved {
        Some(solved) if solved.motion.iter().any(|one| one.body == body) => {
            let motion = Motion::reduced(study, names, case, mode, body, solved);
            let follow = Motion::following(study, names, case, mode, body, solved);
            std::iter::once(motion).chain(follow).collect()
        }
        Some(solved) if solved.follow.iter().any(|(other, ..)| *other == body) => {
            Motion::following(study, names, case, mode, body, solved).into_iter().collect()
        }
        _ => vec![Motion::of(study, names, case, mode, body)],
    };
    let mut motions: Vec<Motion> = (0..study.model.bodies.len()).flat_map(of_body).collect();
    add_ties(&mut motions, names, case, mode);
    name_alike(&mut motions, names);
    motions
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

/// Says of friction that slides what it is, where it is first read of.
fn add_ties(motions: &mut [Motion], names: &Names, case: &Case, mode: &Mode) {
    for (symbol, force) in case.run.equations.shown_ties(mode) {
        let reads = |motion: &&mut Motion| {
            motion.by_law.contains(&symbol)
                || motion.lines.iter().any(|line| line.right.symbols().contains(&symbol))
        };
        let left = Left::symbol(Math::symbol(names.shown(&symbol.name)));
        let line = Line::new(left, force, symbol.clone());
        if let Some(motion) = motions.iter_mut().find(reads) {
            motion.lines.push(line);
        }
    }
}

fn equations_of(study: &Study, names: &Names, motion: &Motion) -> Option<Block> {
    let shown = motion.shown().filter(|_| motion.is_short())?.clone();
    let body = symbols::bare(&study.model.bodies[motion.body].name);
    let is_beside = !motion.by_law.is_empty();
    let title = match (study.model.bodies.len() > 1, motion.follows) {
        (true, true) => format!("{body}, and the forces that hold it"),
        (false, true) => "The forces that hold it follow from".to_owned(),
        (true, false) if is_beside => format!("{body}, {BESIDE_LAWS}"),
        (true, false) => body,
        (false, false) if is_beside => Text::from(BESIDE_LAWS).capitalised().to_plain(),
        (false, false) => String::new(),
    };
    let mut block = names.shown_block(title.into(), Ok(shown));
    block.definitions.extend(seats(study, names, motion));
    block.definitions.extend(second_rate(study, names, motion));
    Some(block)
}

/// What `alpha` is where the equation of motion above says `theta''`.
fn second_rate(study: &Study, names: &Names, motion: &Motion) -> Option<Definition> {
    let alpha = study.model.bodies[motion.body].kinematics().alpha_symbol();
    let is_read = motion.shown()?.lines.iter().any(|line| line.formula.symbols().contains(&alpha));
    let is_told = motion.follows && is_read && study.model.bodies.len() == 1;
    let symbol = Math::symbol(names.shown(&alpha.name));
    let equation = Math::equation(symbol, second(names, study, motion.body).symbol);
    is_told.then(|| Definition { symbol: math(&equation), meaning: Text::default() })
}

/// What the places in equations mean at which joints were made on the way.
fn seats(study: &Study, names: &Names, motion: &Motion) -> Vec<Definition> {
    let used = |symbol: &Symbol| motion.lines.iter().any(|line| line.right.symbols().contains(symbol));
    let seated = study.model.joints.iter().filter(|joint| joint.is_seated);
    let definition = |joint: &Joint| {
        let Anchor::Material(point) = &joint.ends[1] else { return None };
        let symbols = point.arm.components().iter().flat_map(Expr::symbols);
        let mut own: Vec<Symbol> = symbols.filter(used).collect();
        own.sort_by(|a, b| a.name.cmp(&b.name));
        let parts = own.iter().map(|symbol| Math::symbol(names.shown(&symbol.name)));
        let parts: Vec<Vec<Math>> = parts.map(|part| vec![part]).collect();
        let (joint, body) = (symbols::joint(&joint.name), symbols::the(&point.body.body));
        let meaning = format!("where {joint} is on {body}, from its centre of mass, along its axes");
        (!parts.is_empty())
            .then(|| Definition { symbol: math(&Math::Matrix(parts)), meaning: meaning.into() })
    };
    seated.filter_map(definition).collect()
}

/// The equations of motion of one body in one mode, with the names they are shown by.
///
/// Forces of joints and of several lasting contacts stand in them by name, and what determines them below: solved for, they would
/// be a matrix's inverse.
struct Motion {
    body: usize,
    /// Ways to write them, of which the shortest is taken.
    notations: Vec<Notation>,
    lines: Vec<Line>,
    /// What Newton's laws for it read, where they are meant as the model states them: what is said here is said beside them.
    by_law: Vec<Symbol>,
    /// Whether it says what follows from the motion.
    follows: bool,
    /// What is shown, once somebody has asked: exact algebra takes longer than anything else in a report.
    shown: OnceCell<Option<Printed>>,
}

/// An equation, solved for what stands on its left side.
struct Line {
    left: Left,
    right: Expr,
    /// What the symbol on the left side is; 0 of a condition. The tests hold the right side against it.
    is: Expr,
}

impl Line {
    fn new(left: Left, right: Expr, is: impl Into<Expr>) -> Self {
        Self { left, right, is: is.into() }
    }
}

impl Motion {
    fn of(study: &Study, names: &Names, case: &Case, mode: &Mode, body: usize) -> Self {
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
                (notation, vec![Line::new(second(names, study, body), alpha, symbol)])
            }
            (Some(pivot), false) => {
                let inertia = about_pivot(case, body, pivot);
                let line = turned(names, case, mode, (body, pivot), &inertia);
                (named_inertia(notation, study, body, &inertia), vec![line])
            }
            (None, _) => (notation, free(names, case, mode, body, is_solved)),
        };
        let mut by_law = vec![];
        if !is_solved {
            let of_pivots = of_pivots(study, case);
            // What two bodies share stands with the later one.
            let own = constraints.iter().filter(|constraint| last_of(study, constraint) == Some(body));
            let own = own.map(|constraint| shortest(study, &notation, &of_pivots.apply(constraint)));
            let own: Vec<Expr> = own.collect();
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
        let notations = with_parts(case, mode, names, body, notation);
        Self { by_law, ..Self::made(body, notations, lines) }
    }

    fn made(body: usize, notations: Vec<Notation>, lines: Vec<Line>) -> Self {
        Self { body, notations, lines, by_law: vec![], follows: false, shown: OnceCell::new() }
    }

    /// Without the forces of joints and lasting contacts.
    fn reduced(study: &Study, names: &Names, case: &Case, mode: &Mode, body: usize, solved: &Solved) -> Self {
        let parameters = study.model.parameters.symbols();
        let is_fixed = |formula: &Expr| formula.symbols().iter().all(|symbol| parameters.contains(symbol));
        let is_turning = |symbol: &Symbol| *symbol == study.model.bodies[body].kinematics().alpha_symbol();
        let line = |one: &Reduced| {
            let shown = Math::symbol(names.shown(&one.symbol.name));
            let left = match is_fixed(&one.inertia) && is_turning(&one.symbol) {
                true => second(names, study, body),
                false => Left::times(&one.inertia, shown),
            };
            Line::new(left, &one.right / &one.inertia, one.symbol.clone())
        };
        let lines = solved.motion.iter().filter(|one| one.body == body).map(line).collect();
        // The moment of inertia becomes a number with those of the conditions.
        let notation = names.written_notation().clone();
        let notations = with_parts(case, mode, names, body, notation);
        Self::made(body, notations, lines)
    }

    /// The accelerations that follow from the motion, and the forces that they tell of.
    fn following(
        study: &Study,
        names: &Names,
        case: &Case,
        mode: &Mode,
        body: usize,
        solved: &Solved,
    ) -> Option<Self> {
        let equations = &case.run.equations;
        let own: Vec<_> = solved.follow.iter().filter(|(other, ..)| *other == body).collect();
        let terms = equations.shown_terms(mode);
        let axes = study.model.bodies[body].kinematics().acceleration_symbols();
        let mass = &equations.mass_properties(body).mass;
        let force = |axis: usize| {
            let terms = terms.iter().filter(|term| term.body == body);
            terms.fold(Expr::zero(), |sum, term| sum + &term.force[axis])
        };
        let lines = own.iter().flat_map(|(_, symbol, formula)| {
            let shown = || Math::symbol(names.shown(&symbol.name));
            let axis = usize::from(*symbol == axes[1]);
            let by_force = Line::new(Left::times(mass, shown()), force(axis) / mass, symbol.clone());
            [by_force, Line::new(Left::symbol(shown()), formula.clone(), symbol.clone())]
        });
        let notations = vec![names.of_body(body).notation().clone()];
        let follows = !own.is_empty();
        follows.then(|| Self { follows, ..Self::made(body, notations, lines.collect()) })
    }

    /// In the way that has the shortest equations; what laws have explained is not explained again.
    fn shown(&self) -> Option<&Printed> {
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
    fn is_short(&self) -> bool {
        operations(self.lines.iter().map(|line| &line.right)) <= MOST_OPERATIONS
            && self.shown().is_some_and(|shown| shown.text().chars().count() <= MOST_SIGNS)
    }
}

/// A notation, and the same with the lengths of vectors by their names, which laws explain: `|u|`.
fn with_parts(case: &Case, mode: &Mode, names: &Names, body: usize, notation: Notation) -> Vec<Notation> {
    let statements = case.run.equations.shown_statements(mode);
    let own = statements.iter().filter(|stated| stated.body == body);
    let mut parts = notation.clone();
    for stated in own {
        for named in stated.force.iter().flat_map(Written::names).filter(|named| named.of.is_none()) {
            let name = names.of_law(&named.name, &stated.load);
            if let (Written::Sum(_), Some(Value::Vector(vector))) = (&named.is, named.is.value(1)) {
                parts = parts.define(format!("|{name}|"), &vector.norm());
            }
        }
    }
    vec![parts, notation]
}

/// `theta''`
fn second(names: &Names, study: &Study, body: usize) -> Left {
    let angle = study.model.bodies[body].kinematics().angle_symbol();
    Left::symbol(Math::derivative(names.shown(&angle.name), 2))
}

fn named_inertia(notation: Notation, study: &Study, body: usize, inertia: &Expr) -> Notation {
    match inertia.symbols().is_empty() {
        true => notation,
        false => notation.define(inertia_name(study, &study.model.bodies[body].name), inertia),
    }
}

/// `M A = sum F` and `I alpha = sum tau`, solved for where nothing stands by its name.
fn free(names: &Names, case: &Case, mode: &Mode, body: usize, is_solved: bool) -> Vec<Line> {
    let equations = &case.run.equations;
    let kinematics = equations.model().bodies[body].kinematics();
    let mass = equations.mass_properties(body);
    let terms = if is_solved { vec![] } else { equations.shown_terms(mode) };
    let times = |factor: &Expr, symbol: &Symbol, part: fn(&Term) -> Expr| {
        let left = Left::times(factor, Math::symbol(names.shown(&symbol.name)));
        let own = terms.iter().filter(|term| term.body == body);
        let right = match is_solved {
            true => equations.in_states(mode, &symbol.clone().into()),
            false => own.map(part).fold(Expr::zero(), |sum, part| sum + part) / factor,
        };
        Line::new(left, right, symbol.clone())
    };
    let [ax, ay] = kinematics.acceleration_symbols();
    let mut lines = vec![
        times(&mass.mass, &ax, |term| term.force.x().clone()),
        times(&mass.mass, &ay, |term| term.force.y().clone()),
    ];
    let torque = own_torque(&terms, body);
    if !is_identically_zero(&mass.inertia) {
        lines.push(times(&mass.inertia, &kinematics.alpha_symbol(), Term::torque));
    } else if !is_identically_zero(&torque) {
        // A point mass on a massless rod.
        lines.push(Line::new(nothing(), torque, Expr::zero()));
    }
    lines
}

/// About its centre of mass.
fn own_torque(terms: &[Term], body: usize) -> Expr {
    let own = terms.iter().filter(|term| term.body == body);
    own.map(Term::torque).fold(Expr::zero(), |sum, torque| sum + torque)
}

/// The left side of what is zero.
fn nothing() -> Left {
    Left::symbol(Math::Number("0".to_owned()))
}

/// `I_P alpha = sum tau` of a body about its pivot, with the forces of joints by their names; where the pivot moves, less
/// `M r x A_P`.
fn turned(names: &Names, case: &Case, mode: &Mode, (body, pivot): (usize, &Pivot), inertia: &Expr) -> Line {
    let symbol = case.run.equations.model().bodies[body].kinematics().alpha_symbol();
    let terms = case.run.equations.shown_terms(mode);
    let own: Vec<Term> = terms.into_iter().filter(|term| term.body == body).collect();
    let left = Left::times(inertia, Math::symbol(names.shown(&symbol.name)));
    Line::new(left, pivot_torque(case, (body, pivot), &own) / inertia, symbol)
}

/// Torque of terms on a body about its pivot, less `M r x A_P` where that is moved.
pub(super) fn pivot_torque(case: &Case, (body, pivot): (usize, &Pivot), terms: &[Term]) -> Expr {
    let equations = &case.run.equations;
    let kinematics = equations.model().bodies[body].kinematics();
    let mass = equations.mass_properties(body);
    let arm = rotated(&(&mass.centre - &pivot.point), &kinematics.angle());
    let own = terms.iter().filter(|term| term.load != pivot.name);
    let torque =
        own.map(|term| term.torque_about(&(&arm + &term.arm))).fold(Expr::zero(), |sum, torque| sum + torque);
    torque - &mass.mass * arm.cross_planar(&acceleration(pivot))
}

/// Of the point that a pivot holds.
fn acceleration(pivot: &Pivot) -> Vector {
    let rate = |path: Vector| Anchor::World(path).velocity();
    rate(rate(pivot.world.clone()))
}

/// Accelerations of the centres of bodies on pivots, by how the bodies turn.
pub(super) fn of_pivots(study: &Study, case: &Case) -> Substitution {
    let mut all = Substitution::default();
    for (index, body) in study.model.bodies.iter().enumerate() {
        let Some(pivot) = study.model.pivot_of(&body.name) else { continue };
        let kinematics = body.kinematics();
        let centre = &case.run.equations.mass_properties(index).centre;
        let arm = rotated(&(centre - &pivot.point), &kinematics.angle());
        let omega = kinematics.omega();
        let turning = kinematics.alpha() * arm.perpendicular() - (&omega * &omega) * &arm;
        let centre = acceleration(pivot) + turning;
        for (symbol, component) in kinematics.acceleration_symbols().into_iter().zip(centre.components()) {
            all.insert(symbol, component.clone());
        }
    }
    all
}

/// The last body that a condition is about.
fn last_of(study: &Study, condition: &Expr) -> Option<usize> {
    let symbols = condition.symbols();
    let is_of = |body: &str| {
        symbols.iter().any(|symbol| symbol.name.split_once('.').is_some_and(|(stem, _)| stem == body))
    };
    study.model.bodies.iter().rposition(|body| is_of(&body.name))
}

/// Moment of inertia of a body about its pivot.
pub(super) fn about_pivot(case: &Case, body: usize, pivot: &Pivot) -> Expr {
    let mass = case.run.equations.mass_properties(body);
    let away = &mass.centre - &pivot.point;
    &mass.inertia + &mass.mass * away.components().iter().fold(Expr::zero(), |sum, part| sum + part * part)
}

/// `I_P`, with the body's name where there are several.
fn inertia_name(study: &Study, body: &str) -> String {
    if study.model.bodies.len() > 1 { format!("I_P,{body}") } else { "I_P".to_owned() }
}

/// A multiple of what is zero that is written with the fewest signs: without halves, and without lengths that are in all of it.
fn shortest(study: &Study, notation: &Notation, condition: &Expr) -> Expr {
    let sizes = sizes(study, condition);
    let multiples = |formula: &Expr| {
        let whole = [-1, 2, -2, 3, -3, 4, -4, 6, -6].map(|factor| factor * formula);
        let scaled = sizes.iter().flat_map(|size| [formula * size, formula / size]);
        whole.into_iter().chain([2, 3, 4].map(|factor| formula / factor)).chain(scaled).collect::<Vec<_>>()
    };
    let mut best = (written(notation, condition), condition.clone());
    loop {
        let with_length =
            multiples(&best.1).into_iter().map(|formula| (written(notation, &formula), formula));
        match with_length.min_by_key(|(signs, _)| *signs).filter(|(signs, _)| *signs < best.0) {
            Some(shorter) => best = shorter,
            None => return best.1,
        }
    }
}

/// Conditions with the sums and differences of two in their place where these are shorter: of two corners on a slope, how their
/// middle moves and how the body turns.
fn combined(study: &Study, notation: &Notation, mut conditions: Vec<Expr>) -> Vec<Expr> {
    let dimension = |formula: &Expr| formula.dimension().ok();
    for later in 0..conditions.len() {
        for earlier in 0..later {
            let [one, other] = [&conditions[earlier], &conditions[later]];
            if dimension(one) != dimension(other) {
                continue;
            }
            // Any two of these say what the two have said.
            let mut four = [one.clone(), other.clone(), one + other, one - other];
            four.sort_by_cached_key(|formula| written(notation, formula));
            let shortest = |formula: &Expr| shortest(study, notation, formula);
            (conditions[earlier], conditions[later]) = (shortest(&four[0]), shortest(&four[1]));
        }
    }
    conditions
}

/// How long a formula of accelerations is, in signs.
fn written(notation: &Notation, formula: &Expr) -> usize {
    // A fraction is read less easily than some more signs.
    let length = |text: String| text.chars().count() + FRACTION * text.matches('/').count();
    let notation = notation.clone().without_automatic_names();
    notation.formula(formula).map_or(usize::MAX, |shown| length(shown.text()))
}

/// The lengths in a formula that have names, and how much they differ: a ball in a bowl goes round at their difference.
fn sizes(study: &Study, formula: &Expr) -> Vec<Expr> {
    let symbols = formula.symbols();
    let is_size = |one: &Symbol| symbols.contains(one) && one.dimension == tumble_expr::Dimension::LENGTH;
    let named: Vec<Expr> =
        study.model.parameters.symbols().into_iter().filter(is_size).map(Expr::from).collect();
    let pairs =
        named.iter().enumerate().flat_map(|(index, one)| named[..index].iter().map(move |other| one - other));
    let differences: Vec<Expr> = pairs.collect();
    named.into_iter().chain(differences).collect()
}

#[cfg(test)]
mod tests;
