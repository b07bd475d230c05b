//! Which operations matter on given sides: those of a side that is not taken do not.

use crate::Tape;
use crate::ops::Op;

/// What matters of a tape on given sides.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Active {
    /// By branch.
    pub branches: Vec<bool>,
    /// By measured function.
    pub tables: Vec<bool>,
    /// By entry of [`Tape::turnings`].
    pub turnings: Vec<bool>,
}

impl Tape {
    /// What the outputs depend on where the branches have these sides, +1 or -1 (what follows them is not read).
    ///
    /// # Panics
    /// If there is not one side a branch.
    pub fn active(&self, sides: &[f64]) -> Active {
        let mut active = Active {
            branches: vec![false; self.guards().len()],
            tables: vec![false; self.tables().len()],
            turnings: vec![],
        };
        let mut needed = vec![false; self.len()];
        for output in self.outputs() {
            needed[*output as usize] = true;
        }
        for slot in (0..self.len()).rev() {
            if needed[slot] {
                self.mark(self.ops[slot], sides, &mut needed, &mut active);
            }
        }
        let turning = self.varying().filter(|(_, op)| op.turns());
        active.turnings = turning.map(|(slot, _)| needed[slot as usize]).collect();
        active
    }

    fn mark(&self, op: Op, sides: &[f64], needed: &mut [bool], active: &mut Active) {
        if let Some(branch) = op.branch() {
            active.branches[branch as usize] = true;
        }
        if let Some(lookup) = op.lookup() {
            active.tables[lookup as usize] = true;
        }
        let parts = match op {
            Op::Choose { branch, positive, negative } => {
                let taken = if sides[branch as usize] > 0.0 { positive } else { negative };
                vec![self.guards()[branch as usize], taken]
            }
            _ => op.parts(self),
        };
        for part in parts {
            needed[part as usize] = true;
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{Dimension, Expr, Layout, Relation, Symbol, Tape};

    #[test]
    fn a_side_not_taken_does_not_matter() {
        let t = Expr::symbol("t", Dimension::NONE);
        let condition = Expr::compare(Relation::Less, t.clone(), Expr::one());
        let formula = Expr::select(condition, t.sin().abs(), t.sqrt());
        let layout = Layout::new(vec![], Symbol::new("t", Dimension::NONE), vec![]);
        let tape = Tape::compile(&layout, &[formula]).expect("typed");
        // Branch 0 is abs, branch 1 the condition: positive where t >= 1, where the root is taken.
        let (root, sine) = (tape.active(&[1.0, 1.0]), tape.active(&[1.0, -1.0]));
        assert_eq!((root.branches, root.turnings), (vec![false, true], vec![true]));
        assert_eq!((sine.branches, sine.turnings), (vec![true, true], vec![false]));
    }
}
