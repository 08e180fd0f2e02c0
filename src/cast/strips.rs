//! A buffer cut into pieces that threads fill independently: strips of a few tiles side by side,
//! each with its own part of every row.

use super::tile::SIDE;
use crate::pixel::Window;

/// Width of a strip, in pixels: eight tiles, so that there are enough strips for many threads and
/// cutting the rows costs nothing beside casting.
const WIDTH: u32 = 8 * SIDE as u32;

/// Most strips that a thread takes at once: what the last thread still works on while the others
/// are done is a seventeenth of a frame of 1920 x 1080 pixels at most.
pub(super) const STRIPS_AT_ONCE: usize = 16;

/// Cuts a row-major buffer of `window` into strips: each window with its rows.
pub(super) fn strips<T>(window: Window, buffer: &mut [T]) -> Vec<(Window, Vec<&mut [T]>)> {
    let mut all = Vec::new();
    let mut rest = buffer;
    for band in window.bands(SIDE as u32) {
        let (own, others) = rest.split_at_mut(band.len());
        rest = others;
        let mut strips: Vec<(Window, Vec<&mut [T]>)> = band
            .columns(WIDTH)
            .into_iter()
            .map(|strip| (strip, Vec::with_capacity(SIDE)))
            .collect();
        for row in own.chunks_mut(window.width() as usize) {
            let mut row = row;
            for (strip, rows) in &mut strips {
                let (own, others) = row.split_at_mut(strip.width() as usize);
                row = others;
                rows.push(own);
            }
        }
        all.append(&mut strips);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pixel::Resolution;

    #[test]
    fn every_pixel_is_in_its_strip() {
        let frame = Resolution::new(700, 90).unwrap();
        let window = Window::new(frame, 5, 3, 699, 77).unwrap();
        let mut buffer = vec![None; window.len()];
        for (strip, rows) in strips(window, &mut buffer) {
            assert_eq!(rows.len(), strip.height() as usize);
            for (y, row) in rows.into_iter().enumerate() {
                for (x, place) in row.iter_mut().enumerate() {
                    assert!(place.is_none());
                    *place = Some([strip.x0() + x as u32, strip.y0() + y as u32]);
                }
            }
        }
        for (index, place) in buffer.into_iter().enumerate() {
            let pixel = window.pixel(index);
            assert_eq!(place, Some([pixel.x, pixel.y]));
        }
    }
}
