//! Our time a step beside that of any other program, in turn.
//!
//! The program says in its lines how many microseconds a step takes: `anything (0.773 us/step) anything`.

use std::process::Command;
use std::time::Duration;

use crate::measure::{Patience, in_turn, micros};
use crate::problems;

/// How often the two take turns.
const ROUNDS: usize = 5;
/// Each of ours, in each turn.
const PATIENCE: Patience = Patience(Duration::from_millis(200));
const ACCURACIES: [f64; 3] = [1e-6, 1e-9, 1e-12];
/// What stands behind the number.
const UNIT: &str = "us/step";

/// What a line of the program says.
#[derive(Clone, Debug, PartialEq)]
struct Said {
    /// The beginning of the line.
    what: String,
    micros: f64,
}

pub(crate) fn table(program: &str, arguments: &[String]) {
    let (mut ours, mut theirs) = ([f64::INFINITY; ACCURACIES.len()], vec![]);
    for _ in 0..ROUNDS {
        ours = least(ours, bare_steps());
        let said = ask(program, arguments);
        theirs = if theirs.is_empty() { said } else { fewest(&theirs, &said) };
    }
    let problem = problems::wind_pendulum();
    println!("microseconds a step, {}, bare, steps alone", problem.name);
    for (accuracy, micros) in ACCURACIES.iter().zip(ours) {
        let order = problem.motion(&problem.equations(), *accuracy, false).order;
        println!("  accuracy {accuracy:.0e}, order {order}: {micros:.3}");
    }
    println!("the other program, and ours over it at each of these accuracies");
    for Said { what, micros } in theirs {
        let over: Vec<String> = ours.iter().map(|ours| format!("{:>6.2}", ours / micros)).collect();
        println!("  {what:<34} {micros:>8.3} {}", over.join(" "));
    }
}

/// Our time of a bare step at each accuracy, us.
fn bare_steps() -> [f64; ACCURACIES.len()] {
    let problem = problems::wind_pendulum();
    let equations = problem.equations();
    ACCURACIES.map(|accuracy| {
        let steps = problem.motion(&equations, accuracy, false).steps;
        let alone = &mut || problem.motion(&equations, accuracy, false).steps_alone();
        micros(in_turn(PATIENCE, [alone])[0]) / steps as f64
    })
}

fn least<const N: usize>(a: [f64; N], b: [f64; N]) -> [f64; N] {
    std::array::from_fn(|index| a[index].min(b[index]))
}

/// The lesser time of each line; a program says the same lines each time.
fn fewest(a: &[Said], b: &[Said]) -> Vec<Said> {
    let both = a.iter().zip(b);
    both.map(|(a, b)| Said { what: a.what.clone(), micros: a.micros.min(b.micros) }).collect()
}

fn ask(program: &str, arguments: &[String]) -> Vec<Said> {
    let output = Command::new(program).args(arguments).output().expect("the other program starts");
    let text = String::from_utf8_lossy(&output.stdout);
    text.lines().filter_map(said).collect()
}

fn said(line: &str) -> Option<Said> {
    let before = line.split_once(UNIT)?.0.trim_end();
    let number = before.rsplit(|c: char| !(c.is_ascii_digit() || ".eE+-".contains(c))).next()?;
    let what = line.split(':').next().unwrap_or_default().trim().to_owned();
    Some(Said { what, micros: number.parse().ok()? })
}
