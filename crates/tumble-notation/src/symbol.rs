//! From names as scenes spell them to letters and subscripts, by the rules that figures follow.

/// Names of Greek letters, each before its letter. Those that look Latin are left out.
const GREEK: &str = "alpha α beta β gamma γ delta δ epsilon ε zeta ζ eta η theta θ iota ι kappa κ lambda λ mu μ nu ν \
    xi ξ pi π rho ρ sigma σ tau τ upsilon υ phi φ chi χ psi ψ omega ω Gamma Γ Delta Δ Theta Θ Lambda Λ Xi Ξ Pi Π \
    Sigma Σ Upsilon Υ Phi Φ Psi Ψ Omega Ω";

/// The last parts of names such as `rod.tip.vx` that are a letter with its component, or a word for a letter.
const MOTION: [(&str, &str, &str); 9] = [
    ("vx", "v", "x"),
    ("vy", "v", "y"),
    ("ax", "a", "x"),
    ("ay", "a", "y"),
    ("fx", "F", "x"),
    ("fy", "F", "y"),
    ("angle", "θ", ""),
    ("torque", "τ", ""),
    ("energy", "E", ""),
];

/// Most letters of a word that stands for a quantity, such as `dt`; longer words are words.
const LETTERS_OF_A_QUANTITY: usize = 2;

/// A letter or word, and what belongs below the line.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Identifier {
    /// The main letter, Greek already replaced, or a word.
    pub head: String,
    /// Parts of the subscript, shown with commas between.
    pub subscript: Vec<String>,
    /// Never in italics: names of functions, the base of natural logarithms.
    pub upright: bool,
}

impl Identifier {
    /// Takes a name apart: `omega0` is ω with subscript 0, `v_max` is v with subscript max, `rod.tip.vx` is v with
    /// subscripts x and rod.tip.
    pub fn parse(name: &str) -> Self {
        let owned = name.rsplit_once('.').filter(|(owner, last)| !owner.is_empty() && !last.is_empty());
        let Some((owner, last)) = owned else { return Self::simple(name) };
        let mut identifier = match MOTION.iter().find(|(known, ..)| *known == last) {
            Some((_, head, component)) => Self::of(head, &[component]),
            None => Self::simple(last),
        };
        identifier.subscript.push(owner.to_owned());
        identifier
    }

    /// A name that stands upright.
    pub fn upright(name: &str) -> Self {
        Self { upright: true, ..Self::of(name, &[]) }
    }

    fn of(head: &str, subscript: &[&str]) -> Self {
        let parts = subscript.iter().filter(|part| !part.is_empty());
        Self {
            head: head.to_owned(),
            subscript: parts.map(|part| (*part).to_owned()).collect(),
            upright: false,
        }
    }

    fn simple(name: &str) -> Self {
        if let Some((head, subscript)) = name.split_once('_').filter(|(h, s)| !h.is_empty() && !s.is_empty())
        {
            let subscript: Vec<&str> = subscript.split(['_', ',']).map(greek).collect();
            return Self::of(greek(head), &subscript);
        }
        let head = name.trim_end_matches(|c: char| c.is_ascii_digit());
        if head.is_empty() {
            return Self::of(name, &[]);
        }
        Self::of(greek(head), &[&name[head.len()..]])
    }

    /// Whether the main part is set in italics.
    pub fn is_italic(&self) -> bool {
        !self.upright && is_quantity(&self.head)
    }

    /// The subscript as one text; empty if there is none.
    pub fn subscript_text(&self) -> String {
        self.subscript.join(",")
    }
}

/// Whether a part of a subscript is a letter of its own, set in italics.
pub fn is_letter(part: &str) -> bool {
    is_quantity(part) && part.chars().count() == 1
}

/// Whether a word stands for a quantity and is set in italics.
pub(crate) fn is_quantity(word: &str) -> bool {
    word.chars().all(char::is_alphabetic) && word.chars().count() <= LETTERS_OF_A_QUANTITY
}

/// Greek letters with their names before them.
fn letters() -> impl Iterator<Item = (&'static str, &'static str)> {
    let mut words = GREEK.split_whitespace();
    std::iter::from_fn(move || Some((words.next()?, words.next()?)))
}

fn greek(name: &str) -> &str {
    letters().find(|(known, _)| *known == name).map_or(name, |(_, letter)| letter)
}

/// The name of a Greek letter.
pub(crate) fn greek_name(letter: &str) -> Option<&'static str> {
    letters().find(|(_, known)| *known == letter).map(|(name, _)| name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_letters_and_subscripts() {
        for (name, head, subscript) in [
            ("theta", "θ", ""),
            ("w1", "w", "1"),
            ("omega0", "ω", "0"),
            ("v_x", "v", "x"),
            ("I_cm", "I", "cm"),
            ("omega_rod_0", "ω", "rod,0"),
            ("mass", "mass", ""),
            ("42", "42", ""),
            ("_x", "_x", ""),
            ("F_air,x", "F", "air,x"),
            ("rod.angle", "θ", "rod"),
            ("rod.omega", "ω", "rod"),
            ("rod.x", "x", "rod"),
            ("rod.tip.vx", "v", "x,rod.tip"),
            ("air.drag1", "drag", "1,air"),
            (".x", ".x", ""),
            ("x.", "x.", ""),
            ("", "", ""),
        ] {
            let found = Identifier::parse(name);
            assert_eq!((found.head.as_str(), found.subscript_text().as_str()), (head, subscript), "{name}");
        }
    }

    #[test]
    fn short_names_are_italic_and_words_are_not() {
        assert!(Identifier::parse("dt").is_italic());
        assert!(Identifier::parse("theta").is_italic());
        assert!(!Identifier::parse("mass").is_italic());
        assert!(!Identifier::upright("e").is_italic());
    }

    #[test]
    fn letters_have_their_names_back() {
        assert_eq!(greek_name("θ"), Some("theta"));
        assert_eq!(greek_name("x"), None);
    }
}
