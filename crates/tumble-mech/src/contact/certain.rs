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
//! As `contact/rough`.
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

use crate::contact::rough::{Patch, Rough};

/// What is taken off besides, so that no rounding makes it certain.
const SPARE: f64 = 1e-6;

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
