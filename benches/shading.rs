//! The time of shading: what is saved by simulating only what a scene calls for, and how far the
//! equation under four spotlights is from the machine's limit.
//!
//! First, every scene shaded with the effects that it calls for, with every effect on, and with
//! every effect forced to be evaluated. The three pictures are the same bit for bit, which is checked
//! before anything is timed; only then do they take turns, and medians of the rounds are printed.
//!
//! Then, four spotlights on glossy interpolated surfaces, on one thread, beside a bare loop over
//! f32 lanes of the same formula (`shading/bare.rs`), in turns. The loop knows that one triangle
//! fills the picture, reads nothing, writes f32 and has no gate but the formula's own; its values
//! are compared with those of the program within its own rounding. Visibility is not timed.

#[path = "../tests/it/called_for/scenes.rs"]
mod scenes;

#[path = "shading/bare.rs"]
mod bare;

use std::hint::black_box;
use std::io::{self, Write};
use std::time::{Duration, Instant};
use truecast::color::LinearRgb;
use truecast::pixel::Window;
use truecast::raster::rasterize;
use truecast::scene::Scene;
use truecast::shade::{Effects, Precision, ShadeOptions, shade, shade_into, shade_ungated};
use truecast::simd::SimdLevel;
use truecast::statistics::Statistics;
use truecast::visibility::{Counting, VisibilityBuffer};

/// Rounds per scene: an odd number, so that the median is one of them.
const ROUNDS: usize = 11;

/// Size of the pictures, in pixels.
const SIZE: (u32, u32) = (960, 540);

/// Size of the pictures under four spotlights.
const LARGE: (u32, u32) = (1920, 1080);

/// The ways to make the same picture.
const WAYS: [fn(&Scene, &VisibilityBuffer) -> Vec<LinearRgb>; 3] = [
    |scene, buffer| shade(scene, buffer, Effects::of(scene), &|| ()).radiance,
    |scene, buffer| shade(scene, buffer, Effects::ALL, &|| ()).radiance,
    shade_ungated,
];

fn main() -> io::Result<()> {
    called_for(&mut io::stdout().lock())?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().map_err(io::Error::other)?;
    pool.install(|| four_spotlights(&mut io::stdout().lock()))
}

/// What is not called for costs nothing.
fn called_for(out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "shading at {}x{}, medians of {ROUNDS} rounds, in ms", SIZE.0, SIZE.1)?;
    writeln!(out, "scene                    called for     all on     forced   forced/called for")?;
    for (name, scene) in scenes::scenes(SIZE.0, SIZE.1) {
        let buffer = look(&scene);
        let pictures = WAYS.map(|way| bits(way(&scene, &buffer)));
        assert!(pictures.iter().all(|picture| *picture == pictures[0]), "{name}: another picture");
        let mut times = [const { Vec::new() }; WAYS.len()];
        for _ in 0..ROUNDS {
            for (times, way) in times.iter_mut().zip(WAYS) {
                times.push(time(|| way(&scene, &buffer)));
            }
        }
        let [called_for, on, forced] = times.each_ref().map(|times| 1e3 * median(times));
        let ratio = forced / called_for;
        writeln!(out, "{name:<24} {called_for:>10.2} {on:>10.2} {forced:>10.2} {ratio:>10.2}")?;
    }
    Ok(())
}

/// Mpixel/s of lit pixels, beside the bare loop.
fn four_spotlights(out: &mut dyn Write) -> io::Result<()> {
    let one = bare::one_triangle(LARGE.0, LARGE.1);
    let largest = compare(&one);
    let many = bare::torus(LARGE.0, LARGE.1);
    writeln!(
        out,
        "\nfour spotlights at {}x{}, one thread, medians of {ROUNDS} rounds, Mpixel/s of lit pixels;\n\
         the bare loop differs by {largest:.1e} at most",
        LARGE.0, LARGE.1
    )?;
    writeln!(out, "                               one triangle   of the bare loop      torus")?;
    let views = [(&one, look(&one)), (&many, look(&many))];
    let levels = SimdLevel::available();
    let mut ways = vec![(None, Precision::Double)];
    ways.extend(levels.iter().map(|&level| (Some(level), Precision::Double)));
    ways.extend(levels.iter().map(|&level| (Some(level), Precision::Single)));
    let mut loops = vec![Vec::new(); ways.len()];
    let mut times = vec![[const { Vec::new() }; 2]; ways.len()];
    let pixels = views[0].1.window.len();
    // Everybody writes to memory that is there already.
    let (mut radiance, mut planes) = (vec![[0.0; 3]; pixels], planes(pixels));
    for _ in 0..ROUNDS {
        for (way, &(simd, precision)) in ways.iter().enumerate() {
            let level = simd.unwrap_or(SimdLevel::Baseline);
            loops[way].push(time(|| bare::shade(&one, level, &mut planes)));
            for (times, (scene, buffer)) in times[way].iter_mut().zip(&views) {
                let options = ShadeOptions { effects: Effects::of(scene), simd, precision };
                let radiance = &mut radiance;
                times.push(time(|| shade_into(scene, buffer, &options, None, radiance, &|| ())));
            }
        }
    }
    let counts = views.each_ref().map(|(_, buffer)| buffer.covered_pixels() as f64);
    for (way, (simd, precision)) in ways.iter().enumerate() {
        let name = match simd {
            None => "pixel by pixel".to_owned(),
            Some(level) => {
                format!("{level}, {}", if *precision == Precision::Single { "f32" } else { "f64" })
            }
        };
        let speeds: [f64; 2] =
            std::array::from_fn(|view| 1e-6 * counts[view] / median(&times[way][view]));
        let bare = 1e-6 * f64::from(LARGE.0 * LARGE.1) / median(&loops[way]);
        let ratio = speeds[0] / bare;
        writeln!(
            out,
            "{name:<24} {:>18.1} {ratio:>10.2} of {bare:>5.1} {:>10.1}",
            speeds[0], speeds[1]
        )?;
    }
    Ok(())
}

/// Three planes of f32.
fn planes(pixels: usize) -> [Vec<f32>; 3] {
    [vec![0.0; pixels], vec![0.0; pixels], vec![0.0; pixels]]
}

/// The largest difference between the program and the bare loop, which is asserted to be rounding.
fn compare(scene: &Scene) -> f64 {
    let shaded = shade(scene, &look(scene), Effects::of(scene), &|| ()).radiance;
    let mut bare = planes(shaded.len());
    bare::shade(scene, SimdLevel::best(), &mut bare);
    let pixels = shaded.iter().enumerate();
    let largest = pixels.fold(0.0_f64, |largest, (i, rgb)| {
        let differences = (0..3).map(|k| (rgb[k] - f64::from(bare[k][i])).abs());
        differences.fold(largest, f64::max)
    });
    assert!(largest < bare::ERROR, "the bare loop computes something else: {largest:e}");
    largest
}

fn look(scene: &Scene) -> VisibilityBuffer {
    let window: Window = scene.camera.resolution().window();
    rasterize(scene, window, Counting::Nearest, &|| ())
}

fn time<T>(work: impl FnOnce() -> T) -> Duration {
    let started = Instant::now();
    let result = black_box(work());
    let elapsed = started.elapsed();
    drop(result);
    elapsed
}

/// Seconds.
fn median(times: &[Duration]) -> f64 {
    Statistics::of(times).map_or(0.0, |of| of.median)
}

fn bits(picture: Vec<LinearRgb>) -> Vec<[u64; 3]> {
    picture.into_iter().map(|rgb| rgb.map(f64::to_bits)).collect()
}
