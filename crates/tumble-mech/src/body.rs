//! A rigid body: parts or stated mass properties, and named points.

use tumble_expr::{Expr, Vector};

use crate::friction::Friction;
use crate::kinematics::{Kinematics, PointRef};
use crate::mass::MassProperties;
use crate::shape::Shape;

/// A shape with its mass; a hole is a part of negative mass.
#[derive(Clone, Debug)]
pub struct Part {
    /// What it looks like.
    pub shape: Shape,
    /// kg
    pub mass: Expr,
}

/// A rigid body in the plane, described in its own coordinates at angle zero, with any origin.
#[derive(Clone, Debug)]
pub struct Body {
    /// Its name.
    pub name: String,
    /// What it is made of, or, with stated mass properties, what it looks like.
    pub parts: Vec<Part>,
    /// Named points in body coordinates; `cm`, the centre of mass, is always there.
    pub points: Vec<(String, Vector)>,
    /// Mass properties that are given and not computed from the parts.
    pub stated: Option<MassProperties>,
    /// Its own restitution on rigid surfaces, 0 to 1, in the place of theirs.
    pub restitution: Option<Expr>,
    /// Its own dry friction on what is rigid, in the place of theirs.
    pub friction: Option<Friction>,
}

impl Body {
    /// A body of several parts joined rigidly.
    pub fn from_parts(name: impl Into<String>, parts: Vec<Part>) -> Self {
        Self { name: name.into(), parts, points: vec![], stated: None, restitution: None, friction: None }
    }

    /// A body of one shape; its mass is set by [`Body::mass`].
    pub fn of_shape(name: impl Into<String>, shape: Shape) -> Self {
        Self::from_parts(name, vec![Part { shape, mass: Expr::zero() }])
    }

    /// A thin uniform rod between two points, m.
    pub fn rod(name: impl Into<String>, from: [Expr; 2], to: [Expr; 2]) -> Self {
        Self::of_shape(name, Shape::Rod { from: vector(from), to: vector(to), end_radius: Expr::zero() })
    }

    /// A solid ball of that radius, m, about the origin.
    pub fn ball(name: impl Into<String>, radius: Expr) -> Self {
        Self::of_shape(name, Shape::Ball { centre: origin(), radius })
    }

    /// A thin spherical shell of that radius, m, about the origin.
    pub fn shell(name: impl Into<String>, radius: Expr) -> Self {
        Self::of_shape(name, Shape::Shell { centre: origin(), radius })
    }

    /// A mass without extent at the origin.
    pub fn point(name: impl Into<String>) -> Self {
        Self::of_shape(name, Shape::Point { at: origin() })
    }

    /// The same body with its first part's mass, kg.
    #[must_use]
    pub fn mass(mut self, mass: Expr) -> Self {
        if let Some(part) = self.parts.first_mut() {
            part.mass = mass;
        }
        self
    }

    /// The same body with a named point, m, body coordinates.
    #[must_use]
    pub fn with_point(mut self, name: impl Into<String>, at: [Expr; 2]) -> Self {
        self.points.push((name.into(), vector(at)));
        self
    }

    /// What messages call a part, by its index: the body itself where there is one only.
    pub(crate) fn part_name(&self, index: usize) -> String {
        match self.parts.len() {
            1 => format!("`{}`", self.name),
            _ => format!("part {} of `{}`", index + 1, self.name),
        }
    }

    /// Mass, centre of mass and moment of inertia.
    pub fn mass_properties(&self) -> MassProperties {
        match &self.stated {
            Some(stated) => stated.clone(),
            None => {
                let parts: Vec<MassProperties> = self.parts.iter().map(MassProperties::of_part).collect();
                MassProperties::joined(&parts)
            }
        }
    }

    /// Position, velocity and angle of this body as formulas.
    pub fn kinematics(&self) -> Kinematics {
        Kinematics::new(&self.name)
    }

    /// The centre of mass as a point of the body.
    pub fn cm(&self) -> PointRef {
        PointRef { body: self.kinematics(), arm: Vector::planar(Expr::zero(), Expr::zero()) }
    }

    /// A point of the body given in body coordinates, m.
    pub fn at(&self, local: &Vector) -> PointRef {
        PointRef { body: self.kinematics(), arm: local - self.mass_properties().centre }
    }

    /// Points of the body given in body coordinates, m: all refer to one formula of the centre of mass.
    pub fn points_at<'l>(&self, locals: impl IntoIterator<Item = &'l Vector>) -> Vec<PointRef> {
        let centre = self.mass_properties().centre;
        let at = |local: &Vector| PointRef { body: self.kinematics(), arm: local - &centre };
        locals.into_iter().map(at).collect()
    }

    /// A named point; `None` where there is none of that name.
    pub fn named_point(&self, name: &str) -> Option<PointRef> {
        if name == "cm" {
            return Some(self.cm());
        }
        self.points.iter().find(|(known, _)| known == name).map(|(_, local)| self.at(local))
    }

    /// Largest distance of its matter from its centre of mass, m.
    pub fn reach(&self) -> Expr {
        let centre = self.mass_properties().centre;
        let reaches =
            self.parts.iter().map(|part| (part.shape.centre() - &centre).norm() + part.shape.reach());
        reaches
            .reduce(|far, next| Expr::binary(tumble_expr::Binary::Max, far, next))
            .unwrap_or_else(Expr::zero)
    }
}

fn vector([x, y]: [Expr; 2]) -> Vector {
    Vector::planar(x, y)
}

fn origin() -> Vector {
    Vector::planar(Expr::zero(), Expr::zero())
}
