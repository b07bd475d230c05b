//! Where what the model and the run speak of stands in the file, and what they find wrong at its place.

use std::collections::BTreeMap;

use tumble_mech::{ModelError, ModelWarning};
use tumble_ode::Reason;

use crate::code::Code;
use crate::diagnostic::{Diagnostic, Span};

/// Where things stand that only numbers can prove wrong, by what messages call them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Places(BTreeMap<String, Span>);

impl Places {
    pub(crate) fn remember(&mut self, what: impl Into<String>, span: &Span) {
        self.0.insert(what.into(), span.clone());
    }

    pub(crate) fn get(&self, what: &str) -> Option<&Span> {
        self.0.get(what)
    }

    /// Where something stands; at least where its section does, or that of what it is a part of.
    fn find(&self, what: &str) -> Option<&Span> {
        let names = what.split('`').skip(1).step_by(2);
        self.get(what)
            .or_else(|| names.into_iter().find_map(|name| self.owner(name).or_else(|| self.get(name))))
    }

    /// The section of the longest part of a name such as `floor.rod.tip` that has one.
    fn owner(&self, name: &str) -> Option<&Span> {
        let ends = name.rmatch_indices('.').map(|(dot, _)| dot);
        let parts = std::iter::once(name).chain(ends.map(|end| &name[..end]));
        let section =
            |part: &str| self.get(&format!("body `{part}`")).or_else(|| self.get(&format!("`{part}`")));
        parts.into_iter().find_map(section)
    }

    /// Something that is said of what messages call so.
    pub(crate) fn about(&self, code: Code, what: &str, message: impl Into<String>) -> Diagnostic {
        match self.find(what) {
            Some(span) => Diagnostic::new(code, span.clone(), message),
            None => Diagnostic::new(code, 0..0, message).nowhere(),
        }
    }

    /// A mistake that the model finds.
    pub(crate) fn mistake(&self, error: &ModelError) -> Diagnostic {
        let message = error.to_string();
        let about = |code, what: &str| self.about(code, what, message.clone());
        match error {
            ModelError::Window { load, .. } => about(Code::Window, &format!("times of `{load}`"))
                .label("ends before it begins")
                .help("write `during = [start, end]`"),
            ModelError::PointTurned { body, load } => about(Code::PointTurned, &format!("`{load}`"))
                .label("turns it")
                .help(format!("let it act at \"{body}.cm\", or give `{body}` an extent, such as `ball`")),
            ModelError::HeldTwice { first, second, .. } => self.held_twice(first, second, &message),
            ModelError::Start { body, .. } => {
                about(Code::Start, &format!("start of `{body}`")).label("does not fit the body")
            }
            ModelError::Inside { body, depth, .. } => about(Code::Inside, &format!("start of `{body}`"))
                .label("inside the surface")
                .help(format!("start it {depth} m farther out, or a little more")),
            ModelError::InEachOther { first, depth, .. } => about(Code::Inside, &format!("start of `{first}`"))
                .label("inside the other")
                .help(format!("start them {depth} m farther apart, or a little more")),
            ModelError::Contact { contact, cure, .. } => {
                about(Code::Model, &format!("`{contact}`")).label("cannot be").help(*cure)
            }
            ModelError::NoForce { load, .. } => about(Code::NoForce, &format!("`{load}`"))
                .label("has no value at the start")
                .help("look for a division by what is zero at the start, a root of what is negative, or a table outside its range"),
            ModelError::Jumps { load, .. } => self.by_load(load, &message).label("jumps").help(
                "let it act `during` two times or events, or make it go from one value to the other within a short time",
            ),
            ModelError::PlaceByForces { load, .. } => self.by_load(load, &message).label("acts at such a place"),
            ModelError::NoSpan { load } => about(Code::NoSpan, &format!("`{load}`"))
                .label("of no length at the start")
                .help("start the bodies apart; only a spring of no rest length and no damping may have no length"),
            ModelError::JointOpen { joint, .. } => about(Code::JointOpen, &format!("joint `{joint}`"))
                .label("apart at the start")
                .help("start the bodies where the joint holds, leave out `at` of one of them, or write `assemble = true`"),
            ModelError::JointMoves { joint, .. } => about(Code::JointOpen, &format!("joint `{joint}`"))
                .label("coming apart at the start")
                .help("give its bodies velocities that fit, leave out `velocity` of one of them, or write `assemble = true`"),
            ModelError::JointsDoNotClose { joints, .. } => {
                let first = joints.first().map(String::as_str).unwrap_or_default();
                about(Code::JointsDoNotClose, &format!("joint `{first}`"))
                    .label("does not close")
                    .help("are the lengths such that a loop can close? Start nearer to the pose that is meant")
            }
            ModelError::AfterEvent { event, mistake } => self.after_event(event, mistake, &message),
            other => self.about_value(other, &message),
        }
    }

    /// What is wrong with a load where loads depend on forces of contacts and joints.
    fn by_load(&self, load: &str, message: &str) -> Diagnostic {
        let stated = ["force", "torque"].map(|what| format!("{what} of `{load}`"));
        let place = stated.iter().find(|what| self.get(what).is_some()).unwrap_or(&stated[0]);
        self.about(Code::ByForces, place, message)
    }

    /// A value that cannot be.
    fn about_value(&self, error: &ModelError, message: &str) -> Diagnostic {
        let what = error.what().unwrap_or_default();
        let about = |code| self.about(code, what, message);
        match error {
            ModelError::NotPositive { .. } => about(Code::Value).label("must be positive"),
            ModelError::Negative { .. } => about(Code::Value).label("must not be negative"),
            ModelError::Restitution { .. } => about(Code::Value).label("from 0 to 1"),
            ModelError::StaticBelowKinetic { .. } => about(Code::Value)
                .label("less than the kinetic one")
                .help("write `friction = { static = 0.4, kinetic = 0.3 }`, or one number for both"),
            ModelError::TooSmall { .. } => about(Code::Value)
                .label("too small")
                .help("choose a unit in which the number is of ordinary size"),
            ModelError::Angle { most, .. } => about(Code::Value).label(format!("at most {most:e} rad")),
            ModelError::NotFinite { .. } => about(Code::NotFinite)
                .label("not a finite number")
                .help("look for a division by zero, a root of a negative number, or a number beyond 1.8e308"),
            ModelError::NoDirection { .. } => {
                about(Code::NoDirection).label("points nowhere").help("write a vector of any length but zero")
            }
            ModelError::NoRoom { .. } => about(Code::Value)
                .label("too small")
                .help("make the bowl larger, or what moves in it smaller; from outside a circle is met without `inside = true`"),
            ModelError::NotConvex { .. } => about(Code::Value)
                .label("not convex")
                .help("make it of convex parts: `parts = [..]` of a body, a surface each of what is fixed"),
            ModelError::Flat { .. } => about(Code::Value)
                .label("no area, or a side of no length")
                .help("list each corner once; what has no area is a `rod` among bodies"),
            ModelError::Clockwise { .. } => {
                about(Code::Value).label("clockwise").help("list the corners the other way round")
            }
            ModelError::NoInertia { .. } => about(Code::NoInertia)
                .label("about its own centre")
                .help("hold the body at another point, or give it an extent, such as `ball`"),
            _ => about(Code::Model),
        }
    }

    fn held_twice(&self, first: &str, second: &str, message: &str) -> Diagnostic {
        let mistake = self.about(Code::HeldTwice, &format!("pivot `{second}`"), message).label("held again");
        let mistake = match self.get(&format!("pivot `{first}`")) {
            Some(span) => mistake.also(span.clone(), "held first"),
            None => mistake,
        };
        mistake.help("a body that is held at two points cannot move: leave one of them out")
    }

    /// The mistake where the event sets what makes it, with the place of what is wrong then.
    fn after_event(&self, event: &str, mistake: &ModelError, message: &str) -> Diagnostic {
        let then = self.mistake(mistake);
        let set = self.about(then.code, &format!("settings of `{event}`"), message).label("set here");
        let set = match then.labels.into_iter().next() {
            Some(label) => set.also(label.span, label.text),
            None => set,
        };
        set.help("what an event sets has to be possible as at the start")
    }

    /// Something that is possible and most often a slip.
    pub(crate) fn warning(&self, warning: &ModelWarning) -> Diagnostic {
        let (code, what, label, help) = match warning {
            ModelWarning::Speed { body, .. } => (
                Code::Fast,
                format!("start of `{body}`"),
                "faster than a third of light",
                "is a unit or an exponent wrong?",
            ),
            ModelWarning::MassRatio { light, .. } => (
                Code::MassRatio,
                format!("mass of `{light}`"),
                "the lighter one",
                "is a unit or an exponent wrong? What the lighter body does to the heavier is lost by rounding",
            ),
            ModelWarning::Overlap { second, .. } => (
                Code::Overlap,
                format!("start of `{second}`"),
                "starts in the other",
                "start them apart, join them if they are one, or let them meet by a `[contact.NAME]`",
            ),
        };
        self.about(code, &what, warning.to_string()).label(label).help(help).warning()
    }

    /// Why a motion stopped, at the place of what stopped it.
    pub(crate) fn refusal(&self, reason: &Reason, message: &str) -> Diagnostic {
        let (what, label) = match reason {
            Reason::OutsideTable { table, .. } => (format!("`{table}`"), "not measured there"),
            Reason::Sliding { guard } => (format!("`{guard}`"), "zero, and stays there"),
            Reason::NotFinite { state } | Reason::BadStart { state, .. } | Reason::Stalled { state, .. } => {
                (format!("`{state}`"), "its motion")
            }
            Reason::Model(said) => (said.clone(), ""),
            _ => ("until".to_owned(), "not reached"),
        };
        let refused = match self.find(&what) {
            Some(_) => self.about(Code::Refused, &what, message).label(label),
            None => self.about(Code::Refused, "until", message).label("not reached"),
        };
        match reason {
            Reason::OutsideTable { .. } => refused.help("measure farther, or write `outside = \"hold\"`"),
            Reason::Beyond { .. } => refused
                .help("a fault of the program, not of the scene: started a little differently, it may go on"),
            _ => refused,
        }
    }
}
