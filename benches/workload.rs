//! The workload of `truecast bench`, variant by variant, under criterion's statistics.
//!
//! `truecast bench` lets variants take turns and checks every answer; here each is run by itself, after
//! one check. For watching one kernel while it is worked on: `cargo bench --bench workload -- cast`.

use criterion::{Criterion, SamplingMode, Throughput};
use std::path::Path;
use truecast::accel::BuildPreset;
use truecast::bench::kernels::Kernels;
use truecast::bench::reference::Reference;
use truecast::bench::rounds::take_turns;
use truecast::pixel::Resolution;
use truecast::render::{Answerer, Unwatched};
use truecast::scene::{Overrides, Scene};
use truecast::simd::SimdLevel;
use truecast::visibility::Counting;

/// Few large meshes and many small ones: two scenes that come with the project.
const SCENES: [&str; 2] = ["default.toml", "bench/hall.toml"];

/// Size of the frames, in pixels.
const SIZE: (u32, u32) = (960, 540);

/// Pixels that exact arithmetic looks at.
const AUDITED_PIXELS: usize = 100;

fn workload(criterion: &mut Criterion) {
    for name in SCENES {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name);
        let resolution = Resolution::new(SIZE.0, SIZE.1);
        let overrides = Overrides { resolution, ..Overrides::default() };
        let scene = Scene::load(&path, &overrides).unwrap_or_else(|errors| panic!("{errors}"));
        let window = scene.camera.resolution().window();
        let kernels = Kernels::new(&scene, &[BuildPreset::Medium], SimdLevel::best(), &Unwatched);
        let both = [kernels.standard_cast(), &Answerer::Raster]
            .map(|answerer| answerer.see(&scene, window, Counting::All, &Unwatched));
        let reference = Reference::of(&scene, &both, AUDITED_PIXELS, &Unwatched);
        let exposure = kernels.exposure(&scene, &both[0]);
        let variants = kernels.variants(&scene, &both[0], Some(&exposure));
        for row in take_turns(&variants, &reference, 1, &Unwatched) {
            assert!(
                !row.has_failed(),
                "{name}: {} is wrong at {:?} pixels",
                row.name,
                row.wrong_pixels
            );
        }
        let mut group = criterion.benchmark_group(name);
        group.sample_size(10).sampling_mode(SamplingMode::Flat);
        for variant in &variants {
            group.throughput(Throughput::Elements(variant.amount.count as u64));
            group.bench_function(&variant.name, |bencher| bencher.iter(|| variant.run()));
        }
    }
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    workload(&mut criterion);
    criterion.final_summary();
}
