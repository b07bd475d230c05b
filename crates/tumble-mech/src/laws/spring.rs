//! # Law
//! A spring and a damper between two points a and b at the distance d along the unit vector e from a to b: the force on
//! a is `(k (d - d_0) + c d') e`, on b the opposite, with `d' = (v_b - v_a) . e`. The spring's part has the energy
//! `V = k (d - d_0)^2 / 2`.
//! # Symbols and units
//! k stiffness (N/m), d_0 rest length (m), c damping (kg/s), V (J).
//! # Sign and frame
//! World axes; a stretched spring pulls.
//! # Validity
//! Any length but zero, where e has no direction; a spring without rest length and damping, `k (p_b - p_a)`, may pass
//! through zero. One end may be a place of the world that moves on a given path.
//! # Source
//! Hooke's law.
//! # Checked by
//! `tests/springs.rs` (oscillators against closed forms, two bodies, a shaken anchor); energy in `tests/balance.rs`.

use tumble_expr::{Dimension, Expr, Vector, Written, is_identically_zero};

use crate::anchor::Anchor;
use crate::interaction::{Bodies, Interaction};
use crate::potential::Potential;
use crate::statement::{Statement, sum, times};
use crate::term::{Law, Term};

/// A spring, a damper, or both side by side.
#[derive(Clone, Debug)]
pub struct Spring {
    /// Its name.
    pub name: String,
    /// Its ends; at least one belongs to a body.
    pub ends: [Anchor; 2],
    /// N/m; zero for a damper.
    pub stiffness: Expr,
    /// m
    pub rest_length: Expr,
    /// kg/s; zero for a spring.
    pub damping: Expr,
}

impl Spring {
    /// From the first end to the second, m.
    fn span(&self) -> Vector {
        let [a, b] = &self.ends;
        b.position() - a.position()
    }

    /// Force on the first end.
    fn force(&self) -> Vector {
        let [a, b] = &self.ends;
        let span = self.span();
        if self.rest_length.is_zero() && self.damping.is_zero() {
            return &self.stiffness * span;
        }
        let distance = span.norm();
        let stretched = &self.stiffness * (&distance - &self.rest_length) / &distance;
        let mut pull = stretched * &span;
        if !self.damping.is_zero() {
            let relative = b.velocity() - a.velocity();
            let closing = relative.x() * span.x() + relative.y() * span.y();
            pull = pull + (&self.damping * closing / (&distance * &distance)) * &span;
        }
        pull
    }

    /// `k (|d| - d_0) d/|d| + c ...` on the first end, with d from it to the second.
    fn said(&self) -> Written {
        let [a, b] = &self.ends;
        let span = Written::named("d", Written::Vector(self.span()));
        if self.rest_length.is_zero() && self.damping.is_zero() {
            return times(&self.stiffness, vec![span]);
        }
        let inverse = Written::Scalar(1 / self.span().norm());
        let along = Written::named("e", Written::Product(vec![inverse, span.clone()]));
        let mut pulls = vec![];
        if !is_identically_zero(&self.stiffness) {
            let longer = match self.rest_length.is_zero() {
                true => span.norm(),
                false => span.norm().less(Written::Scalar(self.rest_length.clone())),
            };
            pulls.push(times(&self.stiffness, vec![longer]));
        }
        if !is_identically_zero(&self.damping) {
            let rate = Written::named("v", Written::Vector(b.velocity() - a.velocity()));
            pulls.push(times(&self.damping, vec![rate.dot(along.clone())]));
        }
        Written::Product(vec![sum(pulls), along])
    }

    /// Energy, J.
    fn energy(&self) -> Expr {
        let span = self.span();
        let squared = match self.rest_length.is_zero() {
            true => span.x() * span.x() + span.y() * span.y(),
            false => {
                let longer = span.norm() - &self.rest_length;
                &longer * &longer
            }
        };
        &self.stiffness * squared / 2
    }
}

impl Interaction for Spring {
    fn name(&self) -> &str {
        &self.name
    }

    fn terms(&self, bodies: &Bodies<'_>) -> Vec<Term> {
        let pull = self.force();
        let on_end = |(end, force): (&Anchor, Vector)| match end {
            Anchor::World(_) => None,
            Anchor::Material(point) => {
                let (body, arm) = (&point.body.body, point.world_arm());
                Some(bodies.term(&self.name, Law::Spring, body, arm, force, Expr::zero()))
            }
        };
        self.ends.iter().zip([pull.clone(), -&pull]).filter_map(on_end).collect()
    }

    fn statements(&self, bodies: &Bodies<'_>) -> Vec<Statement> {
        let force = self.said();
        let on_end = |(index, term): (usize, &Term)| {
            let is_second = self.ends[0].body().is_none() || index == 1;
            let force = if is_second { force.clone().negative() } else { force.clone() };
            Statement::of(term, force)
        };
        self.terms(bodies).iter().enumerate().map(on_end).collect()
    }

    fn potential(&self, bodies: &Bodies<'_>) -> Option<Potential> {
        let energy = Some(self.energy()).filter(|energy| !is_identically_zero(energy))?;
        let elastic = Self { damping: Expr::zero(), ..self.clone() }.terms(bodies);
        let places = self.ends.iter().flat_map(Anchor::places);
        let given = [&self.stiffness, &self.rest_length].into_iter().chain(places).cloned().collect();
        let is_whole = is_identically_zero(&self.damping);
        let first = elastic.first()?.clone();
        Some(Potential { body: None, elastic, is_whole, ..Potential::of(energy, first, given) })
    }

    fn ends(&self) -> Option<[Vector; 2]> {
        Some(self.ends.each_ref().map(Anchor::position))
    }

    fn bodies(&self) -> Vec<&str> {
        self.ends.iter().filter_map(Anchor::body).collect()
    }

    fn dimensions(&self) -> Vec<(&'static str, Expr, Dimension)> {
        let places =
            self.ends.iter().flat_map(Anchor::places).map(|place| ("end", place.clone(), Dimension::LENGTH));
        let own = [
            ("stiffness", self.stiffness.clone(), Dimension::new(0, 1, -2)),
            ("rest length", self.rest_length.clone(), Dimension::LENGTH),
            ("damping", self.damping.clone(), Dimension::new(0, 1, -1)),
        ];
        own.into_iter().chain(places).collect()
    }

    fn nonnegative(&self) -> Vec<(&'static str, Expr, &'static str)> {
        vec![
            ("stiffness", self.stiffness.clone(), "N/m"),
            ("rest length", self.rest_length.clone(), "m"),
            ("damping", self.damping.clone(), "kg/s"),
        ]
    }
}
