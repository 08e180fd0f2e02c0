//! A71: Phong's highlights against Blinn's. A78: what exponent and coefficient do.

use super::stage::{Picture, V3, angle_deg, cross, dot, halfway, sheet, unit};
use truecast::scene::Scene;
use truecast::scene::light::Light;
use truecast::scene::switches::SwitchValue;

/// How far a measured half width may fall short, in degrees of the normal: the outermost pixel of a
/// highlight may lie one pixel inside its rim. The sphere's radius is 79 pixels, and where the rims
/// of the table cross the sphere, at most 55° from its middle on the side that is measured, a pixel
/// spans at most 1/(79 cos 55°) radians.
const PIXEL_DEG: f64 = 1.3;

/// How far it may exceed, in degrees: outside the plane of L and V Phong's lobe is longer, by the
/// square of the pixel that counts as in the plane (1/79 radian) over sin 6.7°, the least angle
/// between R and V in the table.
const OFF_PLANE_DEG: f64 = 0.08;

/// The scene with its specular light alone, seen from infinity, so that R and H are one-to-one with
/// the normal; and the directions to light and eye.
fn specular_alone(scene: &Scene) -> (Scene, V3, V3) {
    let mut scene = scene.clone();
    for material in &mut scene.materials {
        (material.ka, material.kd) = ([0.0; 3], [0.0; 3]);
    }
    scene.switches = scene.switches.with("viewer", SwitchValue::Word("distant"));
    let to_light = scene
        .lights
        .iter()
        .find_map(|light| match light {
            Light::Directional(light) => Some(light.aim.map(|c| -c)),
            _ => None,
        })
        .unwrap();
    (scene, to_light, [0.0, 0.0, 1.0])
}

/// The largest angle between N and H among pixels with at least half of the peak and with N in the
/// plane of L and V, give or take a pixel; and the number of all pixels with half of the peak.
fn half_width(scene: &Scene) -> (f64, usize) {
    let (scene, to_light, to_eye) = specular_alone(scene);
    let intensity = match &scene.lights[..] {
        [.., Light::Directional(light)] => light.colors.specular[0],
        other => panic!("{other:?}"),
    };
    let half = 0.5 * intensity * scene.materials[0].ks[0];
    let picture = Picture::of(&scene);
    let h = halfway(to_light, to_eye);
    let bright: Vec<usize> =
        picture.pixels_of(0).filter(|&pixel| picture.rgb[pixel][0] >= half).collect();
    let across = unit(cross(to_light, to_eye));
    let normals = bright.iter().map(|&pixel| picture.normals[pixel]);
    let in_plane = normals.filter(|&n| dot(n, across).abs() < 1.0 / 79.0);
    (in_plane.map(|n| angle_deg(n, h)).fold(0.0, f64::max), bright.len())
}

#[test]
fn a71_half_widths_are_those_of_the_formulas_and_blinns_twice_phongs() {
    let cells = sheet("phong-vs-blinn").cells;
    assert_eq!(cells.len(), 6);
    for (column, n) in [1.0_f64, 10.0, 100.0].into_iter().enumerate() {
        // cos^n x = 1/2 in the angle between R and V, which is twice that between N and H.
        let lobe = 0.5_f64.powf(1.0 / n).acos().to_degrees();
        for (row, expected) in [(0, lobe / 2.0), (1, lobe)] {
            let scene = &cells[3 * row + column].scene;
            assert_eq!(scene.materials[0].ns, n);
            let (measured, pixels) = half_width(scene);
            assert!(pixels > 50);
            let range = expected - PIXEL_DEG..=expected + OFF_PLANE_DEG;
            assert!(range.contains(&measured), "row {row} n {n}: {measured}, not {expected}");
        }
    }
}

#[test]
fn a71_at_shininess_one_phong_ends_at_90_degrees_and_blinn_is_seen_well_past_them() {
    let cells = sheet("phong-vs-blinn").cells;
    let [phong, blinn] = [0, 3].map(|cell| {
        let (scene, to_light, to_eye) = specular_alone(&cells[cell].scene);
        (Picture::of(&scene), to_light, to_eye, scene.materials[0].ks[0])
    });
    let (mut within, mut past) = (0, 0);
    for pixel in phong.0.pixels_of(0) {
        let (n, l, v) = (phong.0.normals[pixel], phong.1, phong.2);
        let reflected: V3 = std::array::from_fn(|k| 2.0 * dot(n, l) * n[k] - l[k]);
        let away = angle_deg(reflected, v);
        let [phongs, blinns] = [&phong, &blinn].map(|cell| cell.0.rgb[pixel][0] / cell.3);
        // Up to the rounding to f32, where both have their peak.
        assert!(blinns >= phongs - 1e-6, "Blinn's is the wider: {blinns} {phongs}");
        // A twentieth of a degree for the normal's rounding to f32.
        if away < 89.95 {
            assert!(phongs > 0.0);
            within += 1;
        } else if (90.05..120.0).contains(&away) {
            assert_eq!(phongs, 0.0, "{away}");
            // Of all normals with R·V = cos 120°, those in the plane of L and V have N·H = cos 60°,
            // and no other less than √((L·V − 1/2)/(L·V + 1)) = 0.312.
            assert!(blinns > 0.31, "{away} {blinns}");
            past += 1;
        }
    }
    assert!(within > 5000 && past > 2000, "{within} {past}");
}

#[test]
fn four_times_the_exponent_gives_blinn_phongs_highlight() {
    let cells = sheet("four-n-rule").cells;
    let pictures: Vec<_> = cells.iter().map(|cell| Picture::of(&cell.scene)).collect();
    let [phong, matched, same] = &pictures[..] else { panic!("three cells") };
    let (near, far) = (phong.difference(matched, None), phong.difference(same, None));
    assert!(near * 4.0 < far, "{near} {far}");
}

#[test]
fn a78_highlights_grow_brighter_with_ks_and_narrower_with_ns() {
    let cells = sheet("parameters").cells;
    assert_eq!(cells.len(), 9);
    let pictures: Vec<_> = cells.iter().map(|cell| Picture::of(&cell.scene)).collect();
    for column in 0..3 {
        for row in 1..3 {
            let (dim, bright) = (&pictures[3 * (row - 1) + column], &pictures[3 * row + column]);
            let mut brighter = 0;
            for pixel in dim.pixels_of(0) {
                let [one, other] = [dim, bright].map(|picture| picture.rgb[pixel]);
                assert!((0..3).all(|k| other[k] >= one[k]), "{one:?} {other:?}");
                brighter += usize::from(bright.rgb[pixel][0] > dim.rgb[pixel][0]);
            }
            assert!(brighter > 1000, "{brighter}");
        }
    }
    for row in cells.chunks(3) {
        let widths: Vec<_> = row.iter().map(|cell| half_width(&cell.scene)).collect();
        assert!(
            widths.windows(2).all(|w| 2.0 * w[1].0 < w[0].0 && 2 * w[1].1 < w[0].1),
            "{widths:?}"
        );
    }
}
