//! A frame in bands of rows: each is seen, shaded and laid out before the next, so that a whole
//! frame of visible triangles, radiances and planes is never held.
//!
//! What the bands share is made once: tree, occluders, description. No bit of the film depends on
//! where bands end; every stage works on all threads.

use super::answerer::Answerer;
use super::develop::develop_described;
use super::expose::{Occluders, expose_with, occluders};
use super::visible::list_visible;
use super::{
    Account, Accuracy, PlaneGroup, Progress, RenderOptions, Unwatched, VisibilityPath, cached_tree,
    describe,
};
use crate::accel::Accelerator;
use crate::film::Film;
use crate::pixel::Window;
use crate::scene::Scene;
use crate::shade::Effects;
use crate::visibility::{Counting, VisibilityBuffer};
use std::time::Instant;

/// Rows of a band for each thread, and the number that all bands' rows are a multiple of: two rows of
/// every path's tiles, which are what threads share, and four of a file's blocks.
///
/// What is held of a pixel is about 190 bytes (64 of visibility, 32 of colour, 4 per plane): 46 MB of
/// 128 rows of 1920, memory that the next band finds warm. Written to fresh memory, a whole frame of
/// 1920 × 1080 costs 0.13 s in page faults alone.
const BAND_ROWS: u32 = 64;

/// Pixels of a rasterizer's band for each triangle of the scene, at least. A triangle outside the band
/// costs about 12 ns, the 190 bytes of a pixel 60 ns where they are written for the first time.
const PIXELS_PER_TRIANGLE: usize = 4;

/// A frame that is ready to be made.
pub(super) struct Ready<'a> {
    scene: &'a Scene,
    options: &'a RenderOptions,
    window: Window,
    answerer: Answerer,
    /// A tree for shadows, where the path has none.
    occluders: Occluders,
    effects: Effects,
    pub(super) account: Account,
}

impl<'a> Ready<'a> {
    pub(super) fn new(
        scene: &'a Scene,
        options: &'a RenderOptions,
        progress: &dyn Progress,
    ) -> Self {
        let window = options.window.unwrap_or(scene.camera.resolution().window());
        let effects = Effects::of(scene);
        let mut account = Account::default();
        let started = Instant::now();
        let tree = |account: &mut Account| {
            progress.begin("build", 1);
            let made = cached_tree(&scene.mesh, options.preset, options.bvh_cache.as_deref());
            progress.step();
            account.tree_source = Some(made.source);
            account.tree_remark = made.remark;
            made.accelerator
        };
        let answerer = match options.accuracy {
            Accuracy::Exact => match options.path {
                VisibilityPath::Cast => Answerer::Cast(tree(&mut account)),
                VisibilityPath::Raster => Answerer::Raster,
            },
            Accuracy::Cast(unproven) => Answerer::CastUnproven(tree(&mut account), unproven),
            Accuracy::Raster(unproven) => Answerer::RasterUnproven(unproven),
        };
        let occluders = occluders(&answerer, effects, || tree(&mut account));
        account.times.build = started.elapsed();
        account.mesh_bytes = scene.mesh.bytes();
        let tree = answerer.tree().or(occluders.of(&answerer));
        account.tree_bytes = tree.map(Accelerator::bytes);
        let started = Instant::now();
        account.description = describe(scene, options.accuracy).to_string();
        account.times.describing = started.elapsed();
        Self { scene, options, window, answerer, occluders, effects, account }
    }

    /// The bands of the window; a list of visible triangles needs the whole window, and what is
    /// believed without proof may depend on where it is cut, which threads must not show. The
    /// rasterizer looks at every triangle in every band.
    fn bands(&self) -> Vec<Window> {
        if self.options.listing.is_some() || self.options.accuracy != Accuracy::Exact {
            return vec![self.window];
        }
        let least = match self.answerer.tree() {
            Some(_) => 1,
            None => PIXELS_PER_TRIANGLE * self.scene.mesh.len(),
        };
        let least = least.div_ceil(self.window.width() as usize);
        let rows = least.max(BAND_ROWS as usize * rayon::current_num_threads());
        let rows =
            u32::try_from(rows).ok().and_then(|rows| rows.checked_next_multiple_of(BAND_ROWS));
        let rows = rows.unwrap_or(u32::MAX);
        super::subsamples::bands(self.scene, self.window, rows)
    }

    /// Makes the film of a band, and says what was visible.
    pub(super) fn make(
        &mut self,
        band: Window,
        progress: &dyn Progress,
    ) -> (Film, VisibilityBuffer) {
        let Self { scene, answerer, effects, .. } = self;
        let counting = match self.options.planes.has(PlaneGroup::Cover) {
            true => Counting::All,
            false => Counting::Nearest,
        };
        let started = Instant::now();
        let buffer = answerer.see(scene, band, counting, progress);
        let seen = Instant::now();
        let layers = answerer.see_through(scene, &buffer, progress);
        let occluders = self.occluders.of(answerer);
        let exposure =
            expose_with(scene, answerer, occluders, (&buffer, &layers), *effects, progress);
        let exposed = Instant::now();
        let film = develop_described(
            scene,
            &buffer,
            &exposure.radiance,
            &exposure.alpha,
            &self.options.planes,
            self.account.description.clone(),
        );
        let account = &mut self.account;
        account.times.developing += exposed.elapsed();
        account.times.shading += exposed - seen;
        account.times.visibility += seen - started;
        account.covered_pixels += buffer.covered_pixels();
        account.levels.add(buffer.levels);
        account.notes.add(exposure.notes);
        (film, buffer)
    }

    /// The whole window at once.
    pub(super) fn whole(mut self, progress: &dyn Progress) -> (Film, Account) {
        let (film, buffer) = self.make(self.window, progress);
        self.list(&buffer, progress);
        (film, self.account)
    }

    /// Band by band, from the top.
    pub(super) fn in_bands<E>(
        mut self,
        progress: &dyn Progress,
        mut each: impl FnMut(Film) -> Result<(), E>,
    ) -> Result<Account, E> {
        let bands = self.bands();
        if let [whole] = bands[..] {
            let (film, buffer) = self.make(whole, progress);
            self.list(&buffer, progress);
            each(film)?;
            return Ok(self.account);
        }
        progress.begin("render", bands.len());
        for band in bands {
            let (film, _) = self.make(band, &Unwatched);
            each(film)?;
            progress.step();
        }
        Ok(self.account)
    }

    /// Lists the visible triangles, if they are asked for.
    fn list(&mut self, buffer: &VisibilityBuffer, progress: &dyn Progress) {
        let Some(listing) = self.options.listing else { return };
        // What lies between the pixel centres is looked for exactly, however the frame was made.
        let exact = match &self.answerer {
            Answerer::CastUnproven(..) | Answerer::RasterUnproven(_) => &Answerer::Raster,
            exact => exact,
        };
        let started = Instant::now();
        self.account.visible = Some(list_visible(self.scene, buffer, listing, exact, progress));
        self.account.times.listing = started.elapsed();
    }
}
