//! Times that only the run knows: events, `apex[2]`, and contacts, `floor.contact[1].start`.

use std::sync::Arc;

use tumble_expr::language::{Formula, Value, nearest};
use tumble_expr::{Dimension, Symbol};
use tumble_mech::Change;

use crate::code::Code;
use crate::diagnostic::{Diagnostic, Span};
use crate::document::Field;
use crate::draft::Draft;
use crate::formula::{self, Text, Want};
use crate::names::Names;
use crate::printable::one_line;
use crate::study::Instant;

/// What a contact may be asked for.
const PARTS: &[&str] = &["start", "end", "duration"];

/// Which of several of a kind is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {
    /// From the first, which is 1.
    Nth(usize),
    /// The last one of the run.
    Last,
}

impl Count {
    const FIRST: Self = Self::Nth(1);

    /// `1`, `2`, ... or `last`.
    pub fn read(text: &str) -> Option<Self> {
        match text {
            "last" => Some(Self::Last),
            _ => text.parse().ok().filter(|count| *count > 0).map(Self::Nth),
        }
    }

    /// The one that is meant.
    pub fn of<T>(self, mut all: impl Iterator<Item = T>) -> Option<T> {
        match self {
            Self::Nth(count) => all.nth(count - 1),
            Self::Last => all.last(),
        }
    }
}

impl std::fmt::Display for Count {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Nth(count) => write!(f, "{count}"),
            Self::Last => write!(f, "last"),
        }
    }
}

/// A time, perhaps before or after an event or a contact: `"floor.contact[1].start - 20 ms"`.
pub(crate) fn instant(draft: &mut Draft, field: &Field) -> Option<Instant> {
    let want = Want { moments: true, ..Want::constant(Dimension::TIME) };
    let written = draft.text(field, want)?;
    let outcome = part_of_contact(&draft.names, &written);
    let text = draft.noted(outcome)?;
    let outcome = formula::number(&draft.names, &text, want);
    let time = draft.all_noted(outcome)?;
    Some(Instant { text: one_line(&written.text), time })
}

/// From one instant to another.
pub(crate) fn pair(draft: &mut Draft, field: &Field) -> Option<[Instant; 2]> {
    let [from, to] = draft.pair(field, "[from, to]")?;
    let (from, to) = (instant(draft, &from), instant(draft, &to));
    Some([from?, to?])
}

/// `c.at(10%)` is `c.start + (10%)*c.duration`.
fn part_of_contact(names: &Names, text: &Text) -> Result<Text, Diagnostic> {
    let Some((before, rest)) = text.text.split_once(".at(") else { return Ok(text.clone()) };
    let contact = before.rsplit(|c: char| c.is_whitespace() || "+-*/(".contains(c)).next().unwrap_or(before);
    if contact_of(names, contact).is_none() {
        return Ok(text.clone());
    }
    let Some(close) = rest.find(')') else {
        let message = format!("the bracket after `{contact}.at` is not closed");
        return Err(Diagnostic::new(Code::Value, text.origin.whole(), message)
            .help(format!("write \"{contact}.at(50%)\"")));
    };
    let (part, after) = (&rest[..close], &rest[close + 1..]);
    let head = &before[..before.len() - contact.len()];
    let whole = format!("{head}({contact}.start + ({part})*{contact}.duration){after}");
    // Spans of the rewritten text are none of the file's: mistakes underline the whole value.
    Ok(Text { text: whole, origin: text.origin.without_parts(), ..text.clone() })
}

/// What touches, and which time it does, of `floor.rod.contact[2]`.
pub(crate) fn contact_of<'n>(names: &Names, text: &'n str) -> Option<(&'n str, Count)> {
    let (pair, rest) = text.rsplit_once(".contact")?;
    let count = match rest {
        "" => Count::FIRST,
        _ => Count::read(rest.strip_prefix('[')?.strip_suffix(']')?)?,
    };
    names.touching.contains(pair).then_some((pair, count))
}

/// An event with its count, `apex[2]`; the first where none is said.
fn event_of<'n>(names: &Names, text: &'n str) -> Option<(&'n str, Count)> {
    let (name, count) = match text.split_once('[') {
        Some((name, rest)) => (name, Count::read(rest.strip_suffix(']')?)?),
        None => (text, Count::FIRST),
    };
    let is_known = names.happenings.contains(name) || names.events.iter().any(|event| event == name);
    (is_known || is_rest(names, name) && count == Count::FIRST).then_some((name, count))
}

/// The instant at which a body has come to rest for good, `rod.rest`.
fn is_rest(names: &Names, name: &str) -> bool {
    let body = name.strip_suffix(".rest");
    body.is_some_and(|body| names.bodies.iter().any(|known| known == body))
}

/// The symbols of all moments in a formula, by the names they have there.
pub(crate) fn symbols(names: &Names, formula: &Formula) -> Vec<(Arc<str>, Value)> {
    let symbol = |name: &str| -> Option<(Arc<str>, Value)> {
        let canonical = canonical(names, name)?;
        let symbol: tumble_expr::Expr = Symbol::new(canonical, Dimension::TIME).into();
        Some((name.into(), symbol.into()))
    };
    formula.names().into_iter().filter_map(|name| symbol(name.name)).collect()
}

/// The name with its count: `apex[1]`, `floor.contact[1].start`.
fn canonical(names: &Names, name: &str) -> Option<String> {
    if let Some((event, count)) = event_of(names, name) {
        return Some(format!("{event}[{count}]"));
    }
    let (contact, part) = name.rsplit_once('.')?;
    let (pair, count) = contact_of(names, contact)?;
    PARTS.contains(&part).then(|| format!("{pair}.contact[{count}].{part}"))
}

/// A contact with no surface, or nearly an event.
fn unknown(names: &Names, name: &str, stem: &str, allowed: bool, span: &Span) -> Option<Diagnostic> {
    let mistake = |code, message: String, help: String| {
        Diagnostic::new(code, span.clone(), message).label("unknown name").help(help)
    };
    let surfaces = names.places().map(String::as_str);
    if name.contains(".contact[") && !names.bodies.iter().any(|body| body == stem) {
        let help = crate::suggest::name(stem, "surfaces", surfaces);
        return Some(mistake(Code::UnknownPoint, format!("there is no surface `{stem}`"), help));
    }
    let known = Code::Formula(tumble_expr::language::Code::UnknownName);
    let (word, near) = match name.contains('.') {
        true => (name, nearest(name, names.happenings.iter().map(String::as_str))),
        false => (stem, nearest(stem, names.events.iter().map(String::as_str))),
    };
    let near = near.filter(|_| allowed)?;
    Some(mistake(known, format!("nothing is named `{word}`"), format!("did you mean the event \"{near}\"?")))
}

/// A change that friction never makes to what touches there, `floor.box.slides`.
fn no_slip(names: &Names, name: &str, span: &Span) -> Option<Diagnostic> {
    let (place, change) = name.rsplit_once('.')?;
    let is_change = Change::OF_FRICTION.iter().any(|known| known.word() == change);
    if !is_change || !names.touching.contains(place) {
        return None;
    }
    let (why, help) = match names.happenings.contains(&format!("{place}.{}", Change::Sticks.word())) {
        true => ("nothing round touches there", format!("it has `{place}.slides` and `{place}.sticks`")),
        false => {
            let help = "give it a `friction`, as in `rigid = { restitution = 0, friction = 0.3 }`";
            ("it has no friction", help.to_owned())
        }
    };
    let message = format!("`{place}` never {change}: {why}");
    Some(Diagnostic::new(Code::UnknownPoint, span.clone(), message).label("does not happen").help(help))
}

/// What is wrong with a name that speaks of a contact or an event, if it does; `allowed` says whether it may here.
pub(crate) fn explain(names: &Names, name: &str, allowed: bool, span: &Span) -> Option<Diagnostic> {
    let stem = name.split(['[', '.']).next().unwrap_or(name);
    let is_event = names.events.iter().any(|event| event == stem);
    let is_contact = names.places().any(|place| place == stem) && name.contains(".contact");
    let mistake = |code, message: String| Diagnostic::new(code, span.clone(), message);
    if !is_event && !is_contact {
        return no_slip(names, name, span).or_else(|| unknown(names, name, stem, allowed, span));
    }
    if !allowed {
        let what =
            if is_event { "an event, not a value" } else { "a contact, whose times only the run knows" };
        let shown = if is_event { stem } else { name };
        let mistake =
            mistake(Code::EventInFormula, format!("`{shown}` is {what}")).label("only the run knows");
        return Some(mistake.help(if is_event {
            format!("an event stands alone, as in `during = [\"{stem}\", \"10 s\"]` or in a check `at = \"{stem}\"`")
        } else {
            "times of contacts stand in checks, free-body diagrams and the `during` of a figure".to_owned()
        }));
    }
    if is_event {
        let count = name.strip_prefix(stem).unwrap_or_default();
        let help = format!("events are counted from 1: the first is \"{stem}\" or \"{stem}[1]\"");
        return Some(
            mistake(Code::Value, format!("`{count}` does not count an event")).label("which one?").help(help),
        );
    }
    let pairs: Vec<&str> = names.touching.iter().map(String::as_str).collect();
    let (pair, part) = name.rsplit_once(".contact").unwrap_or((name, ""));
    if !pairs.contains(&pair) {
        let help = crate::suggest::name(pair, "contacts", pairs);
        return Some(mistake(Code::UnknownPoint, format!("nothing touches as `{pair}`")).help(help));
    }
    let message = format!("`{name}` is no time of a contact");
    let help = format!(
        "write \"{pair}.contact[1].start\", `.end`, `.duration` or `.at(50%)`; found `contact{part}`"
    );
    Some(mistake(Code::Value, message).label("which time?").help(help))
}
