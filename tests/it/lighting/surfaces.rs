//! Colours and normals of surfaces: unlit ones (A19), vertex colours (A20), nine coefficients (A23), the normals of
//! triangles, spheres and quads (A30–A32), transformed normals (A34), and two sides (A35).

use super::stage::{
    V3, answer, camera, colors, cross, directional, dot, pixel_at, point, program_picture, unit,
    white,
};
use super::{ULP, matte};
use crate::support::rays::closed_box;
use std::fs;
use std::path::Path;
use tempfile::TempDir;
use truecast::mesh::TriangleId;
use truecast::render::VisibilityPath;
use truecast::scene::material::Material;
use truecast::scene::shapes::{Icosphere, Shape, UvSphere, build};
use truecast::scene::{Overrides, Scene, Shading, Sides};

/// A unit vector after a cross product, a length and a division, per component.
const UNIT_BOUND: f64 = 4.0 * ULP;

fn close(a: V3, b: V3) -> bool {
    (0..3).all(|k| (a[k] - b[k]).abs() <= UNIT_BOUND)
}

/// A scene around one OBJ text; `keys` of its mesh.
fn load(obj: &str, head: &str, keys: &str) -> Scene {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("m.obj"), obj).unwrap();
    let text = format!(
        "version = 1\n{head}\n[image]\nwidth = 17\nheight = 17\n[camera]\neye = [0, 0, 9]\n\
         target = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 60\n[[mesh]]\nfile = \"m.obj\"\n{keys}\n"
    );
    Scene::from_toml(&text, Path::new("t.toml"), folder.path(), &Overrides::default()).unwrap()
}

#[test]
fn a19_a_surface_without_lighting_is_its_colour_under_any_lights() {
    let mut scene = super::neutrality::busy_scene();
    let kd = [0.3, 0.6, 1.2];
    for material in &mut scene.materials {
        *material = Material { kd, unlit: true, ..material.clone() };
    }
    let buffer = answer(&scene, VisibilityPath::Cast);
    let every_light = scene.lights.clone();
    for lights in [&every_light[..], &every_light[..1], &[]] {
        scene.lights = lights.to_vec();
        for shading in [Shading::Phong, Shading::Gouraud, Shading::Flat] {
            scene.objects[0].shading = shading;
            for (visible, rgb) in buffer.visible.iter().zip(program_picture(&scene)) {
                assert_eq!(rgb, if visible.is_some() { kd } else { scene.background });
            }
        }
    }
    assert!(buffer.covered_pixels() > 50);
}

#[test]
fn a20_the_picture_has_the_corners_colours_and_their_mean_in_the_middle() {
    // Three triangles around (0, 0), each of which has the others' rim corners too.
    let corners = [[-6.0, -6.0, 0.0], [6.0, -6.0, 0.0], [0.0, 6.0, 0.0], [0.0, 0.0, 0.0]];
    let mut scene = Scene::from_triangles(camera(), &[[corners[0]; 3]; 3]);
    scene.mesh.positions = corners.to_vec();
    scene.mesh.corners = vec![[0, 1, 3], [1, 2, 3], [2, 0, 3]];
    scene.mesh.colors = vec![[3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0], [0.1, 0.2, 0.7]];
    scene.objects[0].shading = Shading::VertexColor;
    scene.lights = vec![directional([0.0, 0.0, -1.0], white())];
    let at = |scene: &Scene, x, y| {
        program_picture(scene)[scene.camera.resolution().window().index(pixel_at(x, y))]
    };
    assert_eq!(at(&scene, 0, 0), [0.1, 0.2, 0.7]);
    // One triangle: the middle of its corners is (0, −2).
    scene.mesh.corners = vec![[0, 1, 2]];
    scene.objects[0].triangles = 0..1;
    scene.triangle_materials = vec![0];
    let middle = at(&scene, 0, -2);
    // A weight of 1/3 is off by 2^-48 at most.
    let bound = 3.0 * 2.0_f64.powi(-48);
    assert!(middle.iter().all(|value| (value - 1.0).abs() <= bound), "{middle:?}");
}

#[test]
fn a23_nine_coefficients_of_a_light_stay_apart() {
    let mut scene = super::stage::smooth_octahedron();
    scene.materials[0] = Material { ka: [0.5; 3], ks: [0.5; 3], ns: 3.0, ..matte([0.5; 3]) };
    let picture = |coefficients: [f64; 9]| {
        let part = |k: usize| std::array::from_fn(|c| coefficients[3 * k + c]);
        let mut lit = scene.clone();
        let light = colors(part(0), part(1), part(2));
        lit.lights = vec![point([2.0, 3.0, 9.0], [1.0, 0.0, 0.0], light)];
        program_picture(&lit)
    };
    let all = picture([0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1]);
    let mut sum = vec![[0.0; 3]; all.len()];
    let mut alone = Vec::new();
    for k in 0..9 {
        let one: [f64; 9] =
            std::array::from_fn(|i| if i == k { 0.3 + 0.1 * k as f64 } else { 0.0 });
        let picture = picture(one);
        for (sum, rgb) in sum.iter_mut().zip(&picture) {
            let others = [(k + 1) % 3, (k + 2) % 3];
            assert!(others.iter().all(|&channel| rgb[channel] == 0.0), "{k}: {rgb:?}");
            sum[k % 3] += rgb[k % 3];
        }
        alone.push(picture);
    }
    for (sum, all) in sum.iter().zip(&all) {
        assert!((0..3).all(|c| (sum[c] - all[c]).abs() <= 4.0 * ULP), "{sum:?} {all:?}");
    }
    // Red diffuse and blue specular light: a red body with a blue highlight.
    let (red, blue) = (&alone[3], &alone[8]);
    assert!(red.iter().any(|rgb| rgb[0] > 0.2) && blue.iter().any(|rgb| rgb[2] > 0.4));
}

#[test]
fn a30_the_normal_of_a_triangle_follows_the_right_hand() {
    let normal = |corners: [[f32; 3]; 3]| {
        Scene::from_triangles(camera(), &[corners]).mesh.face_normal(TriangleId::new(0))
    };
    assert_eq!(normal([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]), [0.0, 0.0, 1.0]);
    let triangle = [[0.3, -1.7, 2.1], [4.9, 0.6, -3.3], [-2.2, 5.1, 0.7]];
    let [a, b, c] = triangle;
    assert_eq!(normal([a, c, b]), normal(triangle).map(|n| -n));
    assert_eq!(normal([b, c, a]).map(f32_of), normal(triangle).map(f32_of));
    // A needle of 2,000,001 by some 1e-6: its cross product is (1, −1,000,000, −1).
    let needle = [[0.0; 3], [1_000_000.0, 1.0, 0.0], [2_000_001.0, 2.0, 1.0]];
    assert!(close(normal(needle), unit([1.0, -1e6, -1.0])), "{:?}", normal(needle));
}

/// Rounded to where two evaluations of a normal agree.
fn f32_of(value: f64) -> f32 {
    value as f32
}

#[test]
fn a31_the_normal_of_a_sphere_is_its_point() {
    for shape in [
        Shape::UvSphere(UvSphere { radius: 2.5, around: 20, rings: 10 }),
        Shape::Icosphere(Icosphere { radius: 2.5, ..Icosphere::default() }),
    ] {
        let part = build(&shape).unwrap();
        let mut corners = 0;
        for (positions, normals) in part.corners.iter().zip(&part.corner_normals) {
            for (&position, &normal) in positions.iter().zip(normals) {
                let (p, n) = (part.positions[position as usize], part.normals[normal as usize]);
                assert!(close(n, p.map(|c| c / 2.5)), "{p:?} {n:?}");
                corners += 1;
            }
        }
        assert!(corners > 500);
    }
}

#[test]
fn a32_the_normal_of_a_quad_is_that_of_its_first_corners() {
    // quad(a, b, c, d): t1 = b − a, t2 = c − b, cross(t1, t2); d lies in the plane.
    for [a, b, c, d] in [
        [[0.0, 0.0, 0.0], [2.0, 1.0, 0.5], [3.0, 4.0, 1.5], [1.0, 3.0, 1.0]],
        [[-1.0, 2.0, 3.0], [-1.0, 5.0, 3.0], [-4.0, 5.0, 7.0], [-4.0, 2.0, 7.0]],
    ] {
        let quad = [a, b, c, d].map(|[x, y, z]: V3| format!("v {x} {y} {z}\n")).concat();
        let scene = load(&format!("{quad}f 1 2 3 4\n"), "", "");
        let sub = |p: V3, q: V3| -> V3 { std::array::from_fn(|k| p[k] - q[k]) };
        let expected = unit(cross(sub(b, a), sub(c, b)));
        for id in scene.mesh.ids() {
            assert!(close(scene.mesh.face_normal(id), expected), "{expected:?}");
        }
        assert_eq!(scene.mesh.len(), 2);
    }
}

#[test]
fn a34_normals_under_uneven_scale_need_the_inverse_transpose() {
    let h = 0.5_f64.sqrt();
    let plane = format!("v -3 -3 3\nv 3 -3 -3\nv 3 3 -3\nv -3 3 3\nvn {h:?} 0 {h:?}\n");
    let obj = format!("{plane}f 1//1 2//1 3//1 4//1\n");
    let light = "scale = [1, 1, 4]\n[[light]]\ntype = \"directional\"\naim = [0, 0, -1]\n\
                 intensity = [1, 1, 1]\n";
    let (correct, naive) =
        (load(&obj, "", light), load(&obj, "switches = { naive_normals = true }", light));
    let along_edges = |scene: &Scene| {
        let id = TriangleId::new(0);
        let corners = scene.mesh.triangle(id).map(|corner| corner.map(f64::from));
        let normals = scene.mesh.normals_of(id).unwrap();
        (0..3).fold(0.0_f64, |most, i| {
            let (p, q) = (corners[i], corners[(i + 1) % 3]);
            let edge = unit(std::array::from_fn(|k| q[k] - p[k]));
            most.max(dot(edge, normals[0]).abs())
        })
    };
    assert!(along_edges(&correct) <= UNIT_BOUND);
    // (1, 0, 4)/√17 along (1, 0, −4)/√17 is −15/17.
    assert!((along_edges(&naive) - 15.0 / 17.0).abs() <= UNIT_BOUND);
    // The plane x + z/4 = 0 is lit by ¼/√(1 + 1/16), the naive normal by 4/√17.
    let middle = |scene: &Scene| program_picture(scene)[8 * 17 + 8][0] / 0.8;
    assert!((middle(&correct) - 1.0 / 17.0_f64.sqrt()).abs() <= UNIT_BOUND);
    assert!((middle(&naive) - 4.0 / 17.0_f64.sqrt()).abs() <= UNIT_BOUND);
}

#[test]
fn a35_an_open_box_is_lit_inside_only_when_it_has_two_sides() {
    // Open towards the eye, the light inside.
    let walls: Vec<_> = closed_box([-6.0, -6.0, -4.0], [6.0, 6.0, 0.0])
        .into_iter()
        .filter(|triangle| triangle.iter().any(|corner| corner[2] < 0.0))
        .collect();
    let mut scene = Scene::from_triangles(camera(), &walls);
    scene.lights = vec![point([0.25, 0.5, -1.0], [1.0, 0.0, 0.0], white())];
    let buffer = answer(&scene, VisibilityPath::Cast);
    assert!(buffer.covered_pixels() > 100);
    for (sides, is_lit) in [(Sides::Single, false), (Sides::Double, true)] {
        scene.objects[0].sides = sides;
        for (visible, rgb) in buffer.visible.iter().zip(program_picture(&scene)) {
            assert_eq!(rgb[0] > 0.0, is_lit && visible.is_some(), "{sides:?} {visible:?}");
        }
    }
}
