//! truecast answers which triangle is really visible at each pixel, and shades it.

pub mod accel;
pub mod cast;
pub mod color;
pub mod film;
pub mod mesh;
pub mod pixel;
pub mod raster;
pub mod scene;
pub mod shade;
pub mod visibility;
