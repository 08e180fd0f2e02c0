//! One tile: its triangles, eight at a time, into its z-buffer.
//!
//! What was found is turned into an answer's shape by `nearest` or `resolve`.

use super::arithmetic::{Arithmetic, Certain, Double, Kernel, Single, Stored};
use super::blocks::{BlockGrid, Blocks, MOST_BLOCKS};
use super::doubt::Doubt;
use super::draw::{Drawing, Octet};
use super::frame::Frame;
use super::image_plane::ImagePlane;
use super::octet::{Corners, OCTET};
use super::order::Order;
use super::placement::Placement;
use super::tile_rows::{Drawn, TileFrame, TileRows, is_hidden};
use super::unproven::StoredDepth;
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
    pub(super) kernel: Kernel,
    pub(super) stored: StoredDepth,
}

impl<'a> Tiling<'a> {
    /// Places all triangles in the tiles of a window.
    pub(super) fn new(
        camera: &PinholeCamera,
        mesh: &'a TriangleMesh,
        window: Window,
        side: u32,
        simd: SimdLevel,
        kernel: Kernel,
    ) -> Self {
        let plane = ImagePlane::new(camera);
        let frame = Frame::new(&plane);
        let placement = Placement::new(&plane, &frame, mesh, (window, side), simd, kernel);
        let stored = StoredDepth::new(kernel, frame.ray_parameter);
        Self { plane, frame, mesh, placement, blocks: BlockGrid::new(side), simd, kernel, stored }
    }
}

/// A tile's z-buffer, and room to work in: used for one tile after the other.
pub(super) struct Tile {
    pub(super) blocks: Blocks,
    /// The triangles that were drawn, by number.
    pub(super) drawn: Vec<Drawn>,
    /// Per block, the winners' 1/w, for [`Kernel::Double`]; 0 where nothing was drawn.
    pub(super) depths: Vec<[f64; 16]>,
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
            depths: Vec::new(),
            counting,
            order: Order::default(),
            drawing: Drawing::new(),
            rows: TileRows::new(),
            corners: Box::new([const { Corners::new() }; AHEAD]),
        }
    }

    /// How many triangles the tile drawn last was listed for, hard ones left out.
    pub(super) fn listed(&self) -> u64 {
        self.order.sorted().len() as u64
    }

    /// Draws a tile, and hands back the stage that settled its doubts.
    pub(super) fn draw<'a>(&mut self, tiling: &'a Tiling<'a>, window: Window) -> Doubt<'a> {
        let mut doubt = Doubt::new(&tiling.plane, &tiling.frame, tiling.mesh, window);
        self.blocks.clear(&tiling.blocks, window);
        self.drawn.clear();
        tiling.placement.triangles(window, &mut self.order);
        match tiling.kernel {
            // Of equal depths the first that was submitted stays.
            Kernel::Stored(..) => self.order.keep(),
            _ => self.order.sort(),
        }
        match (tiling.kernel, self.counting) {
            (Kernel::Certain, false) => dispatch!(tiling.simd.dispatched(), simd => {
                self.draw_octets::<_, Certain, false>(simd, tiling, window, &mut doubt);
            }),
            (Kernel::Certain, true) => dispatch!(tiling.simd.dispatched(), simd => {
                self.draw_octets::<_, Certain, true>(simd, tiling, window, &mut doubt);
            }),
            (Kernel::Double, _) => {
                self.depths.resize(MOST_BLOCKS, [0.0; 16]);
                for (depths, low) in self.depths.iter_mut().zip(&self.blocks.low[..]) {
                    // Nothing is drawn where the z-buffer holds +∞.
                    *depths = low.0.map(|low| f64::from(low).max(0.0));
                }
                dispatch!(tiling.simd.dispatched(), simd => {
                    self.draw_octets::<_, Double, false>(simd, tiling, window, &mut doubt);
                });
            }
            (Kernel::Single, _) => dispatch!(tiling.simd.dispatched(), simd => {
                self.draw_octets::<_, Single, false>(simd, tiling, window, &mut doubt);
            }),
            (Kernel::Stored(..), _) => dispatch!(tiling.simd.dispatched(), simd => {
                self.draw_octets::<_, Stored, false>(simd, tiling, window, &mut doubt);
            }),
        }
        for candidate in tiling.placement.hard(window) {
            doubt.draw_hard(&tiling.blocks, &mut self.blocks, &mut self.drawn, candidate);
        }
        doubt
    }

    #[inline(always)]
    fn draw_octets<S: Simd, A: Arithmetic, const COUNTING: bool>(
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
            let lanes =
                self.rows.set_up::<S, A>(simd, &tiling.frame, &place, corners, lanes, farthest);
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
            let octet = Octet {
                rows: &self.rows,
                lanes,
                drawn: &self.drawn,
                numbers: &numbers,
                stored: &tiling.stored,
            };
            let (grid, blocks) = (&tiling.blocks, &mut self.blocks);
            match A::DOUBLE {
                true => self.drawing.draw_double(simd, grid, blocks, &mut self.depths, &octet),
                false => {
                    self.drawing.draw::<S, A, COUNTING>(simd, grid, blocks, &octet, doubt);
                }
            }
        }
    }
}
