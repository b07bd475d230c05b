//! # Law
//! Potential energies: of the weight `m g y`, of a spring `k (d - d_0)^2 / 2`, of a torsion spring
//! `kappa (theta - theta_0)^2 / 2`, of a compliant surface `k d^2 / 2` or, after Hertz, `(2/5) k d^(5/2)`. While the
//! bodies move, the force's work is what the energy loses; what an anchor, a surface or a coefficient that is moved in
//! time adds to it is `dV/dt` with the bodies held. All else that a load does, a damper's part, is work.
//! # Symbols and units
//! As in the laws of force; energies in J.
//! # Sign and frame
//! Zero at y = 0, and where a spring or surface exerts no force.
//! # Validity
//! Coefficients are formulas of the parameters and the time. If one depends on the motion there is no such energy, and
//! the load counts by its work.
//! # Source
//! Integrals of the laws of force.
//! # Checked by
//! `tests/balance.rs`.

use tumble_expr::{Expr, Vector, is_identically_zero};

use crate::anchor::Anchor;
use crate::contact::Pair;
use crate::equations::Equations;
use crate::interaction::{Bodies, Interaction};
use crate::kinematics::{Kinematics, PointRef};
use crate::laws;
use crate::laws::spring::Spring;
use crate::laws::torsion::Torsion;
use crate::model::{Gravity, Model};
use crate::parameters::time_symbol;
use crate::surface::ContactLaw;
use crate::term::{Law, Term};

/// An energy with the forces it stands for, in kinematic symbols.
pub(super) struct Potential {
    pub(super) load: String,
    pub(super) law: Law,
    pub(super) body: Option<usize>,
    /// Index of the pair, for which it is there only while pressed.
    pub(super) pair: Option<usize>,
    /// J
    pub(super) energy: Expr,
    /// Rate of the energy with the bodies held, W.
    pub(super) driven: Expr,
    /// Its part of each of the load's terms, in their order.
    pub(super) elastic: Vec<Term>,
    /// Whether that is all of the terms.
    pub(super) is_whole: bool,
}

/// Every potential energy of a model.
pub(super) fn potentials(equations: &Equations) -> Vec<Potential> {
    let model = equations.model();
    let weights = (0..model.bodies.len()).filter_map(|body| of_weight(equations, body));
    let interactions = model.interactions.iter().filter_map(|known| of_interaction(model, &**known));
    let pairs = equations.pairs().iter().enumerate().filter_map(|pair| of_pair(model, pair));
    weights.chain(interactions).chain(pairs).collect()
}

fn of_weight(equations: &Equations, body: usize) -> Option<Potential> {
    let model = equations.model();
    let Gravity::Vertical(g) = &model.gravity else { return None };
    let energy = model.bodies[body].potential_energy(&model.gravity);
    let weight = laws::weight::term(body, equations.mass_properties(body), &model.gravity.in_plane()?);
    is_given(model, std::slice::from_ref(g)).then(|| Potential {
        load: weight.load.clone(),
        law: Law::Weight,
        body: Some(body),
        pair: None,
        driven: energy.derivative(&time_symbol()),
        energy,
        elastic: vec![weight],
        is_whole: true,
    })
}

fn of_interaction(model: &Model, interaction: &dyn Interaction) -> Option<Potential> {
    let names: Vec<String> = model.bodies.iter().map(|body| body.name.clone()).collect();
    let context = Bodies { names: &names, wind: &model.wind, nodes: model.nodes };
    let terms = interaction.terms(&context);
    let law = terms.first()?.law;
    let (energy, elastic) = match law {
        Law::Spring => {
            let spring = spring_of(model, interaction, &terms)?;
            (energy_of_spring(&spring), spring.terms(&context))
        }
        Law::Torsion => {
            let torsion = torsion_of(model, interaction)?;
            (energy_of_torsion(&torsion), torsion.terms(&context))
        }
        _ => return None,
    };
    let is_whole = is_identically_zero(&coefficient(interaction, "damping")?);
    let is_alike = elastic.len() == terms.len() && !is_identically_zero(&energy);
    is_alike.then(|| Potential {
        load: interaction.name().to_owned(),
        law,
        body: if law == Law::Torsion { Some(terms[0].body) } else { None },
        pair: None,
        driven: energy.derivative(&time_symbol()),
        energy,
        elastic,
        is_whole,
    })
}

/// The spring of an interaction, without its damper.
fn spring_of(model: &Model, interaction: &dyn Interaction, terms: &[Term]) -> Option<Spring> {
    let [stiffness, rest_length] =
        ["stiffness", "rest length"].map(|key| coefficient(interaction, key).unwrap_or_else(Expr::zero));
    let places: Vec<Expr> =
        interaction.dimensions().into_iter().filter(|known| known.0 == "end").map(|known| known.1).collect();
    let [ax, ay, bx, by] = <[Expr; 4]>::try_from(places).ok()?;
    let places = [Vector::planar(ax, ay), Vector::planar(bx, by)];
    let ends = match interaction.bodies()[..] {
        [a, b] => [(a, &places[0]), (b, &places[1])].map(|(body, arm)| material(body, arm)),
        [body] => {
            let own = places.map(|place| (material(body, &place), Anchor::World(place)));
            let [(first, first_place), (second, second_place)] = own;
            match is_at(&first, terms.first()?) {
                true => [first, second_place],
                false => [first_place, second],
            }
        }
        _ => return None,
    };
    let mut given = vec![stiffness.clone(), rest_length.clone()];
    given.extend(ends.iter().flat_map(Anchor::places).cloned());
    let name = interaction.name().to_owned();
    is_given(model, &given).then_some(Spring { name, ends, stiffness, rest_length, damping: Expr::zero() })
}

fn material(body: &str, arm: &Vector) -> Anchor {
    Anchor::Material(PointRef { body: Kinematics::new(body), arm: arm.clone() })
}

/// Whether a term acts at an end.
fn is_at(end: &Anchor, term: &Term) -> bool {
    let Anchor::Material(point) = end else { return false };
    (point.world_arm() - &term.arm).components().iter().all(is_identically_zero)
}

fn energy_of_spring(spring: &Spring) -> Expr {
    let [a, b] = &spring.ends;
    let span = b.position() - a.position();
    let squared = match spring.rest_length.is_zero() {
        true => span.x() * span.x() + span.y() * span.y(),
        false => {
            let longer = span.norm() - &spring.rest_length;
            &longer * &longer
        }
    };
    &spring.stiffness * squared / 2
}

/// The torsion spring of an interaction, without its damper.
fn torsion_of(model: &Model, interaction: &dyn Interaction) -> Option<Torsion> {
    let stiffness = coefficient(interaction, "stiffness")?;
    let rest_angle = coefficient(interaction, "rest angle")?;
    let [body] = interaction.bodies()[..] else { return None };
    is_given(model, &[stiffness.clone(), rest_angle.clone()]).then(|| Torsion {
        name: interaction.name().to_owned(),
        body: Kinematics::new(body),
        stiffness,
        rest_angle,
        damping: Expr::zero(),
    })
}

fn energy_of_torsion(torsion: &Torsion) -> Expr {
    let twist = torsion.body.angle() - &torsion.rest_angle;
    &torsion.stiffness * (&twist * &twist) / 2
}

fn of_pair(model: &Model, (index, pair): (usize, &Pair)) -> Option<Potential> {
    let none = Expr::zero();
    let (stiffness, damping, elastic) = match &pair.law {
        ContactLaw::Rigid { .. } => return None,
        ContactLaw::Spring { stiffness, damping, release } => {
            let undamped =
                ContactLaw::Spring { stiffness: stiffness.clone(), damping: none, release: *release };
            (stiffness, damping, undamped)
        }
        ContactLaw::Hertz { stiffness, damping } => {
            (stiffness, damping, ContactLaw::Hertz { stiffness: stiffness.clone(), damping: none })
        }
    };
    let force = laws::compliant::normal_force(&Pair { law: elastic, ..pair.clone() })?;
    let moved = pair.gap().derivative(&time_symbol());
    let (energy, by_path) = match &pair.law {
        ContactLaw::Hertz { .. } => {
            let root: Expr = pair.root_symbol().into();
            (stiffness * root.powi(5) * 2 / 5, -(&force * moved))
        }
        // The gap is in the formula itself.
        _ => (stiffness * (pair.gap() * pair.gap()) / 2, Expr::zero()),
    };
    is_given(model, std::slice::from_ref(stiffness)).then(|| Potential {
        load: pair.name.clone(),
        law: Law::Contact,
        body: Some(pair.body),
        pair: Some(index),
        driven: energy.derivative(&time_symbol()) + by_path,
        energy,
        elastic: vec![Term { force: &force * &pair.normal, ..pair.term() }],
        is_whole: is_identically_zero(damping),
    })
}

fn coefficient(interaction: &dyn Interaction, key: &str) -> Option<Expr> {
    interaction.dimensions().into_iter().find(|known| known.0 == key).map(|known| known.1)
}

/// Whether formulas hold nothing but the parameters and the time.
fn is_given(model: &Model, formulas: &[Expr]) -> bool {
    let mut known = model.parameters.symbols();
    known.push(time_symbol());
    formulas.iter().flat_map(Expr::symbols).all(|symbol| known.contains(&symbol))
}
