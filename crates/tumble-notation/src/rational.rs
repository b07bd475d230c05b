//! Exact numbers: powers, roots and common divisors.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
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

/// The greatest number of which both are integer multiples; positive.
pub(crate) fn common_divisor(a: &Rational, b: &Rational) -> Rational {
    let cross = |p: &Rational, q: &Rational| p.numer() * q.denom();
    Rational::new(gcd(cross(a, b), cross(b, a)), a.denom() * b.denom())
}

fn gcd(a: BigInt, b: BigInt) -> BigInt {
    let (mut a, mut b) = (a.abs(), b.abs());
    while !b.is_zero() {
        (a, b) = (b.clone(), a % b);
    }
    a
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
