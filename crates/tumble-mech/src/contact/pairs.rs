//! All pairs of a model, and which of them are watched in a mode, and how.

use tumble_ode::Direction;

use crate::body::Body;
use crate::contact::contact_mode::ContactMode;
use crate::contact::feature::Feature;
use crate::contact::pair::{Pair, Watched};
use crate::equations::Equations;
use crate::kinematics::PointRef;
use crate::mode::Mode;
use crate::model::Model;
use crate::term::Term;

/// Every pair, in the order of surfaces, bodies and features, with the force it exerts when it touches.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pairs {
    pub(crate) all: Vec<Pair>,
    pub(crate) terms: Vec<Term>,
    of_bodies: Vec<Vec<usize>>,
}

impl Pairs {
    pub(crate) fn of(model: &Model) -> Self {
        let features: Vec<Vec<(Feature, PointRef)>> = match model.surfaces.is_empty() {
            true => vec![vec![]; model.bodies.len()],
            false => model.bodies.iter().map(placed).collect(),
        };
        let mut all = vec![];
        for surface in model.surfaces.iter().enumerate() {
            for body in model.bodies.iter().enumerate() {
                let met = features[body.0].iter().filter(|(feature, _)| surface.1.meets_at(body.1, feature));
                all.extend(met.map(|(feature, centre)| Pair::new(surface, body, (feature, centre))));
            }
        }
        let terms = all.iter().map(Pair::term).collect();
        let mut of_bodies = vec![vec![]; model.bodies.len()];
        all.iter().enumerate().for_each(|(index, pair): (usize, &Pair)| of_bodies[pair.body].push(index));
        Self { all, terms, of_bodies }
    }

    /// Indices of a body's pairs.
    pub(crate) fn of_body(&self, body: usize) -> impl Iterator<Item = usize> {
        self.of_bodies.get(body).into_iter().flatten().copied()
    }
}

/// The points by which a body may touch, with where they are.
fn placed(body: &Body) -> Vec<(Feature, PointRef)> {
    let features = body.features();
    let places = body.points_at(features.iter().map(|feature| &feature.centre));
    features.into_iter().zip(places).collect()
}

impl Equations {
    /// Pairs that may touch, in the order that [`Mode::contacts`] counts them by.
    pub fn pairs(&self) -> &[Pair] {
        &self.pair_list().all
    }

    /// Pairs that are apart in a mode.
    pub(crate) fn apart(&self, mode: &Mode) -> Vec<usize> {
        let own = mode.bodies.iter().flat_map(|body| self.pair_list().of_body(*body));
        let mut apart: Vec<usize> = own.filter(|pair| mode.contact_mode(*pair).is_none()).collect();
        apart.sort_unstable();
        apart
    }

    /// What is watched of the pairs that touch: its guards come after those of the events.
    pub(crate) fn touching(&self, mode: &Mode) -> Vec<(usize, Watched, Direction)> {
        let watched = |(pair, contact_mode): &(usize, ContactMode)| -> Vec<(usize, Watched, Direction)> {
            let gap = (*pair, Watched::Gap, Direction::Rising);
            match contact_mode {
                ContactMode::Pressed if self.pairs()[*pair].releases_early() => {
                    vec![(*pair, Watched::Force, Direction::Falling)]
                }
                ContactMode::Pressed => vec![gap],
                ContactMode::Released => vec![gap, (*pair, Watched::Force, Direction::Rising)],
                ContactMode::Resting | ContactMode::Settling => {
                    vec![(*pair, Watched::Normal, Direction::Falling)]
                }
                ContactMode::Idle => vec![],
            }
        };
        mode.contacts.iter().flat_map(watched).collect()
    }

    /// Names of the guards of all pairs, in the order in which they are watched.
    pub(crate) fn guard_names(&self, mode: &Mode) -> Vec<String> {
        let touching = self.touching(mode).into_iter().map(|(pair, watched, _)| (pair, watched));
        let apart = self.apart(mode).into_iter().map(|pair| (pair, Watched::Gap));
        touching.chain(apart).map(|(pair, watched)| self.pairs()[pair].guard_name(watched)).collect()
    }
}
