//! Events that a user declares: a formula of the motion crosses zero.

use tumble_expr::Expr;
use tumble_ode::Direction;

/// Something that happens each time a formula crosses zero.
#[derive(Clone, Debug)]
pub struct Event {
    /// Its name.
    pub name: String,
    /// The formula, of any dimension; it may hold any state, and the time.
    pub when: Expr,
    /// Which crossings count.
    pub direction: Direction,
    /// What follows.
    pub action: Action,
}

/// What an event does.
#[derive(Clone, Debug)]
pub enum Action {
    /// Its time and the states are recorded, nothing else.
    Record,
    /// The motion ends.
    Stop,
    /// Parameters get other values from then on, formulas of the parameters as they were at the start.
    ///
    /// A parameter that is defined by a changed one keeps its own value.
    Set(Vec<(String, Expr)>),
}

impl Event {
    /// The parameters that it sets, with their new formulas.
    pub(crate) fn settings(&self) -> &[(String, Expr)] {
        match &self.action {
            Action::Set(settings) => settings,
            Action::Record | Action::Stop => &[],
        }
    }
}
