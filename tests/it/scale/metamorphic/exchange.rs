//! H89: the comparison itself has no favourite.

use super::scenes_with_ties;
use crate::support::scenes::standard_scene;
use truecast::accel::{Accelerator, BuildPreset};
use truecast::cast::cast;
use truecast::check::{self, Answered, Blame, CheckOptions, Outcome};
use truecast::raster::rasterize;
use truecast::render::Unwatched;
use truecast::shade::{Effects, shade};
use truecast::visibility::{Counting, Layers, VisibilityBuffer};

/// The comparison itself has no favourite: the paths exchanged give the same verdict, and a damaged
/// answer is blamed on whoever gave it.
#[test]
fn h89_exchanged_paths() {
    for (name, triangles) in scenes_with_ties() {
        let scene = standard_scene(&triangles);
        let window = scene.camera.resolution().window();
        let tree = Accelerator::build(&scene.mesh, BuildPreset::Medium);
        let shaded = |buffer: VisibilityBuffer| {
            let radiance = shade(&scene, &buffer, Effects::of(&scene), &|| ()).radiance;
            let seen = |visible: &Option<_>| f64::from(u8::from(visible.is_some()));
            let alpha = buffer.visible.iter().map(seen).collect();
            Answered { buffer, layers: Layers::none(window), radiance, alpha }
        };
        let cast = shaded(cast(&scene, &tree, window, Counting::All, &|| ()));
        let raster = shaded(rasterize(&scene, window, Counting::All, &|| ()));
        let options = CheckOptions { audited_pixels: 40, ..CheckOptions::default() };
        let judge = |answers: &[Answered; 2]| check::judge(&scene, answers, &options, &Unwatched);
        let [plain, exchanged] =
            [judge(&[cast.clone(), raster.clone()]), judge(&[raster.clone(), cast.clone()])];
        assert_eq!(plain.outcome(), Outcome::Agreement, "{name}");
        assert_eq!(exchanged.outcome(), Outcome::Agreement, "{name}");
        assert_eq!(plain.tied_pixels, exchanged.tied_pixels, "{name}");
        assert_eq!(plain.covered_pixels, exchanged.covered_pixels, "{name}");
        // Take one winner away from either.
        let lost = cast.buffer.visible.iter().position(Option::is_some).unwrap();
        let damaged = |answer: &Answered| {
            let mut answer = answer.clone();
            answer.buffer.visible[lost] = None;
            answer
        };
        let blames = [
            (Blame::Cast, [damaged(&cast), raster.clone()]),
            (Blame::Raster, [cast.clone(), damaged(&raster)]),
            (Blame::Cast, [damaged(&raster), cast.clone()]),
            (Blame::Raster, [raster.clone(), damaged(&cast)]),
        ];
        for (blame, answers) in blames {
            let report = judge(&answers);
            assert_eq!(report.differences.len(), 1, "{name}");
            assert_eq!(report.blamed(blame), 1, "{name}");
        }
    }
}
