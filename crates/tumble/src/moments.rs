//! Times that only a run knows: of events, and of the starts and ends of contacts.

use tumble_expr::{Expr, Substitution, Symbol};
use tumble_mech::{Contact, Run};
use tumble_scene::{Instant, Study};

use crate::pipeline::PipelineError;

/// The events and contacts of one run.
pub(crate) struct Moments<'a> {
    study: &'a Study,
    run: &'a Run,
    contacts: Vec<Contact>,
}

impl<'a> Moments<'a> {
    /// Those of a run of a study with the run's parameters.
    pub(crate) fn of(study: &'a Study, run: &'a Run) -> Self {
        Self { study, run, contacts: run.contacts() }
    }

    /// When that is, s; `None` if it does not happen.
    pub(crate) fn time(&self, instant: &Instant) -> Result<Option<f64>, PipelineError> {
        match self.known(&instant.time) {
            Some(time) => Ok(Some(self.study.number(&time)?)),
            None => Ok(None),
        }
    }

    /// From when to when, s; the whole run where nothing is said, and `None` if one of the two does not happen or they happen
    /// in the other order.
    pub(crate) fn window(&self, during: Option<&[Instant; 2]>) -> Result<Option<[f64; 2]>, PipelineError> {
        Ok(self.ends(during)?.filter(|[from, to]| from <= to))
    }

    /// The same in any order.
    pub(crate) fn ends(&self, during: Option<&[Instant; 2]>) -> Result<Option<[f64; 2]>, PipelineError> {
        let Some([from, to]) = during else { return Ok(Some([0.0, f64::INFINITY])) };
        Ok(self.time(from)?.zip(self.time(to)?).map(|(from, to)| [from, to]))
    }

    /// A formula with its moments replaced by their times; `None` if one of them does not happen.
    pub(crate) fn known(&self, formula: &Expr) -> Option<Expr> {
        let mut times = Substitution::default();
        for symbol in
            formula.symbols().into_iter().filter(|symbol| symbol.name.ends_with(']') || is_contact(symbol))
        {
            let time = self.time_of(&symbol.name)?;
            times.insert(symbol, Expr::from(time) * tumble_expr::units::S);
        }
        Some(times.apply(formula))
    }

    fn time_of(&self, name: &str) -> Option<f64> {
        if let Some((event, count)) = counted(name) {
            let named =
                self.run.trajectory.events.iter().filter(|known| known.tags.iter().any(|tag| tag == event));
            return named.map(|event| event.time).nth(count - 1);
        }
        let (contact, part) = name.rsplit_once('.')?;
        let (place, count) = counted(contact)?;
        let found = self.contact(place.strip_suffix(".contact")?, count)?;
        match part {
            "start" => Some(found.start),
            "end" => Some(found.end),
            _ => Some(found.end - found.start),
        }
    }

    /// The contact of that count of a surface, of a body with it, or of one point of the body.
    fn contact(&self, place: &str, count: usize) -> Option<&Contact> {
        let pairs = self.run.equations.pairs();
        let is_there = |contact: &&Contact| {
            let rest = pairs[contact.pair].name.strip_prefix(place);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        };
        self.contacts.iter().filter(is_there).nth(count - 1)
    }
}

fn is_contact(symbol: &Symbol) -> bool {
    symbol.name.contains(".contact[")
}

/// `apex[2]` in its two parts.
fn counted(name: &str) -> Option<(&str, usize)> {
    let (name, count) = name.strip_suffix(']')?.rsplit_once('[')?;
    Some((name, count.parse().ok().filter(|count| *count > 0)?))
}
