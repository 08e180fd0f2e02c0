//! What is interpolated over a triangle: S12 to S14, S32 to S34.

use super::*;
use dashu_ratio::RBig;

/// Looks along z from the origin at a strip from depth 1 on the left to `depth` on the right, at
/// the middle of its picture; the attribute runs from 0 to 1.
fn strip(depth: f64, far_x: f64, switches: &str) -> (f64, Option<[f64; 2]>, u64) {
    // The right end is one corner: its weight is the attribute.
    let obj = format!(
        "v -1 -0.5 1 0 0 0\nv -1 0.5 1 0 0 0\nv {far_x:?} 0 {depth:?} 1 1 1\n\
         vt 0 0\nvt 0 1\nvt 1 0.5\nf 1/1 2/2 3/3\n"
    );
    let setup = Setup::of(view([0.0; 3], [0.0, 0.0, 1.0]), obj)
        .meshed("shading = \"vertex-color\"\n")
        .switched(switches);
    let scene = setup.scene();
    let buffer = visible(&scene);
    let shaded = shade::shade(&scene, &buffer, Effects::of(&scene), &|| ());
    let pixel = buffer.window.pixel(0);
    let (surface, _) = shade::surface_point(&scene, pixel, &buffer.visible[0].unwrap());
    (shaded.radiance[0][0], surface.uv, shaded.notes.perspective_kept)
}

/// 1/101.
const RIGHT: f64 = 0.009_900_990_099_009_901;

#[test]
fn s12_weights_follow_the_perspective() {
    let (color, _, kept) = strip(100.0, 100.0, "");
    assert_near(color, RIGHT, TOLERANCE);
    assert_eq!(kept, 0);
    // Linear on the screen, where a scene asks for it.
    let (color, _, kept) = strip(100.0, 100.0, "interpolation = \"screen\"");
    assert_near(color, 0.5, TOLERANCE);
    assert_eq!(kept, 0);
    // A corner on the eye plane or behind it: 1/w is infinite or mirrored, the weights are not.
    for depth in [0.0, -50.0, -98.0] {
        assert_near(strip(depth, 100.0, "").0, RIGHT, TOLERANCE);
        let (color, _, kept) = strip(depth, 100.0, "interpolation = \"screen\"");
        assert_near(color, RIGHT, TOLERANCE);
        assert!(kept > 0);
    }
}

/// det(a, b, c), exactly.
fn det(a: &[RBig; 3], b: &[RBig; 3], c: &[RBig; 3]) -> RBig {
    let minor = |i: usize, j: usize| &b[i] * &c[j] - &b[j] * &c[i];
    &a[0] * minor(1, 2) - &a[1] * minor(0, 2) + &a[2] * minor(0, 1)
}

#[test]
fn s13_a_tiny_triangle_far_away_has_its_weights() {
    // A triangle of 1e-3 at a distance of 1000, seen from the origin; one corner in each colour.
    let obj = "v 577.0 577.001 578.0 1 0 0\nv 577.001 577.0 578.0005 0 1 0\n\
               v 577.0005 577.0008 577.999 0 0 1\nf 1 2 3\n";
    let setup = Setup::of(view([0.0; 3], [577.000_6, 577.000_5, 577.999_8]), obj.to_owned())
        .meshed("shading = \"vertex-color\"\n");
    let scene = setup.scene();
    let weights = shaded(&scene).radiance[0];
    // W_i = det(a_j, a_k, d) in rational arithmetic.
    let exact = |v: V3| v.map(|c| RBig::try_from(c).unwrap());
    let camera = &scene.camera;
    let d: V3 =
        std::array::from_fn(|k| camera.d0()[k] + 0.5 * camera.dx()[k] + 0.5 * camera.dy()[k]);
    let d = exact(d);
    let triangle = scene.mesh.triangle(truecast::mesh::TriangleId::new(0));
    let a = triangle.map(|corner| exact(corner.map(f64::from)));
    let volumes = [det(&a[1], &a[2], &d), det(&a[2], &a[0], &d), det(&a[0], &a[1], &d)];
    let sum = &volumes[0] + &volumes[1] + &volumes[2];
    let right = volumes.map(|volume| (volume / &sum).to_f64().value());
    assert!(right.iter().all(|weight| *weight > 0.1), "{right:?}");
    for k in 0..3 {
        assert_near(weights[k], right[k], TOLERANCE);
    }
}

/// A quad of side 2 under a lamp 1 above its centre, ns = 50.
fn quad(shading: &str) -> Setup {
    let obj = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\n";
    Setup::of(view([0.0, 0.0, 8.0], [0.0, 0.0, -8.0]), obj.to_owned())
        .glossy(50.0)
        .meshed(&format!("shading = \"{shading}\"\n"))
        .lit(&point([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]))
}

#[test]
fn s14_gouraud_misses_the_highlight_between_the_corners() {
    assert_near(quad("phong").value(), 1.0, TOLERANCE);
    // Every corner alike: L = (−1, −1, 1)/√3, V = (−1, −1, 8)/√66, (N·H)^50 to 50 digits.
    assert_near(quad("gouraud").value(), 0.000_213_941_121_446_336_05, TOLERANCE);
}

#[test]
fn s32_an_attribute_at_the_middle_of_the_picture() {
    let (_, uv, _) = strip(100.0, 100.0, "");
    let [u, v] = uv.unwrap();
    assert_near(u, RIGHT, TOLERANCE);
    assert_near(v, 0.5, TOLERANCE);
    let (_, uv, _) = strip(100.0, 100.0, "interpolation = \"screen\"");
    assert_near(uv.unwrap()[0], 0.5, TOLERANCE);
}

#[test]
fn s33_equal_normals_make_all_shadings_equal() {
    let picture = |shading: &str, dialect: &str, gloss: &str| {
        let text = format!(
            "version = 1\ndialect = \"{dialect}\"\n[image]\nwidth = 16\nheight = 12\n\
             [camera]\neye = [1, 3, 5]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 40\n\
             [[material]]\nname = \"m\"\nkd = [0.7, 0.5, 0.3]\n{gloss}\
             [[mesh]]\nshape = {{ plane = {{ width = 3, depth = 2 }} }}\nmaterial = \"m\"\n\
             rotate_deg = [10, 20, 30]\nshading = \"{shading}\"\n\
             [[light]]\ntype = \"directional\"\naim = [1, -3, -2]\nintensity = [0.9, 1.7, 0.3]\n\
             ambient = [0.1, 0.2, 0.3]\n"
        );
        shaded(&load(&text, "")).radiance
    };
    // Matte in every dialect, and with a highlight where the eye is distant.
    let mut cases: Vec<(&str, &str)> =
        truecast::scene::switches::DIALECTS.iter().map(|dialect| (*dialect, "")).collect();
    cases.push(("opengl", "ks = [0.5, 0.5, 0.5]\nns = 20\n"));
    for (dialect, gloss) in cases {
        let phong = picture("phong", dialect, gloss);
        assert!(phong.iter().filter(|rgb| rgb[0] > 0.1).count() > 20, "{dialect}");
        for shading in ["flat", "gouraud"] {
            let other = picture(shading, dialect, gloss);
            for (a, b) in phong.iter().flatten().zip(other.iter().flatten()) {
                let (a, b) = (*a as f32, *b as f32);
                assert!(a.to_bits().abs_diff(b.to_bits()) <= 1, "{dialect} {shading}: {a} {b}");
            }
        }
    }
}

#[test]
fn s34_gouraud_stays_below_its_corners_and_phong_need_not() {
    let scene = |shading: &str| {
        let text = format!(
            "version = 1\n[image]\nwidth = 32\nheight = 24\n[camera]\neye = [0, 0, 5]\n\
             target = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 30\n\
             [[material]]\nname = \"m\"\nkd = [0.1, 0.2, 0.3]\nks = [1, 1, 1]\nns = 60\n\
             [[mesh]]\nshape = {{ uv_sphere = {{ around = 11, rings = 7 }} }}\nmaterial = \"m\"\n\
             shading = \"{shading}\"\n\
             [[light]]\ntype = \"point\"\nposition = [1, 2, 4]\nintensity = [1, 1, 1]\n"
        );
        load(&text, "")
    };
    let gouraud = scene("gouraud");
    let buffer = visible(&gouraud);
    let phong = shaded(&scene("phong")).radiance;
    let mut exceeding = 0;
    for (index, seen) in buffer.visible.iter().enumerate() {
        let Some(seen) = seen else { continue };
        let terms = shade::terms(&gouraud, buffer.window.pixel(index), seen, None);
        let corner = |k: usize, channel: usize| {
            terms.elsewhere[k].1.iter().fold(terms.emission[channel], |sum, light| {
                sum + light.ambient[channel] + light.diffuse[channel] + light.specular[channel]
            })
        };
        for (channel, phong) in phong[index].into_iter().enumerate() {
            let most = (0..3).map(|k| corner(k, channel)).fold(0.0, f64::max);
            // Weights sum to 1 to a few roundings.
            let value = terms.sum()[channel];
            assert!(value <= most * (1.0 + 8.0 * f64::EPSILON), "{value} above {most}");
            exceeding += usize::from(phong > most * 1.01);
        }
    }
    assert!(exceeding > 10, "{exceeding}");
}
