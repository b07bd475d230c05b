//! What events do to joints and velocities at an instant: joints are released, others are made, impulses are applied.
//!
//! A joint that begins to hold makes a perfectly inelastic impact: with M the masses, B the gradients of the rows that hold then and v
//! the velocities before, `M (v_after - v) = J + B^T Q` and `B v_after = b`, J the impulses that are applied and b what places that
//! are moved ask for.

use nalgebra::{DMatrix, DVector};
use tumble_ode::{Crossing, Reason};

use crate::equations::Equations;
use crate::impulse::{Impulse, Sizes};
use crate::mode::Mode;
use crate::record::{Happening, Jump};

/// Points that a joint is to keep together meet if they are this part of the sizes of the bodies apart: what accurate motions are off
/// by when the event comes.
const MEETS: f64 = 1e-9;

impl Equations {
    /// Deals with what these happenings do to joints and velocities; the sizes of the impulses.
    pub(crate) fn couple(
        &self,
        happened: &[Happening],
        at: &Crossing<'_, Mode>,
        jump: &mut Jump<Mode>,
    ) -> Result<Sizes, Reason> {
        let events = happened.iter().filter_map(|happening| match happening {
            Happening::Event(event) => Some(self.model().events[*event].name.as_str()),
            _ => None,
        });
        let events: Vec<&str> = events.collect();
        let changed = self.switch_joints(&events, &self.capturing(happened), at, jump)?;
        let impulses = self.model().impulses.iter().enumerate();
        let applied = impulses.filter(|(_, impulse)| events.contains(&impulse.when.as_str()));
        let applied = applied.map(|(index, _)| self.applied(index, at));
        let applied = applied.collect::<Result<Vec<Impulse>, Reason>>()?;
        for impulse in &applied {
            if let crate::Source::Applied(index) = impulse.source {
                jump.record.happened.push(Happening::Impulse(index));
            }
        }
        if !changed && applied.is_empty() {
            return Ok(Sizes::default());
        }
        if let Some(branches) = self.only_here(&jump.mode, at.time, &jump.states, at.inputs) {
            let what = if changed { "joints begin to hold" } else { "an impulse acts" };
            return Err(Reason::Model(format!(
                "{what} while the bodies are in a singular configuration. {branches}. Let it happen a little earlier or later, where one of \
                 them is turned"
            )));
        }
        let rows = self.push(&applied, at, jump)?;
        Ok(Sizes { rows, applied, ..Sizes::default() })
    }

    /// Releases and makes the joints that these events do, and makes those that capture; whether any now holds that did not.
    fn switch_joints(
        &self,
        events: &[&str],
        capturing: &[usize],
        at: &Crossing<'_, Mode>,
        jump: &mut Jump<Mode>,
    ) -> Result<bool, Reason> {
        let is_now = |event: &Option<String>| event.as_deref().is_some_and(|event| events.contains(&event));
        let (mut released, mut made) = (vec![], vec![]);
        for (index, joint) in self.model().joints.iter().enumerate() {
            match self.holds(&jump.mode, index) {
                true if is_now(&joint.until) => released.push(index),
                false if is_now(&joint.from) || capturing.contains(&index) => made.push(index),
                _ => {}
            }
        }
        if released.is_empty() && made.is_empty() {
            return Ok(false);
        }
        for &joint in &released {
            let seat = self.seat_states(&jump.mode, joint);
            jump.states.drain(seat);
            jump.mode.switch_joint(joint);
            jump.record.happened.push(Happening::Joint { joint, holds: false });
        }
        for &joint in &made {
            let seat = &self.joints()[joint].seat_values;
            let values = self.values(seat, &jump.mode, at.time, &jump.states, at.inputs)?;
            jump.mode.switch_joint(joint);
            let place = self.seat_states(&jump.mode, joint).start;
            jump.states.splice(place..place, values);
            jump.record.happened.push(Happening::Joint { joint, holds: true });
        }
        self.fit(&made, at, jump)?;
        Ok(!made.is_empty())
    }

    /// Refuses joints whose points do not meet, and finds which rows are redundant now.
    fn fit(&self, made: &[usize], at: &Crossing<'_, Mode>, jump: &mut Jump<Mode>) -> Result<(), Reason> {
        jump.mode.redundant.clear();
        let rows = self.rows_at(&jump.mode, at.time, &jump.states, at.inputs)?;
        for &joint in made {
            let gap = self.gap_of(&jump.mode, joint, &rows);
            let largest = at.scales.first().copied().unwrap_or(0.0);
            if gap > MEETS * largest {
                let name = &self.model().joints[joint].name;
                return Err(Reason::Model(format!(
                    "`{name}` is to hold from now on, but what it joins is {gap} m apart: let its event come where they meet, or \
                     name the second body alone, which is then joined wherever the first point is"
                )));
            }
        }
        jump.mode.redundant = rows.redundant();
        Ok(())
    }

    /// Changes the velocities by these impulses, so that all joints hold; the impulses of the joints' rows.
    fn push(
        &self,
        applied: &[Impulse],
        at: &Crossing<'_, Mode>,
        jump: &mut Jump<Mode>,
    ) -> Result<Vec<(usize, f64)>, Reason> {
        let rows = self.rows_at(&jump.mode, at.time, &jump.states, at.inputs)?.without(&jump.mode.redundant);
        let mut pushes = DVector::zeros(rows.mass.len());
        for impulse in applied {
            let first = self.velocity_states(&jump.mode, impulse.body)[0];
            let first = rows.velocities.partition_point(|velocity| *velocity < first);
            let ([rx, ry], [jx, jy]) = (impulse.arm, impulse.impulse);
            match self.pivot_arm(impulse.body) {
                None => {
                    pushes[first] += jx;
                    pushes[first + 1] += jy;
                    pushes[first + 2] += rx * jy - ry * jx + impulse.couple;
                }
                Some((_, arm)) => {
                    let arm = self.values(arm.components(), at.mode, at.time, at.states, at.inputs)?;
                    pushes[first] += (rx - arm[0]) * jy - (ry - arm[1]) * jx + impulse.couple;
                }
            }
        }
        let pushes = DMatrix::from_column_slice(pushes.len(), 1, pushes.as_slice());
        let (changes, shares) = rows.respond(&pushes).ok_or_else(|| {
            Reason::Model("no impulses of the joints were found that keep them together here".into())
        })?;
        for (state, change) in rows.velocities.iter().zip(&changes) {
            jump.states[*state] += change;
        }
        Ok(rows.indices.iter().copied().zip(shares.iter().copied()).collect())
    }

    /// Where the states of a joint's seat are.
    fn seat_states(&self, mode: &Mode, joint: usize) -> std::ops::Range<usize> {
        let bodies = self.first_state(mode, self.model().bodies.len());
        let before = (0..joint).filter(|other| self.holds(mode, *other));
        let first = bodies + before.map(|other| self.joints()[other].seat.len()).sum::<usize>();
        first..first + self.joints()[joint].seat.len()
    }
}
