//! Which numbered things meet which tiles: lists per tile, in the order of the numbers.
//!
//! A counting sort: linear in things and (thing, tile) pairs. Things that meet many tiles are not
//! copied into each of them: every tile looks at their common list, which takes no more time and
//! keeps memory below a fixed number of bytes per thing. What is numbered is its caller's matter.

use super::bounds::Rectangle;
use crate::mutant::{self, Mutant};
use crate::pixel::Window;

/// A thing that meets more tiles than this goes to the common list: an entry takes 4 bytes, so
/// that lists take at most 256 bytes per thing.
const MOST_TILES: u64 = 64;

/// The tiles of a window, as `Window::tiles` cuts it: aligned to multiples of the side.
#[derive(Clone, Copy)]
pub(super) struct Grid {
    pub(super) side: u32,
    pub(super) first_column: u32,
    pub(super) first_row: u32,
    pub(super) columns: u32,
    pub(super) rows: u32,
}

impl Grid {
    pub(super) fn new(window: Window, side: u32) -> Self {
        let (first_column, first_row) = (window.x0() / side, window.y0() / side);
        Self {
            side,
            first_column,
            first_row,
            columns: window.x1().div_ceil(side) - first_column,
            rows: window.y1().div_ceil(side) - first_row,
        }
    }

    /// Number of tiles.
    pub(super) fn len(self) -> usize {
        self.columns as usize * self.rows as usize
    }

    /// A tile's position, row by row of tiles.
    pub(super) fn index(self, tile: Window) -> usize {
        let column = tile.x0() / self.side - self.first_column;
        let row = tile.y0() / self.side - self.first_row;
        row as usize * self.columns as usize + column as usize
    }

    /// The tiles that a rectangle of the window's pixels meets.
    pub(super) fn tiles_of(self, pixels: Rectangle) -> Tiles {
        let more = u32::from(!mutant::is(Mutant::ShortBins));
        Tiles(Rectangle {
            x0: pixels.x0 / self.side - self.first_column,
            y0: pixels.y0 / self.side - self.first_row,
            x1: (pixels.x1 - 1) / self.side + more - self.first_column,
            y1: (pixels.y1 - 1) / self.side + 1 - self.first_row,
        })
    }

    fn indices(self, Tiles(tiles): Tiles) -> impl Iterator<Item = usize> {
        (tiles.y0..tiles.y1).flat_map(move |row| {
            let first = row as usize * self.columns as usize;
            (tiles.x0..tiles.x1).map(move |column| first + column as usize)
        })
    }
}

/// A rectangle of tiles, counted from the window's first.
#[derive(Clone, Copy)]
pub(super) struct Tiles(Rectangle);

impl Tiles {
    /// Whether they are too many for a list each.
    pub(super) fn are_many(self) -> bool {
        let Rectangle { x0, y0, x1, y1 } = self.0;
        u64::from(x1 - x0) * u64::from(y1 - y0) > MOST_TILES
    }
}

/// An entry of a tile's list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Listed {
    /// The number of a thing that meets few tiles.
    Small(u32),
    /// The number of a thing that meets many, and its position among those.
    Large(u32, usize),
}

/// Every tile's list.
pub(super) struct TileLists {
    grid: Grid,
    /// Numbers of tile i, ascending: `numbers[starts[i]..starts[i + 1]]`.
    starts: Vec<usize>,
    numbers: Vec<u32>,
    /// Numbers of the things that meet many tiles, ascending.
    large: Vec<u32>,
}

impl TileLists {
    /// Sorts numbered things, which come in ascending order, into the tiles that they meet.
    pub(super) fn new(grid: Grid, placed: impl Iterator<Item = (u32, Tiles)> + Clone) -> Self {
        // Count the things of each tile, one slot late, and turn counts into starts.
        let mut starts = vec![0_usize; grid.len() + 1];
        for (_, tiles) in placed.clone().filter(|(_, tiles)| !tiles.are_many()) {
            grid.indices(tiles).for_each(|tile| starts[tile + 1] += 1);
        }
        for tile in 1..starts.len() {
            starts[tile] += starts[tile - 1];
        }
        // Put each number into its tiles' next free places.
        let mut next = starts.clone();
        let mut numbers = vec![0; starts.last().copied().unwrap_or(0)];
        let mut large = Vec::new();
        for (number, tiles) in placed {
            if tiles.are_many() {
                large.push(number);
                continue;
            }
            for tile in grid.indices(tiles) {
                numbers[next[tile]] = number;
                next[tile] += 1;
            }
        }
        Self { grid, starts, numbers, large }
    }

    /// The list of a tile, ascending by number.
    pub(super) fn of(&self, tile: Window) -> impl Iterator<Item = Listed> {
        let index = self.grid.index(tile);
        let small = &self.numbers[self.starts[index]..self.starts[index + 1]];
        let (mut small, mut large) =
            (small.iter().peekable(), self.large.iter().enumerate().peekable());
        std::iter::from_fn(move || match (small.peek(), large.peek()) {
            (Some(number), Some((_, other))) if number > other => {
                large.next().map(|(position, number)| Listed::Large(*number, position))
            }
            (Some(_), _) => small.next().copied().map(Listed::Small),
            (None, _) => large.next().map(|(position, number)| Listed::Large(*number, position)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pixel::Resolution;

    #[test]
    fn every_tile_lists_what_meets_it_in_order() {
        let window = Window::new(Resolution::new(100, 90).unwrap(), 5, 3, 97, 90).unwrap();
        let grid = Grid::new(window, 4);
        let rectangles: Vec<_> = (0..60_u32)
            .map(|k| {
                let (x0, y0) = (5 + k * 7 % 80, 3 + k * 13 % 70);
                let side = if k % 5 == 0 { 90 } else { 1 + k % 9 };
                Rectangle { x0, y0, x1: (x0 + side).min(97), y1: (y0 + side).min(90) }
            })
            .collect();
        let placed = rectangles.iter().enumerate().map(|(k, r)| (k as u32, grid.tiles_of(*r)));
        let lists = TileLists::new(grid, placed);
        assert!(lists.large.len() > 3 && lists.large.len() < 30, "{}", lists.large.len());
        for tile in window.tiles(4) {
            let listed: Vec<u32> = lists
                .of(tile)
                .map(|listed| match listed {
                    Listed::Small(number) => number,
                    Listed::Large(number, position) => {
                        assert_eq!(lists.large[position], number);
                        number
                    }
                })
                .collect();
            assert!(listed.is_sorted());
            for (k, rectangle) in rectangles.iter().enumerate() {
                let meets = rectangle.intersection(Rectangle::of(tile)).is_some();
                assert!(!meets || listed.contains(&(k as u32)), "{k} {tile:?}");
            }
        }
    }
}
