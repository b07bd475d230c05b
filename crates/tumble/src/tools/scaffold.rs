//! Short texts made scenes, for tests.

/// What short texts leave out.
const SCAFFOLD: &str = "version = 1\nworld.gravity = \"9.81 m/s^2\"\nrun.until = \"5 s\"\n\
    [body.rod]\nrod = { from = [0, 0], to = [0, \"-1 m\"] }\nmass = \"1 kg\"\npoints.tip = [0, \"-1 m\"]";

/// The text with every section that a scene needs and it does not have.
pub(super) fn completed(text: &str) -> String {
    tumble::gallery::completed(text, SCAFFOLD)
}
