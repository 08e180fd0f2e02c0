//! Where a hair's breadth does not change the answer: pixels on which another program that rounds
//! its camera or its samples may be held to the id without excuse.

use crate::accel::Accelerator;
use crate::cast::cast;
use crate::scene::Scene;
use crate::visibility::{Counting, VisibilityBuffer, Visible};

/// How far samples are moved, in 1/256 pixel.
const STEP: i32 = 1;

/// How often the window is answered.
pub(super) const PASSES: usize = 8;

/// Whether each pixel of `answer` shows the same triangle, or nothing, at its sample and at the
/// eight points around it that are 1/256 pixel away along x, y or both.
///
/// Each of the nine answers is exact, but they are nine: a sliver or a corner that lies wholly
/// between the points is not seen. So 0 is certain, and 1 means "at these nine points". `done` is
/// called [`PASSES`] times per tile of the caster.
pub(super) fn stability_of(
    scene: &Scene,
    accelerator: &Accelerator,
    answer: &VisibilityBuffer,
    done: &(dyn Fn() + Sync),
) -> Vec<bool> {
    let mut stable = vec![true; answer.window.len()];
    let mut shifted = scene.clone();
    for b in [-STEP, 0, STEP] {
        for a in [-STEP, 0, STEP] {
            if [a, b] == [0, 0] {
                continue;
            }
            shifted.camera = scene.camera.shifted([a, b]);
            let moved = cast(&shifted, accelerator, answer.window, Counting::Nearest, done);
            for (stable, (here, there)) in
                stable.iter_mut().zip(answer.visible.iter().zip(&moved.visible))
            {
                *stable &= id(here) == id(there);
            }
        }
    }
    stable
}

fn id(visible: &Option<Visible>) -> Option<u32> {
    visible.as_ref().map(|visible| visible.triangle.get())
}
