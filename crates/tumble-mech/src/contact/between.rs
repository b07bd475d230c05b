//! The pairs that a rule makes of two that may meet.

use tumble_expr::{Expr, Vector, is_identically_zero};

use crate::anchor::Anchor;
use crate::contact::border::{Border, Edge, Rim};
use crate::contact::opposite::Opposite;
use crate::contact::pair::{Pair, Rule};
use crate::contact::slipping::Level;
use crate::contact::straight::{Limit, Straight, along_edge, beyond_ends, outward};
use crate::friction::Friction;
use crate::kinematics::PointRef;
use crate::surface::ContactLaw;

/// Two that may meet: a body, and another or something of the world.
pub(crate) struct Between {
    /// What the names of their pairs begin with.
    pub(crate) name: String,
    pub(crate) rule: Rule,
    pub(crate) body: usize,
    pub(crate) other: Option<usize>,
    pub(crate) law: ContactLaw,
    pub(crate) friction: Option<Friction>,
}

/// Where friction of two acts in the depth of a compliant contact, by what of the first meets what of the second.
struct Levels {
    circles: Level,
    on_edges: Level,
    under_edges: Level,
}

impl Levels {
    /// On the rim of what is round, half way between two bodies of one kind, and else where the edge is that is pressed in.
    fn of(between: &Between, [first, second]: [&Border; 2]) -> Self {
        if between.law.is_rigid() {
            return Self { circles: Level::Rim, on_edges: Level::Rim, under_edges: Level::Rim };
        }
        let on_edge_of = |rim: &Border| if rim.is_round() { Level::Rim } else { Level::Surface };
        let circles = match [first.is_round(), second.is_round()] {
            [true, true] if between.other.is_none() => Level::Rim,
            [true, false] => Level::Rim,
            [false, true] => Level::Surface,
            [true, true] | [false, false] => Level::Middle,
        };
        Self { circles, on_edges: on_edge_of(first), under_edges: on_edge_of(second) }
    }
}

impl Between {
    /// All their pairs; `first` is of the body.
    pub(crate) fn pairs(&self, first: &Border, second: &Border) -> Vec<Pair> {
        let are_one = self.other.is_some() && first.is_round() && second.is_round();
        let levels = Levels::of(self, [first, second]);
        let named = |one: &str, other: &str| match are_one {
            true => self.name.clone(),
            false => [&self.name, one, other]
                .iter()
                .filter(|part| !part.is_empty())
                .copied()
                .collect::<Vec<_>>()
                .join("."),
        };
        let level = |level: Level| move |pair: Pair| Pair { level, ..pair };
        let mut pairs = vec![];
        for one in &first.rims {
            let met = second
                .rims
                .iter()
                .filter_map(|other| self.circles(named(&one.name, &other.name), one, other))
                .map(level(levels.circles));
            pairs.extend(met);
        }
        for (line, edge) in second.edges.iter().enumerate() {
            let met = first
                .rims
                .iter()
                .filter_map(|rim| self.on_edge(named(&rim.name, &edge.name), rim, edge, line))
                .map(level(levels.on_edges));
            pairs.extend(met);
        }
        for (line, edge) in first.edges.iter().enumerate() {
            let line = second.edges.len() + line;
            let met = second
                .rims
                .iter()
                .filter_map(|rim| self.under_edge(named(&edge.name, &rim.name), edge, rim, line))
                .map(level(levels.under_edges));
            pairs.extend(met);
        }
        pairs
    }

    /// Two circles; two corners, which have no radius, meet by their edges.
    fn circles(&self, name: String, first: &Rim, second: &Rim) -> Option<Pair> {
        let centre = first.point()?;
        let reach = &first.radius + &second.radius;
        if is_identically_zero(&reach) {
            return None;
        }
        let other = second.point().cloned();
        let opposite = Opposite::circle(other, (second.radius.clone(), false), &first.radius, &self.law);
        let through = second.centre.position();
        let normal = opposite.normal(centre, &through)?;
        let apart = normal.map(|part| part * &reach);
        let own = beyond_ends(first, &-&apart, &reach);
        let limits = own.into_iter().chain(beyond_ends(second, &apart, &reach)).collect();
        Some(self.pair(name, centre, &first.radius, (through, normal, opposite), limits))
    }

    /// A circle of the body on an edge of the other.
    fn on_edge(&self, name: String, rim: &Rim, edge: &Edge, line: usize) -> Option<Pair> {
        let straight = Straight {
            owner: edge.owner(),
            is_first: false,
            other: edge.ends[0].material().cloned(),
            radius: edge.radius.clone(),
            reach: &rim.radius + &edge.radius,
            around: edge.owner().map(|_| edge.reach() + &rim.radius),
            line,
        };
        let opposite = Opposite::Edge(straight);
        let (centre, through) = (rim.point()?, edge.ends[0].position());
        let limits = along_edge(edge, rim, &opposite.apart(centre, &through), (&self.law, false));
        Some(self.pair(name, centre, &rim.radius, (through, outward(edge), opposite), limits))
    }

    /// An edge of the body on a circle of the other.
    fn under_edge(&self, name: String, edge: &Edge, rim: &Rim, line: usize) -> Option<Pair> {
        let straight = Straight {
            owner: edge.owner(),
            is_first: true,
            other: rim.point().cloned(),
            radius: rim.radius.clone(),
            reach: &rim.radius + &edge.radius,
            around: Some(edge.reach() + &rim.radius),
            line,
        };
        let opposite = Opposite::Edge(straight);
        let (start, through) = (edge.ends[0].material()?, rim.centre.position());
        let limits = along_edge(edge, rim, &-&opposite.apart(start, &through), (&self.law, true));
        Some(self.pair(name, start, &edge.radius, (through, -&outward(edge), opposite), limits))
    }

    fn pair(
        &self,
        name: String,
        centre: &PointRef,
        radius: &Expr,
        (through, normal, opposite): (Vector, Vector, Opposite),
        limits: Vec<Limit>,
    ) -> Pair {
        Pair {
            name,
            rule: self.rule,
            body: self.body,
            other: self.other,
            centre: centre.clone(),
            radius: radius.clone(),
            through,
            normal,
            law: self.law.clone(),
            friction: self.friction.clone(),
            opposite,
            limits,
            level: Level::Rim,
            lever: None,
        }
    }
}

/// A circle of the world, which needs no name of its own.
pub(crate) fn circle_of_world(centre: &Vector, radius: &Expr) -> Border {
    let centre = Anchor::World(centre.clone());
    let rim = Rim { name: String::new(), centre, radius: radius.clone(), neighbours: vec![] };
    Border { rims: vec![rim], edges: vec![] }
}
