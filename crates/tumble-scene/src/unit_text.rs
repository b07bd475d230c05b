//! Units as a user wrote them, for labels.

use tumble_expr::Expr;
use tumble_expr::language::{Scope, Syntax, Value, parse};
use tumble_mech::Parameters;

use crate::formula::Want;

/// Smaller numbers are written with a power of ten, not with a row of zeros.
const SMALL: f64 = 1e-4;

/// A unit with its size.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct UnitText {
    text: String,
    /// SI units.
    size: f64,
}

impl UnitText {
    /// The unit of a quantity that stands alone, such as `0.5 s`.
    pub(crate) fn of(quantity: &str) -> Option<Self> {
        let formula = parse(quantity).ok()?;
        let chain = formula.tree().nodes.iter().find_map(|node| match &node.syntax {
            Syntax::Quantity { chain, .. } => chain.as_ref(),
            _ => None,
        });
        let alone = formula
            .tree()
            .nodes
            .iter()
            .all(|node| matches!(node.syntax, Syntax::Quantity { .. } | Syntax::Sign { .. }));
        let text = &quantity[chain?.span.clone()];
        let (_, size) = alone.then(|| unit(text)).flatten()?;
        Some(Self { text: text.to_owned(), size })
    }

    /// The SI unit of what is wanted.
    pub(crate) fn si(want: Want) -> Self {
        let example = want.example("1");
        Self { text: example.trim_start_matches("1").trim().to_owned(), size: 1.0 }
    }

    /// As it was written.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// One of it in SI units.
    pub(crate) fn size(&self) -> f64 {
        self.size
    }

    /// A number of SI units in this one.
    pub(crate) fn number(&self, value: f64) -> f64 {
        value / self.size
    }

    /// A number of SI units in this one, six digits.
    pub(crate) fn write(&self, value: f64) -> String {
        let digits = format!("{:.5e}", value / self.size);
        let number: f64 = digits.parse().unwrap_or(value / self.size);
        let is_small = number != 0.0 && number.abs() < SMALL;
        let number = if is_small { format!("{number:e}") } else { number.to_string() };
        format!("{number} {}", self.text).trim_end().to_owned()
    }
}

/// A chain of units such as `m/s`: one of it as a formula, and how many SI units it is.
pub(crate) fn unit(text: &str) -> Option<(Expr, f64)> {
    let formula = parse(&format!("1 {text}")).ok()?;
    let [node] = &formula.tree().nodes[..] else { return None };
    if !matches!(&node.syntax, Syntax::Quantity { chain: Some(_), .. }) {
        return None;
    }
    let Ok(Value::Scalar(one)) = formula.check(&Scope::new()) else { return None };
    let size = Parameters::default().evaluate(std::slice::from_ref(&one)).ok()?;
    Some((one, size[0]))
}
