//! One tile: its triangles, eight at a time, into its z-buffer.
//!
//! What was found is turned into an answer's shape by `nearest` or `resolve`.

use super::blocks::{BlockGrid, Blocks, NOTHING, SAME_DEPTH};
use super::doubt::Doubt;
use super::draw::{Drawing, Octet};
use super::frame::Frame;
use super::image_plane::ImagePlane;
use super::octet::{Corners, OCTET};
use super::placement::Placement;
use super::tile_rows::{Drawn, TileFrame, TileRows};
use crate::mesh::TriangleMesh;
use crate::pixel::Window;
use crate::simd::SimdLevel;
use fearless_simd::{Simd, dispatch};

/// What the tiles of a frame share.
pub(super) struct Tiling<'a> {
    pub(super) plane: &'a ImagePlane,
    pub(super) frame: Frame,
    pub(super) mesh: &'a TriangleMesh,
    pub(super) placement: Placement,
    pub(super) blocks: BlockGrid,
    pub(super) simd: SimdLevel,
}

impl<'a> Tiling<'a> {
    /// Places all triangles in the tiles of a window.
    pub(super) fn new(
        plane: &'a ImagePlane,
        mesh: &'a TriangleMesh,
        window: Window,
        side: u32,
        simd: SimdLevel,
    ) -> Self {
        let frame = Frame::new(plane);
        let placement = Placement::new(plane, &frame, mesh, window, side, simd);
        Self { plane, frame, mesh, placement, blocks: BlockGrid::new(side), simd }
    }
}

/// A tile's z-buffer, and room to work in: used for one tile after the other.
pub(super) struct Tile {
    pub(super) blocks: Blocks,
    /// The triangles that were drawn, by number.
    pub(super) drawn: Vec<Drawn>,
    counting: bool,
    triangles: Vec<u32>,
    drawing: Drawing,
    rows: TileRows,
    corners: Corners,
}

impl Tile {
    pub(super) fn new(counting: bool) -> Self {
        Self {
            blocks: Blocks::new(counting),
            drawn: Vec::new(),
            counting,
            triangles: Vec::new(),
            drawing: Drawing::new(),
            rows: TileRows::new(),
            corners: Corners::new(),
        }
    }

    /// Draws a tile, and hands back the stage that settled its doubts.
    pub(super) fn draw<'a>(&mut self, tiling: &'a Tiling<'a>, window: Window) -> Doubt<'a> {
        let mut doubt = Doubt::new(tiling.plane, &tiling.frame, tiling.mesh, window);
        self.blocks.clear(&tiling.blocks, window);
        self.drawn.clear();
        tiling.placement.triangles(window, &mut self.triangles);
        match self.counting {
            false => dispatch!(tiling.simd.dispatched(), simd => {
                self.draw_octets::<_, true, false>(simd, tiling, window, &mut doubt);
            }),
            true => dispatch!(tiling.simd.dispatched(), simd => {
                self.draw_octets::<_, true, true>(simd, tiling, window, &mut doubt);
            }),
        }
        for candidate in tiling.placement.hard(window) {
            doubt.draw_hard(&tiling.blocks, &mut self.blocks, &mut self.drawn, candidate);
        }
        doubt
    }

    #[inline(always)]
    fn draw_octets<S: Simd, const CERTIFIED: bool, const COUNTING: bool>(
        &mut self,
        simd: S,
        tiling: &Tiling<'_>,
        window: Window,
        doubt: &mut Doubt<'_>,
    ) {
        let place = TileFrame::new(simd, &tiling.frame, &tiling.blocks, window);
        for octet in self.triangles.chunks(OCTET) {
            for (lane, &id) in octet.iter().enumerate() {
                self.corners.set(lane, tiling.mesh, id);
            }
            let lanes = (1 << octet.len()) - 1;
            let farthest = match COUNTING {
                true => f32::NEG_INFINITY,
                false => self.blocks.farthest_of_all,
            };
            let lanes = self.rows.set_up::<S, CERTIFIED>(
                simd,
                &tiling.frame,
                &place,
                &self.corners,
                lanes,
                farthest,
            );
            if lanes == 0 {
                continue;
            }
            let mut numbers = [0; OCTET];
            let mut left = lanes;
            while left != 0 {
                let lane = left.trailing_zeros() as usize & 7;
                left &= left - 1;
                numbers[lane] = self.drawn.len() as u32;
                self.drawn.push(self.rows.drawn(&tiling.frame, lane, octet[lane]));
            }
            let octet = Octet { rows: &self.rows, lanes, drawn: &self.drawn, numbers: &numbers };
            self.drawing.draw::<S, CERTIFIED, COUNTING>(
                simd,
                &tiling.blocks,
                &mut self.blocks,
                &octet,
                doubt,
            );
        }
    }

    /// The number of the triangle that is visible at a lane, and whether another has the same depth
    /// there.
    pub(super) fn winner(&self, block: usize, lane: usize) -> Option<(u32, bool)> {
        let winner = self.blocks.winner[block].0[lane];
        (winner != NOTHING).then_some((winner & !SAME_DEPTH, winner & SAME_DEPTH != 0))
    }
}
