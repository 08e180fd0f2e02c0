//! A frame in bands of rows, each made by one thread: piece by piece it is seen, shaded and laid out
//! while it lies in the thread's cache, in memory that the piece before left, so that a whole frame of
//! visible triangles, radiances and planes is never held.
//!
//! What the bands share is made once: tree, sorted triangles, occluders, description. No bit of the
//! film depends on where bands end. A thread without a band takes part in those of others.

use super::answerer::has_see_through;
use super::describe;
use super::develop::{blank, develop_into, turn_to};
use super::expose::{Exposure, Occluders, expose_into, occluders};
use super::eye::Eye;
use super::in_order::InOrder;
use super::visible::list_visible;
use super::{
    Account, Accuracy, Answerer, PlaneGroup, Progress, RenderOptions, Unwatched, VisibilityPath,
    cached_tree,
};
use crate::accel::Accelerator;
use crate::film::Film;
use crate::pixel::Window;
use crate::scene::Scene;
use crate::shade::{Effects, Precision, ShadeOptions};
use crate::visibility::{Counting, VisibilityBuffer};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

/// The number that all bands' rows are a multiple of: a row of every path's tiles, and two of a
/// file's blocks.
const BAND_ROWS: u32 = 32;

/// Columns of a piece: eight of every path's tiles. Of its 8192 pixels 0.6 MB are held beside the planes
/// (48 bytes of visibility each, 32 of colour), which stay in a second-level cache. They are read six
/// times.
const PIECE_COLUMNS: u32 = 256;

/// Pixels of a band for each triangle of the scene, at least, where every band looks at every triangle.
/// One outside the band costs about 12 ns, the 190 bytes of a pixel 60 ns where they are written for
/// the first time.
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
    account: Account,
}

/// Memory of one band, which the next takes over.
struct Room {
    buffer: VisibilityBuffer,
    exposure: Exposure,
    film: Film,
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
        let tree = |account: &mut Account| {
            progress.begin("build", 1);
            let made = cached_tree(&scene.mesh, options.preset, options.bvh_cache.as_deref());
            progress.step();
            account.tree_source = Some(made.source);
            account.tree_remark = made.remark;
            made.accelerator
        };
        let mut build = || {
            let started = Instant::now();
            let answerer = match options.accuracy {
                Accuracy::Exact => match options.path {
                    VisibilityPath::Cast => Answerer::Cast(tree(&mut account)),
                    VisibilityPath::Raster => Answerer::Raster,
                },
                Accuracy::Cast(unproven) => Answerer::CastUnproven(tree(&mut account), unproven),
                Accuracy::Raster(unproven) => Answerer::RasterUnproven(unproven),
            };
            let occluders = occluders(&answerer, effects, || tree(&mut account));
            (answerer, occluders, started.elapsed())
        };
        let (answerer, occluders, building) = build();
        account.times.build = building;
        account.mesh_bytes = scene.mesh.bytes();
        let tree = answerer.tree().or(occluders.of(&answerer));
        account.tree_bytes = tree.map(Accelerator::bytes);
        Self { scene, options, window, answerer, occluders, effects, account }
    }

    /// The bands of the window, each cut into pieces; a list of visible triangles needs the whole
    /// window, and what is believed without proof may depend on where it is cut, which threads must
    /// not show.
    fn bands(&self) -> Vec<Vec<Window>> {
        if self.options.listing.is_some() || self.options.accuracy != Accuracy::Exact {
            return vec![vec![self.window]];
        }
        // The samples beside the centres are asked for anew, and so is what is stable.
        let looks_anew = !matches!(self.answerer, Answerer::Cast(_) | Answerer::Raster)
            || self.effects.has(Effects::SUPERSAMPLING)
            || self.options.planes.has(PlaneGroup::Stable);
        let least = match looks_anew {
            true => PIXELS_PER_TRIANGLE * self.scene.mesh.len(),
            false => 1,
        };
        let least = least.div_ceil(self.window.width() as usize);
        let rows = u32::try_from(least).ok();
        let rows = rows.and_then(|rows| rows.checked_next_multiple_of(BAND_ROWS));
        let bands =
            super::subsamples::bands(self.scene, self.window, rows.unwrap_or(u32::MAX)).into_iter();
        match looks_anew {
            true => bands.map(|band| vec![band]).collect(),
            false => bands.map(|band| band.columns(PIECE_COLUMNS)).collect(),
        }
    }

    fn eye(&self) -> Eye<'_> {
        let counting = match self.options.planes.has(PlaneGroup::Cover) {
            true => Counting::All,
            false => Counting::Nearest,
        };
        Eye::new(self.scene, &self.answerer, self.window, counting)
    }

    fn room(&self) -> Room {
        let Self { scene, options, window, .. } = self;
        Room {
            buffer: VisibilityBuffer::unseen(*window),
            exposure: Exposure::default(),
            film: blank(scene, &options.planes, options.accuracy.counts_cover(), String::new()),
        }
    }

    /// The description of the film, and the time that it took.
    fn describe(&self) -> (String, Duration) {
        let started = Instant::now();
        let mut description = describe(self.scene, self.options.accuracy);
        // Double is what a picture is unless it says otherwise.
        if self.options.shading == Precision::Single {
            description["shading"] = "single".into();
        }
        (description.to_string(), started.elapsed())
    }

    /// Makes the film of a band, and says what there is to be said of it.
    fn make(
        &self,
        eye: &Eye<'_>,
        pieces: &[Window],
        room: &mut Room,
        progress: &dyn Progress,
    ) -> Account {
        let mut account = Account::default();
        if let (Some(first), Some(last)) = (pieces.first(), pieces.last()) {
            turn_to(&mut room.film, first.joined(*last));
        }
        for &piece in pieces {
            account.add(&self.make_piece(eye, piece, room, progress), 1);
        }
        account
    }

    fn make_piece(
        &self,
        eye: &Eye<'_>,
        piece: Window,
        room: &mut Room,
        progress: &dyn Progress,
    ) -> Account {
        let Self { scene, answerer, effects, .. } = self;
        let Room { buffer, exposure, film } = room;
        let mut account = Account::default();
        let started = Instant::now();
        eye.see(piece, buffer, progress);
        let seen = Instant::now();
        let layers = match effects.has(Effects::OPACITY) && has_see_through(scene, buffer) {
            true => Some(answerer.see_through(scene, buffer, progress)),
            false => None,
        };
        let occluders = self.occluders.of(answerer);
        let asked = (&*buffer, layers.as_ref());
        let shading =
            ShadeOptions { precision: self.options.shading, ..ShadeOptions::new(*effects) };
        expose_into(scene, answerer, occluders, asked, &shading, exposure, progress);
        let exposed = Instant::now();
        develop_into(scene, buffer, exposure, &self.options.planes, film);
        account.covered_pixels = buffer.covered_pixels();
        account.levels = buffer.levels;
        account.notes = exposure.notes;
        account.times.developing = exposed.elapsed();
        account.times.shading = exposed - seen;
        account.times.visibility = seen - started;
        account
    }

    /// The whole window at once.
    pub(super) fn whole(mut self, progress: &dyn Progress) -> (Film, Account) {
        let mut room = self.room();
        let made = self.make(&self.eye(), &[self.window], &mut room, progress);
        self.account.add(&made, 1);
        (self.account.description, self.account.times.describing) = self.describe();
        room.film.description.clone_from(&self.account.description);
        self.list(&room.buffer, progress);
        (room.film, self.account)
    }

    /// Band by band: `work` on every band, side by side, and `take` what came of it, from the top.
    pub(super) fn in_bands<T: Send, E: Send>(
        mut self,
        progress: &dyn Progress,
        work: impl Fn(&Film) -> Result<T, E> + Sync,
        mut take: impl FnMut(T) -> Result<(), E> + Send,
    ) -> Result<Account, E> {
        let bands = self.bands();
        if bands.len() == 1 && bands[0].len() == 1 {
            let (film, account) = self.whole(progress);
            take(work(&film)?)?;
            return Ok(account);
        }
        progress.begin("render", bands.len());
        let eye = self.eye();
        // The first fault from the top, and whether any band has one.
        let mut fault = None;
        let has_fault = AtomicBool::new(false);
        let results = InOrder::new(|result: Result<T, E>| {
            if fault.is_none()
                && let Err(error) = result.and_then(&mut take)
            {
                has_fault.store(true, Ordering::Relaxed);
                fault = Some(error);
            }
        });
        let next = AtomicUsize::new(0);
        let threads = u32::try_from(rayon::current_num_threads()).unwrap_or(u32::MAX);
        let total = Mutex::new(Account::default());
        // One thread looks at the whole scene while the others begin.
        let description = OnceLock::new();
        rayon::broadcast(|thread| {
            if thread.index() == 0 {
                description.get_or_init(|| self.describe());
            }
            let mut room = self.room();
            loop {
                let number = next.fetch_add(1, Ordering::Relaxed);
                let Some(band) = bands.get(number) else { break };
                if has_fault.load(Ordering::Relaxed) {
                    break;
                }
                let made = self.make(&eye, band, &mut room, &Unwatched);
                let (description, _) = description.get_or_init(|| self.describe());
                room.film.description.clone_from(description);
                results.put(number, work(&room.film));
                let mut total = total.lock().unwrap_or_else(PoisonError::into_inner);
                total.add(&made, threads);
                progress.step();
            }
        });
        drop(results);
        drop(eye);
        if let Some(error) = fault {
            return Err(error);
        }
        self.account.add(&total.into_inner().unwrap_or_else(PoisonError::into_inner), 1);
        if let Some((description, time)) = description.into_inner() {
            self.account.description = description;
            self.account.times.describing = time / threads;
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
