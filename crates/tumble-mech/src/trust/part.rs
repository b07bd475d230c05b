//! One motion with its check runs: how large its errors become, and how far they are known.

use tumble_expr::Expr;
use tumble_ode::{Cause, Motion, Occurrence, Side};

use crate::balance::RunBalance;
use crate::coordinates::Measure;
use crate::equations::Equations;
use crate::record::Record;
use crate::run::{Run, RunError};
use crate::trust::check_run::CheckRun;
use crate::trust::errors::{Errors, Row, larger};
use crate::trust::own::Own;
use crate::trust::{Divergence, Horizon, SAFETY, ULPS};

/// An error of this part of the scale leaves not one digit.
const LOST: f64 = 0.1;

/// What check runs say of one motion.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) run: Run,
    pub(super) checks: Vec<CheckRun>,
    /// Errors of places, angles and their rates, six a body, with the places of their bodies among those of the motion.
    states: Vec<(Vec<usize>, Errors)>,
    /// See [`super::Trust::reached`].
    pub(super) reached: f64,
    /// Where its digits end.
    pub(super) horizon: Option<Horizon>,
    /// Where the check runs cannot be compared with it any more, s.
    compared_until: f64,
}

impl Part {
    /// Of a motion, by the check runs that it is a part of.
    pub(super) fn of(run: Run, checks: &[(Run, f64)]) -> Result<Self, RunError> {
        let mut part = Self::beside(run, checks);
        let horizons = part.checks.iter().filter_map(|check| check.phases.divergence.clone());
        part.horizon = horizons.min_by(|a, b| a.time.total_cmp(&b.time));
        let states = part.errors(&kinematics(&part.run))?;
        part.measure(&states);
        part.states = vec![((0..part.run.bodies().len()).collect(), states)];
        Ok(part)
    }

    /// Of several motions as one, of which it is known how far each can be trusted.
    pub(super) fn joined(run: Run, checks: &[(Run, f64)], parts: &[&Self]) -> Result<Self, RunError> {
        let mut joined = Self::beside(run, checks);
        let bodies = joined.run.bodies();
        let places = |part: &Self| {
            part.run.bodies().into_iter().map(|body| bodies.partition_point(|known| *known < body))
        };
        let own = |part: &&Self| {
            part.states.iter().map(|(_, errors)| (places(part).collect(), errors.clone())).collect::<Vec<_>>()
        };
        joined.states = parts.iter().flat_map(own).collect();
        joined.reached = parts.iter().map(|part| part.reached).fold(0.0, f64::max);
        let horizons = parts.iter().filter_map(|part| part.horizon.clone());
        joined.horizon = horizons.min_by(|a, b| a.time.total_cmp(&b.time));
        Ok(joined)
    }

    fn beside(run: Run, checks: &[(Run, f64)]) -> Self {
        let groups = run.all_tracks().groups.clone();
        let beside = |(check, safety): &(Run, f64)| CheckRun::new(&run, check.part(&groups), *safety);
        let checks: Vec<CheckRun> = checks.iter().map(beside).collect();
        let ends = checks.iter().filter_map(|check| check.phases.divergence.as_ref());
        let compared_until = ends.map(|horizon| horizon.time).fold(f64::INFINITY, f64::min);
        Self { run, checks, states: vec![], reached: 0.0, horizon: None, compared_until }
    }

    /// Finds how large the errors of the states become, and when they are lost. What rounding errors of the rates may have
    /// done is no motion, and its digits are not counted; nor are those of impacts, which pass with them.
    fn measure(&mut self, states: &Errors) {
        let motion = self.run.motion();
        let scales = scales(&motion, states);
        let rounding = MEASURES.map(|measure| {
            let floor = motion.rounding.get(measure as usize).copied().unwrap_or(0.0);
            SAFETY * ULPS * floor
        });
        for Row { time, errors, .. } in states.rows().filter(|row| !row.passes) {
            // What is no number counts, and rounding only where the scale is more than that: what rests has no digits to lose.
            let is_motion = |index: usize, error: f64| {
                let (rounding, scale) = (rounding[index % MEASURES.len()], scales[index % MEASURES.len()]);
                error.is_nan() || error > rounding || rounding < LOST * scale
            };
            let counted = errors.iter().enumerate().filter(|(index, error)| is_motion(*index, **error));
            let relative = counted.map(|(index, error)| error / scales[index % MEASURES.len()]);
            let worst = relative.fold(0.0, larger);
            if worst.is_nan() || worst >= LOST {
                self.horizon = Some(Horizon { time, reason: Divergence::Grown });
                break;
            }
            self.reached = self.reached.max(worst);
        }
    }

    /// Errors of formulas of the motion along it.
    pub(super) fn errors(&self, formulas: &[Expr]) -> Result<Errors, RunError> {
        Errors::of(&self.run, &self.checks, self.compared_end(), formulas)
    }

    /// Errors of places, angles and their rates at a time, by [`kinematics`]; `None` where nothing can be said of them.
    pub(super) fn states_at(&self, time: f64) -> Option<Vec<f64>> {
        let mut all = vec![0.0; kinematics(&self.run).len()];
        for (bodies, errors) in &self.states {
            let errors = errors.at(time)?;
            for (body, own) in bodies.iter().zip(errors.chunks_exact(MEASURES.len())) {
                all[body * MEASURES.len()..][..MEASURES.len()].copy_from_slice(own);
            }
        }
        Some(all)
    }

    /// Time up to which something can be said, s; infinite where that is the whole motion.
    pub(super) fn end(&self) -> f64 {
        self.horizon.as_ref().map_or(f64::INFINITY, |horizon| horizon.time)
    }

    /// Time up to which check runs can be compared with it besides, s: where events of several motions fall together, which of them
    /// comes first is not the same in all.
    pub(super) fn compared_end(&self) -> f64 {
        self.end().min(self.compared_until)
    }

    /// Whether anything happens to its bodies at a time, s.
    pub(super) fn has_event(&self, time: f64) -> bool {
        let motion = self.run.motion();
        let mut events = events_at(&motion, time).peekable();
        events.peek().is_some() && {
            let own = Own::of(&self.run);
            events.any(|event| own.has(&motion, event))
        }
    }

    /// What the check runs are off by in the time of an event, s; `None` where nothing can be said of it.
    pub(super) fn event_error(&self, time: f64) -> Option<f64> {
        let mut off = self.checks.iter().map(|check| Some(check.safety * check.phases.off(time)?));
        let off = off.try_fold(0.0, |worst: f64, off: Option<f64>| Some(worst.max(off?)))?;
        (time <= self.end()).then_some(off)
    }

    /// By how much the works of the contributions of this motion's balance are off by its check runs, with their safety; `None` where
    /// nothing can be said of them.
    pub(super) fn work_differences(
        &self,
        balance: &RunBalance,
        works: &[f64],
        at: (f64, Side),
    ) -> Result<Option<Vec<f64>>, RunError> {
        if at.0 > self.end() {
            return Ok(None);
        }
        let mut worst = vec![0.0; works.len()];
        for check in &self.checks {
            let Some(differences) = check.work_differences(balance, works, at)? else { return Ok(None) };
            for (worst, difference) in worst.iter_mut().zip(differences) {
                *worst = larger(*worst, check.safety * difference);
            }
        }
        Ok(Some(worst))
    }
}

/// The events of one time.
pub(super) fn events_at(motion: &Motion<Equations>, time: f64) -> impl Iterator<Item = &Occurrence<Record>> {
    let first = motion.events.partition_point(|event| event.time < time);
    motion.events[first..].iter().take_while(move |event| event.time == time)
}

/// See [`super::Trust::event_blur`].
pub(super) fn event_blur(motion: &Motion<Equations>, time: f64) -> f64 {
    events_at(motion, time).map(|event| event.blur).fold(ULPS * f64::EPSILON * time, f64::max)
}

/// See [`super::Trust::instant_blur`].
pub(super) fn instant_blur(motion: &Motion<Equations>, time: f64) -> f64 {
    let is_located = |cause: &Cause| matches!(cause, Cause::Guard(_) | Cause::LazyGuard(_));
    let mut here = events_at(motion, time).peekable();
    let is_found = here.peek().is_some() && here.all(|event| event.causes.iter().all(is_located));
    match motion.piece_at(time, Side::Before) {
        Some(piece) if is_found && piece.end == time && piece.time_series.is_none() => {
            let blurs = events_at(motion, time).map(|event| event.blur);
            blurs.fold(ULPS * f64::EPSILON * piece.length, f64::max)
        }
        _ => event_blur(motion, time),
    }
}

/// What [`kinematics`] are measured in.
const MEASURES: [Measure; 6] =
    [Measure::Length, Measure::Length, Measure::Angle, Measure::Speed, Measure::Speed, Measure::AngularRate];

/// What their errors are relative to: the scales of the states, and at least the largest value of their kind.
fn scales(motion: &Motion<Equations>, errors: &Errors) -> [f64; MEASURES.len()] {
    MEASURES.map(|measure| {
        let values = errors.largest().iter().enumerate();
        let same = values.filter(|(index, _)| MEASURES[index % MEASURES.len()] == measure);
        same.map(|(_, value)| *value).fold(motion.scales[measure as usize], f64::max)
    })
}

/// Place, angle and their rates of every body of a motion, six each.
pub(super) fn kinematics(run: &Run) -> Vec<Expr> {
    let of = |body: usize| {
        let kinematics = run.equations.model().bodies[body].kinematics();
        let (at, velocity) = (kinematics.position(), kinematics.velocity());
        [
            at.x().clone(),
            at.y().clone(),
            kinematics.angle(),
            velocity.x().clone(),
            velocity.y().clone(),
            kinematics.omega(),
        ]
    };
    run.bodies().into_iter().flat_map(of).collect()
}
