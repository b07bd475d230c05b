//! What is round meets a pole, a bowl or another body along the line of centres, without weight.
//!
//! # Law
//!
//! M d'' = -k d - c d', or -k d^(3/2) (1 + c d'), with M = m, or m_a m_b/(m_a + m_b) between two bodies.
//!
//! # Closed form
//!
//! That of [`Law`], along one line at any angle: the speed v before and w after change velocities by (v + w) M/m.
//!
//! # Source
//!
//! Landau and Lifshitz, Mechanics, § 13.

use super::super::pad::Pad;
use super::super::real::Real;
use super::super::setup::{At, Given, Problem, Setup};
use super::super::touch::{Law, Touch};
use super::super::units::{LENGTH, MASS, SPEED, TIME};

pub(super) fn make(mut setup: Setup) -> Problem {
    let mass = setup.given("mass", 1.0, MASS);
    let size = setup.draw.log_between(0.03, 1.0);
    let radius = setup.given("radius", size, LENGTH);
    let size = setup.draw.between(-3.1, 3.1);
    let angle = setup.angle("angle", size);
    let speed = setup.given("speed", 1.0, SPEED);
    let centre = ["x", "y"].map(|name| setup.shift(name));
    let size = setup.draw.log_between(0.05, 3.0);
    let way = setup.given("way", size, LENGTH);
    let meeting = Meeting { mass, radius, angle, speed, centre, way };
    match setup.draw.pick(&["pole", "bowl", "pair"]) {
        "pole" => meeting.with_circle(setup, -1),
        "bowl" => meeting.with_circle(setup, 1),
        _ => meeting.with_body(setup),
    }
}

struct Meeting {
    mass: Given,
    radius: Given,
    /// Of the line from the other's centre.
    angle: Given,
    speed: Given,
    /// Of the other.
    centre: [Given; 2],
    /// Between them at first.
    way: Given,
}

impl Meeting {
    /// It flies outwards into a bowl, `out` of 1, or inwards against a pole.
    fn with_circle(&self, mut setup: Setup, out: i64) -> Problem {
        let pad = Pad::random(&mut setup, &self.mass.value, &self.speed.value);
        let Self { mass, radius, angle, speed, centre: [x, y], way } = self;
        let size = setup.draw.log_between(0.1, 3.0);
        let other = setup.given("other", size, LENGTH);
        let (from, circle, sign) = match out > 0 {
            true => (
                format!("{other}"),
                format!(
                    "circle = {{ centre = [\"{x}\", \"{y}\"], radius = \"{other} + {radius} + {way}\", inside = true }}"
                ),
                "",
            ),
            false => (
                format!("({other} + {radius} + {way})"),
                format!("circle = {{ centre = [\"{x}\", \"{y}\"], radius = \"{other}\" }}"),
                "-",
            ),
        };
        setup.write(&format!(
            "[body.p]
            disk = {{ radius = \"{radius}\" }}
            mass = \"{mass}\"
            start = {{ at = [\"{x} + {from}*cos({angle})\", \"{y} + {from}*sin({angle})\"], velocity = [\"{sign}{speed}*cos({angle})\", \"{sign}{speed}*sin({angle})\"] }}
            [surface.round]
            {circle}
            {}",
            pad.line("")
        ));
        let touch = self.ask_contact(&mut setup, &pad.law, "round");
        setup.ask("round.p.rim.gap", At::Least(None), &-&touch.depth, LENGTH);
        // Across a bowl it comes to the other side.
        let until = self.until(&mut setup, &touch, (out > 0).then(|| &other.value * 2));
        let back = -(&touch.after * out);
        self.ask_velocity(&mut setup, "p", &back, [&Real::zero(), &Real::zero()]);
        setup.problem("0 m/s^2", &until)
    }

    fn with_body(&self, mut setup: Setup) -> Problem {
        let size = setup.draw.log_between(0.1, 10.0);
        let heavier = setup.given("other_mass", size, MASS);
        let size = setup.draw.log_between(0.03, 1.0);
        let other = setup.given("other", size, LENGTH);
        let drift = ["ux", "uy"].map(|name| {
            let size = setup.draw.between(-1.0, 1.0);
            setup.given(name, size, SPEED)
        });
        let Self { mass, radius, angle, speed, centre: [x, y], way } = self;
        let whole = &mass.value + &heavier.value;
        let pad = Pad::random(&mut setup, &(&mass.value * &heavier.value / &whole), &speed.value);
        let [ux, uy] = &drift;
        let from = format!("({other} + {radius} + {way})");
        setup.write(&format!(
            "[body.p]
            disk = {{ radius = \"{radius}\" }}
            mass = \"{mass}\"
            start = {{ at = [\"{x} + {from}*cos({angle})\", \"{y} + {from}*sin({angle})\"], velocity = [\"{ux} - {speed}*cos({angle})\", \"{uy} - {speed}*sin({angle})\"] }}
            [body.q]
            disk = {{ radius = \"{other}\" }}
            mass = \"{heavier}\"
            start = {{ at = [\"{x}\", \"{y}\"], velocity = [\"{ux}\", \"{uy}\"] }}
            [contact.round]
            between = [\"p\", \"q\"]
            {}",
            pad.line("")
        ));
        let touch = self.ask_contact(&mut setup, &pad.law, "round");
        setup.ask("round.p.q.gap", At::Least(None), &-&touch.depth, LENGTH);
        let until = self.until(&mut setup, &touch, None);
        let drift = [&ux.value, &uy.value];
        let parting = &speed.value + &touch.after;
        let first = &parting * &heavier.value / &whole - &speed.value;
        self.ask_velocity(&mut setup, "p", &first, drift);
        self.ask_velocity(&mut setup, "q", &-(&parting * &mass.value / &whole), drift);
        setup.problem("0 m/s^2", &until)
    }

    fn ask_contact(&self, setup: &mut Setup, law: &Law, name: &str) -> Touch {
        let touch = law.touch(&self.speed.value);
        let begin = self.begin();
        setup.ask(&format!("{name}.contact[1].start"), At::End, &begin, TIME);
        setup.ask(&format!("{name}.contact[1].duration"), At::End, &touch.duration, TIME);
        setup.ask_time(&format!("{name}.contact[1].end"), &(begin + &touch.duration));
        touch
    }

    fn begin(&self) -> Real {
        &self.way.value / &self.speed.value
    }

    /// An end after the contact, before it has come so far.
    fn until(&self, setup: &mut Setup, touch: &Touch, far: Option<Real>) -> Given {
        let end = self.begin() + &touch.duration;
        let late = self.begin() * Real::of(setup.draw.between(0.1, 2.0));
        let until = setup.near("until", &(&end + late), TIME);
        let late = &until.value - end;
        let comes = far.is_some_and(|far| &late * &touch.after >= far + &self.way.value);
        assert!(late.sign() > 0 && !comes, "one contact");
        until
    }

    /// At the end, by what it is along the line and what is added.
    fn ask_velocity(&self, setup: &mut Setup, body: &str, along: &Real, [ux, uy]: [&Real; 2]) {
        let [sine, cosine] = [self.angle.value.sin(), self.angle.value.cos()];
        setup.ask(&format!("{body}.vx"), At::End, &(ux + along * cosine), SPEED);
        setup.ask(&format!("{body}.vy"), At::End, &(uy + along * sine), SPEED);
    }
}
