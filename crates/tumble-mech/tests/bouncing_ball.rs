//! Balls on rigid floors, walls and slopes, at rest and moving: closed forms.

use crate::common::{at, close, run};
use tumble_expr::Expr;
use tumble_expr::units::{KG, M, S};
use tumble_mech::{Body, ContactLaw, Gravity, Model, Start, Surface, time};

fn rigid(e: f64) -> ContactLaw {
    ContactLaw::Rigid { restitution: Expr::from(e) }
}

/// A disk of 0.1 m in gravity 9.8 m/s^2 that starts at `height` above a floor at `floor`, m.
fn disk(height: f64, floor: f64, e: f64) -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.8 * M / (S * S));
    let ball = model.add(Body::ball("ball", 0.1 * M).mass(2 * KG));
    let start = Start::default().at([0 * M, (floor + height + 0.1) * M]).velocity([3 * M / S, 0 * M / S]);
    model.starts.push((ball.name, start));
    model.surface(Surface::floor("floor", floor * M, rigid(e)));
    model
}

/// With h = 1 m and e = 1/2 it hits at t, 2 t, 2.5 t, ... and comes to rest at 3 t, t = sqrt(2 h / g).
#[test]
fn bounces_accumulate_at_their_limit() {
    for floor in [0.0, 1.0, -37.3] {
        let run = run(disk(1.0, floor, 0.5), 2.0, 1e-12);
        let first = (2.0_f64 / 9.8).sqrt();
        let contacts = run.contacts();
        let (rest, hits): (Vec<_>, Vec<_>) = contacts.iter().partition(|contact| !contact.is_impact);
        let mut expected = first;
        for (n, hit) in hits.iter().enumerate() {
            // The gap is known to a rounding error of the height, and at a low bounce that is much of its time.
            let blur = 1e-15 * (1.0 + floor.abs()) / (9.8 * first * 0.5_f64.powi(n as i32));
            assert!((hit.start - expected).abs() < 4e-15 + blur, "hit {n}: {} is not {expected}", hit.start);
            expected += 2.0 * first * 0.5_f64.powi(n as i32 + 1);
        }
        assert!(hits.len() > 15, "{}", hits.len());
        assert_eq!((rest.len(), run.zeno_sequences()), (1, 1));
        close(rest[0].start, 1.355_261_854_357_877, if floor == 0.0 { 1e-15 } else { 1e-13 });
        let ball = run.equations.model().bodies[0].kinematics();
        let [x, y] = at(&run, 2.0, [ball.position().x().clone(), ball.position().y().clone()]);
        close(x, 6.0, 1e-14);
        close(y, floor + 0.1, 1e-15);
    }
}

/// A thousand seconds of elastic bounces: the energy stays, and no point gets below the floor.
#[test]
fn elastic_bounces_keep_the_energy() {
    let model = disk(1.0, 0.0, 1.0);
    let run = run(model, 1000.0, 1e-12);
    let body = run.equations.model().bodies[0].clone();
    let energy = body.kinetic_energy() + body.potential_energy(&run.equations.model().gravity);
    let [before] = at(&run, 0.0, [energy.clone()]);
    let [after] = at(&run, 1000.0, [energy]);
    println!("{} bounces, drift {:e}", run.contacts().len(), (after - before) / before);
    close(after, before, 1e-13);
    let expected = 1.0 + (1000.0 - (2.0_f64 / 9.8).sqrt()) / (2.0 * (2.0_f64 / 9.8).sqrt());
    assert_eq!(run.contacts().len(), expected.floor() as usize);
}

#[test]
fn its_own_restitution_replaces_the_floor_s() {
    let mut model = disk(1.0, 0.0, 1.0);
    model.bodies[0].restitution = Some(Expr::from(0.5));
    let run = run(model, 2.0, 1e-12);
    close(run.contacts()[1].start, 2.0 * (2.0_f64 / 9.8).sqrt(), 1e-14);
}

/// Between a floor and two walls: every hit of a wall is at the time of a free flight across.
#[test]
fn between_walls() {
    let mut model = disk(1.0, 0.0, 1.0);
    let wall = |name: &str, x: f64, normal: f64| {
        Surface::new(name, [x * M, 0 * M], [Expr::from(normal), Expr::zero()], rigid(1.0))
    };
    model.surface(wall("left", -1.0, 1.0));
    model.surface(wall("right", 1.0, -3.0));
    let run = run(model, 20.0, 1e-12);
    let pairs = run.equations.pairs();
    let hits: Vec<f64> = run
        .contacts()
        .iter()
        .filter(|contact| pairs[contact.pair].name != "floor.ball.rim")
        .map(|contact| contact.start)
        .collect();
    for (n, hit) in hits.iter().enumerate() {
        close(*hit, (0.9 + 1.8 * n as f64) / 3.0, 1e-14);
    }
    assert_eq!(hits.len(), 33);
}

/// A ball dropped on a slope of 45 degrees leaves it horizontally.
#[test]
fn off_a_slope() {
    let mut model = disk(0.0, 10.0, 1.0);
    model.surfaces.clear();
    model.starts[0].1 = Start::default().at([0 * M, 1.1 * M]);
    let angle = -Expr::pi() / 4;
    model.surface(Surface::sloping("slope", [0 * M, 0 * M], &angle, rigid(1.0)));
    let run = run(model, 0.6, 1e-12);
    let hit = &run.contacts()[0];
    let fall = 1.1 - 0.1 * 2.0_f64.sqrt();
    close(hit.start, (2.0 * fall / 9.8).sqrt(), 1e-14);
    let ball = run.equations.model().bodies[0].kinematics();
    let [vx, vy] = at(&run, hit.start, [ball.velocity().x().clone(), ball.velocity().y().clone()]);
    close(vx, (2.0 * 9.8 * fall).sqrt(), 1e-14);
    close(vy, 0.0, 1e-14);
}

/// An elastic floor that goes up with 1 m/s gives twice that to the ball.
#[test]
fn a_rising_floor() {
    let mut model = disk(1.0, 0.0, 1.0);
    model.surfaces[0] = Surface::floor("floor", time() * (1 * M / S), rigid(1.0));
    let run = run(model, 1.0, 1e-12);
    // 1 - g t^2 / 2 = t
    let hit = (-1.0 + (1.0 + 2.0 * 9.8_f64).sqrt()) / 9.8;
    close(run.contacts()[0].start, hit, 1e-14);
    let ball = run.equations.model().bodies[0].kinematics();
    let [vy] = at(&run, hit + 1e-9, [ball.velocity().y().clone()]);
    close(vy, 9.8 * hit + 2.0 - 9.8e-9, 1e-13);
}

/// On a floor that shakes gently the ball stays; shaken harder than gravity it is thrown up at the known phase.
#[test]
fn a_shaken_floor_throws_when_it_outpaces_gravity() {
    for (amplitude, thrown) in [(0.09, false), (0.2, true)] {
        let mut model = disk(0.0, 0.0, 0.0);
        let path = amplitude * M * (time() * (10 / S)).sin();
        model.surfaces[0] = Surface::floor("floor", path, rigid(0.0));
        model.starts[0].1 =
            Start::default().at([0 * M, 0.1 * M]).velocity([0 * M / S, amplitude * 10.0 * M / S]);
        let run = run(model, 0.5, 1e-12);
        let contacts = run.contacts();
        assert_eq!(contacts[0].start, 0.0);
        assert_eq!(contacts.len() > 1 || !contacts[0].is_open, thrown, "{contacts:?}");
        if thrown {
            // a w^2 sin(w t) = g
            close(contacts[0].end, (9.8_f64 / 20.0).asin() / 10.0, 1e-12);
        }
    }
}

/// Touching and approaching at the start is an impact at time 0; inside is refused, with the depth.
#[test]
fn starts_at_the_surface() {
    let mut model = disk(0.0, 0.0, 0.5);
    model.starts[0].1 = Start::default().at([0 * M, 0.1 * M]).velocity([0 * M / S, -2 * M / S]);
    let found = run(model.clone(), 0.1, 1e-12);
    assert_eq!((found.contacts()[0].start, found.contacts()[0].is_impact), (0.0, true));
    let ball = found.equations.model().bodies[0].kinematics();
    let [vy] = at(&found, 0.1, [ball.velocity().y().clone()]);
    close(vy, 1.0 - 0.98, 1e-14);
    model.starts[0].1 = Start::default().at([0 * M, 0.07 * M]);
    let refused = model.simulate(&[], 1 * S).map_err(|error| error.to_string());
    let message = refused.map(|_| ()).expect_err("inside");
    assert!(message.starts_with("`ball` starts 0.03"), "{message}");
    assert!(message.ends_with("m inside `floor`, by its point `rim`"), "{message}");
}

/// What falls without rebound is in contact once, from the impact on; a rebound that ends in contact is another one.
#[test]
fn an_impact_that_stays_is_one_contact() {
    let fallen = (2.0_f64 / 9.8).sqrt();
    let found = run(disk(1.0, 0.0, 0.0), 2.0, 1e-12).contacts();
    assert!(matches!(&found[..], [only] if only.is_open && !only.is_impact), "{found:?}");
    close(found[0].start, fallen, 1e-14);
    let bounced = run(disk(1.0, 0.0, 0.5), 2.0, 1e-12).contacts();
    assert!(bounced.len() > 15 && bounced[0].is_impact && bounced.last().is_some_and(|one| one.is_open));
}
