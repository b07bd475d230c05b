//! What a sweep answers: a curve over one parameter, a map over two.

use tumble_drawing::{Axis, CurveFigure, DataSeries, Label, MapFigure, Mark, Svg};
use tumble_mech::Extreme;
use tumble_scene::{Question, Study, When};

use crate::figures::{self, symbols};
use crate::fill::words::spoken;
use crate::results::{Located, Sample, Survey, SweptAxis};

/// Fewer runs make no curve, and fewer rows or columns no map.
const LEAST: usize = 3;
/// Curves of more runs have no dots.
const MOST_DOTS: usize = 60;
/// Values over more than this many times the least are shown by their powers of ten.
const DECADES: f64 = 100.0;
/// So many answers at one instant are one sentence.
const MOST_AT_ONCE: usize = 3;
/// Digits of the place of an extreme in a figure.
const DIGITS: usize = 4;

/// Every answer as a figure with its name, where the sweep is one of one parameter or two.
pub(super) fn all(study: &Study, survey: &Survey) -> Vec<(String, Svg)> {
    let curves = curves(study, survey).into_iter().map(|(name, figure)| (name, figure.svg()));
    curves.chain(maps(study, survey).into_iter().map(|(name, figure)| (name, figure.svg()))).collect()
}

/// The answers over one parameter.
pub(crate) fn curves(study: &Study, survey: &Survey) -> Vec<(String, CurveFigure)> {
    let [axis] = &survey.axes[..] else { return vec![] };
    if axis.values.len() < LEAST || survey.answers.is_empty() {
        return vec![];
    }
    let figure = |(index, question): (usize, &Question)| {
        let points = points(axis, survey, index);
        let mut figure = CurveFigure::new(title(study, question), shown(study, axis), asked(study, question));
        let dotted = axis.values.len() <= MOST_DOTS;
        figure.series.push(DataSeries { label: Label::default(), points, dotted });
        let own = survey.located.iter().filter(|located| located.index == index);
        figure.marks.extend(own.filter(|located| located.is_asked).map(|located| mark(study, axis, located)));
        (name(question), figure)
    };
    let is_seen = |(_, figure): &(String, CurveFigure)| {
        figure
            .series
            .iter()
            .any(|series| series.points.iter().filter(|point| point[1].is_finite()).count() >= LEAST)
    };
    study.finds.iter().enumerate().map(figure).filter(is_seen).collect()
}

fn points(axis: &SweptAxis, survey: &Survey, index: usize) -> Vec<[f64; 2]> {
    let value =
        |answers: &Vec<Option<Sample>>| answers.get(index).copied().flatten().map_or(f64::NAN, |s| s.value);
    let mut points: Vec<[f64; 2]> = axis
        .values
        .iter()
        .zip(&survey.answers)
        .map(|(at, answers)| [on(axis, *at), value(answers)])
        .collect();
    points.extend(made(survey, index).map(|sample| [on(axis, sample.at), sample.value]));
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    points
}

/// The best of the runs that were made between those of the sweep.
fn made(survey: &Survey, index: usize) -> impl Iterator<Item = Sample> {
    let own = survey.located.iter().filter(move |located| located.index == index && located.place.made > 0);
    own.map(|located| located.place.best)
}

/// Over decades by powers of ten.
fn is_wide(axis: &SweptAxis) -> bool {
    let least = axis.values.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = axis.values.iter().copied().fold(0.0, f64::max);
    least > 0.0 && greatest > DECADES * least
}

fn on(axis: &SweptAxis, value: f64) -> f64 {
    if is_wide(axis) { value.log10() } else { value }
}

fn mark(study: &Study, axis: &SweptAxis, located: &Located) -> Mark {
    let at = located.place.best.at;
    let number = tumble_drawing::Label::number(at, DIGITS).to_plain();
    let value = swept(study, &axis.name).then(Label::plain(" = ")).then(Label::quantity(&number, &axis.unit));
    if located.place.equal.is_some() {
        return Mark { at: on(axis, at), label: Label::default() };
    }
    Mark { at: on(axis, at), label: Label::plain(&format!("{}, ", located.word())).then(value) }
}

/// What is swept, by its symbol.
pub(crate) fn swept(study: &Study, name: &str) -> Label {
    let symbols: Vec<(&str, &str)> =
        study.symbols.iter().map(|(name, symbol)| (&**name, &**symbol)).collect();
    Label::name(name, &symbols)
}

/// What is swept, as an axis.
fn shown(study: &Study, axis: &SweptAxis) -> Axis {
    let name = swept(study, &axis.name);
    if !is_wide(axis) {
        return Axis::new(name, &axis.unit);
    }
    let unit =
        if axis.unit.is_empty() { Label::default() } else { Label::plain("/").then(Label::unit(&axis.unit)) };
    Axis::new(Label::plain("lg ").then(name).then(unit), "")
}

/// What is asked for, as an axis.
fn asked(study: &Study, question: &Question) -> Axis {
    figures::axis(study, std::slice::from_ref(&question.that))
}

fn title(study: &Study, question: &Question) -> Label {
    Label::markup(&study.title).then(Label::plain(": ")).then(called(study, question))
}

/// What is asked for, in words: `the greatest angle θ`; by the scene's name too where others are asked for in the same words.
pub(crate) fn called(study: &Study, question: &Question) -> Label {
    let words = in_words(study, question);
    let alike = study.finds.iter().filter(|other| in_words(study, other) == words);
    if alike.count() > 1 {
        words.then(Label::plain(&format!(" ({})", spoken(&question.name))))
    } else {
        words
    }
}

/// What is asked for, by the instants: of questions that follow on each other, those at one.
pub(crate) fn at_once(study: &Study) -> impl Iterator<Item = &[Question]> {
    let are_at_once = |one: &Question, other: &Question| match (&one.at, &other.at) {
        (When::At(a), When::At(b)) => a.text == b.text && one.side == other.side,
        _ => false,
    };
    study.finds.chunk_by(are_at_once).flat_map(|questions| questions.chunks(MOST_AT_ONCE))
}

/// What is looked at, without when.
pub(crate) fn that(study: &Study, question: &Question) -> Label {
    symbols::called(study, &symbols::all(study), &question.that.text)
}

/// Whether parameters alone say what is asked for, at any time.
pub(crate) fn is_given(study: &Study, question: &Question) -> bool {
    let parameters = study.model.parameters.symbols();
    question.that.quantity.formula.symbols().iter().all(|symbol| parameters.contains(symbol))
}

fn in_words(study: &Study, question: &Question) -> Label {
    let that = that(study, question);
    match question.at {
        _ if is_given(study, question) => that,
        When::Extreme { which: Extreme::Greatest, .. } => Label::plain("the greatest ").then(that),
        When::Extreme { which: Extreme::Least, .. } => Label::plain("the least ").then(that),
        When::End => that.then(Label::plain(" at the end")),
        When::At(_) => Label::plain(&format!("{}: ", spoken(&question.name))).then(that),
    }
}

fn name(question: &Question) -> String {
    format!("find.{}", question.name)
}

/// The answers over two parameters: the first upwards, the second to the right.
pub(crate) fn maps(study: &Study, survey: &Survey) -> Vec<(String, MapFigure)> {
    let [outer, inner] = &survey.axes[..] else { return vec![] };
    let is_large = [outer, inner].iter().all(|axis| axis.values.len() >= LEAST && axis.is_ordered());
    if !is_large || survey.answers.is_empty() {
        return vec![];
    }
    let map = |(index, question): (usize, &Question)| {
        let value = |answers: &Vec<Option<Sample>>| {
            answers.get(index).copied().flatten().map_or(f64::NAN, |s| s.value)
        };
        let cells: Vec<f64> = survey.answers.iter().map(value).collect();
        let place = |cell: usize| [cell % inner.values.len(), cell / inner.values.len()];
        let figure = MapFigure {
            title: title(study, question),
            x: shown(study, inner),
            y: shown(study, outer),
            z: asked(study, question),
            columns: inner.values.iter().map(|value| on(inner, *value)).collect(),
            rows: outer.values.iter().map(|value| on(outer, *value)).collect(),
            marked: best(question, &cells).map(place).into_iter().collect(),
            cells,
        };
        (name(question), figure)
    };
    let is_seen = |(_, figure): &(String, MapFigure)| figure.cells.iter().any(|value| value.is_finite());
    study.finds.iter().enumerate().map(map).filter(is_seen).collect()
}

/// The cell of the greatest value, or of the least where the least is asked for.
pub(crate) fn best(question: &Question, cells: &[f64]) -> Option<usize> {
    let least = matches!(&question.at, When::Extreme { which: Extreme::Least, .. });
    let sign = if least { -1.0 } else { 1.0 };
    let known = cells.iter().enumerate().filter(|(_, value)| value.is_finite());
    known.max_by(|a, b| (sign * a.1).total_cmp(&(sign * b.1))).map(|(cell, _)| cell)
}
