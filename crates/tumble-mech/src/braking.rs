//! Which brakes hold from an instant on, and which way the others go: see [`crate::brake`].

use nalgebra::DMatrix;
use tumble_expr::Expr;
use tumble_ode::{Crossing, Reason};

use crate::brake::Brake;
use crate::contact::{BALANCED, Grip, STANDS, Watched, Way, moves};
use crate::equations::Equations;
use crate::kinematics::Kinematics;
use crate::link::RowOf;
use crate::mode::Mode;
use crate::parameters::time_symbol;
use crate::record::{Happening, Jump};

/// Braking that is beyond what it can be by less than this part is all that it can be.
const FULL: f64 = 1e-11;

/// A row follows from others if less than this part of it is its own.
const FOLLOWS: f64 = 1e-9;

/// An instant.
struct Instant<'a> {
    equations: &'a Equations,
    time: f64,
    states: &'a [f64],
    inputs: &'a [f64],
    /// Scales of the groups of states; none at the start.
    scales: &'a [f64],
}

impl Equations {
    /// Leaves all brakes to the signs of their rates: an impact may change these.
    pub(crate) fn release_brakes(&self, mode: &mut Mode) {
        mode.brakes.retain(|(_, grip)| *grip != Grip::Sticks);
    }

    /// Says which brakes hold from the start on.
    pub(crate) fn brake_at_start(
        &self,
        mode: &mut Mode,
        states: &mut [f64],
        inputs: &[f64],
    ) -> Result<(), Reason> {
        if self.brakes().is_empty() {
            return Ok(());
        }
        let known = states.to_vec();
        let now = Instant { equations: self, time: 0.0, states: &known, inputs, scales: &[] };
        *mode = now.choose(mode, &[])?;
        now.stop(mode, states)
    }

    /// Says which brakes hold from now on; `told` is what was seen of them.
    pub(crate) fn brake(
        &self,
        at: &Crossing<'_, Mode>,
        told: &[(usize, Watched)],
        jump: &mut Jump<Mode>,
    ) -> Result<(), Reason> {
        if self.brakes().is_empty() {
            return Ok(());
        }
        let states = jump.states.clone();
        let now =
            Instant { equations: self, time: at.time, states: &states, inputs: at.inputs, scales: at.scales };
        let chosen = now.choose(&jump.mode, told)?;
        for brake in self.acting_brakes(&chosen) {
            self.tell_brake(brake, (at.mode.brake(brake), chosen.brake(brake)), told, jump);
        }
        jump.mode = chosen;
        now.stop(&mut jump.mode, &mut jump.states)
    }

    /// What a brake does from now on, as an event, and where its rate begins at zero.
    fn tell_brake(
        &self,
        brake: usize,
        (before, after): (Option<Grip>, Option<Grip>),
        told: &[(usize, Watched)],
        jump: &mut Jump<Mode>,
    ) {
        let sticks = match (before, after) {
            (before, Some(Grip::Sticks)) => (before != after).then_some(true),
            (Some(before), Some(after)) => (before != after).then_some(false),
            _ => None,
        };
        jump.record.happened.extend(sticks.map(|sticks| Happening::Brake { brake, sticks }));
        let seen = told.iter().find(|(known, _)| *known == brake).map(|(_, watched)| *watched);
        let zeros = match seen {
            // Its rate begins with its second derivative.
            Some(Watched::Cone(_)) => 2,
            Some(_) => 1,
            None => return,
        };
        if after != Some(Grip::Sticks) {
            jump.zeros.push((self.brakes()[brake].guard_name(Watched::Slip), zeros));
        }
    }
}

impl Instant<'_> {
    /// The mode with the grips of all brakes.
    fn choose(&self, mode: &Mode, told: &[(usize, Watched)]) -> Result<Mode, Reason> {
        let acting = self.equations.acting_brakes(mode);
        let mut chosen = mode.clone();
        chosen.brakes.retain(|(brake, _)| acting.contains(brake));
        let mut still = vec![];
        for (brake, [rate, zero]) in acting.iter().copied().zip(self.rates(mode, &acting)?) {
            let is_still = rate.abs() <= zero || told.iter().any(|(known, _)| *known == brake);
            let grip = if is_still { Grip::Sticks } else { Grip::Slides(Way::of(rate)) };
            still.extend(is_still.then_some(brake));
            chosen.set_brake(brake, Some(grip));
        }
        self.leave_drives(&mut chosen, &mut still)?;
        let broken = told.iter().filter_map(|(brake, watched)| match watched {
            Watched::Cone(way) if still.contains(brake) => Some((*brake, *way)),
            _ => None,
        });
        let broken: Vec<(usize, Way)> = broken.collect();
        broken.iter().for_each(|(brake, way)| chosen.set_brake(*brake, Some(Grip::Slides(*way))));
        self.give_way(&mut chosen, &still)?;
        match self.turned_back(&chosen, &still)? {
            None => Ok(chosen),
            // What was about to give way is held all the same.
            Some(_) if !broken.is_empty() => {
                let told: Vec<(usize, Watched)> =
                    told.iter().map(|(brake, _)| (*brake, Watched::Slip)).collect();
                self.choose(mode, &told)
            }
            Some(brake) => Err(Reason::Model(format!(
                "the sign of a rate in `{}` has no value here with which the motion obeys it: where it holds it would give way, and where it \
                 gives way it would hold",
                self.equations.brake_name(brake)
            ))),
        }
    }

    /// Takes out of the states what rounding has left of rates that stay zero; what cannot move at all is not integrated.
    fn stop(&self, mode: &mut Mode, states: &mut [f64]) -> Result<(), Reason> {
        let equations = self.equations;
        for (state, symbol) in equations.states(mode).iter().enumerate() {
            if equations.is_braked(mode, symbol) {
                states[state] = 0.0;
            }
        }
        let bodies: Vec<usize> = equations
            .acting_brakes(mode)
            .into_iter()
            .flat_map(|brake| self.brakes()[brake].bodies.clone())
            .collect();
        for island in equations.islands(mode, &bodies) {
            mode.still.retain(|body| !island.contains(body));
            if self.is_still(mode, &island)? {
                equations.velocities_of(mode, &island).into_iter().for_each(|state| states[state] = 0.0);
                mode.still.extend(&island);
                mode.still.sort_unstable();
            }
        }
        Ok(())
    }

    /// Whether what holds an island, none of which moves, leaves it no motion.
    fn is_still(&self, mode: &Mode, island: &[usize]) -> Result<bool, Reason> {
        let equations = self.equations;
        let braked: Vec<usize> = mode.braked().collect();
        let joints = equations.independent_rows_of(mode, island).into_iter().map(|(_, row)| row);
        let contacts = mode.held().map(RowOf::Pair).chain(mode.sticking().map(RowOf::Slip));
        let rows = joints.chain(contacts).chain(braked.iter().copied().map(RowOf::Brake));
        let rows: Vec<RowOf> =
            rows.filter(|row| equations.bodies_of(*row).iter().any(|body| island.contains(body))).collect();
        let t = time_symbol();
        let moves = |row: &RowOf| match row {
            RowOf::Pair(pair) | RowOf::Slip(pair) => !equations.pairs()[*pair].is_fixed(),
            RowOf::Joint(joint, _) => equations.model().joints[*joint].world().is_some_and(moves),
            RowOf::Brake(brake) => self.brakes()[*brake].rate.symbols().contains(&t),
        };
        let free = |body: &usize| equations.free_velocity_states(mode, *body, self.states).len();
        let count: usize = island.iter().map(free).sum();
        if rows.len() < count
            || rows.iter().any(moves)
            || island.iter().any(|body| equations.is_carried(*body))
        {
            return Ok(false);
        }
        let rows: Vec<(usize, RowOf)> = rows.into_iter().enumerate().collect();
        let gradient =
            equations.numbers_of(mode, &rows, self.time, self.states, self.inputs)?.gradient.dense();
        // Rows in units of their own.
        let rows = gradient.row_iter().map(|row| row / row.norm().max(f64::MIN_POSITIVE));
        let gradient = DMatrix::from_rows(&rows.collect::<Vec<_>>());
        Ok(gradient.iter().all(|slope| slope.is_finite()) && gradient.rank(FOLLOWS) == count)
    }

    fn brakes(&self) -> &[Brake] {
        self.equations.brakes()
    }

    fn values(&self, mode: &Mode, formulas: &[Expr]) -> Result<Vec<f64>, Reason> {
        let states = self.equations.with_forces(mode, self.time, self.states, self.inputs)?;
        self.equations.values(formulas, mode, self.time, &states, self.inputs)
    }

    /// By brake its rate, and what of it is none.
    fn rates(&self, mode: &Mode, acting: &[usize]) -> Result<Vec<[f64; 2]>, Reason> {
        let bodies = 0..self.equations.model().bodies.len();
        let motions: Vec<&Kinematics> =
            bodies.map(|body| &self.equations.body_equations(body).kinematics).collect();
        let formulas = acting.iter().flat_map(|brake| {
            let brake = &self.brakes()[*brake];
            [brake.rate.clone(), brake.size(&motions)]
        });
        let values = self.values(mode, &formulas.collect::<Vec<_>>())?;
        let scale = |brake: usize| {
            let group = self.brakes()[brake].row.measure.rate();
            self.scales.get(group as usize).copied().unwrap_or_default()
        };
        let each = acting.iter().zip(values.chunks(2));
        Ok(each.map(|(brake, own)| [own[0], STANDS * (own[1] + scale(*brake) * STANDS)]).collect())
    }

    /// Changes of the rate of a brake with its sign positive, and with it negative.
    fn ways(&self, chosen: &Mode, brake: usize) -> Result<[f64; 2], Reason> {
        let mut found = [0.0; 2];
        for (way, found) in [Way::Forward, Way::Backward].into_iter().zip(&mut found) {
            let mut tried = chosen.clone();
            tried.set_brake(brake, Some(Grip::Slides(way)));
            *found = self.change(&tried, brake)?;
        }
        Ok(found)
    }

    fn change(&self, mode: &Mode, brake: usize) -> Result<f64, Reason> {
        Ok(self.values(mode, &[self.brakes()[brake].row.acceleration.clone()])?[0])
    }

    /// Leaves those to the integrator that drive instead of braking, or do nothing.
    fn leave_drives(&self, chosen: &mut Mode, still: &mut Vec<usize>) -> Result<(), Reason> {
        for brake in still.clone() {
            let [forward, backward] = self.ways(chosen, brake)?;
            let is_brake = forward - backward < -BALANCED * (forward.abs() + backward.abs());
            if !is_brake {
                chosen.set_brake(brake, None);
                still.retain(|known| *known != brake);
            }
        }
        Ok(())
    }

    /// Lets those give way that cannot hold, the one that is farthest from it first.
    fn give_way(&self, chosen: &mut Mode, still: &[usize]) -> Result<(), Reason> {
        for _ in still {
            let held: Vec<usize> =
                still.iter().copied().filter(|brake| chosen.brake(*brake) == Some(Grip::Sticks)).collect();
            let formulas: Vec<Expr> = held.iter().flat_map(|brake| self.brakes()[*brake].held()).collect();
            let values = self.values(chosen, &formulas)?;
            let beyond = |own: &[f64]| own[0].abs() - own[1].abs() * (1.0 + FULL);
            let part = |own: &[f64]| own[0].abs() / own[1].abs();
            let breaks = held.iter().zip(values.chunks(2)).filter(|(_, own)| beyond(own) > 0.0);
            let Some((brake, own)) = breaks.max_by(|a, b| part(a.1).total_cmp(&part(b.1))) else {
                return Ok(());
            };
            let way = Way::of(own[0] * own[1].signum());
            chosen.set_brake(*brake, Some(Grip::Slides(way)));
        }
        Ok(())
    }

    /// One of those that have given way and whose rate changes against its sign.
    fn turned_back(&self, chosen: &Mode, still: &[usize]) -> Result<Option<usize>, Reason> {
        for &brake in still {
            let Some(Grip::Slides(way)) = chosen.brake(brake) else { continue };
            let [forward, backward] = self.ways(chosen, brake)?;
            let change = if way == Way::Forward { forward } else { -backward };
            if change < -BALANCED * (forward.abs() + backward.abs()) {
                return Ok(Some(brake));
            }
        }
        Ok(None)
    }
}
