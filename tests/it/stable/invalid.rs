//! The plane `invalid`: each bit where a scene has its case, and nowhere else.

use super::normals::hinge;
use super::*;
use truecast::film::{Samples, decode_exr, encode_exr};
use truecast::render::{PlaneGroup, PlaneGroups, RenderOptions, render};
use truecast::shade::doubt;

/// The plane of a rendered scene, after a way through EXR.
fn plane(scene: &Scene) -> Vec<u32> {
    let planes = PlaneGroups::default().with(PlaneGroup::Color).with(PlaneGroup::Invalid);
    let frame = render(scene, &RenderOptions { planes, ..RenderOptions::default() }, &Unwatched);
    let read = decode_exr(&encode_exr(&frame.film).unwrap()).unwrap();
    assert_eq!(read.plane("invalid"), frame.film.plane("invalid"));
    let Some(Samples::Uint(bits)) = read.plane("invalid") else { panic!("no plane of integers") };
    // The plane and the counts tell of the same cases.
    let any = |bit: u32| bits.iter().any(|bits| bits & bit != 0);
    let notes = frame.account.notes;
    for (bit, count) in [
        (doubt::LIGHT_AT_SURFACE, notes.lights_at_surface),
        (doubt::NEAR_TERMINATOR, notes.near_terminator),
        (doubt::OPPOSITE_VIEW, notes.opposite_view),
        (doubt::CANCELLED_NORMAL, notes.cancelled_normals),
        (doubt::MISSING_NORMAL, notes.missing_normals),
        (doubt::CANCELLED_VECTORS, notes.cancelled_vectors),
        (doubt::PERSPECTIVE_KEPT, notes.perspective_kept),
        (doubt::BEYOND_RANGE, frame.film.infinite_pixels() as u64),
    ] {
        assert_eq!(any(bit), count > 0, "bit {bit}: {notes:?}");
    }
    bits.clone()
}

/// Where the plane is not 0, as points (x, y) of z = 0 with the bits.
fn marked(scene: &Scene) -> Vec<(i32, i32, u32)> {
    let window = scene.camera.resolution().window();
    let at = |index: usize| {
        let pixel = window.pixel(index);
        (pixel.x as i32 - 8, 8 - pixel.y as i32)
    };
    let bits = plane(scene);
    let doubtful = bits.iter().enumerate().filter(|(_, bits)| **bits != 0);
    doubtful.map(|(index, &bits)| (at(index).0, at(index).1, bits)).collect()
}

fn grid(obj: String) -> Setup {
    Setup::of(GRID.to_owned(), obj)
}

#[test]
fn a_faultless_picture_has_no_bit() {
    let setup = grid(plate([0.1, 0.2, 1.0])).lit(&directional([0.3, 0.1, 1.0]));
    assert_eq!(marked(&setup.scene()), []);
}

#[test]
fn a_light_in_the_surface_and_its_terminator() {
    // N = (1, 0, 1)/√2 and a light at (1, −1, 0): N·L is exactly 0 where x = 1, and L is missing at
    // the light.
    let setup = grid(plate([1.0, 0.0, 1.0])).lit(&point([1.0, -1.0, 0.0], [1.0, 0.0, 0.0]));
    let marked = marked(&setup.scene());
    let right = |&(x, y, bits): &(i32, i32, u32)| {
        x == 1 && bits == if y == -1 { doubt::LIGHT_AT_SURFACE } else { doubt::NEAR_TERMINATOR }
    };
    assert!(marked.iter().all(right) && marked.len() > 6, "{marked:?}");
    assert!(marked.contains(&(1, -1, 1)) && marked.contains(&(1, 0, 2)));
}

#[test]
fn a_light_against_the_eye() {
    let setup = grid(plate(UP)).glossy(5.0).switched("backlit_specular = \"none\"");
    let scene = setup.lit(&directional([0.0, 0.0, -1.0])).scene();
    assert_eq!(marked(&scene), [(0, 0, 4)]);
}

#[test]
fn normals_that_cancel() {
    let setup = grid(hinge([1.0, 0.0, 0.0], [-1.0, 0.0, 0.0])).lit(&directional([0.3, 0.1, 1.0]));
    assert_eq!(marked(&setup.scene()), [(0, 0, 8)]);
}

/// A needle along y = x that is 2^-80 wide at the origin: in f64 its edges are parallel. The eye
/// is half of that beside the line, so the ray of the middle pixel is strictly inside.
fn needle() -> Setup {
    let width = 2.0_f64.powi(-80);
    let mut setup = grid(format!("v {width:?} {:?} 0\nv -4 -4 0\nv 4 4 0\nf 1 2 3\n", -width));
    let eye = format!("[{:?}, {:?}, 8.0]", width / 2.0, -width / 2.0);
    setup.view = GRID.replace("[0.0, 0.0, 8.0]", &eye);
    setup
}

#[test]
fn a_face_without_a_normal() {
    let marked = marked(&needle().lit(&directional([0.3, 0.1, 1.0])).scene());
    assert!(marked.contains(&(0, 0, 16)), "{marked:?}");
    // At (k, k) the needle is 2^-80·(1 − |k|/4) wide.
    assert!(marked.iter().all(|&(x, y, bits)| x == y && x.abs() <= 2 && bits == 16), "{marked:?}");
}

#[test]
fn a_face_without_a_normal_gets_ambient_light_only() {
    let hemisphere =
        "type = \"hemisphere\"\ndirection = [0, 1, 0]\ntop = [1, 1, 1]\nbottom = [1, 0, 0]\n";
    let sun = directional([0.3, 0.1, 1.0]) + "ambient = [0.25, 0.25, 0.25]\n";
    let mut setup = needle().lit(&sun).lit(hemisphere);
    setup.material = "kd = [1, 1, 1]\nka = [1, 1, 1]\nks = [1, 1, 1]\nns = 0\n".to_owned();
    for gate in ["le0", "lt0", "none"] {
        for (lobe, curve) in [("blinn", "cosine"), ("phong", "sine"), ("blinn", "linear")] {
            let switches = format!(
                "backlit_specular = \"{gate}\"\nspecular = \"{lobe}\"\nhemisphere = \"{curve}\""
            );
            let scene = setup.clone().switched(&switches).scene();
            for (seen, rgb) in visible(&scene).visible.iter().zip(shaded(&scene).radiance) {
                let right = if seen.is_some() { 0.25 } else { 0.0 };
                assert_eq!(rgb, [right; 3], "{switches}");
            }
        }
    }
}

#[test]
fn directions_that_cancel() {
    // On the hinge, half way between its ends, the light at (1, 0, 0) lies exactly between them.
    let normal = [0.31, 0.17, 1.0];
    let setup = grid(hinge(normal, normal)).switched("fragment_vectors = \"interpolate\"");
    let scene = setup.lit(&point([1.0, 0.0, 0.0], [1.0, 0.0, 0.0])).scene();
    assert_eq!(marked(&scene), [(0, 0, 32), (1, 0, 1)]);
}

#[test]
fn directions_to_the_eye_that_cancel() {
    // The eye is 1e-7 above the middle of the hinge: from its ends, 8 apart, the eye lies in
    // opposite directions. The diffuse part stays, no highlight is made up.
    let mut setup = Setup::of(view([0.0, 0.0, 1e-7], [0.0, 0.0, -8.0]), hinge(UP, UP))
        .switched("fragment_vectors = \"interpolate\"")
        .lit(&directional([0.6, 0.0, 0.8]));
    setup.material = "kd = [1, 1, 1]\nks = [1, 1, 1]\nns = 0\n".to_owned();
    assert_near(setup.value(), 0.8, TOLERANCE);
    assert_eq!(plane(&setup.scene()), [32]);
    setup.view = view([0.0, 0.0, 1e-3], [0.0, 0.0, -8.0]);
    assert_near(setup.value(), 1.8, TOLERANCE);
    assert_eq!(plane(&setup.scene()), [0]);
}

#[test]
fn weights_that_stay_perspective_correct() {
    // A floor that passes under the eye, beside a plate before it.
    let obj = "v -64 -2 -20\nv 64 -2 -20\nv 0 -2 40\nv -3 1 0\nv 3 1 0\nv 0 7 0\nvn 0.1 0.2 1\n\
               f 1//1 2//1 3//1\nf 4//1 5//1 6//1\n";
    let setup = grid(obj.to_owned()).switched("interpolation = \"screen\"");
    let scene = setup.lit(&directional([0.3, 0.1, 1.0])).scene();
    let marked = marked(&scene);
    assert_eq!(marked.len(), 17 * 8);
    assert!(marked.iter().all(|&(_, y, bits)| y < 0 && bits == 64), "{marked:?}");
}

#[test]
fn colours_beyond_f32() {
    let mut setup = grid(plate(UP));
    setup.material = "kd = [0, 0, 0]\nke = [0, 1e39, 0]\n".to_owned();
    let scene = setup.scene();
    let bits = plane(&scene);
    for (seen, bits) in visible(&scene).visible.iter().zip(&bits) {
        assert_eq!(*bits, if seen.is_some() { 128 } else { 0 });
    }
    // Seen through as half of the pixel, 1e39 is still beyond, and 5e38 is not.
    setup.material = "kd = [0, 0, 0]\nke = [0, 5e38, 0]\nopacity = 0.5\n".to_owned();
    assert_eq!(marked(&setup.scene()), []);
    // The background, where nothing is visible.
    let background = "background = [0, 0, 1e300]\n[camera.exact]";
    setup.view = GRID.replace("[camera.exact]", background);
    setup.material = "kd = [0, 0, 0]\n".to_owned();
    let scene = setup.scene();
    for (seen, bits) in visible(&scene).visible.iter().zip(plane(&scene)) {
        assert_eq!(bits, if seen.is_some() { 0 } else { 128 });
    }
}

#[test]
fn corners_that_share_their_colours_mark_every_pixel() {
    // A light at a corner of a Gouraud triangle: counted once per row, met by all its pixels.
    let setup = grid(plate(UP)).meshed("shading = \"gouraud\"\n");
    let scene = setup.lit(&point([0.0, 7.0, 0.0], [1.0, 0.0, 0.0])).scene();
    let bits = plane(&scene);
    for (seen, bits) in visible(&scene).visible.iter().zip(&bits) {
        // The other two corners see it edge-on.
        assert_eq!(*bits, if seen.is_some() { 3 } else { 0 });
    }
}
