//! Numbers of a study that must make sense: the end of the run, distances of samples, times of checks.

use tumble_expr::Expr;

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::draft::Draft;
use crate::study::{Instant, Question, When};

/// More samples than this are a slip of the unit.
const MAX_SAMPLES: f64 = 1e6;

/// Numbers near a larger angle, rad, are more than 1e-7 apart, so that its sine has lost half its digits.
const LARGEST_ANGLE: f64 = 1e9;

/// Notes every number that makes no sense.
pub(crate) fn check(draft: &mut Draft) {
    let Some(until) = value(draft, "until", draft.until.clone()) else { return };
    if until <= 0.0 {
        let message = format!("the run ends at {until} s: it starts at 0 and must end later");
        return note(draft, Code::Value, "until", message, "must be positive");
    }
    let outputs = draft.output_every.clone().map(|every| ("output".to_owned(), every));
    let pictures = draft.stroboscopes.iter().map(|s| (format!("stroboscope `{}`", s.name), s.every.clone()));
    let distances: Vec<_> = outputs.into_iter().chain(pictures).collect();
    for (what, every) in distances {
        check_distance(draft, &what, every, until);
    }
    for plot in draft.plots.clone() {
        let ends = plot.during.iter().flatten().map(|end| end.time.clone());
        check_window(draft, &format!("during of `{}`", plot.name), ends.collect(), until);
    }
    for (body, start) in draft.model.starts.clone() {
        check_angle(draft, &format!("start of `{body}`"), start.angle);
    }
    for sheet in draft.free_bodies.clone() {
        for (at, _) in &sheet.at {
            check_time(draft, &format!("free body `{}`", sheet.name), at, until);
        }
    }
    for question in draft.finds.clone() {
        check_question(draft, &question, until);
    }
    for check in draft.checks.clone() {
        let name = &check.question.name;
        check_question(draft, &check.question, until);
        value(draft, &format!("equals of `{name}`"), Some(check.equals));
        check_margin(draft, &format!("within of `{name}`"), check.within);
    }
}

/// The value of a formula of the parameters; `None` where it is not finite, which is noted.
fn value(draft: &mut Draft, what: &str, formula: Option<Expr>) -> Option<f64> {
    let value = draft.model.parameters.evaluate(&[formula?]).ok()?.first().copied()?;
    if value.is_finite() {
        return Some(value);
    }
    note(
        draft,
        Code::NotFinite,
        what,
        format!("this is {value}, not a finite number"),
        "not a finite number",
    );
    None
}

fn note(draft: &mut Draft, code: Code, what: &str, message: String, label: &str) {
    let span = draft.places.get(what).cloned();
    let mistake = Diagnostic::new(code, span.clone().unwrap_or(0..0), message).label(label);
    draft.note(if span.is_some() { mistake } else { mistake.nowhere() });
}

/// Whether a setting from the command line may be why the run ends before something that the scene looks at: that is
/// then not reached, which is no mistake of the scene.
fn may_end_early(draft: &Draft) -> bool {
    !draft.settings.is_empty()
}

fn check_distance(draft: &mut Draft, what: &str, every: Expr, until: f64) {
    let Some(every) = value(draft, what, Some(every)) else { return };
    if every <= 0.0 {
        note(draft, Code::Value, what, format!("every {every} s: this must be positive"), "must be positive");
    } else if every > until && !may_end_early(draft) {
        let message = format!("every {every} s is longer than the run, which lasts {until} s");
        note(draft, Code::OutsideRun, what, message, "longer than the run");
    } else if until / every > MAX_SAMPLES {
        let message =
            format!("every {every} s makes about {:.0e} samples, more than {MAX_SAMPLES:.0e}", until / every);
        note(draft, Code::TooMany, what, message, &format!("the run lasts {until} s"));
    }
}

fn check_question(draft: &mut Draft, question: &Question, until: f64) {
    let name = &question.name;
    match &question.at {
        When::End => {}
        When::At(at) => check_time(draft, &format!("at of `{name}`"), at, until),
        When::Extreme { during, .. } => {
            let ends = during.iter().flatten().map(|end| end.time.clone()).collect();
            check_window(draft, &format!("during of `{name}`"), ends, until);
        }
    }
}

/// A time that only the run knows is looked at when it is known.
fn check_time(draft: &mut Draft, what: &str, at: &Instant, until: f64) {
    let Some(at) = value(draft, what, Some(at.time.clone())) else { return };
    let is_later = at > until && !may_end_early(draft);
    if at < 0.0 || is_later {
        let message = format!("{at} s is outside of the run, which lasts from 0 to {until} s");
        note(draft, Code::OutsideRun, what, message, "outside of the run");
    }
}

/// The ends of a span of time, as far as they are known before the run.
fn check_window(draft: &mut Draft, what: &str, ends: Vec<Expr>, until: f64) {
    let ends: Option<Vec<f64>> = ends.into_iter().map(|end| value(draft, what, Some(end))).collect();
    let Some([from, to]) = ends.as_deref() else { return };
    if from >= to {
        let message = format!("there is nothing from {from} s to {to} s");
        note(draft, Code::Window, what, message, "ends before it begins");
    } else if *to <= 0.0 || (*from >= until && !may_end_early(draft)) {
        let message = format!("{from} s to {to} s is outside of the run, which lasts from 0 to {until} s");
        note(draft, Code::OutsideRun, what, message, "outside of the run");
    }
}

fn check_angle(draft: &mut Draft, what: &str, angle: Option<Expr>) {
    let Some(angle) = value(draft, what, angle) else { return };
    if angle.abs() > LARGEST_ANGLE {
        let message =
            format!("an angle of {angle:e} rad points nowhere: numbers of that size are too far apart");
        note(draft, Code::Value, what, message, &format!("at most {LARGEST_ANGLE:e} rad"));
    }
}

fn check_margin(draft: &mut Draft, what: &str, within: Expr) {
    let Some(within) = value(draft, what, Some(within)) else { return };
    if within < 0.0 {
        let message = format!("a difference cannot be within {within}: this must not be negative");
        note(draft, Code::Value, what, message, "must not be negative");
    }
}
