//! The arbiter against answers that were known beforehand: golden scenes of another program, and
//! hard cases whose answer is counted by hand. Nothing here compares it with a visibility path.

mod closed_meshes;
mod hard_cases;
mod shortcut;

use crate::support::golden;
use truecast::exact::{Answer, Arbiter};
use truecast::pixel::Pixel;
use truecast::scene::Scene;
use truecast::visibility::Facing;

/// The answer at every pixel, row by row.
fn answers(scene: &Scene) -> Vec<Answer> {
    let arbiter = Arbiter::new(scene);
    scene.camera.resolution().window().pixels().map(|pixel| arbiter.answer(pixel)).collect()
}

/// The visible ids, row by row.
fn ids(answers: &[Answer]) -> Vec<Option<u32>> {
    answers.iter().map(|answer| answer.visible.map(|surface| surface.triangle.get())).collect()
}

fn covered(answers: &[Answer]) -> usize {
    answers.iter().filter(|answer| answer.visible.is_some()).count()
}

#[test]
fn every_pixel_of_the_golden_scenes_agrees() {
    let scenes = golden::scenes();
    assert_eq!(scenes.len(), 26);
    for golden in scenes {
        let answers = answers(&golden.scene);
        assert_eq!(ids(&answers), golden.ids, "ids of {}", golden.name);
        for (index, answer) in answers.iter().enumerate() {
            let expected = (golden.cover[index], golden.signed[index]);
            let name = &golden.name;
            assert_eq!((answer.cover.crossed, answer.cover.signed), expected, "{name} at {index}");
            // Where one triangle covers, the signed count is its sgn V.
            if let (Some(surface), 1) = (answer.visible, answer.cover.crossed) {
                let facing = if golden.signed[index] == 1 { Facing::Back } else { Facing::Front };
                assert_eq!(surface.facing, facing, "{name} at {index}");
            }
        }
    }
}

#[test]
fn surfaces_are_consistent_in_themselves() {
    for golden in golden::scenes() {
        for surface in answers(&golden.scene).into_iter().filter_map(|answer| answer.visible) {
            let name = &golden.name;
            assert!(surface.t_lo > 0.0 && surface.t_hi.is_finite(), "{name}");
            assert!(surface.t_hi == surface.t_lo || surface.t_hi == surface.t_lo.next_up());
            // Three weights rounded once each and two additions: at most 5 half steps of 1.
            let sum: f64 = surface.barycentric.0.iter().sum();
            assert!((sum - 1.0).abs() <= 5.0 * f64::EPSILON / 2.0, "{name}: {sum}");
            assert!(surface.barycentric.0.iter().all(|weight| (0.0..=1.0).contains(weight)));
        }
    }
}

#[test]
fn candidates_begin_with_the_answer() {
    for golden in golden::scenes() {
        let arbiter = Arbiter::new(&golden.scene);
        for pixel in golden.scene.camera.resolution().window().pixels() {
            let answer = arbiter.answer(pixel);
            let candidates = arbiter.candidates(pixel);
            let covering: Vec<_> = candidates.iter().filter(|c| c.covers).collect();
            assert_eq!(covering.len(), answer.cover.crossed as usize, "{}", golden.name);
            assert_eq!(covering.first().map(|c| c.triangle), answer.visible.map(|s| s.triangle));
            for pair in candidates.windows(2) {
                assert!(pair[0].t_lo <= pair[1].t_lo && pair[0].t_hi <= pair[1].t_hi);
            }
        }
    }
}

#[test]
fn candidates_show_both_sides_of_an_edge() {
    // The diagonal of topleft_both runs through pixel centres; the lower triangle owns it.
    let golden = golden::scene("topleft_both");
    let candidates = Arbiter::new(&golden.scene).candidates(Pixel { x: 8, y: 8 });
    let found: Vec<_> = candidates
        .iter()
        .map(|c| (c.triangle.get(), c.covers, c.edge_signs, c.moved_signs, c.t_lo, c.t_hi))
        .collect();
    assert_eq!(
        found,
        [(0, false, [0, 1, 1], [-1, 1, 1], 1.0, 1.0), (1, true, [1, 0, 1], [1, 1, 1], 1.0, 1.0),]
    );
}
