//! Symbols, and the test that what is shown is what was given.
#![allow(dead_code, unreachable_pub)]

use std::collections::BTreeMap;
use std::sync::Arc;

use tumble_expr::{Branches, Dimension, Expr, Jets, Layout, Rounded, Symbol, Tape};

pub mod reader;

/// Relative difference that rounding may leave between two ways of writing one formula.
const ROUNDING: f64 = 1e-12;
const POINTS: usize = 20;

pub fn length(name: &str) -> Expr {
    Expr::symbol(name, Dimension::LENGTH)
}

pub fn mass(name: &str) -> Expr {
    Expr::symbol(name, Dimension::MASS)
}

pub fn force(name: &str) -> Expr {
    Expr::symbol(name, Dimension::FORCE)
}

pub fn pure(name: &str) -> Expr {
    Expr::symbol(name, Dimension::NONE)
}

pub fn speed(name: &str) -> Expr {
    Expr::symbol(name, Dimension::SPEED)
}

pub fn g() -> Expr {
    Expr::symbol("g", Dimension::ACCELERATION)
}

pub fn t() -> Expr {
    Expr::symbol("t", Dimension::TIME)
}

pub fn omega() -> Expr {
    Expr::symbol("rod.omega", Dimension::ANGULAR_RATE)
}

/// Numbers between 0.2 and 1.7, the same in every run.
pub struct Points(u64);

impl Points {
    pub fn new() -> Self {
        Self(0x2545_f491_4f6c_dd1d)
    }

    pub fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        0.2 + 1.5 * (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Values of formulas for values of all their symbols.
pub struct Evaluator {
    jets: Jets<f64>,
    pub names: Vec<String>,
}

impl Evaluator {
    pub fn new(formulas: &[Expr]) -> Self {
        let mut all: BTreeMap<String, Symbol> = BTreeMap::new();
        for symbol in formulas.iter().flat_map(Expr::symbols) {
            all.insert(symbol.name.to_string(), symbol);
        }
        let names = all.keys().cloned().collect();
        let states = all.into_values().collect();
        let time = Symbol::new("no time", Dimension::TIME);
        let layout = Layout::new(states, time, vec![]);
        let tape = Tape::compile(&layout, formulas).expect("typed");
        Self { jets: Jets::new(Arc::new(tape), 0, &[]), names }
    }

    pub fn at(&mut self, values: &[f64]) -> Vec<f64> {
        self.jets.start(0.0, values, Branches::Free);
        let outputs = self.jets.tape().outputs().to_vec();
        outputs.into_iter().map(|slot| self.jets.slot(slot)[0]).collect()
    }
}

impl Evaluator {
    /// What rounding may have made of each value.
    pub fn noise(&self, values: &[f64]) -> Vec<f64> {
        let mut rounded: Jets<Rounded> = Jets::new(Arc::clone(self.jets.tape()), 0, &[]);
        let values: Vec<Rounded> = values.iter().map(|value| Rounded::leaf(*value)).collect();
        rounded.start(Rounded::leaf(0.0), &values, Branches::Free);
        (0..rounded.tape().outputs().len()).map(|index| rounded.value_of(index).noise()).collect()
    }
}

/// Both formulas have one value wherever the first has one. Signs of the values are tried both ways.
pub fn assert_same(given: &Expr, shown: &Expr, positive: &[&str]) {
    let mut evaluator = Evaluator::new(&[given.clone(), shown.clone()]);
    let mut points = Points::new();
    let mut compared = 0;
    for _ in 0..POINTS {
        let values: Vec<f64> = evaluator
            .names
            .clone()
            .iter()
            .map(|name| {
                let value = points.next();
                let minus = points.next() < 0.9 && !positive.contains(&name.as_str());
                if minus { -value } else { value }
            })
            .collect();
        let found = evaluator.at(&values);
        if found[0].is_finite() {
            assert!(close(found[0], found[1]), "{} is not {} at {values:?}", found[1], found[0]);
            compared += 1;
        }
    }
    assert!(compared > 0, "no point where the formula has a value");
}

pub fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= ROUNDING * a.abs().max(b.abs()).max(1e-3)
}
