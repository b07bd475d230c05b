//! Numbers of a study that must make sense: the end of the run, distances of samples, times of checks.

use tumble_expr::{Dimension, Expr};
use tumble_mech::Known;

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::draft::Draft;
use crate::study::{Check, Curve, Instant, Question, When};

/// More samples than this are a slip of the unit.
const MAX_SAMPLES: f64 = 1e6;

/// rad; doubles near a larger angle are an eighth of a radian apart, or more.
const LARGEST_ANGLE: f64 = 1e15;

/// Notes every number that makes no sense.
pub(crate) fn check(draft: &mut Draft) {
    let parameters = draft.model.parameters.clone();
    // A parameter without a value has been reported.
    let Ok(known) = parameters.known() else { return };
    Values { draft, known }.check();
}

/// The numbers of a study, its parameters known.
struct Values<'d> {
    draft: &'d mut Draft,
    known: Known<'d>,
}

impl Values<'_> {
    fn check(&mut self) {
        self.check_angles();
        self.check_shown();
        let Some(until) = self.value("until", self.draft.until.clone()) else { return };
        if until <= 0.0 {
            let message = format!("the run ends at {until} s: it starts at 0 and must end later");
            return self.note(Code::Value, "until", message, "must be positive");
        }
        self.check_samples(until);
        for plot in self.draft.plots.clone() {
            let ends = plot.during.iter().flatten().map(|end| end.time.clone());
            self.check_window(&format!("during of the plot `{}`", plot.name), ends.collect(), until);
        }
        for sheet in self.draft.free_bodies.clone() {
            for (at, _) in &sheet.at {
                self.check_time(&format!("free body `{}`", sheet.name), at, until);
            }
        }
        for question in self.draft.finds.clone() {
            self.check_question(&question, until);
        }
        for check in self.draft.checks.clone() {
            self.check_claim(&check, until);
        }
    }

    /// The value of a formula of the parameters; `None` where it is not finite, which is noted.
    fn value(&mut self, what: &str, formula: Option<Expr>) -> Option<f64> {
        let value = self.known.evaluate(&[formula?]).ok()?.first().copied()?;
        if value.is_finite() {
            return Some(value);
        }
        let message = format!("this is {value}, not a finite number");
        self.note(Code::NotFinite, what, message, "not a finite number");
        None
    }

    fn note(&mut self, code: Code, what: &str, message: String, label: &str) {
        let mistake: Diagnostic = self.draft.places.about(code, what, message).label(label);
        self.draft.note(mistake);
    }

    /// Parameters that are angles have digits.
    fn check_angles(&mut self) {
        let symbols = self.known.parameters().symbols();
        let values = self.known.values().to_vec();
        let of_angles = symbols.iter().zip(values).filter(|(symbol, value)| {
            let is_angle = symbol.dimension == Dimension::NONE && self.draft.angular.contains(&*symbol.name);
            is_angle && value.abs() > LARGEST_ANGLE
        });
        for (symbol, value) in of_angles.collect::<Vec<_>>() {
            let message = format!("an angle of {value:e} rad points nowhere: no digits of it are left");
            let what = format!("parameter `{}`", symbol.name);
            self.note(Code::Value, &what, message, &format!("at most {LARGEST_ANGLE:e} rad"));
        }
    }

    /// What is fixed in a formula that is looked at has a value.
    fn check_shown(&mut self) {
        let mut shown: Vec<(String, Expr)> = vec![];
        let formula = |curve: &Curve| curve.quantity.formula.clone();
        for plot in &self.draft.plots {
            let curves = plot.x.iter().map(|x| ("x", x)).chain(plot.y.iter().map(|y| ("y", y)));
            shown.extend(
                curves.map(|(key, curve)| (format!("{key} of the plot `{}`", plot.name), formula(curve))),
            );
        }
        let claims = self.draft.checks.iter().map(|check| &check.question);
        for question in self.draft.finds.iter().chain(claims) {
            shown.push((format!("that of {}", question.title), formula(&question.that)));
        }
        let named = shown.iter().map(|(what, formula)| (what.as_str(), formula));
        for mistake in self.known.mistakes_of(named) {
            let mistake = self.draft.places.mistake(&mistake);
            self.draft.note(mistake);
        }
    }

    fn check_samples(&mut self, until: f64) {
        let outputs = self.draft.output_every.iter().map(|every| ("output".to_owned(), every.clone()));
        let pictures = self.draft.stroboscopes.iter();
        let pictures = pictures.map(|s| (format!("stroboscope `{}`", s.name), s.every.clone()));
        for (what, every) in outputs.chain(pictures).collect::<Vec<_>>() {
            self.check_distance(&what, every, until);
        }
    }

    /// Whether a setting from the command line may be why the run ends before something that the scene looks at: that is
    /// then not reached, which is no mistake of the scene.
    fn may_end_early(&self) -> bool {
        !self.draft.settings.is_empty()
    }

    fn check_distance(&mut self, what: &str, every: Expr, until: f64) {
        let Some(every) = self.value(what, Some(every)) else { return };
        if every <= 0.0 {
            self.note(
                Code::Value,
                what,
                format!("every {every} s: this must be positive"),
                "must be positive",
            );
        } else if every > until && !self.may_end_early() {
            let message = format!("every {every} s is longer than the run, which lasts {until} s");
            self.note(Code::OutsideRun, what, message, "longer than the run");
        } else if until / every > MAX_SAMPLES {
            let samples = until / every;
            let message =
                format!("every {every} s makes about {samples:.0e} samples, more than {MAX_SAMPLES:.0e}");
            self.note(Code::TooMany, what, message, &format!("the run lasts {until} s"));
        }
    }

    fn check_question(&mut self, question: &Question, until: f64) {
        let title = &question.title;
        match &question.at {
            When::End => {}
            When::At(at) => self.check_time(&format!("at of {title}"), at, until),
            When::Extreme { during, .. } => {
                let ends = during.iter().flatten().map(|end| end.time.clone()).collect();
                self.check_window(&format!("during of {title}"), ends, until);
            }
        }
    }

    fn check_claim(&mut self, check: &Check, until: f64) {
        let name = &check.question.name;
        self.check_question(&check.question, until);
        self.value(&format!("equals of `{name}`"), Some(check.equals.clone()));
        let what = format!("within of `{name}`");
        let Some(within) = self.value(&what, Some(check.within.clone())) else { return };
        if within < 0.0 {
            let message = format!("a difference cannot be within {within}: this must not be negative");
            self.note(Code::Value, &what, message, "must not be negative");
        }
    }

    /// A time that only the run knows is looked at when it is known.
    fn check_time(&mut self, what: &str, at: &Instant, until: f64) {
        let Some(at) = self.value(what, Some(at.time.clone())) else { return };
        let is_later = at > until && !self.may_end_early();
        if at < 0.0 || is_later {
            let message = format!("{at} s is outside of the run, which lasts from 0 to {until} s");
            self.note(Code::OutsideRun, what, message, "outside of the run");
        }
    }

    /// The ends of a span of time, as far as they are known before the run.
    fn check_window(&mut self, what: &str, ends: Vec<Expr>, until: f64) {
        let ends: Option<Vec<f64>> = ends.into_iter().map(|end| self.value(what, Some(end))).collect();
        let Some([from, to]) = ends.as_deref() else { return };
        if from >= to {
            let message = format!("there is nothing from {from} s to {to} s");
            self.note(Code::Window, what, message, "ends before it begins");
        } else if *to <= 0.0 || (*from >= until && !self.may_end_early()) {
            let message =
                format!("{from} s to {to} s is outside of the run, which lasts from 0 to {until} s");
            self.note(Code::OutsideRun, what, message, "outside of the run");
        }
    }
}
