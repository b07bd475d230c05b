//! Figures of a report.

use super::prose::Text;
use tumble_drawing::curves::CurveFigure;
use tumble_drawing::svg::Svg;

/// What a mark says where digits end.
pub(crate) const END_OF_DIGITS: &str = "verified digits end";

/// A drawing that stands as it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The drawing; its title and description are read by screen readers.
    pub svg: Svg,
    /// Caption below it; may be empty.
    pub caption: Text,
    /// Path of a file with the drawing, relative to the report, for Markdown; may be empty.
    pub file: String,
}

impl Picture {
    /// A drawing with its caption.
    pub fn new(svg: Svg, caption: impl Into<Text>) -> Self {
        Self { svg, caption: caption.into(), file: String::new() }
    }

    /// With the path of a file that holds it, relative to the report.
    pub fn stored(mut self, file: impl Into<String>) -> Self {
        self.file = file.into();
        self
    }
}

/// Curves that readers can look into.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chart {
    /// The curves in their figure.
    pub figure: CurveFigure,
    /// Caption below it; may be empty.
    pub caption: Text,
    /// What the curves show, for those who cannot see them; if empty, ranges and end values are listed.
    pub description: String,
    /// Whether the horizontal axis is the time of the run in seconds: then
    /// its cursor goes with those of the other plots and the animation.
    pub over_time: bool,
    /// Path of a file with the figure, relative to the report, for Markdown; may be empty.
    pub file: String,
}

impl Chart {
    /// Curves over the time in seconds.
    pub fn over_time(figure: CurveFigure, caption: impl Into<Text>) -> Self {
        Self { figure, caption: caption.into(), over_time: true, ..Self::default() }
    }

    /// Curves over anything else.
    pub fn new(figure: CurveFigure, caption: impl Into<Text>) -> Self {
        Self { figure, caption: caption.into(), ..Self::default() }
    }

    /// With the path of a file that holds the figure, relative to the report.
    pub fn stored(mut self, file: impl Into<String>) -> Self {
        self.file = file.into();
        self
    }
}
