//! What an instant adds: parameters that change, impacts, surfaces that let go.

use nalgebra::{DMatrix, DVector};
use tumble_ode::{Occurrence, Reason};

use crate::balance::accumulation::Accumulation;
use crate::balance::contribution::ContributionKind;
use crate::balance::lines::Key;
use crate::balance::stored::{Motion, Stored};
use crate::contact::{ContactMode, Couple};
use crate::event::Action;
use crate::impulse::{Impulse, Source};
use crate::mode::Mode;
use crate::record::{Happening, Record};

/// Contacts that begin to last stop what is left of the motion towards them, which is at most this part of the largest
/// momentum that the body has had: bounces are followed down to 1e-15 of its size, so their speeds down to some 1e-8, and far from
/// the origin, where gaps are rounded more, down to some more than that.
const SETTLED: f64 = 1e-3;
/// Contacts whose impulses do not differ by more than this part are one to the balance.
const ALIKE: f64 = 1e-12;

/// Momentum along x and y, and angular momentum about the centre of mass.
type Change = [f64; 3];

impl Accumulation {
    /// Adds an event of the run.
    pub(super) fn add_event(&mut self, event: &Occurrence<Record>) -> Result<(), Reason> {
        let motion = self.run.motion();
        let [before, after] = [event.mode_before, event.mode_after].map(|mode| &motion.modes[mode]);
        let mut stored = self.stored(before, event.time, &event.before)?;
        self.watch(&stored);
        if before.changes != after.changes {
            let changed = Mode { changes: after.changes.clone(), ..before.clone() };
            let then = self.stored(&changed, event.time, &event.before)?;
            self.add_parameters(&event.record, &stored, &then);
            stored = then;
        }
        let then = self.stored(after, event.time, &event.after)?;
        self.watch(&then);
        self.add_impacts(event, &stored, &then)?;
        self.add_releases(&stored, &then);
        Ok(())
    }

    /// What new values of parameters do to energies and momenta.
    fn add_parameters(&mut self, record: &Record, before: &Stored, after: &Stored) {
        let equations = self.run.equations.clone();
        let events = &equations.model().events;
        let setting = |happening: &Happening| match happening {
            Happening::Event(event) => {
                Some(&events[*event]).filter(|event| matches!(event.action, Action::Set(_)))
            }
            _ => None,
        };
        let names = record.happened.iter().filter_map(setting).map(|event| event.name.as_str());
        let name = names.collect::<Vec<_>>().join(", ");
        for (body, (old, new)) in self.bodies.clone().into_iter().zip(before.bodies.iter().zip(&after.bodies))
        {
            let change = |axis: usize| new.momentum[axis] - old.momentum[axis];
            let change = [new.kinetic - old.kinetic, change(0), change(1), new.angular - old.angular];
            if change != [0.0; 4] {
                let kind = ContributionKind::ParameterJump;
                self.add(Key { load: name.clone(), law: None, body: Some(body), kind }, change);
            }
        }
        for (index, (old, new)) in before.potentials.iter().zip(&after.potentials).enumerate() {
            self.add_energy(index, ContributionKind::ParameterJump, new - old);
        }
    }

    /// Energy that is left in what is compliant when it lets go inside, and that which it has when it pushes again; of contacts that leave
    /// their edges what no other of the same two takes over.
    fn add_releases(&mut self, before: &Stored, after: &Stored) {
        let mut left: Vec<(Couple, usize, f64)> = vec![];
        for (index, potential) in self.potentials.iter().enumerate() {
            let Some(pair) = potential.pair.map(|pair| &self.run.equations.pairs()[pair]) else { continue };
            let change = after.potentials[index] - before.potentials[index];
            let known =
                left.iter_mut().find(|(couple, ..)| !pair.limits.is_empty() && *couple == pair.couple());
            match known {
                Some((_, of, sum)) => {
                    *of = if change < 0.0 { index } else { *of };
                    *sum += change;
                }
                None if pair.may_keep_energy() => left.push((pair.couple(), index, change)),
                None => {}
            }
        }
        let negligible = f64::EPSILON * before.size();
        for (_, index, change) in left.into_iter().filter(|(.., change)| change.abs() > negligible) {
            self.add_energy(index, ContributionKind::Release, change);
        }
    }

    fn add_impacts(
        &mut self,
        event: &Occurrence<Record>,
        before: &Stored,
        after: &Stored,
    ) -> Result<(), Reason> {
        let mut left: Vec<Change> =
            before.bodies.iter().zip(&after.bodies).map(|(old, new)| change(old, new)).collect();
        if left.iter().all(|change| *change == [0.0; 3]) {
            return Ok(());
        }
        for impulse in &event.record.impulses {
            let taken = self.add_impulse(impulse, before, after);
            subtract(&mut left[self.place(impulse.body)], taken);
        }
        for (body, left) in self.bodies.clone().into_iter().zip(left) {
            for impulse in self.settled(event, body, left)? {
                self.add_impulse(&impulse, before, after);
            }
        }
        Ok(())
    }

    /// Adds an impulse J with the work `J . (v_before + v_after) / 2`; what it does to the body's momenta.
    fn add_impulse(&mut self, impulse: &Impulse, before: &Stored, after: &Stored) -> Change {
        let ([rx, ry], [jx, jy]) = (impulse.arm, impulse.impulse);
        let place = self.place(impulse.body);
        let [old, new] = [before, after].map(|stored| &stored.bodies[place]);
        let omega = 0.5 * (old.omega + new.omega);
        let mean = |axis: usize| 0.5 * (old.velocity[axis] + new.velocity[axis]);
        let (vx, vy) = (mean(0) - omega * ry, mean(1) + omega * rx);
        let angular = (old.place[0] + rx) * jy - (old.place[1] + ry) * jx + impulse.couple;
        let law = Some(impulse.source.law());
        let load = self.run.equations.source_name(impulse.source).to_owned();
        let body = Some(impulse.body);
        let speeds = |motion: &Motion| {
            let ([vx, vy], omega) = (motion.velocity.map(f64::abs), motion.omega.abs());
            [vx + omega * ry.abs(), vy + omega * rx.abs(), omega]
        };
        let sizes = |motion: &Motion| -> f64 {
            speeds(motion).iter().zip([jx, jy, impulse.couple]).map(|(speed, part)| speed * part.abs()).sum()
        };
        let size = 0.5 * (sizes(old) + sizes(new));
        let amounts = [jx * vx + jy * vy + impulse.couple * omega, jx, jy, angular];
        self.add_impact(Key { load, law, body, kind: ContributionKind::Impact }, amounts, size);
        [jx, jy, rx * jy - ry * jx + impulse.couple]
    }

    /// Impulses by which contacts that last, and the pivot, stop what is left of a body's motion towards them.
    fn settled(&self, event: &Occurrence<Record>, body: usize, left: Change) -> Result<Vec<Impulse>, Reason> {
        let mode = &self.run.trajectory().modes[event.mode_after];
        let (equations, inputs) = (&self.run.equations, &self.run.inputs);
        let lasting = mode.contacts.iter().filter(|(_, contact_mode)| ContactMode::is_lasting(*contact_mode));
        let lasting = lasting.map(|(pair, _)| (*pair, &equations.pairs()[*pair]));
        let mut sources = vec![];
        let mut formulas = vec![];
        for (index, pair) in lasting.filter(|(_, pair)| pair.has(body)) {
            sources.push(Source::Pair(index));
            formulas.push([pair.arm_of(body).components(), pair.normal.components()].concat());
        }
        if sources.is_empty() || left == [0.0; 3] {
            return Ok(vec![]);
        }
        if let Some((pivot, arm)) = equations.pivot_arm(body) {
            let [x, y] = [[1, 0], [0, 1]].map(|axis| axis.map(tumble_expr::Expr::from));
            sources.extend([Source::Pivot(pivot); 2]);
            formulas.extend([[arm.components(), &x].concat(), [arm.components(), &y].concat()]);
        }
        let values = equations.values(&formulas.concat(), mode, event.time, &event.after, inputs)?;
        let impulses = solved(&sources, values.as_slice(), body, left);
        let largest = SETTLED * self.largest.momentum[self.place(body)];
        let is_small = |impulse: &Impulse| libm::hypot(impulse.impulse[0], impulse.impulse[1]) <= largest;
        Ok(if impulses.iter().all(is_small) { impulses } else { vec![] })
    }
}

fn change(old: &Motion, new: &Motion) -> Change {
    let momentum = |axis: usize| new.momentum[axis] - old.momentum[axis];
    [momentum(0), momentum(1), new.spin - old.spin]
}

fn subtract(left: &mut Change, taken: Change) {
    left.iter_mut().zip(taken).for_each(|(left, taken)| *left -= taken);
}

/// Impulses along the given directions that make up a change of momenta, the least ones where more do; each contact has
/// its arm and its direction among the values.
fn solved(sources: &[Source], values: &[f64], body: usize, change: Change) -> Vec<Impulse> {
    let columns: Vec<[f64; 4]> = values.chunks_exact(4).map(|v| [v[0], v[1], v[2], v[3]]).collect();
    let matrix = DMatrix::from_fn(3, columns.len(), |row, column| {
        let [rx, ry, nx, ny] = columns[column];
        [nx, ny, rx * ny - ry * nx][row]
    });
    let decomposition = matrix.svd(true, true);
    let sizes = decomposition.solve(&DVector::from_row_slice(&change), ALIKE);
    let sizes = sizes.unwrap_or_else(|_| DVector::zeros(columns.len()));
    let impulse = |((source, [rx, ry, nx, ny]), size): ((&Source, &[f64; 4]), &f64)| Impulse {
        source: *source,
        body,
        arm: [*rx, *ry],
        impulse: [nx * size, ny * size],
        couple: 0.0,
    };
    sources.iter().zip(&columns).zip(&sizes).map(impulse).collect()
}
