//! One tile: its triangles, eight at a time, into its z-buffer.
//!
//! What was found is turned into an answer's shape by `nearest` or `resolve`.

use super::blocks::{BlockGrid, Blocks};
use super::doubt::Doubt;
use super::draw::{Drawing, Octet};
use super::frame::Frame;
use super::image_plane::ImagePlane;
use super::octet::{Corners, OCTET};
use super::order::Order;
use super::placement::Placement;
use super::tile_rows::{Drawn, TileFrame, TileRows, is_hidden};
use crate::mesh::TriangleMesh;
use crate::pixel::Window;
use crate::scene::camera::PinholeCamera;
use crate::simd::SimdLevel;
use fearless_simd::{Simd, dispatch};

/// Octets whose corners are read at once: 2.5 kB.
const AHEAD: usize = 8;

/// What the tiles of a frame share.
pub(super) struct Tiling<'a> {
    pub(super) plane: ImagePlane,
    pub(super) frame: Frame,
    pub(super) mesh: &'a TriangleMesh,
    pub(super) placement: Placement,
    pub(super) blocks: BlockGrid,
    pub(super) simd: SimdLevel,
}

impl<'a> Tiling<'a> {
    /// Places all triangles in the tiles of a window.
    pub(super) fn new(
        camera: &PinholeCamera,
        mesh: &'a TriangleMesh,
        window: Window,
        side: u32,
        simd: SimdLevel,
    ) -> Self {
        let plane = ImagePlane::new(camera);
        let frame = Frame::new(&plane);
        let placement = Placement::new(&plane, &frame, mesh, window, side, simd);
        Self { plane, frame, mesh, placement, blocks: BlockGrid::new(side), simd }
    }
}

/// A tile's z-buffer, and room to work in: used for one tile after the other.
pub(super) struct Tile {
    pub(super) blocks: Blocks,
    /// The triangles that were drawn, by number.
    pub(super) drawn: Vec<Drawn>,
    counting: bool,
    order: Order,
    drawing: Drawing,
    rows: TileRows,
    corners: Box<[Corners; AHEAD]>,
}

impl Tile {
    pub(super) fn new(counting: bool) -> Self {
        Self {
            blocks: Blocks::new(counting),
            drawn: Vec::new(),
            counting,
            order: Order::default(),
            drawing: Drawing::new(),
            rows: TileRows::new(),
            corners: Box::new([const { Corners::new() }; AHEAD]),
        }
    }

    /// Draws a tile, and hands back the stage that settled its doubts.
    pub(super) fn draw<'a>(&mut self, tiling: &'a Tiling<'a>, window: Window) -> Doubt<'a> {
        let mut doubt = Doubt::new(&tiling.plane, &tiling.frame, tiling.mesh, window);
        self.blocks.clear(&tiling.blocks, window);
        self.drawn.clear();
        tiling.placement.triangles(window, &mut self.order);
        self.order.sort();
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
        let mut class = 0;
        for (index, octet) in self.order.sorted().chunks(OCTET).enumerate() {
            let least_w = self.order.least_w(index * OCTET, &mut class);
            if !COUNTING && is_hidden(least_w, self.blocks.farthest_of_all) {
                break;
            }
            // Read many triangles at once, so that their ways to memory overlap.
            if index % AHEAD == 0 {
                let ahead = self.order.sorted()[index * OCTET..].iter().take(AHEAD * OCTET);
                for (place, &id) in ahead.enumerate() {
                    self.corners[place / OCTET].set(place % OCTET, tiling.mesh, id);
                }
            }
            let corners = &self.corners[index % AHEAD];
            let lanes = (1 << octet.len()) - 1;
            let farthest = match COUNTING {
                true => f32::NEG_INFINITY,
                false => self.blocks.farthest_of_all,
            };
            let lanes = self.rows.set_up::<S, CERTIFIED>(
                simd,
                &tiling.frame,
                &place,
                corners,
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
}
