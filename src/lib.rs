//! truecast answers which triangle is really visible at each pixel, and shades it.

pub mod color;
pub mod exact;
pub mod film;
pub mod mesh;
pub mod pixel;
pub mod scene;
pub mod visibility;
