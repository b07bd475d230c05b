//! The kinds of mistakes a scene can have.

use tumble_expr::language;

tumble_expr::codes! {
    /// The kind of a mistake; prints as a short code that never changes its meaning.
    enum Code with Formula(language::Code);
    /// The file is not written in TOML.
    Toml = "E0501";
    /// A key that is given twice.
    DuplicateKey = "E0502";
    /// The file is not text in UTF-8.
    Encoding = "E0503";
    /// The file is larger than a scene may be.
    TooLarge = "E0504";
    /// The file is empty.
    Empty = "E0505";
    /// The version of the language is none that this program reads.
    Version = "E0506";
    /// A character that is not shown, in a text that is.
    Unseen = "E0507";
    /// A section that the language does not have.
    UnknownSection = "E0510";
    /// A key that its section does not have.
    UnknownKey = "E0511";
    /// A section that every scene needs is missing.
    MissingSection = "E0512";
    /// A key that its section needs is missing.
    MissingKey = "E0513";
    /// A value of another type than the key takes.
    WrongType = "E0514";
    /// A vector or list of the wrong length.
    Length = "E0515";
    /// A bare number where a quantity with its unit is wanted.
    BareNumber = "E0516";
    /// A number that is infinite or not a number.
    NotFinite = "E0517";
    /// A word other than those the key takes.
    Choice = "E0518";
    /// Keys that exclude each other.
    Exclusive = "E0519";
    /// A body that does not exist.
    UnknownBody = "E0520";
    /// A point that does not exist.
    UnknownPoint = "E0521";
    /// A name that is not spelled like one.
    NotAName = "E0522";
    /// A name that has another meaning.
    NameTaken = "E0523";
    /// Parameters that depend on each other in a circle.
    Cycle = "E0524";
    /// A value that is given before the run and depends on the motion.
    Changing = "E0525";
    /// A force that depends on an acceleration.
    Acceleration = "E0526";
    /// Curves of one figure that measure different things.
    UnlikeCurves = "E0527";
    /// An event in the place of a value.
    EventInFormula = "E0528";
    /// A condition of an event that is not written as one.
    When = "E0529";
    /// A number out of the range in which it makes sense.
    Value = "E0530";
    /// A span of time that ends before it begins.
    Window = "E0531";
    /// More samples than are sensible.
    TooMany = "E0532";
    /// A time outside of the run.
    OutsideRun = "E0533";
    /// An accuracy that cannot be asked for.
    Accuracy = "E0534";
    /// A body that is held twice.
    HeldTwice = "E0535";
    /// A body without moment of inertia that something turns.
    PointTurned = "E0536";
    /// A start that does not fit the body.
    Start = "E0537";
    /// A body that starts inside a surface.
    Inside = "E0539";
    /// The model is not in order.
    Model = "E0538";
    /// The setting of a parameter that does not exist.
    UnknownParameter = "E0540";
    /// A sweep that needs itself.
    SweepCycle = "E0541";
    /// Air resistance of a body that is not of the shape it is asked for.
    ShapeInAir = "E0542";
    /// A vector without length that has to point somewhere.
    NoDirection = "E0543";
    /// A pivot at the centre of a body that has no moment of inertia.
    NoInertia = "E0544";
    /// A load that is infinite or no number at the start.
    NoForce = "E0545";
    /// A spring whose ends are at one place at the start.
    NoSpan = "E0546";
    /// An event that does not exist.
    UnknownEvent = "E0547";
    /// A joint whose ends are not together at the start, or do not stay so.
    JointOpen = "E0548";
    /// Joints that no pose of their bodies closes.
    JointsDoNotClose = "E0549";
    /// A load that jumps while others depend on forces of contacts or joints otherwise than linearly.
    ByForces = "E0562";
    /// A file outside of the scene's folder.
    FilePath = "E0550";
    /// A file that cannot be read.
    FileRead = "E0551";
    /// A file that is not a table.
    FileTable = "E0552";
    /// A column that its file does not have.
    UnknownColumn = "E0553";
    /// A column that does not state its unit.
    ColumnUnit = "E0554";
    /// A cell that is not a number in its place.
    Cell = "E0555";
    /// A name that cannot be that of a file on every system.
    FileName = "E0556";
    /// A motion that cannot be begun, or not be continued.
    Refused = "E0560";
    /// A question that the motion has no answer to.
    NoAnswer = "E0561";
    /// A body that starts faster than mechanics without relativity allows.
    Fast = "W0601";
    /// Two masses of which the lighter is lost in the rounding error of the heavier.
    MassRatio = "W0602";
    /// A value of the motion that is infinite or no number.
    ValueOfRun = "W0603";
    /// A span of time that turned out to end before it begins.
    WindowOfRun = "W0604";
    /// Bodies that overlap at the start, where bodies do not meet each other.
    Overlap = "W0605";
    /// A run that was to end at rest and has not come to it.
    NoRest = "W0606";
    /// A pose of equilibrium that was asked for and not found.
    NoEquilibrium = "W0607";
    /// A joint or an impulse that waits for an event which does not happen.
    NeverComes = "W0608";
    /// Two quantities that are shown by the same symbol.
    ShownAlike = "W0609";
    /// A motion of rigid bodies with friction that might go on otherwise, or of which it was not looked at.
    OtherMotions = "W0610";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_unique_and_documented() {
        let mut seen = std::collections::HashSet::new();
        for code in Code::ALL {
            assert!(seen.insert(code.as_str()), "{code} twice");
            assert!(code.summary().ends_with('.'), "{code}: {}", code.summary());
        }
    }
}
