//! A problem: the text of a scene, and the true value of everything that it asks for.

use std::fmt::Write;

use super::draw::Draw;
use super::real::Real;
use super::units::{LENGTH, Measure, NUMBER, TIME, Units};

/// Share of the quantities that stand in the formulas themselves, and not among the parameters.
const INLINE: f64 = 0.3;
/// Share of the quantities in the problem's own unit, and not in the SI unit.
const OWN_UNIT: f64 = 0.5;
/// Share of the values that are asked for in the problem's own unit.
const OWN_ANSWER: f64 = 0.3;
/// Share of the problems that are far from the origin, and how far, in their own size.
const SHIFTED: f64 = 0.4;
const SHIFTS: [f64; 2] = [1.0, 1e6];
/// Accuracies that are asked for.
const ACCURACIES: [f64; 2] = [1e-13, 1e-3];

/// So many numbers are tried where one has to be fit.
const TRIES: usize = 100;

/// A scene with its truths.
#[derive(Clone, Debug)]
pub(crate) struct Problem {
    /// What the scene asks the program for.
    pub(crate) accuracy: f64,
    /// Its text.
    pub(crate) scene: String,
    /// What it asks for.
    pub(crate) asked: Vec<Asked>,
}

/// A value that is asked for.
#[derive(Clone, Debug)]
pub(crate) struct Asked {
    /// Its name.
    pub(crate) name: String,
    /// Where the program tells it.
    pub(crate) place: Place,
    /// What is asked for, in words of the scene.
    pub(crate) what: String,
    /// The true value, in the unit in which it is asked for.
    pub(crate) truth: Real,
    /// The size of what it is a sum of, or of its kind in the problem, where it is truly zero and has none of its own; else 0.
    pub(crate) size: f64,
}

/// Where the program tells a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Place {
    /// Among what the scene asks for, by its name.
    Find,
    /// The start of the contact that lasts to the end of the run, s. The scene language cannot ask for it: it would have
    /// to be counted.
    Rest,
}

/// A quantity that is given: how formulas call it, and what it is in SI units.
#[derive(Clone, Debug)]
pub(crate) struct Given {
    pub(crate) word: String,
    pub(crate) value: Real,
}

impl Given {
    /// Its value in SI units, near enough to lay out a problem by it.
    pub(crate) fn near(&self) -> f64 {
        self.value.to_f64()
    }
}

impl std::fmt::Display for Given {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.word)
    }
}

/// When something is asked for.
#[derive(Clone, Debug)]
pub(crate) enum At {
    /// At the end of the run.
    End,
    /// At an instant, after what happens there.
    After(String),
    /// At an instant, before what happens there.
    Before(String),
    /// Where it is greatest, perhaps between two instants.
    Greatest(Option<[String; 2]>),
    /// Where it is least.
    Least(Option<[String; 2]>),
}

/// A problem that is being written.
#[derive(Debug)]
pub(crate) struct Setup {
    pub(crate) draw: Draw,
    pub(crate) units: Units,
    parameters: String,
    sections: String,
    finds: String,
    asked: Vec<Asked>,
}

impl Setup {
    pub(crate) fn new(mut draw: Draw) -> Self {
        let units = Units::random(&mut draw);
        let (parameters, sections, finds) = Default::default();
        Self { draw, units, parameters, sections, finds, asked: vec![] }
    }

    /// A quantity near `size`, which is in the problem's own size.
    pub(crate) fn given(&mut self, name: &str, size: f64, measure: Measure) -> Given {
        let (text, value) = self.quantity(size * self.units.size(measure), measure);
        self.named(name, text, value)
    }

    /// A quantity near a true one, in SI units.
    pub(crate) fn near(&mut self, name: &str, value: &Real, measure: Measure) -> Given {
        let (text, value) = self.quantity(value.to_f64(), measure);
        self.named(name, text, value)
    }

    /// Quantities near sizes in the problem's own size that something is true of together.
    pub(crate) fn fit_all<const N: usize>(
        &mut self,
        names: [&str; N],
        measure: Measure,
        sizes: impl Fn(&mut Draw) -> [f64; N],
        is_fit: impl Fn([&Real; N]) -> bool,
    ) -> [Given; N] {
        loop {
            let sizes = sizes(&mut self.draw);
            let found = sizes.map(|size| self.quantity(size * self.units.size(measure), measure));
            if is_fit(found.each_ref().map(|(_, value)| value)) {
                let mut names = names.into_iter();
                return found.map(|(text, value)| self.named(names.next().unwrap_or_default(), text, value));
            }
        }
    }

    /// A time that something is true of, of those near to what `size` draws, s; `None` where none is found.
    pub(crate) fn time(
        &mut self,
        name: &str,
        size: impl Fn(&mut Draw) -> f64,
        is_fit: impl Fn(&Real) -> bool,
    ) -> Option<Given> {
        let quantity = |setup: &mut Self| {
            let size = size(&mut setup.draw);
            setup.quantity(size, TIME)
        };
        self.fit(name, quantity, |value| value.sign() > 0 && is_fit(value))
    }

    /// An angle that something is true of, of those near to what `size` draws, rad; `None` where none is found.
    pub(crate) fn fit_angle(
        &mut self,
        name: &str,
        size: impl Fn(&mut Draw) -> f64,
        is_fit: impl Fn(&Real) -> bool,
    ) -> Option<Given> {
        let quantity = |setup: &mut Self| {
            let size = size(&mut setup.draw);
            setup.written_angle(size)
        };
        self.fit(name, quantity, is_fit)
    }

    fn fit(
        &mut self,
        name: &str,
        quantity: impl Fn(&mut Self) -> (String, Real),
        is_fit: impl Fn(&Real) -> bool,
    ) -> Option<Given> {
        let mut tries = (0..TRIES).map(|_| quantity(self));
        let (text, value) = tries.find(|(_, value)| is_fit(value))?;
        Some(self.named(name, text, value))
    }

    /// A time within the run.
    pub(crate) fn moment(&mut self, name: &str, until: &Given) -> Given {
        let end = until.near();
        let found = self.time(name, |draw| draw.unit() * end, |time| *time < until.value);
        found.unwrap_or_else(|| until.clone())
    }

    fn quantity(&mut self, size: f64, measure: Measure) -> (String, Real) {
        let own = self.draw.chance(OWN_UNIT);
        let (unit, factor) = if own { self.units.written(measure) } else { Units::standard(measure) };
        let number = self.draw.decimal(size / factor.to_f64());
        (format!("{number} {unit}").trim_end().to_owned(), Real::read(&number) * factor)
    }

    /// An angle near `size`, rad.
    pub(crate) fn angle(&mut self, name: &str, size: f64) -> Given {
        let (text, value) = self.written_angle(size);
        self.named(name, text, value)
    }

    fn written_angle(&mut self, size: f64) -> (String, Real) {
        let unit = self.draw.pick(&["deg", "deg", "rad", "mrad"]);
        let factor = angle_unit(unit);
        let number = self.draw.decimal(size / factor.to_f64());
        (format!("{number} {unit}"), Real::read(&number) * factor)
    }

    /// A rate of turning near `size`, which is in the problem's own size.
    pub(crate) fn omega(&mut self, name: &str, size: f64) -> Given {
        let number = self.draw.decimal(size * self.units.size(super::units::RATE));
        let value = Real::read(&number);
        self.named(name, format!("{number} rad/s"), value)
    }

    /// A place far from the origin, or the origin.
    pub(crate) fn shift(&mut self, name: &str) -> Given {
        let size = if self.draw.chance(SHIFTED) {
            self.draw.sign() * self.draw.log_between(SHIFTS[0], SHIFTS[1])
        } else {
            0.0
        };
        self.given(name, size, LENGTH)
    }

    fn named(&mut self, name: &str, text: String, value: Real) -> Given {
        if self.draw.chance(INLINE) {
            return Given { word: format!("({text})"), value };
        }
        self.parameter(name, &text);
        Given { word: name.to_owned(), value }
    }

    /// A parameter by its formula.
    pub(crate) fn parameter(&mut self, name: &str, formula: &str) {
        let _ = writeln!(self.parameters, "{name} = \"{formula}\"");
    }

    /// Lines of the scene.
    pub(crate) fn write(&mut self, lines: &str) {
        for line in lines.lines() {
            self.sections.push_str(line.trim_start());
            self.sections.push('\n');
        }
    }

    /// Asks for a value with its truth in SI units.
    pub(crate) fn ask(&mut self, that: &str, at: At, truth: &Real, measure: Measure) {
        self.ask_beside(that, at, (truth, self.units.size(measure)), measure);
    }

    /// The same with the size of what it is a sum of, in SI units, for where it is truly zero.
    pub(crate) fn ask_beside(&mut self, that: &str, at: At, (truth, size): (&Real, f64), measure: Measure) {
        let name = format!("v{}", self.asked.len() + 1);
        let is_own = measure != NUMBER && self.draw.chance(OWN_ANSWER);
        let (unit, factor) = if is_own { self.units.written(measure) } else { Units::standard(measure) };
        // The only rates that are asked for are those of angles.
        let unit = unit.strip_prefix("1/").map(|time| format!("rad/{time}")).unwrap_or(unit);
        let that = if is_own { format!("{that} in {unit}") } else { that.to_owned() };
        let when = at.lines();
        let _ = writeln!(self.finds, "[find.{name}]\nthat = \"{that}\"\n{when}");
        let what = format!("{that} {}", when.trim_end().replace('\n', " "));
        let what = what.trim_end().to_owned();
        let size = if truth.is_zero() { size / factor.to_f64() } else { 0.0 };
        self.asked.push(Asked { name, place: Place::Find, what, truth: truth / factor, size });
    }

    /// Asks when a body comes to rest on a surface for good.
    pub(crate) fn ask_rest(&mut self, truth: &Real) {
        let what = "start of the last contact".to_owned();
        let (name, truth) = ("rest".to_owned(), truth.clone());
        self.asked.push(Asked { name, place: Place::Rest, what, truth, size: 0.0 });
    }

    /// Asks for the time of an instant.
    pub(crate) fn ask_time(&mut self, instant: &str, truth: &Real) {
        self.ask("t", At::After(instant.to_owned()), truth, TIME);
    }

    /// The finished problem.
    pub(crate) fn problem(mut self, gravity: &str, until: &Given) -> Problem {
        let size = self.draw.log_between(ACCURACIES[0], ACCURACIES[1]);
        let accuracy = format!("{size:.1e}");
        let Self { parameters, sections, finds, .. } = &self;
        let head = format!("version = 1\nworld.gravity = \"{gravity}\"\n");
        let run = format!("run.until = \"{until}\"\nrun.accuracy = {accuracy}\n");
        let scene = format!("{head}{run}\n[parameters]\n{parameters}\n{sections}\n{finds}");
        Problem { accuracy: size, scene, asked: self.asked }
    }
}

impl At {
    fn lines(&self) -> String {
        let extreme = |which: &str, during: &Option<[String; 2]>| {
            let during = during.as_ref().map(|[from, to]| format!("during = [\"{from}\", \"{to}\"]\n"));
            format!("at = \"its {which}\"\n{}", during.unwrap_or_default())
        };
        match self {
            Self::End => String::new(),
            Self::After(instant) => format!("at = \"{instant}\"\n"),
            Self::Before(instant) => format!("at = \"{instant}\"\nside = \"before\"\n"),
            Self::Greatest(during) => extreme("greatest", during),
            Self::Least(during) => extreme("least", during),
        }
    }
}

fn angle_unit(unit: &str) -> Real {
    match unit {
        "deg" => Real::pi() / 180,
        "mrad" => Real::read("1e-3"),
        _ => Real::from(1),
    }
}
