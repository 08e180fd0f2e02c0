//! The pixel grid: sizes, windows, where a sample is, and the two parallel loops of the crate.
//!
//! Rows run downwards, pixel (0, 0) is top left, and the sample of pixel (i, j) is the point
//! (i + ½, j + ½) of the image plane. Nothing here knows rays, triangles or colours.

use rayon::prelude::*;

/// Largest width and largest height of an image, in pixels.
pub const MAX_SIDE: u32 = 65_536;

/// Size of a full frame, in pixels; each side is 1…65 536.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Resolution {
    width: u32,
    height: u32,
}

impl Resolution {
    /// A resolution, or `None` when a side is 0 or larger than [`MAX_SIDE`].
    pub const fn new(width: u32, height: u32) -> Option<Self> {
        if width == 0 || height == 0 || width > MAX_SIDE || height > MAX_SIDE {
            return None;
        }
        Some(Self { width, height })
    }

    /// Columns, in pixels.
    pub const fn width(self) -> u32 {
        self.width
    }

    /// Rows, in pixels.
    pub const fn height(self) -> u32 {
        self.height
    }

    /// The window that covers the whole frame.
    pub const fn window(self) -> Window {
        Window { x0: 0, y0: 0, x1: self.width, y1: self.height }
    }
}

/// A pixel by column and row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Pixel {
    /// Column, 0 at the left.
    pub x: u32,
    /// Row, 0 at the top.
    pub y: u32,
}

impl Pixel {
    /// The pixel's sample, its centre, in pixel units of the image plane (exact in f64).
    pub const fn sample(self) -> [f64; 2] {
        [self.x as f64 + 0.5, self.y as f64 + 0.5]
    }
}

/// A non-empty rectangle of pixels, half open: columns `x0..x1`, rows `y0..y1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Window {
    x0: u32,
    y0: u32,
    x1: u32,
    y1: u32,
}

impl Window {
    /// A window inside `frame`, or `None` when it is empty or reaches outside.
    pub const fn new(frame: Resolution, x0: u32, y0: u32, x1: u32, y1: u32) -> Option<Self> {
        if x0 >= x1 || y0 >= y1 || x1 > frame.width || y1 > frame.height {
            return None;
        }
        Some(Self { x0, y0, x1, y1 })
    }

    /// First column.
    pub const fn x0(self) -> u32 {
        self.x0
    }

    /// First row.
    pub const fn y0(self) -> u32 {
        self.y0
    }

    /// One past the last column.
    pub const fn x1(self) -> u32 {
        self.x1
    }

    /// One past the last row.
    pub const fn y1(self) -> u32 {
        self.y1
    }

    /// Columns, in pixels.
    pub const fn width(self) -> u32 {
        self.x1 - self.x0
    }

    /// Rows, in pixels.
    pub const fn height(self) -> u32 {
        self.y1 - self.y0
    }

    /// Number of pixels.
    pub const fn len(self) -> usize {
        self.width() as usize * self.height() as usize
    }

    /// Always false: a window is never empty.
    pub const fn is_empty(self) -> bool {
        false
    }

    /// Whether the pixel lies in this window.
    pub const fn contains(self, pixel: Pixel) -> bool {
        pixel.x >= self.x0 && pixel.x < self.x1 && pixel.y >= self.y0 && pixel.y < self.y1
    }

    /// Row-major position of `pixel` in this window. The pixel must lie inside.
    pub fn index(self, pixel: Pixel) -> usize {
        debug_assert!(self.contains(pixel), "{pixel:?} is outside {self:?}");
        (pixel.y - self.y0) as usize * self.width() as usize + (pixel.x - self.x0) as usize
    }

    /// The pixel at a row-major position of this window.
    pub fn pixel(self, index: usize) -> Pixel {
        debug_assert!(index < self.len());
        let width = self.width() as usize;
        Pixel { x: self.x0 + (index % width) as u32, y: self.y0 + (index / width) as u32 }
    }

    /// All pixels, row by row.
    pub fn pixels(self) -> impl Iterator<Item = Pixel> {
        (self.y0..self.y1).flat_map(move |y| (self.x0..self.x1).map(move |x| Pixel { x, y }))
    }

    /// The window cut into bands of at most `height` rows, aligned as [`Self::tiles`] are.
    pub fn bands(self, height: u32) -> Vec<Window> {
        assert!(height > 0, "a band has at least one row");
        (self.y0 / height..self.y1.div_ceil(height))
            .map(|band| Window {
                x0: self.x0,
                y0: (band * height).max(self.y0),
                x1: self.x1,
                y1: ((band + 1) * height).min(self.y1),
            })
            .collect()
    }

    /// The window cut into pieces of at most `width` columns, aligned as [`Self::tiles`] are.
    pub fn columns(self, width: u32) -> Vec<Window> {
        assert!(width > 0, "a piece has at least one column");
        (self.x0 / width..self.x1.div_ceil(width))
            .map(|piece| Window {
                x0: (piece * width).max(self.x0),
                x1: ((piece + 1) * width).min(self.x1),
                ..self
            })
            .collect()
    }

    /// The window from the first column of this one to the last of `other`, which stands right of it, in
    /// the same rows.
    #[must_use]
    pub fn joined(self, other: Window) -> Window {
        debug_assert_eq!((self.y0, self.y1), (other.y0, other.y1));
        Window { x1: other.x1, ..self }
    }

    /// The window cut into tiles of at most `side` × `side` pixels, row by row of tiles.
    /// Tiles are aligned to multiples of `side` of the frame, so a crop is cut as its frame is.
    pub fn tiles(self, side: u32) -> Vec<Window> {
        assert!(side > 0, "a tile has at least one pixel");
        let mut tiles = Vec::new();
        for ty in self.y0 / side..self.y1.div_ceil(side) {
            for tx in self.x0 / side..self.x1.div_ceil(side) {
                tiles.push(Window {
                    x0: (tx * side).max(self.x0),
                    y0: (ty * side).max(self.y0),
                    x1: ((tx + 1) * side).min(self.x1),
                    y1: ((ty + 1) * side).min(self.y1),
                });
            }
        }
        tiles
    }
}

/// Works on every tile in parallel and hands back the results in the order of `tiles`, so that
/// nothing downstream can depend on which thread did what. `done` is called once per finished
/// tile, from any thread (progress bars).
pub fn for_each_tile<T: Send>(
    tiles: &[Window],
    done: &(dyn Fn() + Sync),
    work: impl Fn(Window) -> T + Sync,
) -> Vec<T> {
    tiles
        .par_iter()
        .map(|&tile| {
            let result = work(tile);
            done();
            result
        })
        .collect()
}

/// Works on every row of a row-major buffer in parallel: `work(row_in_buffer, row)`.
/// `done` is called once per finished row, from any thread.
pub fn for_each_row<T: Send>(
    buffer: &mut [T],
    width: usize,
    done: &(dyn Fn() + Sync),
    work: impl Fn(usize, &mut [T]) + Sync,
) {
    buffer.par_chunks_mut(width).enumerate().for_each(|(row, pixels)| {
        work(row, pixels);
        done();
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_a_window_exactly_once() {
        let frame = Resolution::new(70, 41).unwrap();
        let window = Window::new(frame, 3, 5, 67, 41).unwrap();
        let mut seen = vec![0; window.len()];
        for tile in window.tiles(16) {
            for pixel in tile.pixels() {
                seen[window.index(pixel)] += 1;
            }
        }
        assert!(seen.iter().all(|&count| count == 1));
    }

    #[test]
    fn sizes_outside_the_contract_are_refused() {
        assert!(Resolution::new(0, 5).is_none());
        assert!(Resolution::new(5, 65_537).is_none());
        assert!(Resolution::new(1, 65_536).is_some());
        let frame = Resolution::new(4, 4).unwrap();
        assert!(Window::new(frame, 2, 0, 2, 4).is_none());
        assert!(Window::new(frame, 0, 0, 5, 4).is_none());
    }

    #[test]
    fn index_and_pixel_are_inverse() {
        let window = Window::new(Resolution::new(9, 9).unwrap(), 2, 3, 7, 8).unwrap();
        for (index, pixel) in window.pixels().enumerate() {
            assert_eq!(window.index(pixel), index);
            assert_eq!(window.pixel(index), pixel);
        }
    }
}
