//! Rest: where bodies have come to hold still for good.
//!
//! What comes to rest does so at an instant: an impact, the end of a Zeno sequence or a joint takes the last of its motion. What a
//! damper slows down comes nearer to rest and never is.

use tumble_expr::Expr;
use tumble_ode::{Crossing, Reason, Side};

use crate::contact::ContactMode;
use crate::coordinates::Measure;
use crate::equations::Equations;
use crate::mode::Mode;
use crate::parameters::time_symbol;
use crate::record::{Happening, Jump};
use crate::run::{Run, RunError};

/// Of the largest speed there was: what impacts leave of a speed that they take is rounding, and ten to a hundred times less.
const STILL: f64 = 1e-12;

impl Equations {
    /// Tells of an instant that leaves the bodies at rest for good, if the model says so; ends the motion where they are all.
    pub(crate) fn rest(&self, at: &Crossing<'_, Mode>, jump: &mut Jump<Mode>) -> Result<(), Reason> {
        // What is at rest from the start has no motion to be ended.
        if self.model().stops_at_rest && at.time > 0.0 && jump.wake.is_none() && self.is_at_rest(at, jump)? {
            jump.record.happened.push(Happening::Rest);
            jump.stop = jump.mode.bodies.len() == self.model().bodies.len();
        }
        Ok(())
    }

    /// Whether the bodies of a motion are at rest for good at the instant that it has come to.
    pub(crate) fn are_at_rest(&self, at: &Crossing<'_, Mode>) -> bool {
        let jump = Jump::to(at.mode.clone(), at.states.to_vec());
        self.is_at_rest(at, &jump).unwrap_or(false)
    }

    fn is_at_rest(&self, at: &Crossing<'_, Mode>, jump: &Jump<Mode>) -> Result<bool, Reason> {
        let mode = &jump.mode;
        let bodies = || mode.bodies.iter().copied();
        if self.is_settling(mode, None) || bodies().any(|body| self.moves(body, at, jump)) {
            return Ok(false);
        }
        let is_small = |rates: &[f64], span: f64| {
            let measures = [Measure::Speed, Measure::Speed, Measure::AngularRate].into_iter().cycle();
            rates
                .iter()
                .zip(measures)
                .all(|(rate, measure)| rate.abs() * span <= STILL * at.scales[measure as usize])
        };
        let values = |formulas: Vec<Expr>| self.values(&formulas, mode, at.time, &jump.states, at.inputs);
        let velocities = values(bodies().flat_map(|body| self.velocity_formulas(body)).collect())?;
        if !is_small(&velocities, 1.0) {
            return Ok(false);
        }
        let accelerations = bodies().flat_map(|body| {
            let motion = self.model().bodies[body].kinematics();
            motion.acceleration().components().iter().cloned().chain([motion.alpha()]).collect::<Vec<_>>()
        });
        // As long again as the motion has lasted they must not make a speed that would be one.
        Ok(is_small(&values(accelerations.collect())?, at.time) && self.stays(at, jump)?)
    }

    /// Whether impacts too small to follow go on, of a body or of any.
    pub(crate) fn is_settling(&self, mode: &Mode, body: Option<usize>) -> bool {
        let settling =
            mode.contacts.iter().filter(|(_, contact_mode)| *contact_mode == ContactMode::Settling);
        let mut bodies = settling.flat_map(|(pair, _)| self.pairs()[*pair].bodies());
        bodies.any(|own| body.is_none_or(|body| body == own))
    }

    /// Whether one of the velocities that are states is one, of a body.
    fn moves(&self, body: usize, at: &Crossing<'_, Mode>, jump: &Jump<Mode>) -> bool {
        let states = self.velocity_states(&jump.mode, body).into_iter();
        let mut velocities = states.zip(self.coordinate_measures(body));
        velocities.any(|(state, of)| jump.states[state].abs() > STILL * at.scales[of.rate() as usize])
    }

    fn velocity_formulas(&self, body: usize) -> Vec<Expr> {
        let motion = self.model().bodies[body].kinematics();
        motion.velocity().components().iter().cloned().chain([motion.omega()]).collect()
    }

    /// Whether nothing that depends on the time can end the rest.
    fn stays(&self, at: &Crossing<'_, Mode>, jump: &Jump<Mode>) -> Result<bool, Reason> {
        let times = self.scheduled_times(&jump.mode);
        let times = self.values(&times, &jump.mode, at.time, &jump.states, at.inputs)?;
        if times.iter().any(|time| *time > at.time) {
            return Ok(false);
        }
        let flow = tumble_ode::Hybrid::flow(self, &jump.mode)?;
        let rates = flow.states.iter().map(|state| &state.rate);
        let guards = flow.guards.iter().map(|guard| &guard.formula);
        let mut formulas = rates.chain(guards).chain(flow.lazy_guards.iter().map(|lazy| lazy.of.formula()));
        let t = time_symbol();
        Ok(!formulas.any(|formula| formula.symbols().contains(&t)))
    }
}

impl Run {
    /// When a body has come to rest, s: the first instant from which on it holds still, as far as the motion goes. `None` where it
    /// moves to the end, or only comes ever nearer to rest.
    pub fn rest_of(&self, body: usize) -> Result<Option<f64>, RunError> {
        let ends_at_rest =
            self.events().next_back().is_some_and(|event| event.record.happened.contains(&Happening::Rest));
        let part = self.of_body(body);
        let trajectory = part.trajectory();
        let mut observer = self.observe(&self.equations.velocity_formulas(body))?;
        let scales = [Measure::Speed, Measure::Speed, Measure::AngularRate];
        let scales = scales.map(|measure| trajectory.scales[measure as usize]);
        let mut is_still = |time: f64, side: Side| {
            let rates = observer.at(time, side).unwrap_or_default();
            rates.iter().zip(scales).all(|(rate, scale)| rate.abs() <= STILL * scale)
        };
        let mut first = ends_at_rest.then(|| trajectory.end()).flatten();
        for piece in trajectory.pieces.iter().rev() {
            let middle = (piece.start + piece.end) / 2.0;
            let places = [(piece.start, Side::After), (middle, Side::After), (piece.end, Side::Before)];
            let is_settling = self.equations.is_settling(&trajectory.modes[piece.mode], Some(body));
            if is_settling || !places.into_iter().all(|(time, side)| is_still(time, side)) {
                break;
            }
            first = Some(piece.start);
        }
        let is_instant = |time: &f64| {
            trajectory.start() == Some(*time) || trajectory.events.iter().any(|event| event.time == *time)
        };
        Ok(first.filter(is_instant))
    }

    /// When all bodies have come to rest, s.
    pub fn rest(&self) -> Result<Option<f64>, RunError> {
        let bodies = 0..self.equations.model().bodies.len();
        let each = bodies.map(|body| self.rest_of(body)).collect::<Result<Vec<_>, _>>()?;
        Ok(each.into_iter().try_fold(0.0, |latest: f64, time| Some(latest.max(time?))))
    }
}
