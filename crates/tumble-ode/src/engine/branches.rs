//! Signs of branches, and which functions are zero where a step begins: as a mode is entered, and as steps end.

use tumble_expr::{Active, Branches, Turning};

use super::{Engine, Hit};
use crate::expansion::Expansion;
use crate::work::Work;

/// A length this much smaller than it has been is zero but for rounding: the motion passes through zero.
const VANISHING: f64 = 1024.0 * f64::EPSILON;

/// What is known of the watched functions at the start of a step.
#[derive(Clone, Debug, Default)]
pub(super) struct BranchSigns {
    /// Sign of each branch, +1 or -1, then the segment of each table.
    pub(super) signs: Vec<f64>,
    /// Which functions are zero now, whatever rounding has left of them: branches and turnings.
    pub(super) zero_branches: Vec<bool>,
    pub(super) zero_turnings: Vec<bool>,
    /// How many first coefficients of each guard and lazily evaluated guard are zero now.
    pub(super) zero_guards: Vec<usize>,
    /// Sign that each guard had where the last step ended, or before if it was zero there; 0 at the start of a mode.
    pub(super) sides: Vec<f64>,
    /// Whether those are signs of the mode before.
    pub(super) sides_are_carried: bool,
    /// Which norms are zero vectors now.
    pub(super) vanishing: Vec<bool>,
    /// Largest values that lengths have had.
    pub(super) turning_scales: Vec<f64>,
    /// What matters with these signs.
    pub(super) active: Active,
}

impl Engine {
    /// Determines the branch signs at the start of the mode. `zeros` are guards, by name, that are zero now, with how
    /// many derivatives.
    pub(crate) fn enter(&mut self, time: f64, states: &[f64], zeros: &[(String, usize)]) {
        self.lazy_guards.enter(states);
        let tape = self.system.tape.clone();
        self.values.start(time, states, Branches::Free);
        let is_zero = |slot: u32| self.values.slot(slot)[0] == 0.0;
        let names = &self.system.guard_names;
        let mut active = std::mem::take(&mut self.branch_signs.active);
        tape.find_active(self.values.signs(), &mut active);
        self.branch_signs = BranchSigns {
            signs: self.values.signs().to_vec(),
            zero_branches: tape.guards().iter().map(|slot| is_zero(*slot)).collect(),
            zero_turnings: vec![false; self.turnings.len()],
            zero_guards: names
                .iter()
                .map(|name| zeros.iter().filter(|(zero, _)| zero == name).map(|(_, count)| *count).max())
                .map(Option::unwrap_or_default)
                .collect(),
            sides: vec![0.0; self.system.guards],
            sides_are_carried: false,
            vanishing: vec![false; tape.norms()],
            turning_scales: vec![0.0; self.turnings.len()],
            active,
        };
    }

    /// Carries on with the signs that guards had in the mode before, where no state has jumped.
    pub(crate) fn carry_sides(&mut self, before: &[(String, f64)]) {
        for (name, side) in self.system.guard_names.iter().zip(&mut self.branch_signs.sides) {
            *side = before.iter().find(|(known, _)| known == name).map_or(0.0, |(_, side)| *side);
        }
        self.branch_signs.sides_are_carried = true;
    }

    /// Guards by name with the signs that they had where the last step ended.
    pub(crate) fn sides(&self) -> Vec<(String, f64)> {
        self.system.guard_names.iter().cloned().zip(self.branch_signs.sides.iter().copied()).collect()
    }

    /// Guards by name of which first coefficients are zero now, with how many.
    pub(crate) fn zeros(&self) -> Vec<(String, usize)> {
        let counts = self.branch_signs.zero_guards.iter().copied();
        let named = self.system.guard_names.iter().cloned().zip(counts);
        named.filter(|(_, count)| *count > 0).collect()
    }

    /// The branch signs that hold, then the segments of the tables.
    pub(crate) fn signs(&self) -> &[f64] {
        &self.branch_signs.signs
    }

    /// What matters with these signs.
    pub(crate) fn active(&self) -> &Active {
        &self.branch_signs.active
    }

    /// Lengths, roots and powers, in the tape's order.
    pub(crate) fn turnings(&self) -> &[Turning] {
        &self.turnings
    }

    /// Whether the guard of a branch is zero now.
    pub(crate) fn is_zero_branch(&self, branch: usize) -> bool {
        self.branch_signs.zero_branches[branch]
    }

    /// How many first coefficients of a guard are zero now; lazily evaluated guards are counted after the others.
    pub(crate) fn zeros_of_guard(&self, guard: usize) -> usize {
        self.branch_signs.zero_guards[guard]
    }

    /// Whether a norm is a zero vector now.
    pub(crate) fn is_vanishing(&self, norm: usize) -> bool {
        self.branch_signs.vanishing[norm]
    }

    /// Whether a length that turns is zero there, but for rounding.
    pub(crate) fn vanishes_at(&self, turning: usize, expansion: &Expansion, s: f64) -> bool {
        let least = expansion.turnings[turning].length(s);
        least <= VANISHING * self.branch_signs.turning_scales[turning]
    }

    /// A step was taken: what was zero at its start is so no more.
    pub(crate) fn leave_start(&mut self) {
        let BranchSigns { zero_branches, zero_turnings, zero_guards, vanishing, .. } = &mut self.branch_signs;
        for flags in [zero_branches, zero_turnings, vanishing] {
            flags.fill(false);
        }
        zero_guards.fill(0);
    }

    /// Changes branch signs at the end of a step; `expansion` is that of the step.
    pub(crate) fn pass(&mut self, hits: &[Hit], expansion: &Expansion, length: f64, work: &mut Work) {
        for hit in hits {
            match *hit {
                Hit::Branch(branch, to) => {
                    work.flips += 1;
                    self.branch_signs.zero_branches[branch] = true;
                    self.branch_signs.signs[branch] = to;
                }
                Hit::Turning(turning) => {
                    work.turns += 1;
                    self.branch_signs.zero_turnings[turning] = true;
                }
                Hit::Knot(lookup, segment) => {
                    work.knots += 1;
                    let first = self.system.tape.guards().len();
                    self.branch_signs.signs[first + lookup] = segment as f64;
                }
                Hit::Guard(guard) => self.branch_signs.zero_guards[guard] = 1,
            }
        }
        if hits.iter().any(|hit| matches!(hit, Hit::Turning(_))) {
            self.vanish(expansion, length);
        }
    }

    /// Finds which lengths are zero at the end of a step, but for rounding. Those that turn a little later, though all are zero at
    /// once, count: the series of what rounding has left of them would be that of nothing.
    fn vanish(&mut self, expansion: &Expansion, length: f64) {
        for turning in 0..self.turnings.len() {
            let Turning::Norm { index, .. } = self.turnings[turning] else { continue };
            if self.branch_signs.active.turnings[turning] && self.vanishes_at(turning, expansion, length) {
                self.branch_signs.zero_turnings[turning] = true;
                self.branch_signs.vanishing[index] = true;
            }
        }
    }
}
