//! The work of reading a scene grows as its text does.
//!
//! What is counted is memory that is asked for: how often, and how much. That is the same on every machine, and whatever
//! copies, compiles or compares something for each of many things shows in it.

#[path = "common/large.rs"]
mod large;

use std::time::Instant;

use tumble_scene::read;

/// Twice the text may make this many times the work: a map grows by doubling, and sorting takes a little more than twice.
const MOST: f64 = 2.3;

/// Small enough for a debugging build, large enough for what is done once not to count.
const SIZE: usize = 1000;

fn scene(kind: large::Kind, n: usize) -> String {
    (kind.1)(n)
}

/// Reads a scene and shows its mistakes, if it has any.
fn check(text: &str) {
    if let Err(mistakes) = read("scene.toml", text, &[]) {
        assert!(!mistakes.render(false, 100).is_empty());
    }
}

/// How often memory was asked for, and how many bytes.
fn work(text: &str) -> [f64; 2] {
    let info = allocation_counter::measure(|| check(text));
    [info.count_total as f64, info.bytes_total as f64]
}

#[test]
fn twice_the_scene_is_twice_the_work() {
    let mut found = vec![];
    for kind in large::KINDS {
        let [once, twice] = [SIZE, 2 * SIZE].map(|n| work(&scene(*kind, n)));
        for (what, once, twice) in [("requests", once[0], twice[0]), ("bytes", once[1], twice[1])] {
            if twice > MOST * once {
                found.push(format!("{} {}: {what} from {once} to {twice}", SIZE, kind.0));
            }
        }
    }
    assert!(found.is_empty(), "\n{}", found.join("\n"));
}

/// Large scenes overflow no stack, whatever they are many of.
#[test]
fn very_large_scenes_are_read_or_refused() {
    for kind in large::KINDS.iter().filter(|kind| !kind.0.contains("polygon")) {
        check(&scene(*kind, 20_000));
    }
}

/// How long it takes: `cargo test --release -p tumble-scene --test large -- --ignored --nocapture`.
#[test]
#[ignore = "prints times and asserts nothing"]
fn times() {
    for kind in large::KINDS {
        let times = [10_000, 20_000].map(|n| {
            let text = scene(*kind, n);
            let start = Instant::now();
            check(&text);
            format!("{n}: {:.2} s", start.elapsed().as_secs_f64())
        });
        println!("{:45} {}", kind.0, times.join(", "));
    }
}
