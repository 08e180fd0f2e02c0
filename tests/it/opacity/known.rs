//! Known answers: what two, three or a thousand surfaces make of a pixel.

use super::{agreed, answer, glow, glowing};
use crate::support::scenes::{Triangle, rectangle, standard_scene};
use truecast::render::VisibilityPath;
use truecast::scene::material::Material;
use truecast::shade::Effects;

const RED: [f64; 3] = [1.0, 0.0, 0.0];
const GREEN: [f64; 3] = [0.0, 1.0, 0.0];

/// Error of a thousand surfaces blended, u = 2^-53: T after k surfaces carries 2k roundings (the
/// factor 1 − o and the product), each of the k summands two more and each sum one: at most
/// 3·1000 + 2 of them, all values at most 1.
const THOUSAND_LAYERS: f64 = 3002.0 * f64::EPSILON / 2.0;

/// A square that covers every pixel of G(8) from depth 8 to 16.
fn square(z: f32, material: Material) -> [(Triangle, Material); 2] {
    let side = 32.0;
    rectangle([-side, -side], [side, side], z).map(|triangle| (triangle, material.clone()))
}

/// Radiance and alpha, which all pixels share.
#[track_caller]
fn everywhere(name: &str, squares: &[[(Triangle, Material); 2]]) -> ([f64; 3], f64) {
    let seen = agreed(name, &glowing(squares.as_flattened())).exposure;
    let first = (seen.radiance[0], seen.alpha[0]);
    assert!(seen.radiance.iter().all(|&radiance| radiance == first.0), "{name}");
    assert!(seen.alpha.iter().all(|&alpha| alpha == first.1), "{name}");
    first
}

#[test]
fn two_half_transparent_squares_in_any_order_of_file() {
    let (near, far) = (square(8.0, glow(RED, 0.5)), square(16.0, glow(GREEN, 0.5)));
    let expected = ([0.5, 0.25, 0.25], 0.75);
    assert_eq!(everywhere("near first", &[near.clone(), far.clone()]), expected);
    assert_eq!(everywhere("far first", &[far, near]), expected);
}

#[test]
fn in_one_plane_the_lower_id_is_nearer() {
    let (red, green) = (square(8.0, glow(RED, 0.5)), square(8.0, glow(GREEN, 0.25)));
    let name = "one plane";
    assert_eq!(everywhere(name, &[red.clone(), green.clone()]), ([0.5, 0.125, 0.375], 0.625));
    assert_eq!(everywhere(name, &[green.clone(), red.clone()]), ([0.375, 0.25, 0.375], 0.625));
    // Three times the same triangles, bit for bit: three surfaces, folded in the trees.
    let thrice = everywhere("thrice", &[red.clone(), red.clone(), red.clone()]);
    assert_eq!(thrice, ([0.875, 0.0, 0.125], 0.875));
    // Bitwise copies that wear different materials, one of them opaque.
    let solid = square(8.0, glow(GREEN, 1.0));
    let hidden = square(8.0, glow([7.0; 3], 0.5));
    let ended = everywhere("copies end it", &[red, solid, hidden]);
    assert_eq!(ended, ([0.5, 0.5, 0.0], 1.0));
}

#[test]
fn an_opaque_square_in_the_middle_hides_the_rest() {
    let squares = [
        square(8.0, glow(RED, 0.25)),
        square(15.0, glow([9.0; 3], 0.5)),
        square(12.0, glow(GREEN, 1.0)),
        square(10.0, glow(RED, 0.5)),
    ];
    let seen = agreed("opaque in the middle", &glowing(squares.as_flattened()));
    // T is 0.75 and 0.375 behind the two see-through squares.
    assert!(seen.exposure.radiance.iter().all(|c| *c == [0.25 + 0.375, 0.375, 0.0]));
    assert!(seen.exposure.alpha.iter().all(|&alpha| alpha == 1.0));
    assert_eq!((seen.layers.most(), seen.layers.layered_pixels()), (2, 289));
}

#[test]
fn nothing_is_shown_of_opacity_0_but_it_stays_the_nearest() {
    let squares = [square(12.0, glow(GREEN, 1.0)), square(8.0, glow([f64::MAX; 3], 0.0))];
    let seen = agreed("opacity 0", &glowing(squares.as_flattened()));
    assert!(seen.exposure.radiance.iter().all(|radiance| *radiance == GREEN));
    assert!(seen.nearest.visible.iter().all(|v| v.unwrap().triangle.get() >= 2));
    let alone = everywhere("opacity 0 alone", &[square(8.0, glow(RED, 0.0))]);
    assert_eq!(alone, ([0.0, 0.0, 1.0], 0.0));
}

#[test]
fn a_thousand_faint_layers_are_the_closed_form() {
    let opacity = 0.01;
    let depth = |k: usize| 8.0 + (k * 389 % 1000) as f32 / 128.0;
    let squares: Vec<_> = (0..1000).map(|k| square(depth(k), glow(RED, opacity))).collect();
    let scene = glowing(squares.as_flattened());
    // (1 − o)^1000 by another way; its own error is 1e-13 of 4e-5.
    let through = (1000.0 * (-opacity).ln_1p()).exp();
    for path in [VisibilityPath::Cast, VisibilityPath::Raster] {
        let seen = answer(&scene, path, Effects::of(&scene));
        assert_eq!(seen.layers.most(), 999);
        for (radiance, alpha) in seen.exposure.radiance.iter().zip(&seen.exposure.alpha) {
            assert!((alpha - (1.0 - through)).abs() <= THOUSAND_LAYERS, "{alpha}");
            assert!((radiance[0] - (1.0 - through)).abs() <= THOUSAND_LAYERS, "{radiance:?}");
            assert!((radiance[2] - through).abs() <= THOUSAND_LAYERS, "{radiance:?}");
        }
    }
}

/// Three leaves that pierce each other: which is nearer changes along the lines where they meet,
/// and the picture does not hang on the order of the file.
#[test]
fn three_leaves_through_each_other() {
    let leaves = [
        ([[-9.0, -9.0, 6.0], [11.0, -7.0, 12.0], [-1.0, 13.0, 9.0]], glow(RED, 0.5)),
        ([[9.0, -9.0, 6.0], [-11.0, -7.0, 12.0], [1.0, 13.0, 9.0]], glow(GREEN, 0.25)),
        ([[0.0, 11.0, 6.0], [-10.0, -7.0, 9.0], [10.0, -8.0, 12.0]], glow([0.5; 3], 0.75)),
    ];
    let [a, b, c] = leaves.clone();
    let scene = glowing(&leaves);
    let reference = agreed("three leaves", &scene);
    let orders: std::collections::BTreeSet<Vec<u32>> = (0..289)
        .filter_map(|index| {
            let nearest = reference.nearest.visible[index]?.triangle.get();
            let behind = reference.layers.of(index).iter().map(|v| v.triangle.get());
            Some(std::iter::once(nearest).chain(behind).collect())
        })
        .collect();
    assert!(orders.iter().filter(|order| order.len() == 3).count() >= 3, "{orders:?}");
    // No two corners share a plane: only ties of the same depth could change with the order.
    for order in [[&b, &c, &a], [&c, &b, &a], [&b, &a, &c]] {
        let turned = agreed("leaves in another order", &glowing(&order.map(Clone::clone)));
        assert_eq!(turned.exposure.radiance, reference.exposure.radiance);
        assert_eq!(turned.exposure.alpha, reference.exposure.alpha);
    }
}

/// Forced on, the effects of pixels change no bit of an opaque picture.
#[test]
fn opaque_scenes_do_not_notice() {
    let mut triangles = crate::support::closed::integer_chaos(7);
    triangles.iter_mut().flatten().for_each(|corner| corner[2] += 8.0);
    let scene = standard_scene(&triangles);
    for path in [VisibilityPath::Cast, VisibilityPath::Raster] {
        let plain = answer(&scene, path, Effects::of(&scene));
        let forced = answer(&scene, path, Effects::ALL);
        assert!(plain.layers.is_empty());
        assert_eq!(plain.exposure, forced.exposure);
        let covered = plain.exposure.alpha.iter().filter(|&&alpha| alpha == 1.0).count();
        assert_eq!(covered, plain.nearest.covered_pixels());
        assert!(covered > 20 && covered < 289, "{covered}");
    }
}
