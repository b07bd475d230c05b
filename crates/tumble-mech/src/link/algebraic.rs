//! Forces that loads read otherwise than linearly, as states: see [`crate::algebraic`].

use std::collections::HashMap;
use std::convert::Infallible;
use std::sync::Arc;

use tumble_expr::{Binary, Expr, Tape, Unary};
use tumble_ode::{Invariant, Reason};

use super::algebra::{Algebra, Nodes, Written};
use super::island::Entries;
use super::linking::Linking;
use super::names::Name;
use crate::algebraic::Slopes;
use crate::contact::WEDGED;
use crate::coordinates::StateRate;
use crate::equations::Equations;
use crate::mode::Mode;

impl Equations {
    /// How those that a mode depends on change with its states.
    fn slopes(&self, mode: &Mode) -> Arc<Slopes> {
        let build = || {
            let own = self.implicit(mode);
            let mut linking = Linking::new(self, mode, Written);
            let forces: Vec<Expr> = own.iter().map(|index| linking.algebraic_force(*index)).collect();
            Ok::<_, Infallible>(Slopes::of(self, mode, &own, &forces))
        };
        self.built().slopes.get(mode, build).unwrap_or_else(|never| match never {})
    }

    /// What Newton's method is done with in a mode: the forces that it depends on, then row by row what a unit of the state of each does to
    /// them.
    pub(crate) fn residuals(&self, mode: &Mode) -> Result<Arc<Tape>, Reason> {
        let build = |mode: &Mode| {
            let layout =
                tumble_expr::Layout { rounding: tumble_expr::Rounding::NEAREST, ..self.layout(mode) };
            let mut linking = Linking::new(self, mode, Nodes::default());
            let own = self.implicit(mode);
            let mut outputs: Vec<_> = own.iter().map(|index| linking.algebraic_force(*index)).collect();
            let among = self.slopes(mode).among.concat();
            outputs.extend(linking.in_leaves(&among));
            Ok::<_, Reason>(linking.into_algebra().linker()?.tape(&layout, &outputs)?)
        };
        self.built().residuals.get_rounded(mode.clone(), self.rounding(), build, Tape::rounded)
    }
}

impl<A: Algebra> Linking<'_, A> {
    fn algebraic_force(&mut self, index: usize) -> A::Value {
        let force = &self.equations.algebraic()[index].force;
        self.formula(&force.clone().into())
    }

    /// Formulas in the states and in the parameters as they were at the start.
    fn in_leaves(&mut self, formulas: &[Expr]) -> Vec<A::Value> {
        let piece = self.equations.written_piece(formulas);
        let imports: Vec<_> = piece.imports().map(|import| self.algebra.leaf(&import.symbol)).collect();
        self.algebra.link(&piece, &imports)
    }

    /// The rate of one: all are found together.
    pub(super) fn rate_of_algebraic(&mut self, index: usize) -> A::Value {
        let own = self.equations.implicit(self.mode);
        let Some(place) = own.iter().position(|known| *known == index) else { return self.algebra.zero() };
        let slopes = self.equations.slopes(self.mode);
        let right: Vec<_> = (0..own.len()).map(|row| self.change(&slopes, row)).collect();
        let matrix = self.left_alone(&slopes);
        let found = self.solved(matrix, right);
        let names: Vec<Name> = own
            .iter()
            .filter_map(|known| self.names.find(&self.equations.algebraic()[*known].rate))
            .collect();
        names.into_iter().zip(&found).for_each(|(name, value)| self.settle(name, value.clone()));
        found[place].clone()
    }

    /// How fast a force changes where the states of all these forces stand still.
    fn change(&mut self, slopes: &Slopes, row: usize) -> A::Value {
        let by_state = &slopes.by_state[row];
        let (roots, others): (Vec<_>, Vec<_>) = by_state.iter().partition(|(_, state)| state.per_parameter);
        let by_time = self.in_leaves(std::slice::from_ref(&slopes.by_time[row])).remove(0);
        let change = others.into_iter().fold(by_time, |sum, slope| self.plus_slope(sum, slope));
        let change = match self.time_transformation() {
            Some(whole) => self.algebra.binary(Binary::Mul, whole, change),
            None => change,
        };
        roots.into_iter().fold(change, |sum, slope| self.plus_slope(sum, slope))
    }

    fn plus_slope(&mut self, sum: A::Value, (slope, state): &(Expr, StateRate)) -> A::Value {
        let slope = self.in_leaves(std::slice::from_ref(slope)).remove(0);
        let rate = self.formula(&state.rate);
        let product = self.algebra.binary(Binary::Mul, slope, rate);
        self.algebra.binary(Binary::Add, sum, product)
    }

    /// `1 - d lambda/d z`
    fn left_alone(&mut self, slopes: &Slopes) -> Entries<A::Value> {
        let one = self.formula(&Expr::one());
        let rows = slopes.among.iter().map(|row| self.in_leaves(row)).collect::<Vec<_>>();
        let rows = rows.into_iter().enumerate();
        let row = |(place, row): (usize, Vec<A::Value>)| {
            let entry = |(column, slope)| {
                let less = self.algebra.unary(Unary::Neg, slope);
                let entry =
                    if column == place { self.algebra.binary(Binary::Add, one.clone(), less) } else { less };
                (column, entry)
            };
            row.into_iter().enumerate().map(entry).collect()
        };
        rows.map(row).collect()
    }

    /// That their states are the forces; only these states are moved for it.
    pub(super) fn algebraic_invariants(&mut self, places: &HashMap<Name, usize>) -> Vec<Invariant<A::Value>> {
        let own = self.equations.implicit(self.mode);
        let matrix = if own.is_empty() { vec![] } else { self.left_alone(&self.equations.slopes(self.mode)) };
        let states: Vec<_> = own.iter().map(|index| &self.equations.algebraic()[*index]).collect();
        let place = |column: &usize| places.get(&self.names.find(&states[*column].state)?).copied();
        let slopes: Vec<Vec<(usize, A::Value)>> = matrix
            .iter()
            .map(|row| {
                row.iter().filter_map(|(column, slope)| Some((place(column)?, slope.clone()))).collect()
            })
            .collect();
        let mut found = vec![];
        for ((index, state), slopes) in own.iter().zip(&states).zip(slopes) {
            let leaf = self.algebra.leaf(&state.state);
            let force = self.algebraic_force(*index);
            let formula = self.algebra.binary(Binary::Sub, leaf, force);
            found.push(Invariant { formula, slopes, group: state.measure() as usize, follows: true });
        }
        found
    }

    /// What becomes zero where one of them is determined no more.
    pub(super) fn too_steep(&mut self) -> Vec<(String, A::Value)> {
        let own = self.equations.implicit(self.mode);
        if own.is_empty() {
            return vec![];
        }
        let (slopes, one) = (self.equations.slopes(self.mode), self.formula(&Expr::one()));
        let least = self.formula(&Expr::from(WEDGED));
        let mut found = vec![];
        for (place, index) in own.iter().enumerate() {
            let matrix = self.left_alone(&slopes);
            let mut right = vec![self.algebra.zero(); own.len()];
            right[place] = one.clone();
            let unit = self.solved(matrix, right).swap_remove(place);
            let left = self.algebra.binary(Binary::Div, one.clone(), unit);
            let left = self.algebra.binary(Binary::Sub, left, least.clone());
            found.push((format!("{}.feedback", self.equations.algebraic()[*index].force.name), left));
        }
        found
    }
}
