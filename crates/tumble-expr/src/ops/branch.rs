//! Functions with a branch: abs, sign, step, min, max and if.
//!
//! Each has a guard, a slot whose sign says which side holds. Within a step the side is frozen, so the function is as
//! smooth as the side it is on; whoever takes the step watches the guard.

use crate::Scalar;

/// 1 on the branch's positive side, 0 on the other.
pub(crate) fn step<S: Scalar>(sign: S) -> S {
    sign.choose(S::one(), S::zero())
}
