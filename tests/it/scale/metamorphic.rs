//! H80–H89: changes of the scene or of the way of asking that must not change the answer, or must
//! change it in a known way. No reference answer is needed.

mod exchange;
mod facing;
mod motion;
mod order;
mod presence;
mod settings;
mod subdivision;

use super::triangles_of;
use crate::support::closed::integer_chaos;
use crate::support::golden;
use crate::support::scenes::{Triangle, fan};
use truecast::visibility::{Facing, Visible};

/// Scenes full of ties, in front of G(8) with the eye at the origin: name and triangles.
pub(super) fn scenes_with_ties() -> Vec<(String, Vec<Triangle>)> {
    let mut scenes: Vec<(String, Vec<Triangle>)> =
        ["grid_exact", "interpenetrating_2^-20", "box_inside", "tiny_in_front_of_huge"]
            .map(|name| (name.to_owned(), triangles_of(&golden::scene(name).scene)))
            .to_vec();
    scenes.push(("needles".to_owned(), fan(64)));
    for seed in 0..8 {
        let away = integer_chaos(seed).iter().map(|t| t.map(|[x, y, z]| [x, y, z + 5.0])).collect();
        scenes.push((format!("chaos {seed}"), away));
    }
    scenes
}

/// A visible triangle without its number.
fn place(visible: &Visible) -> ([u64; 2], bool) {
    ([visible.t_lo.to_bits(), visible.t_hi.to_bits()], visible.tie)
}

/// Everything about a visible triangle that does not depend on the triangles behind it.
fn same_place(visible: &Visible) -> (u32, ([u64; 2], Facing)) {
    let t = [visible.t_lo.to_bits(), visible.t_hi.to_bits()];
    (visible.triangle.get(), (t, visible.facing))
}
