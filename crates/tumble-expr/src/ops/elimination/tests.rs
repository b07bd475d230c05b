use super::*;
use crate::{Lanes, SparseSystem};

/// Rows of entries with their columns.
type Rows = Vec<Vec<(u32, f64)>>;

fn plan(rows: &Rows) -> Plan {
    let columns = |row: &Vec<(u32, f64)>| row.iter().map(|(column, _)| *column).collect();
    Plan::new(&rows.iter().map(columns).collect::<Vec<_>>())
}

fn factored(rows: &Rows) -> (Plan, Vec<f64>, f64) {
    let plan = plan(rows);
    let entries: Vec<f64> = rows.iter().flatten().map(|(_, entry)| *entry).collect();
    let mut factors = vec![0.0; plan.room];
    let least = plan.factor(|entry| entries[entry], &mut Workspace::default(), &mut factors);
    (plan, factors, least)
}

fn dense(n: usize, entry: impl Fn(usize, usize) -> f64) -> Rows {
    (0..n).map(|i| (0..n).map(|j| (j as u32, entry(i, j))).collect()).collect()
}

/// Blocks of two that hold on to those before and after them, as pins of a chain do; `order` says which link is which.
fn chain(links: usize, order: impl Fn(usize) -> usize) -> Rows {
    let entry = |i: usize, j: usize| {
        let mixed = libm::sin((3 * i + 5 * j + 1) as f64);
        if i == j { 4.0 + mixed } else { mixed }
    };
    let mut rows = vec![vec![]; 2 * links];
    for i in 0..2 * links {
        let near = |j: &usize| (i / 2).abs_diff(j / 2) < 2;
        let place = |i: usize| 2 * order(i / 2) + i % 2;
        let mut row: Vec<(u32, f64)> =
            (0..2 * links).filter(near).map(|j| (place(j) as u32, entry(i, j))).collect();
        row.sort_unstable_by_key(|(column, _)| *column);
        rows[place(i)] = row;
    }
    rows
}

/// Largest residual of a solution, in ulps of the sizes that it is made of.
fn residual(rows: &Rows) -> f64 {
    let (plan, factors, _) = factored(rows);
    let right: Vec<f64> = (0..rows.len()).map(|row| libm::cos((row * row) as f64)).collect();
    let mut x = vec![0.0; rows.len()];
    plan.substitute(&factors, &mut right.clone(), &mut x);
    let row = |(row, right): (&Vec<(u32, f64)>, &f64)| {
        let terms = row.iter().map(|(column, entry)| entry * x[*column as usize]);
        let (sum, size) =
            terms.fold((-right, right.abs()), |(sum, size), term| (sum + term, size + term.abs()));
        sum.abs() / (size * f64::EPSILON)
    };
    rows.iter().zip(&right).map(row).fold(0.0, f64::max)
}

#[test]
fn solutions_satisfy_their_equations() {
    for n in 1..8 {
        let hilbert = dense(n, |i, j| 1.0 / (1 + i + j) as f64);
        let mixed = dense(n, |i, j| libm::sin(((n * i + j) * (n * i + j) + 1) as f64));
        assert!(residual(&hilbert) <= 4.0 * n as f64, "{}", residual(&hilbert));
        assert!(residual(&mixed) <= 4.0 * n as f64, "{}", residual(&mixed));
    }
    for links in [1, 2, 3, 10, 40] {
        let shuffled = chain(links, |link| (7 * link) % links);
        assert!(residual(&shuffled) <= 16.0, "{links} {}", residual(&shuffled));
    }
}

/// A link more takes as many numbers more, however many there are and in whichever order.
#[test]
fn factors_of_chains_grow_with_their_links() {
    for order in [|link, _| link, |link: usize, links: usize| (7 * link) % links] {
        let room = |links: usize| plan(&chain(links, |link| order(link, links))).room;
        assert!(room(401) <= 402 * (room(51) / 50), "{} {}", room(51), room(401));
    }
    // What waits between steps is that of one place.
    assert_eq!(plan(&chain(400, |link| link)).waiting, plan(&chain(50, |link| link)).waiting);
}

#[test]
fn the_units_of_a_row_do_not_choose_the_pivot() {
    let chosen = |scale: f64| {
        let (_, factors, _) = factored(&vec![vec![(0, scale), (1, 1e9 * scale)], vec![(0, 1.0), (1, 1.0)]]);
        factors[0]
    };
    assert_eq!([chosen(1.0), chosen(1e6)], [1.0; 2]);
}

#[test]
fn rounding_is_told_from_a_small_pivot() {
    let least = |entries: [f64; 4]| factored(&dense(2, |i, j| entries[2 * i + j])).2;
    assert_eq!(least([0.1, 0.3, 0.3, 0.9]), 0.0);
    assert!(least([0.1, 0.3, 0.3, 0.9 * (1.0 + 1e-14)]) > 0.0);
    assert_eq!(least([1.0, 0.0, 0.0, 1e-300]), 1.0);
    assert_eq!(least([1.0, f64::NAN, 1.0, 2.0]), 0.0);
}

#[test]
fn what_has_no_pivot_whatever_its_numbers_has_no_solution() {
    let mut system = SparseSystem::new(vec![vec![0, 1, 2], vec![0], vec![0]]);
    assert_eq!(system.factor(&[1.0; 5]), 0.0);
    let mut x = [0.0; 3];
    system.solve(&[1.0; 3], &mut x);
    assert!(x.iter().all(|x| x.is_nan()));
}

/// Two matrices that choose other pivots, side by side and alone.
#[test]
fn a_pivot_of_one_lane_is_no_other_s() {
    let both = [[1.0, 5.0, 3.0, 2.0], [4.0, 1.0, 1.0, 3.0]];
    let alone = both.map(|entries| factored(&dense(2, |i, j| entries[2 * i + j])));
    assert_ne!(alone[0].1[0], alone[1].1[0]);
    let plan = &alone[0].0;
    let factors: Vec<Lanes<2>> =
        (0..plan.room).map(|index| Lanes([alone[0].1[index], alone[1].1[index]])).collect();
    let mut x = [Lanes([0.0; 2]); 2];
    plan.substitute(&factors, &mut [Lanes([1.0, 1.0]), Lanes([2.0, 2.0])], &mut x);
    for (lane, (_, factors, _)) in alone.iter().enumerate() {
        let mut single = [0.0; 2];
        plan.substitute(factors, &mut [1.0, 2.0], &mut single);
        assert_eq!([x[0].0[lane], x[1].0[lane]], single);
    }
}
