//! Linear complementarity problems: `w = b + A z`, `w >= 0`, `z >= 0`, `w . z = 0`, A symmetric, not negative; or, where friction is
//! tied to pushes, nearly so.
//!
//! They are solved by an active set (Lawson and Hanson 1974, with the exchanges of Keller 1973 where contacts depend on each other):
//! the contact that closes fastest is pushed until it stands still, those that would come to pull leave on the way, and so on. Each
//! round ends with a push of some length, so `z.Az/2 + b.z` falls in each and no set comes twice. Where friction is tied to pushes and they
//! come to no end, complementary pivoting has the last word.

use nalgebra::{DMatrix, DVector};

use crate::contact::lemke;

/// What is negative by less than this part of the numbers that it is made of is zero but for rounding.
pub(crate) const ZERO: f64 = 1e-11;
/// Contacts whose responses are dependent to this relative size of a pivot are not told apart.
pub(crate) const DEPENDENT: f64 = 1e-9;
/// Rounding leaves no more than this part of the numbers that a pivot is the difference of: each has passed through some tens of operations.
const PIVOT_ROUNDING: f64 = 64.0 * f64::EPSILON;
/// A sum that is this part of its terms is none but for rounding: what pushes and impulses do balances to some tens of rounding errors.
pub(crate) const BALANCES: f64 = 64.0 * f64::EPSILON;
/// What closes slower than the fastest by less than this part closes as fast: which of two feet enters is not left to rounding.
const AS_FAST: f64 = 1e-6;
/// Rounds for each contact. Few contacts enter twice; more rounds than this are rounding that goes around in circles.
const ROUNDS: usize = 10;

/// A solution z: the w are the same for all solutions, and so is the motion. `None` if there is none: contacts close that nothing
/// parts, or numbers are not finite.
pub(crate) fn solve(a: &DMatrix<f64>, b: &DVector<f64>) -> Option<DVector<f64>> {
    some_that_push(a, b).map(|(_, z)| z)
}

/// A largest set of contacts that push independently, in order, and the solution with their pushes. Some may push with no force.
pub(crate) fn pushing(a: &DMatrix<f64>, b: &DVector<f64>) -> Option<(Vec<usize>, DVector<f64>)> {
    let (mut set, mut z) = some_that_push(a, b)?;
    // A contact that stands still without a push may join a set: every set that cannot be enlarged is as large as the rank.
    let (w, zero) = (b + a * &z, rounding(a, b, &z));
    for contact in (0..b.len()).filter(|contact| w[*contact] <= zero) {
        let grown = with(&set, contact);
        if let (false, Some(same)) = (set.contains(&contact), by_set(a, b, &grown)) {
            (set, z) = (grown, same);
        }
    }
    Some((set, z))
}

/// Contacts that push, independent of each other, and the solution with their pushes.
fn some_that_push(a: &DMatrix<f64>, b: &DVector<f64>) -> Option<(Vec<usize>, DVector<f64>)> {
    // With friction that is tied to pushes, pushes may be found that close what opens without them.
    let none = DVector::zeros(b.len());
    if b.iter().all(|opens| *opens > rounding(a, b, &none)) {
        return Some((vec![], none));
    }
    // Most often all that touch push.
    let all: Vec<usize> = (0..b.len()).collect();
    if let Some(z) = by_set(a, b, &all) {
        return Some((all, z));
    }
    active_set(a, b).or_else(|| by_pivoting(a, b))
}

/// The solution in which just these contacts stand still.
fn by_set(a: &DMatrix<f64>, b: &DVector<f64>, set: &[usize]) -> Option<DVector<f64>> {
    allowed(a, b, set, standing(a, b, set)?)
}

/// These pushes, where none of the set pulls and nothing closes.
fn allowed(a: &DMatrix<f64>, b: &DVector<f64>, set: &[usize], still: DVector<f64>) -> Option<DVector<f64>> {
    let zero = rounding(a, b, &still);
    let w = b + a * &still;
    // A push is a velocity or acceleration over a response, if there is any.
    let slack = |i: usize| if a[(i, i)] > 0.0 { zero / a[(i, i)] } else { 0.0 };
    let pushes = set.iter().all(|i| still[*i] >= -slack(*i));
    let opens = w.iter().all(|w| *w >= -zero);
    (pushes && opens).then(|| still.map(|z| z.max(0.0)))
}

/// The same where friction that is tied to pushes lets no set grow by one contact after the other.
fn by_pivoting(a: &DMatrix<f64>, b: &DVector<f64>) -> Option<(Vec<usize>, DVector<f64>)> {
    let z = lemke::solve(a, b)?;
    let set: Vec<usize> = (0..b.len()).filter(|i| z[*i] > 0.0).collect();
    let z = allowed(a, b, &set, standing_together(a, b, &set)?)?;
    Some((set, z))
}

/// Pushes at these contacts with which they stand still, though one may not push away what it pushes: the others do.
pub(crate) fn standing_together(a: &DMatrix<f64>, b: &DVector<f64>, set: &[usize]) -> Option<DVector<f64>> {
    let part = DMatrix::from_fn(set.len(), set.len(), |i, j| a[(set[i], set[j])]);
    let right = DVector::from_fn(set.len(), |i, _| -b[set[i]]);
    let factors = part.full_piv_lu();
    let pivots = factors.u().diagonal().abs();
    let is_independent = pivots.min() > DEPENDENT * pivots.amax();
    is_independent.then(|| factors.solve(&right)).flatten().map(|pushes| spread(b.len(), set, &pushes))
}

/// Of some rows those that are independent of the ones before them, in order.
pub(crate) fn independent(a: &DMatrix<f64>, rows: impl IntoIterator<Item = usize>) -> Vec<usize> {
    let none = DVector::zeros(a.nrows());
    rows.into_iter().fold(vec![], |known, row| {
        let grown = [&known[..], &[row]].concat();
        if standing(a, &none, &grown).is_some() { grown } else { known }
    })
}

/// Of some rows those that cannot move while others do not.
pub(crate) fn following(
    a: &DMatrix<f64>,
    others: impl IntoIterator<Item = usize>,
    some: &[usize],
) -> Vec<usize> {
    if some.is_empty() {
        return vec![];
    }
    let kept = independent(a, others);
    let follows = |row: &usize| independent(a, kept.iter().copied().chain([*row])).len() == kept.len();
    some.iter().copied().filter(follows).collect()
}

/// Whether these rows do to each other the same both ways, but for rounding.
pub(crate) fn is_symmetric(a: &DMatrix<f64>, rows: &[usize]) -> bool {
    let differ = |i: usize, j: usize| (a[(i, j)] - a[(j, i)]).abs();
    let least = |i: usize, j: usize| DEPENDENT * libm::sqrt(a[(i, i)] * a[(j, j)]);
    rows.iter().all(|i| rows.iter().all(|j| differ(*i, *j) <= least(*i, *j)))
}

/// Whether no row is one of the others but for rounding: what is left of a pivot then is no part of the row itself, however small that is.
pub(crate) fn are_independent(a: &DMatrix<f64>, rows: &[usize]) -> bool {
    let part = DMatrix::from_fn(rows.len(), rows.len(), |i, j| a[(rows[i], rows[j])]);
    let Some(factors) = part.clone().cholesky() else { return false };
    let lower = factors.l_dirty();
    (0..rows.len()).all(|i| lower[(i, i)] * lower[(i, i)] > rounding_of_pivot(&part, lower, i))
}

/// `b + A z` without what rounding leaves of it, row by row: a light body between heavy ones is pushed by forces that balance, each of which would
/// do much to it.
pub(crate) fn moved(a: &DMatrix<f64>, b: &DVector<f64>, z: &DVector<f64>) -> DVector<f64> {
    let mut w = b + a * z;
    for (row, w) in w.iter_mut().enumerate() {
        if w.abs() <= left_by_rounding(a, b, z, row) {
            *w = 0.0;
        }
    }
    w
}

/// What rounding may leave of a row of `b + A z`.
pub(crate) fn left_by_rounding(a: &DMatrix<f64>, b: &DVector<f64>, z: &DVector<f64>, row: usize) -> f64 {
    let terms: f64 = a.row(row).iter().zip(z).map(|(a, z)| (a * z).abs()).sum();
    BALANCES * (b[row].abs() + terms)
}

/// What of the w is nothing.
fn rounding(a: &DMatrix<f64>, b: &DVector<f64>, z: &DVector<f64>) -> f64 {
    let pushed = if z.is_empty() { 0.0 } else { (a.abs() * z.abs()).amax() };
    ZERO * b.iter().fold(pushed, |most, b| most.max(b.abs()))
}

/// Contacts that push, independent of each other, and a solution with their pushes.
fn active_set(a: &DMatrix<f64>, b: &DVector<f64>) -> Option<(Vec<usize>, DVector<f64>)> {
    let n = b.len();
    let (mut set, mut z) = (vec![], DVector::zeros(n));
    for _ in 0..=ROUNDS * n {
        let (w, zero) = (b + a * &z, rounding(a, b, &z));
        let closing: Vec<usize> = (0..n).filter(|i| !set.contains(i) && w[*i] < -zero).collect();
        let fastest = closing.iter().fold(0.0, |fastest: f64, i| fastest.min(w[*i]));
        let Some(first) = closing.into_iter().find(|i| w[*i] <= (1.0 - AS_FAST) * fastest) else {
            return w.iter().all(|w| w.is_finite()).then_some((set, z));
        };
        (set, z) = entered(a, b, (set, z), first)?;
    }
    None
}

/// The set after one more contact was pushed until it stands still, and the pushes; `None` if no push does it.
fn entered(
    a: &DMatrix<f64>,
    b: &DVector<f64>,
    (mut set, mut z): (Vec<usize>, DVector<f64>),
    entering: usize,
) -> Option<(Vec<usize>, DVector<f64>)> {
    loop {
        let grown = with(&set, entering);
        let still = standing(a, b, &grown);
        let change = match &still {
            Some(still) => still - &z,
            None => exchange(a, &set, entering)?,
        };
        let until_none = |i: &usize| (*i, z[*i] / -change[*i]);
        let falling = set.iter().filter(|i| change[**i] < 0.0).map(until_none);
        match (falling.min_by(|i, j| i.1.total_cmp(&j.1)), still) {
            (Some((leaving, part)), still) if part < 1.0 || still.is_none() => {
                z += change * part;
                z[leaving] = 0.0;
                set.retain(|contact| *contact != leaving);
            }
            (_, still) => return Some((grown, still?)),
        }
    }
}

/// How the pushes of a set change by a unit of another that depends on them, so that nothing moves.
fn exchange(a: &DMatrix<f64>, set: &[usize], other: usize) -> Option<DVector<f64>> {
    let mut change = standing(a, &a.column(other).into_owned(), set)?;
    change[other] = 1.0;
    Some(change)
}

/// The set with a contact, in order.
fn with(set: &[usize], contact: usize) -> Vec<usize> {
    let place = set.partition_point(|known| *known < contact);
    [&set[..place], &[contact], &set[place..]].concat()
}

/// Pushes at these contacts, of either sign, with which they stand still; `None` if they are not independent.
pub(crate) fn standing(a: &DMatrix<f64>, b: &DVector<f64>, set: &[usize]) -> Option<DVector<f64>> {
    // Without the rounding of a square root: one contact is by far the most frequent.
    if let [only] = set {
        let mut all = DVector::zeros(b.len());
        all[*only] = -b[*only] / a[(*only, *only)];
        return (a[(*only, *only)] > 0.0).then_some(all);
    }
    let part = DMatrix::from_fn(set.len(), set.len(), |i, j| a[(set[i], set[j])]);
    let right = DVector::from_fn(set.len(), |i, _| -b[set[i]]);
    if (0..set.len()).any(|i| (0..i).any(|j| part[(i, j)] != part[(j, i)])) {
        return unsymmetric(part, right).map(|pushes| spread(b.len(), set, &pushes));
    }
    let factors = part.clone().cholesky()?;
    let lower = factors.l_dirty();
    let is_independent = |i: usize| {
        let pivot = lower[(i, i)] * lower[(i, i)];
        pivot > (DEPENDENT * part[(i, i)]).max(rounding_of_pivot(&part, lower, i))
    };
    if !(0..set.len()).all(is_independent) {
        return None;
    }
    Some(spread(b.len(), set, &factors.solve(&right)))
}

/// What rounding may leave of a pivot that is none. The pivot is `a_ii - a^T A^-1 a` of the row against those before it; with
/// `c = A^-1 a`, rounding of the entries is carried into it by `1`, `2 |c|` and `|c| |c|`, and c is large where those before nearly
/// depend on each other.
fn rounding_of_pivot(part: &DMatrix<f64>, lower: &DMatrix<f64>, i: usize) -> f64 {
    let mut c = vec![0.0; i];
    for j in (0..i).rev() {
        let known: f64 = (j + 1..i).map(|l| lower[(l, j)] * c[l]).sum();
        c[j] = (lower[(i, j)] - known) / lower[(j, j)];
    }
    let of_row = |j: usize| -> f64 { (0..i).map(|l| (part[(j, l)] * c[l]).abs()).sum() };
    let others: f64 = (0..i).map(|j| c[j].abs() * (2.0 * part[(i, j)].abs() + of_row(j))).sum();
    PIVOT_ROUNDING * (part[(i, i)] + others)
}

/// The same where friction is tied to pushes. Elimination without exchanges: the pivots are those of one contact after the other, and
/// each has to push away what it pushes.
fn unsymmetric(mut part: DMatrix<f64>, mut right: DVector<f64>) -> Option<DVector<f64>> {
    let n = right.len();
    for k in 0..n {
        let before: f64 = (0..k).map(|j| (part[(k, j)] * part[(j, k)]).abs()).sum();
        let pivot = part[(k, k)];
        if pivot.is_nan() || pivot <= DEPENDENT * (pivot.abs() + before) {
            return None;
        }
        for i in k + 1..n {
            let factor = part[(i, k)] / pivot;
            part[(i, k)] = factor;
            (k + 1..n).for_each(|j| part[(i, j)] -= factor * part[(k, j)]);
            right[i] -= factor * right[k];
        }
    }
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|j| part[(i, j)] * right[j]).sum();
        right[i] = (right[i] - known) / part[(i, i)];
    }
    Some(right)
}

/// Pushes of some of so many contacts.
fn spread(count: usize, set: &[usize], pushes: &DVector<f64>) -> DVector<f64> {
    let mut all = DVector::zeros(count);
    set.iter().zip(pushes).for_each(|(contact, push)| all[*contact] = *push);
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn three_supports_in_a_line_push_by_two() {
        // Ends and middle of a rod: the third row is the mean of the others.
        let rows = [[1.0, -0.5], [1.0, 0.5], [1.0, 0.0]];
        let a = DMatrix::from_fn(3, 3, |i, j| rows[i][0] * rows[j][0] + 12.0 * rows[i][1] * rows[j][1]);
        let b = DVector::from_element(3, -9.81);
        let (set, z) = pushing(&a, &b).expect("a solution");
        assert_eq!(set.len(), 2);
        assert!((b + a * z).amax() < 1e-12);
    }

    /// Of two that say the same the one that asks for more pushes, whichever comes first.
    #[test]
    fn dependent_contacts_are_exchanged() {
        let a = DMatrix::from_element(2, 2, 1.0);
        for [first, second] in [[-1.0, -2.0], [-2.0, -1.0]] {
            let b = DVector::from_row_slice(&[first, second]);
            let z = solve(&a, &b).expect("a solution");
            assert_eq!(z.sum(), 2.0);
            let (entered, _) =
                entered(&a, &b, (vec![0], DVector::from_row_slice(&[-first, 0.0])), 1).expect("pushes");
            assert_eq!(entered, vec![1]);
        }
    }

    #[test]
    fn between_two_that_close_nothing_helps() {
        let a = DMatrix::from_row_slice(2, 2, &[1.0, -1.0, -1.0, 1.0]);
        assert_eq!(solve(&a, &DVector::from_element(2, -1.0)), None);
        assert_eq!(solve(&a, &DVector::from_element(2, f64::NAN)), None);
    }

    /// Friction that is tied to pushes makes responses unlike in both directions: of a hundred such problems one or two are solved by pivoting alone.
    #[test]
    fn what_no_set_comes_to_is_found_by_pivoting() {
        let mut state = 0x1234_5678_9abc_def1_u64;
        let mut draw = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            2.0 * ((state >> 11) as f64 / (1u64 << 53) as f64) - 1.0
        };
        let mut alone = 0;
        for problem in 0..4000 {
            let n = 2 + problem % 4;
            let [normals, slips] = [(); 2].map(|()| DMatrix::from_fn(n, 3, |_, _| draw()));
            let a = &normals * (&normals - slips * 0.6).transpose();
            let b = DVector::from_fn(n, |_, _| draw());
            let solution = pushing(&a, &b);
            let needs_pivoting = active_set(&a, &b).is_none() && lemke::solve(&a, &b).is_some();
            alone += usize::from(needs_pivoting && solution.is_some());
            let Some((_, z)) = solution else { continue };
            let (w, zero) = (&b + &a * &z, rounding(&a, &b, &z));
            assert!(z.iter().all(|z| *z >= 0.0) && w.iter().all(|w| *w >= -zero), "{a}{b}{z}{w}");
            assert!(w.iter().zip(&z).all(|(w, z)| *z == 0.0 || w.abs() <= zero), "{a}{b}{z}{w}");
        }
        assert!(alone > 20, "{alone}");
    }

    /// Responses of bodies with `rank` freedoms, and a motion of them: others could ask contacts to part in ways that none can.
    fn of_bodies(rank: usize, rows: &[Vec<f64>], motion: &[f64]) -> (DMatrix<f64>, DVector<f64>) {
        let rows = DMatrix::from_fn(rows.len(), rank, |i, k| rows[i][k]);
        let b = &rows * DVector::from_row_slice(&motion[..rank]);
        (&rows * rows.transpose(), b)
    }

    /// Of every set of at most `rank` contacts, more than which depend on each other whatever rounding makes of it, those that solve
    /// the problem: the largest.
    fn by_enumeration(a: &DMatrix<f64>, b: &DVector<f64>, rank: usize) -> Option<(usize, DVector<f64>)> {
        let sets = (0..1_usize << b.len()).map(|bits| (0..b.len()).filter(|i| bits >> i & 1 == 1).collect());
        let sets = sets.filter(|set: &Vec<usize>| set.len() <= rank);
        let solutions = sets.filter_map(|set: Vec<usize>| Some((set.len(), by_set(a, b, &set)?)));
        solutions.max_by_key(|(size, _)| *size)
    }

    fn check(a: &DMatrix<f64>, b: &DVector<f64>, set: &[usize], z: &DVector<f64>) {
        let w = b + a * z;
        let size = 1.0 + (a.abs() * z).amax();
        assert!(z.iter().all(|z| *z >= 0.0));
        assert!((0..b.len()).all(|i| set.contains(&i) || z[i] == 0.0));
        assert!(w.iter().all(|w| *w >= -1e-9 * size), "{w}");
        assert!(set.iter().all(|i| w[*i].abs() <= 1e-9 * size), "{w}");
    }

    fn rows(count: std::ops::Range<usize>, rank: usize) -> impl Strategy<Value = Vec<Vec<f64>>> {
        proptest::collection::vec(proptest::collection::vec(-1.0f64..1.0, rank), count)
    }

    proptest! {
        /// Islands of up to thirty freedoms with up to forty contacts: every condition holds, and no more contacts could push.
        #[test]
        fn the_conditions_hold(
            rank in 1_usize..30,
            rows in rows(1..40, 30),
            motion in proptest::collection::vec(-5.0f64..5.0, 30),
        ) {
            let (a, b) = of_bodies(rank, &rows, &motion);
            let (set, z) = pushing(&a, &b).expect("motions of bodies can be stopped");
            check(&a, &b, &set, &z);
            prop_assert!(set.len() <= rank.min(rows.len()));
            prop_assert_eq!(pushing(&a, &b), Some((set, z)));
        }

        /// The same contact thrice, and the sum of two: what depends on others.
        #[test]
        fn repeated_contacts_do_no_harm(
            rows in rows(4..12, 6),
            motion in proptest::collection::vec(-5.0f64..5.0, 6),
        ) {
            let sum = rows[0].iter().zip(&rows[1]).map(|(a, b)| a + b).collect();
            let all = [rows.clone(), vec![sum], rows.clone(), rows[..2].to_vec()].concat();
            let (a, b) = of_bodies(6, &all, &motion);
            let (set, z) = pushing(&a, &b).expect("motions of bodies can be stopped");
            check(&a, &b, &set, &z);
        }

        /// Also where contacts are asked to part in ways that no body can.
        #[test]
        fn as_every_set_tried(
            rows in rows(1..7, 3),
            motion in proptest::collection::vec(-5.0f64..5.0, 3),
            asked in proptest::collection::vec(-5.0f64..5.0, 7),
        ) {
            let (a, b) = of_bodies(3, &rows, &motion);
            let asked = DVector::from_row_slice(&asked[..rows.len()]);
            for b in [b, asked] {
                let found = pushing(&a, &b);
                let Some((size, z)) = by_enumeration(&a, &b, 3) else { continue };
                let (set, found) = found.expect("there is one");
                prop_assert_eq!(set.len(), size);
                prop_assert!((&a * (&z - found)).amax() < 1e-8 * (1.0 + (a.abs() * z).amax()));
            }
        }
    }
}
