//! Other people's ray casters beside ours: the same scene, the same pixels, the same turns.
//!
//! They get rays as they want them: f32 origin and f32 unit direction through each pixel's centre,
//! computed in f64 and rounded once, read from memory; and memory that is already there to write id
//! and t into, by tiles of the side of ours, on the same threads. Both favour them a little. Their
//! ids are held against the exact answer as ours are, but their times are shown all the same, with
//! the number of wrong pixels beside them. Not all of these are their makers' errors: a rounded ray
//! is another ray, so a pixel whose centre lies within rounding of an edge may rightly differ.
//!
//! Nothing of it is in a standard build: see the features `peers` and `embree`.

#[cfg(feature = "peers")]
mod bvh;
#[cfg(feature = "embree")]
mod embree;
#[cfg(feature = "embree")]
mod embree_sys;
mod hits;
#[cfg(feature = "peers")]
mod obvhs;
#[cfg(feature = "peers")]
mod parry;
#[cfg(any(feature = "peers", feature = "embree"))]
mod rays;
#[cfg_attr(not(feature = "embree"), expect(dead_code, reason = "Embree's alone"))]
mod shadow_rays;

pub use hits::Hits;
pub use shadow_rays::ShadowRays;

use super::workload::Variant;
use crate::pixel::Window;
use crate::scene::Scene;
use crate::simd::SimdLevel;
use std::marker::PhantomData;
use std::path::PathBuf;

/// Which peers are asked for.
pub struct PeerOptions<'o> {
    /// The shared library of Embree; without it, whichever version the system finds.
    pub embree: Option<PathBuf>,
    /// The instruction set that Embree is held to; without it, it chooses for itself.
    pub simd: Option<SimdLevel>,
    /// Whether a variant of this name is asked for: a peer is built if any of its variants is.
    pub admits: &'o dyn Fn(&str) -> bool,
}

/// Why a peer cannot be measured.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PeerError {
    /// The library that was named cannot be used.
    #[error("{path}: cannot be used as Embree: {reason}")]
    Embree {
        /// Where it was looked for.
        path: String,
        /// What the loader or the library says.
        reason: String,
    },
}

/// Peers that have built their structures over one scene.
#[derive(Default)]
pub struct Peers<'a> {
    #[cfg(any(feature = "peers", feature = "embree"))]
    rays: Option<rays::Rays>,
    #[cfg(feature = "peers")]
    trees: (Option<obvhs::Trees>, Option<bvh::Tree>, Option<parry::Tree>),
    #[cfg(feature = "embree")]
    embree: Option<embree::Scenes<'a>>,
    /// Peers that were left out, with the reason, in words.
    pub left_out: Vec<String>,
    scene: PhantomData<&'a Scene>,
}

impl<'a> Peers<'a> {
    /// Builds the structures of all that this program was compiled with, on the threads of the pool
    /// it is called from. That Embree is not installed is noted in [`Self::left_out`].
    ///
    /// # Errors
    /// When a library that was asked for by its path cannot be used.
    pub fn new(
        scene: &'a Scene,
        window: Window,
        options: &PeerOptions<'_>,
    ) -> Result<Self, PeerError> {
        // Which of these is used is up to the features.
        let _ = (scene, window, options);
        #[cfg(feature = "embree")]
        let names = embree::NAMES.into_iter().chain(embree::SHADOW_NAMES);
        #[cfg(feature = "embree")]
        let asked = { names }.any(options.admits);
        #[cfg(feature = "embree")]
        let (embree, left_out) = match asked.then(|| embree::Scenes::new(&scene.mesh, options)) {
            None => (None, Vec::new()),
            Some(Ok(scenes)) => (Some(scenes), Vec::new()),
            Some(Err(PeerError::Embree { reason, .. })) if options.embree.is_none() => {
                (None, vec![format!("Embree is not measured: {reason}")])
            }
            Some(Err(error)) => return Err(error),
        };
        #[cfg(not(feature = "embree"))]
        let left_out = Vec::new();
        Ok(Self {
            #[cfg(any(feature = "peers", feature = "embree"))]
            rays: Some(rays::Rays::new(&scene.camera, window)),
            #[cfg(feature = "peers")]
            trees: (
                obvhs::NAMES
                    .into_iter()
                    .any(options.admits)
                    .then(|| obvhs::Trees::new(&scene.mesh)),
                (options.admits)(bvh::NAME).then(|| bvh::Tree::new(&scene.mesh)),
                (options.admits)(parry::NAME).then(|| parry::Tree::new(&scene.mesh)),
            ),
            #[cfg(feature = "embree")]
            embree,
            left_out,
            scene: PhantomData,
        })
    }

    /// Closest hits by every peer, shadow rays by those that have them, and the builds of their
    /// structures.
    pub fn variants<'b>(&'b self, shadows: Option<&'b ShadowRays>) -> Vec<Variant<'b>> {
        let _ = shadows;
        #[cfg_attr(
            not(any(feature = "peers", feature = "embree")),
            expect(unused_mut, reason = "none here")
        )]
        let mut variants = Vec::new();
        #[cfg(feature = "peers")]
        if let Some(rays) = &self.rays {
            let (obvhs, bvh, parry) = &self.trees;
            variants.extend(obvhs.iter().flat_map(|trees| trees.variants(rays)));
            variants.extend(bvh.iter().map(|tree| tree.variant(rays)));
            variants.extend(parry.iter().map(|tree| tree.variant(rays)));
        }
        #[cfg(feature = "embree")]
        if let (Some(rays), Some(embree)) = (&self.rays, &self.embree) {
            variants.extend(embree.variants(rays, shadows));
        }
        variants
    }
}
