//! Answers as lines of text, from one process to another.

use super::measure::{Answer, Measured};

const REFUSED: &str = "refused ";
const BROKEN: &str = "broken ";
const KNOWN: &str = "known";
/// Where there is no number.
const NOTHING: &str = "-";

/// The lines of what was measured.
pub(crate) fn write(measured: &Measured) -> String {
    let one_line = |text: &str| text.replace('\n', " ");
    match measured {
        Measured::Answers(answers) => answers.iter().map(line).collect(),
        Measured::Refused(reason) => format!("{REFUSED}{}", one_line(reason)),
        Measured::Broken(reason) => format!("{BROKEN}{}", one_line(reason)),
    }
}

fn line(answer: &Answer) -> String {
    let number = |value: Option<f64>| value.map_or(NOTHING.to_owned(), |value| format!("{value:e}"));
    let known = if answer.is_known { KNOWN } else { NOTHING };
    format!("{} {} {known}\n", number(answer.value), number(answer.stated))
}

/// What the lines say; `None` where they are of something else.
pub(crate) fn read(text: &str) -> Option<Measured> {
    if let Some(reason) = text.strip_prefix(REFUSED) {
        return Some(Measured::Refused(reason.trim().to_owned()));
    }
    if let Some(reason) = text.strip_prefix(BROKEN) {
        return Some(Measured::Broken(reason.trim().to_owned()));
    }
    text.lines().map(answer).collect::<Option<_>>().map(Measured::Answers)
}

fn answer(line: &str) -> Option<Answer> {
    let mut words = line.split(' ');
    let mut number = || match words.next()? {
        NOTHING => Some(None),
        word => word.parse().ok().map(Some),
    };
    let (value, stated) = (number()?, number()?);
    Some(Answer { value, stated, is_known: words.next()? == KNOWN })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_come_back_to_the_last_bit() {
        let answers = vec![
            Answer { value: Some(0.1), stated: Some(1e-300), is_known: true },
            Answer { value: None, stated: None, is_known: false },
        ];
        let back = read(&write(&Measured::Answers(answers.clone())));
        assert!(matches!(back, Some(Measured::Answers(same)) if same == answers));
        let refused = read(&write(&Measured::Refused("no\nway".into())));
        assert!(matches!(refused, Some(Measured::Refused(reason)) if reason == "no way"));
        assert!(read("thread panicked").is_none());
    }
}
