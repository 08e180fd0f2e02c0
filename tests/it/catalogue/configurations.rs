//! One scene through every configuration of both paths, and before the arbiter.
//!
//! A path's answer must not depend on its accelerator, tiles, threads or mode, bit for bit; the two
//! paths' answers must say the same; and the arbiter must say so too. What is right in a case is
//! the case's own business: the answer comes back for it.

mod agreement;

use agreement::{assert_arbiter_agrees, assert_finite, assert_paths_agree, assert_same_bits};
use rayon::{ThreadPool, ThreadPoolBuilder};
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::cast_with_tiles;
use truecast::raster::rasterize_in_tiles;
use truecast::scene::Scene;
use truecast::visibility::{Counting, VisibilityBuffer};

/// Sides of tiles: one pixel, one that divides nothing, smaller and larger than the frames of the
/// catalogue (17), and larger than the paths' own (32).
const TILE_SIDES: [u32; 5] = [1, 3, 8, 32, 64];

/// Most triangles for all of [`TILE_SIDES`]; a larger scene has those of [`FEW_TILE_SIDES`]. A run of
/// 100 000 takes tenths of a second.
const ALL_SIDES_LIMIT: usize = 50_000;

/// Tile sides of very large scenes: several tiles and one.
const FEW_TILE_SIDES: [u32; 2] = [8, 32];

/// Numbers of threads, each a pool of its own.
const THREADS: [usize; 2] = [1, 2];

/// Both modes. The first has the counts that the others are compared with.
const MODES: [Counting; 2] = [Counting::All, Counting::Nearest];

/// Most pixels × triangles for the accelerator that is none, which tests them all.
const LINEAR_LIMIT: usize = 1 << 21;

/// Most triangles for the preset that tries every node for reinsertion, by far the slowest build.
const VERY_SLOW_LIMIT: usize = 5000;

/// The answer of the caster with counts, after every configuration of both paths gave the same and
/// the arbiter agreed.
pub(crate) fn agree_everywhere(name: &str, scene: &Scene) -> VisibilityBuffer {
    let pools = THREADS.map(pool);
    let cast = cast_everywhere(name, scene, &pools);
    let raster = rasterize_everywhere(name, scene, &pools);
    judged(name, scene, cast, &raster, &pools[1])
}

/// [`agree_everywhere`] in one configuration of each path, for cases of very many scenes.
pub(crate) fn agree_once(name: &str, scene: &Scene) -> VisibilityBuffer {
    let pool = pool(1);
    let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Medium);
    let cast = pool.install(|| cast_by(scene, &accelerator, Counting::All, 32));
    let raster = pool.install(|| rasterize_by(scene, Counting::All, 32));
    judged(name, scene, cast, &raster, &pool)
}

fn judged(
    name: &str,
    scene: &Scene,
    cast: VisibilityBuffer,
    raster: &VisibilityBuffer,
    pool: &ThreadPool,
) -> VisibilityBuffer {
    assert_finite(name, &cast);
    assert_finite(name, raster);
    assert_paths_agree(name, &cast, raster);
    pool.install(|| assert_arbiter_agrees(name, scene, &cast));
    cast
}

fn pool(threads: usize) -> ThreadPool {
    ThreadPoolBuilder::new().num_threads(threads).build().unwrap()
}

fn cast_by(
    scene: &Scene,
    accelerator: &Accelerator,
    mode: Counting,
    side: u32,
) -> VisibilityBuffer {
    let window = scene.camera.resolution().window();
    cast_with_tiles(scene, accelerator, window, mode, &|| (), side)
}

fn rasterize_by(scene: &Scene, mode: Counting, side: u32) -> VisibilityBuffer {
    rasterize_in_tiles(scene, scene.camera.resolution().window(), mode, side, &|| ())
}

/// The caster: all tiles, threads and modes on one accelerator, and all accelerators.
fn cast_everywhere(name: &str, scene: &Scene, pools: &[ThreadPool; 2]) -> VisibilityBuffer {
    let mesh = &scene.mesh;
    let medium = Accelerator::build(mesh, BuildPreset::Medium);
    let reference = all_circumstances(name, "cast", scene, pools, |mode, side| {
        cast_by(scene, &medium, mode, side)
    });
    for (index, preset) in BuildPreset::ALL.into_iter().enumerate() {
        if preset == BuildPreset::VerySlow && mesh.len() > VERY_SLOW_LIMIT {
            continue;
        }
        // Built where it is used: topologies must not hang on the number of threads either.
        pools[index % 2].install(|| {
            let accelerator = Accelerator::build(mesh, preset);
            for (mode, side) in MODES.into_iter().zip([8, 32]) {
                let answer = cast_by(scene, &accelerator, mode, side);
                assert_same_bits(name, &format!("cast, {preset:?}, {mode:?}"), &reference, &answer);
            }
        });
    }
    if scene.camera.resolution().window().len() * mesh.len() <= LINEAR_LIMIT {
        let linear = Accelerator::linear(mesh);
        for (mode, pool) in MODES.into_iter().zip(pools) {
            let answer = pool.install(|| cast_by(scene, &linear, mode, 8));
            assert_same_bits(name, &format!("cast, linear, {mode:?}"), &reference, &answer);
        }
    }
    reference
}

/// The rasterizer: all tiles, threads and modes.
fn rasterize_everywhere(name: &str, scene: &Scene, pools: &[ThreadPool; 2]) -> VisibilityBuffer {
    all_circumstances(name, "raster", scene, pools, |mode, side| rasterize_by(scene, mode, side))
}

/// The answer with counts, after every tile side, number of threads and mode gave its bits.
fn all_circumstances(
    name: &str,
    path: &str,
    scene: &Scene,
    pools: &[ThreadPool; 2],
    answer: impl Fn(Counting, u32) -> VisibilityBuffer + Sync,
) -> VisibilityBuffer {
    let few = scene.mesh.len() > ALL_SIDES_LIMIT;
    let sides: &[u32] = if few { &FEW_TILE_SIDES } else { &TILE_SIDES };
    let reference = pools[0].install(|| answer(Counting::All, 32));
    for (threads, pool) in THREADS.iter().zip(pools) {
        for &side in sides {
            for mode in MODES {
                let circumstance = format!("{path}, {threads} threads, tiles of {side}, {mode:?}");
                let found = pool.install(|| answer(mode, side));
                assert_eq!(found.cover.is_some(), mode == Counting::All, "{name}: {circumstance}");
                assert_same_bits(name, &circumstance, &reference, &found);
            }
        }
    }
    reference
}
