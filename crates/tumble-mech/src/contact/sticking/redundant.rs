//! More rows than are independent, where rounding alone tells one from the others.
//!
//! A body that sticks on a floor and on a wall, near the corner between them, is held by three of its four rows. Once friction is eliminated it can
//! only turn about that corner, and the lever of the row across the wall is the distance from there. Where that is short, its pivot is small too, and
//! what rounding of the elimination leaves of it seems to be a part of the row, though the one across the floor says the same. So it is asked of
//! the rows as they are, before anything is eliminated, whether they are independent.

use super::{Pushes, Reduced, Rough};
use crate::contact::complementarity::{are_independent, is_symmetric, standing};
use crate::contact::grip::Grip;

impl Rough<'_> {
    /// Whether one of some normals, by their places, follows from the others and what sticks. Loads that read forces make responses unsymmetric; then
    /// nothing is claimed.
    pub(super) fn is_redundant(&self, reduced: &Reduced, held: &[usize]) -> bool {
        if reduced.holding.is_empty() || held.is_empty() {
            return false;
        }
        let held = held.iter().map(|index| self.contacts[*index]);
        let rows: Vec<usize> = reduced.holding.iter().copied().chain(held).collect();
        is_symmetric(self.response, &rows) && !are_independent(self.response, &rows)
    }

    /// The solution with all of these normals but one, which follows from the others and what sticks.
    pub(super) fn with_one_less(&self, grips: &[Grip], reduced: Reduced, held: &[usize]) -> Option<Pushes> {
        let mut fewer = held.iter().map(|left_out| {
            let rest: Vec<usize> = held.iter().copied().filter(|index| index != left_out).collect();
            let pushes = standing(&reduced.matrix, &reduced.without, &rest)?;
            let found = self.complete(grips, reduced.clone(), &rest, &pushes);
            (!self.is_redundant(&reduced, &rest) && self.pushes_apart(&found)).then_some(found)
        });
        fewer.find_map(|found| found)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::contact::sticking::Patch;
    use crate::product::product;

    /// Rows of a point at `arm` across and along a surface with that normal, of a body with three freedoms; columns are in the scale of its masses.
    fn rows([x, y]: [f64; 2], [nx, ny]: [f64; 2]) -> [[f64; 3]; 2] {
        const LIGHTNESS: [f64; 2] = [1.31, 20.3];
        let row = |[a, b]: [f64; 2]| [a * LIGHTNESS[0], b * LIGHTNESS[0], (x * b - y * a) * LIGHTNESS[1]];
        [row([nx, ny]), row([ny, -nx])]
    }

    /// A body that leans on a floor and a slope, stuck to both, with one foot near the corner between them: three of the four rows hold it, however
    /// near that is.
    #[test]
    fn nothing_is_held_twice_near_a_corner() {
        for step in 0..200 {
            let near = 1e-3 * libm::pow(10.0, -0.03 * f64::from(step));
            let slope = [0.9284766908852594, 0.3713906763541037];
            let [floor, side] = [rows([0.0386, -0.0531], [0.0, 1.0]), rows([-0.0386, -0.0531 + near], slope)];
            let all = [floor[0], side[0], floor[1], side[1]];
            let of = DMatrix::from_fn(4, 3, |row, column| all[row][column]);
            let response = product(&of, &of.transpose());
            let forces = DVector::from_row_slice(&[-3.1, -7.3, 0.02]);
            let patch =
                |contact, row| Patch { contacts: vec![(contact, row)], friction: [0.9; 2], slips: None };
            let rough = Rough {
                without: &of * forces,
                response: &response,
                contacts: vec![0, 1],
                patches: vec![patch(0, 2), patch(1, 3)],
                given: DVector::zeros(4),
                loads: DVector::zeros(4),
                zero: 1e-9,
            };
            let found = rough.solve().expect("forces that hold it");
            assert!(found.then.amax() < 1e-8, "{near}: {}", found.then);
            assert!(found.held.len() + found.holding.len() <= 3, "{near}: {found:?}");
        }
    }
}
