//! The figures of the course texts: the sheets and scenes that reproduce them, and what the texts
//! say about them as assertions. A70 in `shading`, A71 and A78 in `highlights`, A73 in
//! `hemisphere`, A75 in `lab`; A77 here.

mod hemisphere;
mod highlights;
mod lab;
mod page;
mod shading;
mod stage;

use stage::{Picture, sheet};
use std::collections::HashSet;
use truecast::scene::hash::content_hash;

#[test]
fn a77_teapots_differ_in_nothing_but_their_material() {
    let cells = sheet("teapots").cells;
    assert_eq!(cells.len(), 6);
    let hashes: HashSet<_> = cells.iter().map(|cell| content_hash(&cell.scene)).collect();
    assert_eq!(hashes.len(), 6, "six different pictures");
    let first = &cells[0].scene;
    let pots = first.objects[0].triangles.clone();
    let mut materials = HashSet::new();
    for cell in &cells {
        let mut scene = cell.scene.clone();
        let worn = &mut scene.triangle_materials[pots.start as usize..pots.end as usize];
        let material = worn[0];
        assert!(worn.iter().all(|&other| other == material));
        assert!(materials.insert(material), "each material once");
        assert_eq!(Some(&scene.materials[material as usize].name), cell.label.as_ref());
        // In the first one's clothes each is the first, to the last bit of the mesh.
        worn.fill(first.triangle_materials[pots.start as usize]);
        assert_eq!(content_hash(&scene), content_hash(first));
    }
    let pictures: Vec<_> = cells.iter().map(|cell| Picture::of(&cell.scene)).collect();
    for picture in &pictures[1..] {
        assert_eq!(picture.objects, pictures[0].objects);
        // Metal or clay, the table below stays the same.
        for (pixel, &object) in picture.objects.iter().enumerate() {
            if object == Some(1) {
                assert_eq!(picture.rgb[pixel], pictures[0].rgb[pixel]);
            }
        }
    }
}
