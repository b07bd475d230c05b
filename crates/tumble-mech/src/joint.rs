//! # Law
//! A joint keeps two places together: of a pin `p_a - p_b = 0`, of a weld the angle between its bodies as well,
//! `theta_a - theta_b - c = 0`. Each of these conditions is a [`Row`]; what keeps it is a force R on a at the joint and the
//! opposite on b, of a weld a couple too. Forces of joints do no work together but where a place is moved.
//! # Symbols and units
//! p places of the joint on both sides (m), theta angles (rad), c the angle between them when it began to hold (rad), R (N).
//! # Sign and frame
//! World axes; R acts on the first of the two, counter-clockwise couples are positive.
//! # Validity
//! Plane motion of rigid bodies, joints without friction; places of the world may move on given paths. A joint that begins at an
//! event makes a perfectly inelastic impact.
//! # Source
//! Lagrange's multipliers of conditions on places (first kind).
//! # Checked by
//! `tests/joints.rs`: a double pendulum against reference values, reactions against both laws of motion of each body.

use tumble_expr::{Dimension, Expr, Symbol, Vector};

use crate::anchor::{Anchor, rate};
use crate::coordinates::{Measure, force_symbols};
use crate::kinematics::{Kinematics, PointRef};
use crate::row::{Row, Wrench};
use crate::term::{Law, Term};

/// What a joint leaves free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// The bodies turn about it.
    Pin,
    /// Nothing: the angle between the bodies stays what it is when the joint begins to hold.
    Weld,
}

/// Keeps a point of a body at a point of another or at a place.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// What it leaves free.
    pub kind: JointKind,
    /// What it keeps together; at least one belongs to a body, both never to the same.
    pub ends: [Anchor; 2],
    /// Whether the second end is where the first is on that body when the joint begins to hold.
    pub is_seated: bool,
    /// Whether bodies that do not fit together at the start are brought to where they do.
    pub assemble: bool,
    /// Name of the event that makes it; it holds from the start where there is none.
    pub from: Option<String>,
    /// Name of the event that releases it.
    pub until: Option<String>,
    /// Set where a contact makes it that captures: index of the contact. `from` is then the name of the two that meet.
    pub captured_by: Option<usize>,
}

/// A side of a joint that belongs to a body.
pub(crate) struct Side<'a> {
    pub(crate) point: &'a PointRef,
    /// 1 for the first, -1 for the second.
    pub(crate) sign: i32,
}

impl Joint {
    /// A joint about which both turn.
    pub fn pin(name: impl Into<String>, ends: [Anchor; 2]) -> Self {
        let (name, kind) = (name.into(), JointKind::Pin);
        Self {
            name,
            kind,
            ends,
            is_seated: false,
            assemble: false,
            from: None,
            until: None,
            captured_by: None,
        }
    }

    /// A joint that leaves nothing free.
    pub fn weld(name: impl Into<String>, ends: [Anchor; 2]) -> Self {
        Self { kind: JointKind::Weld, ..Self::pin(name, ends) }
    }

    /// The same joint made by the event of that name.
    #[must_use]
    pub fn from(mut self, event: impl Into<String>) -> Self {
        self.from = Some(event.into());
        self
    }

    /// The same joint released by the event of that name.
    #[must_use]
    pub fn until(mut self, event: impl Into<String>) -> Self {
        self.until = Some(event.into());
        self
    }

    /// The same joint, its second end wherever its first is on `body` when it begins to hold.
    #[must_use]
    pub fn seated_on(mut self, body: &Kinematics) -> Self {
        let [x, y] = ["seat_x", "seat_y"].map(|name| self.symbol(name, Dimension::LENGTH).into());
        let arm = Vector::planar(x, y);
        self.ends[1] = Anchor::Material(PointRef { body: body.clone(), arm });
        self.is_seated = true;
        self
    }

    /// Names of the bodies that it keeps.
    pub fn bodies(&self) -> impl Iterator<Item = &str> {
        self.ends.iter().filter_map(Anchor::body)
    }

    /// The place that one of its ends is, where that is no body's, m.
    pub fn world(&self) -> Option<&Vector> {
        self.ends.iter().find_map(|end| match end {
            Anchor::World(place) => Some(place),
            Anchor::Material(_) => None,
        })
    }

    /// Velocity of what it keeps together, m/s: of the place that moves as it is told to, or else of the first end.
    pub(crate) fn velocity(&self) -> Vector {
        self.world().map_or_else(|| self.ends[0].velocity(), rate)
    }

    /// Symbols of the force on the first end, N, and for a weld of the couple, N m.
    pub fn multipliers(&self) -> Vec<Symbol> {
        let force = force_symbols(&self.name);
        let couple = (self.kind == JointKind::Weld).then(|| self.symbol("torque", Dimension::TORQUE));
        force.into_iter().chain(couple).collect()
    }

    /// States that keep how the bodies were when an event made it: the place on the second body, m, the angle of the first
    /// against the second, rad.
    pub(crate) fn seat(&self) -> Vec<(Symbol, Measure)> {
        let place = match &self.ends[1] {
            Anchor::Material(point) if self.is_seated => point.arm.components(),
            _ => &[],
        };
        let place = place.iter().flat_map(Expr::symbols).map(|symbol| (symbol, Measure::Length));
        let is_turned = self.kind == JointKind::Weld && self.from.is_some();
        place.chain(is_turned.then(|| (self.turn_symbol(), Measure::Angle))).collect()
    }

    /// What the states of its seat are, in kinematic symbols.
    pub(crate) fn seat_values(&self) -> Vec<Expr> {
        let place = match &self.ends {
            [first, Anchor::Material(second)] if self.is_seated => {
                let away = first.position() - second.body.position();
                crate::kinematics::rotated(&away, &-second.body.angle()).components().to_vec()
            }
            _ => vec![],
        };
        let is_turned = self.kind == JointKind::Weld && self.from.is_some();
        place.into_iter().chain(is_turned.then(|| self.sum(Kinematics::angle))).collect()
    }

    /// The sides that belong to bodies.
    pub(crate) fn sides(&self) -> impl Iterator<Item = Side<'_>> {
        self.ends.iter().zip([1, -1]).filter_map(|(end, sign)| match end {
            Anchor::Material(point) => Some(Side { point, sign }),
            Anchor::World(_) => None,
        })
    }

    /// What it does to its bodies, by the symbols of its multipliers.
    pub(crate) fn terms(&self, body_index: impl Fn(&str) -> usize) -> Vec<Term> {
        let multipliers: Vec<Expr> = self.multipliers().into_iter().map(Expr::from).collect();
        let force = Vector::planar(multipliers[0].clone(), multipliers[1].clone());
        let couple = multipliers.get(2).cloned().unwrap_or_else(Expr::zero);
        let term = |Side { point, sign }: Side<'_>| Term {
            load: self.name.clone(),
            law: Law::Reaction,
            body: body_index(&point.body.body),
            arm: point.world_arm(),
            force: if sign > 0 { force.clone() } else { -&force },
            couple: if sign > 0 { couple.clone() } else { -&couple },
            window: None,
        };
        self.sides().map(term).collect()
    }

    /// Its conditions, in the order of its multipliers; `angle` is that at the start of the first body against the second, rad.
    pub(crate) fn rows(&self, angle: &Expr, body_index: impl Fn(&str) -> usize) -> Vec<Row> {
        let [x, y] = [[1, 0], [0, 1]].map(|[x, y]| Vector::planar(x.into(), y.into()));
        let turning = Vector::planar(Expr::zero(), Expr::zero());
        let conditions = self.conditions(angle).into_iter().zip([x, y, turning]);
        let row =
            |(([position, rate, acceleration], direction), multiplier): (([Expr; 3], Vector), Symbol)| {
                let is_turning = direction.components().iter().all(Expr::is_zero);
                let wrench = |Side { point, sign }: Side<'_>| Wrench {
                    body: body_index(&point.body.body),
                    arm: point.world_arm(),
                    force: if sign > 0 { direction.clone() } else { -&direction },
                    couple: if is_turning { sign.into() } else { Expr::zero() },
                };
                let measure = if is_turning { Measure::Angle } else { Measure::Length };
                Row {
                    multiplier,
                    wrenches: self.sides().map(wrench).collect(),
                    position,
                    rate,
                    acceleration,
                    measure,
                }
            };
        conditions.zip(self.multipliers()).map(row).collect()
    }

    /// What is zero, with its first and second derivative by the time: apart along x and y, turned.
    fn conditions(&self, angle: &Expr) -> Vec<[Expr; 3]> {
        let [a, b] = &self.ends;
        let apart =
            [a.position() - b.position(), a.velocity() - b.velocity(), acceleration(a) - acceleration(b)];
        let along = |axis: usize| apart.each_ref().map(|vector| vector[axis].clone());
        let angle = if self.from.is_some() { self.turn_symbol().into() } else { angle.clone() };
        let turned = (self.kind == JointKind::Weld).then(|| {
            [self.sum(Kinematics::angle) - angle, self.sum(Kinematics::omega), self.sum(Kinematics::alpha)]
        });
        [along(0), along(1)].into_iter().chain(turned).collect()
    }

    /// Of the first body less of the second.
    fn sum(&self, of: fn(&Kinematics) -> Expr) -> Expr {
        self.sides().fold(Expr::zero(), |sum, side| sum + side.sign * of(&side.point.body))
    }

    fn turn_symbol(&self) -> Symbol {
        self.symbol("seat_angle", Dimension::NONE)
    }

    fn symbol(&self, name: &str, dimension: Dimension) -> Symbol {
        Symbol::new(format!("{}.{name}", self.name), dimension)
    }
}

fn acceleration(end: &Anchor) -> Vector {
    match end {
        Anchor::Material(point) => point.acceleration(),
        Anchor::World(place) => rate(&rate(place)),
    }
}
