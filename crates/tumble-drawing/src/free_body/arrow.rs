//! Forces, couples and their units, as they are given to a diagram.

use crate::scale::drawable;
use crate::text::Label;
use crate::theme::{self, LineStyle};

/// What a force comes from; each kind has its own colour and line style.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum ArrowKind {
    /// Weight.
    Weight,
    /// A surface, with or without friction.
    Contact,
    /// The air.
    Air,
    /// Somebody or something outside the model.
    #[default]
    Applied,
    /// A spring or damper.
    Spring,
    /// A pivot or another support.
    Reaction,
    /// A sum of forces, drawn hollow.
    Resultant,
}

impl ArrowKind {
    /// The word for it in legends and descriptions, and colour and line style of its arrows.
    fn looks(self) -> (&'static str, LineStyle) {
        match self {
            ArrowKind::Weight => ("weight", theme::WEIGHT),
            ArrowKind::Contact => ("contact", theme::CONTACT),
            ArrowKind::Air => ("air", theme::AIR),
            ArrowKind::Applied => ("applied", theme::APPLIED),
            ArrowKind::Spring => ("spring", theme::SPRING),
            ArrowKind::Reaction => ("reaction", theme::REACTION),
            ArrowKind::Resultant => ("sum", theme::RESULTANT),
        }
    }

    /// The word for it in legends and descriptions.
    pub fn name(self) -> &'static str {
        self.looks().0
    }

    /// Colour and line style of its arrows.
    pub fn style(self) -> LineStyle {
        self.looks().1
    }

    /// A symbol, or the word for the kind where there is none.
    fn called(self, symbol: &Label) -> Label {
        if symbol.is_empty() { Label::plain(self.name()) } else { symbol.clone() }
    }
}

/// What arrows stand for, with units as [`Label::unit`] reads them.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ArrowUnit {
    /// The quantity, for descriptions: `force`.
    pub quantity: String,
    /// Unit of arrows: `N`.
    pub arrow: String,
    /// Unit of couples: `N m`.
    pub couple: String,
}

impl ArrowUnit {
    /// Forces in N, couples in N m.
    pub fn force() -> Self {
        Self { quantity: "force".to_owned(), arrow: "N".to_owned(), couple: "N m".to_owned() }
    }

    /// Impulses in N s, angular impulses in N m s.
    pub fn impulse() -> Self {
        Self { quantity: "impulse".to_owned(), arrow: "N s".to_owned(), couple: "N m s".to_owned() }
    }
}

impl Default for ArrowUnit {
    fn default() -> Self {
        Self::force()
    }
}

/// A force (or an impulse) with its point of action.
///
/// Its arrow starts at the point of action, whatever its kind: the tail of a
/// contact force stands on the surface that pushes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Arrow {
    /// What it comes from.
    pub kind: ArrowKind,
    /// Its symbol, for instance `Label::symbol("N")`; may be empty.
    pub symbol: Label,
    /// Point of action in world coordinates, metres.
    pub point: [f64; 2],
    /// Components in world axes, in the arrow unit of the diagram.
    pub vector: [f64; 2],
}

impl Arrow {
    /// A force of some kind at a point (world, metres).
    pub fn new(kind: ArrowKind, symbol: Label, point: [f64; 2], vector: [f64; 2]) -> Self {
        Self { kind, symbol, point, vector }
    }

    /// Its magnitude, which is printed beside it.
    pub fn magnitude(&self) -> f64 {
        self.vector[0].hypot(self.vector[1])
    }

    /// Whether all its numbers can be drawn.
    pub fn is_drawable(&self) -> bool {
        self.point.into_iter().chain(self.vector).chain([self.magnitude()]).all(drawable)
    }

    /// Its symbol, or the word for its kind.
    pub fn name(&self) -> Label {
        self.kind.called(&self.symbol)
    }
}

/// A couple: turning without a force, drawn as a circular arrow about the centre of mass.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Couple {
    /// What it comes from.
    pub kind: ArrowKind,
    /// Its symbol, for instance `Label::symbol("tau")`.
    pub symbol: Label,
    /// Counter-clockwise, in the couple unit of the diagram.
    pub value: f64,
}

impl Couple {
    /// A couple of some kind, counter-clockwise.
    pub fn new(kind: ArrowKind, symbol: Label, value: f64) -> Self {
        Self { kind, symbol, value }
    }

    /// Its symbol, or the word for its kind.
    pub fn name(&self) -> Label {
        self.kind.called(&self.symbol)
    }
}

/// A velocity, drawn thin: it is no force.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Velocity {
    /// Its symbol, for instance `Label::symbol("V")`.
    pub symbol: Label,
    /// Where its arrow starts, in world coordinates, metres.
    pub point: [f64; 2],
    /// Components in world axes, m/s.
    pub vector: [f64; 2],
}

impl Velocity {
    /// A velocity at a point (world, metres).
    pub fn new(symbol: &str, point: [f64; 2], vector: [f64; 2]) -> Self {
        Self { symbol: Label::symbol(symbol), point, vector }
    }

    pub(super) fn speed(&self) -> f64 {
        self.vector[0].hypot(self.vector[1])
    }

    pub(super) fn is_drawable(&self) -> bool {
        self.point.into_iter().chain(self.vector).chain([self.speed()]).all(drawable)
    }
}

/// A force that is spread along a line: a row of arrows, whose sum is drawn as a force of its own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DistributedForce {
    /// What it comes from.
    pub kind: ArrowKind,
    /// Point (world, metres) and force per length, N/m, from one end of the line to the other.
    pub arrows: Vec<[[f64; 2]; 2]>,
}

impl DistributedForce {
    /// The greatest force per length, N/m.
    pub(super) fn largest(&self) -> f64 {
        self.arrows.iter().map(|[_, force]| force[0].hypot(force[1])).fold(0.0, f64::max)
    }

    pub(super) fn is_drawable(&self) -> bool {
        self.arrows.iter().flatten().flatten().copied().chain([self.largest()]).all(drawable)
    }
}
