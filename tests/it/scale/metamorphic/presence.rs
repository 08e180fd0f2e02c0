//! H87: one triangle more or less.

use super::{same_place, scenes_with_ties};
use crate::scale::ids;
use crate::support::configurations::{NARROW, agreed_within};
use crate::support::rays::Random;
use crate::support::scenes::standard_scene;

/// One more triangle brings nothing farther; one less brings nothing nearer; where the winner is
/// another, nothing changes.
#[test]
fn h87_one_more_one_less() {
    let mut random = Random(87);
    for (name, triangles) in scenes_with_ties() {
        let before = agreed_within(&standard_scene(&triangles), &NARROW, &name);
        for _ in 0..3 {
            // One more, with the highest id.
            let mut more = triangles.clone();
            more.push(
                [0; 3].map(|_| [random.integer(6), random.integer(6), 1.0 + random.integer(6)]),
            );
            let added = more.len() as u32 - 1;
            let after = agreed_within(&standard_scene(&more), &NARROW, &name);
            for (a, b) in before.visible.iter().zip(&after.visible) {
                match (a, b) {
                    (_, Some(b)) if b.triangle.get() == added => {
                        assert!(a.is_none_or(|a| b.t_lo <= a.t_hi), "{name}: {a:?} {b:?}");
                    }
                    (a, b) => assert_eq!(a.map(|a| same_place(&a)), b.map(|b| same_place(&b))),
                }
            }
            // One less: the winner of some pixel.
            let winners: Vec<u32> = ids(&before).into_iter().flatten().collect();
            let removed = winners[random.below(winners.len())];
            let mut less = triangles.clone();
            less.remove(removed as usize);
            let after = agreed_within(&standard_scene(&less), &NARROW, &name);
            for (a, b) in before.visible.iter().zip(&after.visible) {
                match (a, b) {
                    (Some(a), b) if a.triangle.get() == removed => {
                        assert!(b.is_none_or(|b| a.t_lo <= b.t_hi), "{name}: {a:?} {b:?}");
                    }
                    (a, b) => {
                        let renumbered = b.map(|b| {
                            let (id, rest) = same_place(&b);
                            (id + u32::from(id >= removed), rest)
                        });
                        assert_eq!(a.map(|a| same_place(&a)), renumbered, "{name}");
                    }
                }
            }
        }
    }
}
