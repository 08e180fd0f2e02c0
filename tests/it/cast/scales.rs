//! Powers of two of the scene and of the camera.

use super::*;

/// H61, H70, H77: a scene at every power of two, down to multiples of the least f32, is the same
/// scene.
#[test]
fn h61_h70_scales_by_powers_of_two_change_nothing() {
    let golden = goldens().into_iter().find(|golden| golden.name == "grid_exact").unwrap();
    let reference = agreed(&golden.scene());
    for k in [-148, -147, -126, -100, -60, 60, 100, 110, 122] {
        let scaled = |c: f32| (f64::from(c) * 2.0_f64.powi(k)) as f32;
        let triangles: Vec<Triangle> =
            golden.triangles.iter().map(|t| t.map(|v| v.map(scaled))).collect();
        let scene = Scene::from_triangles(standard_camera(8.0), &triangles);
        let buffer = agreed(&scene);
        assert_finite(&buffer);
        assert_eq!(ids(&reference), ids(&buffer), "2^{k}");
        assert_eq!(reference.cover, buffer.cover, "2^{k}");
        for (a, b) in reference.visible.iter().zip(&buffer.visible) {
            let (Some(a), Some(b)) = (a, b) else { continue };
            assert_eq!(a.barycentric, b.barycentric);
            assert_eq!(a.t_lo * 2.0_f64.powi(k), b.t_lo);
            assert_eq!(a.t_hi * 2.0_f64.powi(k), b.t_hi);
        }
    }
}

/// H53: the camera's own scale changes t only.
#[test]
fn h53_short_and_long_directions() {
    let golden = goldens().into_iter().find(|golden| golden.name == "grid_exact").unwrap();
    let reference = agreed(&golden.scene());
    for k in [-290, -27, 20, 290] {
        let factor = 2.0_f64.powi(k);
        let scaled = |v: [f64; 3]| v.map(|c| c * factor);
        let Vectors { eye, d0, dx, dy } = golden.camera;
        let mut scene = golden.scene();
        let resolution = scene.camera.resolution();
        scene.camera =
            PinholeCamera::exact(resolution, eye, scaled(d0), scaled(dx), scaled(dy)).unwrap();
        let buffer = agreed(&scene);
        for (a, b) in reference.visible.iter().zip(&buffer.visible) {
            let (Some(a), Some(b)) = (a, b) else { continue };
            assert_eq!((a.triangle, a.barycentric), (b.triangle, b.barycentric));
            assert_eq!(a.t_lo / factor, b.t_lo);
        }
        assert_finite(&buffer);
    }
}
