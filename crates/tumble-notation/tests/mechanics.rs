//! The equations of motion of the first scenes, as mechanics builds them, and how they are shown.

mod common;

use common::{assert_same, force, g, length, mass, omega, pure, speed, t};
use tumble_expr::{Dimension, Expr, Symbol, Vector};
use tumble_notation::{Left, Math, Notation, Printed, integrate_twice, polynomial_in};

const POSITIVE: [&str; 5] = ["m", "M", "L", "R", "I"];

fn notation() -> Notation {
    Notation::new().positive(POSITIVE).name("rod.angle", "theta").name("rod.omega", "omega")
}

fn show(notation: &Notation, left: Left, right: &Expr) -> String {
    let shown = notation.equation(left.clone(), right).expect("short");
    let given = left.factor.map_or_else(|| right.clone(), |factor| factor * right);
    assert_same(&given, &shown.lines[0].formula, &POSITIVE);
    read_back(notation, &shown);
    shown.text()
}

/// The printed text has the value of the formula.
fn read_back(_: &Notation, shown: &Printed) {
    common::reader::assert_reads_as(shown, &POSITIVE, &|name| match name {
        "rod.angle" => "θ".to_owned(),
        "rod.omega" => "ω".to_owned(),
        other => tumble_notation::text(&Math::symbol(other)),
    });
}

fn formula(right: &Expr) -> String {
    let shown = notation().formula(right).expect("short");
    assert_same(right, &shown.lines[0].formula, &POSITIVE);
    read_back(&notation(), &shown);
    shown.text()
}

fn rotated(v: &Vector, angle: &Expr) -> Vector {
    let (cos, sin) = (angle.cos(), angle.sin());
    Vector::planar(&cos * v.x() - &sin * v.y(), &sin * v.x() + &cos * v.y())
}

fn square(v: &Vector) -> Expr {
    v.x() * v.x() + v.y() * v.y()
}

/// A uniform rod of length L and mass m that hangs from its end, in mechanics' own steps.
struct Rod {
    theta: Expr,
    arm: Vector,
    tip: Vector,
    inertia: Expr,
}

fn rod() -> Rod {
    let (m, l, theta) = (mass("m"), length("L"), pure("rod.angle"));
    let zero = || 0 * tumble_expr::units::M;
    let (from, to) = (Vector::planar(zero(), zero()), Vector::planar(zero(), -&l));
    let centre = (&from + &to).map(|sum| sum / 2);
    let span = &to - &from;
    let gyration = square(&span) / 12;
    let about = &m * gyration + &m * square(&(&centre - &Vector::planar(Expr::zero(), Expr::zero())));
    let tip = rotated(&(&to - &centre), &theta);
    Rod { arm: rotated(&(&centre - &from), &theta), tip, inertia: about, theta }
}

/// Angular acceleration of the rod under its weight and, with a wind w along x, resistance at its tip.
fn pendulum(component: impl Fn(&Vector, &Rod) -> Vector) -> (Expr, Expr) {
    let rod = rod();
    let weight = &mass("m") * &Vector::planar(0 * g(), -g());
    let from_pivot = &rod.arm + &rod.tip;
    let velocity = omega() * &(&rod.arm.perpendicular() + &rod.tip.perpendicular());
    let u = Vector::planar(speed("w"), 0 * speed("w")) - velocity;
    let drag = component(&u, &rod);
    let torque = Expr::zero() + rod.arm.cross_planar(&weight) + from_pivot.cross_planar(&drag);
    (torque / &rod.inertia, rod.inertia)
}

fn drag_coefficient() -> Expr {
    Expr::symbol("D", Dimension::new(-1, 1, 0))
}

fn theta2() -> Left {
    Left::symbol(Math::derivative("theta", 2))
}

fn shell() -> (Expr, Expr) {
    let (m, r) = (mass("M"), length("R"));
    (m.clone(), &m * (Expr::from(2) / 3 * (&r * &r)))
}

#[test]
fn kicked_ball() {
    let (m, inertia) = shell();
    let kick = Vector::planar(force("F"), 0 * force("F"));
    let arm = Vector::planar(-length("x"), length("y"));
    let ax = (Expr::zero() + kick.x()) / &m;
    let alpha = (Expr::zero() + arm.cross_planar(&kick)) / &inertia;
    assert_eq!(show(&notation(), Left::times(&m, Math::symbol("A_x")), &ax), "M A_x = F");
    assert_eq!(show(&notation(), Left::symbol(Math::symbol("A_x")), &ax), "A_x = F/M");
    let named = notation().define("I", &inertia);
    let left = || Left::times(&inertia, Math::symbol("alpha"));
    assert_eq!(show(&named, left(), &alpha), "I α = −y F\nwhere I = (2/3) M R²");
    assert_eq!(show(&notation(), left(), &alpha), "(2/3) M R² α = −y F");
    let bare = Left::symbol(Math::symbol("alpha"));
    assert_eq!(show(&named, bare, &alpha), "α = −y F/I\nwhere I = (2/3) M R²");
}

#[test]
fn pendulum_without_air() {
    let (alpha, _) = pendulum(|_, _| Vector::planar(Expr::zero(), Expr::zero()));
    assert_eq!(show(&notation(), theta2(), &alpha), "θ″ = −(3 g/(2 L)) sin θ");
}

#[test]
fn pendulum_with_resistance_at_its_tip() {
    let d = drag_coefficient();
    let (alpha, inertia) = pendulum(|u, _| (&d * u.norm()) * u);
    assert_eq!(
        show(&notation(), theta2(), &alpha),
        "θ″ = (3 D/(m L)) √((w − L ω cos θ)² + L² ω² sin² θ) (w cos θ − L ω) − (3 g/(2 L)) sin θ"
    );
    let left = Left::times(&inertia, Math::derivative("theta", 2));
    assert_eq!(
        show(&notation(), left, &alpha),
        "(m L²/3) θ″ = D L √((w − L ω cos θ)² + L² ω² sin² θ) (w cos θ − L ω) − (m g L/2) sin θ"
    );
}

#[test]
fn pendulum_with_normal_resistance() {
    let d = drag_coefficient();
    let rod = rod();
    let normal = Vector::planar(rod.theta.cos(), rod.theta.sin());
    let along = |u: &Vector, _: &Rod| {
        let un = u.x() * normal.x() + u.y() * normal.y();
        (&d * un.abs() * &un) * &normal
    };
    let (alpha, inertia) = pendulum(along);
    let u = speed("w") * rod.theta.cos() - length("L") * omega();
    let named = notation().define("u", &u);
    assert_eq!(
        show(&named, theta2(), &alpha),
        "θ″ = (3 D/(m L)) |u| u − (3 g/(2 L)) sin θ\nwhere u = w cos θ − L ω"
    );
    let left = Left::times(&inertia, Math::derivative("theta", 2));
    assert_eq!(
        show(&named, left, &alpha),
        "(m L²/3) θ″ = D L |u| u − (m g L/2) sin θ\nwhere u = w cos θ − L ω"
    );
}

#[test]
fn sums_that_vanish_and_inertias_that_join() {
    let (m, l) = (mass("m"), length("L"));
    assert_eq!(formula(&(&m * g() - &m * g())), "0");
    assert_eq!(formula(&(-(&m * g()) / &m)), "−g");
    assert_eq!(formula(&(&m * l.powi(2) / 12 + &m * (&l / 2).powi(2))), "m L²/3");
    assert_eq!(formula(&(&m * g() * &l / 2)), "m g L/2");
    assert_eq!(formula(&(&l * (&m + mass("M")) - &l * &m)), "M L");
}

#[test]
fn a_free_fall_is_ordered_by_powers_of_time() {
    let (x, v) = (length("X_0"), speed("V"));
    let fall = -(g() * t() * t() / 2) + &x + &v * t();
    assert_eq!(formula(&fall), "X₀ + V t − g t²/2");
}

#[test]
fn written_quantities_keep_their_units() {
    let fall = 9.81 * tumble_expr::units::M / tumble_expr::units::S / tumble_expr::units::S;
    let theta = pure("rod.angle");
    assert_eq!(formula(&(-(&fall * theta.sin()))), "−(9.81 m/s²) sin θ");
    assert_eq!(formula(&(length("L") + 2 * tumble_expr::units::M)), "L + 2 m");
}

#[test]
fn kicked_ball_in_closed_form() {
    let (m, inertia) = shell();
    let (time, s) = (Symbol::new("t", Dimension::TIME), Symbol::new("t", Dimension::TIME));
    let start = Expr::zero();
    let rest = (&Expr::zero(), &Expr::zero());
    let named = notation().define("I", &inertia);
    let arm = Vector::planar(-length("x"), length("y"));
    let kick = Vector::planar(force("F"), 0 * force("F"));
    let ax = kick.x() / &m;
    let alpha = arm.cross_planar(&kick) / &inertia;
    let along = integrate_twice(&ax, (&time, &start), &s, rest).expect("a constant");
    assert_eq!(show(&named, Left::symbol(Math::symbol("X")), &along.position), "X = F t²/(2 M)");
    let turned = integrate_twice(&alpha, (&time, &start), &s, rest).expect("a constant");
    assert_eq!(
        show(&named, Left::symbol(Math::symbol("theta")), &turned.position),
        "θ = −y F t²/(2 I)\nwhere I = (2/3) M R²"
    );
    let mut end = tumble_expr::Substitution::default();
    end.insert(time, Expr::symbol("dt", Dimension::TIME));
    let (velocity, spin) = (end.apply(&along.velocity), end.apply(&turned.velocity));
    assert_eq!(show(&named, Left::symbol(Math::symbol("V")), &velocity), "V = F dt/M");
    assert_eq!(
        show(&named, Left::symbol(Math::symbol("omega")), &spin),
        "ω = −y F dt/I\nwhere I = (2/3) M R²"
    );
}

#[test]
fn a_later_phase_counts_its_own_time() {
    let (time, s) = (Symbol::new("T", Dimension::TIME), Symbol::new("t", Dimension::TIME));
    let start = Expr::symbol("t_1", Dimension::TIME);
    let jerk = Expr::symbol("j", Dimension::new(1, 0, -3));
    let acceleration = &jerk * (Expr::from(time.clone()) - &start) - g();
    let (x, v) = (length("x_1"), speed("v_1"));
    let motion = integrate_twice(&acceleration, (&time, &start), &s, (&x, &v)).expect("a polynomial");
    let notation = notation();
    let line = |formula: &Expr| notation.formula(formula).expect("short").text();
    assert_eq!(line(&motion.position), "x₁ + v₁ t − g t²/2 + j t³/6");
    assert_eq!(line(&motion.velocity), "v₁ − g t + j t²/2");
}

#[test]
fn polynomials_are_found_and_others_are_not() {
    let time = Symbol::new("t", Dimension::TIME);
    let v = speed("V");
    let cubed = (length("x") + &v * t()).powi(3);
    let coefficients = polynomial_in(&cubed, &time).expect("a cube");
    let texts: Vec<String> = coefficients.iter().map(formula).collect();
    assert_eq!(texts, ["x³", "3 x² V", "3 x V²", "V³"]);
    let cancelled = polynomial_in(&((&v * t() - &v * t()) / length("x") + 1 / t() * t()), &time);
    assert_eq!(cancelled.expect("the time cancels").len(), 1);
    assert!(polynomial_in(&(t() * tumble_expr::units::S).sqrt(), &time).is_none());
    assert!(polynomial_in(&(v.clone() / t()), &time).is_none());
    assert!(polynomial_in(&(&v * t()).powi(17), &time).is_none());
}
