//! What rates are off by where numbers are rounded in another way.

use tumble_expr::{Branches, Drawn, Jets, Rounding, Scalar, is_short};

use super::Engine;

/// Rates with one of the errors that rounding may have made, and room for what they are evaluated at.
pub(crate) struct Off {
    jets: Jets<Drawn>,
    leaves: Vec<Drawn>,
    signs: Vec<Drawn>,
}

impl Engine {
    /// Finds what each rate is off by: what rounding makes of a state or of an operation is one for all rates that follow from it, so that
    /// friction is off as what presses is.
    pub(crate) fn watch_off(
        &mut self,
        off: &mut Vec<f64>,
        rounding: Rounding,
        (time, states, compensation): (f64, &[f64], &[f64]),
    ) {
        let Off { jets, leaves, signs } = &mut **self.off.get_or_insert_with(|| {
            let inputs: Vec<Drawn> = self.inputs.iter().map(|value| Drawn::splat(*value)).collect();
            let jets = Jets::new(self.system.tape.clone(), 0, &inputs);
            Box::new(Off { jets, leaves: vec![], signs: vec![] })
        });
        let leaf = |(state, (value, left_out)): (usize, (&f64, &f64))| {
            Drawn::rounded(*value, *left_out == 0.0 && is_short(*value), rounding, state as u64)
        };
        leaves.clear();
        leaves.extend(states.iter().zip(compensation).enumerate().map(leaf));
        signs.clear();
        signs.extend(self.branch_signs.signs.iter().map(|sign| Drawn::splat(*sign)));
        jets.start(Drawn::splat(time), leaves, Branches::Frozen(signs));
        let rates = (0..states.len()).map(|state| jets.value_of(state).off());
        off.extend(rates.map(|off| if off.is_finite() { off } else { 0.0 }));
    }
}
