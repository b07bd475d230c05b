//! Exact numbers: powers, roots and common divisors.

use num_bigint::BigInt;
use num_integer::{Integer, gcd};
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};
use tumble_expr::Exponent;

/// An exact number.
pub(crate) type Rational = BigRational;

/// Bits beyond which exact numbers are not kept: powers of powers would outgrow memory.
pub(crate) const LARGEST_BITS: u64 = 4096;

/// `numerator / denominator`, which must not be zero.
pub(crate) fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

pub(crate) fn bits(value: &Rational) -> u64 {
    value.numer().bits().max(value.denom().bits())
}

/// `value^exponent`, unless it is infinite or outgrows [`LARGEST_BITS`].
pub(crate) fn power(value: &Rational, exponent: i32) -> Option<Rational> {
    let long = bits(value).saturating_sub(1).saturating_mul(exponent.unsigned_abs().into()) > LARGEST_BITS;
    let infinite = value.is_zero() && exponent < 0;
    (!long && !infinite).then(|| value.pow(exponent))
}

/// The root of that order of a positive integer, where it is one.
pub(crate) fn exact_root(value: &BigInt, order: u32) -> Option<BigInt> {
    let root = value.nth_root(order);
    (root.pow(order) == *value).then_some(root)
}

/// An integer as `a^order b` with the small primes' powers in a.
pub(crate) fn powers_out(value: &Rational, order: u32) -> (Rational, Rational) {
    let (mut outside, mut inside) = (Rational::one(), value.clone());
    // Only small powers: a long number stays as it is soon enough.
    if order > 4 || bits(value) > 64 {
        return (outside, inside);
    }
    for prime in [2, 3, 5, 7].map(|prime| ratio(prime, 1)) {
        let divisor = prime.pow(i32::try_from(order).unwrap_or(1));
        while (&inside / &divisor).is_integer() {
            inside /= &divisor;
            outside *= &prime;
        }
    }
    (outside, inside)
}

/// `a b`. Most numbers of formulas are short: what they take as machine integers is a fraction of what long ones do.
pub(crate) fn times(a: &Rational, b: &Rational) -> Rational {
    match (short(a), short(b)) {
        (Some((1, 1)), _) => b.clone(),
        (_, Some((1, 1))) => a.clone(),
        (Some(a), Some(b)) => product(a, b),
        _ => a * b,
    }
}

/// `a / b`, where b is not zero.
pub(crate) fn over(a: &Rational, b: &Rational) -> Rational {
    match (short(a), short(b)) {
        (_, Some((1, 1))) => a.clone(),
        (Some(a), Some((p, q))) if q <= i64::MAX as u64 => {
            product(a, (if p < 0 { -(q as i64) } else { q as i64 }, p.unsigned_abs()))
        }
        _ => a / b,
    }
}

/// `a + b`.
pub(crate) fn plus(a: &Rational, b: &Rational) -> Rational {
    let (Some((n, d)), Some((p, q))) = (short(a), short(b)) else { return a + b };
    let shared = gcd(d, q);
    let sum = i128::from(n) * i128::from(q / shared) + i128::from(p) * i128::from(d / shared);
    // What can still be cancelled divides what the denominators share.
    let rest = if shared == 1 { 1 } else { gcd((sum.unsigned_abs() % u128::from(shared)) as u64, shared) };
    fraction(sum / i128::from(rest), u128::from(d / shared) * u128::from(q / rest))
}

/// The greatest number of which both are integer multiples; positive.
pub(crate) fn common_divisor(a: &Rational, b: &Rational) -> Rational {
    let (Some((n, d)), Some((p, q))) = (short(a), short(b)) else {
        return Rational::new((a.numer() * b.denom()).gcd(&(b.numer() * a.denom())), a.denom() * b.denom());
    };
    let multiple = u128::from(d / gcd(d, q)) * u128::from(q);
    let shared = gcd(n.unsigned_abs(), p.unsigned_abs());
    if shared == 0 { Rational::zero() } else { fraction(i128::from(shared), multiple) }
}

/// Numerator and denominator, where they are machine integers.
fn short(value: &Rational) -> Option<(i64, u64)> {
    Some((value.numer().to_i64()?, value.denom().to_i64()?.unsigned_abs()))
}

/// The product of two fractions in lowest terms.
fn product((n, d): (i64, u64), (p, q): (i64, u64)) -> Rational {
    let [left, right] = [gcd(n.unsigned_abs(), q), gcd(p.unsigned_abs(), d)].map(i128::from);
    let above = (i128::from(n) / left) * (i128::from(p) / right);
    let below = (i128::from(d) / right) * (i128::from(q) / left);
    fraction(above, below.unsigned_abs())
}

/// A fraction that is in lowest terms.
fn fraction(numerator: i128, denominator: u128) -> Rational {
    let denominator = if numerator == 0 { 1 } else { denominator };
    Rational::new_raw(numerator.into(), denominator.into())
}

/// An exponent as it is kept, unless it is out of range.
pub(crate) fn exponent(value: &Rational) -> Option<Exponent> {
    let numerator = i32::try_from(value.numer()).ok()?;
    // The smallest integer has no negative.
    let usable = numerator != i32::MIN;
    usable.then_some(Exponent::new(numerator, i32::try_from(value.denom()).ok()?))
}

/// Whether this is an integer and even.
pub(crate) fn is_even(exponent: &Exponent) -> bool {
    exponent.is_integer() && exponent.numer() % 2 == 0
}

/// Whether this is an integer and odd.
pub(crate) fn is_odd(exponent: &Exponent) -> bool {
    exponent.is_integer() && exponent.numer() % 2 != 0
}

/// Whether a number is 1 or -1.
pub(crate) fn is_unit(value: &Rational) -> bool {
    value.abs().is_one()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Short and long, whole and broken, near the ends of machine integers too.
    fn number() -> impl Strategy<Value = Rational> {
        let part = || {
            prop_oneof![
                -9..9_i64,
                Just(i64::from(i32::MIN)),
                Just(i64::from(i32::MAX)),
                Just(i64::MIN),
                Just(i64::MAX),
                any::<i32>().prop_map(i64::from),
                any::<i64>()
            ]
        };
        let longer = prop_oneof![4 => Just(1_i64), 1 => any::<i64>()];
        (part(), part(), longer).prop_map(|(n, d, by)| {
            let long = BigInt::from(n) * BigInt::from(by);
            Rational::new(long, if d == 0 { 1 } else { d }.into())
        })
    }

    proptest! {
        #[test]
        fn short_numbers_are_reckoned_as_long_ones(a in number(), b in number()) {
            let same = |fast: Rational, exact: Rational| fast.numer() == exact.numer() && fast.denom() == exact.denom();
            prop_assert!(same(times(&a, &b), &a * &b));
            prop_assert!(same(plus(&a, &b), &a + &b));
            prop_assert!(b.is_zero() || same(over(&a, &b), &a / &b));
            let long = (a.numer() * b.denom()).gcd(&(b.numer() * a.denom()));
            let both_zero = a.is_zero() && b.is_zero();
            prop_assert!(both_zero || same(common_divisor(&a, &b), Rational::new(long, a.denom() * b.denom())));
        }
    }
}
