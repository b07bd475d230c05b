//! How the names of a scene are written in formulas and in running text.

use std::collections::{BTreeMap, BTreeSet};

use crate::report::{Block, Definition, Text, Typeset};
use tumble_drawing::Label;
use tumble_expr::language::Formula;
use tumble_expr::{Dimension, Expr, Symbol, Vector, Written};
use tumble_mech::Gravity;
use tumble_notation::{Left, Notation, Operator, Printed, as_written};
use tumble_scene::Study;

use crate::figures::symbols;
use crate::results::CaseError;

/// The letter of a mass that is a sum.
pub(super) const MASS: &str = "M";
/// The letter of gravity.
const GRAVITY: &str = "g";
/// Digits of numbers in running text.
const DIGITS: usize = 6;
/// Digits of degrees that stand beside radians, at most.
const DEGREES: usize = 4;

#[derive(Clone)]
pub(crate) struct Names {
    /// Printed names by names of the scene.
    symbols: BTreeMap<String, String>,
    /// Without names for moments of inertia.
    plain: Notation,
    notation: Notation,
    /// Of the only body, where it is a sum.
    mass: Option<(&'static str, Expr)>,
    /// By body, where they are worth a name.
    inertias: Vec<Option<(String, Expr)>>,
    /// What the scene's own quantities are shown as.
    taken: BTreeSet<String>,
    /// Moments of inertia by the formulas of shapes whose sizes are numbers, by the names that they are shown by.
    by_shape: Vec<(String, Definition)>,
}

impl Names {
    /// Those of a study: the user's own symbols first, then the usual letters.
    pub(crate) fn of(study: &Study) -> Result<Self, CaseError> {
        let symbols = symbols::all(study);
        let mut notation = Notation::new();
        for (name, shown) in &symbols {
            notation = notation.name(name.clone(), shown.clone());
        }
        let mut positive = vec![];
        for symbol in study.model.parameters.symbols() {
            let is_size = [Dimension::LENGTH, Dimension::MASS].contains(&symbol.dimension);
            if is_size && study.number(&symbol.clone().into())? > 0.0 {
                positive.push(symbol.name.to_string());
            }
        }
        let inertias = inertias(study, &Notation::new().positive(positive.clone()));
        let mut plain = notation.positive(positive);
        for (name, formula) in scene_s_own(study, &symbols) {
            plain = plain.define(name, &formula);
        }
        let taken = taken(study, &symbols);
        let mass = mass(study, &taken);
        let mut notation = plain.clone();
        for (name, formula) in inertias.iter().flatten() {
            notation = notation.define(name, formula);
        }
        let mut names = Self { symbols, plain, notation, mass, inertias, taken, by_shape: vec![] };
        let mut by_shape = vec![];
        for (body, inertia) in study.model.bodies.iter().zip(&names.inertias) {
            let Some((name, _)) = inertia else { continue };
            let found = super::sizes::inertia(study, &names, body, name)?;
            by_shape.extend(found.map(|found| (name.clone(), found)));
        }
        names.by_shape = by_shape;
        Ok(names)
    }

    /// Those for the formulas of one body: another one's moment of inertia may have the same formula, and is not meant.
    pub(crate) fn of_body(&self, body: usize) -> Self {
        let own = self.inertias[body].iter();
        let notation = own.fold(self.plain.clone(), |all, (name, inertia)| all.define(name, inertia));
        Self { notation, ..self.clone() }
    }

    /// The same with a name for the mass of the only body, which the table of bodies explains.
    pub(crate) fn with_mass(&self) -> Self {
        let named = |notation: &Notation| {
            self.mass.iter().fold(notation.clone(), |all, (name, mass)| all.define(*name, mass))
        };
        Self { notation: named(&self.notation), plain: named(&self.plain), ..self.clone() }
    }

    /// The mass of a body as laws have it: by its name, if it has one.
    pub(crate) fn mass(&self, mass: &Expr) -> Expr {
        let named = |(name, _): &(&str, Expr)| Symbol::new(*name, Dimension::MASS).into();
        self.mass.as_ref().map_or_else(|| mass.clone(), named)
    }

    /// The same with a name for the moment of inertia about the centre, which equations about a pivot do not need.
    pub(crate) fn with_inertia(&self, study: &Study, body: usize, inertia: &Expr) -> Self {
        let own = own_name(study, &study.model.bodies[body].name);
        match own.filter(|_| self.inertias[body].is_none() && !inertia.symbols().is_empty()) {
            Some(name) => Self { notation: self.notation.clone().define(name, inertia), ..self.clone() },
            None => self.clone(),
        }
    }

    /// What a name is shown as: `theta` for `rod.angle`.
    pub(crate) fn shown<'n>(&'n self, name: &'n str) -> &'n str {
        self.symbols.get(name).map_or(name, String::as_str)
    }

    pub(crate) fn label(&self, name: &str) -> Label {
        symbols::label(&self.symbols, name)
    }

    /// What a name of a law is called where the scene has it for something else: that of the load stands below it.
    pub(crate) fn of_law(&self, name: &str, load: &str) -> String {
        let is_taken = self.taken.contains(name);
        if is_taken { symbols::below(name, symbols::last(load)) } else { name.to_owned() }
    }

    /// What a law says, first, and then what the names in it stand for.
    pub(crate) fn stated(&self, left: tumble_notation::Math, right: &Written, load: &str) -> Vec<Typeset> {
        match self.notation.stated(left, right, &|name| self.of_law(name, load)) {
            Ok(lines) => lines.iter().map(math).collect(),
            Err(error) => vec![words(&error.to_string())],
        }
    }

    pub(crate) fn notation(&self) -> &Notation {
        &self.notation
    }

    /// Without names for moments of inertia.
    pub(crate) fn written_notation(&self) -> &Notation {
        &self.plain
    }

    /// A formula on one line, whatever its length.
    pub(crate) fn formula(&self, formula: &Expr) -> Typeset {
        on_one_line(&self.notation, formula)
    }

    /// A formula on one line, as it was written: no name of a body's is in it.
    pub(crate) fn written(&self, formula: &Expr) -> Typeset {
        on_one_line(&self.plain, formula)
    }

    /// A formula of the scene as its text has it; what has no symbol stands in words.
    pub(crate) fn as_written(&self, study: &Study, formula: &Formula) -> Typeset {
        let symbol = |name: &str| match self.symbols.get(name) {
            Some(shown) => tumble_notation::Math::symbol(shown),
            None if name.contains('.') => tumble_notation::Math::Text(symbols::in_words(study, name)),
            None => tumble_notation::Math::symbol(name),
        };
        math(&as_written(formula, &symbol))
    }

    /// What a symbol stands for, on one line: no name of its own making is in it.
    pub(crate) fn equation(&self, left: &str, right: &Expr) -> Typeset {
        let left = Left::symbol(tumble_notation::Math::symbol(left));
        match self.plain.clone().without_automatic_names().equation(left, right) {
            Ok(shown) => shown.lines.first().map(|line| math(&line.math())).unwrap_or_default(),
            Err(error) => words(&error.to_string()),
        }
    }

    /// A column of components.
    pub(crate) fn vector(&self, vector: &Vector) -> tumble_notation::Math {
        let row = |component: &Expr| vec![side(&self.plain, component)];
        tumble_notation::Math::Matrix(vector.components().iter().map(row).collect())
    }

    /// A relation of something to a formula, on one line as it was written.
    pub(crate) fn relation(&self, left: tumble_notation::Math, operator: Operator, right: &Expr) -> Typeset {
        match self.plain.clone().without_automatic_names().formula(right) {
            Ok(shown) => {
                let right = shown.lines.into_iter().map(|line| line.right);
                let parts =
                    [left, tumble_notation::Math::Operator(operator)].into_iter().chain(right.take(1));
                math(&tumble_notation::Math::Row(parts.collect()))
            }
            Err(error) => words(&error.to_string()),
        }
    }

    /// Equations with what follows "where"; what cannot be shown says so.
    pub(crate) fn block(&self, title: impl Into<Text>, equations: &[(Left, Expr)]) -> Block {
        self.shown_block(title.into(), self.notation.equations(equations))
    }

    /// Printed equations as a block of the report.
    pub(crate) fn shown_block(
        &self,
        title: Text,
        shown: Result<Printed, tumble_notation::MathError>,
    ) -> Block {
        let mut block = block(title, shown);
        for (name, by_shape) in &self.by_shape {
            let own =
                |definition: &&mut Definition| definition.symbol.text.starts_with(&format!("{name} = "));
            block.definitions.iter_mut().filter(own).for_each(|definition| *definition = by_shape.clone());
        }
        block
    }
}

/// A formula as a side of an equation.
pub(super) fn side(notation: &Notation, formula: &Expr) -> tumble_notation::Math {
    let shown = notation.clone().without_automatic_names().formula(formula);
    let right = shown.ok().and_then(|shown| shown.lines.into_iter().next()).map(|line| line.right);
    right.unwrap_or_else(|| tumble_notation::Math::Row(vec![]))
}

fn on_one_line(notation: &Notation, formula: &Expr) -> Typeset {
    match notation.clone().without_automatic_names().formula(formula) {
        Ok(shown) => shown.lines.first().map(|line| math(&line.math())).unwrap_or_default(),
        Err(error) => words(&error.to_string()),
    }
}

fn block(title: Text, shown: Result<Printed, tumble_notation::MathError>) -> Block {
    let shown = match shown {
        Ok(shown) => shown,
        Err(error) => return Block { title, lines: vec![words(&error.to_string())], definitions: vec![] },
    };
    let definition =
        |line: &tumble_notation::Line| Definition { symbol: math(&line.math()), meaning: Text::default() };
    Block {
        title,
        lines: shown.lines.iter().map(|line| math(&line.math())).collect(),
        definitions: shown.definitions.iter().map(definition).collect(),
    }
}

/// The same in the notations of a report.
pub(crate) fn math(formula: &tumble_notation::Math) -> Typeset {
    formula.into()
}

/// Words in the place of a formula: they are no mathematics, and their lines break as those of words do.
pub(crate) fn words(words: &str) -> Typeset {
    Typeset::words(words)
}

/// A value with its unit.
pub(crate) fn quantity(value: f64, unit: &str) -> Text {
    quantity_to(value, DIGITS, unit)
}

/// The same to so many digits.
pub(crate) fn quantity_to(value: f64, digits: usize, unit: &str) -> Text {
    let number = Label::number(value, digits);
    match unit.is_empty() {
        true => number.into(),
        // The sign of degrees stands at the number.
        false if unit == "deg" => number.then(Label::unit(unit)).into(),
        false => number.then(Label::plain("\u{a0}")).then(Label::unit(unit)).into(),
    }
}

/// What stands beside a value in radians: degrees, `(20°)`, to as many digits as it has itself, at most four; nothing beside others, or none.
pub(super) fn in_degrees(value: f64, digits: usize, unit: &str) -> Text {
    if unit != "rad" || value == 0.0 || !value.is_finite() {
        return Text::default();
    }
    Text::from("\u{a0}(").and(quantity_to(value.to_degrees(), digits.clamp(1, DEGREES), "deg")).and(")")
}

/// What the scene's parameters and the bodies' motion are shown as.
fn taken(study: &Study, symbols: &BTreeMap<String, String>) -> BTreeSet<String> {
    let parameters = study.model.parameters.symbols();
    let shown =
        parameters.iter().map(|symbol| symbols.get(&*symbol.name).map_or(&*symbol.name, String::as_str));
    let functions = study.functions.iter().filter_map(|(call, _)| call.split('(').next());
    let all = shown.chain(symbols.values().map(String::as_str)).map(str::to_owned);
    // A vector of the same letter as the function that it is made of is understood: w = (w(t); 0).
    all.filter(|name| !functions.clone().any(|function| function == name)).collect()
}

/// What the scene calls by a name of its own: functions of the time, and gravity as g where it is written as a number.
fn scene_s_own(study: &Study, symbols: &BTreeMap<String, String>) -> Vec<(String, Expr)> {
    let functions = study.functions.iter().filter(|(_, formula)| !formula.symbols().is_empty());
    let mut own: Vec<(String, Expr)> = functions.cloned().collect();
    if let Gravity::Vertical(g) = &study.model.gravity
        && g.symbols().is_empty()
        && !taken(study, symbols).contains(GRAVITY)
        && !tumble_expr::is_identically_zero(g)
    {
        own.push((GRAVITY.to_owned(), g.clone()));
    }
    own
}

/// The mass of the only body if it is the sum of those of parts: M, unless something else is called so.
fn mass(study: &Study, taken: &BTreeSet<String>) -> Option<(&'static str, Expr)> {
    let [only] = &study.model.bodies[..] else { return None };
    let mass = only.mass_properties().mass;
    (mass.symbols().len() > 1 && !taken.contains(MASS)).then_some((MASS, mass))
}

/// By body, a moment of inertia that is worth a name: the parameter's that is one, else I. `notation` shows every symbol by its
/// own name, as different symbols may be shown as the same letter.
fn inertias(study: &Study, notation: &Notation) -> Vec<Option<(String, Expr)>> {
    // Two formulas are one if they are written alike once they are in their short form.
    let written = |formula: &Expr| notation.formula(formula).map(|shown| shown.text()).ok();
    let parameters = study.model.parameters.formulas();
    let stated: Vec<(&Symbol, Option<String>)> = parameters
        .filter(|(symbol, _)| symbol.dimension == Dimension::INERTIA)
        .map(|(symbol, formula)| (symbol, written(formula)))
        .collect();
    let mut found: Vec<Option<(String, Expr)>> = vec![];
    for body in &study.model.bodies {
        let inertia = body.mass_properties().inertia;
        // A number is shorter than a name for it, and what is held by a pivot turns about that.
        if inertia.symbols().is_empty() || study.model.pivot_of(&body.name).is_some() {
            found.push(None);
            continue;
        }
        let own = written(&inertia);
        let same = stated.iter().filter(|(_, formula)| *formula == own).map(|(symbol, _)| &*symbol.name);
        let is_free = |name: &&str| !found.iter().flatten().any(|(taken, _)| taken == name);
        let parameter = same.clone().find(is_free).or_else(|| same.clone().next());
        let name = parameter.map(str::to_owned).or_else(|| own_name(study, &body.name));
        found.push(name.map(|name| (name, inertia)));
    }
    found
}

/// I, with the body's name where there are several, unless a parameter is named so.
fn own_name(study: &Study, body: &str) -> Option<String> {
    let name = if study.model.bodies.len() > 1 { format!("I_{body}") } else { "I".to_owned() };
    let is_taken = study.model.parameters.symbols().iter().any(|symbol| *symbol.name == *name);
    (!is_taken).then_some(name)
}
