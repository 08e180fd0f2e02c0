//! Golden scenes, and what must not change an answer: presets, tiles, crops, threads.

use super::*;

#[test]
fn golden_scenes_for_every_preset_and_tile_size() {
    let goldens = goldens();
    assert_eq!(goldens.len(), 26);
    for golden in &goldens {
        let scene = golden.scene();
        let buffer = agreed(&scene);
        assert_eq!(ids(&buffer), golden.ids, "{}", golden.name);
        let cover = buffer.cover.as_ref().unwrap();
        let crossed: Vec<u32> = cover.iter().map(|c| c.crossed).collect();
        let signed: Vec<i32> = cover.iter().map(|c| c.signed).collect();
        assert_eq!(crossed, golden.cover_count, "{}", golden.name);
        assert_eq!(signed, golden.signed_count, "{}", golden.name);
        assert_finite(&buffer);
        let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Medium);
        let window = scene.camera.resolution().window();
        for side in [1, 3, 16, 64] {
            let tiled = cast_in(&scene, &accelerator, window, Counting::All, side);
            assert_same(&buffer, &tiled);
            assert_eq!(buffer.cover, tiled.cover);
            let tiled = cast_in(&scene, &accelerator, window, Counting::Nearest, side);
            assert_same(&buffer, &tiled);
        }
    }
}

#[test]
fn a_crop_is_a_part_of_its_frame() {
    let golden = &goldens()[5];
    let scene = golden.scene();
    let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Fast);
    let whole = nearest(&scene, &accelerator);
    let window = Window::new(scene.camera.resolution(), 3, 5, 14, 11).unwrap();
    let crop = cast(&scene, &accelerator, window, Counting::Nearest, &|| ());
    for pixel in window.pixels() {
        assert_eq!(whole.at(pixel), crop.at(pixel));
    }
    assert!(crop.cover.is_none());
}

#[test]
fn threads_do_not_change_a_bit() {
    let triangles = sphere(24, 48, 3.0, [0.0, 0.0, 9.0]);
    let camera = PinholeCamera::look_at(
        Resolution::new(160, 120).unwrap(),
        [0.1, 0.2, 0.0],
        [0.0, 0.0, 9.0],
        [0.0, 1.0, 0.0],
        50.0,
    )
    .unwrap();
    let scene = Scene::from_triangles(camera, &triangles);
    let with_threads = |count: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build().unwrap();
        pool.install(|| {
            let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Slow);
            all(&scene, &accelerator)
        })
    };
    let (one, two) = (with_threads(1), with_threads(2));
    assert_same(&one, &two);
    assert_eq!(one.cover, two.cover);
    assert!(covered(&one) > 5000);
    // A closed sphere seen from outside: two crossings, net zero.
    assert!(one.cover.unwrap().iter().all(|c| c.signed == 0 && c.crossed % 2 == 0));
}
