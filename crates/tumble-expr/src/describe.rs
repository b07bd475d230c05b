//! Formulas of a tape as text, for messages.

use crate::Tape;
use crate::ops::{Op, Slot};

/// Parts nested deeper than this are left out: a message must fit a line.
const DEEPEST: usize = 6;

impl Tape {
    /// The formula in a slot, in the names of the layout; long formulas are cut with `...`.
    pub fn describe(&self, slot: Slot) -> String {
        self.describe_with(slot, &[])
    }

    /// The same with these names of the states, where there are any.
    pub fn describe_with(&self, slot: Slot, states: &[String]) -> String {
        self.text(slot, DEEPEST, states)
    }

    fn text(&self, slot: Slot, depth: usize, states: &[String]) -> String {
        if depth == 0 {
            return "...".to_owned();
        }
        let of = |slot: Slot| self.text(slot, depth - 1, states);
        let call = |name: &str, slot: Slot| format!("{name}({})", self.text(slot, depth - 1, states));
        match self.ops[slot as usize] {
            Op::State(state) if (state as usize) < states.len() => states[state as usize].clone(),
            Op::State(_) | Op::Time | Op::Input(_) => self.names[slot as usize].clone(),
            Op::Number(index) => self.numbers[index as usize].value.to_string(),
            Op::Pi => "pi".to_owned(),
            Op::Neg(a) => format!("-{}", of(a)),
            Op::Add(a, b) => format!("({} + {})", of(a), of(b)),
            Op::Sub(a, b) => format!("({} - {})", of(a), of(b)),
            Op::Mul(a, b) | Op::Scale { of: a, by: b } => format!("{}*{}", of(a), of(b)),
            Op::Div(a, b) | Op::Shrink { of: a, by: b } => format!("{}/{}", of(a), of(b)),
            Op::Square(a) => format!("{}^2", of(a)),
            Op::Pow { of: a, exponent } => format!("{}^{}", of(a), of(exponent)),
            Op::Sqrt(a) => call("sqrt", a),
            Op::Exp(a) => call("exp", a),
            Op::Log(a) => call("log", a),
            Op::Sin { of, .. } => call("sin", of),
            Op::Cos { of, .. } => call("cos", of),
            Op::Sinh { of, .. } => call("sinh", of),
            Op::Cosh { of, .. } => call("cosh", of),
            Op::Tan { of, .. } => call("tan", of),
            Op::Tanh { of, .. } => call("tanh", of),
            Op::Asin { of, .. } => call("asin", of),
            Op::Acos { of, .. } => call("acos", of),
            Op::Atan { of, .. } => call("atan", of),
            Op::Atan2 { y, x, .. } => format!("atan2({}, {})", of(y), of(x)),
            Op::Abs { of, .. } => call("abs", of),
            Op::Sign { of, .. } => call("sign", of),
            Op::Step { branch } => call("step", self.guards[branch as usize]),
            Op::Choose { branch, positive, negative } => {
                format!("if({} >= 0, {}, {})", of(self.guards[branch as usize]), of(positive), of(negative))
            }
            Op::SquareOver { of: a, by, .. } => format!("{}^2/{}", of(a), of(by)),
            Op::Knot { lookup, .. } | Op::Coefficient { lookup, .. } => {
                self.tables[lookup as usize].table.0.name.clone()
            }
            Op::Factor(matrix) => self.matrix_text(matrix, of),
            Op::System(system) => {
                let system = &self.systems[system as usize];
                let right: Vec<String> = system.right.iter().map(|part| of(*part)).collect();
                format!("solve({}, [{}])", self.matrix_text(system.matrix, of), right.join(", "))
            }
            Op::Unknown { system, row } => format!("{}[{row}]", self.text(system, depth, states)),
            Op::Norm(parts) => {
                let parts: Vec<String> = self.norms[parts as usize].iter().map(|part| of(*part)).collect();
                format!("norm([{}])", parts.join(", "))
            }
        }
    }

    fn matrix_text(&self, matrix: u32, of: impl Fn(Slot) -> String) -> String {
        let matrix = &self.matrices[matrix as usize];
        let shape = &matrix.shape;
        let row = |row: usize| {
            let mut texts = vec!["0".to_owned(); shape.size()];
            shape.entries_of(row).for_each(|(entry, column)| texts[column] = of(matrix.entries[entry]));
            format!("[{}]", texts.join(", "))
        };
        let rows: Vec<String> = (0..shape.size()).map(row).collect();
        format!("[{}]", rows.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use crate::{Dimension, Expr, Layout, Symbol, Tape};

    #[test]
    fn a_formula_reads_as_it_was_written() {
        let symbol = |name: &str| Symbol::new(name, Dimension::NONE);
        let leaf = |name: &str| Expr::from(symbol(name));
        let layout = Layout::new(vec![symbol("rod.vx")], symbol("t"), vec![symbol("L")]);
        let formula = (leaf("t") / 2 - leaf("rod.vx")).abs() * leaf("L").sin();
        let tape = Tape::compile(&layout, &[formula]).expect("typed");
        assert_eq!(tape.describe(tape.outputs()[0]), "abs((t/2 - rod.vx))*sin(L)");
        let matrix = vec![vec![leaf("L"), leaf("t")], vec![leaf("t"), 2 * leaf("L")]];
        let solved = Expr::solve(matrix, vec![leaf("rod.vx"), Expr::from(1)]);
        let tape = Tape::compile(&layout, &solved).expect("typed");
        assert_eq!(tape.describe(tape.outputs()[1]), "solve([[L, t], [t, L*2]], [rod.vx, 1])[1]");
    }
}
