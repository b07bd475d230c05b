//! The forces of a pair by name, on both of its bodies, and the conditions that they keep.

use tumble_expr::{Dimension, Expr, Symbol, Vector, Written};

use super::{NORMAL, Pair, TANGENT};
use crate::coordinates::Measure;
use crate::row::{Row, Wrench};
use crate::statement::Statement;
use crate::term::{Law, Term};

impl Pair {
    /// Stands for the force along the surface, N, or for a couple against rolling over its lever, the radius of what rolls.
    pub fn friction_symbol(&self) -> Symbol {
        let what = if self.is_rolling() { "rolling_force" } else { "friction" };
        Symbol::new(format!("{}.{what}", self.name), Dimension::FORCE)
    }

    /// Stands for the force along the normal, N.
    pub fn force_symbol(&self) -> Symbol {
        Symbol::new(format!("{}.normal", self.name), Dimension::FORCE)
    }

    /// Stands for the root of the depth, m^(1/2), a state while a Hertzian contact is pressed.
    pub(crate) fn root_symbol(&self) -> Symbol {
        let dimension = Dimension::LENGTH.power(tumble_expr::Exponent::new(1, 2));
        Symbol::new(format!("{}.root", self.name), dimension.unwrap_or(Dimension::NONE))
    }

    /// The force on the body.
    pub(crate) fn term(&self) -> Term {
        self.pushed(&self.force_symbol().into())
    }

    /// A force on the body along the normal, N.
    fn pushed(&self, force: &Expr) -> Term {
        Term {
            load: self.name.clone(),
            law: Law::Contact,
            body: self.body,
            arm: self.arm(),
            force: force * &self.normal,
            couple: Expr::zero(),
            window: None,
        }
    }

    /// The forces on both bodies.
    pub(crate) fn terms(&self) -> Vec<Term> {
        self.pushed_by(&self.force_symbol().into())
    }

    /// A force on both bodies along the normal, N.
    pub(crate) fn pushed_by(&self, force: &Expr) -> Vec<Term> {
        self.on_both(self.pushed(force), Self::arm_of)
    }

    /// The friction on the body.
    fn friction_term(&self) -> Term {
        let force: Expr = self.friction_symbol().into();
        if let Some(lever) = &self.lever {
            let nothing = Vector::planar(Expr::zero(), Expr::zero());
            let load = format!("{}.rolling", self.name);
            return Term { load, law: Law::Rolling, force: nothing, couple: lever * force, ..self.term() };
        }
        Term {
            load: format!("{}.friction", self.name),
            law: Law::Friction,
            arm: self.slip_arm(),
            force: &force * &self.tangent(),
            ..self.term()
        }
    }

    /// The friction on both bodies.
    pub(crate) fn friction_terms(&self) -> Vec<Term> {
        self.on_both(self.friction_term(), Self::slip_arm_of)
    }

    fn on_both(&self, own: Term, arm: fn(&Self, usize) -> Vector) -> Vec<Term> {
        let other = self.other.map(|body| Term {
            body,
            arm: arm(self, body),
            force: -&own.force,
            couple: -&own.couple,
            ..own.clone()
        });
        std::iter::once(own).chain(other).collect()
    }

    /// `N n`; what N is follows from other loads where the surface is rigid.
    pub(crate) fn statement(&self) -> Statement {
        along(&self.term(), self.force_symbol(), NORMAL, &self.normal)
    }

    /// `f e_t`, where there is friction.
    pub(crate) fn friction_statement(&self) -> Option<Statement> {
        let rubs = || along(&self.friction_term(), self.friction_symbol(), TANGENT, &self.tangent());
        (self.friction.is_some() && !self.is_rolling()).then(rubs)
    }

    /// The condition that it does not slip. How far it has slipped before is nothing to it: it has a rate only.
    pub(crate) fn slip_row(&self) -> Row {
        Row {
            multiplier: self.friction_symbol(),
            wrenches: self
                .turning_wrenches()
                .unwrap_or_else(|| self.wrenches(&self.tangent(), Self::slip_arm_of)),
            position: Expr::zero(),
            rate: self.slip_rate(),
            acceleration: self.slip_acceleration(),
            measure: Measure::Length,
        }
    }

    /// The condition that the gap stays closed.
    pub(crate) fn row(&self) -> Row {
        Row {
            multiplier: self.force_symbol(),
            wrenches: self.wrenches(&self.normal, Self::arm_of),
            position: self.closing(),
            rate: self.gap_rate(),
            acceleration: self.gap_acceleration(),
            measure: Measure::Length,
        }
    }

    /// Of what resists rolling.
    fn turning_wrenches(&self) -> Option<Vec<Wrench>> {
        let lever = self.lever.as_ref()?;
        let force = || Vector::planar(Expr::zero(), Expr::zero());
        let wrench =
            |(body, sign)| Wrench { body, arm: self.arm_of(body), force: force(), couple: sign * lever };
        Some(self.sides().map(wrench).collect())
    }

    fn wrenches(&self, direction: &Vector, arm: fn(&Self, usize) -> Vector) -> Vec<Wrench> {
        let wrench = |(body, sign)| Wrench {
            body,
            arm: arm(self, body),
            force: if sign < 0 { -direction } else { direction.clone() },
            couple: Expr::zero(),
        };
        self.sides().map(wrench).collect()
    }
}

/// A force along a unit vector.
fn along(term: &Term, force: Symbol, name: &str, unit: &Vector) -> Statement {
    let unit = Written::named(name, Written::Vector(unit.clone()));
    Statement::of(term, Written::Product(vec![Written::Scalar(force.into()), unit]))
}
