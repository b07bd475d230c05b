use std::time::Instant;
use tumble_expr::units::{KG, M, S};
use tumble_mech::{Body, ContactLaw, Gravity, Model, Run, Start, Surface};
use tumble_ode::Accuracy;
use std::ops::ControlFlow;

fn main() {
    for n in std::env::args().skip(1).map(|n| n.parse::<usize>().unwrap()) {
        let mut model = Model::new();
        model.gravity = Gravity::Vertical(10 * M / (S * S));
        for i in 0..n {
            let name = format!("ball{i}");
            model.add(Body::point(&name).mass(1 * KG));
            let h = 1.0 + 0.37 * ((i * 7919) % 100) as f64 / 100.0;
            model.starts.push((name, Start::default().at([(0.2 * i as f64) * M, h * M])));
        }
        model.surface(Surface::floor("floor", 0 * M, ContactLaw::Rigid { restitution: 0.8.into() }));
        let begun = Instant::now();
        let equations = tumble_mech::Equations::new(model.clone()).unwrap();
        let built = begun.elapsed();
        let go = |_| ControlFlow::Continue(());
        let run = Run::refined_of(&equations, &model.parameters, 3.0, Accuracy::DEFAULT, go).unwrap();
        let first = begun.elapsed();
        let (_, trust) = Run::trusted_of(&equations, &model.parameters, 3.0, Accuracy::DEFAULT, go).unwrap();
        println!("{n}: built {:?}, first run {:?}, then trusted {:?}; {} events, reached {:e}", built, first, begun.elapsed(), run.events().count(), trust.reached);
    }
}
