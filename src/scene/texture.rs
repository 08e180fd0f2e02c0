//! Textures: linear texels in memory, and how a material refers to them.
//!
//! A texture multiplies a coefficient of its material, texel by texel; looking texels up is
//! `shade::texture`'s business. Files become texels in `decode`, smaller levels are made in
//! `pyramid`.

mod decode;
mod pyramid;

pub(crate) use decode::TextureError;

use crate::color::LinearRgb;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Longest side of a texture, in texels.
pub const MAX_SIDE: u32 = 65_536;

/// Most texels of a texture: 12 bytes each, 3 GiB.
pub const MAX_TEXELS: u64 = 1 << 28;

/// An image in linear light. Clones share the texels.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Its file.
    pub path: PathBuf,
    /// The image itself, and behind it the smaller levels where a material asks for them, each half
    /// as wide and half as high, rounded down but at least 1, down to 1 × 1.
    pub levels: Arc<[Level]>,
}

/// One level of a texture.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    width: u32,
    height: u32,
    texels: Vec<[f32; 3]>,
}

impl Level {
    /// `width` × `height` texels, at least one, the bottom row first; `None` where their number or
    /// a side is wrong.
    pub fn new(width: u32, height: u32, texels: Vec<[f32; 3]>) -> Option<Self> {
        let sides = 1..=MAX_SIDE;
        let count = u64::from(width) * u64::from(height);
        let fits = sides.contains(&width) && sides.contains(&height);
        (fits && texels.len() as u64 == count).then_some(Self { width, height, texels })
    }

    /// Columns.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// All texels, the bottom row first.
    pub fn texels(&self) -> &[[f32; 3]] {
        &self.texels
    }

    /// The texel of a column, counted from the left, and a row, counted from the bottom. It covers
    /// [column, column + 1)/width × [row, row + 1)/height of the uv square.
    ///
    /// # Panics
    /// When there is no such texel.
    pub fn texel(&self, column: u32, row: u32) -> LinearRgb {
        assert!(column < self.width, "a texel of the level");
        let index = row as usize * self.width as usize + column as usize;
        self.texels[index].map(f64::from)
    }
}

impl Texture {
    /// A texture of the texels given, without smaller levels.
    pub fn new(path: &Path, base: Level) -> Self {
        Self { path: path.to_owned(), levels: [base].into() }
    }

    /// Reads a PNG or JPEG file.
    ///
    /// # Errors
    /// [`TextureError`]: what the file is instead, or why it cannot be read.
    pub(crate) fn load(path: &Path) -> Result<Self, TextureError> {
        decode::read(path).map(|base| Self::new(path, base))
    }

    /// The same texture with all its smaller levels.
    #[must_use]
    pub fn with_levels(self) -> Self {
        Self { levels: pyramid::levels(self.base()).into(), path: self.path }
    }

    /// The image itself.
    pub fn base(&self) -> &Level {
        &self.levels[0]
    }
}

/// How texels become a value between their centres.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Filter {
    /// The texel that holds the point.
    Nearest,
    /// The four nearest centres, weighted by distance along each axis.
    #[default]
    Bilinear,
    /// Bilinear in the two levels whose texels are nearest to a pixel in size, weighted likewise.
    Mip,
}

impl Filter {
    /// Every filter by its name in the scene file.
    pub const NAMED: [(&'static str, Self); 3] =
        [("nearest", Self::Nearest), ("bilinear", Self::Bilinear), ("mip", Self::Mip)];
}

/// What lies outside the uv square.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Wrap {
    /// The same square again and again.
    #[default]
    Repeat,
    /// The square's rim.
    Clamp,
}

impl Wrap {
    /// Every wrap by its name in the scene file.
    pub const NAMED: [(&'static str, Self); 2] = [("repeat", Self::Repeat), ("clamp", Self::Clamp)];
}

/// A material's use of a texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureRef {
    /// Position in [`crate::scene::Scene::textures`].
    pub texture: u32,
    /// How it is filtered.
    pub filter: Filter,
    /// What lies outside.
    pub wrap: Wrap,
    /// Factors of u and v, finite; applied first.
    pub scale: [f64; 2],
    /// Added to u and v, finite.
    pub offset: [f64; 2],
}

/// A texture that a material asks for, before it is known whether a triangle wears the material.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureRequest {
    /// Where the file may be; the first that exists counts. At least one.
    pub paths: Vec<PathBuf>,
    /// How it is filtered.
    pub filter: Filter,
    /// What lies outside.
    pub wrap: Wrap,
    /// As in [`TextureRef`].
    pub scale: [f64; 2],
    /// As in [`TextureRef`].
    pub offset: [f64; 2],
    /// Where it was asked for.
    pub place: super::error::Place,
    /// Whether the scene is at fault when the file cannot be read; else it is left out with a
    /// warning, as meshes travel without their textures.
    pub required: bool,
}

/// The textures that a material asks for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TextureRequests {
    /// That of kd.
    pub kd: Option<TextureRequest>,
    /// That of ks.
    pub ks: Option<TextureRequest>,
    /// What the material is without those that are left out.
    pub untextured: Untextured,
}

/// Coefficients that a material has where a texture that it may lack is left out. A texture stands
/// for a coefficient that is not written; without it the default does.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Untextured {
    /// Without the texture of kd.
    pub ka: LinearRgb,
    /// Without the texture of kd.
    pub kd: LinearRgb,
    /// Without the texture of ks.
    pub ks: LinearRgb,
}
