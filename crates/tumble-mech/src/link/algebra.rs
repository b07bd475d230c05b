//! What values in a mode may be: nodes of a linker, or formulas.

use tumble_expr::{Binary, CompileError, Expr, Linker, NodeId, Symbol, Unary};

use super::part::Piece;

/// How values are made of others.
pub(crate) trait Algebra {
    type Value: Clone;

    fn leaf(&mut self, symbol: &Symbol) -> Self::Value;

    fn zero(&mut self) -> Self::Value;

    /// What a piece computes, for values of its imports.
    fn link(&mut self, piece: &Piece, imports: &[Self::Value]) -> Vec<Self::Value>;

    fn binary(&mut self, op: Binary, a: Self::Value, b: Self::Value) -> Self::Value;

    fn unary(&mut self, op: Unary, a: Self::Value) -> Self::Value;

    /// The unknowns of a linear system of entries by row and column, and right sides.
    fn solve(&mut self, rows: Vec<Vec<(usize, Self::Value)>>, right: Vec<Self::Value>) -> Vec<Self::Value>;
}

/// Values are nodes of a linker.
#[derive(Default)]
pub(crate) struct Nodes {
    linker: Linker,
    /// The first mistake in a formula.
    mistake: Option<CompileError>,
}

impl Nodes {
    /// The linker, if no formula has a mistake.
    pub(crate) fn linker(self) -> Result<Linker, CompileError> {
        match self.mistake {
            Some(mistake) => Err(mistake),
            None => Ok(self.linker),
        }
    }
}

impl Algebra for Nodes {
    type Value = NodeId;

    fn leaf(&mut self, symbol: &Symbol) -> NodeId {
        self.linker.symbol(symbol)
    }

    fn zero(&mut self) -> NodeId {
        self.linker.zero()
    }

    fn link(&mut self, piece: &Piece, imports: &[NodeId]) -> Vec<NodeId> {
        match &piece.class.code {
            Ok(code) => self.linker.link(code, imports),
            Err(mistake) => {
                self.mistake.get_or_insert_with(|| mistake.clone());
                vec![self.linker.zero(); piece.class.formulas.len()]
            }
        }
    }

    fn binary(&mut self, op: Binary, a: NodeId, b: NodeId) -> NodeId {
        self.linker.binary(op, a, b)
    }

    fn unary(&mut self, op: Unary, a: NodeId) -> NodeId {
        self.linker.unary(op, a)
    }

    fn solve(&mut self, rows: Vec<Vec<(usize, NodeId)>>, right: Vec<NodeId>) -> Vec<NodeId> {
        self.linker.solve_rows(rows, right)
    }
}

/// Values are formulas.
#[derive(Default)]
pub(crate) struct Written;

impl Algebra for Written {
    type Value = Expr;

    fn leaf(&mut self, symbol: &Symbol) -> Expr {
        symbol.clone().into()
    }

    fn zero(&mut self) -> Expr {
        Expr::zero()
    }

    fn link(&mut self, piece: &Piece, imports: &[Expr]) -> Vec<Expr> {
        piece.written(imports)
    }

    fn binary(&mut self, op: Binary, a: Expr, b: Expr) -> Expr {
        Expr::binary(op, a, b)
    }

    fn unary(&mut self, op: Unary, a: Expr) -> Expr {
        Expr::unary(op, a)
    }

    fn solve(&mut self, rows: Vec<Vec<(usize, Expr)>>, right: Vec<Expr>) -> Vec<Expr> {
        Expr::solve_rows(rows, right)
    }
}
