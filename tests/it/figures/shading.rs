//! A70: the torus by tessellation and shading, Mach bands, and the missed highlight.

use super::stage::{Picture, changed, sheet};

/// At the finest tessellation flat and Gouraud shading are at least this many times closer to each
/// other than at the coarsest: cells are 12 times smaller, and a highlight of exponent 40 spans
/// several of them.
const FINE_GAIN: f64 = 4.0;

#[test]
fn a70_phong_errs_less_than_gouraud_and_gouraud_less_than_flat_at_each_level() {
    let cells = sheet("torus").cells;
    let pictures: Vec<_> = cells.iter().map(|cell| Picture::of(&cell.scene)).collect();
    // Four times finer than the finest of the sheet in both directions.
    let fine = changed(
        "sheets/ring.toml",
        &[("around = 24", "around = 384"), ("across = 16", "across = 256")],
    );
    let fine = Picture::of(&fine);
    for level in pictures.chunks(3) {
        let errors: Vec<f64> =
            level.iter().map(|picture| picture.difference(&fine, None)).collect();
        assert!(errors[2] < errors[1] && errors[1] < errors[0], "{errors:?}");
    }
    let between = |level: usize| pictures[3 * level].difference(&pictures[3 * level + 1], None);
    assert!(between(2) * FINE_GAIN < between(0), "{} {}", between(2), between(0));
    assert!(between(2) < between(1) && between(1) < between(0));
}

#[test]
fn a_highlight_between_the_corners_is_missed_unless_every_pixel_is_lit() {
    let cells = sheet("missed-highlight").cells;
    let [flat, gouraud, phong] = &cells[..] else { panic!("three cells") };
    let brightest = |scene| {
        let picture = Picture::of(scene);
        picture.rgb.iter().map(|rgb| rgb[1]).fold(0.0, f64::max)
    };
    let ks = phong.scene.materials[0].ks[1];
    // The light's intensity is 0.95 and the highlight lies within the picture.
    assert!(brightest(&phong.scene) > 0.95 * ks);
    assert!(brightest(&gouraud.scene) < 0.3 * ks, "all four corners are dull");
    // One colour per triangle: two colours, and a seam between them.
    let picture = Picture::of(&flat.scene);
    let mut colors: Vec<_> =
        picture.pixels_of(0).map(|pixel| picture.rgb[pixel].map(f64::to_bits)).collect();
    colors.sort_unstable();
    colors.dedup();
    assert_eq!(colors.len(), 2);
}

/// Red along the middle row of a picture, where its object is seen.
fn middle_row(picture: &Picture) -> Vec<f64> {
    let height = picture.rgb.len() / picture.width;
    let row = height / 2 * picture.width..(height / 2 + 1) * picture.width;
    row.filter(|&pixel| picture.objects[pixel].is_some())
        .map(|pixel| picture.rgb[pixel][0])
        .collect()
}

#[test]
fn mach_bands_stand_at_steps_under_flat_and_at_kinks_under_gouraud_shading() {
    let rows: Vec<_> = sheet("mach-bands")
        .cells
        .iter()
        .map(|cell| middle_row(&Picture::of(&cell.scene)))
        .collect();
    let step = |row: &[f64]| row.windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f64::max);
    // The ramp's bend: the largest change of slope where the row is lit at all and rises.
    let bend = |row: &[f64]| {
        let lit: Vec<f64> = row.iter().copied().filter(|&value| value > 0.12).collect();
        lit.windows(3).map(|w| (w[2] - 2.0 * w[1] + w[0]).abs()).fold(0.0, f64::max)
    };
    let [flat, gouraud, phong] = &rows[..] else { panic!("three cells") };
    assert!(step(flat) > 5.0 * step(gouraud), "{} {}", step(flat), step(gouraud));
    assert!(bend(gouraud) > 2.0 * bend(phong), "{} {}", bend(gouraud), bend(phong));
}
