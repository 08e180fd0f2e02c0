//! The time that simulating only what a scene calls for saves: every scene shaded with the effects
//! that it calls for, with every effect on, and with every effect forced to be evaluated.
//!
//! The three pictures are the same bit for bit, which is checked before anything is timed; only
//! then do they take turns, and medians of the rounds are printed. Visibility is not timed.

#[path = "../tests/it/called_for/scenes.rs"]
mod scenes;

use std::hint::black_box;
use std::io::{self, Write};
use std::time::Instant;
use truecast::color::LinearRgb;
use truecast::pixel::Window;
use truecast::raster::rasterize;
use truecast::scene::Scene;
use truecast::shade::{Effects, shade, shade_ungated};
use truecast::statistics::Statistics;
use truecast::visibility::{Counting, VisibilityBuffer};

/// Rounds per scene: an odd number, so that the median is one of them.
const ROUNDS: usize = 11;

/// Size of the pictures, in pixels.
const SIZE: (u32, u32) = (960, 540);

/// The ways to make the same picture.
const WAYS: [fn(&Scene, &VisibilityBuffer) -> Vec<LinearRgb>; 3] = [
    |scene, buffer| shade(scene, buffer, Effects::of(scene), &|| ()).radiance,
    |scene, buffer| shade(scene, buffer, Effects::ALL, &|| ()).radiance,
    shade_ungated,
];

fn main() -> io::Result<()> {
    let mut out = io::stdout().lock();
    writeln!(out, "shading at {}x{}, medians of {ROUNDS} rounds, in ms", SIZE.0, SIZE.1)?;
    writeln!(out, "scene                    called for     all on     forced   forced/called for")?;
    for (name, scene) in scenes::scenes(SIZE.0, SIZE.1) {
        let window: Window = scene.camera.resolution().window();
        let buffer = rasterize(&scene, window, Counting::Nearest, &|| ());
        let pictures = WAYS.map(|way| bits(way(&scene, &buffer)));
        assert!(pictures.iter().all(|picture| *picture == pictures[0]), "{name}: another picture");
        let mut times = [const { Vec::new() }; WAYS.len()];
        for _ in 0..ROUNDS {
            for (times, way) in times.iter_mut().zip(WAYS) {
                let started = Instant::now();
                black_box(way(&scene, &buffer));
                times.push(started.elapsed());
            }
        }
        let median_ms = |times: &Vec<_>| Statistics::of(times).map_or(0.0, |of| 1e3 * of.median);
        let [called_for, on, forced] = times.each_ref().map(median_ms);
        let ratio = forced / called_for;
        writeln!(out, "{name:<24} {called_for:>10.2} {on:>10.2} {forced:>10.2} {ratio:>10.2}")?;
    }
    Ok(())
}

fn bits(picture: Vec<LinearRgb>) -> Vec<[u64; 3]> {
    picture.into_iter().map(|rgb| rgb.map(f64::to_bits)).collect()
}
