//! Where bodies start: as they are told, or as pivots and joints that hold from the start say.
//!
//! A body without a place of its own that is joined to one that has a place starts where the joint holds it; so does its
//! velocity. A weld gives the angle too.

use std::collections::{BTreeSet, HashMap};

use tumble_expr::{Expr, Substitution, Vector};

use crate::anchor::{Anchor, rate};
use crate::joint::{Joint, JointKind};
use crate::kinematics::rotated;
use crate::model::Model;
use crate::parameters::time_symbol;
use crate::start::Start;

/// Formulas of the parameters that a body starts from.
#[derive(Clone, Debug)]
pub(crate) struct Placement {
    /// Of the centre of mass, m and m/s.
    pub(crate) position: Vector,
    pub(crate) velocity: Vector,
    /// rad and rad/s
    pub(crate) angle: Expr,
    pub(crate) omega: Expr,
}

/// What is known of the starts so far.
struct Placing<'m> {
    model: &'m Model,
    placements: Vec<Placement>,
    /// Of each body: place, velocity, angle and rate.
    known: Vec<[bool; 4]>,
    /// Indices of bodies by their names.
    bodies: HashMap<&'m str, usize>,
    /// By body, the joints that hold it from the start.
    joints_of: Vec<Vec<usize>>,
    /// Bodies before this have all.
    settled: usize,
}

impl Model {
    /// What every body starts from.
    pub(crate) fn placements(&self) -> Vec<Placement> {
        let mut placing = Placing::new(self);
        // Joints that may say something new: the first that does is followed.
        let mut next: BTreeSet<usize> = placing.joints_at_start().collect();
        loop {
            while let Some(joint) = next.pop_first() {
                if let Some(body) = placing.follow(&self.joints[joint]) {
                    next.extend(&placing.joints_of[body]);
                }
            }
            // Of bodies that are joined to each other only, the first is where it is drawn.
            let Some(body) = placing.settle_first() else { return placing.placements };
            next.extend(&placing.joints_of[body]);
        }
    }
}

impl<'m> Placing<'m> {
    fn new(model: &'m Model) -> Self {
        let bodies: HashMap<&str, usize> =
            model.bodies.iter().enumerate().map(|(index, body)| (body.name.as_str(), index)).collect();
        let mut joints_of = vec![vec![]; bodies.len()];
        for (index, joint) in model.joints.iter().enumerate().filter(|(_, joint)| joint.from.is_none()) {
            joint.bodies().filter_map(|name| bodies.get(name)).for_each(|body| joints_of[*body].push(index));
        }
        let starts: HashMap<&str, &Start> =
            model.starts.iter().rev().map(|(body, start)| (body.as_str(), start)).collect();
        let (mut placements, mut known) = (vec![], vec![]);
        for (body, joints) in model.bodies.iter().zip(&joints_of) {
            let start = starts.get(body.name.as_str()).map(|start| (*start).clone()).unwrap_or_default();
            let welded = joints.iter().any(|joint| model.joints[*joint].kind == JointKind::Weld);
            let (angle, omega) = (start.angle.clone(), start.omega.clone());
            let is_free = joints.is_empty();
            known.push([
                is_free || start.at.is_some(),
                is_free || start.velocity.is_some(),
                !welded || angle.is_some(),
                !welded || omega.is_some(),
            ]);
            let rest = Vector::planar(Expr::zero(), Expr::zero());
            placements.push(Placement {
                position: start.at.unwrap_or_else(|| body.mass_properties().centre),
                velocity: start.velocity.unwrap_or(rest),
                angle: angle.unwrap_or_else(Expr::zero),
                omega: omega.unwrap_or_else(Expr::zero),
            });
        }
        let mut placing = Self { model, placements, known, bodies, joints_of, settled: 0 };
        for pivot in &model.pivots {
            if let Some(&index) = placing.bodies.get(pivot.body.as_str()) {
                let arm = &model.bodies[index].mass_properties().centre - &pivot.point;
                placing.place(index, &-&arm, [at_start(&pivot.world), at_start(&rate(&pivot.world))]);
                placing.known[index] = [true; 4];
            }
        }
        placing
    }

    /// Gives a body whatever of place and velocity it has not, by a point of it, m from its centre in its own axes.
    fn place(&mut self, body: usize, arm: &Vector, [at, moving]: [Vector; 2]) {
        let placement = &mut self.placements[body];
        let arm = rotated(arm, &placement.angle);
        if !self.known[body][0] {
            placement.position = at - &arm;
        }
        if !self.known[body][1] {
            placement.velocity = moving - &placement.omega * arm.perpendicular();
        }
        self.known[body][0] = true;
        self.known[body][1] = true;
    }

    /// All that hold bodies from the start.
    fn joints_at_start(&self) -> impl Iterator<Item = usize> + 'm {
        let joints = self.model.joints.iter().enumerate();
        joints.filter(|(_, joint)| joint.from.is_none()).map(|(index, _)| index)
    }

    /// The body of which a joint said something new.
    fn follow(&mut self, joint: &Joint) -> Option<usize> {
        let [a, b] = &joint.ends;
        self.follow_from(joint, a, b).or_else(|| self.follow_from(joint, b, a))
    }

    fn follow_from(&mut self, joint: &Joint, known: &Anchor, other: &Anchor) -> Option<usize> {
        let Anchor::Material(point) = other else { return None };
        let &body = self.bodies.get(&*point.body.body)?;
        if self.known[body] == [true; 4] {
            return None;
        }
        let (at, moving, turned) = self.motion_of(known)?;
        let before = self.known[body];
        if joint.kind == JointKind::Weld {
            let placement = &mut self.placements[body];
            let [angle, omega] = turned;
            if !before[2] {
                placement.angle = angle;
            }
            if !before[3] {
                placement.omega = omega;
            }
            self.known[body][2] = true;
            self.known[body][3] = true;
        }
        if !(self.known[body][2] && self.known[body][3]) {
            return (self.known[body] != before).then_some(body);
        }
        if !(before[0] && before[1]) {
            self.place(body, &point.arm, [at, moving]);
        }
        (self.known[body] != before).then_some(body)
    }

    /// Place, velocity, angle and angular rate of an end whose body is placed.
    fn motion_of(&self, end: &Anchor) -> Option<(Vector, Vector, [Expr; 2])> {
        match end {
            Anchor::World(place) => {
                Some((at_start(place), at_start(&rate(place)), [Expr::zero(), Expr::zero()]))
            }
            Anchor::Material(point) => {
                let body = *self.bodies.get(&*point.body.body)?;
                let Placement { position, velocity, angle, omega } = &self.placements[body];
                let arm = rotated(&point.arm, angle);
                let moving = velocity + omega * arm.perpendicular();
                let all = self.known[body].iter().all(|known| *known);
                all.then(|| (position + &arm, moving, [angle.clone(), omega.clone()]))
            }
        }
    }

    /// Takes the first body that is not known yet as it is drawn, if there is one.
    fn settle_first(&mut self) -> Option<usize> {
        let first = self.known[self.settled..].iter().position(|known| known.contains(&false));
        self.settled = first.map_or(self.known.len(), |first| self.settled + first);
        let body = first.map(|_| self.settled)?;
        self.known[body] = [true; 4];
        Some(body)
    }
}

fn at_start(path: &Vector) -> Vector {
    let mut start = Substitution::default();
    start.insert(time_symbol(), Expr::zero());
    path.map(|component| start.apply(component))
}
