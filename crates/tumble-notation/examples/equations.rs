//! A page of equations, to be looked at: `cargo run -p tumble-notation --example equations > equations.html`.

use tumble_expr::{Dimension, Expr, Relation};
use tumble_notation::{Left, Mark, Math, MathError, Notation, Shown, page_font};

fn symbol(name: &str, dimension: Dimension) -> Expr {
    Expr::symbol(name, dimension)
}

fn notation() -> Notation {
    Notation::new().positive(["m", "M", "L", "R"]).name("rod.angle", "theta").name("rod.omega", "omega")
}

fn left(name: &str) -> Left {
    Left::symbol(Math::symbol(name))
}

/// The equations of the page.
fn sheet() -> Result<Vec<Shown>, MathError> {
    let (m, l, g) =
        (symbol("m", Dimension::MASS), symbol("L", Dimension::LENGTH), symbol("g", Dimension::ACCELERATION));
    let (theta, omega) = (symbol("rod.angle", Dimension::NONE), symbol("rod.omega", Dimension::ANGULAR_RATE));
    let (w, d) = (symbol("w1", Dimension::SPEED), symbol("D", Dimension::new(-1, 1, 0)));
    let (x, y) = (symbol("x", Dimension::LENGTH), symbol("y", Dimension::LENGTH));
    let (f, t) = (symbol("F", Dimension::FORCE), symbol("t", Dimension::TIME));
    let (big, r) = (symbol("M", Dimension::MASS), symbol("R", Dimension::LENGTH));
    let un = &w * theta.cos() - &l * &omega;
    let components = vec![&w - &l * &omega * theta.cos(), -(&l * &omega * theta.sin())];
    let torque = &d * &l * un.abs() * &un - &m * &g * &l / 2 * theta.sin();
    let inertia = &m * &l * &l / 3;
    let shell = Expr::from(2) / 3 * &big * &r * &r;
    let alpha = -(&y * &f) / &shell;
    let second = |mark| Math::derivative("theta", 2, mark);
    let tip =
        Expr::norm(vec![symbol("rod.tip.vx", Dimension::SPEED), symbol("rod.tip.vy", Dimension::SPEED)]);
    let select = Expr::select(
        Expr::compare(Relation::Less, t.clone(), symbol("dt", Dimension::TIME)),
        f.clone(),
        Expr::zero(),
    );
    let period = Expr::pi() * 2 * (&l / &g).sqrt();
    let tall = ((&x.powi(2) + y.powi(2)) / (&x - &y)).abs() * (&x / &y + 1).powi(3);
    let named = notation().define("u", &un);
    let vector = notation().define("|u|", &Expr::norm(components.clone()));
    let kicked = notation().define("I", &shell);
    let system = Expr::solve(
        vec![vec![m.clone(), &m * theta.cos()], vec![&m * theta.cos(), big.clone()]],
        vec![f.clone(), &m * &g],
    );
    Ok(vec![
        notation().equation(Left::times(&big, Math::symbol("A_x")), &(&f / &big))?,
        kicked.equations(&[
            (Left::times(&shell, Math::symbol("alpha")), alpha.clone()),
            (left("theta"), &alpha * t.powi(2) / 2),
        ])?,
        named.equation(Left::symbol(second(Mark::Dots)), &(&torque / &inertia))?,
        named.equation(Left::symbol(second(Mark::Primes)), &(&torque / &inertia))?,
        notation().equation(Left::times(&inertia, second(Mark::Dots)), &(&torque / &inertia))?,
        vector.equation(left("tau"), &(&d * &l * Expr::norm(components) * &un))?,
        notation().equation(left("T"), &period)?,
        notation().equation(left("F_x"), &select)?,
        notation().equation(left("v_tip"), &tip)?,
        notation().equation(left("q"), &tall)?,
        notation().equation(
            left("x"),
            &(symbol("x_0", Dimension::LENGTH) + symbol("v_0", Dimension::SPEED) * &t - &g * t.powi(2) / 2),
        )?,
        notation().equation(
            left("w"),
            &(&w / 2 * (1 + (2 * Expr::pi() * &t / symbol("T", Dimension::TIME)).cos())),
        )?,
        notation().equation(left("y"), &(&x * (-(theta.sin().powi(2))).exp() / 981 * 100))?,
        notation().equation(
            Left::symbol(Math::derivative("rod.x", 1, Mark::Dots)),
            &(&omega * &l * theta.cos().powi(2)),
        )?,
        notation().equation(left("lambda_1"), &system[0])?,
        notation().equation(
            left("z"),
            &((&x * &x + 1.0 * tumble_expr::units::M * &y).sqrt()
                / (1 + (&x / (&y + &x / (1 + &theta))).sqrt())),
        )?,
    ])
}

fn main() -> Result<(), MathError> {
    println!("<!doctype html><meta charset=\"utf-8\"><title>Equations</title><style>{}", page_font());
    println!(
        "body {{ font: 18px/1.5 serif; margin: 2em; columns: 2; }} section {{ break-inside: avoid; border-bottom: 1px solid #ddd; }}</style>"
    );
    for shown in sheet()? {
        println!("<section>{}</section>", shown.mathml());
        eprintln!("{}\n{}", shown.text(), shown.latex());
    }
    let inline = tumble_notation::mathml(&Math::derivative("theta", 1, Mark::Dots));
    println!("<p>In a line of text, the rate {inline} stands between words.</p>");
    Ok(())
}
