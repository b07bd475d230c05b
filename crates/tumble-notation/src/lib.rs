//! Formulas as mathematics for people: short, in the usual order, and the very formulas that are integrated.
//!
//! [`Notation`] turns a [`tumble_expr::Expr`] by exact algebra into [`Math`], a small tree of what stands on paper, and
//! [`mathml_in_pieces`], [`latex`] and [`text`] write it down. Each [`Line`] keeps what it shows as a formula, so that
//! anyone can put both to the test. [`page_font`] makes pages independent of the reader's fonts.
//!
//! ```
//! use tumble_expr::{Dimension, Expr, units::S};
//! use tumble_notation::{Left, Math, Notation};
//!
//! let (m, g, l) = (
//!     Expr::symbol("m", Dimension::MASS),
//!     Expr::symbol("g", Dimension::ACCELERATION),
//!     Expr::symbol("L", Dimension::LENGTH),
//! );
//! let theta = Expr::symbol("rod.angle", Dimension::NONE);
//! let alpha = -(&l / 2 * theta.sin() * (&m * &g)) / (&m * &l * &l / 12 + &m * (&l / 2).powi(2));
//! let notation = Notation::new().name("rod.angle", "theta").positive(["m", "L"]);
//! let left = Left::symbol(Math::derivative("theta", 2));
//! let shown = notation.equation(left, &alpha)?;
//! assert_eq!(shown.text(), "θ″ = −(3 g/(2 L)) sin θ");
//! # Ok::<(), tumble_notation::MathError>(())
//! ```

mod algebra;
mod as_written;
mod board;
mod closed_form;
mod error;
mod font;
mod known;
mod latex;
mod layers;
mod layout;
mod mathml;
mod monomial;
mod notation;
mod numbers;
pub mod numeral;
mod order;
mod print;
mod rational;
mod spelling;
mod symbol;
mod text;

pub use as_written::as_written;
pub use closed_form::{ClosedForm, integrate_twice, polynomial_in};
pub use error::MathError;
pub use font::{FAMILY, page_font};
pub use latex::latex;
pub use layout::{Math, Operator};
pub use mathml::mathml_in_pieces;
pub use monomial::monomial_of;
pub use notation::{Left, Line, Notation, Printed};
pub use symbol::{Identifier, is_letter};
pub use text::text;
