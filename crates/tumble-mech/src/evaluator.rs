//! Formulas of the motion as numbers, in the states of a mode.

use std::sync::Arc;

use tumble_expr::{Branches, Expr, Formulas, Jets, Layout, Rounding, Tape};
use tumble_ode::{MotionState, Piece, Reason};

use crate::cache::Cache;
use crate::equations::Equations;
use crate::link::{Linking, Nodes};
use crate::mode::Mode;
use crate::parameters::time_symbol;

/// How far inside a piece its branches are looked at for its ends, in parts of its length.
const INSIDE: f64 = 1.0 / 1_048_576.0;

/// Evaluates formulas at a place of the motion.
pub(crate) fn evaluate(jets: &mut Jets<f64>, place: &MotionState<'_>) {
    evaluate_in(jets, place.piece, place.time, &place.states);
}

/// The same at states of a piece, where there is one.
///
/// At the ends of a piece a branch may stand at zero: it has the sign that it has within the piece.
pub(crate) fn evaluate_in(jets: &mut Jets<f64>, piece: Option<&Piece>, time: f64, states: &[f64]) {
    let inside = piece.filter(|_| jets.tape().sides() > 0).and_then(|piece| {
        let reach = INSIDE * piece.length;
        let s = match time {
            time if time == piece.start => reach,
            time if time == piece.end => piece.length - reach,
            _ => return None,
        };
        Some((piece.time_at(s), piece.states_at_parameter(s)))
    });
    match inside {
        None => jets.start(time, states, Branches::Free),
        Some((inner_time, inner_states)) => {
            jets.start(inner_time, &inner_states, Branches::Free);
            let signs = jets.signs().to_vec();
            jets.start(time, states, Branches::Frozen(&signs));
        }
    }
}

/// Tapes of formulas, by what they are compiled of.
pub(crate) type Tapes = Cache<(TapeKey, Rounding), Tape>;

/// What a tape of formulas depends on.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct TapeKey {
    mode: Mode,
    formulas: Formulas,
}

impl Equations {
    /// What formulas in the states of a mode run on.
    pub(crate) fn layout(&self, mode: &Mode) -> Layout {
        let inputs = self.model().parameters.symbols();
        Layout { rounding: self.rounding(), ..Layout::new(self.states(mode), time_symbol(), inputs) }
    }

    /// An evaluator of values of formulas of any kinematic symbols, accelerations and contact forces included.
    pub(crate) fn evaluator(
        &self,
        mode: &Mode,
        formulas: &[Expr],
        inputs: &[f64],
    ) -> Result<Jets<f64>, Reason> {
        self.expander(mode, formulas, inputs, 0)
    }

    /// The same for their Taylor coefficients up to an order.
    pub(crate) fn expander(
        &self,
        mode: &Mode,
        formulas: &[Expr],
        inputs: &[f64],
        order: usize,
    ) -> Result<Jets<f64>, Reason> {
        Ok(Jets::new(self.motion_tape(mode, formulas)?, order, inputs))
    }

    /// The tape of formulas of any kinematic symbols.
    pub(crate) fn motion_tape(&self, mode: &Mode, formulas: &[Expr]) -> Result<Arc<Tape>, Reason> {
        if let Some(twin) = self.twin(mode) {
            let formulas: Vec<Expr> = formulas.iter().map(|formula| twin.renamed(formula)).collect();
            return self.motion_tape(&twin.mode(mode), &formulas);
        }
        let key = TapeKey { mode: mode.clone(), formulas: Formulas::new(formulas) };
        self.built().tapes.get_rounded(key, self.rounding(), |key| self.link(key), Tape::rounded)
    }

    /// Linked with what the formulas need of the mode, and nothing else.
    fn link(&self, key: &TapeKey) -> Result<Tape, Reason> {
        let layout = Layout { rounding: Rounding::NEAREST, ..self.layout(&key.mode) };
        let mut linking = Linking::new(self, &key.mode, Nodes::default());
        let outputs = linking.formulas(key.formulas.list());
        Ok(linking.into_algebra().linker()?.tape(&layout, &outputs)?)
    }

    /// Values of such formulas at one instant.
    pub(crate) fn values(
        &self,
        formulas: &[Expr],
        mode: &Mode,
        time: f64,
        states: &[f64],
        inputs: &[f64],
    ) -> Result<Vec<f64>, Reason> {
        let mut jets = self.evaluator(mode, formulas, inputs)?;
        jets.start(time, states, Branches::Free);
        Ok((0..formulas.len()).map(|index| jets.value_of(index)).collect())
    }
}
