//! The vector kernels' bounds against the integers: how near to them do errors come?

use super::{cameras, on_ray};
use crate::mesh::TriangleId;
use crate::pixel::{Pixel, Window};
use crate::raster::arithmetic::Certain;
use crate::raster::blocks::BlockGrid;
use crate::raster::exact::ExactTriangle;
use crate::raster::frame::Frame;
use crate::raster::image_plane::ImagePlane;
use crate::raster::octet::{Corners, Images, OCTET};
use crate::raster::placement::hard_lanes;
use crate::raster::tile_rows::{TileFrame, TileRows};
use crate::scene::Scene;
use crate::simd::SimdLevel;
use fearless_simd::{Simd, dispatch};

/// Largest errors found, in units of their bounds.
#[derive(Debug, Default)]
struct Worst {
    /// |W| with a sign that is not the exact one; the bound is 1.
    edge: f64,
    /// |1/w| off the exact one, over the bound of the triangle.
    depth: f64,
    /// Edges within 16 of 0, and triangles that were not hard.
    near_edges: usize,
    usable: usize,
}

/// Triangles around a pixel, from a few hundredths of a pixel to thousands, with edges and corners
/// near samples, some of them nearly edge-on, some reaching behind the eye.
fn triangles(camera: &crate::scene::camera::PinholeCamera, aim: Pixel) -> Vec<[[f32; 3]; 3]> {
    let [x, y] = aim.sample();
    let mut triangles = Vec::new();
    for step in 0..160_i32 {
        let size = 2.0_f64.powi(step % 17 - 5);
        let angle = f64::from(step) * 0.7;
        let (c, s) = (size * angle.cos(), size * angle.sin());
        let t = 0.5 + f64::from(step % 7);
        let behind = if step % 5 == 4 { -0.25 } else { 1.5 };
        let a = on_ray(camera, [x + c, y + s], t);
        let b = on_ray(camera, [x - c, y - s], t * (1.0 + f64::from(step % 3)));
        let third = on_ray(camera, [x - s, y + 2.0 * c], t * behind);
        let hub = on_ray(camera, [x + 0.01 * c, y], t);
        triangles.extend([[a, b, third], [hub, a, third], [b, third, a]]);
    }
    triangles
}

#[test]
fn errors_of_the_kernels_stay_far_below_their_bounds() {
    let mut worst = Worst::default();
    for level in SimdLevel::available() {
        for camera in cameras() {
            for (aim, side) in [([401, 77], 32), ([620, 350], 64), ([3, 1], 4)] {
                let aim = Pixel { x: aim[0], y: aim[1] };
                let scene = Scene::from_triangles(camera.clone(), &triangles(&camera, aim));
                dispatch!(level.dispatched(), simd => hunt(simd, &scene, aim, side, &mut worst));
            }
        }
    }
    assert!(worst.near_edges > 10_000 && worst.usable > 4_000, "{worst:?}");
    // The derivations leave 0.63 of an edge's bound, and 6/6.5 and 1/1.05 of the parts of a depth's.
    assert!(worst.edge < 0.6, "{worst:?}");
    assert!(worst.depth < 0.8, "{worst:?}");
}

fn hunt<S: Simd>(simd: S, scene: &Scene, aim: Pixel, side: u32, worst: &mut Worst) {
    let plane = ImagePlane::new(&scene.camera);
    let (frame, grid) = (Frame::new(&plane), BlockGrid::new(side));
    let resolution = scene.camera.resolution();
    let (x, y) = (aim.x / side * side, aim.y / side * side);
    let (right, below) = (resolution.width().min(x + side), resolution.height().min(y + side));
    let tile = Window::new(resolution, x, y, right, below).unwrap();
    let tile_frame = TileFrame::new(simd, &frame, &grid, tile);
    let (mut rows, mut corners) = (TileRows::new(), Corners::new());
    for first in (0..scene.mesh.len() as u32).step_by(OCTET) {
        (0..OCTET).for_each(|lane| corners.set(lane, &scene.mesh, first + lane as u32));
        let images = Images::new(simd, &frame, &corners);
        let hard = hard_lanes(simd, &frame, &images.plane(simd, &frame, &corners));
        let lanes = 0xff & !hard;
        let all = f32::NEG_INFINITY;
        let lanes = rows.set_up::<S, Certain>(simd, &frame, &tile_frame, &corners, lanes, all);
        for lane in (0..OCTET).filter(|lane| lanes >> lane & 1 == 1) {
            let id = TriangleId::new(first + lane as u32);
            let Some(exact) = ExactTriangle::new(&plane, scene.mesh.triangle(id)) else {
                panic!("a triangle with V = 0 was not hard");
            };
            worst.usable += 1;
            for pixel in tile.pixels().filter(|p| (p.x + 3 * p.y) % 7 == 0 || *p == aim) {
                compare(&frame, &rows, lane, &exact, tile, pixel, worst);
            }
        }
    }
}

/// Holds a lane's values at a pixel, computed as they are drawn, against the exact ones.
fn compare(
    frame: &Frame,
    rows: &TileRows,
    lane: usize,
    exact: &ExactTriangle,
    tile: Window,
    pixel: Pixel,
    worst: &mut Worst,
) {
    let (x, y) = (pixel.x - tile.x0(), pixel.y - tile.y0());
    let [within_x, within_y, block_x, block_y] =
        [x % 4, y % 4, x / 4 * 4, y / 4 * 4].map(|offset| offset as f32);
    let values = |k: usize| {
        let (half, lane) = (k >> 1, (k & 1) * 8 + lane);
        let (a, b, c) = (rows.a[half].0[lane], rows.b[half].0[lane], rows.c[half].0[lane]);
        let within = a * within_x + b * within_y;
        let fused = a.mul_add(block_x, b.mul_add(block_y, c));
        [within + (a * block_x + (b * block_y + c)), within + fused].map(f64::from)
    };
    for (k, edge) in exact.edges.iter().enumerate() {
        for value in values(k).into_iter().filter(|value| value.abs() < 16.0) {
            worst.near_edges += 1;
            if f64::from(edge.sign_at(pixel)) * value <= 0.0 {
                worst.edge = worst.edge.max(value.abs());
            }
        }
    }
    // Outside the triangle the row continues, and may be 0.
    let truth = frame.ray_parameter / exact.t_at(pixel);
    if truth.is_finite() {
        for value in values(3) {
            let error = (value - truth).abs() / f64::from(rows.error.0[8 + lane]);
            worst.depth = worst.depth.max(error);
        }
    }
}
