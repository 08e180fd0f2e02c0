//! Counters: what kernels do for a frame, in numbers that no busy machine changes.
//!
//! Counted outside the timed runs, by instances that count, and on the lowest instruction set.

use super::kernels::Kernels;
use super::workload::Work;
use crate::cast::count_walk;
use crate::pixel::Window;
use crate::raster::count_raster;
use crate::scene::Scene;

/// What a kernel does for a whole frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Counters {
    /// The row that it is the work of.
    pub name: String,
    /// What is counted, and how many.
    pub counts: Vec<(&'static str, u64)>,
}

/// Counts the casters of all trees and the rasterizer, as far as their rows are wanted.
pub fn counters(
    kernels: &Kernels,
    scene: &Scene,
    window: Window,
    admits: &dyn Fn(&str, Work) -> bool,
) -> Vec<Counters> {
    let mut all = Vec::new();
    for (preset, tree) in kernels.trees_by_preset() {
        let name = format!("cast {preset}");
        if let Some(counts) =
            admits(&name, Work::Closest).then(|| count_walk(scene, tree, window)).flatten()
        {
            let counts = vec![
                ("nodes", counts.nodes),
                ("boxes", counts.boxes),
                ("leaves", counts.leaves),
                ("leaf triangles", counts.leaf_triangles),
                ("set up", counts.set_up),
                ("samples", counts.levels.single),
                ("f64", counts.levels.double),
                ("exact", counts.levels.exact),
            ];
            all.push(Counters { name, counts });
        }
    }
    if admits("raster", Work::Raster) {
        let counts = count_raster(scene, window);
        let counts = vec![
            ("listed", counts.listed),
            ("drawn", counts.drawn),
            ("samples", counts.levels.single),
            ("f64", counts.levels.double),
            ("exact", counts.levels.exact),
        ];
        all.push(Counters { name: "raster".to_owned(), counts });
    }
    all
}
