//! H81: triangles cut up.

use super::scenes_with_ties;
use crate::support::configurations::agreed;
use crate::support::scenes::{Triangle, standard_scene};

/// Each triangle cut into four at the exact midpoints of its edges: the same picture.
#[test]
fn h81_subdivision() {
    for (name, triangles) in scenes_with_ties() {
        let middle = |a: [f32; 3], b: [f32; 3]| std::array::from_fn(|k| (a[k] + b[k]) * 0.5);
        let is_exact = triangles.iter().all(|t| {
            (0..3).all(|i| {
                let (a, b) = (t[i], t[(i + 1) % 3]);
                (0..3).all(|k| {
                    f64::from((a[k] + b[k]) * 0.5) == (f64::from(a[k]) + f64::from(b[k])) * 0.5
                })
            })
        });
        if !is_exact {
            continue;
        }
        let quartered: Vec<Triangle> = triangles
            .iter()
            .flat_map(|&[a, b, c]| {
                let [p, q, r] = [middle(a, b), middle(b, c), middle(c, a)];
                [[a, p, r], [p, b, q], [r, q, c], [p, q, r]]
            })
            .collect();
        let whole = agreed(&standard_scene(&triangles));
        let parts = agreed(&standard_scene(&quartered));
        assert_eq!(whole.cover, parts.cover, "{name}");
        for (a, b) in whole.visible.iter().zip(&parts.visible) {
            assert_eq!(a.is_some(), b.is_some(), "{name}");
            let (Some(a), Some(b)) = (a, b) else { continue };
            assert_eq!(a.triangle.get(), b.triangle.get() / 4, "{name}");
            assert_eq!(a.facing, b.facing, "{name}");
            assert!(b.tie || !a.tie, "{name}: cutting adds edges, it takes none away");
            assert!(a.t_lo <= b.t_hi && b.t_lo <= a.t_hi, "{name}: {a:?} {b:?}");
        }
    }
}
