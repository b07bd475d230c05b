//! What rates are off by where numbers are rounded in another way.

use tumble_expr::{Branches, Drawn, Jets, Rounding, Scalar, is_short};

use super::Engine;

impl Engine {
    /// Finds what each rate is off by: what rounding makes of a state or of an operation is one for all rates that follow from it, so that
    /// friction is off as what presses is.
    pub(crate) fn watch_off(
        &mut self,
        off: &mut Vec<f64>,
        rounding: Rounding,
        (time, states, compensation): (f64, &[f64], &[f64]),
    ) {
        let drawn = self.drawn.get_or_insert_with(|| {
            let inputs: Vec<Drawn> = self.inputs.iter().map(|value| Drawn::splat(*value)).collect();
            Box::new(Jets::new(self.system.tape.clone(), 0, &inputs))
        });
        let leaf =
            |(state, (value, left_out)): (usize, (&f64, &f64))| match *left_out == 0.0 && is_short(*value) {
                true => Drawn::splat(*value),
                false => Drawn::off_by(*value, rounding.draw(*value, state as u64)),
            };
        let leaves: Vec<Drawn> = states.iter().zip(compensation).enumerate().map(leaf).collect();
        let signs: Vec<Drawn> = self.branch_signs.signs.iter().map(|sign| Drawn::splat(*sign)).collect();
        drawn.start(Drawn::splat(time), &leaves, Branches::Frozen(&signs));
        let rates = (0..states.len()).map(|state| drawn.value_of(state).off());
        off.extend(rates.map(|off| if off.is_finite() { off } else { 0.0 }));
    }
}
