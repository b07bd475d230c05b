//! Zeros and integrals to all digits.

use std::sync::OnceLock;

use super::real::Real;

/// Halvings until a function is as good as straight, and secants from there on until its zero is known to all digits.
const HALVINGS: usize = 24;
const SECANTS: usize = 8;
/// Points of a quadrature are so many to one, ...
const FINE: i64 = 8;
/// ... up to the last of them, which are within 1e-60 of the ends: no rounding of these shows, and powers of distances down to -3/5 leave 1e-24.
const LAST: i64 = 36;

/// Where a smooth increasing function is zero.
pub(crate) fn root(of: impl Fn(&Real) -> Real, [low, high]: [&Real; 2]) -> Real {
    let (mut low, mut high) = (low.clone(), high.clone());
    for _ in 0..HALVINGS {
        let middle = (&low + &high) / 2;
        if of(&middle).sign() < 0 { low = middle } else { high = middle }
    }
    let (mut before, mut now) = ((of(&low), low), (of(&high), high));
    for _ in 0..SECANTS {
        let rise = &now.0 - &before.0;
        if rise.is_zero() {
            break;
        }
        let next = &now.1 - &now.0 * (&now.1 - &before.1) / rise;
        before = std::mem::replace(&mut now, (of(&next), next));
    }
    now.1
}

/// An integral by the substitution x = tanh((pi/2) sinh t) (Takahasi and Mori 1974), which powers at the ends do not hurt. The function is told
/// the distances from both ends.
pub(crate) fn integral(of: impl Fn([Real; 2]) -> Real, [low, high]: [&Real; 2]) -> Real {
    let wide = high - low;
    let term = |Node { from, to, weight }: &Node| of([&wide * from, &wide * to]) * weight;
    nodes().iter().map(term).fold(Real::zero(), |sum, term| sum + term) * wide
}

/// Parts of the way from either end, and what the function there counts.
struct Node {
    from: Real,
    to: Real,
    weight: Real,
}

fn nodes() -> &'static [Node] {
    static NODES: OnceLock<Vec<Node>> = OnceLock::new();
    let node = |step: i64| {
        let t = Real::from(step) / FINE;
        let e = (Real::pi() * t.sinh()).exp();
        let [from, to] = [&e / (1 + &e), 1 / (1 + &e)];
        let weight = Real::pi() * t.cosh() * &from * &to / FINE;
        Node { from, to, weight }
    };
    NODES.get_or_init(|| (-LAST..=LAST).map(node).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_at_the_ends() {
        // B(2/5, 1/2) and B(1/2, 1/2) = pi.
        let beta = |power: [i64; 2]| {
            integral(|[x, y]| 1 / (x.power_of(power) * y.sqrt()), [&Real::zero(), &Real::from(1)])
        };
        assert!((beta([1, 2]) - Real::pi()).abs() < Real::read("1e-29"));
        let known = Real::read("3.6790939804058808217");
        assert!((beta([3, 5]) - known).abs() < Real::read("1e-18"));
    }

    #[test]
    fn zeros() {
        let two = root(|x| x.squared() - 2, [&Real::zero(), &Real::from(2)]);
        assert!((two - Real::from(2).sqrt()).abs() < Real::read("1e-70"));
    }
}
