//! One body in one run, as findings look at it.

use std::collections::BTreeSet;

use tumble_expr::Expr;
use tumble_mech::{Anchor, At, Body, Force, Forces, Joint, Law, Observer, Run, joined};
use tumble_ode::Side;
use tumble_scene::Study;

use super::said::with_digits;
use crate::figures::symbols;
use crate::report::Text;
use crate::results::{Case, CaseError, digits, equal_times};

/// Instants at which the motion is looked at.
const SAMPLES: usize = 4000;
/// Instants at which its forces are.
const FORCE_SAMPLES: usize = 40;
/// Halvings that locate an instant between two samples to the last digit.
const HALVINGS: usize = 60;
/// Part of the run over which a rate is taken to tell the error of an instant.
const RATE_STEP: f64 = 1e-6;

/// One body in one run.
pub(super) struct Seen<'a> {
    /// With the parameters of the run.
    pub(super) study: &'a Study,
    pub(super) case: &'a Case,
    pub(super) run: &'a Run,
    pub(super) body: &'a Body,
    /// Its place among the model's.
    pub(super) index: usize,
}

impl Seen<'_> {
    pub(super) fn end(&self) -> f64 {
        self.run.end().unwrap_or(0.0)
    }

    pub(super) fn values(&self, formula: &Expr) -> Result<Vec<(f64, f64)>, CaseError> {
        let mut observer = self.run.observe(std::slice::from_ref(formula))?;
        Ok(equal_times(self.run, SAMPLES)
            .filter_map(|time| Some((time, observer.at(time, Side::After)?[0])))
            .collect())
    }

    /// Instants at which a smooth quantity passes zero downwards.
    pub(super) fn falls_through_zero(&self, formula: &Expr) -> Result<Vec<f64>, CaseError> {
        let values = self.values(formula)?;
        let mut observer = self.run.observe(std::slice::from_ref(formula))?;
        let jumps = self.jumps(&mut observer);
        let mut found = vec![];
        for pair in values.windows(2) {
            let ((mut low, before), (mut high, after)) = (pair[0], pair[1]);
            // A jump is no passing.
            let jumps = jumps.iter().any(|event| low <= *event && *event <= high);
            if jumps || !(before > 0.0 && after <= 0.0) {
                continue;
            }
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                let positive = observer.at(middle, Side::After).is_some_and(|values| values[0] > 0.0);
                *(if positive { &mut low } else { &mut high }) = middle;
            }
            found.push(high);
        }
        Ok(found)
    }

    /// Events at which a quantity is not continuous.
    fn jumps(&self, observer: &mut Observer) -> Vec<f64> {
        let events = self.run.events().enumerate();
        let jumps = events.filter(|(index, _)| observer.at_event(*index).is_some_and(|[a, b]| a != b));
        jumps.map(|(_, event)| event.time).collect()
    }

    pub(super) fn at(&self, time: f64, formula: &Expr) -> Result<f64, CaseError> {
        let values = self.run.observe(std::slice::from_ref(formula))?.at(time, Side::After);
        Ok(values.map_or(f64::NAN, |values| values[0]))
    }

    pub(super) fn error(&self, time: f64, formula: &Expr) -> Result<Option<f64>, CaseError> {
        let off = self.case.trust.as_ref().and_then(|trust| trust.event_error(&self.case.run, time));
        digits::error(self.case.solution(), formula, At { time, side: Side::After, off: off.unwrap_or(0.0) })
    }

    /// A value with its digits.
    pub(super) fn known(&self, time: f64, formula: &Expr, unit: &str) -> Result<Text, CaseError> {
        self.known_in(time, formula, (unit, |value| value))
    }

    /// The same in another unit.
    pub(super) fn known_in(
        &self,
        time: f64,
        formula: &Expr,
        (unit, to): (&str, fn(f64) -> f64),
    ) -> Result<Text, CaseError> {
        Ok(with_digits(to(self.at(time, formula)?), self.error(time, formula)?.map(to), unit))
    }

    /// An instant at which a quantity is zero, with its digits.
    pub(super) fn instant(&self, time: f64, formula: &Expr) -> Result<Text, CaseError> {
        Ok(with_digits(time, self.error_of_instant(time, formula)?, "s"))
    }

    /// The error of an instant at which a quantity is zero: that of the quantity over its rate.
    pub(super) fn error_of_instant(&self, time: f64, formula: &Expr) -> Result<Option<f64>, CaseError> {
        let step = self.end() * RATE_STEP;
        let (before, after) = ((time - step).max(0.0), (time + step).min(self.end()));
        let rate = (self.at(after, formula)? - self.at(before, formula)?) / (after - before);
        let rounding = time * f64::EPSILON;
        Ok(self.error(time, formula)?.map(|error| (error / rate).abs() + rounding))
    }

    pub(super) fn name(&self) -> &str {
        &self.body.name
    }

    /// Its name in a sentence.
    pub(super) fn called(&self) -> String {
        symbols::the(self.name())
    }

    /// What one of its quantities is shown as.
    pub(super) fn symbol(&self, quantity: &str) -> Text {
        symbols::label(&symbols::all(self.study), &format!("{}.{quantity}", self.name())).into()
    }

    /// The time of an event, s, with its digits.
    pub(super) fn event_time(&self, time: f64) -> Text {
        let error = self.case.trust.as_ref().and_then(|trust| trust.event_error(&self.case.run, time));
        with_digits(time, error, "s")
    }

    /// When its motion ceases to be smooth for the first time, or ends.
    pub(super) fn first_jump(&self) -> Result<f64, CaseError> {
        let motion = self.body.kinematics();
        let velocity = motion.velocity();
        let formulas = [velocity.x().clone(), velocity.y().clone(), motion.omega()];
        let mut observer = self.run.observe(&formulas)?;
        let touches = self.contacts().first().map_or(f64::INFINITY, |contact| contact.start);
        let jumps = self.jumps(&mut observer).into_iter().fold(f64::INFINITY, f64::min);
        Ok(touches.min(jumps).min(self.end()))
    }

    /// Whether a joint holds it from the start.
    pub(super) fn is_jointed(&self) -> bool {
        let holds = |joint: &&Joint| joint.from.is_none();
        let own = self.body.kinematics().angle_symbol();
        let is_own =
            |end: &Anchor| matches!(end, Anchor::Material(point) if point.body.angle_symbol() == own);
        self.study.model.joints.iter().filter(holds).any(|joint| joint.ends.iter().any(is_own))
    }

    /// Its contacts with any surface.
    pub(super) fn contacts(&self) -> Vec<tumble_mech::Contact> {
        let pairs = self.run.equations.pairs();
        let is_own =
            |contact: &tumble_mech::Contact| pairs[contact.pair].name.split('.').nth(1) == Some(self.name());
        self.run.contacts().into_iter().filter(is_own).collect()
    }

    /// The forces on it at an instant, one of each load.
    pub(super) fn forces(&self, time: f64, side: Side) -> Result<Vec<Force>, CaseError> {
        let all = joined(&Forces::of(self.run).at(time, side)?);
        Ok(all.into_iter().filter(|force| force.body == self.index).collect())
    }

    /// Whether impacts of it follow each other ever faster.
    pub(super) fn bounces_without_end(&self) -> bool {
        let pairs = self.run.equations.pairs();
        let mut sequences = self.run.events().flat_map(|event| event.record.zeno_sequences());
        sequences.any(|pair| pairs[pair].bodies().any(|body| body == self.index))
    }

    /// The laws of the forces on it from the start to a time, s.
    pub(super) fn laws(&self, until: f64) -> Result<BTreeSet<&'static str>, CaseError> {
        let mut found = BTreeSet::new();
        let mut forces = Forces::of(self.run);
        for sample in 0..FORCE_SAMPLES {
            let time = until * (sample as f64 + 0.5) / FORCE_SAMPLES as f64;
            let all = forces.at(time, Side::Before)?;
            let acting =
                |force: &&Force| force.body == self.index && (force.force != [0.0; 2] || force.couple != 0.0);
            found.extend(all.iter().filter(acting).map(|force| kind(force.law)));
        }
        Ok(found)
    }
}

/// Laws as findings tell them apart.
fn kind(law: Law) -> &'static str {
    match law {
        Law::Weight => "weight",
        Law::Drag | Law::Lift => "air",
        Law::Reaction => "pivot",
        _ => "other",
    }
}
