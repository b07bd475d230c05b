//! A rod falls on a floor until it rests: `cargo run --release --example falling_rod`, then open `out/falling-rod/report.html`.

use std::error::Error;

use tumble::prelude::*;

fn main() -> Result<(), Box<dyn Error>> {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    model.stops_at_rest = true;
    let rod = Body::rod("rod", [-0.5 * M, 0 * M], [0.5 * M, 0 * M]).mass(1 * KG);
    let rod = model.add(rod.with_point("tip", [0.5 * M, 0 * M]));
    model.starts.push((rod.name.clone(), Start::default().at([0 * M, 1 * M]).angle(0.2.into())));
    model.surface(Surface::floor("floor", 0 * M, ContactLaw::Rigid { restitution: 0.4.into() }));
    let (angle, height) = (rod.kinematics().angle(), rod.kinematics().position().y().clone());
    let study = Plan::of("A rod falls on a floor", model, 20 * S)
        .plot("height", [("centre", height.clone())])
        .plot("tilt", [("angle", angle.clone())])
        .stroboscope("fall", 0.05 * S)
        .balance("energies", Sheet::Energies)
        .free_body("landing", &rod, [Instant::contact_start("floor", 1), Instant::event("rest")])
        .find("first touch", t(), When::At(Instant::contact_start("floor", 1)))
        .check("flat", angle, When::At(Instant::event("rod.rest")), 0.into(), 1e-9.into())
        .study()
        .map_err(|mistakes| mistakes.to_string())?;
    let options = Options { out: "out".into(), ..Options::default() };
    let outcome = run_study(&study, "falling-rod", &options)?;
    for find in &outcome.cases[0].finds {
        println!("{}: {} {}, {}", find.name, find.value, find.unit, find.certainty());
    }
    println!("rests from {} s on; results: {}", outcome.cases[0].end, outcome.folder.display());
    Ok(())
}
