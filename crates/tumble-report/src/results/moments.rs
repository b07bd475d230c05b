//! Times that only a run knows: of events, and of the starts and ends of contacts.

use tumble_expr::{Expr, Symbol};
use tumble_mech::{Change, Contact, Happening};
use tumble_scene::{Count, Instant, Study};

use crate::results::CaseError;
use crate::results::case::Solution;
use crate::results::known::{AllKnown, Known};

/// The events and contacts of one run.
pub(crate) struct Moments<'a> {
    study: &'a Study,
    solution: Solution<'a>,
    contacts: Vec<Contact>,
}

/// A formula with its moments replaced by their times.
pub(crate) struct Timed {
    /// With the times that were found.
    pub(crate) formula: Expr,
    /// For each moment, the formula with that one off by its error.
    pub(crate) variants: Vec<Expr>,
    /// For each moment, the formula with that one off by what rounding alone may have done to it.
    pub(crate) blurred: Vec<Expr>,
    /// Whether all errors are known.
    pub(crate) is_sure: bool,
}

impl Timed {
    /// A formula without moments.
    pub(crate) fn plain(formula: &Expr) -> Self {
        Self::with(&AllKnown::default(), formula)
    }

    fn with(times: &AllKnown, formula: &Expr) -> Self {
        Self {
            formula: times.put_into(formula),
            variants: times.variants(formula),
            blurred: times.blurred(formula),
            is_sure: times.is_sure(),
        }
    }
}

impl<'a> Moments<'a> {
    /// Those of a run of a study with the run's parameters.
    pub(crate) fn of(study: &'a Study, solution: Solution<'a>) -> Self {
        Self { study, solution, contacts: solution.run.contacts() }
    }

    /// Whether a formula holds times that only a run knows.
    pub(crate) fn names(formula: &Expr) -> bool {
        formula.symbols().iter().any(is_moment)
    }

    /// When that is, s, with the error of that; `None` if it does not happen.
    pub(crate) fn time(&self, instant: &Instant) -> Result<Option<(f64, Option<f64>)>, CaseError> {
        let Some(timed) = self.known(&instant.time) else { return Ok(None) };
        let time = self.study.number(&timed.formula)?;
        let mut error = 0.0;
        for variant in &timed.variants {
            error += (self.study.number(variant)? - time).abs();
        }
        Ok(Some((time, timed.is_sure.then_some(error))))
    }

    /// Error of the time of an event, s: of the time at which an event has ended the run, too.
    pub(crate) fn event_error(&self, time: f64) -> Option<f64> {
        let is_event = self.solution.run.events().any(|event| event.time == time);
        let trust = self.solution.trust?;
        if is_event { trust.event_error(self.solution.run, time) } else { Some(f64::EPSILON * time) }
    }

    /// From when to when, s; the whole run where nothing is said, and `None` if one of the two does not happen or they happen
    /// in the other order.
    pub(crate) fn window(&self, during: Option<&[Instant; 2]>) -> Result<Option<[f64; 2]>, CaseError> {
        Ok(self.ends(during)?.filter(|[from, to]| from <= to))
    }

    /// The same in any order.
    pub(crate) fn ends(&self, during: Option<&[Instant; 2]>) -> Result<Option<[f64; 2]>, CaseError> {
        let Some([from, to]) = during else { return Ok(Some([0.0, f64::INFINITY])) };
        Ok(self.time(from)?.zip(self.time(to)?).map(|((from, _), (to, _))| [from, to]))
    }

    /// A formula with its moments replaced by their times; `None` if one of them does not happen.
    pub(crate) fn known(&self, formula: &Expr) -> Option<Timed> {
        let symbols = formula.symbols().into_iter().filter(is_moment);
        let times = symbols.map(|symbol| self.time_of(&symbol.name).map(|known| (symbol, known)));
        Some(Timed::with(&AllKnown(times.collect::<Option<_>>()?), formula))
    }

    fn time_of(&self, name: &str) -> Option<Known> {
        let run = self.solution.run;
        let at = |time: f64| Known {
            value: time,
            error: self.event_error(time),
            blur: tumble_mech::Trust::event_blur(run, time),
        };
        if let Some((event, count)) = counted(name) {
            if let Some(body) = self.resting(event) {
                return run.rest_of(body).ok().flatten().map(at);
            }
            let named = self.named(event)?;
            let there = run.events().filter(|event| event.record.happened.iter().any(&named));
            return count.of(there).map(|event| at(event.time));
        }
        let (contact, part) = name.rsplit_once('.')?;
        let (place, count) = counted(contact)?;
        let found = self.contact(place.strip_suffix(".contact")?, count)?;
        let [start, end] = [at(found.start), at(found.end)];
        Some(match part {
            "start" => start,
            "end" => end,
            _ if found.start == found.end => Known { value: 0.0, error: Some(0.0), blur: 0.0 },
            _ => Known {
                value: found.end - found.start,
                error: start.error.zip(end.error).map(|(start, end)| start + end),
                blur: start.blur + end.blur,
            },
        })
    }

    /// What is called so: `apex`, or `floor.ball.rolls` of any point of the ball.
    fn named<'n>(&self, name: &'n str) -> Option<impl Fn(&Happening) -> bool + use<'a, 'n>> {
        let equations = &self.solution.run.equations;
        let (place, word) = name.rsplit_once('.').unwrap_or((name, ""));
        let slips =
            Change::OF_FRICTION.into_iter().chain(Change::OF_ROLLING).find(|change| change.word() == word);
        let happening = equations.named(name);
        (happening.is_some() || slips.is_some()).then_some(move |own: &Happening| match *own {
            Happening::Contact { pair, change } => {
                Some(change) == slips && is_part(&equations.pairs()[pair].name, place)
            }
            own => Some(own) == happening,
        })
    }

    /// The body whose rest is called so, `rod.rest`.
    fn resting(&self, name: &str) -> Option<usize> {
        self.solution.run.equations.model().body_index(name.strip_suffix(".rest")?)
    }

    /// The contact of that count of a surface, of a body with it, or of one point of the body.
    fn contact(&self, place: &str, count: Count) -> Option<&Contact> {
        let pairs = self.solution.run.equations.pairs();
        let is_there = |contact: &&Contact| is_part(&pairs[contact.pair].name, place);
        count.of(self.contacts.iter().filter(is_there))
    }
}

fn is_moment(symbol: &Symbol) -> bool {
    symbol.name.ends_with(']') || symbol.name.contains(".contact[")
}

/// Whether a name such as `floor.rod.tip` is that of a part of a whole such as `floor.rod`, or of all of it.
pub(crate) fn is_part(name: &str, whole: &str) -> bool {
    name.strip_prefix(whole).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// `apex[2]` in its two parts.
fn counted(name: &str) -> Option<(&str, Count)> {
    let (name, count) = name.strip_suffix(']')?.rsplit_once('[')?;
    Some((name, Count::read(count)?))
}
