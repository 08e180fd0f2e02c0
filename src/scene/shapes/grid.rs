//! A surface of rows and columns of cells, each cut into two triangles: the common part of all
//! shapes but the icosphere. No geometry here, only numbering.
//!
//! Rows run downwards and columns to the right as seen from outside, so that the triangles
//! (top left, bottom left, bottom right) and (top left, bottom right, top right) run
//! counter-clockwise. At an edge that shrinks to a point, the triangle without area is left out.

use crate::scene::part::MeshPart;

/// What the first or last row of points is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Edge {
    /// A row of its own.
    Row,
    /// One point.
    Point,
}

/// The cells of a surface and how its edges meet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    /// Rows of cells, at least 1.
    pub(super) rows: u32,
    /// Columns of cells, at least 1.
    pub(super) columns: u32,
    /// Whether the last row meets the first.
    pub(super) rows_close: bool,
    /// Whether the last column meets the first.
    pub(super) columns_close: bool,
    /// The first row of points.
    pub(super) top: Edge,
    /// The last row of points.
    pub(super) bottom: Edge,
}

/// Where a grid's values stand in a list: row by row, starting at `first`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Numbering {
    first: u32,
    row_points: u32,
    column_points: u32,
    top: Edge,
    bottom: Edge,
}

impl Numbering {
    /// The same entry of a list at every point.
    pub(super) const fn constant(index: u32) -> Self {
        let (top, bottom) = (Edge::Row, Edge::Row);
        Self { first: index, row_points: 1, column_points: 1, top, bottom }
    }

    /// Position in the list of the value at a point; indices past a closing edge start again.
    fn index(&self, row: u32, column: u32) -> u32 {
        let row = row % self.row_points;
        let at_point = (row == 0 && self.top == Edge::Point)
            || (row + 1 == self.row_points && self.bottom == Edge::Point);
        let column = if at_point { 0 } else { column % self.column_points };
        match (self.top, row) {
            (Edge::Point, 0) => self.first,
            (Edge::Point, _) => self.first + 1 + (row - 1) * self.column_points + column,
            (Edge::Row, _) => self.first + row * self.column_points + column,
        }
    }

    /// Appends the value at every point.
    fn fill<T>(&self, list: &mut Vec<T>, value: impl Fn(u32, u32) -> T) {
        for row in 0..self.row_points {
            let at_point = (row == 0 && self.top == Edge::Point)
                || (row + 1 == self.row_points && self.bottom == Edge::Point);
            let columns = if at_point { 1 } else { self.column_points };
            list.extend((0..columns).map(|column| value(row, column)));
        }
    }
}

impl Grid {
    /// A grid none of whose edges meet.
    pub(super) const fn open(rows: u32, columns: u32) -> Self {
        let (top, bottom) = (Edge::Row, Edge::Row);
        Self { rows, columns, rows_close: false, columns_close: false, top, bottom }
    }

    /// A tube whose columns go round.
    pub(super) const fn tube(rows: u32, columns: u32) -> Self {
        Self { columns_close: true, ..Self::open(rows, columns) }
    }

    /// Appends one value for each distinct point of the surface.
    pub(super) fn fill_points<T>(
        &self,
        list: &mut Vec<T>,
        value: impl Fn(u32, u32) -> T,
    ) -> Numbering {
        self.fill(list, self.top, self.bottom, value)
    }

    /// Appends one value for each point, but one for each column where an edge is a point: the
    /// value at `(row, column)` of such an edge serves the triangle between `column` and the next.
    pub(super) fn fill_per_column<T>(
        &self,
        list: &mut Vec<T>,
        value: impl Fn(u32, u32) -> T,
    ) -> Numbering {
        self.fill(list, Edge::Row, Edge::Row, value)
    }

    fn fill<T>(
        &self,
        list: &mut Vec<T>,
        top: Edge,
        bottom: Edge,
        value: impl Fn(u32, u32) -> T,
    ) -> Numbering {
        let numbering = Numbering {
            first: list.len() as u32,
            row_points: self.rows + u32::from(!self.rows_close),
            column_points: self.columns + u32::from(!self.columns_close),
            top,
            bottom,
        };
        numbering.fill(list, value);
        numbering
    }

    /// Appends texture coordinates that run over the whole surface once: s from left to right, t
    /// from bottom to top. They do not close; at an edge that is a point, s is the middle of the
    /// triangle's column.
    pub(super) fn fill_texture_points(&self, list: &mut Vec<[f64; 2]>) -> Numbering {
        let unrolled = Self { rows_close: false, columns_close: false, ..*self };
        unrolled.fill_per_column(list, |row, column| {
            let at_point = (row == 0 && self.top == Edge::Point)
                || (row == self.rows && self.bottom == Edge::Point);
            let shift = if at_point { 0.5 } else { 0.0 };
            let s = (f64::from(column) + shift) / f64::from(self.columns);
            [s, f64::from(self.rows - row) / f64::from(self.rows)]
        })
    }

    /// Appends the corners, cell by cell, row by row; every cell is a polygon.
    pub(super) fn append_cells(&self, part: &mut MeshPart, points: Numbering) {
        let first = part.polygons.last().map_or(0, |last| last + 1);
        self.append_triangles(&mut part.corners, points);
        for row in 0..self.rows {
            let shrinks_above = row == 0 && self.top == Edge::Point;
            let shrinks_below = row + 1 == self.rows && self.bottom == Edge::Point;
            let triangles = usize::from(!shrinks_above) + usize::from(!shrinks_below);
            for column in 0..self.columns {
                let cell = first + row * self.columns + column;
                part.polygons.extend(std::iter::repeat_n(cell, triangles));
            }
        }
    }

    /// Appends the triangles, cell by cell, row by row, as indices of a numbering.
    pub(super) fn append_triangles(&self, list: &mut Vec<[u32; 3]>, numbering: Numbering) {
        self.append_triangles_by_place(list, |[row, column], [down, right]| {
            numbering.index(row + down, column + right)
        });
    }

    /// Appends the triangles, cell by cell, row by row. `index` is asked for each corner, given its
    /// cell's row and column and how far down and to the right in the cell it is (0 or 1).
    pub(super) fn append_triangles_by_place(
        &self,
        list: &mut Vec<[u32; 3]>,
        index: impl Fn([u32; 2], [u32; 2]) -> u32,
    ) {
        list.reserve_exact(self.triangle_count() as usize);
        for row in 0..self.rows {
            let shrinks_above = row == 0 && self.top == Edge::Point;
            let shrinks_below = row + 1 == self.rows && self.bottom == Edge::Point;
            for cell in (0..self.columns).map(|column| [row, column]) {
                let [top_left, top_right] = [[0, 0], [0, 1]].map(|place| index(cell, place));
                let bottom_left = index(cell, [1, 0]);
                // A point below serves the column to its right, as a point above does.
                let low = if shrinks_below { bottom_left } else { index(cell, [1, 1]) };
                if !shrinks_below {
                    list.push([top_left, bottom_left, low]);
                }
                if !shrinks_above {
                    list.push([top_left, low, top_right]);
                }
            }
        }
    }

    /// Number of triangles.
    pub(super) fn triangle_count(&self) -> u128 {
        let columns = u128::from(self.columns);
        let lost = u128::from(self.top == Edge::Point) + u128::from(self.bottom == Edge::Point);
        (2 * u128::from(self.rows) - lost) * columns
    }
}
