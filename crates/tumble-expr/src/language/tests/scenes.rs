//! The formulas of the scenes that the language is made for.

use super::super::{Function, Scope, parse};
use crate::Dimension;

/// Parameters in the order they depend on each other, then what is computed of them.
fn pendulum() -> Scope {
    let mut scope = Scope::new();
    let parameters = [
        ("m", "1 kg", Dimension::MASS),
        ("L", "1 m", Dimension::LENGTH),
        ("D", "0.02 kg/m", Dimension::new(-1, 1, 0)),
        ("w1", "20 m/s", Dimension::SPEED),
        ("T", "1 s", Dimension::TIME),
        ("g", "9.81 m/s^2", Dimension::ACCELERATION),
        ("half", "-L/2", Dimension::LENGTH),
        ("t", "0 s", Dimension::TIME),
    ];
    for (name, text, dimension) in parameters {
        let value = parse(text).expect(text).check_number(&scope, dimension).expect(text);
        scope.define(name, value).expect(name);
    }
    let wind = Function::parse("w(t)", "0.5*w1*(1 + cos(2*pi*t/T))").expect("parses");
    scope.define_function(wind).expect("w");
    scope
}

#[test]
fn a_scene_with_parameters_named_like_units_works() {
    let scope = pendulum();
    let cases = [
        ("m*g*L/2", Dimension::TORQUE),
        ("D*w(t)*abs(w(t))", Dimension::FORCE),
        ("m*L^2/3", Dimension::INERTIA),
        ("sqrt(3*g/(2*L))", Dimension::ANGULAR_RATE),
        ("-L", Dimension::LENGTH),
        ("20 s", Dimension::TIME),
        ("t - 20 ms", Dimension::TIME),
    ];
    for (text, dimension) in cases {
        let outcome = parse(text).expect(text).check_number(&scope, dimension);
        assert!(outcome.is_ok(), "{text}: {outcome:?}");
    }
}

#[test]
fn slips_in_a_scene_are_not_taken_for_units() {
    let scope = pendulum();
    for (text, code) in [
        ("2 m g", "E0110"),
        ("2 m*g", "E0202"),
        ("2 m/L", "E0202"),
        ("L > 1 m", "E0202"),
        ("2 m*w1", "E0202"),
        ("0.5 L", "E0401"),
    ] {
        let formula = parse(text);
        let errors = match formula {
            Ok(formula) => formula.check_number(&scope, Dimension::LENGTH).map(|_| ()),
            Err(errors) => Err(errors),
        };
        let found = errors.map_err(|errors| errors[0].code.as_str());
        if code != "E0401" {
            assert_eq!(found, Err(code), "{text}");
        } else {
            // Half a litre where a length is asked for.
            assert_eq!(found, Err("E0404"), "{text}");
        }
    }
}
