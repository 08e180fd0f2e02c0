//! truecast answers one question with proof: *which triangle is really visible at this pixel?*
//!
//! A pinhole camera sends one ray per pixel through a BVH over triangle meshes; a z-buffer
//! rasterizer that shares no arithmetic with it answers the same question; an arbiter in rational
//! arithmetic decides every doubt. On the answer stand a renderer (Blinn-Phong, many spotlights,
//! interpolated normals, EXR and PNG) and a cross-check of the two paths, pixel for pixel.
//!
//! # A frame, from left to right
//!
//! ```text
//! scene.toml ── SceneFile ──▶ Scene ─┬─▶ Accelerator ──▶ cast() ──┐
//!  *.obj                             │                            ├──▶ VisibilityBuffer ──▶ shade() ──▶ Film ──▶ .exr .png .npy
//!                                    ├─▶ rasterize() ─────────────┘            │
//!                                    │                                         ▼
//!                                    └─▶ exact::Arbiter ◀── which pixels? ── check ──▶ verdict, difference picture
//! ```
//!
//! # The definition
//!
//! Vertices are f32 triples in world space, rounded once. The camera's numbers lie on a lattice on
//! which the direction `d(x, y) = D0 + x·DX + y·DY` of every sample is exact in f64
//! ([`scene::camera`]). With `a_i = v_i − e`, `W_i = det(a_j, a_k, d)` and `V = det(a_0, a_1, a_2)`,
//! a triangle covers a sample exactly if V ≠ 0 and every `sgn* W_i = sgn V`; the nearest is found by
//! `sgn*` of the depth polynomial; of triangles in one plane the lowest id wins. `sgn*` is the sign
//! with the sample moved by (+ε, +ε²): the first nonzero sign of the value, its derivative along x,
//! and its derivative along y. It is the top-left rule, and it makes every closed mesh
//! cover every sample exactly once, without an epsilon anywhere. Edge-on and zero-area triangles
//! and those that touch the eye have V = 0 and are never visible.
//!
//! A hard shadow is a question of the same kind ([`cast::shadow`], [`exact::Shadows`]): a triangle
//! other than the visible one occludes a light if it crosses the open segment from the exact surface
//! point e + (V/D)·d to the light. Each side that this asks for is the sign of a polynomial linear in
//! d, so it too is taken by `sgn*`: segments cross closed meshes exactly as often as they must, and
//! no offset keeps a surface out of its own shadow.
//!
//! # The floors
//!
//! A module uses only modules on floors below its own; a test holds every import against the table.
//!
//! | floor | modules | what they hold |
//! |---|---|---|
//! | prices | [`cost`] | what accuracy costs: each setting's time against its error |
//! | check | [`check`], [`mod@bench`], [`export`], [`sheet`] | both paths compared, the arbiter's word, blame, difference pictures; times of right answers; the oracle bundle; sheets of pictures |
//! | frame | [`render`] | scene and options in, film out: the one place that knows both paths and shading |
//! | lobe | [`lobe`] | goniometric diagrams of a reflectance |
//! | shading | [`shade`] | effects, the equation, surface points |
//! | answers | [`mod@cast`], [`raster`], [`exact`] | three answerers that do not know each other |
//! | structure | [`accel`] | BVHs built by obvhs, our own conservative boxes; only `cast` uses it |
//! | shapes of an answer | [`visibility`], [`film`] | buffers; EXR, PNG, NPY |
//! | scene | [`scene`] | `SceneFile` as written, `Scene` as meant; OBJ, shapes, camera, lights |
//! | words | [`pixel`], [`color`], [`mesh`], [`drawing`], [`statistics`], [`mutant`] | grids, ids, triangles; marks on a page; times condensed; the tests' planted mistakes |
//!
//! To read the program, open `lib.rs`, `visibility.rs`, `cast.rs`, `raster.rs`, `shade.rs` and
//! `check.rs` in this order.
//!
//! # A tiny scene
//!
//! Two triangles, one behind the other, seen by both paths, and drawn by their ids:
//!
//! ```
//! use truecast::accel::{Accelerator, BuildPreset};
//! use truecast::pixel::Resolution;
//! use truecast::scene::{Scene, camera::PinholeCamera};
//! use truecast::visibility::Counting;
//!
//! // The ray of pixel (i, j) is (i − 7, j − 4, 8); y points down, as rows do.
//! let frame = Resolution::new(15, 9).unwrap();
//! let camera = PinholeCamera::exact(
//!     frame, [0.0; 3], [-7.5, -4.5, 8.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]).unwrap();
//! let near = [[-6.0, -3.0, 8.0], [2.0, -3.0, 8.0], [-6.0, 5.0, 8.0]];
//! let far = [[-8.0, -2.0, 16.0], [12.0, -2.0, 16.0], [12.0, 6.0, 16.0]];
//! let scene = Scene::from_triangles(camera, &[near, far]);
//!
//! let accelerator = Accelerator::build(&scene.mesh, BuildPreset::Medium);
//! let cast = truecast::cast::cast(&scene, &accelerator, frame.window(), Counting::All, &|| ());
//! let raster = truecast::raster::rasterize(&scene, frame.window(), Counting::All, &|| ());
//!
//! let picture: Vec<String> = (0..9).map(|y| (0..15).map(|x| {
//!     let pixel = truecast::pixel::Pixel { x, y };
//!     let id = |answer: &truecast::visibility::VisibilityBuffer| answer.at(pixel).map(|v| v.triangle);
//!     assert_eq!(id(&cast), id(&raster));
//!     match id(&cast).map(|id| id.get()) { None => '.', Some(0) => '#', Some(_) => '+' }
//! }).collect()).collect();
//! assert_eq!(picture, [
//!     "...............",
//!     ".########......",
//!     ".#######.......",
//!     ".######++++++..",
//!     ".#####+++++++..",
//!     ".####...+++++..",
//!     ".###.......++..",
//!     ".##............",
//!     ".#.............",
//! ]);
//! assert_eq!(cast.cover, raster.cover);
//! ```
//!
//! # Accuracy
//!
//! Every answer is the exact one, unless another level is asked for to be compared with it
//! ([`render::Accuracy`]; [`mod@cost`] prices them). f32 and f64 filters with derived bounds take nearly all decisions,
//! exact arithmetic the rest; [`visibility::LevelCounts`] says how many each took. Shading is f64, in
//! forms that do not break on grazing angles, tiny cones or huge exponents, and the same bits for
//! any number of threads. Where shading meets a case that has no right value (a light at the surface,
//! a normal that cancels, a side that rounding decides), it says so: [`shade::Notes`] count such
//! cases, and the plane `invalid` ([`render::PlaneGroup::Invalid`]) shows where they are.
//!
//! # Limits
//!
//! Local illumination and hard shadows: no reflection or global illumination. Vertices are f32, at
//! most 2^126; a scene has fewer than 2^32 − 1 triangles; an image at most 65 536 pixels a side.

pub mod accel;
pub mod bench;
pub mod cast;
pub mod check;
pub mod color;
pub mod cost;
pub mod drawing;
pub mod exact;
pub mod export;
pub mod film;
pub mod lobe;
pub mod mesh;
pub mod mutant;
pub mod pixel;
pub mod raster;
pub mod render;
pub mod scene;
pub mod shade;
pub mod sheet;
pub mod simd;
pub mod statistics;
pub mod visibility;
