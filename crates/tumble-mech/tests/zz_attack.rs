mod common;
use common::at;
use tumble_expr::{Expr, Vector, Exponent};
use tumble_expr::units::{KG, M, N, S};
use tumble_mech::*;
use tumble_ode::Accuracy;
use std::time::Instant as Clock;
fn rigid(e: f64) -> ContactLaw { ContactLaw::Rigid { restitution: Expr::from(e) } }
fn base(body: Body, p: [f64; 2], v: [f64; 2], a: f64, w: f64, g: f64) -> Model {
    let mut m = Model::new();
    m.gravity = Gravity::Vertical(g * M / (S * S));
    let s = Start::default().at([p[0] * M, p[1] * M]).velocity([v[0] * M / S, v[1] * M / S]).angle(Expr::from(a)).omega(w / S);
    m.starts.push((body.name.clone(), s));
    m.add(body);
    m
}
fn rod(l: f64) -> Body { Body::rod("b", [-0.5 * l * M, 0 * M], [0.5 * l * M, 0 * M]).mass(1 * KG) }
fn ball(r: f64) -> Body { Body::ball("b", r * M).mass(1 * KG) }
fn show(name: &str, m: Model, until: f64) {
    let began = Clock::now();
    match m.simulate_to(&[], until * S, Accuracy::new(1e-10).unwrap()) {
        Ok(run) => {
            let gaps: Vec<Expr> = run.equations.pairs().iter().filter(|p| p.is_rigid()).map(|p| p.gap()).collect();
            let mut least = f64::INFINITY;
            let mut when = 0.0;
            if !gaps.is_empty() {
            let o = run.observe(&gaps).unwrap();
            for k in 0..=2000 { let t = until * k as f64 / 2000.0;
                for g in o.at(t, tumble_ode::Side::After).unwrap() { if !(g >= least) { least = g; when = t; } } } }
            let b = run.equations.model().bodies[0].clone();
            let k = b.kinematics();
            let pivoted = !run.equations.model().pivots.is_empty();
            let end = at(&run, until, [k.position().x().clone(), k.position().y().clone(), k.velocity().x().clone(), k.velocity().y().clone(), k.angle(), k.omega()]);
            let es = |t| at(&run, t, [b.kinetic_energy() + b.potential_energy(&run.equations.model().gravity)])[0];
            let cs = run.contacts();
            println!("== {name}: contacts {} lasting {} cascades {} least gap {least:.3e} at {when} end {end:?} dE/E {:.2e} steps {} rej {} modes {} {:?} piv {pivoted}",
                cs.len(), cs.iter().filter(|c| !c.is_impact).count(), run.cascades(), es(until) / es(0.0) - 1.0, run.trajectory.work.steps, run.trajectory.work.rejected, run.trajectory.modes.len(), began.elapsed());
        }
        Err(RunError::Refused { refusal, partial }) => {
            let e = &partial.trajectory.events;
            println!("== {name}: REFUSED {refusal} after {} events, steps {} last {:?} {:?}", e.len(), partial.trajectory.work.steps, e.last().map(|e| (e.time, e.tags.clone())), began.elapsed());
        }
        Err(e) => println!("== {name}: ERR {e} {:?}", began.elapsed()),
    }
}
fn sl(name: &str, at: [f64; 2], a: f64, law: ContactLaw) -> Surface { Surface::sloping(name, [at[0] * M, at[1] * M], &Expr::from(a), law) }
#[test]
fn attack() {
    for l in [1e-9, 1e-3, 1e6] {
        for e in [0.0, 0.5, 1.0] {
            let mut m = base(rod(l), [0.0, l], [0.0, 0.0], 0.3, 0.0, 9.81);
            m.surface(Surface::floor("f", 0 * M, rigid(e)));
            show(&format!("rod size {l} e {e}"), m, 10.0 * (l / 9.81f64).sqrt());
        }
    }
    for e in [0.9, 0.99, 0.999999, 0.9999999999] {
        let mut m = base(ball(0.1), [0.0, 1.1], [1.0, 0.0], 0.0, 0.0, 9.81);
        m.surface(Surface::floor("f", 0 * M, rigid(e)));
        show(&format!("ball e {e}"), m, 100.0);
    }
    let mut m = base(ball(0.1), [0.0, 1.1], [1.0, -1.0], 0.0, 0.0, 0.0);
    m.surface(Surface::floor("f", 0 * M, rigid(0.5)));
    m.surface(Surface::new("c", [0 * M, 5 * M], [Expr::zero(), Expr::from(-2)], rigid(0.5)));
    show("zero gravity", m, 100.0);
    for vy in [-0.0, 1e-12, 1.0, -1e-12, -1e-300] {
        let mut m = base(ball(0.1), [0.0, 0.1], [1.0, vy], 0.0, 0.0, 9.81);
        m.surface(Surface::floor("f", 0 * M, rigid(0.5)));
        show(&format!("touching vy {vy:e}"), m, 3.0);
    }
    for a in [0.1, 0.3, -0.7, 1.2, 3.0] {
        for y in [1.0 / 3.0, 1e3 / 3.0] {
            let r = 0.1;
            let mut m = base(ball(r), [2.0 * f64::cos(a) - r * f64::sin(a), y + 2.0 * f64::sin(a) + r * f64::cos(a)], [0.0; 2], 0.0, 0.0, 9.81);
            m.surface(sl("s", [0.0, y], a, rigid(0.3)));
            show(&format!("slope {a} from y {y}"), m, 3.0);
        }
    }
    let mut m = base(Body::point("b").mass(1 * KG), [0.3, 1.0], [1.0, 0.0], 0.0, 0.0, 9.81);
    m.surface(Surface::floor("f", 0 * M, rigid(0.5)));
    show("point mass", m, 5.0);
    let mut r0 = rod(1.0); r0.stated = Some(MassProperties { mass: 1 * KG, centre: Vector::planar(0 * M, 0 * M), inertia: 0 * KG * M * M });
    let mut m = base(r0, [0.3, 1.0], [1.0, 0.0], 0.2, 1.0, 9.81);
    m.surface(Surface::floor("f", 0 * M, rigid(0.5)));
    show("rod without inertia", m, 2.0);
    // moving surface fast into resting body
    let mut m = base(ball(0.1), [0.5, 0.1], [0.0, 0.0], 0.0, 0.0, 9.81);
    m.surface(Surface::floor("f", 0 * M, rigid(0.0)));
    m.surface(Surface::new("w", [-1000 * M + 1000 * (M / S) * time(), 0 * M], [Expr::one(), Expr::zero()], rigid(0.5)));
    show("fast wall", m, 3.0);
    // plastic piston
    let mut m = base(rod(1.0), [0.6, 0.0], [0.0, 0.0], 0.0, 0.0, 9.81);
    m.surface(Surface::floor("f", 0 * M, rigid(0.0)));
    m.surface(Surface::new("w", [-0.5 * M + 1 * (M / S) * time(), 0 * M], [Expr::one(), Expr::zero()], rigid(0.0)));
    show("wall pushes lying rod", m, 3.0);
    // graze: rod spins and tip just touches
    for off in [0.0, 1e-15, 1e-12, -1e-15, -1e-12, 1e-9, -1e-9] {
        let mut m = base(rod(1.0), [0.0, 0.5 + off], [1.0, 0.0], 0.0, -3.0, 0.0);
        m.surface(Surface::floor("f", 0 * M, rigid(0.5)));
        show(&format!("graze {off:e}"), m, 5.0);
    }
    // ball into a corner
    for e in [0.0, 0.5, 1.0] {
        let mut m = base(ball(0.1), [1.0, 1.0], [-1.0, -1.0], 0.0, 0.0, 0.0);
        m.surface(Surface::floor("f", 0 * M, rigid(e)));
        m.surface(Surface::new("w", [0 * M, 0 * M], [Expr::one(), Expr::zero()], rigid(e)));
        show(&format!("ball into corner at once {e}"), m.clone(), 3.0);
        m.gravity = Gravity::Vertical(9.81 * M / (S * S));
        show(&format!("ball in corner gravity {e}"), m, 10.0);
        let mut m = base(ball(0.1), [0.1, 2.0], [0.0, 0.0], 0.0, 0.0, 9.81);
        m.surface(sl("l", [0.0, 0.0], -0.8, rigid(e)));
        m.surface(sl("r", [0.0, 0.0], 0.6, rigid(e)));
        show(&format!("ball falls in groove {e}"), m, 20.0);
        let bx = Body::of_shape("b", Shape::Box { centre: Vector::planar(0 * M, 0 * M), width: 0.4 * M, height: 0.2 * M }).mass(1 * KG);
        let mut m = base(bx.clone(), [0.0, 1.0], [0.0, 0.0], 0.0, 0.0, 9.81);
        m.surface(Surface::floor("f", 0 * M, rigid(e)));
        show(&format!("box falls flat {e}"), m, 10.0);
        let mut m = base(bx.clone(), [0.0, 1.0], [0.0, 0.0], 0.0, 0.0, 9.81);
        m.surface(Surface::floor("f", 0 * M, rigid(e)));
        m.simultaneous = Simultaneous::InTurn;
        show(&format!("box falls flat in turn {e}"), m, 10.0);
        let mut m = base(bx, [0.0, 1.0], [0.0, 0.0], 0.3, 0.0, 9.81);
        m.surface(sl("l", [0.0, 0.0], -0.8, rigid(e)));
        m.surface(sl("r", [0.0, 0.0], 0.6, rigid(e)));
        show(&format!("box falls in groove {e}"), m, 20.0);
    }
    // far pivot
    for h in [1e2, 1e4, 1e6] {
        for e in [0.0, 0.5] {
        let mut m = Model::new();
        m.gravity = Gravity::Vertical(9.81 * M / (S * S));
        let b = m.add(Body::rod("b", [0 * M, 0 * M], [1 * M, 0 * M]).mass(2 * KG));
        m.pivot_at("hinge", &b, [0 * M, 0 * M], [0 * M, (h + 0.5) * M]);
        m.surface(Surface::floor("f", h * M, rigid(e)));
        show(&format!("far pivot {h} e {e}"), m, 5.0);
        }
    }
}
fn spring(k: f64, c: f64, release: Release) -> ContactLaw { ContactLaw::Spring { stiffness: k * N / M, damping: c * N * S / M, release } }
#[test]
fn springs() {
    for (k, c) in [(1e12, 0.0), (1e4, 20.0), (1e4, 200.0), (1e4, 500.0), (1e2, 1e3)] {
        for release in [Release::AtZeroForce, Release::AtSurface] {
            let mut m = base(ball(0.1), [0.0, 1.1], [1.0, 0.0], 0.0, 0.0, 9.81);
            m.surface(Surface::floor("f", 0 * M, spring(k, c, release)));
            show(&format!("spring {k} {c} {release:?}"), m.clone(), 5.0);
            m.bodies[0] = rod(1.0);
            m.starts[0].1 = m.starts[0].1.clone().angle(Expr::from(0.4)).omega(1 / S);
            show(&format!("rod on spring {k} {c} {release:?}"), m, 5.0);
        }
    }
    let mut m = base(ball(0.1), [0.0, 1.1], [1.0, 0.0], 0.0, 0.0, 9.81);
    m.surface(Surface::floor("f", 0 * M, spring(1e4, 20.0, Release::AtZeroForce)));
    show("damped 1000 s", m, 1000.0);
    let root = (1 * M).powr(Exponent::new(3, 2));
    for d in [0.0, 0.5] {
        let h = ContactLaw::Hertz { stiffness: 1e6 * N / root.clone(), damping: d * S / M };
        let mut m = base(ball(0.1), [0.0, 1.1], [1.0, 0.0], 0.0, 0.0, 9.81);
        m.surface(Surface::floor("f", 0 * M, h.clone()));
        show(&format!("hertz {d} 20 s"), m.clone(), 20.0);
        let second = Body::ball("c", 0.1 * M).mass(1 * KG);
        m.starts.push(("c".into(), Start::default().at([3 * M, 1.1 * M])));
        m.add(second);
        show(&format!("two hertz at once {d}"), m, 2.0);
        let mut m = base(ball(0.1), [0.0, 0.1], [1.0, 0.0], 0.0, 0.0, 9.81);
        m.surface(Surface::floor("f", 0 * M, h.clone()));
        show(&format!("hertz from touch {d}"), m, 2.0);
    }
    for n in [10, 100, 1000] {
        let mut m = Model::new();
        m.gravity = Gravity::Vertical(9.81 * M / (S * S));
        for i in 0..n {
            let b = m.add(Body::ball(format!("b{i}"), 0.1 * M).mass(1 * KG));
            m.starts.push((b.name, Start::default().at([i as f64 * M, (0.3 + 0.7 * (i as f64 * 0.618).fract()) * M])));
        }
        m.surface(Surface::floor("f", 0 * M, rigid(0.8)));
        show(&format!("{n} balls"), m, 0.3);
    }
}
