//! A short hunt with a fixed seed; `examples/fuzz.rs` is the long one.

#[path = "common/mutations.rs"]
mod mutations;

use mutations::{Corpus, Random, survives};

#[test]
fn scenes_with_slips_are_read_or_refused() {
    let corpus = Corpus::of_gallery().expect("the gallery");
    for seed in 0..3000 {
        let text = corpus.scene(&mut Random::new(seed));
        survives(&text, &corpus.files, seed.is_multiple_of(8));
    }
}
