//! Scenes to begin with: what each shows, and its text. `tumble new` writes them, and the page of a gallery offers them.

/// In the order in which they are offered.
pub const TEMPLATES: [(&str, &str); 5] = [
    ("A rod that swings on a hinge", include_str!("tools/templates/pendulum.toml")),
    ("A ball that is thrown through the air", include_str!("tools/templates/throw.toml")),
    ("A ball that bounces on the floor", include_str!("tools/templates/bounce.toml")),
    ("A ball that is kicked off-centre, seen from above", include_str!("tools/templates/kick.toml")),
    ("The least that a scene needs", include_str!("tools/templates/empty.toml")),
];
