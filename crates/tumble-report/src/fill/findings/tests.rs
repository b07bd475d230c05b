//! What findings say is so.

use std::path::Path;

use tumble_scene::{Folder, Study};

use super::of;
use crate::results::{Case, CaseBalance, Runs, Surveyor, telling};
use crate::scenes;

/// What is found in a scene of the gallery.
fn found_in(name: &str) -> Vec<String> {
    let (study, cases) = scenes::motions_called(name);
    plain(&study, cases)
}

/// What is found in a scene's text.
fn found(text: &str) -> Vec<String> {
    let (study, cases) = scenes::motions_in("scene", text.as_bytes(), &Folder::of(Path::new(".")));
    plain(&study, cases)
}

fn plain(study: &Study, mut cases: Vec<Case>) -> Vec<String> {
    for case in &mut cases {
        case.balance = CaseBalance::of(case).expect("a balance");
    }
    let cases = &cases[..];
    let survey = Surveyor::of(study, true).expect("a sweep").end(vec![]);
    let runs = Runs { cases, missing: &[], survey: &survey };
    let found = of(study, runs, &telling(cases)).expect("findings");
    found.iter().map(|text| text.to_plain().replace('\u{a0}', " ")).collect()
}

fn has(found: &[String], words: &str) -> bool {
    found.iter().any(|text| text.contains(words))
}

/// 2 pi sqrt(2 L/(3 g)) of a rod of a metre is 1.638 s.
#[test]
fn small_swings_stand_beside_the_gusts() {
    let found = found_in("01-pendulum-in-the-wind");
    assert!(
        has(
            &found,
            "small swings of the rod, without air, is 1.638 s; the wind repeats every 0.5 s, 0.305 of that"
        ),
        "{found:?}"
    );
    assert!(has(&found, "2 s, 1.22 times that period (T = 2 s)"), "{found:?}");
    assert!(
        !found_in("07-measured-gust").iter().any(|text| text.contains("repeats every")),
        "a record has no period"
    );
}

/// The run beside it has no air: 9.6 m of range.
#[test]
fn the_air_takes_what_the_throw_without_it_has_more() {
    let found = found_in("02-thrown-rod");
    assert!(has(&found, "9.6 m (without air); 7.97437 m (with air)"), "{found:?}");
    assert!(has(&found, "the centre of the rod is 1.62563 m behind and 0.4563 m lower"), "{found:?}");
    assert_eq!(found.iter().filter(|text| text.contains("Compared with the same throw")).count(), 1);
}

/// 5/7 of its speed is left of a ball that slid; a hoop keeps (v - r omega)/2.
#[test]
fn friction_changes_speed_and_spin_until_a_ball_rolls() {
    let found = found_in("19-bowling-ball");
    assert!(
        has(&found, "until then friction changes its speed from 8 to 5.714 m/s and its spin from 0 to"),
        "{found:?}"
    );
    assert!(!has(&found_in("20-rolling-down"), "until then"), "it rolls from the start");
}

#[test]
fn a_contact_that_is_lost_is_told_with_the_angle() {
    assert!(has(
        &found_in("14-sliding-ladder"),
        "The head of the ladder leaves the wall, whose push falls to zero, at 0.845032 s"
    ));
}

#[test]
fn points_of_one_body_on_one_surface_are_one_work() {
    let found = found_in("17-block-on-a-slope");
    assert_eq!(found.iter().filter(|text| text.contains("takes energy")).count(), 1, "{found:?}");
    let found = found_in("11-double-pendulum");
    assert!(
        has(&found, "The elbow passes energy from the forearm to the arm: 1.96478 J")
            && !has(&found, "gives energy"),
        "{found:?}"
    );
}

/// sqrt(m g/D) is 10 m/s.
#[test]
fn a_terminal_speed_is_told_once_it_is_reached() {
    let fall = |until: &str| {
        format!(
            r#"version = 1
            world.gravity = "10 m/s^2"
            run.until = "{until}"
            [body.stone]
            point = {{}}
            mass = "1 kg"
            [drag.air]
            at = "stone.cm"
            quadratic = "0.1 kg/m"
            "#
        )
    };
    let found = found(&fall("20 s"));
    assert!(
        has(&found, "stone has come to its terminal speed, the air bears its weight: 10 m/s"),
        "{found:?}"
    );
    assert!(!has(&self::found(&fall("1 s")), "terminal"));
}

/// A rod that is let go at 0.2 rad, 11.4592 degrees, swings as far to the other side.
#[test]
fn how_far_a_pivoted_body_swings_is_told_where_nothing_else_is_asked() {
    let found = found(
        r#"version = 1
        world.gravity = "9.81 m/s^2"
        run.until = "3 s"
        [body.rod]
        rod = { from = [0, 0], to = [0, "-1 m"] }
        mass = "1 kg"
        start = { angle = "0.2 rad" }
        [pivot.hinge]
        body = "rod"
        point = [0, 0]
        world = [0, 0]
        "#,
    );
    assert!(has(&found, "The rod swings between \u{2212}11.4592° and 11.4592°."), "{found:?}");
}

/// A rod whose foot sticks while it is pressed; then what pulls at it allows it to stick, to lift off or to slide to the left.
#[test]
fn motions_that_are_possible_besides_are_listed_by_what_contacts_do() {
    let found = found(include_str!("../../tests/leaning.toml"));
    let said = "Rigid bodies with friction could go on in 3 ways from 0.25 s on: ";
    let said = found.iter().find_map(|text| text.strip_prefix(said)).expect("it is said");
    let mut ways: Vec<&str> = said.trim_end_matches('.').split("; or ").collect();
    ways.sort_unstable();
    assert_eq!(
        ways,
        [
            "the end \u{201c}from\u{201d} leaves the floor",
            "the end \u{201c}from\u{201d} slides to the left on the floor",
            "the end \u{201c}from\u{201d} sticks to the floor, as this run goes on"
        ]
    );
}

/// m g sin(20 deg) of the 0.5 m g cos(20 deg) that static friction could be.
#[test]
fn what_rests_on_a_slope_is_held_by_friction() {
    let found = found_in("17-block-on-a-slope");
    let words = "Friction holds the block on the incline: 6.71 N of at most 9.218 N.";
    assert!(has(&found, words), "{found:?}");
    let flat = found_in("27-rocking-block");
    assert!(!has(&flat, "Friction holds"), "{flat:?}");
}

/// In the run in which the air gives little it is said too, since it gives much in the others.
#[test]
fn no_run_is_left_out_of_what_matters_in_another() {
    let found = found_in("01-pendulum-in-the-wind");
    let runs = ["0.5", "1", "2", "4"].map(|period| format!("(T = {period} s)"));
    let of_air = found.iter().find(|text| text.starts_with("The air gives energy to the rod"));
    assert!(of_air.is_some_and(|text| runs.iter().all(|run| text.contains(run))), "{found:?}");
    // Where it matters in no run nothing is said.
    assert!(!has(&found, "The air takes energy"), "{found:?}");
    assert!(!has(&found, "turns"), "{found:?}");
}

/// On the slope, and not to the side: 16/(2 (sin 20° + 0.4 cos 20°) 9.81) m.
#[test]
fn a_body_on_an_incline_ends_farther_along_it() {
    let found = found_in("17-block-on-a-slope");
    assert!(has(&found, "The block ends farther up the incline than it began, by 1.13595 m"), "{found:?}");
}

#[test]
fn an_answer_has_the_scene_s_name_only_beside_others_in_the_same_words() {
    let twice = "version = 1\nworld.gravity = \"9.81 m/s^2\"\nrun.until = \"1 s\"\n[body.stone]\nball = { radius = \"1 cm\" }\nmass = \"1 kg\"\n\
                 [find.early]\nthat = \"stone.vy\"\nat = \"its least\"\nduring = [0, \"0.5 s\"]\n\
                 [find.late]\nthat = \"stone.vy\"\nat = \"its least\"\nduring = [\"0.5 s\", \"1 s\"]\n";
    let found = self::found(twice);
    assert!(
        has(&found, "(early) between 0 s and 0.5 s is ") && has(&found, "(late) from 0.5 s on is "),
        "{found:?}"
    );
}

#[test]
fn of_few_runs_each_has_its_answer() {
    let found = found_in("28-painleve-rod");
    let words = "Let go: normal force of the floor N is 6.13125 N, at 0 s (μ = 0); 24.525 N, at 0 s (μ = 1)";
    assert!(found[0].starts_with(words), "{found:?}");
}

#[test]
fn answers_at_one_instant_are_one_sentence() {
    let found = found_in("14-sliding-ladder");
    let words =
        "Leaves the wall: height of the head y_head is 2.50585 m and angle θ is 51.2104°, at 0.845032 s.";
    assert_eq!(found[0], words);
    let given = found_in("20-rolling-down");
    assert_eq!(given[0], "Least coefficient of friction with which it rolls (μ_0) is 0.19245.");
}

#[test]
fn of_two_bodies_the_one_is_named_whose_speed_a_contact_changes() {
    let found = found_in("24-glancing-disks");
    assert!(has(&found, "Disk 1 in its first contact with disk 2 changes its speed from 2 to"), "{found:?}");
}

/// Half a period and a whole one after it was let go, it is as high as then.
#[test]
fn a_height_that_is_reached_again_is_told_once() {
    let found = found_in("26-ball-in-a-bowl");
    let words = "reaches its highest point, y = \u{2212}0.225 m at 0.854396 s, at 1.70879 s, and once more.";
    assert!(has(&found, words), "{found:?}");
}
