//! Circles that bodies are within: where these are apart, nothing of the bodies touches.
//!
//! The circle of a body is about its centre of mass, or about its pivot, where that holds it.

use std::collections::{BTreeSet, HashSet};

use tumble_expr::{Expr, Interval};

use crate::contact::border::{Border, Rim};
use crate::coordinates::Pivot;
use crate::equations::Equations;
use crate::mode::Mode;

/// In parts of the radii: what rounding may have made them shorter by.
const MARGIN: f64 = 1e-9;

/// By body; of those that were asked about.
pub(crate) struct Circles(Vec<Option<Circle>>);

/// All of a body is within it.
struct Circle {
    /// Its centre where a pivot holds it, m; elsewhere it is the centre of mass.
    pivot: Option<[f64; 2]>,
    /// m
    radius: f64,
}

/// Where the circle of a body is, at an instant or within a stretch of time.
pub(crate) struct Surrounding {
    pub(crate) body: usize,
    x: Interval,
    y: Interval,
    radius: f64,
}

impl Surrounding {
    /// Whether this and another have no point in common.
    pub(crate) fn is_apart(&self, other: &Self) -> bool {
        let between = |a: Interval, b: Interval| (a.low - b.high).max(b.low - a.high).max(0.0);
        let [x, y] = [between(self.x, other.x), between(self.y, other.y)];
        let radii = (1.0 + MARGIN) * (self.radius + other.radius);
        x * x + y * y > radii * radii
    }
}

/// Two bodies, the lesser first.
pub(crate) fn ordered(a: usize, b: usize) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

/// Bodies of two lists that are not shown to be apart, of some that may meet.
pub(crate) fn meeting<'a>(
    some: &'a [Surrounding],
    others: &'a [Surrounding],
    meet: &'a HashSet<[usize; 2]>,
) -> impl Iterator<Item = [usize; 2]> + 'a {
    let both = some.iter().flat_map(move |one| others.iter().map(move |other| (one, other)));
    let near = both.filter(|(one, other)| !one.is_apart(other));
    near.map(|(one, other)| ordered(one.body, other.body)).filter(|bodies| meet.contains(bodies))
}

/// The same within one list.
pub(crate) fn meeting_within(all: &[Surrounding], meet: &HashSet<[usize; 2]>) -> HashSet<[usize; 2]> {
    let each = all.iter().enumerate();
    each.flat_map(|(index, one)| meeting(std::slice::from_ref(one), &all[index + 1..], meet)).collect()
}

impl Circles {
    /// Of some bodies, pivots being where they are at an instant.
    pub(crate) fn of(
        equations: &Equations,
        bodies: impl IntoIterator<Item = usize>,
        mode: &Mode,
        (time, states): (f64, &[f64]),
        inputs: &[f64],
    ) -> Self {
        let mut circles: Vec<Option<Circle>> = equations.model().bodies.iter().map(|_| None).collect();
        // In order: formulas that are the same are compiled once.
        let asked: BTreeSet<usize> = bodies.into_iter().collect();
        let (mut formulas, mut places) = (vec![], vec![]);
        for &body in &asked {
            circles[body] = Some(Circle { pivot: None, radius: f64::INFINITY });
            places.push(formulas.len());
            formulas.extend(circle(equations, body));
        }
        // What has no value is nowhere shown to be apart.
        let Ok(values) = equations.values(&formulas, mode, time, states, inputs) else {
            return Self(circles);
        };
        places.push(formulas.len());
        for (body, place) in asked.into_iter().zip(places.windows(2)) {
            let own = &values[place[0]..place[1]];
            circles[body] = Some(Circle { pivot: own.get(1..3).map(|at| [at[0], at[1]]), radius: own[0] });
        }
        Self(circles)
    }

    /// How many bodies there are.
    pub(crate) fn count(&self) -> usize {
        self.0.len()
    }

    /// Whether no body has one.
    pub(crate) fn is_empty(&self) -> bool {
        self.0.iter().all(Option::is_none)
    }

    /// Those of the bodies of a mode, by the ranges of its states.
    pub(crate) fn within(
        &self,
        equations: &Equations,
        mode: &Mode,
        range: impl Fn(usize) -> Interval,
    ) -> Vec<Surrounding> {
        let mut first = 0;
        let stretch = |body: &usize| {
            let own = first;
            first += equations.body_equations(*body).coordinates.count();
            let Circle { pivot, radius } = self.0[*body].as_ref()?;
            let [x, y] = pivot.map_or_else(|| [range(own), range(own + 1)], |at| at.map(Interval::point));
            Some(Surrounding { body: *body, x, y, radius: *radius })
        };
        mode.bodies.iter().filter_map(stretch).collect()
    }

    /// The same at an instant.
    pub(crate) fn at(&self, equations: &Equations, mode: &Mode, states: &[f64]) -> Vec<Surrounding> {
        self.within(equations, mode, |state| Interval::point(states[state]))
    }
}

/// The radius of a body's circle, m, and where its pivot is, if it has one.
fn circle(equations: &Equations, body: usize) -> Vec<Expr> {
    let known = &equations.model().bodies[body];
    let rims = Border::of_body(known).rims;
    let reach = |rim: &Rim| Some(&rim.point()?.arm.norm() + &rim.radius);
    let farthest = |far: Expr, next: Expr| Expr::binary(tumble_expr::Binary::Max, far, next);
    let reach = rims.iter().filter_map(reach).reduce(farthest).unwrap_or_else(Expr::zero);
    match equations.model().pivot_of(&known.name) {
        None => vec![reach],
        Some(Pivot { point, world, .. }) => {
            let lever = known.at(point).arm.norm();
            [vec![reach + lever], world.components().to_vec()].concat()
        }
    }
}
