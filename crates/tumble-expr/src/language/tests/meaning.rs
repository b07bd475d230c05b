//! What correct formulas mean.

use super::super::{Scope, StatedUnit, Value, parse};
use super::{check, evaluate, number};
use crate::{Dimension, Exponent, Kind};

fn close(text: &str, expected: f64) {
    let found = evaluate(&number(text));
    assert!((found - expected).abs() <= 1e-15 * expected.abs(), "{text}: {found} is not {expected}");
}

#[test]
fn operators_bind_as_in_mathematics() {
    let cases = [
        ("-2^2", -4.0),
        ("2^3^2", 512.0),
        ("2^-1", 0.5),
        ("2^-1^2", 0.5),
        ("2^-1*3", 1.5),
        ("1 - 2 - 3", -4.0),
        ("12/2/3", 2.0),
        ("2 + 3*4", 14.0),
        ("(2 + 3)*4", 20.0),
        ("2*-3 + 1", -5.0),
        ("--2", 2.0),
        ("+2 - +3", -1.0),
        ("-(2 + 1)^2", -9.0),
        ("if(1 < 2, 3, 4) + 1", 4.0),
        ("if(1 >= 2, 3, 4)", 4.0),
        ("if(2 <= 2, 3, 4) + if(3 > 2, 1, 0)", 4.0),
        ("1e-1", 0.1),
        ("((((2))))", 2.0),
    ];
    for (text, expected) in cases {
        close(text, expected);
    }
}

#[test]
fn functions_compute_what_they_are_named_for() {
    let cases = [
        ("atan2(1, -1)", 0.75 * std::f64::consts::PI),
        ("min(3, 1, 2) + max(3, 5)", 6.0),
        ("sqrt(9) + abs(-2) + sign(-4)", 4.0),
        ("pulse(2, 1, 3) + pulse(3, 1, 3) + step(0)", 2.0),
        ("exp(0) + log(1) + cosh(0) + tanh(0)", 2.0),
        ("dot([1, 2], [3, 4])", 11.0),
        ("cross([1, 2], [3, 4])", -2.0),
        ("norm([3, 4])", 5.0),
        ("dot(cross([1, 0, 0], [0, 1, 0]), [0, 0, 1])", 1.0),
        ("norm(2*[3, 4]/5 - [0, 1])", 1.341_640_786_499_874),
        ("norm(if(1 < 2, [3, 4], [0, 0]))", 5.0),
    ];
    for (text, expected) in cases {
        close(text, expected);
    }
}

#[test]
fn quantities_are_in_si_units() {
    let half = Dimension::LENGTH.power(Exponent::new(1, 2)).expect("small");
    let cases = [
        ("9.81 m/s^2", 9.81, Dimension::ACCELERATION),
        ("5m", 5.0, Dimension::LENGTH),
        ("0.02  kg/m", 0.02, Dimension::new(-1, 1, 0)),
        ("3 kg*m^2/s^2", 3.0, Dimension::TORQUE),
        ("36 km/h", 10.0, Dimension::SPEED),
        ("4 s^-1", 4.0, Dimension::ANGULAR_RATE),
        ("1 m^(1/2)", 1.0, half),
        ("1 cm^(1/2)", 0.1, half),
        ("1 km^0.5", 1000f64.sqrt(), half),
        ("20 ms", 0.02, Dimension::TIME),
        ("180 deg", std::f64::consts::PI, Dimension::NONE),
        ("60 rpm", 2.0 * std::f64::consts::PI, Dimension::ANGULAR_RATE),
        ("50%", 0.5, Dimension::NONE),
        ("-2 m", -2.0, Dimension::LENGTH),
        ("0 kg", 0.0, Dimension::MASS),
        ("2*(3 m) + (4 m)", 10.0, Dimension::LENGTH),
        ("3 cm / 2", 0.015, Dimension::LENGTH),
        ("3 km/2", 1500.0, Dimension::LENGTH),
        ("2 kg*sqrt(4)", 4.0, Dimension::MASS),
        ("(2 cm)^2", 4e-4, Dimension::new(2, 0, 0)),
        ("3 kg/(cm*s)", 300.0, Dimension::new(-1, 1, -1)),
        ("3 kg/(cm/s)*2", 600.0, Dimension::new(-1, 1, 1)),
        ("(3 kg/(m*L))", 3000.0, Dimension::new(-4, 1, 0)),
        ("20 1/min", 1.0 / 3.0, Dimension::ANGULAR_RATE),
        ("3 1/(m*s)", 3.0, Dimension::new(-1, 0, -1)),
        // Here m and L are names.
        ("6 kg / (m*L)", 1.5, Dimension::new(-1, 0, 0)),
        ("4 kg/(m*L)^2", 0.25, Dimension::new(-2, -1, 0)),
    ];
    for (text, expected, dimension) in cases {
        close(text, expected);
        assert_eq!(number(text).kind(), Ok(Kind::Quantity(dimension)), "{text}");
    }
}

#[test]
fn names_stand_for_what_the_scope_says() {
    let cases = [
        ("m*gravity*L*sin(rod.angle)", Dimension::TORQUE),
        ("w(t) - rod.tip.vx", Dimension::SPEED),
        ("w(t + 3 ms)", Dimension::SPEED),
        ("V/R", Dimension::ANGULAR_RATE),
        ("V*t + 0", Dimension::LENGTH),
        ("norm(r)^2 / dot(r, r)", Dimension::NONE),
    ];
    for (text, dimension) in cases {
        assert_eq!(number(text).dimension(), Ok(dimension), "{text}");
    }
    // Every symbol is 2, so that the cosine is that of a whole turn.
    close("w(t)", 2.0);
    close("w(0)", 2.0);
    close("w(T/2)", 0.0);
}

#[test]
fn a_unit_that_is_a_name_is_a_unit_where_it_stands_alone() {
    for text in [
        "1 m",
        "-1 m",
        "2 kg/m",
        "2 kg/(m*s)",
        "2 1/m",
        "[0, 2 kg/(m*s)]",
        "norm([0, 2 m])",
        "(2 m)*3",
        "L + (2 m)",
        "max(2 m, L)",
        "(2 m/L)",
    ] {
        assert!(check(text).is_ok(), "{text}");
    }
}

#[test]
fn vectors_have_arithmetic() {
    let Ok(Value::Vector(vector)) = check("V*[cos(rod.angle), 0.5] + r/t - [V, 0]") else {
        panic!("a vector")
    };
    assert_eq!(vector.components().len(), 2);
    assert_eq!(vector.y().dimension(), Ok(Dimension::SPEED));
    assert!(check("-[1 m, 2 m, 0]").is_ok());
}

#[test]
fn names_are_listed_in_order() {
    let formula = parse("a.b*sin(pi*t) + w(t)").expect("parses");
    let names: Vec<_> = formula.names().into_iter().map(|name| (name.name, name.span, name.called)).collect();
    assert_eq!(
        names,
        [("a.b", 0..3, false), ("t", 11..12, false), ("w", 16..17, true), ("t", 18..19, false)]
    );
}

#[test]
fn a_formula_tells_the_unit_it_states() {
    let cases = [
        ("0", StatedUnit::Zero),
        ("-0.0", StatedUnit::Zero),
        ("35", StatedUnit::Bare),
        ("1/2 + (3)", StatedUnit::Bare),
        ("-35 deg", StatedUnit::Angle),
        ("(20 rpm)", StatedUnit::Angle),
        ("2 rad/s^2", StatedUnit::Angle),
        ("2 Hz", StatedUnit::Frequency),
        ("2 s^-1", StatedUnit::Other),
        ("V/R", StatedUnit::Formula),
        ("pi/2", StatedUnit::Formula),
        ("2*35 deg", StatedUnit::Formula),
    ];
    for (text, expected) in cases {
        assert_eq!(parse(text).expect(text).stated_unit(), expected, "{text}");
    }
    let help = |text| parse(text).expect(text).demand_angle_unit().map_err(|error| error.help);
    assert_eq!(help("35 deg"), Ok(()));
    assert_eq!(
        help("35").expect_err("bare").expect("help"),
        "write `35 deg` or `35 rad`, per time `35 rad/s`"
    );
    assert!(help("2 Hz").expect_err("hertz").expect("help").contains("`2 rev/s`"));
    assert!(help("2 s^-1").is_err());
}

#[test]
fn a_place_asks_for_what_it_needs() {
    let scope = super::scope();
    let formula = |text| parse(text).expect(text);
    assert!(formula("V*t").check_number(&scope, Dimension::LENGTH).is_ok());
    assert!(formula("0").check_number(&scope, Dimension::LENGTH).is_ok());
    assert!(formula("[0, V]").check_vector(&scope, Dimension::SPEED).is_ok());
    assert!(formula("V < w1").check_condition(&scope).is_ok());
    let wrong = formula(" V*t ").check_number(&scope, Dimension::MASS).expect_err("a length");
    assert_eq!(wrong[0].labels[0].0, 1..4);
    assert_eq!(wrong[0].message, "expected a mass (kg), found a length (m)");
    assert!(formula("0 kg").check_number(&scope, Dimension::LENGTH).is_err(), "a stated zero has its unit");
    assert!(formula("[V, V]").check_number(&scope, Dimension::SPEED).is_err());
    assert!(formula("V").check_vector(&scope, Dimension::SPEED).is_err());
    assert!(formula("V").check_condition(&scope).is_err());
}

#[test]
fn every_printed_dimension_reads_back_as_itself() {
    let powers = [-24, -3, -1, 0, 1, 2, 24].map(Exponent::from_integer);
    let fractions = [(1, 2), (-1, 2), (3, 4), (-5, 3)].map(|(n, d)| Exponent::new(n, d));
    let powers = [&powers[..], &fractions].concat();
    let all = powers.iter().flat_map(|l| powers.iter().flat_map(|m| powers.iter().map(|t| (*l, *m, *t))));
    for (length, mass, time) in all {
        let dimension = Dimension { length, mass, time };
        // A pure number prints as 1, which is no unit.
        let text =
            if dimension == Dimension::NONE { dimension.to_string() } else { format!("1 {dimension}") };
        let formula = parse(&text).unwrap_or_else(|errors| panic!("{text}: {errors:?}"));
        let Ok(Value::Scalar(one)) = formula.check(&Scope::new()) else { panic!("{text}") };
        assert_eq!(one.dimension(), Ok(dimension), "{text}");
        assert_eq!(evaluate(&one), 1.0, "{text}");
    }
}
