//! Embree in the ways that its users cast primary rays: one by one, and in coherent packets, each
//! with and without the robust flag.
//!
//! Packets are 16 rays of 4 × 4 pixels, or 8 of 4 × 2 where the instruction set has no 16 lanes:
//! Embree would trace packets of 16 one ray at a time there. Trees are of medium quality, its
//! default. Shadow rays go one by one. Denormals are left as they are: no mesh worth timing has any.

use super::embree_sys::{Call, Embree, Lanes, Packet, Tree};
use super::rays::Rays;
use super::shadow_rays::ShadowRays;
use super::{Hits, PeerError, PeerOptions};
use crate::bench::workload::{Answer, Variant, Work};
use crate::mesh::TriangleMesh;
use crate::pixel::{Pixel, for_each_row};
use crate::simd::SimdLevel;
use std::ffi::OsStr;
use std::hint::black_box;

/// Under which names a system may know the library, the newest first.
const LIBRARIES: [&str; 6] = [
    "libembree4.so.4",
    "libembree4.so",
    "libembree4.dylib",
    "libembree3.so.3",
    "libembree3.so",
    "libembree3.dylib",
];

/// Columns of the block of pixels that a packet of either width covers.
const BLOCK_WIDTH: u32 = 4;

/// The names of its variants of rays.
pub(super) const NAMES: [&str; 6] = [
    "Embree single",
    "Embree 8 coherent",
    "Embree 16 coherent",
    "Embree single, robust",
    "Embree 8 coherent, robust",
    "Embree 16 coherent, robust",
];

/// The names of its variants of shadow rays.
pub(super) const SHADOW_NAMES: [&str; 2] = ["shadow Embree", "shadow Embree, robust"];

/// One mesh, built with and without the robust flag.
pub(super) struct Scenes<'a> {
    embree: Embree,
    mesh: &'a TriangleMesh,
    configuration: String,
    fast: Tree,
    robust: Tree,
}

impl<'a> Scenes<'a> {
    /// Loads the library and builds both trees on the threads of the pool this is called from.
    pub(super) fn new(
        mesh: &'a TriangleMesh,
        options: &PeerOptions<'_>,
    ) -> Result<Self, PeerError> {
        let named = options.embree.as_ref().map(|path| path.display().to_string());
        let failed = |reason| PeerError::Embree {
            path: named.clone().unwrap_or_else(|| LIBRARIES[0].to_owned()),
            reason,
        };
        let embree = match &options.embree {
            Some(path) => Embree::load(path.as_os_str()).map_err(failed)?,
            None => LIBRARIES
                .iter()
                .find_map(|name| Embree::load(OsStr::new(name)).ok())
                .ok_or_else(|| failed("none of its libraries is installed".to_owned()))?,
        };
        let mut configuration = format!("threads={}", rayon::current_num_threads());
        if let Some(level) = options.simd {
            configuration += match level {
                SimdLevel::Baseline => ",isa=sse2",
                SimdLevel::Sse42 => ",isa=sse4.2",
                SimdLevel::Avx2 => ",isa=avx2",
                SimdLevel::Avx512 => ",isa=avx512",
            };
        }
        let build = |is_robust| {
            embree
                .build(&configuration, (&mesh.positions, &mesh.corners), is_robust)
                .map_err(failed)
        };
        let (fast, robust) = (build(false)?, build(true)?);
        Ok(Self { embree, mesh, configuration, fast, robust })
    }

    /// The build, and both trees by single rays, by packets and by shadow rays.
    pub(super) fn variants<'b>(
        &'b self,
        rays: &'b Rays,
        shadows: Option<&'b ShadowRays>,
    ) -> Vec<Variant<'b>> {
        let [major, minor, patch] = self.embree.version;
        let program = format!("Embree {major}.{minor}.{patch}");
        let mut variants = Vec::new();
        let build = || {
            let data = (&self.mesh.positions[..], &self.mesh.corners[..]);
            // It has been built before with the same arguments; a failure would show as no time.
            drop(black_box(self.embree.build(&self.configuration, data, false)));
            Answer::Unchecked
        };
        variants.push(Variant::new("build Embree", Work::Build, self.mesh.len(), build));
        for (tree, names) in [(&self.fast, &NAMES[..3]), (&self.robust, &NAMES[3..])] {
            let hits = rays.hits();
            variants.push(Variant::new(names[0], Work::Closest, rays.len(), move || {
                cast_singles(tree, rays, &hits);
                Answer::Hits(hits.clone())
            }));
            let hits = rays.hits();
            let has_16 = tree.has_16_lanes();
            variants.push(Variant::new(
                names[if has_16 { 2 } else { 1 }],
                Work::Closest,
                rays.len(),
                move || {
                    match has_16 {
                        true => cast_packets::<16>(tree, rays, &hits),
                        false => cast_packets::<8>(tree, rays, &hits),
                    }
                    Answer::Hits(hits.clone())
                },
            ));
        }
        for (tree, name) in [&self.fast, &self.robust].into_iter().zip(SHADOW_NAMES) {
            variants.extend(shadows.map(|shadows| {
                let cast = move || Answer::Shadowed(cast_shadows(tree, shadows));
                Variant::new(name, Work::Any, shadows.len(), cast)
            }));
        }
        variants.into_iter().map(|variant| variant.of(&program)).collect()
    }
}

fn cast_singles(tree: &Tree, rays: &Rays, hits: &Hits) {
    rays.for_each_tile(|tile| {
        let mut call = Call::coherent();
        let mut packet = Packet::<1>::from(rays.origin);
        for pixel in tile.pixels() {
            let (index, direction) = rays.at(pixel);
            packet.aim(0, direction);
            tree.closest(&mut call, &Lanes([-1]), &mut packet);
            hits.store(index, packet.triangle[0], packet.far[0]);
        }
    });
}

/// Row by row, as ours are.
fn cast_shadows(tree: &Tree, shadows: &ShadowRays) -> Vec<bool> {
    let width = shadows.window.width() as usize;
    let mut occluded = vec![false; shadows.rays.len()];
    for_each_row(&mut occluded, width, &|| (), |row, pixels| {
        let mut call = Call::coherent();
        let mut ray = Packet::<1>::from([0.0; 3]);
        for (occluded, own) in pixels.iter_mut().zip(&shadows.rays[row * width..]) {
            if let Some(own) = own {
                ray.reach(own.origin, own.direction, [own.near, own.far]);
                *occluded = tree.is_occluded(&mut call, &mut ray);
            }
        }
    });
    occluded
}

fn cast_packets<const N: usize>(tree: &Tree, rays: &Rays, hits: &Hits) {
    let height = N as u32 / BLOCK_WIDTH;
    rays.for_each_tile(|tile| {
        let mut call = Call::coherent();
        let mut packet = Packet::<N>::from(rays.origin);
        for y in (tile.y0()..tile.y1()).step_by(height as usize) {
            for x in (tile.x0()..tile.x1()).step_by(BLOCK_WIDTH as usize) {
                let mut lanes = Lanes([0; N]);
                let mut places = [0; N];
                for (lane, place) in places.iter_mut().enumerate() {
                    let (column, row) = (lane as u32 % BLOCK_WIDTH, lane as u32 / BLOCK_WIDTH);
                    let pixel = Pixel { x: x + column, y: y + row };
                    if tile.contains(pixel) {
                        let (index, direction) = rays.at(pixel);
                        packet.aim(lane, direction);
                        (lanes.0[lane], *place) = (-1, index);
                    }
                }
                tree.closest(&mut call, &lanes, &mut packet);
                for lane in (0..N).filter(|&lane| lanes.0[lane] != 0) {
                    hits.store(places[lane], packet.triangle[lane], packet.far[lane]);
                }
            }
        }
    });
}
