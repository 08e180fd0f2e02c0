//! PNG and JPEG files into linear texels.
//!
//! Sample values are sRGB codes (IEC 61966-2-1) whatever the file says of its colours: embedded
//! profiles, gamma and orientation are not read. Grey is equal parts, alpha is left out. An 8-bit
//! code is decoded by the table of `color`, a 16-bit one by the curve with `libm::pow`, both in f64
//! and rounded once to f32. So a PNG gives the same texels everywhere; for a JPEG the format itself
//! leaves the last code to the decoder.

use super::{Level, MAX_SIDE, MAX_TEXELS};
use crate::color::{srgb_decode, srgb_decode_16};
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use std::io::Cursor;
use std::path::Path;

/// Why a file is no texture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub(crate) enum TextureError {
    /// It cannot be read at all.
    #[error("cannot be read: {0}")]
    Reading(String),
    /// It is something else.
    #[error("is neither a PNG nor a JPEG image")]
    Kind,
    /// It is damaged, or uses something that is not decoded.
    #[error("cannot be decoded: {0}")]
    Damaged(String),
    /// It has too many texels.
    #[error("has {0} × {1} texels; at most 65536 a side and 2^28 in all are read")]
    Size(u32, u32),
}

/// The file's texels.
pub(super) fn read(path: &Path) -> Result<Level, TextureError> {
    if path.is_dir() {
        return Err(TextureError::Reading("it is a folder".to_owned()));
    }
    let bytes = std::fs::read(path).map_err(|error| TextureError::Reading(error.to_string()))?;
    decode(&bytes)
}

/// The texels of a file's bytes. What kind of file it is, its first bytes tell, not its name.
fn decode(bytes: &[u8]) -> Result<Level, TextureError> {
    let damaged = |error: image::ImageError| TextureError::Damaged(error.to_string());
    let format = match image::guess_format(bytes) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg)) => format,
        _ => return Err(TextureError::Kind),
    };
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    // The size is checked below, before memory for the texels is taken.
    reader.limits(Limits::no_limits());
    let decoder = reader.into_decoder().map_err(damaged)?;
    let (width, height) = decoder.dimensions();
    if width.max(height) > MAX_SIDE || u64::from(width) * u64::from(height) > MAX_TEXELS {
        return Err(TextureError::Size(width, height));
    }
    let image = DynamicImage::from_decoder(decoder).map_err(damaged)?;
    let texels = linear_texels(image);
    Level::new(width, height, texels).ok_or_else(|| TextureError::Damaged("no texels".to_owned()))
}

/// Linear texels, the bottom row first; files hold the top row first.
fn linear_texels(image: DynamicImage) -> Vec<[f32; 3]> {
    let is_deep = image.color().bytes_per_pixel() / image.color().channel_count() > 1;
    if is_deep {
        let codes = image.into_rgb16();
        let rows = codes.rows().rev();
        rows.flatten().map(|pixel| pixel.0.map(|code| srgb_decode_16(code) as f32)).collect()
    } else {
        let codes = image.into_rgb8();
        let rows = codes.rows().rev();
        rows.flatten().map(|pixel| pixel.0.map(|code| srgb_decode(code) as f32)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{ImageBuffer, Luma, LumaA, Rgb, Rgba};

    fn encoded(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        image.write_to(&mut bytes, format).unwrap();
        bytes.into_inner()
    }

    fn png(image: impl Into<DynamicImage>) -> Level {
        decode(&encoded(&image.into(), ImageFormat::Png)).unwrap()
    }

    #[test]
    fn eight_bit_codes_are_the_table_rounded_once() {
        let level = png(ImageBuffer::from_fn(256, 1, |x, _| Rgb([x as u8, 0, 255])));
        for code in 0..=255_u8 {
            let texel = level.texels()[usize::from(code)];
            assert_eq!(texel, [srgb_decode(code) as f32, 0.0, 1.0]);
        }
        // (1/255)/12.92, ((127/255 + 0.055)/1.055)^2.4 and so on, to seven digits.
        let known = [(0, 0.0), (1, 0.000303527), (127, 0.2122308), (128, 0.2158605), (255, 1.0)];
        for (code, linear) in known {
            // Half a unit of the seventh digit.
            assert!((f64::from(level.texels()[code][0]) - linear).abs() <= 5e-8, "{code}");
        }
    }

    #[test]
    fn sixteen_bits_agree_with_eight() {
        // 257·c/65535 is c/255.
        let deep = png(ImageBuffer::from_fn(256, 1, |x, _| Rgb([257 * x as u16; 3])));
        let shallow = png(ImageBuffer::from_fn(256, 1, |x, _| Rgb([x as u8; 3])));
        assert_eq!(deep, shallow);
        let between = png(ImageBuffer::from_pixel(1, 1, Luma([40_000_u16])));
        assert_eq!(between.texels(), [[srgb_decode_16(40_000) as f32; 3]]);
    }

    #[test]
    fn grey_is_equal_parts_and_alpha_is_left_out() {
        let half = srgb_decode(128) as f32;
        let grey = png(ImageBuffer::from_pixel(2, 1, Luma([128_u8])));
        assert_eq!(grey.texels(), [[half; 3]; 2]);
        let clear = png(ImageBuffer::from_pixel(1, 1, LumaA([128_u8, 0])));
        assert_eq!(clear.texels(), [[half; 3]]);
        let clear = png(ImageBuffer::from_pixel(1, 1, Rgba([255_u8, 128, 0, 0])));
        assert_eq!(clear.texels(), [[1.0, half, 0.0]]);
    }

    #[test]
    fn the_bottom_row_comes_first() {
        let level = png(ImageBuffer::from_fn(2, 2, |x, y| Rgb([255 * x as u8, 255 * y as u8, 0])));
        assert_eq!(
            level.texels(),
            [[0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]
        );
        assert_eq!(level.texel(1, 0), [1.0, 1.0, 0.0]);
    }

    #[test]
    fn jpeg_is_read() {
        let image = ImageBuffer::from_pixel(9, 5, Rgb([200_u8, 200, 200]));
        let level = decode(&encoded(&image.into(), ImageFormat::Jpeg)).unwrap();
        assert_eq!((level.width(), level.height()), (9, 5));
        // One colour has no detail to lose; one code for the rounding of its colour space.
        let [low, high] = [199, 201].map(|code| srgb_decode(code) as f32);
        assert!(level.texels().iter().flatten().all(|&c| (low..=high).contains(&c)));
    }

    #[test]
    fn damaged_files_are_errors_and_never_panics() {
        assert_eq!(decode(b""), Err(TextureError::Kind));
        assert_eq!(decode(b"BM not a bitmap"), Err(TextureError::Kind));
        let picture: DynamicImage =
            ImageBuffer::from_fn(24, 16, |x, y| Rgb([10 * x as u8, 15 * y as u8, 7])).into();
        let whole = encoded(&picture, ImageFormat::Png);
        for end in 0..whole.len() - 12 {
            assert!(decode(&whole[..end]).is_err(), "{end}");
        }
        // A JPEG that is cut may be shown in part; both are fine.
        let whole = encoded(&picture, ImageFormat::Jpeg);
        for end in 0..whole.len() {
            drop(decode(&whole[..end]));
            for value in [0, 0xFF] {
                let mut bytes = whole.clone();
                bytes[end] = value;
                drop(decode(&bytes));
            }
        }
    }

    #[test]
    fn too_large_is_refused_before_memory_is_taken() {
        // The header of a PNG of 65 537 × 1 texels, and of 65 536 × 8192.
        for (width, height) in [(65_537, 1), (65_536, 8192)] {
            let mut bytes = Vec::new();
            let mut encoder = png::Encoder::new(&mut bytes, width, height);
            encoder.set_color(png::ColorType::Grayscale);
            let writer = encoder.write_header().unwrap();
            drop(writer);
            // The decoder looks for the data before it tells the size.
            let header = bytes.len() - 12;
            bytes.truncate(header);
            bytes.extend([0, 0, 0, 0]);
            bytes.extend(b"IDAT\x35\xAF\x06\x1E");
            assert_eq!(decode(&bytes), Err(TextureError::Size(width, height)));
        }
    }
}
