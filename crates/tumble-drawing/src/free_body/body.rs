//! One body at one instant, as it is given to a diagram.

use crate::outline::{Outline, Pose};
use crate::scale::drawable;
use crate::text::Label;

use super::arrow::{Arrow, ArrowUnit, Couple, DistributedForce, Velocity};
use super::cone::FrictionCone;
use super::side::SideView;
use super::surface::Ground;

/// A point of the body or its surroundings that gets a name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NamedPoint {
    /// Its name.
    pub name: Label,
    /// Where it is, in world coordinates, metres.
    pub at: [f64; 2],
}

/// An angle at the centre of mass to be marked by an arc, with its symbol and its value in degrees.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AngleMark {
    /// Its symbol, for instance `Label::symbol("theta")`.
    pub symbol: Label,
    /// Direction from which it is counted, in radians from the x axis: 0 is
    /// horizontal, -pi/2 straight down. Drawn as a dashed line.
    pub reference: f64,
    /// The angle in radians, counter-clockwise.
    pub value: f64,
}

impl AngleMark {
    /// An angle at the centre of mass, from the horizontal (radians).
    pub fn horizontal(symbol: Label, value: f64) -> Self {
        Self { symbol, reference: 0.0, value }
    }

    fn is_drawable(&self) -> bool {
        [self.reference, self.value].into_iter().all(drawable)
    }
}

/// A body at one instant with what acts on it: one panel of a sheet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FreeBodyDiagram {
    /// Name of the body; printed where panels of a sheet show different bodies.
    pub name: Label,
    /// Lines above the panel; the first is bold.
    pub heading: Vec<Label>,
    /// Where the body is.
    pub pose: Pose,
    /// Outlines in body coordinates about the centre of mass, metres.
    pub outlines: Vec<Outline>,
    /// Surfaces near it.
    pub surfaces: Vec<Ground>,
    /// What the arrows stand for.
    pub unit: ArrowUnit,
    /// Forces with their points of action.
    pub forces: Vec<Arrow>,
    /// Cones of friction at contacts; their normal forces and frictions are among the forces.
    pub cones: Vec<FrictionCone>,
    /// Couples.
    pub couples: Vec<Couple>,
    /// The sum of the forces or M A, if it is to be shown. It is no force of its own.
    pub resultant: Option<Arrow>,
    /// The angle to mark.
    pub angle: Option<AngleMark>,
    /// Ends of the arms from the centre of mass, with their symbols.
    pub arms: Vec<NamedPoint>,
    /// Velocities: of the centre of mass, of the air past a point.
    pub velocities: Vec<Velocity>,
    /// Forces along lines; their sums are among the forces.
    pub spreads: Vec<DistributedForce>,
    /// Angular velocity in rad/s, counter-clockwise, if it is to be shown.
    pub rate: Option<f64>,
    /// For motion in a horizontal plane, seen from above: what acts out of the plane.
    pub side: Option<SideView>,
}

impl FreeBodyDiagram {
    /// A body without forces, from its name, pose and outlines.
    pub fn new(name: Label, pose: Pose, outlines: Vec<Outline>) -> Self {
        Self { name, pose, outlines, ..Self::default() }
    }

    /// With one more line of heading.
    pub fn heading(mut self, line: Label) -> Self {
        self.heading.push(line);
        self
    }

    /// With one more force.
    pub fn force(mut self, force: Arrow) -> Self {
        self.forces.push(force);
        self
    }

    /// With one more couple.
    pub fn couple(mut self, couple: Couple) -> Self {
        self.couples.push(couple);
        self
    }

    /// With one more surface.
    pub fn surface(mut self, surface: Ground) -> Self {
        self.surfaces.push(surface);
        self
    }

    /// With the arm from the centre of mass to a point (world, metres), unless it is there.
    pub fn arm(mut self, name: Label, at: [f64; 2]) -> Self {
        if at != self.pose.centre() && self.arms.iter().all(|arm| arm.at != at) {
            self.arms.push(NamedPoint { name, at });
        }
        self
    }

    /// With a velocity.
    pub fn velocity(mut self, velocity: Velocity) -> Self {
        self.velocities.push(velocity);
        self
    }

    /// With an angle marked.
    pub fn angle(mut self, angle: AngleMark) -> Self {
        self.angle = Some(angle);
        self
    }

    /// With impulses instead of forces.
    pub fn impulses(mut self) -> Self {
        self.unit = ArrowUnit::impulse();
        self
    }

    /// The part of it that can be drawn: finite numbers, and forces and couples that are not zero.
    pub(super) fn drawable(&self) -> Self {
        let mut body = self.clone();
        if !body.pose.is_drawable() {
            body.pose = Pose::default();
        }
        let pose = body.pose;
        let shown = |p: &[f64; 2]| p.iter().copied().all(drawable);
        body.outlines.retain(|outline| outline.extent(&pose).iter().all(shown));
        body.surfaces.retain(Ground::is_drawable);
        body.forces.retain(|force| force.is_drawable() && force.magnitude() > 0.0);
        body.cones.retain(FrictionCone::is_drawable);
        body.couples.retain(|couple| drawable(couple.value) && couple.value != 0.0);
        body.resultant = body.resultant.filter(|sum| sum.is_drawable() && sum.magnitude() > 0.0);
        body.angle = body.angle.filter(AngleMark::is_drawable);
        body.arms.retain(|arm| shown(&arm.at));
        body.velocities.retain(|velocity| velocity.is_drawable() && velocity.speed() > 0.0);
        body.spreads.retain(|spread| spread.is_drawable() && spread.largest() > 0.0);
        body.rate = body.rate.filter(|rate| drawable(*rate) && *rate != 0.0);
        body
    }

    /// `symbol = 0` for what is zero, and a dash for what is no number.
    pub(super) fn listed(&self) -> Vec<Label> {
        let line = |symbol: &Label, name: Label, value: f64| {
            let sign = if symbol.is_empty() { ": " } else { " = " };
            name.then(Label::plain(sign)).then(Label::plain(if value == 0.0 { "0" } else { "–" }))
        };
        let forces = self.forces.iter().filter(|force| !(force.is_drawable() && force.magnitude() > 0.0));
        let couples = self.couples.iter().filter(|couple| !drawable(couple.value) || couple.value == 0.0);
        let forces = forces.map(|force| {
            let value = if force.is_drawable() { 0.0 } else { f64::NAN };
            line(&force.symbol, force.name(), value)
        });
        forces.chain(couples.map(|couple| line(&couple.symbol, couple.name(), couple.value))).collect()
    }
}
