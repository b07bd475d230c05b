//! A study: a model and what to do with it. This is what the rest of the pipeline sees of a scene.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use tumble_expr::{Dimension, Expr};
use tumble_mech::{Equations, Extreme, Model, ModelErrors, Parameters};
use tumble_ode::{Accuracy, Reason, Side};

use crate::code::Code;
use crate::curve::is_angular_by;
use crate::diagnostic::{Diagnostic, Diagnostics, SourceText};
use crate::places::Places;
use crate::play::Play;
use crate::sweep::SweepAxis;

/// A model and what to do with it, as formulas of its parameters.
#[derive(Clone, Debug)]
pub struct Study {
    /// One line, as the user wrote it.
    pub title: String,
    /// What the scene says in words, in the order in which it is read.
    pub texts: Vec<Commentary>,
    /// Its functions of the time by their calls, such as `w(t)`, each with its formula.
    pub functions: Vec<(String, Expr)>,
    /// Bodies, loads, starts and parameters.
    pub model: Model,
    /// Parameters that are angles, or angles per time.
    pub angles: BTreeSet<String>,
    /// Every name that a figure, a check or an output may use, with its formula.
    pub quantities: BTreeMap<String, Quantity>,
    /// End of the run, s; it starts at 0.
    pub until: Expr,
    /// What the motion is held to.
    pub accuracy: Accuracy,
    /// Time between samples of the tables, s; `None` is a thousandth of the run.
    pub output_every: Option<Expr>,
    /// Curves, in the order of the scene.
    pub plots: Vec<Plot>,
    /// Stroboscopic pictures.
    pub stroboscopes: Vec<Stroboscope>,
    /// Figures of the energy and momentum balance.
    pub balances: Vec<BalancePlot>,
    /// Free-body diagrams.
    pub free_bodies: Vec<FreeBody>,
    /// What is asked for.
    pub finds: Vec<Question>,
    /// What must hold.
    pub checks: Vec<Check>,
    /// Whether the pose of equilibrium near the start is asked for.
    pub equilibrium: bool,
    /// How names are written in figures and equations: `rod.angle` as `theta`.
    pub symbols: BTreeMap<String, String>,
    /// What parameters are, in words, by their names.
    pub meanings: BTreeMap<String, String>,
    /// What takes several values, one run each; with several axes, every combination.
    pub sweep: Vec<SweepAxis>,
    /// Whether settings stand in the place of some of its values: claims may be about those alone.
    pub is_set: bool,
    /// What a reader of the page may change.
    pub play: Play,
    /// Of the model as it was read.
    pub(crate) equations: Equations,
    pub(crate) said: Said,
}

/// What was read, and what is to be said of it.
#[derive(Clone, Debug)]
pub(crate) struct Said {
    pub(crate) sources: Arc<[SourceText]>,
    pub(crate) places: Arc<Places>,
    pub(crate) warnings: Vec<Diagnostic>,
}

impl Said {
    fn diagnostics(&self, list: Vec<Diagnostic>) -> Diagnostics {
        Diagnostics::new(self.sources.to_vec(), list)
    }

    fn one(&self, diagnostic: Diagnostic) -> Diagnostics {
        self.diagnostics(vec![diagnostic])
    }
}

impl Study {
    /// The equations of the model as it was read: with other parameters by [`Equations::with`], and no other change of it.
    pub fn equations(&self) -> &Equations {
        &self.equations
    }

    /// The same study with these parameters.
    #[must_use]
    pub fn with(&self, parameters: &Parameters) -> Self {
        let model = Model { parameters: parameters.clone(), ..self.model.clone() };
        Self { model, ..self.clone() }
    }

    /// Value of a formula of the parameters, SI units.
    pub fn number(&self, formula: &Expr) -> Result<f64, ModelErrors> {
        Ok(self.model.parameters.evaluate(std::slice::from_ref(formula))?[0])
    }

    /// Whether a parameter is an angle, or an angle per time: by its unit, or because it is computed of such, which come before it.
    pub fn is_angle(&self, parameter: &str) -> bool {
        let mut found: BTreeSet<&str> = self.angles.iter().map(String::as_str).collect();
        for (symbol, formula) in self.model.parameters.formulas() {
            if is_angular_by(formula, &|name| found.contains(name)) {
                found.insert(&symbol.name);
            }
        }
        found.contains(parameter)
    }

    /// What its user should know before it is run.
    pub fn warnings(&self) -> Diagnostics {
        self.said.diagnostics(self.said.warnings.clone())
    }

    /// Mistakes of the model, at their places in the scene.
    pub fn mistakes(&self, errors: &ModelErrors) -> Diagnostics {
        self.said.diagnostics(errors.0.iter().map(|error| self.said.places.mistake(error)).collect())
    }

    /// Why its motion stopped, at the place of what stopped it; `message` is all that is said.
    pub fn refusal(&self, reason: &Reason, message: &str) -> Diagnostics {
        self.said.one(self.said.places.refusal(reason, message))
    }

    /// Why a question has no answer, at its place.
    pub fn no_answer(&self, question: &Question, reason: &Reason) -> Diagnostics {
        let message = format!("{} has no answer: {reason}", question.title);
        let what = format!("that of {}", question.title);
        self.said.one(self.said.places.about(Code::NoAnswer, &what, message).label("asked for here"))
    }

    /// That a question's value is infinite or no number.
    pub fn no_number(&self, question: &Question, value: f64, at: f64) -> Diagnostics {
        let message = format!("{} looks at {value} at {at} s, which is not a finite number", question.title);
        let what = format!("that of {}", question.title);
        let warning = self.said.places.about(Code::ValueOfRun, &what, message).label("not a finite number");
        let help = "look for a division by what has become zero, by an event or by the motion";
        self.said.one(warning.help(help).warning())
    }

    /// That a question asks for what forces have no value of at an instant, s: that of a singular configuration.
    pub fn no_force(&self, question: &Question, at: f64) -> Diagnostics {
        let message = format!(
            "{} has no value at {at} s: the bodies pass a singular configuration, in which joints leave forces and accelerations open",
            question.title
        );
        let what = format!("that of {}", question.title);
        let warning = self.said.places.about(Code::ValueOfRun, &what, message).label("no value then");
        let help = "ask for it a little before or after, as at `singular[1] + 1 ms`; places and velocities have values";
        self.said.one(warning.help(help).warning())
    }

    /// That the motion was to end at rest and did not come to it before the latest time, s.
    pub fn no_rest(&self, latest: f64) -> Diagnostics {
        let message = format!("the motion has not come to rest by {latest} s, and ends there");
        let warning = self.said.places.about(Code::NoRest, "until", message).label("not at rest before");
        let help = "what slides without friction, or is slowed down by dampers or the air, only comes ever nearer to rest";
        self.said.one(warning.help(help).warning())
    }

    /// That an event which a joint or an impulse waits for does not happen in a motion; `what` is which, and `stays` what becomes of it.
    pub fn never_comes(&self, what: &str, stays: &str, event: &str) -> Diagnostics {
        let message = format!("{what} {stays}: `{event}` does not happen in this motion");
        let warning = self.said.places.about(Code::NeverComes, what, message).label("waits for an event");
        let help = format!(
            "look at `when` of `[event.{event}]`, at the way in which it passes, and at how long the run is"
        );
        self.said.one(warning.help(help).warning())
    }

    /// That rigid bodies with friction might go on otherwise at an instant, s; `motions` are those that are possible, in sentences.
    pub fn other_motions(&self, at: f64, motions: &str) -> Diagnostics {
        let message = format!("from {at} s on rigid bodies with friction might go on otherwise. {motions}");
        let warning = self.said.places.about(Code::OtherMotions, motions, message).label("of this contact");
        let help = "the run goes on with the one that keeps every contact as it was; a compliant surface would know how hard it is pressed";
        self.said.one(warning.help(help).warning())
    }

    /// That nobody looked at whether there are others, at so many instants, of which the first is at a time, s.
    pub fn unexamined_motions(&self, at: f64, count: usize) -> Diagnostics {
        let instants =
            if count == 1 { "one instant".to_owned() } else { format!("{count} instants, the first") };
        let message = format!(
            "at {instants} at {at} s, whether rigid bodies with friction might go on otherwise was not examined: more than six contacts take part"
        );
        let warning =
            self.said.places.about(Code::OtherMotions, "until", message).label("as far as it was found");
        let help = "each contact keeps to its laws; with friction that is small enough, or fewer bodies that touch at once, it would be certain";
        self.said.one(warning.help(help).warning())
    }

    /// That two quantities are shown by the same symbol, so that no reader can tell them apart.
    pub fn shown_alike(&self, name: &str, other: &str, symbol: &str) -> Diagnostics {
        let message = format!("`{name}` and `{other}` are both shown as {symbol}");
        let warning = self.said.places.about(Code::ShownAlike, name, message).label("shown like another");
        let help = format!(
            "give one of them a symbol of its own, as in `[symbols]` with `\"{other}\" = \"{symbol}_1\"`"
        );
        self.said.one(warning.help(help).warning())
    }

    /// Why there is no pose of equilibrium to tell of.
    pub fn no_equilibrium(&self, reason: &str) -> Diagnostics {
        let warning =
            self.said.places.about(Code::NoEquilibrium, "equilibrium", reason).label("asked for here");
        let help = "start nearer to the pose that is meant; what slides or falls has none";
        self.said.one(warning.help(help).warning())
    }

    /// That the time between two instants of the run turned out to be none; `of` is the question or figure it is of.
    pub fn empty_window(&self, of: &str, [from, to]: [f64; 2]) -> Diagnostics {
        let message = format!("{of} looks at the time from {from} s to {to} s, in which there is nothing");
        let warning = self.said.places.about(Code::WindowOfRun, &format!("during of {of}"), message);
        self.said
            .one(warning.label("ends before it begins").help("write the earlier instant first").warning())
    }
}

/// What a scene says in words, at its top or in one of its sections.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Commentary {
    /// `body` of `[body.rod]`; empty at the top of the file.
    pub section: String,
    /// `rod` of `[body.rod]`; empty where the section has no name.
    pub name: String,
    /// Each in one line.
    pub paragraphs: Vec<String>,
}

/// Something that can be shown: a named formula of the motion.
#[derive(Clone, Debug)]
pub struct Quantity {
    /// The formula; it may hold any kinematic symbol, accelerations included. Its values are numbers of `unit`.
    pub formula: Expr,
    /// What it measures.
    pub dimension: Dimension,
    /// Its unit as it is shown: `rad/s`, `N`, `J`, or another that a figure asks for; empty for a pure number.
    pub unit: String,
}

/// A figure of curves against the time or another quantity.
#[derive(Clone, Debug)]
pub struct Plot {
    /// Its name: the file's stem.
    pub name: String,
    /// One line above the figure.
    pub title: Option<String>,
    /// Horizontal axis; `None` is the time.
    pub x: Option<Curve>,
    /// Vertical axis: one curve each, of one dimension.
    pub y: Vec<Curve>,
    /// From when to when; `None` is the whole run.
    pub during: Option<[Instant; 2]>,
}

/// One quantity of a figure, as the user wrote it.
#[derive(Clone, Debug)]
pub struct Curve {
    /// The formula's text, without the unit that an axis shows it in.
    pub text: String,
    /// Whether it is an angle, or an angle per time.
    pub angle: bool,
    /// One of its unit in SI units, a pure number.
    pub size: Expr,
    /// How figures call it, where that is not its formula.
    pub label: Option<String>,
    /// What to show.
    pub quantity: Quantity,
}

/// The bodies at equal time steps, and the paths of their centres.
#[derive(Clone, Debug)]
pub struct Stroboscope {
    /// Its name: the file's stem.
    pub name: String,
    /// One line above the picture.
    pub title: Option<String>,
    /// Indices of the bodies shown.
    pub bodies: Vec<usize>,
    /// Time between two instants, s.
    pub every: Expr,
    /// Whether the path of each centre of mass is drawn.
    pub trace: bool,
}

/// Energies or works of all bodies along the run.
#[derive(Clone, Debug)]
pub struct BalancePlot {
    /// Its name: the file's stem.
    pub name: String,
    /// One line above the figure.
    pub title: Option<String>,
    /// Which part of the balance.
    pub show: Sheet,
}

/// A part of the balance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sheet {
    /// Kinetic, potential and total energy.
    Energies,
    /// What every load has done so far.
    Works,
    /// What the works leave unexplained of the energy.
    Residual,
}

impl Sheet {
    /// Every part.
    pub const ALL: [Self; 3] = [Self::Energies, Self::Works, Self::Residual];

    /// How a scene calls it.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Energies => "energies",
            Self::Works => "works",
            Self::Residual => "residual",
        }
    }
}

/// When something is looked at: a time, s, a formula of the parameters and of symbols that only the run knows.
///
/// Those are events, `apex[2]`, and starts and ends of contacts, `floor.contact[1].start`, `floor.rod.tip.contact[2].end`,
/// each counted from 1.
#[derive(Clone, Debug)]
pub struct Instant {
    /// As the user wrote it.
    pub text: String,
    /// The time.
    pub time: Expr,
}

/// Free-body diagrams of one body at some instants, on one sheet.
#[derive(Clone, Debug)]
pub struct FreeBody {
    /// Its name: the file's stem.
    pub name: String,
    /// One line above the sheet.
    pub title: Option<String>,
    /// Index of the body.
    pub body: usize,
    /// When, each with what stands above its diagram.
    pub at: Vec<(Instant, String)>,
}

/// When something is looked at.
#[derive(Clone, Debug)]
pub enum When {
    /// At the end of the run.
    End,
    /// At an instant.
    At(Instant),
    /// Where what is looked at is greatest or least, in the whole run or between two instants.
    Extreme {
        /// Which of them.
        which: Extreme,
        /// From when to when; `None` is the whole run.
        during: Option<[Instant; 2]>,
    },
}

/// A question about the motion at one time.
#[derive(Clone, Debug)]
pub struct Question {
    /// Its name.
    pub name: String,
    /// What messages call it: "the check `apex`".
    pub title: String,
    /// What is looked at.
    pub that: Curve,
    /// When.
    pub at: When,
    /// On which side of what happens at an instant.
    pub side: Side,
}

/// A claim about the motion at one time.
#[derive(Clone, Debug)]
pub struct Check {
    /// What is looked at, and when.
    pub question: Question,
    /// What it must be; its values are numbers of the quantity's unit.
    pub equals: Expr,
    /// Largest difference allowed, likewise.
    pub within: Expr,
}
