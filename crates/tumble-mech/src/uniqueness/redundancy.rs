//! Forces of which some are more than needed: what they may be together, and how far each may go.

use nalgebra::{DMatrix, DVector};
use tumble_expr::{Expr, Substitution, Symbol, Unit};

use super::NOTHING;
use crate::contact::Alike;
use crate::linear_program::greatest;

/// A row that was left out follows from the others to this part of its size: a little more than the root of what contacts are told
/// apart by, where pivots are squares.
const FOLLOWS: f64 = 1e-4;

/// Multipliers of which some are more than needed.
pub(super) struct Redundancy {
    pub(super) symbols: Vec<Symbol>,
    pub(super) is_contact: Vec<bool>,
    /// How many of them, at the end, belong to rows that are left out.
    pub(super) left_out: usize,
    /// By multiplier and row left out: what changes no motion.
    pub(super) directions: DMatrix<f64>,
    pub(super) cones: Vec<Cone>,
}

/// What friction can be where something does not slip: places of the multipliers, and the static coefficient.
pub(super) struct Cone {
    pub(super) normal: usize,
    pub(super) along: usize,
    pub(super) friction: Expr,
    /// What slips alike.
    pub(super) patch: Alike,
    /// Whether it is given no friction, because another point of those has it all.
    pub(super) follows: bool,
}

impl Redundancy {
    /// How a quantity of this gradient changes along the directions; zero where it does not but for rounding.
    pub(super) fn slopes(&self, gradient: &DVector<f64>) -> DVector<f64> {
        DVector::from_fn(self.left_out, |column, _| {
            let parts = gradient.component_mul(&self.directions.column(column));
            let sum = parts.sum();
            if sum.abs() > NOTHING * parts.abs().sum() { sum } else { 0.0 }
        })
    }

    /// All multipliers one unit away.
    pub(super) fn elsewhere(&self) -> Substitution {
        let mut away = Substitution::default();
        for symbol in &self.symbols {
            away.insert(symbol.clone(), Expr::from(symbol.clone()) + 1 * Unit(symbol.dimension));
        }
        away
    }

    /// What bounds the directions, from forces of which each friction is what it can be.
    pub(super) fn limits(&self, found: &DVector<f64>, friction: &DVector<f64>) -> Limits {
        let kept = self.symbols.len() - self.left_out;
        let shift = self.shared(found);
        let forces = found + &self.directions * &shift;
        // What is left out pushes from nothing on; all else both ways.
        let both_ways = (0..self.left_out).filter(|column| !self.is_contact[kept + column]);
        let ways: Vec<(usize, f64)> = (0..self.left_out)
            .map(|column| (column, 1.0))
            .chain(both_ways.map(|column| (column, -1.0)))
            .collect();
        let along = |parts: &[(usize, f64)]| {
            let of_way = |(column, sign): &(usize, f64)| -> f64 {
                parts.iter().map(|(row, part)| -sign * part * self.directions[(*row, *column)]).sum()
            };
            let left: f64 = parts.iter().map(|(row, part)| part * forces[*row]).sum();
            (DVector::from_iterator(ways.len(), ways.iter().map(of_way)), left)
        };
        let pushes = (0..kept).filter(|row| self.is_contact[*row]).map(|row| along(&[(row, 1.0)]));
        let cones = self.cones.iter().zip(friction).flat_map(|(cone, most)| {
            [1.0, -1.0].map(|way| along(&[(cone.normal, *most), (cone.along, way)]))
        });
        let size = NOTHING * forces.amax();
        // What is beyond a limit already is not bounded by it.
        let bounds: Vec<(DVector<f64>, f64)> =
            pushes.chain(cones).filter(|(_, left)| *left >= -size).collect();
        Limits {
            a: DMatrix::from_fn(bounds.len(), ways.len(), |bound, way| bounds[bound].0[way]),
            b: DVector::from_fn(bounds.len(), |bound, _| bounds[bound].1.max(0.0)),
            ways,
            shift,
        }
    }

    /// Along the directions, the way to where points that slip alike share their friction as their normal forces are: the equations give
    /// all of it to one.
    fn shared(&self, found: &DVector<f64>) -> DVector<f64> {
        let kept = self.symbols.len() - self.left_out;
        let mut shift = DVector::zeros(self.left_out);
        for cone in self.cones.iter().filter(|cone| cone.along >= kept && cone.follows) {
            let alike = || self.cones.iter().filter(|other| other.patch == cone.patch);
            let [all, along] = [
                alike().map(|other| found[other.normal]).sum::<f64>(),
                alike().map(|other| found[other.along]).sum(),
            ];
            if all > 0.0 {
                shift[cone.along - kept] = along * found[cone.normal] / all;
            }
        }
        shift
    }
}

/// How far multipliers may go along the directions: `A x <= b`, with x how far each of some ways, none of them negative.
pub(super) struct Limits {
    a: DMatrix<f64>,
    b: DVector<f64>,
    /// Direction and sign.
    ways: Vec<(usize, f64)>,
    /// Where they are measured from.
    shift: DVector<f64>,
}

impl Limits {
    /// How far a quantity of these slopes can grow.
    pub(super) fn farthest(&self, slopes: &DVector<f64>) -> f64 {
        let d = DVector::from_fn(self.ways.len(), |way, _| self.ways[way].1 * slopes[self.ways[way].0]);
        slopes.dot(&self.shift) + greatest(&d, &self.a, &self.b)
    }
}

/// Of columns of unit length, `e_k - sum c_i e_i` for each of the last ones that is the sum of the first `kept`, and of those of the last
/// before it that are not, with the parts c; zero where it is not.
pub(super) fn shares(columns: &DMatrix<f64>, kept: usize) -> DMatrix<f64> {
    let left_out = columns.ncols() - kept;
    let mut found = DMatrix::zeros(columns.ncols(), left_out);
    let mut known: Vec<usize> = (0..kept).collect();
    for column in 0..left_out {
        let (own, basis) = (columns.column(kept + column).into_owned(), columns.select_columns(&known));
        let parts = (!known.is_empty()).then(|| basis.clone().svd(true, true));
        let solved = parts.and_then(|parts| parts.solve(&own, NOTHING).ok());
        let sum = solved.unwrap_or_else(|| DVector::zeros(known.len()));
        if (&own - &basis * &sum).norm() > FOLLOWS * own.norm() {
            known.push(kept + column);
            continue;
        }
        for (place, part) in known.iter().zip(&sum) {
            found[(*place, column)] = if part.abs() <= NOTHING { 0.0 } else { -part };
        }
        found[(kept + column, column)] = 1.0;
    }
    found
}
