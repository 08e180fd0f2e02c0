//! The hard cases of traversal (H50–H65), of scale and extremes (H70–H7A) and the transformations
//! that must not change an answer (H80–H89), each under its name.
//!
//! Every scene goes through `agreed`: both paths, all build presets and the linear scan, several
//! tile sizes, one and two threads, and the arbiter. Left out: H8A, which needs
//! stability marks.

mod extremes;
mod metamorphic;
mod supersampling;
mod traversal;

use crate::support::scenes::Triangle;
use std::sync::LazyLock;
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::cast_with_tiles;
use truecast::check::tolerance::weights_agree;
use truecast::check::visible_of;
use truecast::exact::Arbiter;
use truecast::pixel::Pixel;
use truecast::raster::rasterize_in_tiles;
use truecast::scene::Scene;
use truecast::visibility::{Counting, Cover, Level, VisibilityBuffer, Visible};

/// How widely a scene's answers are compared.
pub(crate) struct Breadth {
    /// Build presets of the cast path; the first gives the answer.
    pub(crate) presets: &'static [BuildPreset],
    /// Whether the linear scan answers as well.
    pub(crate) linear: bool,
    /// Tile sides of both paths, pixels; at least one.
    pub(crate) tile_sides: &'static [u32],
    /// Pixels that the arbiter looks at; all when the frame has no more.
    pub(crate) audited_pixels: usize,
}

/// Everything; for frames of some hundred pixels.
pub(crate) const FULL: Breadth = Breadth {
    presets: &BuildPreset::ALL,
    linear: true,
    tile_sides: &[1, 7, 32],
    audited_pixels: usize::MAX,
};

/// One configuration of each path; for large meshes and many scenes.
pub(crate) const NARROW: Breadth = Breadth {
    presets: &[BuildPreset::Medium],
    linear: false,
    tile_sides: &[32],
    audited_pixels: 60,
};

static POOLS: LazyLock<[rayon::ThreadPool; 2]> = LazyLock::new(|| {
    [1, 2].map(|count| rayon::ThreadPoolBuilder::new().num_threads(count).build().unwrap())
});

/// The caster's answer with counts, after every way of asking gave the same.
#[track_caller]
pub(crate) fn agreed(scene: &Scene) -> VisibilityBuffer {
    agreed_within(scene, &FULL, "scene")
}

/// The same, compared as widely as `breadth` says; `name` stands in messages.
#[track_caller]
pub(crate) fn agreed_within(scene: &Scene, breadth: &Breadth, name: &str) -> VisibilityBuffer {
    let answer = cast_everywhere(scene, breadth, name);
    let raster = rasterize_everywhere(scene, breadth, name);
    assert_finite(&answer, name);
    assert_finite(&raster, name);
    // The paths share no arithmetic: decisions are equal, intervals overlap, weights are close.
    for (index, pixel) in answer.window.pixels().enumerate() {
        let other = (raster.visible[index], cover(&raster, index));
        assert_matches((answer.visible[index], cover(&answer, index)), other, name, pixel);
    }
    audit(scene, &answer, breadth.audited_pixels, name);
    answer
}

/// The caster's answer, the same bits from every tree, tile size, thread count and mode.
fn cast_everywhere(scene: &Scene, breadth: &Breadth, name: &str) -> VisibilityBuffer {
    let window = scene.camera.resolution().window();
    let mut trees: Vec<(String, Accelerator)> = (breadth.presets.iter())
        .map(|&preset| (format!("{preset:?}"), Accelerator::build(&scene.mesh, preset)))
        .collect();
    if breadth.linear {
        trees.push(("linear".to_owned(), Accelerator::linear(&scene.mesh)));
    }
    let ask = |tree: &Accelerator, counting, side, pool: usize| {
        POOLS[pool].install(|| cast_with_tiles(scene, tree, window, counting, &|| (), side))
    };
    // Tile sides and threads take turns over the trees, so that each meets each somewhere.
    let side = |number: usize| breadth.tile_sides[number % breadth.tile_sides.len()];
    let answer = ask(&trees[0].1, Counting::All, side(0), 1);
    for (number, (tree_name, tree)) in trees.iter().enumerate() {
        let what = format!("{name}, {tree_name}, tiles of {}", side(number));
        if number > 0 {
            let counted = ask(tree, Counting::All, side(number), number % 2);
            assert_same(&answer, &counted, &what);
            assert_eq!(answer.cover, counted.cover, "{what}");
        }
        let nearest = ask(tree, Counting::Nearest, side(number), number % 2);
        assert_same(&answer, &nearest, &format!("{what}, nearest only"));
    }
    for &side in &breadth.tile_sides[1..] {
        let tiled = ask(&trees[0].1, Counting::All, side, 0);
        assert_same(&answer, &tiled, &format!("{name}, tiles of {side}"));
        assert_eq!(answer.cover, tiled.cover, "{name}, tiles of {side}");
    }
    answer
}

/// The rasterizer's answer, the same bits at every tile size, thread count and mode.
fn rasterize_everywhere(scene: &Scene, breadth: &Breadth, name: &str) -> VisibilityBuffer {
    let window = scene.camera.resolution().window();
    let ask = |counting, side, pool: usize| {
        POOLS[pool].install(|| rasterize_in_tiles(scene, window, counting, side, &|| ()))
    };
    let answer = ask(Counting::All, breadth.tile_sides[0], 1);
    for (number, &side) in breadth.tile_sides.iter().enumerate() {
        if number > 0 {
            let counted = ask(Counting::All, side, 0);
            assert_same(&answer, &counted, &format!("{name}, rasterized in tiles of {side}"));
            assert_eq!(answer.cover, counted.cover, "{name}, rasterized in tiles of {side}");
        }
        let nearest = ask(Counting::Nearest, side, 0);
        assert_same(&answer, &nearest, &format!("{name}, rasterized, nearest only"));
    }
    answer
}

/// The arbiter's word at a fixed sample of pixels, half of it beside boundaries between ids.
fn audit(scene: &Scene, answer: &VisibilityBuffer, count: usize, name: &str) {
    let arbiter = Arbiter::new(scene);
    let length = answer.visible.len();
    let chosen: Vec<usize> = if count >= length {
        (0..length).collect()
    } else {
        let id = |index: usize| answer.visible[index].map(|v| v.triangle);
        let edges: Vec<usize> = (1..length).filter(|&i| id(i) != id(i - 1)).collect();
        let anywhere = (0..length).step_by((2 * length / count).max(1));
        anywhere.chain(edges.iter().copied().step_by((2 * edges.len() / count).max(1))).collect()
    };
    for index in chosen {
        let pixel = answer.window.pixel(index);
        let exact = visible_of(&arbiter.answer(pixel));
        let what = format!("{name}, arbiter");
        assert_matches((answer.visible[index], cover(answer, index)), exact, &what, pixel);
    }
}

/// Two computations of one answer at a pixel.
#[track_caller]
fn assert_matches(
    a: (Option<Visible>, Cover),
    b: (Option<Visible>, Cover),
    name: &str,
    pixel: Pixel,
) {
    let decided = |v: Option<Visible>| v.map(|v| (v.triangle, v.facing, v.tie));
    assert_eq!((decided(a.0), a.1), (decided(b.0), b.1), "{name} at {pixel:?}");
    let (Some(a), Some(b)) = (a.0, b.0) else { return };
    assert!(a.t_lo <= b.t_hi && b.t_lo <= a.t_hi, "{name} at {pixel:?}: {a:?} {b:?}");
    let weights = a.barycentric.0.into_iter().zip(b.barycentric.0);
    let close = weights.into_iter().all(|(a, b)| weights_agree(a, b));
    assert!(close, "{name} at {pixel:?}: {a:?} {b:?}");
}

/// Same answers, bit for bit; levels of work may differ.
#[track_caller]
pub(crate) fn assert_same(a: &VisibilityBuffer, b: &VisibilityBuffer, name: &str) {
    assert_eq!(a.visible.len(), b.visible.len(), "{name}");
    for (index, (left, right)) in a.visible.iter().zip(&b.visible).enumerate() {
        assert_eq!(left, right, "{name}, pixel {index}");
        assert_eq!(left.as_ref().map(bits), right.as_ref().map(bits), "{name}, pixel {index}");
    }
}

fn bits(visible: &Visible) -> [u64; 5] {
    let [b0, b1, b2] = visible.barycentric.0;
    [b0, b1, b2, visible.t_lo, visible.t_hi].map(f64::to_bits)
}

/// FIN: finite, ordered bounds of t with a relative width of at most 2^-40, weights that sum to 1.
#[track_caller]
fn assert_finite(buffer: &VisibilityBuffer, name: &str) {
    for visible in buffer.visible.iter().flatten() {
        assert!(visible.t_lo > 0.0 && visible.t_hi.is_finite(), "{name}: {visible:?}");
        assert!(visible.t_lo <= visible.t_hi, "{name}: {visible:?}");
        let width = visible.t_hi - visible.t_lo;
        assert!(width <= visible.t_hi * 2.0_f64.powi(-40), "{name}: {visible:?}");
        let sum: f64 = visible.barycentric.0.iter().sum();
        // Each weight is good to 2^-49, so is their sum.
        assert!((sum - 1.0).abs() <= 2.0_f64.powi(-49), "{name}: {visible:?}");
        let none_is_negative = visible.barycentric.0.iter().all(|b| b.is_sign_positive());
        assert!(none_is_negative, "{name}: {visible:?}");
        assert!(!visible.tie || visible.level == Level::Exact, "{name}: {visible:?}");
    }
}

/// The counts at a pixel of a buffer that has them.
pub(crate) fn cover(buffer: &VisibilityBuffer, index: usize) -> Cover {
    buffer.cover.as_ref().expect("counts were asked for")[index]
}

/// The visible triangle of every pixel, row by row.
fn ids(buffer: &VisibilityBuffer) -> Vec<Option<u32>> {
    buffer.visible.iter().map(|v| v.map(|v| v.triangle.get())).collect()
}

/// XO: no sample is covered twice.
#[track_caller]
fn assert_covered_once(buffer: &VisibilityBuffer) {
    assert!(buffer.cover.as_ref().unwrap().iter().all(|cover| cover.crossed <= 1));
}

/// The triangles of a scene of bare triangles.
fn triangles_of(scene: &Scene) -> Vec<Triangle> {
    scene.mesh.ids().map(|id| scene.mesh.triangle(id)).collect()
}

/// Every component times 2^k, exact while it stays in the range of f32.
fn times_power_of_two(triangles: &[Triangle], k: i32) -> Vec<Triangle> {
    let factor = 2.0_f64.powi(k);
    triangles.iter().map(|t| t.map(|v| v.map(|c| (f64::from(c) * factor) as f32))).collect()
}
