//! All pairs of a model, and which of them are watched in a mode, and how.

use std::collections::{HashMap, HashSet};
use std::sync::OnceLock;

use tumble_expr::{Expr, Symbol};
use tumble_ode::Direction;

use crate::body::Body;
use crate::contact::between::{Between, circle_of_world};
use crate::contact::border::{Border, Rim};
use crate::contact::capture::captures;
use crate::contact::circles::ordered;
use crate::contact::contact_mode::ContactMode;
use crate::contact::grip::{Grip, Way};
use crate::contact::pair::{Pair, Rule};
use crate::contact::said::of_surface_and_body;
use crate::contact::slipping::Level;
use crate::contact::watched::Watched;
use crate::equations::Equations;
use crate::link::RowOf;
use crate::mode::Mode;
use crate::model::Model;
use crate::surface::Surface;
use crate::term::Term;

/// Rows that hold an island in which it is watched all the time whether friction takes all that a push moves: each is a system of so many.
const MOST_WATCHED: usize = 12;

/// Every pair, in the order of surfaces, bodies and features, then of contacts of bodies, with the forces it exerts when it touches.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pairs {
    pub(crate) all: Vec<Pair>,
    /// By pair, once they are asked for: there may be as many pairs as the square of the bodies, of which few ever touch.
    exerted: Vec<OnceLock<Exerted>>,
    /// The joints that pairs make which capture.
    pub(crate) captures: HashMap<usize, usize>,
    /// What stands for the rolling resistance of pairs, behind all of them, and of which pair each of these is.
    pub(crate) rolling: HashMap<usize, usize>,
    pub(crate) owner: HashMap<usize, usize>,
    of_bodies: Vec<Vec<usize>>,
    /// Bodies that may meet each other, the lesser first.
    pub(crate) couples: HashSet<[usize; 2]>,
}

/// The forces of a pair, by body.
#[derive(Clone, Debug)]
struct Exerted {
    terms: Vec<Term>,
    /// None without friction.
    friction: Vec<Term>,
}

impl Pairs {
    pub(crate) fn of(model: &Model) -> Self {
        let borders: Vec<Border> = match model.surfaces.is_empty() && model.contacts.is_empty() {
            true => vec![Border::default(); model.bodies.len()],
            false => model.bodies.iter().map(Border::of_body).collect(),
        };
        let mut all = vec![];
        for surface in model.surfaces.iter().enumerate() {
            for body in model.bodies.iter().enumerate() {
                all.extend(of_surface(model, surface, body, &borders[body.0]));
            }
        }
        let contacts = model.contacts.iter().enumerate();
        all.extend(contacts.flat_map(|(index, contact)| contact.pairs(index, model, &borders)));
        let mut of_bodies = vec![vec![]; model.bodies.len()];
        for (index, pair) in all.iter().enumerate() {
            pair.bodies().for_each(|body| of_bodies[body].push(index));
        }
        let resisting: Vec<(usize, Pair)> =
            all.iter().enumerate().filter_map(|(index, pair)| Some((index, pair.rolling()?))).collect();
        let rolling: HashMap<usize, usize> =
            resisting.iter().zip(all.len()..).map(|((index, _), rolling)| (*index, rolling)).collect();
        let owner = rolling.iter().map(|(index, rolling)| (*rolling, *index)).collect();
        all.extend(resisting.into_iter().map(|(_, pair)| pair));
        let exerted = all.iter().map(|_| OnceLock::new()).collect();
        let couples = all.iter().filter_map(|pair| Some([pair.body, pair.other?]));
        let couples = couples.map(|[a, b]| ordered(a, b)).collect();
        let captures = captures(model, &all);
        Self { all, exerted, captures, rolling, owner, of_bodies, couples }
    }

    fn exerted(&self, pair: usize) -> &Exerted {
        self.exerted[pair].get_or_init(|| {
            let of = &self.all[pair];
            let friction = if of.friction.is_some() { of.friction_terms() } else { vec![] };
            Exerted { terms: of.terms(), friction }
        })
    }

    /// The forces of a pair along its normal, by body.
    pub(crate) fn terms(&self, pair: usize) -> &[Term] {
        &self.exerted(pair).terms
    }

    /// Those along its surface; none without friction.
    pub(crate) fn friction_terms(&self, pair: usize) -> &[Term] {
        &self.exerted(pair).friction
    }

    /// Indices of the pairs of which all bodies are among some that are in order.
    pub(crate) fn among(&self, bodies: &[usize]) -> Vec<usize> {
        let is_own = |pair: &usize| self.all[*pair].bodies().all(|body| bodies.binary_search(&body).is_ok());
        let mut pairs: Vec<usize> =
            bodies.iter().flat_map(|body| self.of_body(*body)).filter(is_own).collect();
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }

    /// What has friction, or resists rolling, of a pair.
    pub(crate) fn rubbing(&self, pair: usize) -> impl Iterator<Item = usize> {
        [Some(pair), self.rolling.get(&pair).copied()].into_iter().flatten()
    }

    /// Indices of a body's pairs.
    pub(crate) fn of_body(&self, body: usize) -> impl Iterator<Item = usize> {
        self.of_bodies.get(body).into_iter().flatten().copied()
    }
}

/// All pairs of a body and a surface: planes and bowls are met by circles, others by edges too.
fn of_surface(
    model: &Model,
    (index, surface): (usize, &Surface),
    (body_index, body): (usize, &Body),
    border: &Border,
) -> Vec<Pair> {
    let (own, said) = (surface.met_of(body, border), of_surface_and_body(model, surface, body));
    let between = || Between {
        name: format!("{}.{}", surface.name, body.name),
        rule: Rule::Surface(index),
        body: body_index,
        other: None,
        law: said.0.clone(),
        friction: said.1.clone(),
    };
    match (&surface.polygon, &surface.circle) {
        (Some(corners), _) => {
            let planes: Vec<&Surface> =
                model.surfaces.iter().filter(|other| other.hides_from(body)).collect();
            let hidden = |corner: &_| planes.iter().any(|plane| plane.has_behind(corner));
            between().pairs(&own, &Border::of_polygon(corners, hidden))
        }
        (None, Some(circle)) if !circle.inside => {
            between().pairs(&own, &circle_of_world(&surface.through, &circle.radius))
        }
        _ => {
            // Of several points that sink in by different depths none is the one to slip at.
            let is_level = surface.circle.is_none() && !said.0.is_rigid() && border.rims.len() > 1;
            let level = if is_level { Level::Surface } else { Level::Rim };
            let pair = |rim: &Rim| {
                let of = (rim, rim.point()?);
                Some(Pair { level, ..Pair::new((index, surface), (body_index, body), of, said.clone()) })
            };
            own.rims.iter().filter_map(pair).collect()
        }
    }
}

impl Equations {
    /// Pairs that may touch, in the order that [`Mode::contacts`] counts them by.
    pub fn pairs(&self) -> &[Pair] {
        &self.pair_list().all
    }

    /// Pairs that are apart in a mode.
    pub(crate) fn apart(&self, mode: &Mode) -> Vec<usize> {
        let own = self.pairs_among(mode, &mode.bodies).into_iter();
        own.filter(|pair| mode.contact_mode(*pair).is_none()).collect()
    }

    /// What stands for the rolling resistance of a pair, by index, if it has any.
    pub fn resisting(&self, pair: usize) -> Option<usize> {
        self.pair_list().rolling.get(&pair).copied()
    }

    /// What is watched of the pairs that touch: its guards come after those of the events.
    pub(crate) fn touching(&self, mode: &Mode) -> Vec<(usize, Watched, Direction)> {
        let watched = |(pair, contact_mode): &(usize, ContactMode)| -> Vec<(usize, Watched, Direction)> {
            let gap = (*pair, Watched::Gap, Direction::Rising);
            match contact_mode {
                ContactMode::Pressed => {
                    let own = &self.pairs()[*pair];
                    let force = own.releases_early().then_some((*pair, Watched::Force, Direction::Falling));
                    // Of a damped spring the force comes down to zero first, always.
                    let gap = Some(gap).filter(|_| force.is_none() || own.is_hertzian());
                    let shallow = (*pair, Watched::Shallow, Direction::Rising);
                    let shallow = Some(shallow).filter(|_| self.is_among_roots(mode, *pair));
                    gap.into_iter().chain(shallow).chain(force).collect()
                }
                ContactMode::Entering(_) => vec![
                    (*pair, Watched::Out, Direction::Rising),
                    (*pair, Watched::Depth, Direction::Falling),
                ],
                ContactMode::Leaving(_) => vec![gap, (*pair, Watched::Depth, Direction::Falling)],
                ContactMode::Released => vec![gap, (*pair, Watched::Force, Direction::Rising)],
                ContactMode::Resting | ContactMode::Settling if !self.lacks_friction(mode, *pair) => {
                    vec![(*pair, Watched::Normal, Direction::Falling)]
                }
                ContactMode::Resting | ContactMode::Settling | ContactMode::Idle => vec![],
            }
        };
        let limits = |(pair, _): &(usize, ContactMode)| {
            let pair = *pair;
            let limits = 0..self.pairs()[pair].leaving().len();
            limits.map(move |limit| (pair, Watched::Limit(limit), Direction::Falling)).collect::<Vec<_>>()
        };
        let contacts = mode.contacts.iter().flat_map(watched).chain(mode.contacts.iter().flat_map(limits));
        contacts.chain(self.watched_grips(mode)).collect()
    }

    /// What is watched of friction: of all points of a body on one surface together, since they slip alike.
    fn watched_grips(&self, mode: &Mode) -> Vec<(usize, Watched, Direction)> {
        let mut found = vec![];
        for (pair, grip) in &mode.grips {
            match grip {
                Grip::Sticks if self.lacks_friction(mode, *pair) => {}
                Grip::Sticks => found.extend(
                    [Way::Forward, Way::Backward].map(|way| (*pair, Watched::Cone(way), Direction::Falling)),
                ),
                // Friction has done what it does until the impacts have ended.
                Grip::Slides(_) if self.is_ending(mode, *pair) => {}
                Grip::Slides(way) => {
                    if self.alike(mode, *pair).next() == Some(*pair) {
                        let direction =
                            if *way == Way::Forward { Direction::Falling } else { Direction::Rising };
                        found.push((*pair, Watched::Slip, direction));
                    }
                    if !mode.is_pressed(*pair) && (self.is_alone(mode, *pair) || self.may_wedge(mode, *pair))
                    {
                        found.push((*pair, Watched::Wedge, Direction::Falling));
                    }
                }
                Grip::Follows | Grip::Strains(_) => {}
            }
        }
        found
    }

    /// Whether a push at a pair moves one body that nothing else holds.
    pub(crate) fn is_alone(&self, mode: &Mode, pair: usize) -> bool {
        let body = self.pairs()[pair].body;
        let mut own = mode.held().filter(|other| self.pairs()[*other].has(body));
        own.next() == Some(pair)
            && own.next().is_none()
            && self.island_of(mode, body).len() == 1
            && self.independent_rows_of(mode, &[body]).is_empty()
    }

    /// Whether friction at a pair may come to take all that a push moves there, though other contacts or joints hold its bodies too. It is
    /// watched where that is a system of some size, and looked at where contacts change in any.
    fn may_wedge(&self, mode: &Mode, pair: usize) -> bool {
        let own = &self.pairs()[pair];
        if own.is_rolling() || own.is_central() || self.alike(mode, pair).nth(1).is_some() {
            return false;
        }
        let island = self.island_of(mode, own.body);
        let is_own = |row: &RowOf| self.bodies_of(*row).iter().any(|body| island.binary_search(body).is_ok());
        let contacts = mode.held().map(RowOf::Pair).chain(mode.sticking().map(RowOf::Slip)).filter(is_own);
        self.independent_rows_of(mode, &island).len() + contacts.count() <= MOST_WATCHED
    }

    /// The pairs that touch and slip like a pair: of the same body on the same plane.
    pub(crate) fn alike<'a>(&'a self, mode: &'a Mode, pair: usize) -> impl Iterator<Item = usize> + 'a {
        let own = self.pairs()[pair].slips_with(pair);
        mode.grips
            .iter()
            .map(|(other, _)| *other)
            .filter(move |other| self.pairs()[*other].slips_with(*other) == own)
    }

    /// What friction of a body on a surface could still have more before it slips that way, N; the pair is the one that is given it.
    pub(crate) fn friction_left(&self, mode: &Mode, pair: usize, way: Way) -> Expr {
        let own = &self.pairs()[pair];
        let of_rest = own.friction.as_ref().map_or_else(Expr::zero, |friction| friction.of_rest.clone());
        let normals = self.alike(mode, pair).map(|other| Expr::from(self.pairs()[other].force_symbol()));
        let normal = normals.reduce(|sum, next| sum + next).unwrap_or_else(Expr::zero);
        // Friction acts against the slip that it keeps from coming.
        of_rest * normal + way.sign() * Expr::from(own.friction_symbol())
    }

    /// Friction that is tied to normal forces in a mode, by its symbol, shown like the terms.
    pub fn shown_ties(&self, mode: &Mode) -> Vec<(Symbol, Expr)> {
        let tied = |pair: usize| {
            let own = &self.pairs()[pair];
            let force = self.tie(mode, pair)? * Expr::from(own.force_symbol());
            Some((own.friction_symbol(), self.shown(mode, &force)))
        };
        mode.grips.iter().filter_map(|(pair, _)| tied(*pair)).collect()
    }

    /// Friction of a pair that is tied to its normal force, for each unit of that.
    pub(crate) fn tie(&self, mode: &Mode, pair: usize) -> Option<Expr> {
        let friction = self.pairs()[pair].friction.as_ref()?;
        match mode.grip(pair)? {
            Grip::Slides(_) if self.is_ending(mode, pair) => Some(Expr::zero()),
            Grip::Slides(way) => Some(-way.sign() * &friction.kinetic),
            Grip::Strains(way) => Some(-way.sign() * &friction.of_rest),
            Grip::Sticks | Grip::Follows => None,
        }
    }

    /// Whether impacts of a pair too small to follow go on.
    fn is_ending(&self, mode: &Mode, pair: usize) -> bool {
        let touching = self.pair_list().owner.get(&pair).copied().unwrap_or(pair);
        mode.contact_mode(touching) == Some(ContactMode::Settling)
    }

    /// Whether forces of what is coupled to a pair lack friction that has been done already, until impacts have ended: what it would hold or
    /// let go is looked at when they have.
    fn lacks_friction(&self, mode: &Mode, pair: usize) -> bool {
        let is_ending =
            |(pair, grip): &(usize, Grip)| matches!(grip, Grip::Slides(_)) && self.is_ending(mode, *pair);
        let mut ending = mode.grips.iter().filter(|of| is_ending(of)).peekable();
        if ending.peek().is_none() {
            return false;
        }
        let island = self.island_of(mode, self.pairs()[pair].body);
        ending.any(|(ending, _)| self.pairs()[*ending].bodies().any(|body| island.contains(&body)))
    }

    /// Names of the guards of all pairs, in the order in which they are watched.
    pub(crate) fn guard_names(&self, mode: &Mode) -> Vec<String> {
        let touching = self.touching(mode).into_iter().map(|(pair, watched, _)| (pair, watched));
        let apart = self.apart(mode).into_iter().map(|pair| (pair, Watched::Gap));
        touching.chain(apart).map(|(pair, watched)| self.pairs()[pair].guard_name(watched)).collect()
    }
}
