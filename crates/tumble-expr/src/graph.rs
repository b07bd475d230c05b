//! Formulas as one directed graph in which equal sub-formulas are one node.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::sync::Arc;

use num_traits::Zero;

use crate::expr::{Expr, Inner, Node};
use crate::hashing::FastMap;
use crate::peel;
use crate::simplify;

/// A node of a [`Graph`]. Parts always have smaller indices than the node made of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(pub(crate) u32);

impl NodeId {
    /// Position in [`Graph::nodes`].
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A deduplicated graph of formulas, simplified as it grows.
///
/// Only what is exact is simplified: sums and products with 0 and 1, signs, functions at 0 and 1, and arithmetic
/// between rational numbers. Parameters are never folded, whatever their values.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Vec<Node<NodeId>>,
    /// Numbers and symbols, which the user chooses.
    leaves: HashMap<Node<NodeId>, NodeId>,
    /// All others, which are indices.
    known: FastMap<Node<NodeId>, NodeId>,
    /// By linear system, simpler nodes for its unknowns.
    peeled: FastMap<NodeId, Arc<[Option<NodeId>]>>,
}

impl Graph {
    /// Nodes in an order in which parts come first.
    pub fn nodes(&self) -> &[Node<NodeId>] {
        &self.nodes
    }

    /// One node.
    pub fn node(&self, id: NodeId) -> &Node<NodeId> {
        &self.nodes[id.index()]
    }

    /// Adds formulas; shared parts are visited once, and the depth of a formula is not bounded by the stack.
    pub fn import(&mut self, formulas: &[Expr]) -> Vec<NodeId> {
        let mut seen: FastMap<*const Inner, NodeId> = FastMap::default();
        let mut pending: Vec<(&Expr, bool)> = Vec::new();
        for formula in formulas {
            pending.push((formula, false));
            while let Some((next, are_parts_done)) = pending.pop() {
                if seen.contains_key(&Arc::as_ptr(&next.0)) {
                    continue;
                }
                if are_parts_done {
                    let node = next.node().map(|part| seen[&Arc::as_ptr(&part.0)]);
                    let id = self.add(node);
                    seen.insert(Arc::as_ptr(&next.0), id);
                } else {
                    pending.push((next, true));
                    // The last of the parts comes first, as it always has: nodes are counted in that order.
                    next.node().each_part(|part| pending.push((part, false)));
                }
            }
        }
        formulas.iter().map(|formula| seen[&Arc::as_ptr(&formula.0)]).collect()
    }

    /// Adds one node over nodes of this graph, or finds the equal one that is there.
    pub fn add(&mut self, node: Node<NodeId>) -> NodeId {
        match simplify::simplify(self, node) {
            simplify::Simplified::Known(id) => id,
            simplify::Simplified::Node(node) => self.intern(node),
        }
    }

    /// Nodes that some need, these included, in the graph's order.
    pub(crate) fn reachable(&self, roots: &[NodeId]) -> impl Iterator<Item = NodeId> {
        let mut needed = vec![false; self.nodes.len()];
        for root in roots {
            needed[root.index()] = true;
        }
        for index in (0..needed.len()).rev() {
            if needed[index] {
                self.nodes[index].each_part(|part| needed[part.index()] = true);
            }
        }
        let needed = needed.into_iter().zip(0..).filter(|(is_needed, _)| *is_needed);
        needed.map(|(_, index)| NodeId(index))
    }

    /// A simpler node for an unknown of a linear system, if there is one.
    pub(crate) fn peeled(&mut self, system: NodeId, row: u32) -> Option<NodeId> {
        if let Some(known) = self.peeled.get(&system) {
            return known[row as usize];
        }
        let Node::System(shape, parts) = self.node(system).clone() else { return None };
        let found: Arc<[Option<NodeId>]> = peel::unknowns(self, &shape, &parts).into();
        self.peeled.insert(system, Arc::clone(&found));
        found[row as usize]
    }

    fn intern(&mut self, node: Node<NodeId>) -> NodeId {
        match matches!(node, Node::Number(_) | Node::Pi | Node::Symbol(_)) {
            true => placed(&mut self.nodes, self.leaves.entry(node)),
            false => placed(&mut self.nodes, self.known.entry(node)),
        }
    }
}

/// The node of an entry, added if it is new.
fn placed(nodes: &mut Vec<Node<NodeId>>, entry: Entry<'_, Node<NodeId>, NodeId>) -> NodeId {
    *entry.or_insert_with_key(|node| {
        nodes.push(node.clone());
        NodeId(u32::try_from(nodes.len() - 1).expect("fewer than 2^32 nodes fit in memory"))
    })
}

/// Whether a formula is zero whatever its symbols are, as far as exact simplification shows.
pub fn is_identically_zero(formula: &Expr) -> bool {
    let mut graph = Graph::default();
    let id = graph.import(std::slice::from_ref(formula))[0];
    matches!(graph.node(id), Node::Number(value) if value.is_zero())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Dimension;

    fn size(formula: &Expr) -> usize {
        let mut graph = Graph::default();
        graph.import(std::slice::from_ref(formula));
        graph.nodes().len()
    }

    #[test]
    fn equal_parts_are_one_node() {
        let x = Expr::symbol("x", Dimension::LENGTH);
        let y = Expr::symbol("y", Dimension::LENGTH);
        // x, y, x*y, and the sum: y*x is the same node as x*y.
        assert_eq!(size(&((&x * &y) + (&y * &x))), 4);
    }

    #[test]
    fn doubling_a_hundred_times_is_linear() {
        let mut sum = Expr::symbol("a", Dimension::LENGTH);
        for _ in 0..100 {
            sum = &sum + &sum;
        }
        assert_eq!(size(&sum), 101);
    }

    #[test]
    fn a_deep_chain_imports() {
        let x = Expr::symbol("x", Dimension::NONE);
        let mut chain = x.clone();
        for _ in 0..200_000 {
            chain = (chain + &x).sin();
        }
        assert_eq!(size(&chain), 400_001);
    }
}
