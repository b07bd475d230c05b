//! # Law
//! Air resistance at a point, with u the velocity of the air relative to the point: `F = b u + c |u| u`. Of the normal
//! component only: `F = (b u_n + c |u_n| u_n) n`. Along a line, the same for each piece of its length, with b and c a
//! length; a ball of radius R has `c = rho C_d pi R^2 / 2`.
//! # Symbols and units
//! u (m/s), b linear (kg/s at a point, kg/(m s) along a line), c quadratic (kg/m at a point, kg/m^2 along a line),
//! rho density of the air (kg/m^3), C_d drag coefficient, R (m).
//! # Sign and frame
//! World axes; u is the wind minus the velocity of the point, so the force is along u. n is the line's direction turned
//! counter-clockwise.
//! # Validity
//! Any speed, through zero too. The normal component along a line is integrated exactly where the wind is affine along
//! it: u_n is affine too, and with U its value in the middle and d its change, `integral of |u|u` is
//! `s (U^2 + d^2/12)` where u keeps its sign s and `s (U d/2 + 2 U^3/(3 d))` where it changes, s being the sign of d;
//! about the middle the moments are `s U d/6` and `s (U^2/4 + d^2/32 - U^4/(6 d^2))`, each times the length (and its
//! square). The full component, or another wind, is summed over Gauss nodes.
//! # Source
//! Newton's resistance law; the integrals are elementary.
//! # Checked by
//! `tests/air.rs` (a rod falling flat, a spinning rod, a sign change along the rod, a box that has all but stopped turning, the
//! reference of the thrown rod).

use tumble_expr::{Binary, Dimension, Expr, Relation, Symbol, Vector, Written, is_identically_zero};

use crate::air::Wind;
use crate::gauss;
use crate::interaction::{Bodies, Interaction};
use crate::kinematics::PointRef;
use crate::statement::{Statement, sum, times, vanishes};
use crate::term::{Law, Term};

/// Air resistance on one body.
#[derive(Clone, Debug)]
pub struct Drag {
    /// Its name.
    pub name: String,
    /// Where it acts.
    pub on: DragPlace,
    /// Coefficient of u; `None` is none.
    pub linear: Option<Expr>,
    /// Coefficient of |u| u; `None` is none.
    pub quadratic: Option<Expr>,
}

/// Where air resistance acts.
#[derive(Clone, Debug)]
pub enum DragPlace {
    /// At one point, against its whole velocity.
    Point(PointRef),
    /// At the centre of a ball, whose quadratic coefficient was made of these.
    Ball {
        /// The centre.
        centre: PointRef,
        /// Density of the air, kg/m^3.
        density: Expr,
        /// Drag coefficient.
        coefficient: Expr,
    },
    /// At one point, against the component along a direction in body axes.
    PointNormal(PointRef, Vector),
    /// Along straight lines between pairs of points of one body.
    Lines {
        /// Ends of each line.
        lines: Vec<[PointRef; 2]>,
        /// Which component of the velocity counts.
        component: Component,
    },
}

/// Component of the relative velocity that air resistance along a line depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// The whole vector.
    Full,
    /// Across the line.
    Normal,
}

impl Drag {
    /// On a ball of that radius, m, in air of that density, kg/m^3, with a drag coefficient.
    pub fn ball(
        name: impl Into<String>,
        at: PointRef,
        radius: &Expr,
        density: Expr,
        coefficient: Expr,
    ) -> Self {
        let area = Expr::pi() * (radius * radius);
        let quadratic = Some(&density * &coefficient * area / 2);
        let on = DragPlace::Ball { centre: at, density, coefficient };
        Self { name: name.into(), on, linear: None, quadratic }
    }

    fn at_point(&self, point: &PointRef, wind: &Wind) -> Vector {
        let u = relative(point, wind);
        self.along_vector(&u)
    }

    fn along_vector(&self, u: &Vector) -> Vector {
        let zero = || Vector::planar(Expr::zero(), Expr::zero());
        let linear = self.linear.as_ref().map_or_else(zero, |b| b * u);
        let quadratic = self.quadratic.as_ref().map_or_else(zero, |c| (c * u.norm()) * u);
        linear + quadratic
    }

    /// b u + c |u| u of one component.
    fn along_axis(&self, u: &Expr) -> Expr {
        let linear = self.linear.as_ref().map_or_else(Expr::zero, |b| b * u);
        let quadratic = self.quadratic.as_ref().map_or_else(Expr::zero, |c| c * u.abs() * u);
        linear + quadratic
    }

    fn on_line(&self, [from, to]: &[PointRef; 2], component: Component, bodies: &Bodies<'_>) -> Resultant {
        let line = Line::new(from, to);
        if component == Component::Normal && bodies.wind.is_affine() {
            return self.exact(&line, bodies.wind);
        }
        let mut sum = Resultant::nothing(line.middle());
        for (node, weight) in gauss::rule(bodies.nodes) {
            let point = line.at(node);
            let u = relative(&point, bodies.wind);
            let density = match component {
                Component::Full => self.along_vector(&u),
                Component::Normal => self.along_axis(&dot(&u, &line.normal)) * &line.normal,
            };
            let force = (&line.length * weight / 2) * density;
            let arm = (Expr::from(node) / 2) * &line.span;
            sum.couple = sum.couple + arm.cross_planar(&force);
            sum.force = sum.force + force;
        }
        sum
    }

    /// `b u + c |u| u`, as it is written, of the whole velocity or of its component along a direction.
    fn said(&self, u: &Written, normal: Option<&Written>, number: &str) -> Written {
        let along = match normal {
            Some(normal) => Written::named(&format!("u_n{number}"), u.clone().dot(normal.clone())),
            None => u.clone(),
        };
        let direction = || normal.cloned().into_iter();
        let linear = self.linear.as_ref().map(|b| {
            let factors = std::iter::once(along.clone()).chain(direction());
            times(b, factors.collect())
        });
        let quadratic = self.quadratic.as_ref().map(|c| {
            let factors = [along.clone().norm(), along.clone()].into_iter().chain(direction());
            times(c, factors.collect())
        });
        sum(linear.into_iter().chain(quadratic).collect())
    }

    /// The force and the torque of one line, as integrals.
    fn said_along(
        &self,
        ends: &[PointRef; 2],
        number: &str,
        component: Component,
        wind: &Wind,
    ) -> [Written; 2] {
        let line = WrittenLine::new(&self.name, ends, number);
        let wind = written_wind(wind, &line.place);
        let is = against(line.velocity.clone(), wind);
        let u = Written::function(&format!("u{number}"), &line.variable, is);
        let normal = (component == Component::Normal).then_some(&line.normal);
        let density = self.said(&u, normal, number);
        [line.integral(density.clone()), line.integral(line.arm.clone().cross(density))]
    }

    /// The integrals of the law's header.
    fn exact(&self, line: &Line, wind: &Wind) -> Resultant {
        let [u0, u1] = [&line.from, &line.to].map(|end| dot(&relative(end, wind), &line.normal));
        // Not `u1 - u0`: in that, the velocity of a body that hardly turns hides the little that u changes by.
        let gust = wind.at(&line.to.position()) - wind.at(&line.from.position());
        let change = dot(&gust, &line.normal) - line.from.body.omega() * &line.length;
        let middle = (&u0 + &u1) / 2;
        let (mut force, mut moment) = (Expr::zero(), Expr::zero());
        if let Some(b) = &self.linear {
            force = force + b * &middle;
            moment = moment + b * &change / 12;
        }
        if let Some(c) = &self.quadratic {
            let (q, m) = integrals(&u0, &u1, &middle, &change);
            force = force + c * q;
            moment = moment + c * m;
        }
        Resultant {
            at: line.middle(),
            force: (force * &line.length) * &line.normal,
            couple: moment * (&line.length * &line.length),
        }
    }
}

/// Integrals over a unit length of |u| u, and of it times the distance from the middle, for u affine from u0 to u1.
fn integrals(u0: &Expr, u1: &Expr, middle: &Expr, change: &Expr) -> (Expr, Expr) {
    let one_sign = middle.sign();
    let kept = (&one_sign * (middle * middle + change * change / 12), &one_sign * (middle * change) / 6);
    let rising = change.sign();
    let ratio = Expr::binary(Binary::SquareOver, middle.clone(), change.clone());
    let changed = (
        &rising * (middle * change / 2 + 2 * middle * &ratio / 3),
        &rising * (middle * middle / 4 + change * change / 32 - &ratio * &ratio / 6),
    );
    // With `<` what is zero at an end counts as one sign, where both forms agree. Of the product of both, two zeros that are near
    // each other could not be told from none.
    let changes = Expr::compare(Relation::Less, u0 * u1.sign(), Expr::zero());
    (Expr::select(changes.clone(), changed.0, kept.0), Expr::select(changes, changed.1, kept.1))
}

/// A force at a point with a couple.
struct Resultant {
    at: PointRef,
    force: Vector,
    couple: Expr,
}

impl Resultant {
    fn nothing(at: PointRef) -> Self {
        Self { at, force: Vector::planar(Expr::zero(), Expr::zero()), couple: Expr::zero() }
    }
}

struct Line {
    from: PointRef,
    to: PointRef,
    length: Expr,
    /// From one end to the other, world axes.
    span: Vector,
    normal: Vector,
}

impl Line {
    fn new(from: &PointRef, to: &PointRef) -> Self {
        let local = &to.arm - &from.arm;
        let length = local.norm();
        let span = crate::kinematics::rotated(&local, &from.body.angle());
        let normal = (1 / &length) * span.perpendicular();
        Self { from: from.clone(), to: to.clone(), length, span, normal }
    }

    /// The point at -1 (from) to 1 (to).
    fn at(&self, place: f64) -> PointRef {
        let share = (1 + Expr::from(place)) / 2;
        let arm = &self.from.arm + share * (&self.to.arm - &self.from.arm);
        PointRef { body: self.from.body.clone(), arm }
    }

    fn middle(&self) -> PointRef {
        self.at(0.0)
    }
}

/// Velocity of the wind at a place, by its name; nothing where the air is at rest.
pub(crate) fn written_wind(wind: &Wind, place: &Vector) -> Option<Written> {
    let velocity = wind.at(place);
    (!vanishes(&velocity)).then(|| Written::named("w", Written::Vector(velocity)))
}

/// Velocity of the air relative to a point, as it is written.
fn written_relative(point: &PointRef, wind: &Wind) -> Written {
    let velocity = Written::named("v", Written::Vector(point.velocity()));
    Written::named("u", against(velocity, written_wind(wind, &point.position())))
}

/// The wind less a velocity.
fn against(velocity: Written, wind: Option<Written>) -> Written {
    match wind {
        Some(wind) => wind.less(velocity),
        None => velocity.negative(),
    }
}

/// A line as it is written, with s along it.
struct WrittenLine {
    variable: Symbol,
    limits: [Expr; 2],
    arm: Written,
    velocity: Written,
    normal: Written,
    place: Vector,
}

impl WrittenLine {
    /// `number` is that of the line, where there are several.
    fn new(load: &str, [from, to]: &[PointRef; 2], number: &str) -> Self {
        let variable = Symbol::new(format!("{load}.s"), Dimension::LENGTH);
        let s: Expr = variable.clone().into();
        let body = &from.body;
        let local = (1 / (&to.arm - &from.arm).norm()) * (&to.arm - &from.arm);
        // From the centre of mass where that is on the line, else from the line's own beginning.
        let is_central = is_identically_zero(&from.arm.cross_planar(&to.arm));
        let (foot, limits) = match is_central {
            true => (Vector::planar(Expr::zero(), Expr::zero()), [from, to].map(|end| dot(&end.arm, &local))),
            false => (from.arm.clone(), [Expr::zero(), (&to.arm - &from.arm).norm()]),
        };
        let point = PointRef { body: body.clone(), arm: &foot + &s * &local };
        let arm = Written::function(&format!("r{number}"), &variable, Written::Vector(point.world_arm()));
        let centre = Written::named("v", Written::Vector(body.velocity()));
        let turning = Written::Scalar(body.omega()).cross(arm.clone());
        let velocity = Written::Sum(vec![(false, centre), (false, turning)]);
        let normal = crate::kinematics::rotated(&local.perpendicular(), &body.angle());
        let normal = Written::named(&format!("n{number}"), Written::Vector(normal));
        Self { variable, limits, arm, velocity, normal, place: point.position() }
    }

    fn integral(&self, of: Written) -> Written {
        Written::Integral { of: Box::new(of), over: self.variable.clone(), limits: self.limits.clone() }
    }
}

/// Velocity of the air relative to a point.
pub(crate) fn relative(point: &PointRef, wind: &Wind) -> Vector {
    wind.at(&point.position()) - point.velocity()
}

fn dot(a: &Vector, b: &Vector) -> Expr {
    a.x() * b.x() + a.y() * b.y()
}

impl Interaction for Drag {
    fn name(&self) -> &str {
        &self.name
    }

    fn terms(&self, bodies: &Bodies<'_>) -> Vec<Term> {
        let single =
            |at: &PointRef, force: Vector| vec![Resultant { at: at.clone(), force, couple: Expr::zero() }];
        let resultants = match &self.on {
            DragPlace::Point(point) | DragPlace::Ball { centre: point, .. } => {
                single(point, self.at_point(point, bodies.wind))
            }
            DragPlace::PointNormal(point, direction) => {
                let unit = (1 / direction.norm()) * direction;
                let normal = crate::kinematics::rotated(&unit, &point.body.angle());
                let u = dot(&relative(point, bodies.wind), &normal);
                single(point, self.along_axis(&u) * normal)
            }
            DragPlace::Lines { lines, component } => {
                lines.iter().map(|line| self.on_line(line, *component, bodies)).collect()
            }
        };
        let term = |resultant: Resultant| {
            let Resultant { at, force, couple } = resultant;
            bodies.term(&self.name, Law::Drag, &at.body.body, at.world_arm(), force, couple)
        };
        resultants.into_iter().map(term).collect()
    }

    fn statements(&self, bodies: &Bodies<'_>) -> Vec<Statement> {
        let terms = self.terms(bodies);
        let (force, torque) = match &self.on {
            DragPlace::Point(point) | DragPlace::Ball { centre: point, .. } => {
                (self.said(&written_relative(point, bodies.wind), None, ""), None)
            }
            DragPlace::PointNormal(point, direction) => {
                let unit = (1 / direction.norm()) * direction;
                let normal = crate::kinematics::rotated(&unit, &point.body.angle());
                let normal = Written::named("n", Written::Vector(normal));
                (self.said(&written_relative(point, bodies.wind), Some(&normal), ""), None)
            }
            DragPlace::Lines { lines, component } => {
                let (mut forces, mut torques) = (vec![], vec![]);
                for (index, line) in lines.iter().enumerate() {
                    let number = if lines.len() > 1 { (index + 1).to_string() } else { String::new() };
                    let [force, torque] = self.said_along(line, &number, *component, bodies.wind);
                    forces.push(force);
                    torques.push(torque);
                }
                (sum(forces), Some(sum(torques)))
            }
        };
        let first = terms.first().map(|term| Statement { torque, ..Statement::of(term, force) });
        first.into_iter().collect()
    }

    fn bodies(&self) -> Vec<&str> {
        match &self.on {
            DragPlace::Point(point)
            | DragPlace::PointNormal(point, _)
            | DragPlace::Ball { centre: point, .. } => vec![&point.body.body],
            DragPlace::Lines { lines, .. } => {
                lines.iter().map(|[from, _]| from.body.body.as_str()).take(1).collect()
            }
        }
    }

    fn dimensions(&self) -> Vec<(&'static str, Expr, Dimension)> {
        let per = if matches!(self.on, DragPlace::Lines { .. }) { 1 } else { 0 };
        let linear = self.linear.iter().map(|b| ("linear", b.clone(), Dimension::new(-per, 1, -1)));
        let quadratic =
            self.quadratic.iter().map(|c| ("quadratic", c.clone(), Dimension::new(-1 - per, 1, 0)));
        linear.chain(quadratic).collect()
    }

    fn is_quadrature(&self, wind: &Wind) -> bool {
        match &self.on {
            DragPlace::Lines { component: Component::Full, .. } => {
                self.quadratic.is_some() || !wind.is_affine()
            }
            DragPlace::Lines { component: Component::Normal, .. } => !wind.is_affine(),
            DragPlace::Point(_) | DragPlace::PointNormal(..) | DragPlace::Ball { .. } => false,
        }
    }

    fn directions(&self) -> Vec<(&'static str, Vector)> {
        match &self.on {
            DragPlace::Point(_) | DragPlace::Ball { .. } => vec![],
            DragPlace::PointNormal(_, direction) => vec![("direction", direction.clone())],
            DragPlace::Lines { lines, .. } => {
                lines.iter().map(|[from, to]| ("a line", &to.arm - &from.arm)).collect()
            }
        }
    }

    fn nonnegative(&self) -> Vec<(&'static str, Expr, &'static str)> {
        if let DragPlace::Ball { density, coefficient, .. } = &self.on {
            return vec![("density", density.clone(), "kg/m^3"), ("coefficient", coefficient.clone(), "")];
        }
        let linear = self.linear.iter().map(|b| ("linear", b.clone(), "kg/s"));
        linear.chain(self.quadratic.iter().map(|c| ("quadratic", c.clone(), "kg/m"))).collect()
    }
}
