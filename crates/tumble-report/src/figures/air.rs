//! The air about a body, for its diagrams: the wind past a point, and the row of forces along a line, read from what the laws say.

use tumble_drawing::free_body::{DistributedForce, Velocity};
use tumble_expr::language::Value;
use tumble_expr::{Expr, Substitution, Symbol, Vector, Written};
use tumble_mech::{Run, Statement};
use tumble_ode::Side;

use crate::figures::free_bodies::kind;
use crate::results::CaseError;

/// Arrows of a row.
const ROW: u32 = 11;

/// What the law of a load says at that time.
pub(crate) fn stated(run: &Run, body: usize, load: &str, time: f64) -> Option<Statement> {
    let part = run.of_body(body);
    let trajectory = part.trajectory();
    let mode = trajectory.modes.get(trajectory.piece_at(time, Side::After)?.mode)?;
    let mut all = run.equations.shown_statements(mode).into_iter();
    all.find(|stated| stated.body == body && stated.load == load)
}

/// The velocity of the air past the one point where it acts.
pub(crate) fn wind(
    run: &Run,
    stated: &Statement,
    point: [f64; 2],
    time: f64,
) -> Result<Option<Velocity>, CaseError> {
    let Some(Value::Vector(u)) =
        stated.force.as_ref().and_then(|law| named(law, "u")).and_then(|u| u.value(1))
    else {
        return Ok(None);
    };
    let at = run.observe(u.components())?.at(time, Side::After);
    Ok(at.map(|at| Velocity::new("u", point, [at[0], at[1]])))
}

/// The forces along every line on which the air acts, about a centre of mass.
pub(crate) fn spreads(
    run: &Run,
    stated: &Statement,
    centre: [f64; 2],
    time: f64,
) -> Result<Vec<DistributedForce>, CaseError> {
    let mut found = vec![];
    for line in stated.torque.iter().flat_map(lines) {
        let formulas: Vec<Expr> = (0..ROW).flat_map(|index| line.at(index)).collect();
        let Some(values) = run.observe(&formulas)?.at(time, Side::After) else { continue };
        let arrow = |v: &[f64]| [[centre[0] + v[0], centre[1] + v[1]], [v[2], v[3]]];
        found.push(DistributedForce {
            kind: kind(stated.law),
            arrows: values.chunks_exact(4).map(arrow).collect(),
        });
    }
    Ok(found)
}

/// A force along a line, by the place on it.
struct Line<'a> {
    arm: Vector,
    density: Vector,
    over: &'a Symbol,
    limits: &'a [Expr; 2],
}

impl Line<'_> {
    /// Arm and force per length at one of the places of a row.
    fn at(&self, index: u32) -> [Expr; 4] {
        let [from, to] = self.limits;
        let mut here = Substitution::default();
        here.insert(
            self.over.clone(),
            from + Expr::from(f64::from(index) / f64::from(ROW - 1)) * (to - from),
        );
        [self.arm.x(), self.arm.y(), self.density.x(), self.density.y()].map(|formula| here.apply(formula))
    }
}

/// The lines whose torque is an integral of the arm times the force.
fn lines(torque: &Written) -> Vec<Line<'_>> {
    match torque {
        Written::Sum(terms) => terms.iter().flat_map(|(_, term)| lines(term)).collect(),
        Written::Name(named) => lines(&named.is),
        Written::Integral { of, over, limits } => match &**of {
            Written::Cross(pair) => match (pair[0].value(1), pair[1].value(1)) {
                (Some(Value::Vector(arm)), Some(Value::Vector(density))) => {
                    vec![Line { arm, density, over, limits }]
                }
                _ => vec![],
            },
            _ => vec![],
        },
        _ => vec![],
    }
}

/// What a name stands for in what a law says.
pub(crate) fn named<'a>(written: &'a Written, name: &str) -> Option<&'a Written> {
    match written {
        Written::Name(known) if known.name == name => Some(&known.is),
        Written::Name(other) => named(&other.is, name),
        Written::Sum(terms) => terms.iter().find_map(|(_, term)| named(term, name)),
        Written::Product(factors) => factors.iter().find_map(|factor| named(factor, name)),
        Written::Norm(of) => named(of, name),
        Written::Dot(pair) | Written::Cross(pair) => pair.iter().find_map(|part| named(part, name)),
        Written::Integral { .. } | Written::Scalar(_) | Written::Vector(_) => None,
    }
}
