//! Dry friction of contacts that last: stops, break-away, rolling, belts; against closed forms.

use crate::common;

use crate::common::{at, close, rigid, run};
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{Body, Change, Friction, Gravity, Happening, Model, Run, Shape, Start, Surface, time};
use tumble_ode::{AtZero, Hybrid};

const G: f64 = 9.81;

/// One body in gravity on a slope that rises to the right by `slope`, through the origin.
fn on_slope(body: Body, start: Start, slope: f64, restitution: f64, friction: Friction) -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    model.starts.push((body.name.clone(), start));
    model.add(body);
    let surface = Surface::sloping("floor", [0 * M, 0 * M], &Expr::from(slope), rigid(restitution));
    model.surface(surface.with_friction(friction));
    model
}

fn plate(width: f64, height: f64, mass: f64) -> Body {
    let centre = Vector::planar(0 * M, 0 * M);
    Body::of_shape("box", Shape::Box { centre, width: width * M, height: height * M }).mass(mass * KG)
}

/// A box that stands on the slope with its middle above the origin and moves up along it.
fn block(slope: f64, speed: f64, friction: Friction) -> Model {
    let (sin, cos) = slope.sin_cos();
    let start = Start::default().at([-0.1 * sin * M, 0.1 * cos * M]).angle(Expr::from(slope));
    let start = start.velocity([speed * cos * M / S, speed * sin * M / S]);
    on_slope(plate(0.4, 0.2, 2.0), start, slope, 0.0, friction)
}

/// x, y, vx, vy, angle, omega of the first body.
fn state(run: &Run, time: f64) -> [f64; 6] {
    let body = run.equations.model().bodies[0].kinematics();
    let (c, v) = (body.position(), body.velocity());
    at(run, time, [c.x().clone(), c.y().clone(), v.x().clone(), v.y().clone(), body.angle(), body.omega()])
}

/// Along the slope from where a body on it began.
fn along(run: &Run, slope: f64, time: f64) -> [f64; 2] {
    let ([x0, y0, ..], [x, y, vx, vy, ..]) = (state(run, 0.0), state(run, time));
    let (sin, cos) = slope.sin_cos();
    [cos * (x - x0) + sin * (y - y0), cos * vx + sin * vy]
}

/// Times of a change of any contact.
fn times(run: &Run, change: Change) -> Vec<f64> {
    let is_it =
        |happening: &Happening| matches!(happening, Happening::Contact { change: own, .. } if *own == change);
    run.events().filter(|event| event.record.happened.iter().any(is_it)).map(|event| event.time).collect()
}

/// Normal and friction force of all contacts together, N.
fn forces(run: &Run, time: f64) -> [f64; 2] {
    let pairs = run.equations.pairs();
    let sum =
        |of: &dyn Fn(&tumble_mech::Pair) -> Expr| pairs.iter().map(of).reduce(|a, b| a + b).expect("pairs");
    at(run, time, [sum(&|pair| pair.force_symbol().into()), sum(&|pair| pair.friction_symbol().into())])
}

/// `t = v/(mu g)` and `x = v^2/(2 mu g)`, and from there on nothing moves at all.
#[test]
fn a_block_stops() {
    let (mu, speed) = (0.3, 3.0);
    let run = run(block(0.0, speed, Friction::new(Expr::from(mu))), 10.0, 1e-13);
    let (stop, way) = (speed / (mu * G), speed * speed / (2.0 * mu * G));
    assert_eq!(times(&run, Change::Slides), [0.0]);
    let sticks = times(&run, Change::Sticks);
    assert_eq!(sticks.len(), 1);
    close(sticks[0], stop, 1e-14);
    close(state(&run, 0.5)[2], speed - mu * G * 0.5, 1e-14);
    close(forces(&run, 0.5)[1], -mu * 2.0 * G, 1e-12);
    let still = state(&run, 5.0);
    close(still[0], way, 1e-14);
    assert_eq!(still[2..4], [0.0, 0.0]);
    assert_eq!(still, state(&run, 10.0));
    assert_eq!(forces(&run, 5.0)[1], 0.0);
}

/// Up a slope that is too steep to hold it: it turns round and comes down, friction always against it.
#[test]
fn a_block_turns_round_on_a_steep_slope() {
    let (slope, mu, speed) = (0.6_f64, 0.25, 4.0);
    let run = run(block(slope, speed, Friction::new(Expr::from(mu))), 3.0, 1e-13);
    let (up, down) = (G * (slope.sin() + mu * slope.cos()), G * (slope.sin() - mu * slope.cos()));
    let turns = times(&run, Change::Slides);
    assert_eq!(turns.len(), 2);
    close(turns[1], speed / up, 1e-14);
    let [x, v] = along(&run, slope, 3.0);
    let fallen = 3.0 - speed / up;
    close(v, -down * fallen, 1e-13);
    close(x, speed * speed / (2.0 * up) - 0.5 * down * fallen * fallen, 1e-13);
    assert!(times(&run, Change::Sticks).is_empty());
}

/// Up a slope that holds it: there it stays, with friction `m g sin`, and does not creep by the least.
#[test]
fn a_block_stays_on_a_slope_that_holds_it() {
    let (slope, mu, speed) = (0.3_f64, 0.4, 4.0);
    let run = run(block(slope, speed, Friction::new(Expr::from(mu))), 1000.0, 1e-13);
    let up = G * (slope.sin() + mu * slope.cos());
    close(times(&run, Change::Sticks)[0], speed / up, 1e-14);
    close(along(&run, slope, 900.0)[0], speed * speed / (2.0 * up), 1e-14);
    assert_eq!(state(&run, 2.0), state(&run, 1000.0));
    close(forces(&run, 7.0)[0], 2.0 * G * slope.cos(), 1e-13);
    close(forces(&run, 7.0)[1], 2.0 * G * slope.sin(), 1e-13);
    assert!(run.trajectory().events.len() <= 3, "{}", run.trajectory().events.len());
}

/// On both sides of `tan = mu` by a millionth.
#[test]
fn the_angle_of_repose() {
    for mu in [0.1_f64, 0.5, 1.7] {
        for off in [-1e-6, 1e-6] {
            let slope = mu.atan() * (1.0 + off);
            let run = run(block(slope, 0.0, Friction::new(Expr::from(mu))), 10.0, 1e-13);
            let [x, _] = along(&run, slope, 10.0);
            let acceleration = G * (slope.sin() - mu * slope.cos());
            match off < 0.0 {
                true => assert_eq!(x, 0.0),
                false => close(x, -50.0 * acceleration, 1e-13),
            }
        }
    }
}

/// A force that grows evenly: it holds until `k t = mu_s m g`, then `m v' = k t - mu_k m g`; with one coefficient it begins to slip
/// without a jump of its acceleration.
#[test]
fn a_block_breaks_away() {
    for (of_rest, kinetic) in [(0.5, 0.5), (0.5, 0.3)] {
        let friction = Friction::new(Expr::from(of_rest)).kinetic(Expr::from(kinetic));
        let mut model = block(0.0, 0.0, friction);
        let (rope, force) = (1.5, Vector::planar(1.5 * N / S * time(), 0 * N));
        let centre = model.bodies[0].cm();
        model.force("rope", &centre, force);
        let run = run(model, 10.0, 1e-13);
        let breaks = of_rest * 2.0 * G / rope;
        let slides = times(&run, Change::Slides);
        assert_eq!(slides.len(), 1);
        close(slides[0], breaks, 1e-14);
        assert_eq!(state(&run, breaks * 0.99)[2], 0.0);
        let speed =
            |t: f64| (0.5 * rope * (t * t - breaks * breaks) - kinetic * 2.0 * G * (t - breaks)) / 2.0;
        close(state(&run, 10.0)[2], speed(10.0), 1e-13);
        close(forces(&run, 0.5 * breaks)[1], -rope * 0.5 * breaks, 1e-13);
    }
}

/// Hoop, disk and ball, with moments of inertia `c m r^2`.
fn round() -> [(Shape, f64); 3] {
    let (centre, radius) = (Vector::planar(0 * M, 0 * M), 0.2 * M);
    [
        (Shape::Ring { centre: centre.clone(), radius: radius.clone() }, 1.0),
        (Shape::Disk { centre: centre.clone(), radius: radius.clone() }, 0.5),
        (Shape::Ball { centre, radius }, 0.4),
    ]
}

/// Pushed forward with backspin: it slips for `s/(mu g (1 + 1/c))`, s the slip at first, and then rolls with `v - s c/(1 + c)`, which
/// is back where it came from if the spin was enough.
#[test]
fn backspin_returns() {
    for (shape, c) in round() {
        for spin in [0.0, 12.0, 60.0] {
            let (mu, speed, radius) = (0.2, 2.0, 0.2);
            let body = Body::of_shape("ball", shape.clone()).mass(3 * KG);
            let start = Start::default().at([0 * M, radius * M]).velocity([speed * M / S, 0 * M / S]);
            let model = on_slope(body, start.omega(spin / S), 0.0, 0.0, Friction::new(Expr::from(mu)));
            let run = run(model, 20.0, 1e-13);
            let slip = speed + spin * radius;
            let (when, rolls) = (slip / (mu * G * (1.0 + 1.0 / c)), speed - slip * c / (1.0 + c));
            let found = times(&run, Change::Rolls);
            assert_eq!(found.len(), 1);
            close(found[0], when, 1e-14);
            let [x, y, vx, vy, _, omega] = state(&run, 20.0);
            close(vx, rolls, 1e-14);
            close(omega, -rolls / radius, 1e-14);
            close(x, speed * when - 0.5 * mu * G * when * when + rolls * (20.0 - when), 1e-13);
            close(y, radius, 1e-15);
            close(vy, 0.0, 1e-15);
            assert_eq!(rolls < 0.0, spin > speed / (c * radius));
            assert!(forces(&run, 19.0)[1].abs() < 1e-14);
        }
    }
}

/// Down a slope: it rolls with `g sin / (1 + c)` if `mu >= tan c/(1 + c)`, else it slips; a millionth on both sides.
#[test]
fn thresholds_of_rolling() {
    let slope = 0.7_f64;
    for (shape, c) in round() {
        let least = slope.tan() * c / (1.0 + c);
        for off in [-1e-6, 1e-6] {
            let mu = least * (1.0 + off);
            let body = Body::of_shape("ball", shape.clone()).mass(3 * KG);
            let (sin, cos) = slope.sin_cos();
            let start = Start::default().at([-0.2 * sin * M, 0.2 * cos * M]);
            let model = on_slope(body, start, slope, 0.0, Friction::new(Expr::from(mu)));
            let run = run(model, 4.0, 1e-13);
            let rolls = off > 0.0;
            assert_eq!(times(&run, Change::Rolls).len(), usize::from(rolls));
            assert_eq!(times(&run, Change::Slides).len(), usize::from(!rolls));
            let acceleration = if rolls { G * sin / (1.0 + c) } else { G * (sin - mu * cos) };
            let [_, v] = along(&run, slope, 4.0);
            close(v, -4.0 * acceleration, 1e-13);
            let turns = if rolls { 4.0 * acceleration / 0.2 } else { 4.0 * mu * G * cos / (c * 0.2) };
            close(state(&run, 4.0)[5], turns, 1e-13);
        }
    }
}

/// A block that is put on a moving belt is carried along: after `u/(mu g)` it goes with the belt, without slip from there on.
#[test]
fn a_belt_takes_a_block_along() {
    let (mu, belt) = (0.4, 1.5);
    let mut model = block(0.0, 0.0, Friction::new(Expr::from(mu)));
    model.surfaces[0].through = Vector::planar(belt * M / S * time(), 0 * M);
    let run = run(model, 5.0, 1e-13);
    let taken = belt / (mu * G);
    close(times(&run, Change::Sticks)[0], taken, 1e-14);
    close(state(&run, 0.5 * taken)[2], 0.5 * belt, 1e-14);
    let [x, _, vx, ..] = state(&run, 5.0);
    close(vx, belt, 1e-15);
    close(x, belt * (5.0 - 0.5 * taken), 1e-14);
    assert!(forces(&run, 4.0)[1].abs() < 1e-13);
}

/// On a shaken floor, `x = A sin(w t)`, it holds while `A w^2 |sin| <= mu g`: it breaks away where that ends.
#[test]
fn a_shaken_floor_breaks_away() {
    let (mu, amplitude, w) = (0.3, 0.05, 9.0);
    let mut model = block(0.0, 0.0, Friction::new(Expr::from(mu)));
    let path = amplitude * M * (1 - (w / S * time()).cos());
    model.surfaces[0].through = Vector::planar(path, 0 * M);
    let run = run(model, 3.0, 1e-12);
    // The floor accelerates by A w^2 cos(w t): it is too much at once.
    assert!(amplitude * w * w > mu * G);
    assert_eq!(times(&run, Change::Slides)[0], 0.0);
    close(state(&run, 0.01)[2], mu * G * 0.01, 1e-13);
    // It goes with the floor where their speeds meet, if the floor's acceleration is small then, and leaves it where that is mu g.
    let stick = times(&run, Change::Sticks)[0];
    close(state(&run, stick)[2], amplitude * w * (w * stick).sin(), 1e-11);
    let slide = times(&run, Change::Slides)[1];
    close((amplitude * w * w * (w * slide).cos()).abs(), mu * G, 1e-10);
}

/// A uniform rod of 1 m and 1 kg that leans: its lower end at the origin, at this angle to the floor.
fn leaning(angle: f64, friction: Friction) -> Model {
    let body = Body::rod("rod", [-0.5 * M, 0 * M], [0.5 * M, 0 * M]).mass(1 * KG);
    let start = Start::default().at([0.5 * angle.cos() * M, 0.5 * angle.sin() * M]).angle(Expr::from(angle));
    on_slope(body, start, 0.0, 0.0, friction)
}

/// A rod falls about its foot while that sticks. By its energy, with phi from upright,
/// `F = 3/4 m g sin (3 cos - 2 cos_0)` and `N = m g (1 - 3/4 sin^2 - 3/2 cos (cos_0 - cos))`: it slips where `|F| = mu N`, backward where
/// that comes early and forward where it comes late.
#[test]
fn a_falling_rod_slips_where_its_cone_ends() {
    for (mu, start, way) in [(0.2, 0.05_f64, -1.0), (0.8, 0.05, 1.0)] {
        let run =
            run(leaning(std::f64::consts::FRAC_PI_2 - start, Friction::new(Expr::from(mu))), 2.0, 1e-13);
        let slides = times(&run, Change::Slides)[0];
        let phi = std::f64::consts::FRAC_PI_2 - state(&run, slides)[4];
        let (sin, cos, first) = (phi.sin(), phi.cos(), start.cos());
        let along = 0.75 * G * sin * (3.0 * cos - 2.0 * first);
        let normal = G * (1.0 - 0.75 * sin * sin - 1.5 * cos * (first - cos));
        close(along.abs() / normal, mu, 1e-11);
        let omega = (3.0 * G * (first - cos)).sqrt();
        close(state(&run, slides)[5], -omega, 1e-12);
        let foot = run.equations.pairs()[0].slip_rate();
        assert!(at(&run, slides + 1e-3, [foot.clone()])[0] * way > 0.0);
        assert!(at(&run, 0.5 * slides, [foot])[0].abs() < 1e-14);
    }
}

/// A ladder between a floor and a wall, both rough: it stands while `tan >= (1 - mu^2)/(2 mu)`, though the forces of its feet are
/// undetermined then; a millionth on both sides.
#[test]
fn a_ladder_stands_or_slips() {
    for mu in [0.2_f64, 0.4, 0.7] {
        for off in [-1e-6, 1e-6] {
            let angle = ((1.0 - mu * mu) / (2.0 * mu) * (1.0 + off)).atan();
            let mut model = leaning(angle, Friction::new(Expr::from(mu)));
            let wall =
                Surface::new("wall", [angle.cos() * M, 0 * M], [Expr::from(-1), Expr::zero()], rigid(0.0));
            model.surface(wall.with_friction(Friction::new(Expr::from(mu))));
            let run = run(model, 0.5, 1e-12);
            let turned = state(&run, 0.5)[4] - angle;
            match off > 0.0 {
                true => assert_eq!(turned, 0.0, "mu {mu}"),
                false => assert!(turned < -1e-8, "mu {mu}: {turned}"),
            }
        }
    }
}

/// A ball that is thrown with spin bounces, by turns slipping and not, and comes to roll: at the same time as without friction, since
/// friction does not lift it, and with the speed that its angular momentum about a point of the floor leaves, `v - s c/(1 + c)`.
#[test]
fn a_thrown_ball_comes_to_roll() {
    let (radius, height, e, mu, speed, spin) = (0.2, 1.0_f64, 0.6, 0.15, 3.0, 20.0);
    for (shape, c) in round() {
        let body = Body::of_shape("ball", shape).mass(3 * KG);
        let start = Start::default().at([0 * M, (radius + height) * M]).velocity([speed * M / S, 0 * M / S]);
        let model = on_slope(body, start.omega(spin / S), 0.0, e, Friction::new(Expr::from(mu)));
        let run = run(model, 20.0, 1e-13);
        let rolls = speed - (speed + spin * radius) * c / (1.0 + c);
        let [_, y, vx, _, _, omega] = state(&run, 20.0);
        close(vx, rolls, 1e-12);
        close(omega, -rolls / radius, 1e-12);
        close(y, radius, 1e-14);
        let lands = (2.0 * height / G).sqrt() * (1.0 + e) / (1.0 - e);
        let lasting = run.contacts().into_iter().find(|contact| !contact.is_impact).expect("it stays down");
        close(lasting.start, lands, 1e-12);
        // The first bounce, by hand: it slips throughout.
        let fall = (2.0 * G * height).sqrt();
        let first = (2.0 * height / G).sqrt();
        close(state(&run, first + 0.01)[2], speed - mu * (1.0 + e) * fall, 1e-13);
        close(state(&run, first + 0.01)[5], spin - mu * (1.0 + e) * fall / (c * radius), 1e-12);
    }
}

/// A rod that is thrown onto a rough floor and comes to rest: no end goes into the floor, it never gains energy, what touches pushes
/// and keeps to its cone, and what slips is slowed down.
#[test]
fn a_thrown_rod_comes_to_rest() {
    for (mu, e) in [(0.1, 0.5), (0.3, 0.7), (0.6, 0.3)] {
        let mut model = common::bouncing_rod(rigid(e));
        model.surfaces[0].friction = Some(Friction::new(Expr::from(mu)));
        let run = run(model, 8.0, 1e-12);
        println!("mu {mu}: {} events", run.trajectory().events.len());
        let body = run.equations.model().bodies[0].clone();
        let energy = body.kinetic_energy() + body.potential_energy(&run.equations.model().gravity);
        let pairs = run.equations.pairs().to_vec();
        let mut before = f64::INFINITY;
        for step in 0..4000 {
            let t = 8.0 * f64::from(step) / 4000.0;
            let [now] = at(&run, t, [energy.clone()]);
            assert!(now <= before + 1e-12, "{now} after {before} at {t}");
            before = now;
            for pair in &pairs {
                let [gap, slip, normal, along] = at(
                    &run,
                    t,
                    [pair.gap(), pair.slip_rate(), pair.force_symbol().into(), pair.friction_symbol().into()],
                );
                assert!(gap >= -1e-12, "{gap} at {t}");
                assert!(normal >= -1e-10 && (gap.abs() < 1e-12 || normal == 0.0), "{normal} {gap} at {t}");
                assert!(
                    along.abs() <= mu * normal * (1.0 + 1e-9) + 1e-10 || normal == 0.0,
                    "{along} {normal}"
                );
                assert!(along * slip <= 1e-12, "{along} {slip} at {t}");
            }
        }
        assert!(
            at(&run, 8.0, [body.kinetic_energy()])[0] == 0.0,
            "{}",
            at(&run, 8.0, [body.kinetic_energy()])[0]
        );
    }
}

/// How two corners share the friction that holds a box on a slope is undetermined, and told so; what both have together is not.
#[test]
fn shares_of_friction_are_undetermined() {
    let run = run(block(0.3, 0.0, Friction::new(Expr::from(0.5))), 1.0, 1e-12);
    let pairs: Vec<_> = run.equations.pairs().iter().take(2).cloned().collect();
    let [first, second] = [0, 1].map(|corner| Expr::from(pairs[corner].friction_symbol()));
    let normal: Expr = pairs[0].force_symbol().into();
    let all = [first.clone(), second.clone(), first + second, normal];
    let spreads = run.spreads(&all, 0.5, tumble_ode::Side::After).expect("within the run");
    assert_eq!(spreads.iter().map(Option::is_some).collect::<Vec<_>>(), [true, true, false, false]);
}

/// What touches with friction has no one pose of equilibrium.
#[test]
fn there_is_no_one_equilibrium() {
    let model = block(0.0, 0.0, Friction::new(Expr::from(0.5)));
    let parameters = model.parameters.clone();
    let equations = tumble_mech::Equations::new(model).expect("a model");
    let told = equations.equilibrium(&parameters).map(|_| ()).expect_err("many poses");
    assert!(told.to_string().contains("touches with friction"), "{told}");
}

/// Coefficients that cannot be.
#[test]
fn coefficients_that_cannot_be_are_refused() {
    let refused = |friction: Friction| {
        let model = block(0.0, 0.0, friction);
        let mistakes = model.value_mistakes(&model.parameters);
        mistakes.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
    };
    assert!(
        refused(Friction::new(Expr::from(-0.1)))
            .contains("friction of `floor` is -0.1: it must not be negative")
    );
    let below = Friction::new(Expr::from(0.3)).kinetic(Expr::from(0.4));
    assert!(refused(below).contains("static friction of `floor` is less than the kinetic one"));
    assert_eq!(refused(Friction::new(Expr::from(0.4)).kinetic(Expr::from(0.3))), "");
}

/// Of what bounces until it slides the floor's impulses are `m g t` once it bounces no more, and friction's are mu of that: nothing is left out of the
/// bounces that are too low to be followed.
#[test]
fn friction_of_all_bounces_is_done_when_they_have_ended() {
    let (mu, speed) = (0.3, 3.0);
    for body in [Body::point("box").mass(2 * KG), plate(0.4, 0.2, 2.0)] {
        let start = Start::default().at([0 * M, 0.2 * M]).velocity([speed * M / S, 0 * M / S]);
        let run = run(on_slope(body, start, 0.0, 0.5, Friction::new(Expr::from(mu))), 0.9, 1e-13);
        let ended = *times(&run, Change::Start).first().expect("it comes to slide");
        for time in [ended, 0.5 * (ended + 0.9), 0.9] {
            close(state(&run, time)[2], speed - mu * G * time, 1e-14);
        }
    }
}

/// The integrator holds a slip to the side that its friction is for.
#[test]
fn a_slip_is_kept_to_its_side() {
    let run = run(block(0.0, 3.0, Friction::new(Expr::from(0.3))), 0.5, 1e-13);
    let slides = run.trajectory().modes.iter().filter(|mode| !mode.grips.is_empty());
    let guards = slides.flat_map(|mode| run.equations.flow(mode).expect("a flow").guards);
    let kept: Vec<bool> = guards
        .filter(|guard| guard.name.ends_with(".slip"))
        .map(|guard| matches!(guard.at_zero, AtZero::Keeps { .. }))
        .collect();
    assert!(!kept.is_empty() && kept.iter().all(|kept| *kept), "{kept:?}");
}
