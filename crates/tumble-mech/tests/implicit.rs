//! Loads that depend on forces of contacts and joints otherwise than linearly; against closed forms and independent integrations.

mod common;

use common::{at, close, run};
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{Anchor, Body, Gravity, Joint, Model, Run, RunError, Shape, Start};
use tumble_ode::Accuracy;

const G: f64 = 9.81;

/// The force of `hinge`.
fn size(forces: [Expr; 2]) -> Expr {
    Expr::norm(forces.to_vec())
}

/// A body held at its point (0, 0) by a pivot or by a pin, with a torque that depends on what that does.
fn hinged(body: Body, by_pivot: bool, start: Start, torque: impl Fn(&Body, Expr) -> Expr) -> (Model, Body) {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    let body = model.add(body.with_point("top", [0 * M, 0 * M]));
    let place = [0 * M, 0 * M];
    let forces = if by_pivot {
        model.pivot_at("hinge", &body, place.clone(), place);
        model.pivots[0].force_symbols().to_vec()
    } else {
        let top = Anchor::Material(body.named_point("top").expect("given"));
        let world = Anchor::World(Vector::planar(0 * M, 0 * M));
        let joint = Joint { assemble: true, ..Joint::pin("hinge", [top, world]) };
        let forces = joint.multipliers();
        model.join(joint);
        forces
    };
    let force = size([forces[0].clone().into(), forces[1].clone().into()]);
    model.torque("rub", &body, torque(&body, force));
    model.starts.push((body.name.clone(), start));
    (model, body)
}

fn rubs(body: &Body, force: Expr, arm: f64) -> Expr {
    -arm * M * force * body.kinematics().omega().sign()
}

/// A disk of 2 kg and 0.3 m on its axle bears m g, and its friction of radius mu r stops it after `omega I/(mu r m g)`, for good.
#[test]
fn a_disk_on_its_axle_spins_down() {
    let (mass, radius, arm, omega) = (2.0, 0.3, 0.004, 5.0);
    let inertia = 0.5 * mass * radius * radius;
    let stop = omega * inertia / (arm * mass * G);
    for by_pivot in [true, false] {
        for way in [1.0, -1.0] {
            let disk = Shape::Disk { centre: Vector::planar(0 * M, 0 * M), radius: radius * M };
            let start = Start::default().omega(way * omega / S);
            let (model, disk) = hinged(Body::of_shape("disk", disk).mass(mass * KG), by_pivot, start, |body, force| {
                rubs(body, force, arm)
            });
            let run = run(model, 2.0 * stop, 1e-13);
            let motion = [disk.kinematics().omega(), disk.kinematics().angle()];
            let t = 0.6 * stop;
            let found = at(&run, t, motion.clone());
            close(found[0], way * omega * 0.4, 1e-14);
            close(found[1], way * (omega * t - 0.5 * omega / stop * t * t), 1e-13);
            let found = at(&run, 1.9 * stop, motion);
            assert_eq!(found[0], 0.0);
            close(found[1], way * 0.5 * omega * stop, 1e-13);
        }
    }
}
