//! The names of a scene: what formulas may use where, and who has which name.

use std::collections::{BTreeMap, BTreeSet};

use tumble_expr::Expr;
use tumble_expr::language::{Function, Measured, Scope, is_name, is_reserved};

use crate::code::Code;
use crate::diagnostic::{Diagnostic, Span};
use crate::document::Field;
use crate::file_names::file_name_fault;
use crate::formula::Origin;

/// What a formula may depend on; each level includes those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Level {
    /// Parameters: what is fixed before the run.
    Constant,
    /// The time: what is given before the run as a course of time.
    Time,
    /// Positions and velocities.
    Motion,
    /// Forces of contacts and joints too: what forces may depend on.
    Forces,
    /// Accelerations too: what can be shown.
    Output,
}

/// Quantities that every body has, which therefore are no names of points.
pub(crate) const OF_BODY: &[&str] =
    &["x", "y", "angle", "vx", "vy", "omega", "ax", "ay", "alpha", "energy", "kinetic", "cm"];

/// What is set and swept like a parameter, and is none.
pub(crate) const ACCURACY: &str = "accuracy";

/// Quantities that follow from the forces.
const ACCELERATIONS: &[&str] = &["ax", "ay", "alpha"];

/// The names of a scene.
#[derive(Default)]
pub(crate) struct Names {
    scopes: [Scope; 5],
    claimed: BTreeMap<String, (&'static str, Span)>,
    /// The names of all bodies, known before anything of them is read.
    pub(crate) bodies: Vec<String>,
    /// The names of the points of each body, and of its centre of mass, likewise.
    pub(crate) points: BTreeMap<String, Vec<String>>,
    /// The names of all events, likewise.
    pub(crate) events: Vec<String>,
    /// What happens beside events: starts and ends of forces and joints that do not act always, `kick.end`, and impulses.
    pub(crate) happenings: BTreeSet<String>,
    /// The names of all joints, pivots among them, likewise.
    pub(crate) joints: Vec<String>,
    /// The names of all surfaces, likewise.
    pub(crate) surfaces: Vec<String>,
    /// The names of all contacts, likewise.
    pub(crate) contacts: Vec<String>,
    /// What may touch what: `floor`, `floor.rod` and `floor.rod.tip`.
    pub(crate) touching: BTreeSet<String>,
    /// What does work: loads, pivots, surfaces and what touches them.
    pub(crate) working: BTreeSet<String>,
    /// Names whose definition has a mistake that has been reported: what uses them is not to blame.
    broken: BTreeSet<String>,
    /// Where the bodies of the functions stand.
    pub(crate) functions: BTreeMap<String, Origin>,
}

impl Names {
    pub(crate) fn scope(&self, level: Level) -> &Scope {
        &self.scopes[level as usize]
    }

    /// Gives a value to a name from a level on. Whether the name is free has been looked at before.
    pub(crate) fn define(&mut self, level: Level, name: &str, value: &Expr) {
        for scope in &mut self.scopes[level as usize..] {
            // A name with two owners has been reported where it was claimed.
            scope.define(name, value.clone()).ok();
        }
    }

    pub(crate) fn define_function(&mut self, function: &Function, body: Origin) {
        for scope in &mut self.scopes {
            scope.define_function(function.clone()).ok();
        }
        self.functions.insert(function.header.name.to_string(), body);
    }

    pub(crate) fn define_measured(&mut self, measured: &Measured) {
        for scope in &mut self.scopes {
            scope.define_measured(measured.clone()).ok();
        }
    }

    /// Marks a name whose definition has a mistake.
    pub(crate) fn break_name(&mut self, name: &str) {
        self.broken.insert(name.to_owned());
    }

    /// Whether a name, or the body or point that it begins with, is without meaning only because of another mistake.
    pub(crate) fn is_broken(&self, name: &str) -> bool {
        let ends = name.match_indices('.').map(|(dot, _)| dot).chain([name.len()]);
        ends.into_iter().any(|end| self.broken.contains(&name[..end]))
    }

    /// The level from which on a name of the motion may be used.
    pub(crate) fn level_of(&self, name: &str) -> Option<Level> {
        let last = name.rsplit('.').next().unwrap_or(name);
        let of_body = name.contains('.') && self.bodies.iter().any(|body| body == first_word(name));
        let of_surface = self.places().any(|place| place == first_word(name));
        match name {
            "t" => Some(Level::Time),
            _ if of_body && ACCELERATIONS.contains(&last) => Some(Level::Output),
            _ if of_body => Some(Level::Motion),
            _ if self.joints.iter().any(|joint| joint == first_word(name)) => Some(Level::Forces),
            _ if of_surface && matches!(last, "normal" | "friction" | "rolling") => Some(Level::Forces),
            _ if of_surface && matches!(last, "gap" | "slip") => Some(Level::Motion),
            _ => None,
        }
    }

    /// The names of all surfaces and contacts.
    pub(crate) fn places(&self) -> impl Iterator<Item = &String> + Clone {
        self.surfaces.iter().chain(&self.contacts)
    }

    /// Gives a name to one owner, such as "the body".
    pub(crate) fn claim(&mut self, owner: &'static str, name: &str, span: Span) -> Result<(), Diagnostic> {
        fit(name, &span)?;
        if name == "t" {
            return Err(taken(name, span, "`t` is the time".to_owned()));
        }
        // Parameters may have this name: theirs has no dot, and the weight's quantities all have one.
        if name == "gravity" && !matches!(owner, "a parameter" | "a function" | "a table") {
            return Err(taken(name, span, "`gravity` is the weight of the bodies".to_owned()));
        }
        if name == ACCURACY && owner == "a parameter" {
            return Err(taken(name, span, format!("`{ACCURACY}` is the accuracy of the run")));
        }
        if is_reserved(name) {
            return Err(taken(name, span, format!("`{name}` is a name that every formula knows")));
        }
        if let Some((other, first)) = self.claimed.get(name) {
            let message = format!("`{name}` is the name of {owner} and of {other}");
            return Err(taken(name, span, message).also(first.clone(), *other));
        }
        self.claimed.insert(name.to_owned(), (owner, span));
        Ok(())
    }
}

fn first_word(name: &str) -> &str {
    name.split('.').next().unwrap_or(name)
}

/// Whether a name is one word that formulas can use.
fn fit(name: &str, span: &Span) -> Result<(), Diagnostic> {
    if is_name(name) && !name.contains(['.', '[']) {
        return Ok(());
    }
    let message = format!("`{name}` is not a name");
    let cure = "names begin with a letter and go on with letters, digits and underscores";
    Err(Diagnostic::new(Code::NotAName, span.clone(), message).label("not a name").help(cure))
}

fn taken(name: &str, span: Span, message: String) -> Diagnostic {
    let cure = format!("give `{name}` another name here");
    Diagnostic::new(Code::NameTaken, span, message).label("this name is taken").help(cure)
}

/// A name of a point of a body.
pub(crate) fn fit_point(field: &Field) -> Result<(), Diagnostic> {
    fit(field.key, &field.key_span)?;
    match OF_BODY.contains(&field.key) {
        true => {
            Err(taken(field.key, field.key_span.clone(), format!("every body has its own `{}`", field.key)))
        }
        false => Ok(()),
    }
}

/// A name of a figure, which becomes the name of a file.
pub(crate) fn fit_file(field: &Field) -> Result<(), Diagnostic> {
    fit_label(field)?;
    let Some(fault) = file_name_fault(field.key) else { return Ok(()) };
    let message = format!("`{}` cannot be the name of a file: {fault}", field.key);
    let mistake = Diagnostic::new(Code::FileName, field.key_span.clone(), message).label("becomes a file");
    Err(mistake.help("give the figure another name"))
}

/// A name of a find or a check: a name of formulas, in which hyphens may stand.
pub(crate) fn fit_label(field: &Field) -> Result<(), Diagnostic> {
    let as_word = field.key.replace('-', "_");
    fit(&as_word, &field.key_span).map_err(|mut mistake| {
        mistake.message = format!("`{}` is not a name", field.key);
        mistake
    })
}
