//! Shadows: the caster before the arbiter, at every pixel, with lights where it is hard.
//!
//! Both answer from the same definition with no code in common. Every build preset and the linear
//! scan are asked; an occluder that the caster names must be one that the arbiter finds.

mod closed;
mod lights;
mod picture;
mod random;
mod scenes;

use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::cast;
use truecast::cast::shadow::{ShadowCaster, ShadowCounts};
use truecast::exact::{Arbiter, Shadows};
use truecast::mesh::TriangleId;
use truecast::scene::Scene;
use truecast::scene::light_point::LightPoint;
use truecast::visibility::Counting;

/// What a comparison met.
#[derive(Clone, Copy, Debug, Default)]
struct Met {
    lit: usize,
    shadowed: usize,
    counts: ShadowCounts,
}

impl Met {
    fn add(&mut self, other: Self) {
        self.lit += other.lit;
        self.shadowed += other.shadowed;
        self.counts.add(other.counts);
    }
}

/// Every tree shape there is.
fn accelerators(scene: &Scene) -> Vec<Accelerator> {
    let built = BuildPreset::ALL.iter().map(|&preset| Accelerator::build(&scene.mesh, preset));
    built.chain([Accelerator::linear(&scene.mesh)]).collect()
}

/// Holds the caster against the arbiter at every pixel, for every light, with all triangles opaque
/// and with every third one not.
fn agreed(name: &str, scene: &Scene, lights: &[LightPoint]) -> Met {
    let accelerators = accelerators(scene);
    let mut casters: Vec<_> =
        accelerators.iter().map(|accelerator| ShadowCaster::new(scene, accelerator)).collect();
    let window = scene.camera.resolution().window();
    let buffer = cast(scene, &accelerators[0], window, Counting::Nearest, &|| ());
    let all: Vec<TriangleId> = scene.mesh.ids().collect();
    let arbiter = Arbiter::new(scene);
    let mut met = Met::default();
    for (index, &light) in lights.iter().enumerate() {
        let shadows = Shadows::new(scene, light);
        for (number, pixel) in window.pixels().enumerate() {
            let Some(visible) = buffer.at(pixel) else { continue };
            let right = shadows.occluders(pixel, visible.triangle, |_| true);
            // The interval test changes nothing, and the one-off answer is the same.
            if (number + index) % 41 == 0 && all.len() <= 400 {
                let among = shadows.occluders_among(&all, pixel, visible.triangle, |_| true);
                assert_eq!(right, among, "{name}: {light:?} at {pixel:?}");
                let once = arbiter.is_shadowed(pixel, light, |_| true);
                assert_eq!(once, Some(!right.is_empty()), "{name}: {light:?} at {pixel:?}");
            }
            let thinned = |id: TriangleId| id.get() % 3 != 1;
            for caster in &mut casters {
                let found = caster.occluder(pixel, visible, light, |_| true);
                assert_found(name, light, pixel, found, &right);
            }
            let found = casters[number % 6].occluder(pixel, visible, light, thinned);
            let opaque: Vec<_> = right.iter().copied().filter(|&id| thinned(id)).collect();
            assert_found(name, light, pixel, found, &opaque);
            met.lit += usize::from(right.is_empty());
            met.shadowed += usize::from(!right.is_empty());
        }
    }
    casters.iter().for_each(|caster| met.counts.add(caster.counts()));
    met
}

/// Generic lights, and lights on whole numbers around and before the standard scenes.
fn generic_and_whole() -> Vec<LightPoint> {
    let mut lights = lights::generic(7.0);
    let places =
        [[0.0, 0.0, 0.0], [8.0, 0.0, 2.0], [-6.0, 4.0, 0.0], [0.0, -9.0, 4.0], [0.0, 0.0, 30.0]];
    lights.extend(places.map(LightPoint::Position));
    let ways =
        [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [1.0, -1.0, 0.0], [1.0, 2.0, 2.0]];
    lights.extend(ways.map(LightPoint::Direction));
    lights
}

fn assert_found(
    name: &str,
    light: LightPoint,
    pixel: truecast::pixel::Pixel,
    found: Option<TriangleId>,
    right: &[TriangleId],
) {
    match found {
        None => assert!(right.is_empty(), "{name}: {light:?} at {pixel:?} is hidden by {right:?}"),
        Some(id) => {
            assert!(right.contains(&id), "{name}: {light:?} at {pixel:?}: {id:?}, not {right:?}");
        }
    }
}
