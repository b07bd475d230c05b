//! Energies that forces come from: while the bodies move, the work of the forces is what the energy loses. All else that a load
//! does, a damper's part, is work. So is all of it where a coefficient depends on the motion.

use tumble_expr::Expr;

use crate::equations::Equations;
use crate::interaction::Bodies;
use crate::laws::{compliant, weight};
use crate::parameters::time_symbol;
use crate::term::{Law, Term};

/// A potential energy with the forces it stands for, in kinematic symbols.
#[derive(Clone, Debug)]
pub struct Potential {
    /// Name of the load.
    pub load: String,
    /// The law it follows.
    pub law: Law,
    /// Index of the body; `None` for a spring, which may belong to two.
    pub body: Option<usize>,
    /// Index of the pair, for which it is there only while pressed.
    pub pair: Option<usize>,
    /// J
    pub energy: Expr,
    /// Rate of the energy with the bodies held, W: of an anchor, a surface or a coefficient that is moved in time.
    pub driven: Expr,
    /// Its part of each of the load's terms, in their order.
    pub elastic: Vec<Term>,
    /// Whether that is all of the terms.
    pub is_whole: bool,
    /// Its coefficients: formulas of the parameters and the time, or there is no such energy.
    pub given: Vec<Expr>,
}

impl Potential {
    /// An energy, J, that one term on one body comes from.
    pub fn of(energy: Expr, elastic: Term, given: Vec<Expr>) -> Self {
        Self {
            load: elastic.load.clone(),
            law: elastic.law,
            body: Some(elastic.body),
            pair: None,
            driven: energy.derivative(&time_symbol()),
            energy,
            elastic: vec![elastic],
            is_whole: true,
            given,
        }
    }
}

impl Equations {
    /// Every potential energy of the model.
    pub(crate) fn potentials(&self) -> Vec<Potential> {
        let model = self.model();
        let mut known = model.parameters.symbols();
        known.push(time_symbol());
        let is_given = |potential: &Potential| {
            potential.given.iter().flat_map(Expr::symbols).all(|symbol| known.contains(&symbol))
        };
        let weights = model.bodies.iter().enumerate();
        let weights = weights.filter_map(|body| weight::potential(body, &model.gravity));
        let bodies = Bodies::of(model);
        let interactions = model.interactions.iter().filter_map(|known| known.potential(&bodies));
        let pairs = self.pairs().iter().enumerate().filter_map(compliant::potential);
        weights.chain(interactions).chain(pairs).filter(is_given).collect()
    }
}
