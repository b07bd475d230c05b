//! What a survey found, as Markdown.

use super::families::FAMILIES;
use super::judge::{Judged, Verdict};
use super::tally::{Failure, Survey, Tally};
use super::{Fate, Report};

/// At most this part of the stated errors may be exceeded, ...
const MOST_EXCEEDED: f64 = 1e-3;
/// ... none by more than this factor.
const MOST_EXCESS: f64 = 3.0;
/// Stated over true errors: the median, ...
const MOST_MEDIAN: f64 = 30.0;
/// ... and what 99 in 100 are below.
const MOST_RATIO: f64 = 1e3;
/// Part of the problems that may be refused.
const MOST_REFUSED: f64 = 0.01;
/// Failures that are listed, of all and of each family.
const LISTED: usize = 20;
const LISTED_EACH: usize = 4;

const HEAD: &str = "problems | refused | values | unknown | missed | exceeded | worst | median | 99 % \n";

/// Every target that is missed, in words.
pub(crate) fn missed(survey: &Survey) -> Vec<String> {
    let all = Tally::of(survey.reports.iter());
    let targets = [
        ("share of errors exceeded", all.share_exceeded(), MOST_EXCEEDED),
        ("largest factor", if all.missed > 0 { f64::INFINITY } else { all.worst }, MOST_EXCESS),
        ("median ratio", all.ratio(0.5), MOST_MEDIAN),
        ("99th percentile of the ratio", all.ratio(0.99), MOST_RATIO),
        ("share refused", all.share_refused(), MOST_REFUSED),
    ];
    let missed = targets.into_iter().filter(|(_, found, most)| found > most);
    missed.map(|(what, found, most)| format!("{what}: {found:.2e}, at most {most:.0e}")).collect()
}

/// The tables and the worst failures.
pub(crate) fn render(survey: &Survey) -> String {
    let family =
        |index: usize| Tally::of(survey.reports.iter().filter(move |report| report.key.family == index));
    let decade =
        |tens: i32| Tally::of(survey.reports.iter().filter(move |report| decade(report.accuracy) == tens));
    let families = FAMILIES.iter().enumerate().map(|(index, known)| (known.name, family(index)));
    let families = families.filter(|(_, tally)| tally.problems > 0).map(|(name, tally)| row(name, &tally));
    let decades = (-13..=-4).rev().map(|tens| row(&format!("1e{tens} to 1e{}", tens + 1), &decade(tens)));
    let all = row("all", &Tally::of(survey.reports.iter()));
    let mut text = table("family", families.chain([all]));
    text += &table("accuracy", decades);
    text += &list("Targets missed", missed(survey));
    let worst = survey.worst(|failure| failure.factor.is_finite());
    text += &list("Worst errors", worst.iter().take(LISTED).map(line));
    for (index, family) in FAMILIES.iter().enumerate() {
        let worst = survey.worst(|failure| failure.report.key.family == index).into_iter().take(LISTED_EACH);
        let worst: Vec<String> = worst.map(|failure| line(&failure)).chain(stops(survey, index)).collect();
        text += &list(family.name, worst);
    }
    text + &slowest(survey)
}

fn decade(accuracy: f64) -> i32 {
    accuracy.log10().floor().clamp(-13.0, -4.0) as i32
}

fn table(first: &str, rows: impl Iterator<Item = String>) -> String {
    let line = "|---".repeat(1 + HEAD.split('|').count());
    format!("| {first} | {}|\n{line}|\n{}\n", HEAD.trim_end_matches('\n'), rows.collect::<String>())
}

fn row(name: &str, tally: &Tally) -> String {
    let Tally { problems, stated, unknown, missed, exceeded, worst, .. } = tally;
    let (refused, values) = (tally.refused + tally.broken, stated + unknown + missed);
    let worst = if *exceeded == 0 { "-".to_owned() } else { number(*worst) };
    let [median, most] = [0.5, 0.99].map(|part| number(tally.ratio(part)));
    format!(
        "| {name} | {problems} | {refused} | {values} | {unknown} | {missed} | {exceeded} | {worst} | {median} | {most} |\n"
    )
}

fn number(value: f64) -> String {
    match value {
        value if value.is_nan() => "-".to_owned(),
        value if value < 9999.5 => {
            format!("{value:.3}").chars().take(5).collect::<String>().trim_end_matches('.').to_owned()
        }
        value => format!("{value:.0e}"),
    }
}

fn list(title: &str, lines: impl IntoIterator<Item = String>) -> String {
    let lines: Vec<String> = lines.into_iter().map(|line| format!("- {line}\n")).collect();
    if lines.is_empty() { String::new() } else { format!("{title}:\n\n{}\n", lines.concat()) }
}

fn line(Failure { report, value, factor }: &Failure<'_>) -> String {
    format!("{} factor {}: {}", command(report), number(*factor), told(value))
}

fn command(report: &Report) -> String {
    format!("`--only {}`", report.key.words().join(" "))
}

/// Problems of a family that were refused, or that the program broke down over.
fn stops(survey: &Survey, family: usize) -> impl Iterator<Item = String> {
    let reports = survey.reports.iter().filter(move |report| report.key.family == family);
    let stops = reports.filter_map(move |report| Some((report, stop(&report.fate)?)));
    stops.take(LISTED_EACH).map(move |(report, why)| format!("{} {why}", command(report)))
}

fn stop(fate: &Fate) -> Option<String> {
    match fate {
        Fate::Answered(_) => None,
        Fate::Refused(reason) => Some(format!("refused: {reason}")),
        Fate::Broken(reason) => Some(format!("broke down: {reason}")),
    }
}

fn slowest(survey: &Survey) -> String {
    let slowest = survey.reports.iter().max_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let told = |report: &Report| format!("Slowest: {} in {:.1} s.\n", command(report), report.seconds);
    slowest.map(told).unwrap_or_default()
}

/// Every value of one problem.
pub(crate) fn values(fate: &Fate) -> String {
    match fate {
        Fate::Answered(values) => values.iter().map(|value| told(value) + "\n").collect(),
        other => stop(other).unwrap_or_default() + "\n",
    }
}

fn told(Judged { name, what, truth, value, verdict }: &Judged) -> String {
    let verdict = match verdict {
        Verdict::Missed => "missed".to_owned(),
        Verdict::Unknown => format!("nothing stated, true error {:.2e}", (value - truth).abs()),
        Verdict::Stated(errors) => {
            let mark = if errors.is_exceeded() { "EXCEEDED " } else { "" };
            format!(
                "{mark}true error {:.2e}, stated {:.2e}, ulp {:.1e}",
                errors.real, errors.stated, errors.ulp
            )
        }
    };
    format!("{name} ({what}): {value:e}, truly {truth:e}: {verdict}")
}
