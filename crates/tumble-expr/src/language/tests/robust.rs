//! Texts of every kind get an answer: no panic, no overflow, spans within the text.

use proptest::prelude::*;

use super::super::{Code, FormulaError, MAX_LENGTH, Scope, SpannedText, Value, parse};
use super::{check, evaluate, number};
use crate::{Dimension, Expr, Layout, Symbol, Tape};

const GOOD: &[&str] = &[
    "0.5*w1*(1 + cos(2*pi*t/T))",
    "m*gravity*L/2*sin(rod.angle) - 3 kg*m^2/s^2",
    "if(V < 2 m/s, [1, 2]*norm(r), r)",
    "-2^-2^2 + max(1e-3, .5, 10%)",
    "floor.contact[1].start + 20 ms",
    "w(t + w(2 s)/1 m^(1/2))",
    "2 − １２·rаd°",
    "2 kg/(m*s) + 3 1/s - 1 1/(m*L^2) − L⁻¹²*٣",
];

fn spans_fit(text: &str, errors: &[FormulaError]) {
    assert!(!errors.is_empty());
    for error in errors.iter().filter(|error| error.place == SpannedText::Formula) {
        for (span, _) in &error.labels {
            assert!(text.get(span.clone()).is_some(), "{text:?}: {error:?}");
        }
    }
}

fn answer(text: &str) {
    if let Err(errors) = check(text) {
        spans_fit(text, &errors);
    }
}

fn splice(text: &str, at: usize, remove: usize, insert: &str) -> String {
    let characters: Vec<char> = text.chars().collect();
    let at = at % (characters.len() + 1);
    let rest = (at + remove).min(characters.len());
    characters[..at].iter().copied().chain(insert.chars()).chain(characters[rest..].iter().copied()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn any_text_gets_an_answer(text in "\\PC*") {
        answer(&text);
    }

    #[test]
    fn any_text_of_formula_signs_gets_an_answer(text in "[-+*/^<>=()\\[\\],.%a-eLmstw0-9 ]{0,40}") {
        answer(&text);
    }

    #[test]
    fn a_formula_with_slips_gets_an_answer(
        which in 0..GOOD.len(),
        slips in prop::collection::vec((0..60usize, 0..4usize, "[-+*/^()\\[\\],.a-z0-9 −·]{0,3}"), 1..4),
    ) {
        let slipped = slips.iter().fold(GOOD[which].to_owned(), |t, (at, remove, insert)| splice(&t, *at, *remove, insert));
        answer(&slipped);
    }

    #[test]
    fn a_number_is_the_nearest_double(value in proptest::num::f64::POSITIVE | proptest::num::f64::SUBNORMAL) {
        let value = value.abs();
        prop_assert_eq!(evaluate(&number(&format!("{value:e}"))), value);
        prop_assert_eq!(evaluate(&number(&format!("{value}"))), value);
    }

    #[test]
    fn spaces_around_operators_mean_nothing(a in 1..99i32, b in 1..99i32, c in 1..9i32) {
        let tight = number(&format!("{a}-{b}*({c}+1)^2/{a}"));
        let loose = number(&format!(" {a} - {b} * ( {c} + 1 ) ^ 2 / {a} "));
        prop_assert_eq!(evaluate(&tight), evaluate(&loose));
    }
}

#[test]
fn huge_texts_are_answered() {
    let many = |sign: &str| sign.repeat(60_000);
    for sign in [
        "(", "[", "-", "sin(", "f(", "1^", "1+", "2 m*", ")", ",", "[1,", "1<", "é", "１", "1.", "m*", "x+",
        "1 x+", "1.2.3+", "1 1/", "1 m/(", "1 m/(m*", "⁻¹",
    ] {
        let text = &many(sign)[..sign.len() * (60_000 / sign.len())];
        answer(text);
        answer(&format!("{text}1"));
    }
    let nested = format!("{}1{}", "(".repeat(30_000), ")".repeat(30_000));
    assert_eq!(parse(&nested).expect_err("deep")[0].code, Code::TooDeep);
    let hundred_thousand =
        [format!("{}1{}", "(".repeat(100_000), ")".repeat(100_000)), "1+".repeat(100_000) + "1"];
    for text in [&hundred_thousand[0], &hundred_thousand[1], &"(".repeat(MAX_LENGTH + 1)] {
        assert_eq!(parse(text).expect_err("long")[0].code, Code::TooLong);
    }
    let allowed = format!("{}1{}", "(".repeat(100), ")".repeat(100));
    assert!(parse(&allowed).is_ok());
}

#[test]
fn long_chains_are_checked_without_recursion() {
    for text in ["1+".repeat(30_000) + "1", "-".repeat(60_000) + "1", "2^".repeat(30_000) + "1"] {
        assert!(check(&text).is_ok());
    }
    let exponent = format!("L^({}1)", "-".repeat(60_000));
    assert_eq!(check(&exponent).expect_err("no plain number")[0].code, Code::Exponent);
}

/// The longest chains that a formula may have, through everything that is done with it, on a small stack.
#[test]
fn long_chains_are_compiled_and_dropped_without_recursion() {
    const STACK: usize = 256 << 10;
    let last = |text: &str, count: usize| format!("{}t", text.repeat(count));
    let texts = [last("t+", 32_000), last("t*t/", 16_000), last("-", 65_000), "1 s + ".repeat(10_000) + "t"];
    let compiled = move || {
        let time = Symbol::new("t", Dimension::TIME);
        let mut scope = Scope::new();
        scope.define("t", Expr::from(time.clone())).expect("a name");
        for text in &texts {
            let formula = parse(text).expect("short enough").check(&scope).expect("alike");
            let Value::Scalar(formula) = formula else { panic!("a number") };
            let derived = formula.clone() * 2;
            let layout = Layout::new(vec![], time.clone(), vec![]);
            assert!(Tape::compile(&layout, &[formula, derived]).is_ok(), "{}", &text[..8]);
        }
    };
    let thread = std::thread::Builder::new().stack_size(STACK).spawn(compiled).expect("a thread");
    assert!(thread.join().is_ok());
}
