//! Which triangles are visible, how much of them, and which ones pixel centres miss.
//!
//! A triangle that no pixel centre sees is not always hidden: it may lie between the centres. A
//! finer grid of sub-samples finds more of them, each by a camera that is shifted on its lattice,
//! so every sub-sample is as exact as a centre. What a grid finds is a lower bound: a sliver may
//! lie between sub-samples too. No radiance is computed from sub-samples.

use super::subsamples::for_each_subsample;
use super::{Answerer, Progress};
use crate::mesh::TriangleId;
use crate::pixel::{Pixel, Window};
use crate::scene::Scene;
use crate::scene::sampling::SampleGrid;
use crate::visibility::VisibilityBuffer;
use std::borrow::Cow;
use std::collections::HashMap;
use std::fmt::Write;

/// Column names of [`to_csv`]. `mesh` is the position of the mesh in the scene file, `source` is
/// `file.obj:line`. `subsamples` is empty when none were taken.
const HEADER: &str = "id,mesh,source,pixels,subsamples,first_x,first_y\n";

/// How finely visible triangles are looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Listing {
    /// At pixel centres, as the picture is made.
    Centres,
    /// At pixel centres and at a grid of sub-samples in every pixel.
    Subsamples(SubsampleGrid),
}

/// A regular grid of `N` × `N` sub-samples in a pixel, N = 2, 4, 8 or 16: the points
/// ((m + ½)/N, (n + ½)/N). They are multiples of 1/256 pixel, as exact samples must be, and none
/// is the pixel's centre.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SubsampleGrid(SampleGrid);

impl SubsampleGrid {
    /// The grid of `side` × `side`; `None` unless `side` is 2, 4, 8 or 16.
    pub const fn new(side: u32) -> Option<Self> {
        match SampleGrid::new(side) {
            Some(grid) if side > 1 && side.is_power_of_two() => Some(Self(grid)),
            _ => None,
        }
    }

    /// N.
    pub const fn side(self) -> u32 {
        self.0.side()
    }

    /// Where the sub-samples lie, from the pixel's centre, in 1/256 pixel.
    pub fn offsets(self) -> impl Iterator<Item = [i32; 2]> {
        self.0.offsets()
    }
}

/// A triangle that some sample sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VisibleTriangle {
    /// Which.
    pub triangle: TriangleId,
    /// Number of pixels whose centre sees it.
    pub pixels: u64,
    /// Number of sub-samples that see it; `None` when none were taken.
    pub subsamples: Option<u64>,
    /// First pixel by rows whose centre sees it; where none does, with a sub-sample that sees it.
    pub first: Pixel,
}

/// Lists the triangles that `buffer`, the answer of a path for some window, and the sub-samples of
/// the same window see, by id.
pub fn list_visible(
    scene: &Scene,
    buffer: &VisibilityBuffer,
    listing: Listing,
    answerer: &Answerer,
    progress: &dyn Progress,
) -> Vec<VisibleTriangle> {
    let window = buffer.window;
    let mut centres = Tally::default();
    centres.add(buffer, window);
    let mut subsamples = Tally::default();
    if let Listing::Subsamples(grid) = listing {
        let stage = ("subpixel", progress);
        for_each_subsample(scene, answerer, window, grid.offsets(), stage, |_, answer| {
            subsamples.add(answer, window);
        });
    }
    let mut triangles: Vec<TriangleId> =
        centres.seen.keys().chain(subsamples.seen.keys()).copied().collect();
    triangles.sort_unstable();
    triangles.dedup();
    let taken = listing != Listing::Centres;
    triangles
        .into_iter()
        .map(|triangle| {
            let centre = centres.of(triangle);
            let between = subsamples.of(triangle);
            let first = if centre.samples > 0 { centre.first } else { between.first };
            VisibleTriangle {
                triangle,
                pixels: centre.samples,
                subsamples: taken.then_some(between.samples),
                first: window.pixel(first),
            }
        })
        .collect()
}

/// How often a triangle was seen, and the lowest position in the window where it was.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    samples: u64,
    first: usize,
}

/// Seen triangles. A map, for a scene may hold far more triangles than a picture shows.
#[derive(Debug, Default)]
struct Tally {
    seen: HashMap<TriangleId, Seen>,
}

impl Tally {
    /// Adds the answer for a part of `window`.
    fn add(&mut self, answer: &VisibilityBuffer, window: Window) {
        // Neighbours mostly see the same triangle: one look-up per run of equals.
        let same = |a: &Option<_>, b: &Option<_>| id(a) == id(b);
        let mut start = 0;
        for run in answer.visible.chunk_by(same) {
            if let Some(triangle) = id(&run[0]) {
                let first = window.index(answer.window.pixel(start));
                let seen = self.seen.entry(triangle).or_insert(Seen { samples: 0, first });
                seen.samples += run.len() as u64;
                seen.first = seen.first.min(first);
            }
            start += run.len();
        }
    }

    fn of(&self, triangle: TriangleId) -> Seen {
        self.seen.get(&triangle).copied().unwrap_or_default()
    }
}

fn id(visible: &Option<crate::visibility::Visible>) -> Option<TriangleId> {
    visible.as_ref().map(|visible| visible.triangle)
}

/// The list as CSV: a header and one line per triangle, by id.
pub fn to_csv(scene: &Scene, list: &[VisibleTriangle]) -> String {
    let mut text = String::from(HEADER);
    for seen in list {
        let (mesh, _) = scene.object_of(seen.triangle);
        let source = scene.describe_source(seen.triangle);
        let subsamples = seen.subsamples.map_or_else(String::new, |count| count.to_string());
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{},{mesh},{},{},{subsamples},{},{}",
            seen.triangle.get(),
            csv_field(&source),
            seen.pixels,
            seen.first.x,
            seen.first.y,
        );
    }
    text
}

/// Text as one field of CSV (RFC 4180): in quotes, with its own doubled, where it needs them.
pub fn csv_field(text: &str) -> Cow<'_, str> {
    if text.contains([',', '"', '\n', '\r']) {
        Cow::Owned(format!("\"{}\"", text.replace('"', "\"\"")))
    } else {
        Cow::Borrowed(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_is_regular_and_on_the_lattice() {
        for side in [2, 4, 8, 16] {
            let offsets: Vec<_> = SubsampleGrid::new(side).unwrap().offsets().collect();
            assert_eq!(offsets.len(), (side * side) as usize);
            let step = 256 / side as i32;
            assert_eq!(offsets[0], [step / 2 - 128; 2]);
            assert_eq!(offsets[1], [step / 2 - 128 + step, step / 2 - 128]);
            assert_eq!(offsets[offsets.len() - 1], [128 - step / 2; 2]);
        }
        for side in [0, 1, 3, 5, 32] {
            assert!(SubsampleGrid::new(side).is_none());
        }
    }

    #[test]
    fn fields_are_quoted_where_they_must_be() {
        assert_eq!(csv_field("mesh/a.obj:3"), "mesh/a.obj:3");
        assert_eq!(csv_field("a, b.obj:3"), "\"a, b.obj:3\"");
        assert_eq!(csv_field("a\"b"), "\"a\"\"b\"");
    }
}
