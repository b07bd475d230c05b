//! Events whose formula jumps across zero: an impact turns a velocity round, a floor begins to push.
//!
//! Between jumps the integrator locates the crossings. At a jump there is nothing to locate: a formula that is on one side
//! of zero before and on the other after it has crossed then.

use tumble_expr::Expr;
use tumble_ode::{Cause, Crossing, Direction, Reason};

use crate::equations::Equations;
use crate::mode::Mode;
use crate::record::Jump;

/// A value this much smaller than it was, or will be, is what rounding has left of zero: there is no crossing.
const VANISHED: f64 = 1e-12;

impl Equations {
    /// Events that a jump makes happen, by index, beside those that have caused it.
    pub(crate) fn carried_across(
        &self,
        at: &Crossing<'_, Mode>,
        jump: &Jump<Mode>,
    ) -> Result<Vec<usize>, Reason> {
        let (events, all) = (self.events(at.mode), &self.model().events);
        if events.is_empty() || (jump.mode == *at.mode && jump.states == at.states) {
            return Ok(vec![]);
        }
        let formulas: Vec<Expr> = events.iter().map(|event| all[*event].when.clone()).collect();
        let before = self.values(&formulas, at.mode, at.time, at.states, at.inputs)?;
        let after = self.values(&formulas, &jump.mode, at.time, &jump.states, at.inputs)?;
        let crosses = |(guard, event): &(usize, usize)| {
            let is_cause = at.causes.contains(&Cause::Guard(*guard));
            !is_cause && is_crossing(before[*guard], after[*guard], all[*event].direction)
        };
        Ok(events.into_iter().enumerate().filter(crosses).map(|(_, event)| event).collect())
    }
}

/// Whether a function that jumps between these values crosses zero in a direction.
pub(crate) fn is_crossing(from: f64, to: f64, direction: Direction) -> bool {
    let is_told = from.abs() > VANISHED * to.abs() && to.abs() > VANISHED * from.abs();
    from.signum() != to.signum() && is_told && direction.allows(to)
}
