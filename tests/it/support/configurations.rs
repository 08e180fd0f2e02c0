//! One scene through every configuration of both paths, and before the arbiter.
//!
//! A path's answer must not depend on its accelerator, tiles, threads or mode, bit for bit; the two
//! paths' answers must say the same; and the arbiter must say so too. What is right in a case is
//! the case's own business: the answer comes back for it.

mod agreement;

use agreement::{assert_arbiter_agrees, assert_finite, assert_paths_agree};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::LazyLock;
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::{CastOptions, cast_nearest, cast_with};
use truecast::raster::rasterize_in_tiles;
use truecast::scene::Scene;
use truecast::simd::SimdLevel;
use truecast::visibility::{Counting, VisibilityBuffer};

pub(crate) use agreement::{assert_nearest_is, assert_same};

/// How widely a scene's answers are compared.
#[derive(Clone, Copy)]
pub(crate) struct Breadth {
    /// Build presets of the cast path; the first gives the answer.
    pub(crate) presets: &'static [BuildPreset],
    /// Whether the linear scan, which tests every triangle, answers as well.
    pub(crate) linear: bool,
    /// Tile sides of both paths, pixels; at least one.
    pub(crate) tile_sides: &'static [u32],
    /// Pixels that the arbiter looks at: half of them beside boundaries between ids, all when the
    /// frame has no more.
    pub(crate) audited_pixels: usize,
}

/// Everything; for frames of some hundred pixels. Tiles of one pixel, of sides that divide nothing,
/// smaller and larger than the frames of the catalogue (17), and larger than the paths' own (32).
pub(crate) const FULL: Breadth = Breadth {
    presets: &BuildPreset::ALL,
    linear: true,
    tile_sides: &[1, 3, 7, 8, 32, 64],
    audited_pixels: usize::MAX,
};

/// One configuration of each path, with two numbers of threads and both modes; for large meshes.
pub(crate) const NARROW: Breadth = Breadth {
    presets: &[BuildPreset::Medium],
    linear: false,
    tile_sides: &[32],
    audited_pixels: 60,
};

/// Most triangles for all tile sides of [`FULL`]; a larger scene has several tiles and one. A run
/// of 100 000 takes tenths of a second.
const ALL_SIDES_LIMIT: usize = 50_000;

/// Tile sides of very large scenes.
const FEW_TILE_SIDES: &[u32] = &[8, 32];

/// Most pixels × triangles for the accelerator that is none.
const LINEAR_LIMIT: usize = 1 << 21;

/// Most triangles for the preset that tries every node for reinsertion, by far the slowest build.
const VERY_SLOW_LIMIT: usize = 5000;

/// The presets of larger scenes.
const BUT_VERY_SLOW: &[BuildPreset] =
    &[BuildPreset::Fastest, BuildPreset::Fast, BuildPreset::Medium, BuildPreset::Slow];

/// Most pixels × triangles for which the arbiter is asked about every pixel: its interval test
/// takes about 20 ns for each, so 0.1 s.
const ARBITER_LIMIT: usize = 1 << 22;

/// Pixels that the arbiter is asked about beyond that.
const ARBITER_SAMPLE: usize = 64;

/// One and two threads.
pub(crate) static POOLS: LazyLock<[ThreadPool; 2]> = LazyLock::new(|| {
    [1, 2].map(|count| ThreadPoolBuilder::new().num_threads(count).build().unwrap())
});

/// Both modes. The first has the counts that the others are compared with.
const MODES: [Counting; 2] = [Counting::All, Counting::Nearest];

/// [`FULL`], less what a scene of this size cannot afford.
fn affordable(scene: &Scene) -> Breadth {
    let (pixels, triangles) = (scene.camera.resolution().window().len(), scene.mesh.len());
    Breadth {
        presets: if triangles > VERY_SLOW_LIMIT { BUT_VERY_SLOW } else { FULL.presets },
        linear: pixels * triangles <= LINEAR_LIMIT,
        tile_sides: if triangles > ALL_SIDES_LIMIT { FEW_TILE_SIDES } else { FULL.tile_sides },
        audited_pixels: affordable_audit(scene),
    }
}

fn affordable_audit(scene: &Scene) -> usize {
    let pixels = scene.camera.resolution().window().len();
    if pixels * scene.mesh.len() <= ARBITER_LIMIT { pixels } else { ARBITER_SAMPLE }
}

/// The caster's answer with counts, after every configuration of both paths that a scene of this
/// size can afford gave the same and the arbiter agreed.
#[track_caller]
pub(crate) fn agree_everywhere(name: &str, scene: &Scene) -> VisibilityBuffer {
    agreed_within(scene, &affordable(scene), name)
}

/// The same in one configuration of each path, for cases of very many scenes.
#[track_caller]
pub(crate) fn agree_once(name: &str, scene: &Scene) -> VisibilityBuffer {
    agreed_within(scene, &Breadth { audited_pixels: affordable_audit(scene), ..NARROW }, name)
}

/// [`agreed_within`] of [`FULL`].
#[track_caller]
pub(crate) fn agreed(scene: &Scene) -> VisibilityBuffer {
    agreed_within(scene, &FULL, "scene")
}

/// The caster's answer with counts, after every way of asking that `breadth` says gave the same;
/// `name` stands in messages.
#[track_caller]
pub(crate) fn agreed_within(scene: &Scene, breadth: &Breadth, name: &str) -> VisibilityBuffer {
    let cast = cast_everywhere(scene, breadth, name);
    let raster = all_circumstances(breadth, &format!("{name}, raster"), |mode, side| {
        rasterize_in_tiles(scene, scene.camera.resolution().window(), mode, side, &|| ())
    });
    assert_finite(name, &cast);
    assert_finite(name, &raster);
    assert_paths_agree(name, &cast, &raster);
    assert_arbiter_agrees(name, scene, &cast, breadth.audited_pixels);
    cast
}

/// The caster: all tiles, threads and modes on the first accelerator, and all accelerators.
fn cast_everywhere(scene: &Scene, breadth: &Breadth, name: &str) -> VisibilityBuffer {
    let window = scene.camera.resolution().window();
    let ask = |tree: &Accelerator, mode, side| {
        let options = CastOptions { side, ..CastOptions::default() };
        cast_with(scene, tree, window, mode, options, &|| ())
    };
    let first = Accelerator::build(&scene.mesh, breadth.presets[0]);
    let reference =
        all_circumstances(breadth, &format!("{name}, cast"), |mode, side| ask(&first, mode, side));
    // Rays one by one, and every instruction set.
    let single = CastOptions { tiles: false, ..CastOptions::default() };
    let found = cast_with(scene, &first, window, Counting::Nearest, single, &|| ());
    assert_same(&reference, &found, &format!("{name}, cast, single rays"));
    for simd in SimdLevel::available() {
        let options = CastOptions { simd, ..CastOptions::default() };
        for mode in MODES {
            let found = cast_with(scene, &first, window, mode, options, &|| ());
            assert_same(&reference, &found, &format!("{name}, cast, {simd}, {mode:?}"));
        }
        let nearest = cast_nearest(scene, &first, window, options, &|| ());
        assert_nearest_is(&reference, &nearest, &format!("{name}, cast, {simd}, nearest only"));
    }
    let presets = breadth.presets[1..].iter().map(|&preset| Some(preset));
    for (number, preset) in presets.chain(breadth.linear.then_some(None)).enumerate() {
        // Built where it is used: topologies must not hang on the number of threads either. Tile
        // sides take turns.
        POOLS[number % 2].install(|| {
            let tree = match preset {
                Some(preset) => Accelerator::build(&scene.mesh, preset),
                None => Accelerator::linear(&scene.mesh),
            };
            let side = breadth.tile_sides[number % breadth.tile_sides.len()];
            for mode in MODES {
                let what = format!("{name}, cast, {preset:?}, tiles of {side}, {mode:?}");
                assert_same(&reference, &ask(&tree, mode, side), &what);
            }
        });
    }
    reference
}

/// The answer with counts, after every tile side, number of threads and mode gave its bits.
fn all_circumstances(
    breadth: &Breadth,
    name: &str,
    answer: impl Fn(Counting, u32) -> VisibilityBuffer + Sync,
) -> VisibilityBuffer {
    let mut reference: Option<VisibilityBuffer> = None;
    for pool in POOLS.iter().rev() {
        for &side in breadth.tile_sides {
            for mode in MODES {
                let threads = pool.current_num_threads();
                let found = pool.install(|| answer(mode, side));
                let what = format!("{name}, {threads} threads, tiles of {side}, {mode:?}");
                assert_eq!(found.cover.is_some(), mode == Counting::All, "{what}");
                match &reference {
                    None => reference = Some(found),
                    Some(reference) => assert_same(reference, &found, &what),
                }
            }
        }
    }
    reference.expect("a tile side was named")
}
