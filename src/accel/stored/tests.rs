//! What was kept comes back as it was, and nothing else does.

use super::*;
use crate::accel::tests::check as check_boxes;

/// Triangles of small size anywhere.
fn soup() -> TriangleMesh {
    let mut state = 1_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 40) as f32 / (1 << 24) as f32
    };
    let mut positions = Vec::new();
    for _ in 0..500 {
        let place = [next(), next(), next()];
        positions.extend((0..3).map(|_| place.map(|c| c + 0.05 * next())));
    }
    let corners = (0..500).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    TriangleMesh { positions, corners, ..TriangleMesh::default() }
}

/// A bumpy surface over a grid.
fn surface() -> TriangleMesh {
    let place = |i: u32| {
        let (x, y) = ((i % 17) as f32, (i / 17) as f32);
        [x, y, (x * y * 0.3).fract()]
    };
    let squares = (0..16_u32).flat_map(|y| (0..16).map(move |x| 17 * y + x));
    let corners = squares.flat_map(|i| [[i, i + 1, i + 17], [i + 18, i + 17, i + 1]]).collect();
    let positions = (0..17 * 17).map(place).collect();
    TriangleMesh { positions, corners, ..TriangleMesh::default() }
}

fn same(a: &Accelerator, b: &Accelerator) {
    assert_eq!(format!("{:?}", a.tree), format!("{:?}", b.tree));
    assert_eq!(a.copies, b.copies);
}

/// Meshes of none, one, few and many triangles, with thin ones and copies.
fn meshes() -> Vec<TriangleMesh> {
    let mut doubled = surface();
    let corners = doubled.corners.clone();
    doubled.corners.extend(corners.iter().step_by(3).map(|&[a, b, c]| [b, c, a]));
    doubled.corners.extend(corners.iter().step_by(9));
    doubled.corners.push([0, 0, 1]);
    let few = TriangleMesh { corners: doubled.corners[..5].to_vec(), ..doubled.clone() };
    let one = TriangleMesh { corners: doubled.corners[..1].to_vec(), ..doubled.clone() };
    vec![TriangleMesh::default(), one, few, doubled, soup()]
}

#[test]
fn trees_come_back() {
    for mesh in meshes() {
        for preset in [BuildPreset::Fastest, BuildPreset::Medium] {
            let key = TreeKey::new(&mesh, preset);
            let built = Accelerator::build(&mesh, preset);
            let bytes = built.to_bytes(key);
            assert!(bytes.len() <= Accelerator::most_bytes(mesh.len()));
            let back = Accelerator::from_bytes(&bytes, key, &mesh).unwrap();
            same(&back, &built);
            assert_eq!(back.to_bytes(key), bytes);
        }
    }
}

#[test]
fn keys_tell_meshes_and_presets_apart() {
    let mesh = soup();
    let key = TreeKey::new(&mesh, BuildPreset::Medium);
    assert_eq!(key, TreeKey::new(&mesh.clone(), BuildPreset::Medium));
    assert_ne!(key, TreeKey::new(&mesh, BuildPreset::Fast));
    let mut moved = mesh.clone();
    moved.positions[3][1] = moved.positions[3][1].next_up();
    assert_ne!(key, TreeKey::new(&moved, BuildPreset::Medium));
    let mut turned = mesh.clone();
    turned.corners[7].rotate_left(1);
    assert_ne!(key, TreeKey::new(&turned, BuildPreset::Medium));
    let bytes = Accelerator::build(&mesh, BuildPreset::Medium).to_bytes(key);
    let other = TreeKey::new(&moved, BuildPreset::Medium);
    assert!(Accelerator::from_bytes(&bytes, other, &moved).is_err());
}

#[test]
fn cut_and_changed_bytes_are_refused() {
    let mesh = &meshes()[3];
    let key = TreeKey::new(mesh, BuildPreset::Medium);
    let bytes = Accelerator::build(mesh, BuildPreset::Medium).to_bytes(key);
    for end in (0..bytes.len()).step_by(61).chain([bytes.len() - 1]) {
        assert!(Accelerator::from_bytes(&bytes[..end], key, mesh).is_err(), "cut at {end}");
    }
    for place in (0..bytes.len()).step_by(53) {
        let mut damaged = bytes.clone();
        damaged[place] ^= 0x10;
        assert!(Accelerator::from_bytes(&damaged, key, mesh).is_err(), "changed at {place}");
    }
    let mut longer = bytes.clone();
    longer.push(0);
    assert!(Accelerator::from_bytes(&longer, key, mesh).is_err());
}

/// Bytes with other words and the digest that belongs to them.
fn forged(bytes: &[u8], change: impl FnOnce(&mut Vec<u32>)) -> Vec<u8> {
    let (head, rest) = bytes.split_at(40);
    let (words, _) = rest[..rest.len() - DIGEST].as_chunks();
    let mut words: Vec<u32> = words.iter().map(|&word| u32::from_le_bytes(word)).collect();
    change(&mut words);
    let mut forged = head.to_vec();
    forged.extend(words.iter().flat_map(|word| word.to_le_bytes()));
    let digest = Sha256::digest(&forged);
    forged.extend(digest);
    forged
}

#[test]
fn a_tree_that_is_none_is_refused_though_its_digest_is_right() {
    let mesh = &meshes()[3];
    let key = TreeKey::new(mesh, BuildPreset::Medium);
    let bytes = Accelerator::build(mesh, BuildPreset::Medium).to_bytes(key);
    assert!(Accelerator::from_bytes(&forged(&bytes, |_| ()), key, mesh).is_ok());
    // Any one word, by 1, by a bit and to the largest: links, counts, ids and copies. A change may
    // turn one tree into another; then it is a tree over the same triangles.
    let count = (bytes.len() - 40 - DIGEST) / 4;
    let mut refused = 0;
    for place in (0..count).step_by(7) {
        let changes: [fn(u32) -> u32; 4] =
            [|w| w.wrapping_add(1), |w| w.wrapping_sub(1), |w| w ^ 1 << 27, |_| u32::MAX];
        for change in changes {
            let bytes = forged(&bytes, |words| words[place] = change(words[place]));
            match Accelerator::from_bytes(&bytes, key, mesh) {
                Err(_) => refused += 1,
                Ok(tree) => check_boxes(&tree),
            }
        }
    }
    assert!(refused > count / 7 * 3, "{refused} of {count}");
    // Two ids exchanged between leaves: their boxes follow.
    let exchanged = forged(&bytes, |words| {
        let lanes = GROUP * words[1] as usize;
        let first = words.len() - words[3] as usize - lanes;
        words.swap(first, first + lanes - GROUP);
    });
    check_boxes(&Accelerator::from_bytes(&exchanged, key, mesh).unwrap());
}
