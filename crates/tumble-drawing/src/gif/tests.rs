use super::*;
use crate::animation::MovingBody;
use crate::outline::{Outline, Pose};

fn pendulum() -> Animation {
    let times: Vec<f64> = (0..=60).map(|i| f64::from(i) / 30.0).collect();
    let pose = |t: &f64| {
        let angle = (3.0 * t).cos();
        Pose { t: *t, x: 0.5 * angle.sin(), y: -0.5 * angle.cos(), angle }
    };
    let poses = times.iter().map(pose).collect();
    let rod = Outline::Segment { from: [0.0, 0.5], to: [0.0, -0.5] };
    let body = MovingBody { outlines: vec![rod], poses, trail: true, ..MovingBody::default() };
    let motion = MovingCase { times, bodies: vec![body], ..MovingCase::default() };
    Animation { cases: vec![motion], speed: 1.0, ..Animation::default() }
}

fn decoded(bytes: &[u8]) -> (u16, Vec<Frame<'static>>) {
    let mut decoder = ::gif::Decoder::new(bytes).expect("a GIF");
    let width = decoder.width();
    let mut frames = Vec::new();
    while let Some(frame) = decoder.read_next_frame().expect("a frame") {
        frames.push(frame.clone());
    }
    (width, frames)
}

#[test]
fn it_lasts_as_long_as_the_motion_and_moves() {
    let bytes = animation_gif(&pendulum(), 0, 200, 15.0).expect("an animation");
    let (width, frames) = decoded(&bytes);
    assert_eq!((width, frames.len()), (200, 31));
    let shown: u32 = frames[..30].iter().map(|frame| u32::from(frame.delay)).sum();
    assert_eq!(shown, 200, "two seconds");
    assert!(
        frames[1..].iter().all(|frame| frame.width > 10 && frame.width < 200),
        "only what moves is drawn again"
    );
}

#[test]
fn it_says_whose_it_is() {
    let bytes = animation_gif(&pendulum(), 0, 120, 5.0).expect("an animation");
    let seals = bytes.windows(ANIMATION_SEAL.len()).filter(|part| *part == ANIMATION_SEAL.as_bytes());
    assert_eq!(seals.count(), 1);
}

#[test]
fn equal_motions_give_equal_bytes() {
    let gif = || animation_gif(&pendulum(), 0, 120, 5.0).expect("an animation");
    assert_eq!(gif(), gif());
}

#[test]
fn what_cannot_be_shown_is_refused() {
    let mut animation = pendulum();
    assert!(matches!(animation_gif(&animation, 1, 200, 15.0), Err(GifError::NoMotion { case: 1, cases: 1 })));
    assert!(matches!(animation_gif(&animation, 0, 5, 15.0), Err(GifError::Width(5))));
    assert!(matches!(animation_gif(&animation, 0, 200, f64::NAN), Err(GifError::Rate(_))));
    animation.speed = 1e-6;
    assert!(matches!(animation_gif(&animation, 0, 200, 15.0), Err(GifError::TooLong { .. })));
    animation.cases[0].bodies[0].poses.iter_mut().for_each(|pose| pose.x = f64::NAN);
    animation.speed = 1.0;
    assert!(matches!(animation_gif(&animation, 0, 200, 15.0), Err(GifError::NoMotion { .. })));
}

/// Frames laid over each other, as viewers do.
fn composed(bytes: &[u8]) -> Vec<u8> {
    let mut decoder = ::gif::Decoder::new(bytes).expect("a GIF");
    let palette = decoder.global_palette().expect("colours").to_vec();
    let (width, height) = (usize::from(decoder.width()), usize::from(decoder.height()));
    let mut page = vec![0u8; width * height];
    while let Some(frame) = decoder.read_next_frame().expect("a frame") {
        for (y, row) in frame.buffer.chunks(usize::from(frame.width)).enumerate() {
            let start = (usize::from(frame.top) + y) * width + usize::from(frame.left);
            page[start..start + row.len()].copy_from_slice(row);
        }
    }
    page.iter().flat_map(|i| palette[3 * usize::from(*i)..3 * usize::from(*i) + 3].to_vec()).collect()
}

#[test]
fn the_last_frame_is_the_end_of_the_motion() {
    let animation = pendulum();
    let shown = composed(&animation_gif(&animation, 0, 160, 10.0).expect("an animation"));
    let scene = frame::Scene::new(&animation.cases[0]).expect("a scene");
    let wanted = drawn(&scene.svg(2.0, 160.0), 1.0).expect("a picture").take();
    let wanted = wanted.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]);
    let differs = |(a, b): (&u8, u8)| a.abs_diff(b);
    assert_eq!(shown[..3], [u8::MAX; 3], "the white of the page stays");
    // Rare shades become near ones.
    assert!(shown.iter().zip(wanted).map(differs).max() < Some(48));
}
