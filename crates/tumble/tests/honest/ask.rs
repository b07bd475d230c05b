//! Scenes as texts, with what they are asked.

use std::cell::Cell;
use std::ops::ControlFlow;

use tumble::{Case, FindResult, pipeline};
use tumble_mech::Run;

/// A point of 1 kg that moves with 1 m/s along x.
const POINT: &str = r#"
[body.p]
point = {}
mass = "1 kg"
start = { velocity = ["1 m/s", 0] }
"#;

/// A scene of 10 s without gravity, unless it says otherwise.
#[derive(Clone)]
pub(crate) struct Scene {
    until: String,
    gravity: String,
    accuracy: f64,
    sections: String,
}

/// A scene of these sections.
pub(crate) fn scene(sections: &str) -> Scene {
    let [until, gravity, sections] = ["10 s", "0 m/s^2", sections].map(str::to_owned);
    Scene { until, gravity, accuracy: 1e-9, sections }
}

/// A point of 1 kg that moves with 1 m/s along x, and these sections.
pub(crate) fn flight(sections: &str) -> Scene {
    scene(&format!("{POINT}{sections}"))
}

/// A section with a force along x on the point.
pub(crate) fn force(along_x: &str) -> String {
    format!("[force.push]\non = \"p\"\nat = \"p.cm\"\nforce = [\"{along_x}\", 0]\n")
}

/// Two elastic walls, at these places along x.
pub(crate) fn walls(left: &str, right: &str) -> String {
    let wall = |name: &str, place: &str, normal: i32| {
        format!(
            "[surface.{name}]\nthrough = [\"{place}\", 0]\nnormal = [{normal}, 0]\nrigid = {{ restitution = 1 }}\n"
        )
    };
    wall("left", left, 1) + &wall("right", right, -1)
}

impl Scene {
    pub(crate) fn until(self, until: &str) -> Self {
        Self { until: until.to_owned(), ..self }
    }

    /// In the field of the earth.
    pub(crate) fn heavy(self) -> Self {
        self.gravity("9.81 m/s^2")
    }

    pub(crate) fn gravity(self, gravity: &str) -> Self {
        Self { gravity: gravity.to_owned(), ..self }
    }

    pub(crate) fn accuracy(self, accuracy: f64) -> Self {
        Self { accuracy, ..self }
    }

    /// The scene with a find for each question, which is a formula, or a formula, ` at ` and an instant.
    fn text(&self, questions: &[&str]) -> String {
        let Self { until, gravity, accuracy, sections } = self;
        let head = format!("version = 1\nworld.gravity = \"{gravity}\"\n");
        let run = format!("run.until = \"{until}\"\nrun.accuracy = {accuracy:e}\n");
        let finds = questions.iter().zip(1..).map(|(question, number)| find(question, number));
        [head, run, sections.clone(), finds.collect()].concat()
    }

    #[track_caller]
    pub(crate) fn run(&self, questions: &[&str]) -> Case {
        let cases = pipeline::run_text("scene", &self.text(questions));
        cases.map_err(|error| format!("{error:?}")).expect("a scene that runs").remove(0)
    }

    /// What the scene answers to each question.
    #[track_caller]
    pub(crate) fn ask<const N: usize>(&self, questions: [&str; N]) -> [Found; N] {
        let case = self.run(&questions);
        assert!(case.refusal.is_none(), "{:?}", case.refusal);
        std::array::from_fn(|index| Found {
            what: questions[index].to_owned(),
            ..Found::of(&case.finds[index])
        })
    }

    /// Why the motion ends early, or does not begin.
    #[track_caller]
    pub(crate) fn refusal(&self) -> String {
        match pipeline::run_text("scene", &self.text(&[])) {
            Ok(mut cases) => cases.remove(0).refusal.expect("a motion that is refused").to_string(),
            Err(error) => format!("{error:?}"),
        }
    }

    /// Steps of the motion, and these with those of all runs that it is checked by.
    #[track_caller]
    pub(crate) fn steps(&self) -> Steps {
        let study = tumble_scene::read("scene", &self.text(&[]), &[]).expect("a scene without mistakes");
        let until = study.number(&study.until).expect("a time");
        let taken = Cell::new(0);
        let progress = |_: f64| {
            taken.set(taken.get() + 1);
            ControlFlow::Continue(())
        };
        let found = Run::trusted(&study.model, &study.model.parameters, until, study.accuracy, progress);
        let (run, _) = found.map_err(|error| error.to_string()).expect("a motion");
        Steps { motion: run.trajectory().pieces.len(), all: taken.get() }
    }
}

fn find(question: &str, number: usize) -> String {
    let (that, at) = question.split_once(" at ").unwrap_or((question, ""));
    let at = if at.is_empty() { String::new() } else { format!("at = \"{at}\"\n") };
    format!("[find.answer{number}]\nthat = \"{that}\"\n{at}")
}

/// What a motion cost.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Steps {
    pub(crate) motion: usize,
    /// Check runs included.
    pub(crate) all: usize,
}

/// A value with the error stated of it.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    pub(crate) what: String,
    pub(crate) value: f64,
    /// Infinite where nothing is known.
    pub(crate) error: f64,
}

impl Found {
    pub(crate) fn of(find: &FindResult) -> Self {
        let error = find.error.unwrap_or(f64::INFINITY);
        Self { what: find.that.clone(), value: find.value, error }
    }

    /// The truth lies within the error stated, and that is no more than would be of use.
    #[track_caller]
    pub(crate) fn is(&self, truth: f64, most: f64) {
        let Self { what, value, error } = self;
        let off = (value - truth).abs();
        println!("{what} = {value}: off by {off:.1e}, and {error:.1e} is stated");
        assert!(off <= *error, "{what} is {value} and not {truth}: off by {off:e}, and {error:e} is stated");
        assert!(*error <= most, "{what} is {value}: {error:e} is stated, and the error is {off:e}");
    }
}

/// Several at once, none of which is known to less than `most`.
#[track_caller]
pub(crate) fn are<const N: usize>(found: &[Found; N], truths: [f64; N], most: f64) {
    found.iter().zip(truths).for_each(|(found, truth)| found.is(truth, most));
}
