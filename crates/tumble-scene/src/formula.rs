//! Formulas in the file: their text, what is asked of them, and their mistakes in places of the file.

use std::sync::Arc;

use tumble_expr::language::{self, Formula, FormulaError, SpannedText, StatedUnit, Value};
use tumble_expr::{Dimension, Exponent, Expr};
use tumble_mech::place_symbols;

use crate::code::Code;
use crate::diagnostic::{Diagnostic, Severity, Span, Underlined};
use crate::keys::{Keys, Takes};
use crate::moments;
use crate::names::{Level, Names};
use crate::quantities;

/// Where the text of a formula stands in a source.
#[derive(Clone, Debug)]
pub(crate) struct Origin {
    pub(crate) source: usize,
    /// The whole value, quotes included.
    pub(crate) span: Span,
    /// Where the formula's first byte is, unless escapes stand between it and the file.
    start: Option<usize>,
}

impl Origin {
    /// The place of a text that the file has at `span`, with or without quotes.
    pub(crate) fn of(file: &str, span: Span, text: &str) -> Self {
        let written = &file[span.clone()];
        let start = match written.find(text) {
            // Quotes and nothing else stand around it.
            Some(before) if written.len().saturating_sub(text.len()) <= 7 => Some(span.start + before),
            _ => None,
        };
        Self { source: 0, span, start }
    }

    /// The place of a text that ends a setting on the command line.
    pub(crate) fn of_setting(source: usize, start: usize, length: usize) -> Self {
        Self { source, span: start..start + length, start: Some(start) }
    }

    /// The same place for a text that is not the file's own: whatever is wrong in it, the whole value is underlined.
    pub(crate) fn without_parts(&self) -> Self {
        Self { start: None, ..self.clone() }
    }

    /// The whole value.
    pub(crate) fn whole(&self) -> Span {
        self.span.clone()
    }

    /// The place of a part of the text.
    pub(crate) fn part(&self, part: Span) -> Self {
        let span = self.map(&part);
        Self { source: self.source, start: self.start.map(|_| span.start), span }
    }

    /// A span of the formula's text in its source.
    pub(crate) fn map(&self, span: &Span) -> Span {
        match self.start {
            Some(start) if start + span.end <= self.span.end => start + span.start..start + span.end,
            _ => self.span.clone(),
        }
    }
}

/// A formula's text with its place and the key it belongs to.
#[derive(Clone, Debug)]
pub(crate) struct Text {
    pub(crate) key: String,
    pub(crate) text: String,
    pub(crate) origin: Origin,
}

/// What is asked of a formula.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Want {
    pub(crate) dimension: Option<Dimension>,
    /// Whether it is an angle, or an angle per time, and must say so.
    pub(crate) angle: bool,
    pub(crate) level: Level,
    /// Whether `x` and `y` are the coordinates of a place in it.
    pub(crate) field: bool,
    /// Whether it may hold times that only the run knows.
    pub(crate) moments: bool,
    /// Whether it may hold works up to the instant that it is asked for.
    pub(crate) works: bool,
}

impl Want {
    /// A constant of this dimension.
    pub(crate) fn constant(dimension: Dimension) -> Self {
        Self {
            dimension: Some(dimension),
            angle: false,
            level: Level::Constant,
            field: false,
            moments: false,
            works: false,
        }
    }

    /// A constant as a key declares it.
    pub(crate) fn of(keys: &Keys, key: &str) -> Self {
        match keys.find(key).map(|key| &key.takes) {
            Some(Takes::Quantity(dimension) | Takes::Vector(dimension)) => Self::constant(*dimension),
            Some(Takes::Angle(dimension)) => Self::angular(*dimension),
            _ => Self::any(),
        }
    }

    /// A constant of any dimension.
    pub(crate) fn any() -> Self {
        Self { dimension: None, ..Self::constant(Dimension::NONE) }
    }

    /// A constant angle, or angle per time.
    pub(crate) fn angular(dimension: Dimension) -> Self {
        Self { angle: true, ..Self::constant(dimension) }
    }

    /// The same, free to depend on more.
    pub(crate) fn at(self, level: Level) -> Self {
        Self { level, ..self }
    }

    /// The same, free to depend on the time and the place.
    pub(crate) fn everywhere(self) -> Self {
        Self { level: Level::Time, field: true, ..self }
    }

    /// What is known in this formula only.
    fn own_names(&self, names: &Names, formula: &Formula) -> Vec<(Arc<str>, Value)> {
        let symbols = self.field.then(place_symbols).into_iter().flatten();
        let places = symbols.map(|symbol| (symbol.name.clone(), Expr::from(symbol).into()));
        let moments = if self.moments { moments::symbols(names, formula) } else { vec![] };
        let works = if self.works { quantities::works(names, formula) } else { vec![] };
        places.chain(moments).chain(works).collect()
    }

    /// An example of what is wanted: `1 kg`.
    pub(crate) fn example(&self, number: &str) -> String {
        let unit = self.dimension.map_or_else(|| "m".to_owned(), |dimension| unit_of(dimension, self.angle));
        format!("{number} {unit}").trim_end().to_owned()
    }
}

/// The unit of a dimension as a formula writes it.
fn unit_of(dimension: Dimension, angle: bool) -> String {
    let known = UNITS.iter().find(|(known, of_angle, _)| *known == dimension && *of_angle == angle);
    known.map_or_else(|| chain_of(dimension), |(_, _, unit)| (*unit).to_owned())
}

/// Units without spaces and brackets: `kg*m^2/s^2`, `s^-1`.
fn chain_of(dimension: Dimension) -> String {
    let bases = [(dimension.mass, "kg"), (dimension.length, "m"), (dimension.time, "s")];
    let zero = Exponent::from_integer(0);
    let (above, below): (Vec<_>, Vec<_>) =
        bases.into_iter().filter(|(power, _)| *power != zero).partition(|(power, _)| *power > zero);
    if above.is_empty() {
        return below.iter().map(powered).collect::<Vec<_>>().join("*");
    }
    let chain = above.iter().map(powered).collect::<Vec<_>>().join("*");
    below.iter().fold(chain, |chain, (power, unit)| format!("{chain}/{}", powered(&(-power, unit))))
}

fn powered((power, unit): &(Exponent, &str)) -> String {
    match power.is_integer() {
        true if *power.numer() == 1 => (*unit).to_owned(),
        true => format!("{unit}^{power}"),
        false => format!("{unit}^({power})"),
    }
}

const UNITS: &[(Dimension, bool, &str)] = &[
    (Dimension::NONE, false, ""),
    (Dimension::NONE, true, "rad"),
    (Dimension::ANGULAR_RATE, true, "rad/s"),
    (Dimension::ANGULAR_ACCELERATION, true, "rad/s^2"),
    (Dimension::FORCE, false, "N"),
    (Dimension::TORQUE, false, "N*m"),
];

/// Reads a text as a formula.
pub(crate) fn parse(names: &Names, text: &Text) -> Result<Formula, Vec<Diagnostic>> {
    let origin = &text.origin;
    let anything = Want::any().at(Level::Output);
    language::parse(&text.text).map_err(|errors| translate(names, origin, anything, errors))
}

/// The value of a text as a formula.
pub(crate) fn number(names: &Names, text: &Text, want: Want) -> Result<Expr, Vec<Diagnostic>> {
    let formula = parse(names, text)?;
    let complain = |errors| translate(names, &text.origin, want, errors);
    if want.angle {
        formula.demand_angle_unit().map_err(|error| complain(vec![error]))?;
    }
    let scope = names.scope(want.level);
    let value = formula.check_with(scope, &want.own_names(names, &formula)).map_err(complain)?;
    match want.dimension {
        Some(dimension) => formula.number(value, dimension).map_err(|errors| {
            complain(errors).into_iter().map(|d| with_key(d, text, &formula, want)).collect()
        }),
        None => any_number(&formula, value).map_err(complain),
    }
}

fn any_number(formula: &Formula, value: Value) -> Result<Expr, Vec<FormulaError>> {
    match value {
        Value::Scalar(expr) if expr.dimension().is_ok() => Ok(expr),
        other => {
            let span = 0..formula.text().len();
            let message = format!("expected a number, found {}", other.describe());
            Err(vec![FormulaError::new(language::Code::Shape, span, message)])
        }
    }
}

/// Says which key wants what.
fn with_key(diagnostic: Diagnostic, text: &Text, formula: &Formula, want: Want) -> Diagnostic {
    let expected = Code::Formula(language::Code::Expected);
    let Some(dimension) = want.dimension.filter(|_| diagnostic.code == expected) else { return diagnostic };
    let diagnostic = diagnostic.label(format!("`{}` is {}", text.key, dimension.describe()));
    match formula.stated_unit() {
        StatedUnit::Bare => {
            let number = text.text.trim();
            diagnostic.help(format!("write \"{}\", with the unit", want.example(number)))
        }
        _ => diagnostic,
    }
}

/// Mistakes of a formula as mistakes of the scene.
pub(crate) fn translate(
    names: &Names,
    origin: &Origin,
    want: Want,
    errors: Vec<FormulaError>,
) -> Vec<Diagnostic> {
    let translator = Translator { names, origin, want };
    errors.into_iter().filter_map(|error| translator.one(error)).collect()
}

struct Translator<'n> {
    names: &'n Names,
    origin: &'n Origin,
    want: Want,
}

impl Translator<'_> {
    /// `None` for what only follows from another mistake.
    fn one(&self, error: FormulaError) -> Option<Diagnostic> {
        let origin = self.place(&error.place);
        let labels =
            error.labels.iter().map(|(span, text)| Underlined { span: origin.map(span), text: text.clone() });
        let mut mistake = Diagnostic {
            severity: Severity::Error,
            code: error.code.into(),
            message: error.message.clone(),
            source: origin.source,
            labels: labels.collect(),
            help: error.help.clone(),
        };
        for call in &error.calls {
            let caller = self.place(&call.place);
            if caller.source == origin.source {
                mistake = mistake.also(caller.map(&call.span), call.note.clone());
            }
        }
        match error.code {
            language::Code::UnknownName | language::Code::UnknownFunction => {
                self.explain_name(&error, mistake)
            }
            _ => Some(mistake),
        }
    }

    fn place(&self, place: &SpannedText) -> &Origin {
        match place {
            SpannedText::Formula => self.origin,
            SpannedText::Body(function) => self.names.functions.get(&**function).unwrap_or(self.origin),
        }
    }

    fn explain_name(&self, error: &FormulaError, mistake: Diagnostic) -> Option<Diagnostic> {
        let name = error.message.split('`').nth(1).unwrap_or_default();
        if self.names.is_broken(name) {
            return None;
        }
        let span = mistake.labels.first().map_or(0..0, |label| label.span.clone());
        if let Some(of_moment) = moments::explain(self.names, name, self.want.moments, &span) {
            return Some(Diagnostic { source: mistake.source, ..of_moment });
        }
        if let Some(of_work) = quantities::explain_work(self.names, name, &span) {
            return Some(Diagnostic { source: mistake.source, ..of_work });
        }
        let level = self.want.level;
        let exists = self.names.scope(Level::Output).value(name).is_some() || !name.contains('.');
        match self.names.level_of(name) {
            Some(needed) if needed > level && (exists || level < Level::Motion) => {
                Some(misplaced(name, (needed, level), mistake))
            }
            _ => Some(mistake),
        }
    }
}

fn misplaced(name: &str, (needed, level): (Level, Level), mut mistake: Diagnostic) -> Diagnostic {
    let (code, message, label, help) = match level {
        Level::Constant => (
            Code::Changing,
            format!("`{name}` changes during the run"),
            "this value is fixed before the run starts",
            "use numbers and parameters only",
        ),
        Level::Time => (
            Code::Changing,
            format!("`{name}` follows from the motion"),
            "this course is given before the run starts",
            "use the time `t`, numbers and parameters only",
        ),
        Level::Motion if needed == Level::Forces => (
            Code::Changing,
            format!("`{name}` is a force, on which no place and no impulse can depend"),
            "follows from all forces at a time",
            "use positions, velocities and the time here; what a `[force.NAME]` is may depend on it",
        ),
        _ => (
            Code::Acceleration,
            "a force cannot depend on an acceleration".to_owned(),
            "accelerations follow from the forces",
            "use positions, velocities, the time, and forces of contacts and joints",
        ),
    };
    (mistake.code, mistake.message) = (code, message);
    mistake.label(label).help(help)
}
