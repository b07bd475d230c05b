//! Which operations matter on given sides: those of a side that is not taken do not.

use smallvec::smallvec;

use crate::Tape;
use crate::ops::{Op, Parts};

/// What matters of a tape on given sides.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Active {
    /// By branch.
    pub branches: Vec<bool>,
    /// By measured function.
    pub tables: Vec<bool>,
    /// By entry of [`Tape::turnings`].
    pub turnings: Vec<bool>,
    /// By slot.
    needed: Vec<bool>,
}

impl Active {
    fn clear(&mut self, tape: &Tape) {
        let lengths = [tape.guards().len(), tape.tables().len(), 0, tape.len()];
        let Self { branches, tables, turnings, needed } = self;
        for (flags, length) in [branches, tables, turnings, needed].into_iter().zip(lengths) {
            flags.clear();
            flags.resize(length, false);
        }
    }
}

impl Tape {
    /// Finds what the outputs depend on where the branches have these sides, +1 or -1 (what follows them is not read).
    ///
    /// # Panics
    /// If there is not one side a branch.
    pub fn find_active(&self, sides: &[f64], active: &mut Active) {
        active.clear(self);
        for output in self.outputs() {
            active.needed[*output as usize] = true;
        }
        for slot in (0..self.len()).rev() {
            if active.needed[slot] {
                self.mark(self.ops[slot], sides, active);
            }
        }
        let Active { turnings, needed, .. } = active;
        let turning = self.varying().filter(|(_, op)| op.turns());
        turnings.extend(turning.map(|(slot, _)| needed[slot as usize]));
    }

    fn mark(&self, op: Op, sides: &[f64], active: &mut Active) {
        if let Some(branch) = op.branch() {
            active.branches[branch as usize] = true;
        }
        if let Some(lookup) = op.lookup() {
            active.tables[lookup as usize] = true;
        }
        let parts: Parts = match op {
            Op::Choose { branch, positive, negative } => {
                let taken = if sides[branch as usize] > 0.0 { positive } else { negative };
                smallvec![self.guards()[branch as usize], taken]
            }
            _ => op.parts(self),
        };
        for part in parts {
            active.needed[part as usize] = true;
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{Active, Dimension, Expr, Layout, Relation, Symbol, Tape};

    #[test]
    fn a_side_not_taken_does_not_matter() {
        let t = Expr::symbol("t", Dimension::NONE);
        let condition = Expr::compare(Relation::Less, t.clone(), Expr::one());
        let formula = Expr::select(condition, t.sin().abs(), t.sqrt());
        let layout = Layout::new(vec![], Symbol::new("t", Dimension::NONE), vec![]);
        let tape = Tape::compile(&layout, &[formula]).expect("typed");
        // Branch 0 is abs, branch 1 the condition: positive where t >= 1, where the root is taken.
        let [mut root, mut sine] = [(); 2].map(|()| Active::default());
        tape.find_active(&[1.0, 1.0], &mut root);
        tape.find_active(&[1.0, -1.0], &mut sine);
        assert_eq!((root.branches, root.turnings), (vec![false, true], vec![true]));
        assert_eq!((sine.branches, sine.turnings), (vec![true, true], vec![false]));
    }
}
