//! In which order unknowns are eliminated, and where numbers stand meanwhile: known from where the matrix has entries.
//!
//! A step takes all rows that still hold its unknown. One of them, whichever has the best pivot then, becomes a row of the upper
//! triangle; the others go on without the unknown, with entries in all columns that any of the rows had. So the pattern is that
//! of every possible choice of pivots, and rows may be exchanged in each lane by its own numbers. Which unknown is next is
//! decided by the size of its step, the first of equals: of a chain from one of its ends on, so that the steps of a chain
//! of n bodies are n times as many as those of one and no larger.
//!
//! Source: George and Ng, Symbolic factorization for sparse Gaussian elimination with partial pivoting, SIAM J. Sci. Stat.
//! Comput. 8 (1987); Markowitz, Management Science 3 (1957), for the order.

use std::collections::BTreeSet;
use std::ops::Range;

/// All steps, in order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Plan {
    pub(crate) n: usize,
    pub(crate) steps: Vec<Step>,
    /// How many numbers the factors are.
    pub(crate) room: usize,
    /// How many numbers wait between steps, at most.
    pub(crate) waiting: usize,
    /// Whether some unknown has no row left whatever the numbers are.
    pub(crate) is_singular: bool,
}

/// The elimination of one unknown. Its rows and columns are lines and columns of a small dense matrix, the unknown first.
#[derive(Clone, Debug)]
pub(crate) struct Step {
    /// The unknown.
    pub(crate) column: usize,
    /// By line, where its right side stands; that of the pivot comes to stand in the first.
    pub(crate) places: Vec<u32>,
    /// Unknowns of the other columns.
    pub(crate) right: Vec<u32>,
    pub(crate) own: Vec<Own>,
    pub(crate) inherited: Vec<Inherited>,
    /// Where the other lines wait without the unknown.
    pub(crate) waits_at: usize,
    /// Where its factors begin: which line had the pivot, the pivot, the rest of its row, then the factors of the other lines.
    pub(crate) factors: usize,
}

/// A row of the matrix that comes in.
#[derive(Clone, Debug)]
pub(crate) struct Own {
    pub(crate) line: usize,
    pub(crate) entries: Range<usize>,
    /// By entry.
    pub(crate) columns: Vec<u32>,
}

/// Lines that an earlier step has left.
#[derive(Clone, Debug)]
pub(crate) struct Inherited {
    pub(crate) from: usize,
    /// By line and by column of that step.
    pub(crate) lines: Vec<u32>,
    pub(crate) columns: Vec<u32>,
}

impl Plan {
    /// Of a matrix of which each row has entries in these columns; entries are counted row by row.
    pub(crate) fn new(rows: &[Vec<u32>]) -> Self {
        let (n, mut first) = (rows.len(), 0);
        let ranged = |columns: &Vec<u32>| {
            first += columns.len();
            (first - columns.len()..first, columns.clone())
        };
        let rows: &[(Range<usize>, Vec<u32>)] = &rows.iter().map(ranged).collect::<Vec<_>>();
        let merges = Merging::new(rows).run();
        if merges.len() < n {
            return Self { n, is_singular: true, room: 0, ..Self::default() };
        }
        let mut placing = Placing::new(rows, &merges);
        let steps = (0..n).map(|step| placing.step(&merges, step)).collect();
        let Placing { room, waiting, .. } = placing;
        Self { n, steps, room, waiting: waiting.length, is_singular: false }
    }
}

impl Step {
    /// How many columns its small matrix has.
    pub(crate) fn width(&self) -> usize {
        self.right.len() + 1
    }
}

/// Rows with one pattern: of the matrix, or left by a step.
#[derive(Clone, Debug)]
struct Group {
    places: Vec<u32>,
    columns: Vec<u32>,
}

/// A step before it is known when the others are.
struct Merge {
    column: u32,
    /// Groups by their number: rows of the matrix, then what steps leave in their order.
    groups: Vec<usize>,
    /// All rows, and all columns but its own.
    whole: Group,
}

/// Looks for the next step.
struct Merging {
    groups: Vec<Group>,
    /// By column, the groups that hold it.
    holders: Vec<Vec<usize>>,
    /// Columns that are left, by the size of their step.
    costs: Vec<usize>,
    next: BTreeSet<(usize, u32)>,
    is_marked: Vec<bool>,
    /// The columns that are, while they are counted.
    marked: Vec<u32>,
}

impl Merging {
    fn new(rows: &[(Range<usize>, Vec<u32>)]) -> Self {
        let n = rows.len();
        let group = |(place, (_, columns)): (usize, &(_, Vec<u32>))| Group {
            places: vec![place as u32],
            columns: columns.clone(),
        };
        let groups: Vec<Group> = rows.iter().enumerate().map(group).collect();
        let mut holders = vec![vec![]; n];
        for (index, group) in groups.iter().enumerate() {
            group.columns.iter().for_each(|column| holders[*column as usize].push(index));
        }
        let (costs, next) = (vec![0; n], BTreeSet::new());
        let (is_marked, marked) = (vec![false; n], vec![]);
        let mut merging = Self { groups, holders, costs, next, is_marked, marked };
        (0..n as u32).for_each(|column| merging.weigh(column));
        merging
    }

    fn run(mut self) -> Vec<Merge> {
        let mut merges = vec![];
        while let Some((_, column)) = self.next.pop_first() {
            let groups = std::mem::take(&mut self.holders[column as usize]);
            if groups.is_empty() {
                return merges;
            }
            let whole = self.union(&groups, column);
            for &other in &whole.columns {
                self.holders[other as usize].retain(|group| !groups.contains(group));
            }
            let left = Group { places: whole.places[1..].to_vec(), columns: whole.columns.clone() };
            if !left.places.is_empty() {
                for &other in &left.columns {
                    self.holders[other as usize].push(self.groups.len());
                }
            }
            self.groups.push(left);
            for &other in &whole.columns {
                self.next.remove(&(self.costs[other as usize], other));
                self.weigh(other);
            }
            merges.push(Merge { column, groups, whole });
        }
        merges
    }

    /// All rows of some groups and all their columns, but for one.
    fn union(&mut self, groups: &[usize], without: u32) -> Group {
        let mut places: Vec<u32> =
            groups.iter().flat_map(|group| &self.groups[*group].places).copied().collect();
        for group in groups {
            mark(&self.groups[*group].columns, &mut self.is_marked, &mut self.marked);
        }
        let mut columns = self.marked.clone();
        self.unmark();
        columns.retain(|column| *column != without);
        places.sort_unstable();
        columns.sort_unstable();
        Group { places, columns }
    }

    /// Finds the size of a column's step: how many rows its groups have together, and how many columns. Groups share no rows.
    fn weigh(&mut self, column: u32) {
        let mut places = 0;
        for group in self.holders[column as usize].iter().map(|group| &self.groups[*group]) {
            places += group.places.len();
            mark(&group.columns, &mut self.is_marked, &mut self.marked);
        }
        let cost = places * self.marked.len();
        self.unmark();
        self.costs[column as usize] = cost;
        self.next.insert((cost, column));
    }

    fn unmark(&mut self) {
        self.marked.iter().for_each(|column| self.is_marked[*column as usize] = false);
        self.marked.clear();
    }
}

/// Marks columns, and lists those that were not marked.
fn mark(columns: &[u32], is_marked: &mut [bool], marked: &mut Vec<u32>) {
    for &column in columns {
        if !std::mem::replace(&mut is_marked[column as usize], true) {
            marked.push(column);
        }
    }
}

/// Gives numbers their places, step by step.
struct Placing<'a> {
    rows: &'a [(Range<usize>, Vec<u32>)],
    /// By column, its step.
    order: Vec<u32>,
    room: usize,
    waiting: Waiting,
    /// By step, where its lines wait, their places and their columns.
    left: Vec<(usize, Group)>,
    /// Column of the small matrix by column, of the step that is placed.
    position: Vec<u32>,
}

impl<'a> Placing<'a> {
    fn new(rows: &'a [(Range<usize>, Vec<u32>)], merges: &[Merge]) -> Self {
        let mut order = vec![0; rows.len()];
        merges.iter().enumerate().for_each(|(step, merge)| order[merge.column as usize] = step as u32);
        let (waiting, position) = (Waiting::default(), vec![0; rows.len()]);
        Self { rows, order, room: 0, waiting, left: vec![], position }
    }

    fn step(&mut self, merges: &[Merge], step: usize) -> Step {
        let Merge { column, groups, whole } = &merges[step];
        let mut right = whole.columns.clone();
        right.sort_unstable_by_key(|column| self.order[*column as usize]);
        self.position[*column as usize] = 0;
        right.iter().zip(1..).for_each(|(column, place)| self.position[*column as usize] = place);
        let of = |columns: &[u32]| columns.iter().map(|column| self.position[*column as usize]).collect();
        let line = |place: &u32| whole.places.binary_search(place).unwrap_or_default();
        let (mut own, mut inherited, mut done) = (vec![], vec![], vec![]);
        for &group in groups {
            match group.checked_sub(self.rows.len()) {
                None => {
                    let (entries, columns) = &self.rows[group];
                    let (line, columns) = (line(&(group as u32)), of(columns));
                    own.push(Own { line, entries: entries.clone(), columns });
                }
                Some(step) => {
                    let (from, Group { places, columns }) = &self.left[step];
                    let lines = places.iter().map(|place| line(place) as u32).collect();
                    inherited.push(Inherited { from: *from, lines, columns: of(columns) });
                    done.push(*from..*from + places.len() * columns.len());
                }
            }
        }
        done.into_iter().for_each(|range| self.waiting.free.push(range));
        let places = whole.places.clone();
        let waits_at = self.waiting.take((places.len() - 1) * right.len());
        self.left.push((waits_at, Group { places: places[1..].to_vec(), columns: right.clone() }));
        let factors = self.room;
        self.room += 1 + (1 + right.len()) + (places.len() - 1);
        Step { column: *column as usize, places, right, own, inherited, waits_at, factors }
    }
}

/// Room for lines between steps, used again when they have come in.
#[derive(Default)]
struct Waiting {
    length: usize,
    free: Vec<Range<usize>>,
}

impl Waiting {
    fn take(&mut self, length: usize) -> usize {
        let fits = |free: &Range<usize>| free.len() >= length;
        if let Some(index) = self.free.iter().position(fits) {
            let first = self.free[index].start;
            self.free[index].start += length;
            if self.free[index].is_empty() {
                self.free.swap_remove(index);
            }
            return first;
        }
        self.length += length;
        self.length - length
    }
}
