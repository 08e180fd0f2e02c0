//! Interpolation in perspective and on the screen: the scan-line formulas of IIT (A43), texture
//! coordinates of a plane and how far they swim without perspective (A48).

use super::ULP;
use super::stage::{V3, answer, camera, program_picture};
use truecast::mesh::TriangleId;
use truecast::pixel::Resolution;
use truecast::render::VisibilityPath;
use truecast::scene::camera::PinholeCamera;
use truecast::scene::switches::{SwitchValue, Switches};
use truecast::scene::{Scene, Shading};
use truecast::shade;

fn on_screen(scene: &Scene) -> Scene {
    let switches = Switches::default().with("interpolation", SwitchValue::Word("screen"));
    Scene { switches, ..scene.clone() }
}

/// Colours by IIT's formulas. `corners` are (x, y) on the screen with their colours, by y.
fn scan_line(corners: [([f64; 2], f64); 3], [xp, yp]: [f64; 2]) -> f64 {
    // I4 = (y4 − y2)/(y1 − y2)·I1 + (y1 − y4)/(y1 − y2)·I2 on each edge that the line crosses.
    let mut crossings = Vec::new();
    for (one, other) in [(0, 1), (1, 2), (0, 2)] {
        let (([x1, y1], i1), ([x2, y2], i2)) = (corners[one], corners[other]);
        if y1 < yp && yp <= y2 {
            let (a, b) = ((yp - y2) / (y1 - y2), (y1 - yp) / (y1 - y2));
            crossings.push((a * x1 + b * x2, a * i1 + b * i2));
        }
    }
    let [(x4, i4), (x5, i5)] = crossings[..] else { panic!("{crossings:?} of {corners:?}") };
    (x5 - xp) / (x5 - x4) * i4 + (xp - x4) / (x5 - x4) * i5
}

#[test]
fn a43_screen_weights_are_the_scan_line_formulas() {
    let corners = [[-7.0, -6.0, 0.0], [4.0, -3.5, 5.0], [2.0, 6.5, -9.0]];
    let values = [0.2, 0.9, 0.5];
    let mut scene = Scene::from_triangles(camera(), &[corners]);
    scene.mesh.colors = values.map(|value| [value; 3]).to_vec();
    scene.objects[0].shading = Shading::VertexColor;
    // The ray of pixel (i, j) meets (i − 8, 8 − j, 0): a corner's image is at 8/(8 − z) of its x, y.
    let mut projected: [([f64; 2], f64); 3] = std::array::from_fn(|i| {
        let [x, y, z] = corners[i].map(f64::from);
        let share = 8.0 / (8.0 - z);
        ([8.5 + share * x, 8.5 - share * y], values[i])
    });
    projected.sort_by(|a, b| a.0[1].total_cmp(&b.0[1]));
    let buffer = answer(&scene, VisibilityPath::Cast);
    let (screen, perspective) = (program_picture(&on_screen(&scene)), program_picture(&scene));
    let (mut pixels, mut largest) = (0, 0.0_f64);
    for (index, visible) in buffer.visible.iter().enumerate() {
        if visible.is_none() {
            continue;
        }
        let expected = scan_line(projected, buffer.window.pixel(index).sample());
        // Quotients of differences of numbers up to 17, over lines of half a pixel or more.
        let bound = 256.0 * ULP;
        assert!((screen[index][0] - expected).abs() <= bound, "{expected} {:?}", screen[index]);
        largest = largest.max((perspective[index][0] - expected).abs());
        pixels += 1;
    }
    assert!(pixels > 40 && largest > 0.05, "{pixels} {largest}");
}

#[test]
fn a48_texture_coordinates_of_a_plane_are_those_of_the_point() {
    // A floor that runs from depth 2 to depth 2ρ below the eye; v = 0 at the near edge, 1 at the
    // far one; u across.
    for rho in [2.0_f64, 5.0, 9.0] {
        let rows = 2048;
        let frame = Resolution::new(3, rows).unwrap();
        let step = 1.0 / 1024.0;
        let camera = PinholeCamera::exact(
            frame,
            [0.0, 1.0, 0.0],
            [-1.5 * step, 0.0, -1.0],
            [step, 0.0, 0.0],
            [0.0, -step, 0.0],
        )
        .unwrap();
        let (near, far) = (-2.0_f32, (-2.0 * rho) as f32);
        let corners = [[-4.0, 0.0, near], [4.0, 0.0, near], [4.0, 0.0, far], [-4.0, 0.0, far]];
        let mut scene = Scene::from_triangles(camera, &[[corners[0]; 3]; 2]);
        scene.mesh.positions = corners.to_vec();
        scene.mesh.corners = vec![[0, 1, 2], [0, 2, 3]];
        scene.mesh.uvs = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        scene.mesh.corner_uvs = scene.mesh.corners.clone();
        let affine = on_screen(&scene);
        let buffer = answer(&scene, VisibilityPath::Cast);
        let mut swim = 0.0_f64;
        for (pixel, visible) in buffer.window.pixels().zip(&buffer.visible) {
            let Some(visible) = visible else { continue };
            let ([x, y], camera) = (pixel.sample(), &scene.camera);
            let d: V3 =
                std::array::from_fn(|k| camera.d0()[k] + x * camera.dx()[k] + y * camera.dy()[k]);
            // The ray meets the floor at t = −1/d_y.
            let point = d.map(|c| -c / d[1]);
            let expected = [(point[0] + 4.0) / 8.0, (-point[2] - 2.0) / (2.0 * rho - 2.0)];
            let uv = |scene| shade::surface_point(scene, pixel, visible).0.uv.unwrap();
            let own = uv(&scene);
            // Weights are right to 2^-48, and positions here are below 20.
            let bound = 2.0_f64.powi(-44);
            assert!((0..2).all(|k| (own[k] - expected[k]).abs() <= bound), "{own:?} {expected:?}");
            swim = swim.max((uv(&affine)[1] - expected[1]).abs());
        }
        // s − s/(ρ − s(ρ − 1)) is largest at s = √ρ/(1 + √ρ): (√ρ − 1)/(√ρ + 1).
        let formula = (rho.sqrt() - 1.0) / (rho.sqrt() + 1.0);
        // A thousandth of an edge beside its place, an extremum moves by its square.
        assert!(swim <= formula + 1e-12 && swim > formula - 1e-4, "{rho}: {swim} {formula}");
    }
}

#[test]
fn weights_of_a_triangle_through_the_eye_plane_stay_in_perspective() {
    let mut scene = Scene::from_triangles(
        camera(),
        &[[[-9.0, -3.0, 9.0], [9.0, -3.0, 9.0], [0.0, -3.0, -99.0]]],
    );
    scene.mesh.colors = vec![[0.1; 3], [0.5; 3], [0.9; 3]];
    scene.objects[0].shading = Shading::VertexColor;
    let buffer = answer(&scene, VisibilityPath::Cast);
    assert!(buffer.visible.iter().flatten().all(|v| v.triangle == TriangleId::new(0)));
    assert_eq!(program_picture(&scene), program_picture(&on_screen(&scene)));
    let effects = truecast::shade::Effects::of(&scene);
    let notes = shade::shade(&on_screen(&scene), &buffer, effects, &|| ()).notes;
    assert_eq!(notes.perspective_kept, buffer.covered_pixels() as u64);
    assert!(notes.perspective_kept > 10);
}
