//! Formulas prepared once and put together again and again: fragments, and what links them.
//!
//! A fragment is what formulas become in a graph of their own: simplified, in order, without what they do not need. Its symbols are
//! imports. A linker puts fragments into one graph: each node again with its parts moved to where they stand there. So no
//! formula is walked through, what several fragments compute alike is one node, what an import is makes it simpler where it can
//! (a force that is zero), and everything that a tape holds comes out of the same lowering as that of formulas compiled as one.

use std::sync::Arc;

use num_traits::Zero;

use crate::expr::{Binary, Expr, Node, Symbol, Unary};
use crate::graph::{Graph, NodeId};
use crate::hashing::FastMap;
use crate::lower::Lowering;
use crate::shape::SparsityPattern;
use crate::tape::{CompileError, Layout, Tape, check};

/// Formulas but for the names of their symbols. Equal for formulas that differ by names alone.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Code {
    imports: u32,
    /// Parts are counted from the first import on.
    nodes: Vec<Node<u32>>,
    exports: Vec<u32>,
}

/// Some formulas, ready to be linked.
#[derive(Clone, Debug)]
pub struct Fragment {
    /// What they compute. Those that differ by names alone may share it: numbers are then looked up once.
    pub code: Arc<Code>,
    /// What they are computed from.
    pub imports: Vec<Symbol>,
}

impl Fragment {
    /// That of these formulas, which are its exports in this order.
    pub fn new(formulas: &[Expr]) -> Result<Self, CompileError> {
        check(formulas)?;
        let mut graph = Graph::default();
        let exports = graph.import(formulas);
        let (mut imports, mut inner) = (vec![], vec![]);
        for id in graph.reachable(&exports) {
            match graph.node(id) {
                Node::Symbol(symbol) => imports.push((id, symbol.clone())),
                _ => inner.push(id),
            }
        }
        let mut places = vec![0; graph.nodes().len()];
        let ids = imports.iter().map(|(id, _)| *id).chain(inner.iter().copied());
        ids.zip(0..).for_each(|(id, place)| places[id.index()] = place);
        let code = Code {
            imports: imports.len() as u32,
            nodes: inner.iter().map(|id| graph.node(*id).map(|part| places[part.index()])).collect(),
            exports: exports.iter().map(|id| places[id.index()]).collect(),
        };
        let imports = imports.into_iter().map(|(_, symbol)| symbol).collect();
        Ok(Self { code: Arc::new(code), imports })
    }
}

/// Puts fragments into one graph, and makes tapes of it.
#[derive(Debug, Default)]
pub struct Linker {
    graph: Graph,
    /// By code, where its numbers stand in the graph. The code is held, so that its address is no other's.
    numbers: FastMap<*const Code, (Arc<Code>, Vec<NodeId>)>,
    /// By place in the code that is being linked.
    places: Vec<NodeId>,
}

impl Linker {
    /// A symbol as a leaf.
    pub fn symbol(&mut self, symbol: &Symbol) -> NodeId {
        self.graph.add(Node::Symbol(symbol.clone()))
    }

    /// The exports of some code, for these imports.
    ///
    /// # Panics
    /// If there are not as many imports as the code has.
    pub fn link(&mut self, code: &Arc<Code>, imports: &[NodeId]) -> Vec<NodeId> {
        assert_eq!(imports.len(), code.imports as usize, "one value an import");
        let Self { graph, numbers, places } = self;
        let (_, numbers) = numbers.entry(Arc::as_ptr(code)).or_insert_with(|| {
            let is_number = |node: &&Node<u32>| matches!(node, Node::Number(_));
            let numbers = code.nodes.iter().filter(is_number).map(|node| graph.add(node.map(|_| NodeId(0))));
            let numbers = numbers.collect();
            (Arc::clone(code), numbers)
        });
        let mut numbers = numbers.iter();
        places.clear();
        places.extend(imports);
        for node in &code.nodes {
            let place = match node {
                Node::Number(_) => numbers.next().copied(),
                _ => None,
            };
            let place = place.unwrap_or_else(|| graph.add(node.map(|part| places[*part as usize])));
            places.push(place);
        }
        code.exports.iter().map(|export| places[*export as usize]).collect()
    }

    /// Formulas that are linked this once, their symbols as leaves.
    pub fn formulas(&mut self, formulas: &[Expr]) -> Result<Vec<NodeId>, CompileError> {
        check(formulas)?;
        Ok(self.graph.import(formulas))
    }

    /// The number 0.
    pub fn zero(&mut self) -> NodeId {
        self.graph.add(Node::Number(Zero::zero()))
    }

    /// An operation on a value.
    pub fn unary(&mut self, op: Unary, a: NodeId) -> NodeId {
        self.graph.add(Node::Unary(op, a))
    }

    /// An operation on two values.
    pub fn binary(&mut self, op: Binary, a: NodeId, b: NodeId) -> NodeId {
        self.graph.add(Node::Binary(op, a, b))
    }

    /// The unknowns of a linear system of the entries of each row, by increasing columns, and the right sides: as
    /// [`Expr::solve_rows`] of formulas.
    pub fn solve_rows(&mut self, rows: Vec<Vec<(usize, NodeId)>>, right: Vec<NodeId>) -> Vec<NodeId> {
        let is_entry = |(_, entry): &(usize, NodeId)| !self.is_zero(*entry);
        let rows: Vec<Vec<(usize, NodeId)>> =
            rows.into_iter().map(|row| row.into_iter().filter(is_entry).collect()).collect();
        if let ([row], [right]) = (&rows[..], &right[..]) {
            let entry = row.first().map(|(_, entry)| *entry);
            let entry = entry.unwrap_or_else(|| self.zero());
            return vec![self.binary(Binary::Div, *right, entry)];
        }
        let columns = |row: &Vec<(usize, NodeId)>| row.iter().map(|(column, _)| *column as u32).collect();
        let shape = Arc::new(SparsityPattern::new(rows.iter().map(columns)));
        let unknowns = right.len() as u32;
        let entries = rows.into_iter().flatten().map(|(_, entry)| entry);
        let system = self.graph.add(Node::System(shape, entries.chain(right).collect()));
        (0..unknowns).map(|row| self.graph.add(Node::Unknown(system, row))).collect()
    }

    /// The tape of some values, in this order.
    pub fn tape(&self, layout: &Layout, outputs: &[NodeId]) -> Result<Tape, CompileError> {
        Lowering::new(layout).lower(&self.graph, outputs)
    }

    fn is_zero(&self, id: NodeId) -> bool {
        matches!(self.graph.node(id), Node::Number(value) if value.is_zero())
    }
}
