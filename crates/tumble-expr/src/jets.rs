//! Evaluators: a tape on values, and on Taylor coefficients.

use std::sync::Arc;

use crate::arena::Arena;
use crate::ops::kernels::Kernels;
use crate::ops::solve::Bench;
use crate::ops::{Op, Series, Slot};
use crate::resolved::{Kernel, Resolved};
use crate::{Lookup, Rounded, Stage, Tape};

/// How branches (abs, sign, step, min, max, if) take their sides at order 0.
#[derive(Clone, Copy, Debug)]
pub enum Branches<'a, S> {
    /// By the sign of their guard, zero counting as positive.
    Free,
    /// As given, +1 or -1 a branch and then a segment a table, whatever the guards say: the sides that a step is on.
    Frozen(&'a [S]),
}

/// Runs a tape on Taylor coefficients up to a highest order; with highest order 0, on values.
///
/// First [`Jets::start`], then for `k = 1, 2, ...` the leaves' coefficients of order k by [`Jets::set`] and
/// [`Jets::extend`]. That order lets the coefficients of a state be found from those of its derivative.
#[derive(Clone, Debug)]
pub struct Jets<S> {
    tape: Arc<Tape>,
    /// Series of the slots, and what kernels keep besides.
    arena: Arena<S>,
    /// What each term of a sum is multiplied with, its sign included.
    multipliers: Vec<S>,
    signs: Vec<S>,
    /// By norm.
    vanishing: Vec<bool>,
    /// Factors of the matrices of linear systems.
    factors: Vec<S>,
    bench: Bench<S>,
    /// Of an interval of places, how far they are from where what vanishes is zero.
    elapsed: S,
    time_is_parameter: bool,
}

/// Runs a tape on values.
pub type Values<S> = Jets<S>;

impl Jets<Rounded> {
    /// Takes numbers to be off by so many eps of them, where they are not exact.
    pub fn set_errors_of_numbers(&mut self, part: f64) {
        let tape = Arc::clone(&self.tape);
        for (slot, op) in tape.prologue() {
            let value = match op {
                Op::Number(_) | Op::Pi => {
                    let Rounded { value, error } = self.arena.at(slot, 0);
                    Rounded { value, error: part * error }
                }
                _ => self.value(op, true),
            };
            self.arena.put(slot, 0, value);
        }
    }

    /// Takes inputs, numbers and what is computed from them alone as exact: their errors are the same at all instants.
    pub fn settle(&mut self) {
        let tape = Arc::clone(&self.tape);
        let first = tape.states() + 1;
        let inputs = (first..first + tape.inputs()).chain(tape.prologue().map(|(slot, _)| slot as usize));
        for slot in inputs {
            let value = self.arena.at(slot as Slot, 0);
            self.arena.put(slot as Slot, 0, Rounded { error: 0.0, ..value });
        }
    }
}

impl<S: Kernels> Jets<S> {
    /// An evaluator of `tape` up to `order`, for one set of inputs.
    ///
    /// # Panics
    /// If there are not as many inputs as the tape's layout has.
    pub fn new(tape: Arc<Tape>, order: usize, inputs: &[S]) -> Self {
        let arena = Arena::new(tape.resolved().rows, order);
        let signs = vec![S::one(); tape.sides()];
        let vanishing = vec![false; tape.norms.len()];
        let factors = vec![S::zero(); tape.matrices.iter().map(|matrix| matrix.plan.room).sum()];
        let elapsed = S::zero();
        let mut jets = Self {
            tape,
            arena,
            multipliers: vec![],
            signs,
            vanishing,
            factors,
            bench: Bench::default(),
            elapsed,
            time_is_parameter: false,
        };
        jets.bind(inputs);
        jets
    }

    /// Gives the inputs new values.
    ///
    /// # Panics
    /// If there are not as many inputs as the tape's layout has.
    pub fn bind(&mut self, inputs: &[S]) {
        assert_eq!(inputs.len(), self.tape.inputs(), "one value an input");
        let tape = Arc::clone(&self.tape);
        let first = tape.states() + 1;
        for (index, value) in inputs.iter().enumerate() {
            self.arena.put((first + index) as Slot, 0, *value);
        }
        for (slot, op) in tape.prologue() {
            let value = match op {
                Op::Number(index) => {
                    let number = &tape.numbers[index as usize];
                    S::constant(number.value, number.is_exact)
                }
                Op::Pi => S::constant(tape.pi, false),
                _ => self.value(op, true),
            };
            self.arena.put(slot, 0, value);
        }
        self.multipliers.clear();
        self.multipliers.extend(tape.resolved().terms.iter().map(|term| self.arena.multiplier(term)));
    }

    /// Evaluates everything at one instant.
    ///
    /// # Panics
    /// If there are not as many states, or frozen branches, as the tape has.
    pub fn start(&mut self, time: S, states: &[S], branches: Branches<'_, S>) {
        assert_eq!(states.len(), self.tape.states(), "one value a state");
        for (index, value) in states.iter().chain([&time]).enumerate() {
            self.arena.put(index as Slot, 0, *value);
        }
        let free = matches!(branches, Branches::Free);
        if let Branches::Frozen(signs) = branches {
            self.freeze(signs);
        }
        // The tape is not held: threads share it, and the count of its holders.
        for index in 0..self.tape.resolved().kernels.len() {
            let (slot, kernel) = self.tape.resolved().kernels[index].clone();
            let value = match kernel {
                Kernel::Abs { of, branch } => self.value(Op::Abs { of, branch }, free),
                Kernel::Directed { of, branch } => {
                    self.value(Op::Abs { of, branch }, free) * self.arena.at(of, 0)
                }
                Kernel::Other(op) | Kernel::Along { op, .. } => self.value(op, free),
                kernel => self.first(&kernel),
            };
            self.arena.put(slot, 0, value);
        }
    }

    /// Says whether the time is the parameter of the series but for a constant: what depends on it alone is found faster.
    pub fn set_time_is_parameter(&mut self, is_so: bool) {
        self.time_is_parameter = is_so;
    }

    /// Sets a leaf's coefficient: a state's by its index, the time's by the number of states.
    #[inline]
    pub fn set(&mut self, leaf: usize, order: usize, value: S) {
        self.arena.put(leaf as Slot, order, value);
    }

    /// Finds every coefficient of order `k >= 1` from the leaves' and from all lower orders.
    pub fn extend(&mut self, k: usize) {
        let Self { tape, arena, multipliers, signs, vanishing, factors, bench, elapsed, time_is_parameter } =
            self;
        let Resolved { kernels, terms, linear, .. } = tape.resolved();
        // Beyond order 1 what is linear in the parameter stays zero.
        let first = if *time_is_parameter && k > 1 { *linear } else { 0 };
        for (slot, kernel) in &kernels[first..] {
            let value = match kernel {
                Kernel::Sum(sum) => {
                    let range = sum.change.start as usize..sum.change.end as usize;
                    let value = arena.sum(&terms[range.clone()], &multipliers[range], k);
                    arena.scaled(value, sum.then)
                }
                Kernel::Product(a, b) => arena.product(*a, *b, k),
                Kernel::Square(a) => arena.square(*a, k),
                Kernel::Directed { of, branch } => arena.directed_square(*of, signs[*branch as usize], k),
                Kernel::Slope(a) => S::splat(k as f64) * arena.at(*a, k),
                Kernel::Abs { of, branch } => signs[*branch as usize] * arena.at(*of, k),
                Kernel::Wave { of, slope, cos, is_linear } => {
                    let one_term = *is_linear && *time_is_parameter;
                    let [sin_k, cos_k] = arena.wave((*of, *slope), (*slot, *cos), k, one_term);
                    arena.put(*cos, k, cos_k);
                    sin_k
                }
                Kernel::Along { of, slope, factor, .. } => arena.along((*of, *slope), *factor, k),
                Kernel::Quotient(a, b) => arena.quotient(*a, *b, *slot, k),
                Kernel::Root(a) => arena.root(*a, *slot, k),
                Kernel::Norm { parts, square } => {
                    let of_square = arena.squares(&tape.norms[*parts as usize], k);
                    arena.put(*square, k, of_square);
                    let series = Series { arena, signs, tape, factors, vanishing, elapsed: *elapsed };
                    S::norm_coefficient(&series, *parts, (*slot, of_square), k)
                }
                Kernel::System(system) => {
                    let series = Series { arena, signs, tape, factors, vanishing, elapsed: *elapsed };
                    series.solve(*system, k, bench);
                    let unknowns = tape.systems[*system as usize].unknowns;
                    (unknowns..).zip(&bench.x).for_each(|(slot, x)| arena.put(slot, k, *x));
                    S::zero()
                }
                Kernel::Other(op) => {
                    let series = Series { arena, signs, tape, factors, vanishing, elapsed: *elapsed };
                    series.coefficient(*op, *slot, k)
                }
            };
            arena.put(*slot, k, value);
        }
    }

    /// Forgets all that was found: every result may be anything.
    pub fn forget(&mut self, anything: S) {
        let tape = Arc::clone(&self.tape);
        for (slot, _) in tape.varying() {
            self.arena.fill(slot, anything);
        }
    }

    /// For intervals: says how far from where they vanish the norms of [`Jets::set_vanishing`] are looked at. Results for them
    /// are then made from those of the evaluation before, so that evaluation is to be done twice after [`Jets::forget`].
    pub fn set_elapsed(&mut self, elapsed: S) {
        self.elapsed = elapsed;
    }

    /// Says which norms (in the order of [`Tape::turnings`]) are zero at the next start, whatever rounding has left.
    ///
    /// # Panics
    /// If there is not one entry a norm.
    pub fn set_vanishing(&mut self, norms: &[bool]) {
        self.vanishing.copy_from_slice(norms);
    }

    pub(crate) fn arena(&self) -> &Arena<S> {
        &self.arena
    }

    /// Coefficients in a slot.
    pub fn slot(&self, slot: Slot) -> &[S] {
        self.arena.row(slot)
    }

    /// One coefficient in a slot.
    #[inline]
    pub fn coefficient(&self, slot: Slot, order: usize) -> S {
        self.arena.at(slot, order)
    }

    /// Coefficients of an output.
    pub fn output(&self, index: usize) -> &[S] {
        self.slot(self.tape.outputs()[index])
    }

    /// Value of an output at the instant of the last start.
    pub fn value_of(&self, index: usize) -> S {
        self.output(index)[0]
    }

    /// The sides that the branches took, +1 or -1, then the segments of the tables.
    pub fn signs(&self) -> &[S] {
        &self.signs
    }

    /// Coefficients of the square of a length, by its index in the tape's list.
    pub fn square_of_norm(&self, norm: usize) -> &[S] {
        self.slot(self.tape.resolved().squares[norm])
    }

    /// The tape that runs.
    pub fn tape(&self) -> &Arc<Tape> {
        &self.tape
    }

    /// Sides of branches that depend on inputs alone stay as the inputs say.
    fn freeze(&mut self, signs: &[S]) {
        assert_eq!(signs.len(), self.signs.len(), "one side a branch or table");
        let arguments = self.tape.tables().iter().map(|lookup| &lookup.of);
        for (side, of) in self.tape.guards().iter().chain(arguments).enumerate() {
            if self.tape.stage(*of) == Stage::Varying {
                self.signs[side] = signs[side];
            }
        }
    }

    /// Value of a kernel that has no branch.
    fn first(&mut self, kernel: &Kernel) -> S {
        let at = |slot: Slot| self.arena.at(slot, 0);
        match *kernel {
            Kernel::Sum(ref sum) => {
                let terms = &self.tape.resolved().terms[sum.value.start as usize..sum.value.end as usize];
                self.arena.scaled(self.arena.first_sum(terms), sum.then)
            }
            Kernel::Product(a, b) => at(a) * at(b),
            Kernel::Square(a) => at(a).square(),
            // A row of slopes has no order 0.
            Kernel::Slope(_) => S::zero(),
            Kernel::Wave { of, cos, .. } => {
                let (sin_of, cos_of) = at(of).sine_and_cosine();
                self.arena.put(cos, 0, cos_of);
                sin_of
            }
            Kernel::Quotient(a, b) => at(a) / at(b),
            Kernel::Root(a) => at(a).sqrt(),
            Kernel::Norm { parts, square } => {
                let parts_of = &self.tape.norms[parts as usize];
                let of_square = parts_of.iter().fold(S::zero(), |sum, part| sum + at(*part).square());
                self.arena.put(square, 0, of_square);
                S::norm(&self.series(), parts)
            }
            Kernel::System(system) => {
                self.solve(system);
                S::zero()
            }
            Kernel::Along { .. } | Kernel::Abs { .. } | Kernel::Directed { .. } | Kernel::Other(_) => {
                unreachable!("these are found by their operation")
            }
        }
    }

    fn value(&mut self, op: Op, free: bool) -> S {
        if free && let Some(branch) = op.branch() {
            let guard = self.tape.guards()[branch as usize];
            self.signs[branch as usize] = self.slot(guard)[0].choose(S::one(), -S::one());
        }
        if free && let Some(lookup) = op.lookup() {
            let Lookup { table, of } = &self.tape.tables()[lookup as usize];
            let segment = self.slot(*of)[0].segment(&table.0);
            let side = self.tape.guards().len() + lookup as usize;
            self.signs[side] = segment;
        }
        match op {
            Op::Factor(matrix) => self.factor(matrix),
            Op::System(system) => self.solve(system),
            _ => {}
        }
        match op {
            // A free sign has three values; a frozen one is its side.
            Op::Sign { of, .. } if free => self.slot(of)[0].sign(),
            _ => self.series().value(op),
        }
    }

    fn factor(&mut self, matrix: u32) {
        let (mut factors, mut bench) = (std::mem::take(&mut self.factors), std::mem::take(&mut self.bench));
        let matrix = &self.tape.matrices[matrix as usize];
        let own = &mut factors[matrix.offset..][..matrix.plan.room];
        S::factor(&self.series(), matrix, &mut bench, own);
        (self.factors, self.bench) = (factors, bench);
    }

    /// Finds the unknowns of a system at order 0.
    fn solve(&mut self, system: u32) {
        let mut bench = std::mem::take(&mut self.bench);
        self.series().solve(system, 0, &mut bench);
        let unknowns = self.tape.systems[system as usize].unknowns;
        (unknowns..).zip(&bench.x).for_each(|(slot, x)| self.arena.put(slot, 0, *x));
        self.bench = bench;
    }

    fn series(&self) -> Series<'_, S> {
        Series {
            arena: &self.arena,
            signs: &self.signs,
            tape: &self.tape,
            factors: &self.factors,
            vanishing: &self.vanishing,
            elapsed: self.elapsed,
        }
    }
}
