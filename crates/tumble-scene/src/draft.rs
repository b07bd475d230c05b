//! A scene while it is being read: what is known so far, and every mistake so far.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::sync::Arc;

use tumble_expr::Expr;
use tumble_mech::{Equations, Model};
use tumble_ode::Accuracy;

use crate::diagnostic::{Diagnostic, Diagnostics, SourceText, Span};
use crate::formula::Text;
use crate::names::{ACCURACY, Names};
use crate::places::Places;
use crate::play::{Asked, Play, Preset, StartValue};
use crate::quantities;
use crate::sections::functions;
use crate::settings::{Override, Setting};
use crate::study::{BalancePlot, Check, Commentary, FreeBody, Plot, Question, Said, Stroboscope, Study};
use crate::sweep::{SweepAxis, Swept};

/// A study that may still have holes.
#[derive(Default)]
pub(crate) struct Draft {
    pub(crate) sources: Vec<SourceText>,
    pub(crate) mistakes: Vec<Diagnostic>,
    pub(crate) warnings: Vec<Diagnostic>,
    pub(crate) settings: Vec<Setting>,
    pub(crate) names: Names,
    /// Where things stand that only numbers can prove wrong, by what messages call them.
    pub(crate) places: Places,
    /// The name of each figure, which is that of a file, and where it stands; by its letters whatever their case.
    pub(crate) figures: BTreeMap<String, (String, Span)>,
    pub(crate) title: String,
    pub(crate) texts: Vec<Commentary>,
    pub(crate) horizontal: bool,
    pub(crate) model: Model,
    pub(crate) until: Option<Expr>,
    pub(crate) accuracy: Accuracy,
    pub(crate) output_every: Option<Expr>,
    pub(crate) plots: Vec<Plot>,
    pub(crate) stroboscopes: Vec<Stroboscope>,
    pub(crate) balances: Vec<BalancePlot>,
    pub(crate) free_bodies: Vec<FreeBody>,
    pub(crate) finds: Vec<Question>,
    pub(crate) checks: Vec<Check>,
    pub(crate) equilibrium: bool,
    pub(crate) symbols: BTreeMap<String, String>,
    pub(crate) meanings: BTreeMap<String, String>,
    pub(crate) sweep: Vec<SweepAxis>,
    /// Parameters in the order of the scene, each with the formula that it has.
    pub(crate) parameter_texts: Vec<(String, String)>,
    /// What bodies start from, by components.
    pub(crate) starts: Vec<StartValue>,
    /// What `[play]` asks for.
    pub(crate) asked_to_play: Vec<Asked>,
    pub(crate) presets: Vec<Preset>,
    pub(crate) play: Play,
    /// Once it is known that the model has some.
    pub(crate) equations: Option<Equations>,
    /// Parameters that are angles, or angles per time.
    pub(crate) angular: BTreeSet<String>,
    /// What the files of the scene's tables hold, by their names there.
    pub(crate) files: BTreeMap<String, io::Result<Vec<u8>>>,
}

/// Values of a sweep that a range is taken from.
const MOST_SWEPT: usize = 100;

/// Mistakes of a scene that has more are mostly echoes of each other, and each costs the time to find its cure.
const MOST_MISTAKES: usize = 200;

impl Draft {
    /// Whether there are so many mistakes that more would help nobody.
    pub(crate) fn is_full(&self) -> bool {
        self.mistakes.len() >= MOST_MISTAKES
    }

    /// A draft of which only the texts are known.
    pub(crate) fn begin(name: &str, text: &str, overrides: &[Override]) -> Self {
        let scene = SourceText { name: name.to_owned(), text: text.to_owned() };
        let mut draft = Self {
            sources: std::iter::once(scene).chain(overrides.iter().map(Override::source)).collect(),
            settings: overrides.iter().enumerate().map(|(at, set)| set.setting(at + 1)).collect(),
            ..Self::default()
        };
        quantities::define_time(&mut draft.names);
        draft
    }

    /// What the command line puts in the place of a value, the last of several.
    pub(crate) fn setting(&self, name: &str) -> Option<Text> {
        self.settings.iter().rev().find(|setting| setting.name == name).map(|setting| setting.text.clone())
    }

    /// The values that a sweep gives a parameter, SI units.
    pub(crate) fn swept(&self, name: &str) -> Vec<f64> {
        let axis = self.sweep.iter().find(|axis| axis.of == Swept::Parameter(name.to_owned()));
        let Some(axis) = axis else { return vec![] };
        let values: Vec<Expr> = axis.values.iter().take(MOST_SWEPT).map(|value| value.value).collect();
        self.model.parameters.evaluate(&values).unwrap_or_default()
    }

    /// The study, if nothing is wrong with it.
    pub(crate) fn finish(self) -> Result<Study, Diagnostics> {
        match (self.until, self.equations) {
            (Some(until), Some(equations)) if self.mistakes.is_empty() => Ok(Study {
                equations,
                quantities: quantities::all(&self.names),
                functions: functions::of_time(&self.names),
                title: self.title,
                texts: self.texts,
                model: self.model,
                angles: self.angular,
                until,
                accuracy: self.accuracy,
                output_every: self.output_every,
                plots: self.plots,
                stroboscopes: self.stroboscopes,
                balances: self.balances,
                free_bodies: self.free_bodies,
                finds: self.finds,
                checks: self.checks,
                equilibrium: self.equilibrium,
                symbols: self.symbols,
                meanings: self.meanings,
                sweep: self.sweep,
                is_set: self.settings.iter().any(|setting| setting.name != ACCURACY),
                play: self.play,
                said: Said {
                    sources: self.sources.into(),
                    places: Arc::new(self.places),
                    warnings: self.warnings,
                },
            }),
            _ => Err(Diagnostics::new(self.sources, self.mistakes)),
        }
    }
}
