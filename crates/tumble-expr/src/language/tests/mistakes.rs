//! Every mistake: its code, the words it underlines, and part of what it says.

use super::super::{FormulaError, Function, Scope, SpannedText, parse};
use super::{check, scope};

/// Codes with the underlined words, one line a mistake.
fn report(text: &str, errors: &[FormulaError]) -> Vec<String> {
    let underlined = |error: &FormulaError| {
        let words: Vec<_> = error.labels.iter().map(|(span, _)| &text[span.clone()]).collect();
        format!("{} {}", error.code, words.join(" | "))
    };
    errors.iter().map(underlined).collect()
}

/// (formula, code and underlined words, part of the message or help)
const SYNTAX: &[(&str, &str, &str)] = &[
    ("", "E0101 ", "no formula"),
    ("  ", "E0101   ", "no formula"),
    ("2 − 1", "E0104 −", "write `-`"),
    ("2×3", "E0104 ×", "write `*`"),
    ("2·3", "E0104 ·", "U+00B7, middle dot"),
    ("１２ + 1", "E0104 １２", "write `12`"),
    ("rаd + 1", "E0104 а", "write `rad`"),
    ("35°", "E0104 °", "write `deg`"),
    ("1 m²", "E0104 ²", "write `^2`"),
    ("1\u{a0}m", "E0104 \u{a0}", "an ordinary space"),
    ("a # b", "E0104 #", "`#` (U+0023)"),
    ("1.5.2 + 1", "E0105 1.5.2", "one decimal point"),
    ("floor.contact[-1].start", "E0105 [-1]", "`[last]`"),
    ("apex[n] + 1", "E0105 [n]", "`[1]`, `[2]`"),
    ("1e + 2", "E0105 1e", "exponent of this number is missing"),
    ("1_000", "E0105 1_000", "write `1000`"),
    ("1e400*V", "E0106 1e400", "too large"),
    ("1,5 m", "E0107 1,5", "write `1.5`"),
    ("-1,5 m/s + V", "E0107 1,5", "write `1.5`"),
    ("V + 2*1,5 m/s", "E0107 1,5", "write `1.5`"),
    ("−2", "E0104 −", "(U+2212, minus sign)"),
    ("V–2", "E0104 –", "(U+2013, en dash)"),
    ("m·L", "E0104 ·", "(U+00B7, middle dot)"),
    ("m⋅L", "E0104 ⋅", "(U+22C5, dot operator)"),
    ("m×L", "E0104 ×", "(U+00D7, multiplication sign)"),
    ("L²", "E0104 ²", "(U+00B2, superscript)"),
    ("3 s⁻¹", "E0104 ⁻¹", "write `^-1`"),
    ("L¹²", "E0104 ¹²", "write `^12`"),
    ("٣ + 1", "E0104 ٣", "write `3`"),
    ("𝟏𝟐 + 1", "E0104 𝟏𝟐", "write `12`"),
    ("𝑚*L", "E0104 𝑚", "write `m`"),
    ("V₀", "E0104 ₀", "write `0`"),
    ("½*V", "E0104 ½", "write `0.5`"),
    ("35º", "E0104 º", "write `deg`"),
    ("∞", "E0104 ∞", "finite numbers"),
    ("2，5", "E0104 ，", "write `,`"),
    ("（V）", "E0104 （ && E0104 ）", "write `(`"),
    ("1e999", "E0106 1e999", "too large"),
    ("1e-999", "E0106 1e-999", "too small"),
    ("1,5", "E0107 1,5", "write `1.5`"),
    ("2*(1,5 + V)", "E0107 1,5", "write `1.5`"),
    ("1,234.5 + V", "E0107 1,234", "`1234...`"),
    ("V1,5", "E0114 ,", "`f(a, b)`"),
    ("V*2−,5", "E0104 −", "write `-`"),
    ("2*(V", "E0108 (", "not closed"),
    ("2*V)", "E0108 )", "not opened"),
    ("sin(V]", "E0108 ] | (", "does not close"),
    ("2 +", "E0109  | +", "the formula ends"),
    ("* 2", "E0109 *", "a value is missing"),
    ("V + * 2", "E0109 * | +", "should follow this `+`"),
    ("2*()", "E0109 ) | (", "a value is missing"),
    ("max(1,, 2)", "E0109 , | ,", "a value is missing"),
    ("2 (V)", "E0110 ( | 2", "`2*(...`"),
    ("V R", "E0110 R | V", "`V*R`"),
    ("2 rod.angle", "E0110 rod.angle | 2", "`2*rod.angle`"),
    ("3 kg m", "E0110 m | 3 kg", "`3 kg*m`"),
    ("2 sin(1)", "E0110 sin | 2", "`2*sin`"),
    ("V**2", "E0111 **", "`a^b`"),
    ("V == 2", "E0111 ==", "compare with"),
    ("1 < V < 2", "E0112 1 < V", "if(a < b, if(b < c, x, y), y)"),
    ("2 cm ^2", "E0113 2 cm", "`(2 cm)^2`"),
    ("V, R", "E0114 ,", "`f(a, b)`"),
    ("[V]", "E0115 [V]", "2 or 3 components"),
    ("[]", "E0115 []", "not 0"),
    ("2 m^n", "E0203 ^n", "plain number"),
    ("2 m^-n*V", "E0203 ^-n", "plain number"),
    ("2 m^99", "E0203 ^99", "plain number"),
];

const MEANING: &[(&str, &str, &str)] = &[
    ("2 Kg", "E0201 Kg", "did you mean `kg`?"),
    ("2 sec", "E0201 sec", "did you mean `s`?"),
    ("2 m2", "E0201 m2", "did you mean `m^2`?"),
    ("2 zorkmid", "E0201 zorkmid", "not a unit"),
    ("2 м", "E0201 м", "`м` (U+043C, Cyrillic) is no Latin letter: did you mean `m`?"),
    ("2 сm", "E0201 сm", "`с` (U+0441, Cyrillic) is no Latin letter: did you mean `cm`?"),
    ("2 Ν", "E0201 Ν", "`Ν` (U+039D, Greek) is no Latin letter: did you mean `N`?"),
    ("1е5", "E0201 е5", "`е` (U+0435, Cyrillic) is no Latin letter: write `e5`"),
    ("2 kg/(m*L) + V", "E0202 m", "write `2 kg / (m*L)` for the names, `(2 kg/(m*L))` for the units"),
    ("2 kg/(m*L)", "E0202 m", "write `2 kg / (m*L)` for the names"),
    ("2 kg/(L)", "E0202 L", "write `2 kg / (L)` for the names"),
    ("V + 1 1/m", "E0202 m", "`(1 1/m)` for the unit"),
    ("2 kg/(s*x)", "E0301 s && E0301 x", "is a unit"),
    ("L + 2 m", "E0202 m", "write `2*m` for the name, `(2 m)` for the unit"),
    ("2 m/L", "E0202 m", "`(2 m/L)`"),
    ("2 m/R", "E0202 R", "write `2 m / R`"),
    ("2 V", "E0202 V", "write `2*V`"),
    ("1e300 km^3", "E0106 1e300 km^3", "too large"),
    ("gravty*2", "E0301 gravty", "did you mean `gravity`?"),
    ("9.81 kg / s", "E0301 s", "`s` is a unit (second, SI)"),
    ("2*kg", "E0301 kg", "as in `2 kg`"),
    ("2*π", "E0301 π", "write `pi`"),
    ("2*Т", "E0301 Т", "`Т` (U+0422, Cyrillic) is no Latin letter: write `T` in Latin letters"),
    ("nan*V", "E0301 nan", "finite numbers"),
    ("-Infinity", "E0301 Infinity", "finite numbers"),
    ("si(2)", "E0302 si", "did you mean `sin`?"),
    ("ln(2)", "E0302 ln", "written `log` here"),
    ("w2(2)", "E0302 w2", "did you mean `w`?"),
    ("sin(1, 2)", "E0303 sin(1, 2)", "sin takes 1 argument, not 2"),
    ("sin(1,5)", "E0303 sin(1,5)", "a decimal point is written `1.5`"),
    ("atan2(1)", "E0303 atan2(1)", "write `atan2(y, x)`"),
    ("w()", "E0303 w()", "write `w(t)`"),
    ("min(2)", "E0303 min(2)", "2 arguments or more"),
    ("sin + 1", "E0307 sin", "write `sin(angle)`"),
    ("w*2", "E0307 w", "write `w(t)`"),
    ("V(2 + 1)", "E0307 V", "written `V*(2 + 1)`"),
    ("L + m", "E0401 L | m", "this adds a length (m) and a mass (kg)"),
    ("V - 2", "E0401 V | 2", "this subtracts a speed (m/s) and a pure number"),
    ("if(V < 2, 1, 2)", "E0401 V | 2", "compares"),
    ("if(1 < 2, V, L)", "E0401 1 < 2 | V | L", "chooses between"),
    ("max(V, L)", "E0401 V | L", "compares"),
    ("[V, L]", "E0401 V | L", "components of this vector are a speed"),
    ("[1,5 m, V]", "E0401 1 | 5 m | V", "a decimal point is written `1.5 m`"),
    ("max(1,5 m/s, V)", "E0401 1 | 5 m/s | V", "a decimal point is written `1.5 m/s`"),
    ("r + [1, 2]", "E0401 r | [1, 2]", "adds a length"),
    ("sin(L)", "E0402 L", "sin takes a pure number"),
    ("2^L", "E0402 2 | L", "an exponent"),
    ("L^V", "E0402 L | V", "an exponent"),
    ("L^rod.angle", "E0403 L | rod.angle", "only be raised to a plain number"),
    ("(1 < 2) + 1", "E0405 (1 < 2) | 1", "not a number"),
    ("if(1, 2, 3)", "E0405 1 | 2 | 3", "expected a comparison"),
    ("r + 1", "E0406 r | 1", "a vector and a number"),
    ("r*r", "E0406 r | r", "`dot(a, b)`"),
    ("1/r", "E0406 1 | r", "divided by a vector"),
    ("r^2", "E0406 r | 2", "dot(a, a)"),
    ("r < r", "E0406 r | r", "cannot be compared"),
    ("abs(r)", "E0406 r", "norm(a)"),
    ("norm(L)", "E0406 L", "abs(a)"),
    ("[r, r]", "E0406 r | r", "a component takes a number"),
    ("r + [L, L, L]", "E0407 r | [L, L, L]", "2 components and one of 3"),
    ("dot(r, [1, 2, 3])", "E0407 r | [1, 2, 3]", "2 components and one of 3"),
    ("cross(r, [1, 2, 3])", "E0407 r | [1, 2, 3]", "2 components and one of 3"),
    ("V/0", "E0408 V | 0", "divides by zero"),
    ("L^1000000000^3", "E0403 L | 1000000000^3", "plain number"),
    ("L^2000000000*L^2000000000", "E0409 L^2000000000 | L^2000000000", "out of range"),
];

fn expect(text: &str, errors: &[FormulaError], underlined: &str, says: &str) {
    assert_eq!(report(text, errors).join(" && "), underlined, "{text}: {errors:#?}");
    let said = format!("{}; {}", errors[0].message, errors[0].help.as_deref().unwrap_or_default());
    let labels: Vec<_> = errors[0].labels.iter().map(|(_, label)| label.as_str()).collect();
    assert!(said.contains(says) || labels.concat().contains(says), "{text}: {said}; {labels:?}");
}

#[test]
fn mistakes_of_syntax() {
    for (text, underlined, says) in SYNTAX {
        let errors = parse(text).expect_err(text);
        expect(text, &errors, underlined, says);
    }
}

#[test]
fn mistakes_of_meaning() {
    for (text, underlined, says) in MEANING {
        let errors = check(text).expect_err(text);
        expect(text, &errors, underlined, says);
    }
}

#[test]
fn operands_are_labelled_by_what_they_are() {
    let errors = check("2*L + m*V").expect_err("unlike");
    let labels: Vec<_> = errors[0].labels.iter().map(|(_, label)| label.as_str()).collect();
    assert_eq!(labels, ["a length (m)", "a momentum (kg*m/s)"]);
}

#[test]
fn independent_mistakes_are_all_reported() {
    let text = "sin(L) + (V + m)*foo + 1 zorkmid";
    let errors = check(text).expect_err("wrong");
    assert_eq!(report(text, &errors), ["E0402 L", "E0401 V | m", "E0301 foo", "E0201 zorkmid"]);
    let text = "1e999 + 1.2.3*(V R";
    let errors = parse(text).expect_err("wrong");
    assert_eq!(report(text, &errors), ["E0106 1e999", "E0105 1.2.3", "E0108 (", "E0110 R | V"]);
}

#[test]
fn a_mistake_in_a_body_points_at_the_body_and_the_call() {
    let errors = check("1 + w(L)/V").expect_err("a length is no time");
    let [error] = &errors[..] else { panic!("{errors:?}") };
    assert_eq!(error.place, SpannedText::Body("w".into()));
    let body = "0.5*w1*(1 + cos(2*pi*t/T))";
    assert_eq!(report(body, &errors), ["E0402 2*pi*t/T"]);
    assert_eq!((error.calls[0].place.clone(), error.calls[0].span.clone()), (SpannedText::Formula, 4..8));
    assert_eq!(error.calls[0].note, "called here with t = a length (m)");
}

fn with_functions(functions: &[(&str, &str)]) -> Scope {
    let mut scope = scope();
    for (header, body) in functions {
        let function = Function::parse(header, body).expect("parses");
        scope.define_function(function).expect("name is fit");
    }
    scope
}

#[test]
fn functions_that_do_not_end_are_refused() {
    let scope = with_functions(&[("f(x)", "g(x) + 1"), ("g(x)", "2*f(x)")]);
    let errors = parse("f(1)").expect("parses").check(&scope).expect_err("recursive");
    assert_eq!(report("2*f(x)", &errors), ["E0304 f(x)"]);
    assert_eq!(errors[0].calls.len(), 2);
    assert_eq!(errors[0].calls[1].place, SpannedText::Formula);
}

fn chain_of_functions(count: usize, body: impl Fn(usize) -> String) -> Scope {
    let names: Vec<_> = (0..count).map(|i| (format!("f{i}(x)"), body(i + 1))).collect();
    let mut functions: Vec<_> = names.iter().map(|(h, b)| (h.as_str(), b.as_str())).collect();
    let last = format!("f{count}(x)");
    functions.push((&last, "x"));
    with_functions(&functions)
}

#[test]
fn calls_that_grow_without_bound_are_refused() {
    let doubling = chain_of_functions(40, |next| format!("f{next}(2*x) + f{next}(3*x)"));
    let errors = parse("f0(1)").expect("parses").check(&doubling).expect_err("too large");
    assert_eq!(report("f0(1)", &errors), ["E0306 f0(1)"]);
    let deep = chain_of_functions(5000, |next| format!("f{next}(x)"));
    let errors = parse("f0(1)").expect("parses").check(&deep).expect_err("too deep");
    assert_eq!(errors[0].code.as_str(), "E0305");
}

#[test]
fn equal_calls_are_written_out_once() {
    let shared = chain_of_functions(40, |next| format!("f{next}(x) + f{next}(x)"));
    assert!(parse("f0(1)").expect("parses").check(&shared).is_ok());
    let wrong = with_functions(&[("f(x)", "x + foo")]);
    let errors = parse("f(1) + f(2)").expect("parses").check(&wrong).expect_err("unknown name");
    assert_eq!(errors.len(), 1, "said once: {errors:?}");
}
