//! Opacity: what is seen through surfaces, by both paths and before the arbiter, and what comes of
//! it in radiance and alpha.
//!
//! Known answers in `known`; scenes made of structure in `structured`.

mod known;
mod program;
mod structured;

use crate::support::scenes::{Triangle, standard_scene};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::LazyLock;
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::cast_layers;
use truecast::check::tolerance::weights_agree;
use truecast::check::visible_from;
use truecast::exact::Arbiter;
use truecast::pixel::Pixel;
use truecast::raster::rasterize_layers;
use truecast::render::{Answerer, Exposure, Unwatched, VisibilityPath, expose};
use truecast::scene::Scene;
use truecast::scene::material::Material;
use truecast::shade::Effects;
use truecast::visibility::{Counting, Layers, VisibilityBuffer, Visible};

static POOLS: LazyLock<[ThreadPool; 2]> =
    LazyLock::new(|| [1, 2].map(|n| ThreadPoolBuilder::new().num_threads(n).build().unwrap()));

/// A surface that shines by itself and reflects nothing: its radiance is `ke`, exactly.
fn glow(ke: [f64; 3], opacity: f64) -> Material {
    let black = [0.0; 3];
    Material { ka: black, kd: black, ks: black, ke, opacity, ..Material::default_named("glow") }
}

/// Triangles before G(8), each with a material of its own.
fn glowing(triangles: &[(Triangle, Material)]) -> Scene {
    let bare: Vec<Triangle> = triangles.iter().map(|(triangle, _)| *triangle).collect();
    let mut scene = standard_scene(&bare);
    scene.materials = triangles.iter().map(|(_, material)| material.clone()).collect();
    scene.triangle_materials = (0..triangles.len() as u32).collect();
    scene.background = [0.0, 0.0, 1.0];
    scene
}

/// What one path sees, and what comes of it.
struct Answer {
    nearest: VisibilityBuffer,
    layers: Layers,
    exposure: Exposure,
}

fn answer(scene: &Scene, path: VisibilityPath, effects: Effects) -> Answer {
    let window = scene.camera.resolution().window();
    let answerer = Answerer::new(scene, path, BuildPreset::Medium, &Unwatched);
    let nearest = answerer.see(scene, window, Counting::Nearest, &Unwatched);
    let layers = answerer.see_through(scene, &nearest, &Unwatched);
    let exposure = expose(scene, &answerer, (&nearest, &layers), effects, &Unwatched);
    Answer { nearest, layers, exposure }
}

/// The caster's answer, after every tree, both numbers of threads, the rasterizer and the arbiter
/// saw the same surfaces in the same order at every pixel.
#[track_caller]
fn agreed(name: &str, scene: &Scene) -> Answer {
    let effects = Effects::of(scene);
    let cast = answer(scene, VisibilityPath::Cast, effects);
    let raster = answer(scene, VisibilityPath::Raster, effects);
    let opaque = |id| scene.is_opaque(id);
    // Within a path: the same bits.
    let mut trees: Vec<_> =
        BuildPreset::ALL.map(|preset| Accelerator::build(&scene.mesh, preset)).into();
    trees.push(Accelerator::linear(&scene.mesh));
    for (number, tree) in trees.iter().enumerate() {
        let again =
            POOLS[number % 2].install(|| cast_layers(scene, tree, &cast.nearest, &opaque, &|| ()));
        assert_same_bits(&format!("{name}, tree {number}"), &cast.layers, &again);
    }
    for pool in &*POOLS {
        let again = pool.install(|| rasterize_layers(scene, &raster.nearest, &opaque, &|| ()));
        assert_same_bits(&format!("{name}, rasterized"), &raster.layers, &again);
    }
    // Between the paths and before the arbiter: the same statements.
    let arbiter = Arbiter::new(scene);
    for (index, pixel) in cast.nearest.window.pixels().enumerate() {
        let place = format!("{name} at {pixel:?}");
        let exact = seen_by(&arbiter, scene, pixel);
        for path in [&cast, &raster] {
            let nearest = path.nearest.visible[index].iter();
            let found: Vec<Visible> = nearest.chain(path.layers.of(index)).copied().collect();
            assert_same_surfaces(&place, &found, &exact);
        }
    }
    // Radiance of emission alone does not hang on weights.
    assert_eq!(cast.exposure, raster.exposure, "{name}");
    cast
}

/// The surfaces that are seen at a pixel, by the arbiter: all up to the first opaque one.
fn seen_by(arbiter: &Arbiter<'_>, scene: &Scene, pixel: Pixel) -> Vec<Visible> {
    let mut surfaces: Vec<Visible> =
        arbiter.surfaces(pixel, [0; 2]).iter().map(visible_from).collect();
    let opaque = surfaces.iter().position(|surface| scene.is_opaque(surface.triangle));
    surfaces.truncate(opaque.map_or(surfaces.len(), |first| first + 1));
    surfaces
}

#[track_caller]
fn assert_same_surfaces(place: &str, found: &[Visible], exact: &[Visible]) {
    let statement = |v: &Visible| (v.triangle, v.facing, v.tie);
    let statements = |list: &[Visible]| list.iter().map(statement).collect::<Vec<_>>();
    assert_eq!(statements(found), statements(exact), "{place}");
    for (a, b) in found.iter().zip(exact) {
        assert!(a.t_lo <= b.t_hi && b.t_lo <= a.t_hi, "{place}: {a:?} {b:?}");
        let mut weights = a.barycentric.0.into_iter().zip(b.barycentric.0);
        assert!(weights.all(|(a, b)| weights_agree(a, b)), "{place}: {a:?} {b:?}");
    }
}

#[track_caller]
fn assert_same_bits(name: &str, a: &Layers, b: &Layers) {
    let bits = |v: &Visible| {
        let [b0, b1, b2] = v.barycentric.0;
        let numbers = [b0, b1, b2, v.t_lo, v.t_hi].map(f64::to_bits);
        (v.triangle, v.facing, v.level, v.tie, numbers)
    };
    for index in 0..a.window.len() {
        let lists = [a, b].map(|layers| layers.of(index).iter().map(bits).collect::<Vec<_>>());
        assert_eq!(lists[0], lists[1], "{name}, pixel {index}");
    }
}
