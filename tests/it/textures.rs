//! Textures: what a lookup gives, how far uv moves over a pixel, and which files are read for whom.
//!
//! Decoding and the smaller levels are tested beside them.

mod files;
mod footprints;
mod libraries;
mod sampling;

use image::{Rgb, RgbImage};
use std::path::Path;
use truecast::scene::error::Fault;
use truecast::scene::texture::{Filter, Level, Texture, TextureRef, Wrap};
use truecast::scene::{Overrides, Scene, SceneErrors};

const HEAD: &str = "version = 1\n\
    [image]\nwidth = 4\nheight = 3\n\
    [camera]\neye = [0, 4, 4]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 45\n";

/// A plane that wears the material "m".
const PLANE: &str = "[[mesh]]\nshape = { plane = {} }\nmaterial = \"m\"\n";

/// The image itself of a texture with grey texels, the bottom row first.
fn grey(width: u32, texels: &[f32]) -> Texture {
    let texels: Vec<_> = texels.iter().map(|&value| [value; 3]).collect();
    let height = texels.len() as u32 / width;
    Texture::new(Path::new("grey.png"), Level::new(width, height, texels).unwrap())
}

fn reference(filter: Filter, wrap: Wrap) -> TextureRef {
    TextureRef { texture: 0, filter, wrap, scale: [1.0; 2], offset: [0.0; 2] }
}

/// A folder with a picture of 2 × 2 pixels, red, green over blue, white, and some more texts.
fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let colors = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 255]];
    let picture = RgbImage::from_fn(2, 2, |x, y| Rgb(colors[(2 * y + x) as usize]));
    picture.save(folder.path().join("four.png")).unwrap();
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

fn load(base: &Path, text: &str) -> Result<Scene, SceneErrors> {
    let text = format!("{HEAD}{text}");
    Scene::from_toml(&text, Path::new("test.toml"), base, &Overrides::default())
}
