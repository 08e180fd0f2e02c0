//! What the numbers of an id picture mean.

use crate::film::{NumberPlane, Numbers};
use crate::mesh::TriangleId;
use crate::visibility::Visible;

/// Stands for a number that is not finite, in [`IdPlane::words`].
pub const NOT_FINITE: i64 = i64::MIN;

/// "Nothing is visible", where nothing else is said: 2^32 − 1.
pub const NOTHING: i64 = u32::MAX as i64;

/// Largest whole number up to which f32 holds every one: 2^24.
pub const LARGEST_F32_ID: i64 = 1 << 24;

/// One whole number per pixel, as the file has it.
#[derive(Clone, Debug, PartialEq)]
pub struct IdPlane {
    /// The numbers; [`NOT_FINITE`] for NaN and infinities.
    pub words: Vec<i64>,
    /// The numbers were floats and some are above 2^24 (and not 2^32): f32 cannot hold every id
    /// there, so neighbours may have been rounded to one.
    pub may_be_rounded: bool,
}

impl IdPlane {
    /// Takes numbers as ids.
    ///
    /// # Errors
    /// The first pixel, by column and row, whose number is a fraction, in words.
    pub fn of(plane: &NumberPlane) -> Result<Self, String> {
        let values = match &plane.numbers {
            Numbers::Whole(words) => {
                return Ok(Self { words: words.clone(), may_be_rounded: false });
            }
            Numbers::Float(values) => values,
        };
        let mut words = Vec::with_capacity(values.len());
        for (index, &value) in values.iter().enumerate() {
            if value.is_finite() && value.fract() != 0.0 {
                let pixel = plane.window.pixel(index);
                return Err(format!(
                    "pixel ({}, {}) holds {value}, which is not the number of a triangle; write ids \
                     without filtering or scaling",
                    pixel.x, pixel.y
                ));
            }
            // The cast keeps whole numbers up to 2^63 and saturates above, where no id lies.
            words.push(if value.is_finite() { value as i64 } else { NOT_FINITE });
        }
        // 2^32 is 2^32 − 1, our mark of nothing, rounded to f32.
        let may_be_rounded = words.iter().any(|&word| word > LARGEST_F32_ID && word < NOTHING);
        Ok(Self { words, may_be_rounded })
    }
}

/// Another program's answer at a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Theirs {
    /// Nothing is visible.
    Nothing,
    /// This triangle is.
    Triangle(TriangleId),
    /// A number, as the file has it, that is no triangle of the scene.
    Unknown(i64),
}

impl Theirs {
    /// The answer of a program that is right.
    pub fn of(visible: Option<&Visible>) -> Self {
        visible.map_or(Self::Nothing, |visible| Self::Triangle(visible.triangle))
    }
}

/// How numbers become ids.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Convention {
    /// The number of the scene's first triangle.
    pub base: i64,
    /// The number that means nothing; without it 2^32 − 1, and 0 too where ids begin at 1.
    pub background: Option<i64>,
}

impl Convention {
    /// What a number means in a scene of `triangles` triangles.
    pub fn read(self, word: i64, triangles: usize) -> Theirs {
        let is_nothing = match self.background {
            Some(background) => word == background,
            None => word == NOTHING || (self.base == 1 && word == 0),
        };
        if is_nothing {
            return Theirs::Nothing;
        }
        let index = word.checked_sub(self.base).and_then(|index| u32::try_from(index).ok());
        match index.filter(|&index| (index as usize) < triangles) {
            Some(index) => Theirs::Triangle(TriangleId::new(index)),
            None => Theirs::Unknown(word),
        }
    }
}
