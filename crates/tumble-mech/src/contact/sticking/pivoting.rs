//! Pushes of contacts with friction by complementary pivoting, all at once.

use nalgebra::{DMatrix, DVector};

use super::{Patch, Pushes, Rough};
use crate::contact::grip::Grip;
use crate::contact::lemke;
use crate::product::product;

impl Rough<'_> {
    /// The solution of the whole problem, if it stands with both coefficients of each surface; else its choice put right.
    pub(super) fn by_pivoting(&self, coefficient: usize) -> Option<Pushes> {
        let pushes = self.as_a_whole(coefficient)?;
        let then = self.then(&pushes);
        let pivoted = |patch: &Patch| self.pivoted_grip(patch, &pushes, &then);
        let grips: Vec<Grip> = self.patches.iter().map(pivoted).collect();
        let presses = |contact: &usize| pushes[*contact] > self.given[*contact];
        let held: Vec<usize> = self.contacts.iter().copied().filter(presses).collect();
        let own = self.stopped(&grips, &held);
        let own = own.filter(|found| self.is_sound(found) && self.all_follow(found));
        own.or_else(|| {
            let swept = self.patches.iter().map(|patch| self.swept_grip(patch, &pushes, &then));
            self.put_right(swept.collect())
        })
    }

    /// The same as after sweeps, but that friction which is none stays so: where more rows stand still than are independent, pivoting has found
    /// with which of them the others are within their cones.
    fn pivoted_grip(&self, patch: &Patch, pushes: &DVector<f64>, then: &DVector<f64>) -> Grip {
        let is_none = |(_, row): &(usize, usize)| pushes[*row].abs() <= self.slack(*row, pushes);
        match self.swept_grip(patch, pushes, then) {
            Grip::Sticks if patch.contacts.iter().all(is_none) => Grip::Follows,
            other => other,
        }
    }

    /// Pushes of the whole problem, with one of the coefficients of each surface for both. In order, its unknowns are the pushes along normals
    /// and, of each patch that may stick, friction one way and the other, and how fast it slips: `0 <= s + w_t`, `0 <= s - w_t` and `0 <= mu z_n -
    /// z_t+ - z_t-` are the conditions that these are paired with.
    fn as_a_whole(&self, coefficient: usize) -> Option<DVector<f64>> {
        let free: Vec<&Patch> = self.patches.iter().filter(|patch| patch.slips.is_none()).collect();
        let (n, size) = (self.contacts.len(), self.contacts.len() + 3 * free.len());
        let mut push = DMatrix::zeros(self.response.nrows(), size);
        self.contacts.iter().enumerate().for_each(|(j, contact)| push[(*contact, j)] = 1.0);
        let mut pushes = self.given.clone();
        for patch in &self.patches {
            let Some(way) = patch.slips else { continue };
            for &(contact, row) in &patch.contacts {
                let part = -f64::from(way.sign()) * patch.friction[1];
                let own = self.contacts.iter().position(|known| *known == contact);
                own.into_iter().for_each(|j| push[(row, j)] = part);
                pushes[row] = part * self.normal(&self.given, contact);
            }
        }
        for (index, patch) in free.iter().enumerate() {
            push[(patch.row(), n + 3 * index)] = 1.0;
            push[(patch.row(), n + 3 * index + 1)] = -1.0;
        }
        let (moved, without) = (product(self.response, &push), &self.without + self.response * &pushes);
        let mut m = DMatrix::zeros(size, size);
        let mut q = DVector::zeros(size);
        for (i, contact) in self.contacts.iter().enumerate() {
            m.row_mut(i).copy_from(&moved.row(*contact));
            q[i] = without[*contact];
        }
        for (index, patch) in free.iter().enumerate() {
            let [one, other, slip] = [0, 1, 2].map(|part| n + 3 * index + part);
            for (row, sign) in [(one, 1.0), (other, -1.0)] {
                m.row_mut(row).copy_from(&(moved.row(patch.row()) * sign));
                m[(row, slip)] = 1.0;
                m[(slip, row)] = -1.0;
                q[row] = sign * without[patch.row()];
            }
            for (contact, _) in &patch.contacts {
                let own = self.contacts.iter().position(|known| known == contact);
                own.into_iter().for_each(|j| m[(slip, j)] = patch.friction[coefficient]);
                q[slip] += patch.friction[coefficient] * self.normal(&self.given, *contact);
            }
        }
        // Pivoting takes zeros as they come, and rounding for what it is not.
        q.iter_mut().filter(|q| q.abs() <= self.zero).for_each(|q| *q = 0.0);
        let z = lemke::solve(&m, &q)?;
        pushes += push * &z;
        Some(pushes)
    }
}
