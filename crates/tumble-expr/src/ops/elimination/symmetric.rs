//! In which order the unknowns of a symmetric matrix are eliminated when the diagonal bears it, and where entries come to stand.

use std::ops::Range;

use crate::shape::SparsityPattern;

/// All columns of the lower triangle, in order.
#[derive(Clone, Debug)]
pub(crate) struct Symmetric {
    pub(crate) columns: Vec<Column>,
    /// How many entries the triangle has when it is filled in.
    pub(crate) room: usize,
    /// By entry of the matrix, where it comes to stand; each pair of equal ones once.
    pub(crate) places: Vec<Option<u32>>,
}

/// One column of the triangle: its diagonal entry comes first, then those below.
#[derive(Clone, Debug)]
pub(crate) struct Column {
    pub(crate) unknown: usize,
    pub(crate) first: usize,
    /// Unknowns of the rows below.
    pub(crate) below: Vec<u32>,
    /// What its outer product is taken from: by row, the places from the diagonal entry of that row's own column on.
    pub(crate) targets: Vec<u32>,
}

impl Column {
    pub(crate) fn entries(&self) -> Range<usize> {
        self.first + 1..self.first + 1 + self.below.len()
    }
}

impl Symmetric {
    /// Of a matrix in which entries across the diagonal are equal, by these unknowns one after the other.
    pub(crate) fn new(shape: &SparsityPattern, order: impl Iterator<Item = usize>) -> Self {
        let order: Vec<usize> = order.collect();
        let mut turn = vec![0; order.len()];
        order.iter().enumerate().for_each(|(index, unknown)| turn[*unknown] = index);
        let patterns = patterns(shape, &order, &turn);
        let firsts: Vec<usize> = patterns
            .iter()
            .scan(0, |next, below| Some(std::mem::replace(next, *next + 1 + below.len())))
            .collect();
        // Where the entry of two turns stands, the earlier first.
        let place = |early: usize, late: usize| -> Option<u32> {
            let within = if early == late { 0 } else { 1 + patterns[early].binary_search(&late).ok()? };
            Some((firsts[early] + within) as u32)
        };
        let column = |(index, below): (usize, &Vec<usize>)| {
            let pairs =
                below.iter().enumerate().flat_map(|(k, early)| below[k..].iter().map(|late| (*early, *late)));
            Column {
                unknown: order[index],
                first: firsts[index],
                below: below.iter().map(|turn| order[*turn] as u32).collect(),
                targets: pairs.filter_map(|(early, late)| place(early, late)).collect(),
            }
        };
        let columns = patterns.iter().enumerate().map(column).collect();
        let own = |row: usize| shape.entries_of(row).map(move |(_, column)| (row, column));
        let placed = |(row, column): (usize, usize)| (row >= column).then(|| [turn[row], turn[column]]);
        let places = (0..shape.size())
            .flat_map(own)
            .map(|pair| placed(pair).and_then(|[a, b]| place(a.min(b), a.max(b))));
        let room = order.len() + patterns.iter().map(Vec::len).sum::<usize>();
        Self { columns, room, places: places.collect() }
    }
}

/// By turn, the later turns that its column has entries in: those of the matrix, and those of the columns whose next one it is.
fn patterns(shape: &SparsityPattern, order: &[usize], turn: &[usize]) -> Vec<Vec<usize>> {
    let mut patterns: Vec<Vec<usize>> = order
        .iter()
        .map(|unknown| shape.entries_of(*unknown).map(|(_, column)| turn[column]).collect())
        .collect();
    for index in 0..order.len() {
        let own = &mut patterns[index];
        own.retain(|later| *later > index);
        own.sort_unstable();
        own.dedup();
        if let [next, others @ ..] = &own[..] {
            let (next, others) = (*next, others.to_vec());
            patterns[next].extend(others);
        }
    }
    patterns
}
