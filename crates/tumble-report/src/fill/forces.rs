//! What acts on a body: a row for each load, with its law, where it acts and its torque; impulses likewise.

use crate::report::{ForceRow, Typeset};
use tumble_expr::{Expr, Node, Symbol, Unary, Vector, Written, is_identically_zero};
use tumble_mech::{
    Application, AppliedImpulse, Equations, Frame, Kinematics, Law, NORMAL, Pair, Statement, TANGENT, Term,
    rotated,
};
use tumble_notation::{Math, Operator};
use tumble_scene::Study;

use super::names::{MASS, Names, math, words};
use super::passed::Passed;
use super::words::{contact, spoken};
use crate::figures::{air, symbols};

/// A torque of more signs than these is said by its arm and its force.
const MOST_SIGNS_IN_TABLE: usize = 36;

/// A row for each load on a body, in the first mode in which it acts.
pub(super) fn of(study: &Study, names: &Names, passed: &[Passed<'_>], body: usize) -> Vec<ForceRow> {
    let (mut seen, mut rows): (Vec<String>, _) = (vec![], vec![]);
    for Passed { case, mode } in passed {
        let equations = &case.run.equations;
        let (mut terms, statements) = (equations.shown_terms(mode), equations.shown_statements(mode));
        terms.retain(|term| term.body == body);
        for first in &terms {
            if seen.contains(&first.load) {
                continue;
            }
            seen.push(first.load.clone());
            let stated = statements.iter().filter(|stated| stated.load == first.load);
            // What a contact does to its other body is stated for the first.
            let stated = stated.clone().find(|stated| stated.body == body).or_else(|| stated.clone().next());
            let is_single = terms.iter().filter(|term| term.load == first.load).count() == 1;
            rows.push(Load::new(study, names, equations, first, stated).row(is_single));
        }
    }
    rows
}

/// A row for each impulse that an event applies to a body.
pub(super) fn impulses(study: &Study, names: &Names, body: usize) -> Vec<ForceRow> {
    let body = &study.model.bodies[body];
    let own = study.model.impulses.iter().filter(|one| one.body == body.name);
    own.map(|one| impulse(names, &body.kinematics(), one)).collect()
}

fn impulse(names: &Names, kinematics: &Kinematics, applied: &AppliedImpulse) -> ForceRow {
    let name = format!("{}, when “{}” happens", symbols::the(&applied.name), spoken(&applied.when));
    let own = symbols::last(&applied.name);
    let turns = symbols::angular_impulse(own);
    let stated = |left: &str, right: Written| names.stated(Math::symbol(left), &right, &applied.name);
    let (symbol, law, point, torque) = match &applied.application {
        Application::Torque(couple) => {
            let law = stated(&turns, Written::Scalar(couple.clone()));
            (turns.clone(), law, "", vec![math(&Math::symbol(&turns))])
        }
        Application::Force { at, force, frame } => {
            let symbol = symbols::impulse(own);
            let turned =
                if *frame == Frame::Body { rotated(force, &kinematics.angle()) } else { force.clone() };
            let arm = Written::named(&symbols::arm(&symbol), Written::Vector(at.arm(kinematics)));
            let acts = Written::named(&symbol, Written::Vector(turned.clone()));
            let torque = stated(&turns, arm.cross(acts)).into_iter().take(2).collect();
            let law = stated(&symbol, Written::Vector(turned));
            (symbol, law, "its point of action", torque)
        }
    };
    ForceRow { name: name.into(), symbol: math(&Math::symbol(&symbol)), law, point: point.into(), torque }
}

/// A load on a body.
struct Load<'a> {
    study: &'a Study,
    names: &'a Names,
    equations: &'a Equations,
    /// The first of its terms.
    term: &'a Term,
    stated: Option<Statement>,
    /// The contact that it is of.
    pair: Option<&'a Pair>,
    symbol: String,
    /// What the unit vector is called that a contact pushes or rubs along.
    direction: Option<String>,
}

impl<'a> Load<'a> {
    fn new(
        study: &'a Study,
        names: &'a Names,
        equations: &'a Equations,
        term: &'a Term,
        stated: Option<&'a Statement>,
    ) -> Self {
        let symbol = symbols::force(study, &term.load, term.law);
        let direction = direction(study, equations, term);
        let stated = stated.map(|stated| match &direction {
            Some(own) => called(stated, own),
            None => stated.clone(),
        });
        Self { study, names, equations, term, stated, pair: pair(equations, term), symbol, direction }
    }

    fn row(&self, is_single: bool) -> ForceRow {
        let law = self.law();
        let mut torque = self.torque();
        torque.retain(|line| !law.iter().skip(1).any(|said| said == line));
        let is_at_point = is_single && !self.stated.as_ref().is_some_and(is_spread);
        ForceRow {
            name: self.name().into(),
            symbol: math(&self.signed(is_opposite(self.term) || self.is_on_other())),
            law,
            point: if is_at_point { self.point() } else { "every point of it".to_owned() }.into(),
            torque,
        }
    }

    fn is_on_other(&self) -> bool {
        is_on_other(self.equations, self.term)
    }

    /// Its symbol as it is for the body that it acts on.
    fn of_body(&self) -> String {
        let Self { study, term, symbol, .. } = self;
        symbols::of_body(study, symbol, &term.load, &study.model.bodies[term.body].name)
    }

    /// Its symbol, or the opposite.
    fn signed(&self, is_opposite: bool) -> Math {
        let symbol = Math::symbol(&self.symbol);
        if is_opposite { symbol.negative() } else { symbol }
    }

    fn name(&self) -> String {
        match (self.term.law, self.pair) {
            (Law::Weight, _) => "weight".to_owned(),
            (Law::Contact, Some(pair)) => contact(self.study, pair, self.term.body),
            (Law::Friction, Some(_)) => "friction".to_owned(),
            (Law::Rolling, Some(_)) => "rolling resistance".to_owned(),
            (Law::Reaction, _) => format!("reaction of {}", symbols::joint(&self.term.load)),
            _ => spoken(&self.term.load),
        }
    }

    /// Where it acts, in words.
    fn point(&self) -> String {
        let term = self.term;
        if term.law.is_couple() {
            return String::new();
        }
        if !has_arm(term) {
            return "the centre of mass".to_owned();
        }
        let bodies = &self.equations.model().bodies;
        let body = &bodies[term.body];
        let is_there = |(_, at): &&(String, Vector)| {
            let arm = body.at(at).world_arm();
            is_same(&arm, &term.arm)
        };
        match (term.law, body.points.iter().find(is_there)) {
            (_, Some((name, _))) if bodies.len() == 1 => symbols::the(name),
            (_, Some((name, _))) => format!("{} of {}", symbols::the(name), symbols::the(&body.name)),
            (Law::Contact | Law::Friction, None) => "the point of contact".to_owned(),
            (Law::Reaction, None) => symbols::joint(&term.load),
            _ => "its point of action".to_owned(),
        }
    }

    /// What the law says; where it says nothing, the components.
    fn law(&self) -> Vec<Typeset> {
        let (term, names) = (self.term, self.names);
        let said = self.stated.as_ref().and_then(|stated| stated.force.as_ref().or(stated.torque.as_ref()));
        if let Some(pair) = self.pair.filter(|_| touches(term)) {
            return self.contact(pair, said);
        }
        let right = match (said, term.law) {
            (None, Law::Reaction) if is_identically_zero(&term.couple) => {
                return vec![words(self.holds())];
            }
            (None, Law::Reaction) => {
                let couple = symbols::couple(&term.load);
                let by = Math::Row(vec![Math::Text("the couple\u{a0}".to_owned()), Math::symbol(&couple)]);
                return vec![words(&format!("{}, and the body at its angle", self.holds())), math(&by)];
            }
            (None, law) if law.is_couple() => Written::Scalar(term.couple.clone()),
            (None, _) => Written::Vector(term.force.clone()),
            (Some(said), _) => said.clone(),
        };
        if let (Some(_), Written::Vector(vector)) = (symbols::named(self.study, &term.load), &right) {
            // Its symbol is in it: an equation would say it twice.
            return vec![math(&names.vector(vector))];
        }
        let names = if term.law == Law::Weight { &names.with_mass() } else { names };
        let mut lines = names.stated(self.signed(false), &right, &term.load);
        // The table of bodies says it.
        lines.retain(|line| !line.text.starts_with(&format!("{MASS} = ")));
        lines
    }

    /// What a pivot, or a joint of two bodies, does.
    fn holds(&self) -> &'static str {
        let joint = self.study.model.joints.iter().find(|joint| joint.name == self.term.load);
        match joint.is_some_and(|joint| joint.bodies().count() > 1) {
            true => "keeps the two bodies together there",
            false => "holds the point in its place",
        }
    }

    /// What a contact pushes with along the normal, or rubs with along the surface; nothing says how strongly a rigid one pushes.
    fn contact(&self, pair: &Pair, said: Option<&Written>) -> Vec<Typeset> {
        let (is_friction, is_on_other) = (self.term.law == Law::Friction, self.is_on_other());
        if self.term.law == Law::Rolling {
            return self.resistance(pair);
        }
        let along = self.direction.as_deref().map(Math::symbol);
        let acts = Math::Product([self.signed(false)].into_iter().chain(along).collect());
        let acts = if is_on_other { acts.negative() } else { acts };
        let Some(said) = said else { return vec![math(&acts)] };
        let mut lines = self.names.stated(acts.clone(), said, &self.term.load);
        if pair.law.is_rigid() || is_on_other || is_friction {
            // It says that it is along a direction, and no more; how strongly is said for the first body.
            lines[0] = math(&acts);
        }
        if is_friction {
            lines.extend(self.coulomb(pair));
        }
        lines
    }

    /// Friction while it slips with the rate s, and its bound while it does not.
    fn coulomb(&self, pair: &Pair) -> Vec<Typeset> {
        let Some(friction) = &pair.friction else { return vec![] };
        let way = Expr::unary(Unary::Sign, Symbol::new("s", tumble_expr::Dimension::SPEED).into());
        let normal: Expr = pair.force_symbol().into();
        let slips = self.names.equation(&self.symbol, &-(&friction.kinetic * &normal * way));
        let with_speed = [Math::Text("while it slips with speed\u{a0}".to_owned()), Math::symbol("s")];
        let with_speed = math(&Math::Row(with_speed.into()));
        vec![slips, with_speed, self.at_most(&(&friction.of_rest * &normal)), words("while it sticks")]
    }

    /// The couple against rolling while it turns with the rate omega against the other, and its bound while it does not.
    fn resistance(&self, pair: &Pair) -> Vec<Typeset> {
        let Some(length) = pair.friction.as_ref().and_then(|friction| friction.rolling.as_ref()) else {
            return vec![];
        };
        if self.is_on_other() {
            return vec![math(&self.signed(true))];
        }
        let turning = Symbol::new("omega", tumble_expr::Dimension::ANGULAR_RATE);
        let most = length * Expr::from(pair.force_symbol());
        let turns = self.names.equation(&self.symbol, &-(&most * Expr::unary(Unary::Sign, turning.into())));
        let turning = words("while it turns with ω against what it rolls on");
        vec![math(&self.signed(false)), turns, turning, self.at_most(&most), words("while it does not")]
    }

    /// The bound of its size.
    fn at_most(&self, most: &Expr) -> Typeset {
        self.names.relation(Math::Bars(Box::new(self.signed(false))), Operator::LessEqual, most)
    }

    /// The torque about the centre of mass: as the law says it, by its formula if that is short, or as arm and force.
    fn torque(&self) -> Vec<Typeset> {
        let Self { term, names, .. } = self;
        let symbol = &self.of_body();
        let own = || Math::symbol(&symbols::torque(symbol));
        if let Some(Statement { force: Some(_), torque: Some(torque), .. }) = &self.stated {
            return names.stated(own(), torque, &term.load).into_iter().take(1).collect();
        }
        if term.law.is_couple() {
            return vec![math(&self.signed(false))];
        }
        if !has_arm(term) {
            return vec![names.formula(&term.couple)];
        }
        let arm = Written::Vector(term.arm.clone());
        let torque = term.torque();
        let formula = (term.law != Law::Reaction).then(|| names.formula(&torque));
        if let Some(formula) = formula.filter(|formula| formula.text.chars().count() <= MOST_SIGNS_IN_TABLE) {
            if is_identically_zero(&torque) || formula.text == "0" {
                return vec![formula];
            }
            let arm = names.stated(Math::symbol(&symbols::arm(symbol)), &arm, &term.load);
            return [vec![names.equation(&symbols::torque(symbol), &torque)], arm].concat();
        }
        names.stated(own(), &self.moment(arm), &term.load)
    }

    /// Its arm times its force, and its couple.
    fn moment(&self, arm: Written) -> Written {
        let force = Written::Scalar(Symbol::new(&*self.symbol, tumble_expr::Dimension::FORCE).into());
        let force = if is_opposite(self.term) { force.negative() } else { force };
        let force = match self.direction() {
            Some(direction) => Written::Product(vec![force, direction]),
            None => force,
        };
        let moment = Written::named(&symbols::arm(&self.of_body()), arm).cross(force);
        let couple = &self.term.couple;
        if is_identically_zero(couple) {
            return moment;
        }
        // The couple on the second body is the opposite of the symbol.
        let is_minus = matches!(couple.node(), Node::Unary(Unary::Neg, _));
        let couple = if is_minus { -couple } else { couple.clone() };
        Written::Sum(vec![(false, moment), (is_minus, Written::Scalar(couple))])
    }

    /// Along which unit vector a contact pushes or rubs: its symbol is a number.
    fn direction(&self) -> Option<Written> {
        let letter = self.direction.as_deref()?;
        let unit = air::named(self.stated.as_ref()?.force.as_ref()?, letter)?;
        Some(Written::named(letter, unit.clone()))
    }
}

/// What the unit vector is called that a contact pushes or rubs along: of a body that others touch from several sides by who touches.
pub(super) fn direction(study: &Study, equations: &Equations, term: &Term) -> Option<String> {
    let letter = match term.law {
        Law::Contact => NORMAL,
        Law::Friction => TANGENT,
        _ => return None,
    };
    let mut own = equations.pairs().iter().filter(|pair| pair.has(term.body));
    let first = own.next();
    let are_several = first.is_some_and(|first| own.any(|pair| !is_same(&pair.normal, &first.normal)));
    let force = symbols::force(study, &term.load, term.law);
    let of = force.split_once('_').filter(|_| are_several);
    Some(of.map_or_else(|| letter.to_owned(), |(_, touching)| symbols::below(letter, touching)))
}

fn is_same(one: &Vector, other: &Vector) -> bool {
    (one - other).components().iter().all(is_identically_zero)
}

/// A law with this name of the direction along which it acts.
fn called(stated: &Statement, own: &str) -> Statement {
    let name = |name: &str| if [NORMAL, TANGENT].contains(&name) { own.to_owned() } else { name.to_owned() };
    let [force, torque] =
        [&stated.force, &stated.torque].map(|part| part.as_ref().map(|written| written.renamed(&name)));
    Statement { force, torque, ..stated.clone() }
}

/// Whether a law is a sum along lines.
fn is_spread(stated: &Statement) -> bool {
    fn has_integral(written: &Written) -> bool {
        match written {
            Written::Integral { .. } => true,
            Written::Sum(terms) => terms.iter().any(|(_, term)| has_integral(term)),
            Written::Product(factors) => factors.iter().any(has_integral),
            _ => false,
        }
    }
    stated.force.as_ref().is_some_and(has_integral)
}

fn has_arm(term: &Term) -> bool {
    !term.arm.components().iter().all(is_identically_zero)
}

fn touches(term: &Term) -> bool {
    matches!(term.law, Law::Contact | Law::Friction | Law::Rolling)
}

/// The contact that a term is of.
fn pair<'e>(equations: &'e Equations, term: &Term) -> Option<&'e Pair> {
    equations.pairs().iter().find(|pair| pair.name == symbols::rubbed(&term.load))
}

/// Whether it is the opposite of what a joint's symbol says: on the other of its bodies.
fn is_opposite(term: &Term) -> bool {
    let is_opposite = |component: &Expr| {
        let symbols = component.symbols();
        let multiplier = symbols.iter().next().filter(|_| symbols.len() == 1);
        multiplier.is_some_and(|multiplier| is_identically_zero(&(component.derivative(multiplier) + 1)))
    };
    term.law == Law::Reaction && term.force.components().iter().any(is_opposite)
}

/// Whether it is what a contact does to the second of its bodies.
pub(super) fn is_on_other(equations: &Equations, term: &Term) -> bool {
    let mut pairs = equations.pairs().iter().filter(|pair| pair.name == symbols::rubbed(&term.load));
    touches(term) && pairs.any(|pair| pair.other == Some(term.body))
}
