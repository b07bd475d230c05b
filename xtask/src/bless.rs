//! `cargo xtask bless`: regenerates what is committed but computed.

use anyhow::Result;
use clap::ValueEnum;

use crate::references;
use crate::steps::Step;
use crate::workspace::{Workspace, copy};

/// What can be regenerated.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum Part {
    /// The snapshots of the tests.
    Snapshots,
    /// The figures in docs/images.
    Figures,
    /// The equations of the gallery in docs/equations.md.
    Equations,
    /// The reference numbers of the scripts in references/.
    References,
}

/// Figures that documents show: the name below the gallery, the name in docs/images.
const FIGURES: &[(&str, &str)] = &[
    ("01-pendulum-in-the-wind/theta.svg", "wind-pendulum.svg"),
    ("02-thrown-rod/flight.svg", "thrown-rod.svg"),
    ("05-shuttlecock/flight.svg", "shuttlecock.svg"),
    ("06-curve-ball/path.svg", "curve-ball.svg"),
    ("07-measured-gust/theta.svg", "measured-gust.svg"),
    ("03-bouncing-rod/contact.svg", "bouncing-rod.svg"),
    ("08-rigid-rod/bounces.svg", "rigid-rod.svg"),
    ("09-bouncing-ball/height.svg", "bouncing-ball.svg"),
    ("10-falling-rod/forces.svg", "falling-rod.svg"),
    ("11-double-pendulum/path.svg", "double-pendulum.svg"),
    ("12-bullet-in-a-rod/swing.svg", "bullet.svg"),
    ("13-four-bar-linkage/linkage.svg", "four-bar-linkage.svg"),
    ("14-sliding-ladder/fall.svg", "sliding-ladder.svg"),
    ("15-falling-chain/fall.svg", "falling-chain.svg"),
    ("16-bench-on-three-feet/bench.svg", "bench.svg"),
    ("17-block-on-a-slope/block.svg", "block-on-a-slope.svg"),
    ("18-backspin/path.svg", "backspin.svg"),
    ("19-bowling-ball/speeds.svg", "bowling-ball.svg"),
    ("20-rolling-down/disk.svg", "rolling-down.svg"),
    ("21-rough-floor/bounces.svg", "rough-floor.svg"),
    ("22-newtons-cradle/angles.svg", "newtons-cradle.svg"),
    ("23-three-balls-at-once/places.svg", "three-balls.svg"),
    ("24-glancing-disks/path.svg", "glancing-disks.svg"),
    ("25-pool-break/corners.svg", "pool-break.svg"),
    ("26-ball-in-a-bowl/ball.svg", "ball-in-a-bowl.svg"),
    ("27-rocking-block/block.svg", "rocking-block.svg"),
    ("28-painleve-rod/force.svg", "painleve-rod.svg"),
    ("29-dropped-rod/impact.run-002.svg", "dropped-rod.svg"),
];

/// The steps for the parts named, or for all of them.
pub(crate) fn steps(parts: &[Part]) -> Vec<Step> {
    let chosen = if parts.is_empty() { Part::value_variants() } else { parts };
    chosen.iter().map(|&part| step(part)).collect()
}

fn step(part: Part) -> Step {
    match part {
        Part::Snapshots => Step { name: "snapshots", run: snapshots },
        Part::Figures => Step { name: "figures", run: figures },
        Part::Equations => Step { name: "equations", run: equations },
        Part::References => Step { name: "references", run: references::write },
    }
}

fn snapshots(workspace: &Workspace) -> Result<()> {
    let tests = workspace.cargo(["test", "--workspace", "--locked", "--no-fail-fast"]);
    tests.env("INSTA_UPDATE", "always").run()
}

fn figures(workspace: &Workspace) -> Result<()> {
    let gallery = workspace.empty_scratch("figures")?;
    let tumble = ["run", "--release", "--locked", "--package", "tumble", "--", "gallery", "--out"];
    workspace.cargo(tumble).arg(&gallery).run()?;
    FIGURES
        .iter()
        .try_for_each(|(from, to)| copy(&gallery.join(from), &workspace.path("docs/images").join(to)))
}

fn equations(workspace: &Workspace) -> Result<()> {
    let example = ["run", "--release", "--locked", "--package", "tumble-report", "--example", "equations"];
    workspace.cargo(example).run()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_when_nothing_is_named() {
        assert_eq!(steps(&[]).len(), 4);
        assert_eq!(steps(&[Part::Figures])[0].name, "figures");
    }
}
