//! The runs of a study, made on several cores and told of in order.

use tumble_report::results::{Case, CaseError, Combinations, Located, Missing, Surveyor};
use tumble_scene::Study;

use crate::jobs;
use crate::pipeline::{Options, PipelineError};
use crate::progress::Progress;

/// Makes the runs of a study on so many cores as the options say, and has each that was made kept, in order: what `done` made of
/// it. What comes out does not depend on the number of cores: of several runs that fail the first is told.
///
/// The runs that were not made, because no more were wanted.
pub(crate) fn all<T: Send>(
    study: &Study,
    options: &Options,
    done: impl Fn(Case) -> Result<T, PipelineError> + Sync,
    mut keep: impl FnMut(T) -> Result<(), PipelineError> + Send,
) -> Result<Vec<Missing>, PipelineError> {
    let all = Combinations::of(study)?;
    let progress = Progress::new(&study.title, all.count(), options);
    let make = |index: usize| {
        let motion = progress.of_run();
        let case = Case::run(&all, index, |time, until| motion.reached(time, until))?;
        let kept = done(case)?;
        progress.finish();
        Ok::<_, PipelineError>(kept)
    };
    let (mut count, mut missing, mut failed) = (0, vec![], None);
    jobs::in_order(all.count(), options.jobs, make, |index, run| match run {
        _ if failed.is_some() => {}
        Some(Ok(run)) => {
            count += 1;
            failed = keep(run).err();
        }
        // One after the other it would not have been begun.
        Some(Err(error)) if !error.is_interruption() && missing.is_empty() => failed = Some(error),
        _ => missing.push(Missing { number: index + 1, label: all.label(index) }),
    });
    match failed {
        Some(error) => Err(error),
        None if count == 0 => Err(CaseError::Interrupted.into()),
        None => Ok(missing),
    }
}

/// Where the answers of a sweep are greatest and least, with more runs between those that were made; none of it where no more were
/// wanted.
pub(crate) fn located(
    study: &Study,
    options: &Options,
    surveyor: &Surveyor,
) -> Result<Vec<Located>, PipelineError> {
    let all = Combinations::of(study)?;
    let progress = Progress::new(&study.title, surveyor.targets(), options);
    let locate = |target: usize| {
        let motion = progress.of_run();
        let found = surveyor.locate(&all, target, |time, until| motion.reached(time, until))?;
        progress.finish();
        Ok::<_, PipelineError>(found)
    };
    let (mut located, mut error) = (vec![], None);
    jobs::in_order(surveyor.targets(), options.jobs, locate, |_, found| match found {
        Some(Ok(found)) => located.extend(found),
        Some(Err(failed)) => error = error.take().or(Some(failed)),
        None => {}
    });
    match error {
        None => Ok(located),
        Some(error) if error.is_interruption() => Ok(vec![]),
        Some(error) => Err(error),
    }
}
