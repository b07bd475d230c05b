//! From formulas to a tape: each node of the graph becomes one operation, with the companions its recurrence needs.

mod system;

use std::collections::HashMap;

use num_rational::BigRational;
use num_traits::{One, ToPrimitive};

use crate::rounding::{Constant, Rounding};

use crate::expr::{Binary, Node, Relation, Symbol, Unary};
use crate::graph::{Graph, NodeId};
use crate::hashing::FastMap;
use crate::ops::{Op, Slot};
use crate::resolved::Resolved;
use crate::same::Exact;
use crate::table::TableRef;
use crate::tape::{CompileError, Layout, Lookup, Stage, Tape};

/// Integer powers up to this become products, a base of zero included; higher ones, and all others, use the power's own recurrence.
const LARGEST_UNROLLED_POWER: u32 = 1 << 16;

/// Stands for a companion's slot in keys that are looked up before the companion has one.
const UNPLACED: Slot = Slot::MAX;

pub(crate) struct Lowering {
    leaves: HashMap<Symbol, Slot>,
    tape: Tape,
    rounding: Rounding,
    /// Indices in the tape's list of numbers.
    numbers: HashMap<Exact, u32>,
    /// Operations already on the tape.
    known: FastMap<Op, Slot>,
    /// Branches by their guard.
    branches: FastMap<Slot, u32>,
}

impl Lowering {
    pub(crate) fn new(layout: &Layout) -> Self {
        let mut lowering = Self {
            leaves: HashMap::new(),
            rounding: layout.rounding,
            numbers: HashMap::new(),
            tape: Tape {
                ops: vec![],
                stages: vec![],
                numbers: vec![],
                pi: layout.rounding.pi(),
                norms: vec![],
                guards: vec![],
                outputs: vec![],
                names: vec![],
                tables: vec![],
                matrices: vec![],
                systems: vec![],
                states: layout.states.len(),
                inputs: layout.inputs.len(),
                resolved: Resolved::default(),
            },
            known: FastMap::default(),
            branches: FastMap::default(),
        };
        let states = layout.states.iter().enumerate().map(|(i, s)| (s, Op::State(i as u32)));
        let inputs = layout.inputs.iter().enumerate().map(|(i, s)| (s, Op::Input(i as u32)));
        for (symbol, op) in states.chain([(&layout.time, Op::Time)]).chain(inputs) {
            let slot = lowering.push(op);
            lowering.tape.names.push(symbol.name.to_string());
            lowering.leaves.insert(symbol.clone(), slot);
        }
        lowering
    }

    /// The tape of some nodes of a graph, and of what they need.
    pub(crate) fn lower(mut self, graph: &Graph, outputs: &[NodeId]) -> Result<Tape, CompileError> {
        let mut slots: Vec<Option<Slot>> = vec![None; graph.nodes().len()];
        for id in graph.reachable(outputs) {
            slots[id.index()] = Some(self.node(graph, id, &slots)?);
        }
        self.tape.outputs = outputs.iter().map(|output| placed(&slots, *output)).collect();
        self.tape.resolved = Resolved::of(&self.tape);
        Ok(self.tape)
    }

    fn node(&mut self, graph: &Graph, id: NodeId, slots: &[Option<Slot>]) -> Result<Slot, CompileError> {
        let at = |part: &NodeId| placed(slots, *part);
        Ok(match graph.node(id) {
            Node::Number(value) => self.number(value),
            Node::Pi => self.emit(Op::Pi),
            Node::Symbol(symbol) => *self
                .leaves
                .get(symbol)
                .ok_or_else(|| CompileError::UnknownSymbol(symbol.name.to_string()))?,
            Node::Unary(op, a) => self.unary(*op, at(a)),
            Node::Binary(Binary::Pow, a, b) => self.power(at(a), at(b), exact(graph, *b)),
            Node::Binary(op, a, b) => self.binary(*op, at(a), at(b)),
            // A comparison is its guard: its side is the sign. See `select`.
            Node::Compare(_, a, b) => self.emit(Op::Sub(at(a), at(b))),
            Node::Select(condition, a, b) => self.select(graph, *condition, at(condition), at(a), at(b)),
            Node::Norm(parts) => self.norm(parts.iter().map(at).collect()),
            Node::Table(table, a) => self.table(table, at(a)),
            Node::System(shape, parts) => self.system(shape, &parts.iter().map(at).collect::<Vec<_>>()),
            Node::Unknown(system, row) => self.unknown(at(system), *row),
        })
    }

    fn number(&mut self, value: &BigRational) -> Slot {
        let (list, rounding) = (&mut self.tape.numbers, self.rounding);
        let index = *self.numbers.entry(Exact(value.clone())).or_insert_with(|| {
            list.push(Constant::of(value, rounding));
            list.len() as u32 - 1
        });
        self.emit(Op::Number(index))
    }

    fn unary(&mut self, op: Unary, of: Slot) -> Slot {
        match op {
            Unary::Neg => self.emit(Op::Neg(of)),
            Unary::Sqrt => self.emit(Op::Sqrt(of)),
            Unary::Exp => self.emit(Op::Exp(of)),
            Unary::Log => self.emit(Op::Log(of)),
            Unary::Sin => self.pair(|cos| Op::Sin { of, cos }, |sin| Op::Cos { of, sin }).0,
            Unary::Cos => self.pair(|cos| Op::Sin { of, cos }, |sin| Op::Cos { of, sin }).1,
            Unary::Sinh => self.pair(|cosh| Op::Sinh { of, cosh }, |sinh| Op::Cosh { of, sinh }).0,
            Unary::Cosh => self.pair(|cosh| Op::Sinh { of, cosh }, |sinh| Op::Cosh { of, sinh }).1,
            Unary::Tan => self.with_slope(of, |of, slope| Op::Tan { of, slope }, Op::Add),
            Unary::Tanh => self.with_slope(of, |of, slope| Op::Tanh { of, slope }, Op::Sub),
            Unary::Asin => {
                let root = self.circle(of);
                self.emit(Op::Asin { of, root })
            }
            Unary::Acos => {
                let root = self.circle(of);
                self.emit(Op::Acos { of, root })
            }
            Unary::Atan => {
                let (one, square) = (self.one(), self.emit(Op::Square(of)));
                let square = self.emit(Op::Add(one, square));
                self.emit(Op::Atan { of, square })
            }
            Unary::Abs => {
                let branch = self.branch(of);
                self.emit(Op::Abs { of, branch })
            }
            Unary::Sign => {
                let branch = self.branch(of);
                self.emit(Op::Sign { of, branch })
            }
            Unary::Step => {
                let branch = self.branch(of);
                self.emit(Op::Step { branch })
            }
        }
    }

    fn binary(&mut self, op: Binary, a: Slot, b: Slot) -> Slot {
        match op {
            Binary::Add => self.emit(Op::Add(a, b)),
            Binary::Sub => self.emit(Op::Sub(a, b)),
            Binary::Mul if a == b => self.emit(Op::Square(a)),
            Binary::Mul if self.fixed(b) => self.emit(Op::Scale { of: a, by: b }),
            Binary::Mul if self.fixed(a) => self.emit(Op::Scale { of: b, by: a }),
            Binary::Mul => self.emit(Op::Mul(a, b)),
            Binary::Div if self.fixed(b) => self.emit(Op::Shrink { of: a, by: b }),
            Binary::Div => self.emit(Op::Div(a, b)),
            Binary::Atan2 => {
                let (y2, x2) = (self.emit(Op::Square(a)), self.emit(Op::Square(b)));
                let square = self.emit(Op::Add(x2, y2));
                self.emit(Op::Atan2 { y: a, x: b, square })
            }
            Binary::Min => self.choose(a, b, b, a),
            Binary::Max => self.choose(a, b, a, b),
            Binary::SquareOver => self.square_over(a, b),
            Binary::Pow => unreachable!("powers are lowered by `power`, which sees the exponent's value"),
        }
    }

    /// `positive` where `a - b >= 0`, else `negative`.
    fn choose(&mut self, a: Slot, b: Slot, positive: Slot, negative: Slot) -> Slot {
        let guard = self.emit(Op::Sub(a, b));
        let branch = self.branch(guard);
        self.emit(Op::Choose { branch, positive, negative })
    }

    /// `a < b` fails where `a - b >= 0`; `a <= b` holds where `b - a >= 0`: at equality both are right.
    fn select(
        &mut self,
        graph: &Graph,
        condition: NodeId,
        difference: Slot,
        then: Slot,
        otherwise: Slot,
    ) -> Slot {
        let strict = matches!(graph.node(condition), Node::Compare(Relation::Less, ..));
        let (guard, positive, negative) = match self.tape.ops[difference as usize] {
            Op::Sub(a, b) if !strict => (self.emit(Op::Sub(b, a)), then, otherwise),
            _ => (difference, otherwise, then),
        };
        let branch = self.branch(guard);
        self.emit(Op::Choose { branch, positive, negative })
    }

    fn power(&mut self, of: Slot, exponent: Slot, exact: Option<&BigRational>) -> Slot {
        let two = BigRational::from_integer(2.into());
        match exact {
            Some(value) if value.is_integer() => match value.numer().to_i32() {
                Some(n) if n.unsigned_abs() <= LARGEST_UNROLLED_POWER => self.integer_power(of, n),
                _ => self.emit(Op::Pow { of, exponent }),
            },
            Some(value) if (value * &two).is_one() => self.emit(Op::Sqrt(of)),
            _ if self.fixed(exponent) => self.emit(Op::Pow { of, exponent }),
            _ => {
                let log = self.emit(Op::Log(of));
                let product = self.binary(Binary::Mul, exponent, log);
                self.emit(Op::Exp(product))
            }
        }
    }

    /// By repeated squaring, so that a base of zero is no special case.
    fn integer_power(&mut self, of: Slot, n: i32) -> Slot {
        let (mut square, mut result) = (of, None);
        let mut rest = n.unsigned_abs();
        while rest > 0 {
            if rest % 2 == 1 {
                result = Some(match result {
                    None => square,
                    Some(product) => self.binary(Binary::Mul, product, square),
                });
            }
            rest /= 2;
            if rest > 0 {
                square = self.emit(Op::Square(square));
            }
        }
        let one = self.one();
        let product = result.unwrap_or(one);
        if n < 0 { self.binary(Binary::Div, one, product) } else { product }
    }

    fn norm(&mut self, parts: Vec<Slot>) -> Slot {
        self.tape.norms.push(parts);
        self.emit(Op::Norm(self.tape.norms.len() as u32 - 1))
    }

    fn square_over(&mut self, of: Slot, by: Slot) -> Slot {
        self.tape.norms.push(vec![by]);
        self.emit(Op::SquareOver { of, by, vanishing: self.tape.norms.len() as u32 - 1 })
    }

    /// The polynomial of the segment that holds, by Horner's rule in the distance from its knot.
    fn table(&mut self, table: &TableRef, of: Slot) -> Slot {
        let uses = &mut self.tape.tables;
        let lookup =
            uses.iter().position(|known| known.of == of && known.table == *table).unwrap_or_else(|| {
                uses.push(Lookup { table: table.clone(), of });
                uses.len() - 1
            }) as u32;
        let origin = self.emit(Op::Knot { lookup, of });
        let distance = self.emit(Op::Sub(of, origin));
        let mut sum = self.emit(Op::Coefficient { lookup, of, power: table.0.degree() as u32 });
        for power in (0..table.0.degree() as u32).rev() {
            let next = self.emit(Op::Coefficient { lookup, of, power });
            let product = self.binary(Binary::Mul, sum, distance);
            sum = self.emit(Op::Add(next, product));
        }
        sum
    }

    fn one(&mut self) -> Slot {
        self.number(&BigRational::one())
    }

    /// sqrt(1 - of^2)
    fn circle(&mut self, of: Slot) -> Slot {
        let (one, square) = (self.one(), self.emit(Op::Square(of)));
        let rest = self.emit(Op::Sub(one, square));
        self.emit(Op::Sqrt(rest))
    }

    /// A function whose derivative is 1 plus or minus its own square: the square follows it on the tape.
    fn with_slope(
        &mut self,
        of: Slot,
        function: impl Fn(Slot, Slot) -> Op,
        combine: fn(Slot, Slot) -> Op,
    ) -> Slot {
        let key = function(of, UNPLACED);
        if let Some(&slot) = self.known.get(&key) {
            return slot;
        }
        let one = self.one();
        let slot = self.push(function(of, self.next() + 2));
        let square = self.push(Op::Square(slot));
        self.push(combine(one, square));
        self.known.insert(key, slot);
        slot
    }

    /// Two functions that are each other's derivative up to sign, next to each other on the tape.
    fn pair(&mut self, first: impl Fn(Slot) -> Op, second: impl Fn(Slot) -> Op) -> (Slot, Slot) {
        let key = first(UNPLACED);
        if let Some(&slot) = self.known.get(&key) {
            return (slot, slot + 1);
        }
        let next = self.next();
        let pair = (self.push(first(next + 1)), self.push(second(next)));
        self.known.insert(key, pair.0);
        pair
    }

    fn branch(&mut self, guard: Slot) -> u32 {
        let guards = &mut self.tape.guards;
        *self.branches.entry(guard).or_insert_with(|| {
            guards.push(guard);
            guards.len() as u32 - 1
        })
    }

    fn fixed(&self, slot: Slot) -> bool {
        self.tape.stage(slot) < Stage::Varying
    }

    fn emit(&mut self, op: Op) -> Slot {
        match self.known.get(&op) {
            Some(&slot) => slot,
            None => self.push(op),
        }
    }

    fn next(&self) -> Slot {
        self.tape.ops.len() as Slot
    }

    fn push(&mut self, op: Op) -> Slot {
        let slot = self.next();
        let parts = op.parts(&self.tape);
        let stage = match op {
            Op::State(_) | Op::Time => Stage::Varying,
            Op::Input(_) => Stage::Uniform,
            _ => parts.iter().map(|part| self.tape.stage(*part)).max().unwrap_or(Stage::Constant),
        };
        self.tape.ops.push(op);
        self.tape.stages.push(stage);
        self.known.insert(op, slot);
        slot
    }
}

fn exact(graph: &Graph, id: NodeId) -> Option<&BigRational> {
    match graph.node(id) {
        Node::Number(value) => Some(value),
        _ => None,
    }
}

fn placed(slots: &[Option<Slot>], id: NodeId) -> Slot {
    slots[id.index()].expect("parts come before what is made of them")
}
