//! Linked fragments beside formulas compiled as one: the same values, series, intervals, sides and degrees, to the bit.

use std::sync::Arc;

use tumble_expr::{
    Branches, Dimension, Expr, Fragment, Interval, Jets, Kernels, Layout, Linker, NodeId, Rounded,
    Substitution, Symbol, Tape,
};

use super::{ORDER, P, cases, p, systems, t};

/// What the time of a case is made of.
fn u() -> Symbol {
    Symbol::new("u", Dimension::NONE)
}

/// What its parameter is made of.
fn r() -> Symbol {
    Symbol::new("r", Dimension::NONE)
}

fn layout() -> Layout {
    Layout::new(vec![], u(), vec![r()])
}

/// The formulas behind `t` and `p`.
fn before() -> [Expr; 2] {
    [Expr::from(u()) * 2, Expr::from(r()) / 2 + 1]
}

fn compiled(formula: &Expr) -> Arc<Tape> {
    let mut substitution = Substitution::default();
    let symbols = ["t", "p"].map(|name| Symbol::new(name, Dimension::NONE));
    symbols.into_iter().zip(before()).for_each(|(symbol, formula)| substitution.insert(symbol, formula));
    Arc::new(Tape::compile(&layout(), &[substitution.apply(formula)]).expect("well-typed"))
}

/// A fragment's exports where `t` and `p` are these, and all other symbols leaves.
fn linked_with(linker: &mut Linker, formulas: &[Expr], known: &[NodeId]) -> Vec<NodeId> {
    let fragment = Fragment::new(formulas).expect("well-typed");
    let import = |symbol: &Symbol| match &*symbol.name {
        "t" => known[0],
        "p" => known[1],
        _ => linker.symbol(symbol),
    };
    let imports: Vec<NodeId> = fragment.imports.iter().map(import).collect();
    linker.link(&fragment.code, &imports)
}

fn linked(formula: &Expr) -> Arc<Tape> {
    let mut linker = Linker::default();
    let known = linked_with(&mut linker, &before(), &[]);
    let outputs = linked_with(&mut linker, std::slice::from_ref(formula), &known);
    Arc::new(linker.tape(&layout(), &outputs).expect("known symbols"))
}

fn series<S: Kernels>(tape: &Arc<Tape>, at: S, parameter: f64) -> (Vec<S>, Vec<S>) {
    let mut jets = Jets::new(Arc::clone(tape), ORDER, &[S::splat(parameter)]);
    jets.start(at, &[], Branches::Free);
    for k in 1..=ORDER {
        jets.set(0, k, if k == 1 { S::one() } else { S::zero() });
        jets.extend(k);
    }
    (jets.output(0).to_vec(), jets.signs().to_vec())
}

#[test]
fn every_case_is_the_same_linked() {
    for case in cases() {
        let tapes = [compiled(&case.formula), linked(&case.formula)];
        let [as_one, linked] = &tapes;
        // Nothing is computed twice, and nothing that is not needed.
        assert_eq!(as_one.len(), linked.len(), "{}", case.name);
        assert_eq!(as_one.sides(), linked.sides(), "{}", case.name);
        assert_eq!(as_one.norms(), linked.norms(), "{}", case.name);
        assert_eq!(as_one.turnings().len(), linked.turnings().len(), "{}", case.name);
        assert_eq!(as_one.degrees(&[]), linked.degrees(&[]), "{}", case.name);
        assert_eq!(as_one.may_be_narrow(), linked.may_be_narrow(), "{}", case.name);
        let (at, parameter) = (case.at / 2.0, 2.0 * (P - 1.0));
        // Texts of numbers are theirs alone, also of those that are no number.
        let numbers = tapes.each_ref().map(|tape| format!("{:?}", series(tape, at, parameter)));
        assert_eq!(numbers[0], numbers[1], "{}", case.name);
        let rounded =
            tapes.each_ref().map(|tape| format!("{:?}", series(tape, Rounded::leaf(at), parameter)));
        assert_eq!(rounded[0], rounded[1], "{}", case.name);
        let place = Interval::new(at, at + 0.01);
        let intervals = tapes.each_ref().map(|tape| format!("{:?}", series(tape, place, parameter)));
        assert_eq!(intervals[0], intervals[1], "{}", case.name);
    }
}

#[test]
fn what_fragments_have_in_common_is_computed_once() {
    let mut linker = Linker::default();
    let known = [u(), r()].map(|symbol| linker.symbol(&symbol));
    let outputs: Vec<NodeId> = [t().sin() * p(), t().cos() * p() + t().sin()]
        .iter()
        .flat_map(|formula| linked_with(&mut linker, std::slice::from_ref(formula), &known))
        .collect();
    let tape = linker.tape(&layout(), &outputs).expect("known symbols");
    // Time and parameter, sine and cosine, two products, one sum.
    assert_eq!(tape.len(), 7);
}

#[test]
fn an_import_that_is_zero_takes_its_operations_with_it() {
    let mut linker = Linker::default();
    let (time, zero) = (linker.symbol(&u()), linker.zero());
    let formula = t().exp() + p() * (t().abs() + t().sin());
    let outputs = linked_with(&mut linker, &[formula], &[time, zero]);
    let tape = linker.tape(&layout(), &outputs).expect("known symbols");
    assert_eq!((tape.len(), tape.sides()), (3, 0));
}

#[test]
fn formulas_of_other_names_are_one_code() {
    let formula = |name: &str| Expr::symbol(name, Dimension::NONE).sin() * 3 + Expr::pi();
    let [a, b] = ["a", "b"].map(|name| Fragment::new(&[formula(name)]).expect("well-typed"));
    assert_eq!(a.code, b.code);
    assert_ne!(a.imports, b.imports);
}

#[test]
fn systems_are_linked_from_their_entries() {
    for n in [1, 3, 6] {
        let (matrix, right) = (systems::dense(n), vec![t().cos() + p(); n as usize]);
        let rows: Vec<Vec<(usize, Expr)>> =
            matrix.into_iter().map(|row| row.into_iter().enumerate().collect()).collect();
        let mut linker = Linker::default();
        let known = linked_with(&mut linker, &before(), &[]);
        let mut part = |formula: &Expr| linked_with(&mut linker, std::slice::from_ref(formula), &known)[0];
        let entries =
            rows.iter().map(|row| row.iter().map(|(column, entry)| (*column, part(entry))).collect());
        let entries: Vec<Vec<(usize, NodeId)>> = entries.collect();
        let sides = right.iter().map(&mut part).collect();
        let outputs = linker.solve_rows(entries, sides);
        let last = outputs.len() - 1;
        let tape = Arc::new(linker.tape(&layout(), &outputs[last..]).expect("known symbols"));
        let formula = Expr::solve_rows(rows, right).pop().expect("an unknown");
        let numbers = [&tape, &compiled(&formula)].map(|tape| series(tape, 0.35, 1.4));
        assert_eq!(numbers[0], numbers[1], "{n} equations");
    }
}

#[test]
fn a_symbol_without_a_value_is_named() {
    let mut linker = Linker::default();
    let nobody = linker.symbol(&Symbol::new("nobody", Dimension::NONE));
    let refused = linker.tape(&layout(), &[nobody]);
    assert_eq!(
        refused.map(|_| ()).map_err(|error| error.to_string()),
        Err("`nobody` has no value here".into())
    );
}
