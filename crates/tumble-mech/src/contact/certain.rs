//! # Law
//!
//! Contacts with friction at an instant as in `contact/possible`: where frictions are small for how strongly pushes along surfaces and across them
//! are coupled, one motion is possible, whatever forces act.
//!
//! Let two sets of pushes hold and D be their difference. What slips already has friction in proportion to its normal forces, so D follows from the
//! part x of normals and of friction that is not tied so: `D = P x`. With R the rows of that part, `B = R A P` and dw = B x, each normal has
//! `x_n dw_n <= 0` (one of push and opening is zero in both sets), and each surface that may stick, pressed by the sum N of its normals,
//! `x_t dw_t <= mu |dN| |dw_t|` (Coulomb: friction does the most work it can). So `x.Bx <= sum mu |u.x| |a.x|`, u summing the normals of a surface
//! and a being its row of B. For any k > 0, `|u.x| |a.x| <= (k (u.x)^2 + (a.x)^2/k)/2`. Therefore, if
//!
//! `(B + B^T)/2 - sum mu (k u u^T + a a^T/k)/2`
//!
//! is positive definite, x = 0. Here k makes both parts equal in the norm of `(B + B^T)/2`; for one contact that may stick this is
//! `mu sqrt(A_tt (A^-1)_nn) < 2`. Of one contact by itself the push needed is a function of the normal force whose slopes are `A_nn - A_nt^2/A_tt` and
//! `A_nn +- mu A_nt`: one motion where all are positive, which is Painleve's bound.
//!
//! # Symbols and units
//!
//! A and B (1/kg), x and D (N), mu (1), k (1/kg).
//!
//! # Sign and frame
//!
//! As `contact/sticking`.
//!
//! # Validity
//!
//! Sufficient, not necessary. Rows that depend on each other are never certain: what presses bodies against each other without moving them is
//! bounded by no motion. Forces that loads read make A unsymmetric; then nothing is claimed.
//!
//! # Source
//!
//! The derivation above. That small friction makes the motion unique: Pang and Trinkle, Mathematical
//! Programming 73 (1996); Stewart, SIAM Review 42 (2000).
//!
//! # Checked by
//!
//! Its own tests: of random contacts what is certain has one motion. `tests/several_motions.rs`.

use nalgebra::{DMatrix, DVector};

use crate::contact::sticking::{Patch, Rough};

/// What is taken off besides, so that no rounding makes it certain.
pub(super) const SPARE: f64 = 1e-6;

impl Rough<'_> {
    /// Whether no forces leave more than one motion possible, by the friction alone; of as many freedoms.
    pub(super) fn is_certain(&self, freedoms: usize) -> bool {
        self.is_one_contact() || self.is_weak(freedoms)
    }

    /// One contact, below Painleve's bound.
    fn is_one_contact(&self) -> bool {
        let ([normal], [patch]) = (&self.contacts[..], &self.patches[..]) else { return false };
        let ([(contact, row)], a) = (&patch.contacts[..], self.response) else { return false };
        let (own, across, along) = (a[(*normal, *normal)], a[(*normal, *row)], a[(*row, *row)]);
        let tied = match patch.slips {
            Some(way) => -f64::from(way.sign()) * patch.friction[1] * across,
            None => -patch.friction[0] * across.abs(),
        };
        let sticks = patch.slips.is_some() || own * along - across * across > SPARE * own * along;
        contact == normal && sticks && own + tied > SPARE * own
    }

    fn is_weak(&self, freedoms: usize) -> bool {
        let free: Vec<&Patch> = self.patches.iter().filter(|patch| patch.slips.is_none()).collect();
        let sticking = free.iter().map(|patch| patch.row());
        let rows: Vec<usize> = self.contacts.iter().copied().chain(sticking).collect();
        if rows.len() > freedoms {
            return false;
        }
        let b = self.tied(&rows);
        let mean = (&b + b.transpose()) / 2.0;
        let Some(factors) = mean.clone().cholesky() else { return false };
        let mut left = mean * (1.0 - SPARE);
        for (index, patch) in free.into_iter().enumerate() {
            let presses = |row: usize| patch.contacts.iter().any(|(contact, _)| *contact == row);
            let u = DVector::from_fn(rows.len(), |i, _| if presses(rows[i]) { 1.0 } else { 0.0 });
            let a = b.row(self.contacts.len() + index).transpose();
            let [of_u, of_a] = [&u, &a].map(|v| v.dot(&factors.solve(v)));
            if u.amax() == 0.0 || patch.friction[0] == 0.0 {
                continue;
            }
            let k = libm::sqrt(of_a / of_u);
            let half = patch.friction[0] / 2.0;
            left -= (&u * u.transpose()) * (half * k) + (&a * a.transpose()) * (half / k);
        }
        left.cholesky().is_some()
    }

    /// B: what a unit of each does to these rows, with the friction of what slips.
    fn tied(&self, rows: &[usize]) -> DMatrix<f64> {
        let mut columns = DMatrix::from_fn(rows.len(), rows.len(), |i, j| self.response[(rows[i], rows[j])]);
        let slipping = self.patches.iter().filter_map(|patch| Some((patch, patch.slips?)));
        for (patch, way) in slipping {
            for (contact, row) in &patch.contacts {
                let Some(column) = self.contacts.iter().position(|known| known == contact) else { continue };
                let part = -f64::from(way.sign()) * patch.friction[1];
                (0..rows.len()).for_each(|i| columns[(i, column)] += part * self.response[(rows[i], *row)]);
            }
        }
        columns
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::contact::grip::Way;

    /// Numbers from -1 to 1 in an order of their own (Knuth's linear congruential generator).
    pub(in crate::contact) struct Draw(pub(in crate::contact) u64);

    impl Draw {
        fn next(&mut self) -> f64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        }
    }

    /// Contacts of bodies with some freedoms, each surface with one or two of them.
    pub(in crate::contact) fn random(
        draw: &mut Draw,
        [surfaces, freedoms]: [usize; 2],
        friction: f64,
    ) -> Rough<'static> {
        let pairs = usize::from(draw.next() > 0.0);
        let contacts = surfaces + pairs;
        let mut rows = DMatrix::from_fn(2 * contacts, freedoms, |_, _| draw.next());
        let patches = (0..surfaces).map(|surface| {
            let own = if surface < pairs { vec![surface, surfaces + surface] } else { vec![surface] };
            let contacts = own.into_iter().map(|contact| (contact, contacts + contact)).collect();
            let way = if draw.next() > 0.0 { Way::Forward } else { Way::Backward };
            let slips = Some(way).filter(|_| draw.next() > 0.6);
            Patch { contacts, friction: [friction; 2], slips }
        });
        let patches: Vec<Patch> = patches.collect();
        for patch in &patches {
            let alike = rows.row(patch.row()).into_owned();
            patch.contacts.iter().for_each(|(_, row)| rows.set_row(*row, &alike));
        }
        let forces = DVector::from_fn(freedoms, |_, _| draw.next());
        Rough {
            response: Box::leak(Box::new(&rows * rows.transpose())),
            without: &rows * forces,
            contacts: (0..contacts).collect(),
            patches,
            given: DVector::zeros(2 * contacts),
            loads: DVector::zeros(2 * contacts),
            zero: 1e-10,
        }
    }

    /// What is certain has one motion, which is the one that is found; of what is not, some has several.
    #[test]
    fn certain_contacts_have_one_motion() {
        let mut draw = Draw(7);
        let (mut certain, mut several) = (0, 0);
        for index in 0..4000 {
            let friction = 0.02 * f64::from(index % 60);
            let sizes = [1 + index as usize % 3, 3 + index as usize % 5];
            let rough = random(&mut draw, sizes, friction);
            let forced: Vec<Option<Way>> = rough.patches.iter().map(|patch| patch.slips).collect();
            let motions = rough.motions(&forced);
            if !rough.is_certain(sizes[1]) {
                several += usize::from(motions.found.len() > 1);
                continue;
            }
            certain += 1;
            let [only] = &motions.found[..] else { panic!("{index}: {} motions", motions.found.len()) };
            let found = rough.solve().expect("forces");
            assert!((&only.then - &found.then).amax() < 1e-6, "{index}");
        }
        assert!(certain > 1000 && several > 50, "{certain} {several}");
    }
}
