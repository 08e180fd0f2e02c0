//! H40 to H4B: triangles through, behind and in the planes of the eye, eyes inside and beside
//! boxes, and what is very near. There is no near plane, and t = 0 is no hit.

use super::{
    agree_with_golden, assert_covered_once, assert_same_picture, cover, ids, one_signed_count,
    samples,
};
use crate::support::configurations::agree_everywhere;
use crate::support::golden;
use crate::support::scenes::{Triangle, rectangle, standard_camera, standard_scene, triangles_of};
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;

/// The triangle by each of its corners first: no corner may be a special one.
fn turned(triangle: Triangle) -> [Triangle; 3] {
    let [a, b, c] = triangle;
    [[a, b, c], [b, c, a], [c, a, b]]
}

fn assert_pixels(name: &str, triangle: Triangle, pixels: usize) {
    for triangle in turned(triangle) {
        let buffer = agree_everywhere(name, &standard_scene(&[triangle]));
        assert_eq!(buffer.covered_pixels(), pixels, "{name}");
    }
}

#[test]
fn h40_crossing_the_eye_plane() {
    assert_pixels("one behind", [[-4.0, -3.0, -6.0], [5.0, -3.0, 2.0], [1.0, 6.0, 12.0]], 182);
    assert_eq!(agree_with_golden("two_behind").covered_pixels(), 196);
}

#[test]
fn h41_all_behind() {
    assert_eq!(agree_with_golden("all_behind").covered_pixels(), 0);
    assert_pixels("all behind", [[-4.0, -3.0, -6.0], [5.0, -3.0, -2.0], [1.0, 6.0, -12.0]], 0);
}

/// A vertex, and an edge, in the plane through the eye that no ray reaches: 1/w is infinite there.
/// The counts are those of the definition in rational arithmetic, in a program of its own.
#[test]
fn h42_vertex_and_edge_at_w_0() {
    let [vertex, behind] = [[-4.0, -3.0, 0.0], [1.0, 6.0, 12.0]];
    assert_pixels("a vertex at w = 0", [vertex, [5.0, -3.0, 2.0], behind], 156);
    assert_eq!(agree_with_golden("edge_in_eye_plane").covered_pixels(), 163);
    assert_pixels("an edge at w = 0", [vertex, [5.0, -3.0, 0.0], behind], 163);
}

fn assert_nothing(name: &str, triangle: Triangle) {
    for triangle in turned(triangle) {
        let buffer = agree_everywhere(name, &standard_scene(&[triangle]));
        assert!(cover(&buffer).iter().all(|c| c.crossed == 0), "{name}");
    }
}

#[test]
fn h43_eye_in_the_plane() {
    agree_with_golden("eye_in_plane");
    assert_nothing("eye in the plane", [[0.0, -3.0, 2.0], [0.0, 5.0, 3.0], [0.0, 1.0, 9.0]]);
    // A plane that runs through samples too, and obliquely.
    assert_nothing("oblique", [[1.0, 1.0, 8.0], [-3.0, -3.0, 8.0], [5.0, 5.0, 16.0]]);
}

#[test]
fn h44_eye_at_a_vertex() {
    agree_with_golden("eye_at_vertex");
    assert_nothing("eye at a vertex", [[0.0; 3], [5.0, -5.0, 8.0], [5.0, 5.0, 8.0]]);
}

#[test]
fn h45_eye_on_an_edge() {
    agree_with_golden("eye_on_edge");
    assert_nothing("eye on an edge", [[0.0, 0.0, -4.0], [0.0, 0.0, 4.0], [5.0, 5.0, 8.0]]);
}

#[test]
fn h46_eye_inside_a_triangle() {
    agree_with_golden("eye_inside_triangle");
    assert_nothing("eye inside", [[-5.0, -5.0, 0.0], [5.0, -5.0, 0.0], [0.0, 5.0, 0.0]]);
    assert_nothing("inside, in view", [[0.0, -5.0, -5.0], [0.0, -5.0, 9.0], [0.0, 5.0, 9.0]]);
}

#[test]
fn h47_mirror_ghost() {
    // Behind the eye; their reflections through it would cover the middle, or everything.
    assert_nothing("ghost", [[-6.0, -5.0, -8.0], [6.0, -5.0, -8.0], [0.0, 7.0, -8.0]]);
    assert_nothing("large ghost", [[-60.0, -60.0, -8.0], [90.0, -60.0, -8.0], [0.0, 90.0, -8.0]]);
    // Before something that is there, nothing changes.
    let there = rectangle([-4.0, -4.0], [4.0, 4.0], 8.0);
    let reference = agree_everywhere("square", &standard_scene(&there));
    let mut haunted = there.to_vec();
    haunted.extend(rectangle([-90.0, -90.0], [90.0, 90.0], -4.0));
    assert_same_picture("haunted", &reference, &standard_scene(&haunted));
}

/// A closed box, two triangles a face, counter-clockwise from outside; faces in the order
/// −x, +x, −y, +y, −z, +z.
fn closed_box(low: [f32; 3], high: [f32; 3]) -> Vec<Triangle> {
    let mut triangles = Vec::new();
    for axis in 0..3 {
        for end in [low, high] {
            let corner = |u: f32, v: f32| {
                let mut corner = [0.0; 3];
                corner[axis] = end[axis];
                corner[(axis + 1) % 3] = u;
                corner[(axis + 2) % 3] = v;
                corner
            };
            let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
            let ring = [
                corner(low[u], low[v]),
                corner(high[u], low[v]),
                corner(high[u], high[v]),
                corner(low[u], high[v]),
            ];
            let [a, b, c, d] = ring;
            if end == high {
                triangles.extend([[a, b, c], [a, c, d]]);
            } else {
                triangles.extend([[a, c, b], [a, d, c]]);
            }
        }
    }
    triangles
}

#[test]
fn h48_closed_box_eye_inside() {
    let buffer = agree_with_golden("box_inside");
    assert_covered_once("box", &buffer);
    assert_eq!(one_signed_count("box", &buffer).abs(), 1);
    // Off its middle, near a face, at a step of f32 from one.
    let room = closed_box([-4.0; 3], [4.0; 3]);
    let near_a_face = 4.0_f64 - 2.0_f64.powi(-22);
    for eye in [[1.5, -0.25, 2.0], [-3.0, 1.0, -1.0], [near_a_face, 0.0, 0.0]] {
        let camera = standard_camera(8.0);
        let (d0, dx, dy) = (camera.d0(), camera.dx(), camera.dy());
        let camera = PinholeCamera::exact(camera.resolution(), eye, d0, dx, dy).unwrap();
        let name = format!("room from {eye:?}");
        let buffer = agree_everywhere(&name, &Scene::from_triangles(camera, &room));
        assert_covered_once(&name, &buffer);
        assert_eq!(one_signed_count(&name, &buffer), 1, "{name}");
    }
}

/// A box that touches the plane x = 0 ahead of the eye, which looks along that face: the face is
/// never seen, and the others are as if it were not there.
#[test]
fn h49_eye_on_a_face_plane() {
    let block = closed_box([0.0, -1.0, 3.0], [2.0, 1.0, 5.0]);
    let buffer = agree_everywhere("block", &standard_scene(&block));
    assert_eq!(one_signed_count("block", &buffer), 0);
    for (index, [x, y]) in samples().enumerate() {
        // The front face, z = 3: 0 ≤ 3x/8 < 2 and −1 ≤ 3y/8 < 1; top, bottom and right are hidden.
        let seen = (0..=5).contains(&x) && (-2..=2).contains(&y);
        let id = ids(&buffer)[index];
        assert_eq!(id.is_some(), seen, "({x}, {y})");
        // Faces 4 and 5 of 6 are −z's: triangles 8 and 9.
        assert!(id.is_none_or(|id| id == 8 || id == 9), "({x}, {y}): {id:?}");
        assert_eq!(cover(&buffer)[index].crossed, if seen { 2 } else { 0 });
    }
    // Without the face on x = 0 nothing changes, the counts neither.
    let open: Vec<Triangle> = block[2..].to_vec();
    let open = agree_everywhere("block without its face", &standard_scene(&open));
    assert_eq!(buffer.cover, open.cover);
    let moved = |id: Option<u32>| id.map(|id| id + 2);
    assert_eq!(ids(&buffer), ids(&open).into_iter().map(moved).collect::<Vec<_>>());
}

#[test]
fn h4a_grazing() {
    let (below, side) = (2.0_f32.powi(-20), 1e8);
    let corner = |x: f32, z: f32| [x, below, z];
    let floor = [
        [corner(-side, -side), corner(side, -side), corner(side, side)],
        [corner(-side, -side), corner(side, side), corner(-side, side)],
    ];
    let buffer = agree_everywhere("grazed floor", &standard_scene(&floor));
    assert_covered_once("grazed floor", &buffer);
    for (visible, [x, y]) in buffer.visible.iter().zip(samples()) {
        assert_eq!(visible.is_some(), y > 0, "({x}, {y})");
        let Some(visible) = visible else { continue };
        // d_y is y: t = 2^-20/y.
        let t = f64::from(below) / f64::from(y);
        assert!(visible.t_lo <= t.next_up() && t.next_down() <= visible.t_hi);
    }
}

#[test]
fn h4b_very_near() {
    let golden = golden::scene("grid_exact");
    let reference = agree_everywhere("grid", &golden.scene);
    // Two factors: 2^-140 alone is no normal f32, and 8·2^-149 is the least depth of all.
    for power in [-60, -120, -140, -149] {
        let (half, rest) = (2.0_f32.powi(power / 2), 2.0_f32.powi(power - power / 2));
        let scaled: Vec<Triangle> = triangles_of(&golden.scene)
            .into_iter()
            .map(|triangle| triangle.map(|v| v.map(|c| c * half * rest)))
            .collect();
        let scene = standard_scene(&scaled);
        assert_same_picture(&format!("grid scaled by 2^{power}"), &reference, &scene);
        let buffer = agree_everywhere("grid scaled", &scene);
        for visible in buffer.visible.iter().flatten() {
            let t = 2.0_f64.powi(power);
            assert!(visible.t_lo <= t && t <= visible.t_hi, "{visible:?}");
        }
    }
}
