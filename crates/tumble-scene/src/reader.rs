//! Typed reading of fields: every mistake is noted and the reading goes on.

use toml::de::DeValue;
use tumble_expr::{Dimension, Expr, Vector};
use tumble_mech::Body;

use crate::code::Code;
use crate::diagnostic::{Diagnostic, Span};
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::file_names::folded;
use crate::formula::{self, Origin, Text, Want};
use crate::keys::Keys;
use crate::names::fit_file;
use crate::printable::is_unseen;
use crate::{suggest, words};

/// Reading of values. `None` means that a mistake has been noted.
impl Draft {
    pub(crate) fn note(&mut self, mistake: Diagnostic) {
        self.mistakes.push(mistake);
    }

    /// The value of an outcome, its mistake noted.
    pub(crate) fn noted<T>(&mut self, outcome: Result<T, Diagnostic>) -> Option<T> {
        outcome.map_err(|mistake| self.note(mistake)).ok()
    }

    /// The value of an outcome, its mistakes noted.
    pub(crate) fn all_noted<T>(&mut self, outcome: Result<T, Vec<Diagnostic>>) -> Option<T> {
        outcome.map_err(|mistakes| self.mistakes.extend(mistakes)).ok()
    }

    /// The field, or the mistake that it is missing, with the declared example.
    pub(crate) fn required<'t>(&mut self, table: &mut Table<'t>, key: &str) -> Option<Field<'t>> {
        let example = table.keys.find(key).map_or("..", |key| key.example);
        self.required_like(table, key, example)
    }

    /// The same with an example of its own.
    pub(crate) fn required_like<'t>(
        &mut self,
        table: &mut Table<'t>,
        key: &str,
        example: &str,
    ) -> Option<Field<'t>> {
        let field = table.take(key);
        if field.is_none() {
            let message = format!("`{key}` is missing in `{}`", table.title);
            let mistake = Diagnostic::new(Code::MissingKey, table.span.clone(), message);
            self.note(mistake.label(format!("has no `{key}`")).help(format!("add `{key} = {example}`")));
        }
        field
    }

    /// The name of a section, which is then taken.
    pub(crate) fn own_name(&mut self, owner: &'static str, field: &Field) -> String {
        let claimed = self.names.claim(owner, field.key, field.key_span.clone());
        self.noted(claimed);
        self.remember(format!("`{}`", field.key), &field.key_span);
        field.key.to_owned()
    }

    /// The name of a figure, which no other figure has, of whatever kind: it is the name of a file.
    pub(crate) fn figure_name(&mut self, field: &Field) {
        self.noted(fit_file(field));
        let (name, span) = (field.key, field.key_span.clone());
        if let Some((other, first)) = self.figures.insert(folded(name), (name.to_owned(), span)) {
            let message = match other == name {
                true => format!("two figures have the name `{name}`"),
                false => format!("the figures `{other}` and `{name}` are one file on some systems"),
            };
            let mistake = Diagnostic::new(Code::NameTaken, field.key_span.clone(), message);
            let mistake = mistake.label("this name is taken").also(first, "the first figure");
            self.note(mistake.help("figures become files: give each its own name"));
        }
    }

    /// A constant that must be given, of the declared dimension; `name` is whose it is.
    pub(crate) fn coefficient(&mut self, table: &mut Table, name: &str, key: &str) -> Option<Expr> {
        let want = Want::of(table.keys, key);
        let field = self.required(table, key)?;
        self.constant(name, &field, want)
    }

    /// The same where it may be left out, with what it then is.
    pub(crate) fn coefficient_or(
        &mut self,
        table: &mut Table,
        name: &str,
        key: &str,
        default: Expr,
    ) -> Option<Expr> {
        let want = Want::of(table.keys, key);
        match table.take(key) {
            Some(field) => self.constant(name, &field, want),
            None => Some(default),
        }
    }

    /// A number whose place is remembered.
    pub(crate) fn constant(&mut self, name: &str, field: &Field, want: Want) -> Option<Expr> {
        self.remember(format!("{} of `{name}`", field.key.replace('_', " ")), &field.span);
        self.number(field, want)
    }

    /// What a value of the parameter that is this field's key must be; the parameter must exist.
    pub(crate) fn parameter(&mut self, field: &Field) -> Option<Want> {
        if let Some(symbol) = self.model.parameters.symbol(field.key) {
            let angle = self.angular.contains(field.key);
            return Some(Want { angle, ..Want::constant(symbol.dimension) });
        }
        if !self.names.is_broken(field.key) {
            let symbols = self.model.parameters.symbols();
            let help = suggest::name(field.key, "parameters", symbols.iter().map(|symbol| &*symbol.name));
            let message = format!("there is no parameter `{}`", field.key);
            let mistake = Diagnostic::new(Code::UnknownParameter, field.key_span.clone(), message);
            self.note(mistake.label("unknown parameter").help(help));
        }
        None
    }

    /// A body by its name; `None` where it has mistakes of its own.
    pub(crate) fn body_named(&self, name: &str) -> Option<Body> {
        self.model.bodies.iter().find(|body| body.name == name).cloned()
    }

    /// `true` or `false`.
    pub(crate) fn flag(&mut self, field: &Field) -> Option<bool> {
        match field.value {
            DeValue::Boolean(flag) => Some(*flag),
            _ => {
                self.wrong_type(field, "`true` or `false`");
                None
            }
        }
    }

    /// Everything that was not asked for is unknown.
    pub(crate) fn done(&mut self, table: Table) {
        for field in &table.fields {
            if self.is_full() {
                break;
            }
            let message = format!("`{}` has no key `{}`", table.title, field.key);
            let mistake = Diagnostic::new(Code::UnknownKey, field.key_span.clone(), message);
            self.note(mistake.label("unknown key").help(suggest::key(&table, field.key)));
        }
    }

    pub(crate) fn wrong_type(&mut self, field: &Field, expected: &str) {
        let message = format!("`{}` is {expected}, not {}", field.key, field.describe());
        let mistake = Diagnostic::new(Code::WrongType, field.span.clone(), message);
        self.note(mistake.label(format!("this is {}", field.describe())));
    }

    /// A table, inline or of its own, with its title; mistakes of the whole underline its key.
    pub(crate) fn titled<'t>(
        &mut self,
        field: &Field<'t>,
        keys: &'static Keys,
        title: String,
    ) -> Option<Table<'t>> {
        match field.value {
            DeValue::Table(table) => Some(Table::new(keys, title, field.key_span.clone(), table)),
            _ => {
                self.wrong_type(field, "a table");
                None
            }
        }
    }

    /// A table called by its key.
    pub(crate) fn table<'t>(&mut self, field: &Field<'t>, keys: &'static Keys) -> Option<Table<'t>> {
        self.titled(field, keys, field.key.to_owned())
    }

    /// A table called by its key; mistakes of the whole underline its braces.
    pub(crate) fn inline<'t>(&mut self, field: &Field<'t>, keys: &'static Keys) -> Option<Table<'t>> {
        let span = field.span.clone();
        self.table(field, keys).map(|table| Table { span, ..table })
    }

    /// A text that is no formula.
    pub(crate) fn words(&mut self, field: &Field) -> Option<String> {
        let words = field.value.as_str().map(str::to_owned);
        if words.is_none() {
            self.wrong_type(field, "a text in quotes");
        }
        words
    }

    /// A text that figures and reports show in one line.
    pub(crate) fn line(&mut self, field: &Field) -> Option<String> {
        let text = self.words(field)?;
        let Some((at, unseen)) = text.char_indices().find(|(_, c)| is_unseen(*c)) else { return Some(text) };
        let origin = Origin::of(&self.sources[0].text, field.span.clone(), &text);
        let span = origin.map(&(at..at + unseen.len_utf8()));
        let message =
            format!("`{}` has the character U+{:04X}, which is not shown", field.key, u32::from(unseen));
        let cure = if unseen == '\n' { "write it in one line" } else { "leave this character out" };
        self.note(Diagnostic::new(Code::Unseen, span, message).label("not shown").help(cure));
        None
    }

    /// One of a few words.
    pub(crate) fn choice(&mut self, field: &Field, words: &[&'static str]) -> Option<&'static str> {
        let found = self.words(field)?;
        let chosen = words.iter().find(|word| **word == found).copied();
        if chosen.is_none() {
            let quoted: Vec<_> = words.iter().map(|word| format!("\"{word}\"")).collect();
            let message = format!("`{}` cannot be \"{found}\"", field.key);
            let mistake = Diagnostic::new(Code::Choice, field.span.clone(), message);
            self.note(mistake.label("unknown word").help(format!("write {}", quoted.join(" or "))));
        }
        chosen
    }

    /// A number as TOML writes it.
    pub(crate) fn bare_number(&mut self, field: &Field) -> Option<f64> {
        let text = match field.value {
            DeValue::Integer(integer) => integer.to_string(),
            DeValue::Float(float) => float.to_string(),
            _ => {
                self.wrong_type(field, "a number without quotes");
                return None;
            }
        };
        text.parse().map_err(|_| self.wrong_type(field, "a decimal number")).ok()
    }

    /// A formula that is a number.
    pub(crate) fn number(&mut self, field: &Field, want: Want) -> Option<Expr> {
        let text = self.text(field, want)?;
        let outcome = formula::number(&self.names, &text, want);
        self.all_noted(outcome)
    }

    /// A formula's text: in quotes, or a bare number where no unit is wanted.
    pub(crate) fn text(&mut self, field: &Field, want: Want) -> Option<Text> {
        let text = match field.value {
            DeValue::String(text) => text.to_string(),
            DeValue::Integer(_) | DeValue::Float(_) => {
                let outcome = bare(field, want);
                self.noted(outcome)?
            }
            DeValue::Array(_) => {
                self.wrong_type(field, "one formula in quotes");
                return None;
            }
            _ => {
                self.wrong_type(field, "a formula in quotes");
                return None;
            }
        };
        let origin = Origin::of(&self.sources[0].text, field.span.clone(), &text);
        Some(Text { key: field.key.to_owned(), text, origin })
    }

    /// Two components.
    pub(crate) fn vector(&mut self, field: &Field, want: Want) -> Option<Vector> {
        let [x, y] = self.pair(field, "[x, y]")?;
        let (x, y) = (self.number(&x, want), self.number(&y, want));
        Some(Vector::planar(x?, y?))
    }

    /// A list of two.
    pub(crate) fn pair<'t>(&mut self, field: &Field<'t>, shape: &str) -> Option<[Field<'t>; 2]> {
        let Some(parts) = field.elements() else {
            self.wrong_type(field, &format!("a list of two, {shape}"));
            return None;
        };
        let count = parts.len();
        let pair = <[Field; 2]>::try_from(parts).ok();
        if pair.is_none() {
            let message = format!("`{}` is a list of two, {shape}, not of {count}", field.key);
            let mistake =
                Diagnostic::new(Code::Length, field.span.clone(), message).label(format!("{count} here"));
            self.note(if count == 3 { mistake.help(words::IN_SPACE) } else { mistake });
        }
        pair
    }

    /// A constant vector of lengths.
    pub(crate) fn place(&mut self, field: &Field) -> Option<Vector> {
        self.vector(field, Want::constant(Dimension::LENGTH))
    }

    /// Remembers where something stands that only numbers can prove wrong.
    pub(crate) fn remember(&mut self, what: impl Into<String>, span: &Span) {
        self.places.remember(what, span);
    }
}

/// A number without quotes as a formula: where a quantity is wanted only a zero can do without its unit.
fn bare(field: &Field, want: Want) -> Result<String, Diagnostic> {
    let text = match field.value {
        DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().to_owned(),
        DeValue::Float(float) => float.as_str().to_owned(),
        other => return Err(odd_number(field, other)),
    };
    let text = text.trim_start_matches('+').to_owned();
    if text.contains(['n', 'i']) {
        let message = format!("`{}` cannot be `{text}`", field.key);
        return Err(
            Diagnostic::new(Code::NotFinite, field.span.clone(), message).label("not a finite number")
        );
    }
    let zero = !text.contains(|c: char| c.is_ascii_digit() && c != '0');
    let pure = want.dimension.is_none_or(|dimension| dimension == Dimension::NONE) && !want.angle;
    if zero || pure { Ok(text) } else { Err(bare_number(field, &text, want)) }
}

fn odd_number(field: &Field, value: &DeValue) -> Diagnostic {
    let number = value.as_integer().map(ToString::to_string).unwrap_or_default();
    let message = format!("`{}` is a decimal number, not `{number}`", field.key);
    Diagnostic::new(Code::WrongType, field.span.clone(), message).label("not decimal")
}

fn bare_number(field: &Field, number: &str, want: Want) -> Diagnostic {
    let dimension = want.dimension.unwrap_or(Dimension::NONE);
    let angle = dimension == Dimension::NONE;
    let what = if angle { "an angle".to_owned() } else { dimension.describe() };
    let message = format!("`{}` is {what}, not a bare number", field.key);
    let cure = match angle {
        true => format!("write \"{number} deg\" or \"{number} rad\", in quotes"),
        false => format!("write \"{}\", in quotes and with its unit", want.example(number)),
    };
    Diagnostic::new(Code::BareNumber, field.span.clone(), message).label("which unit?").help(cure)
}
