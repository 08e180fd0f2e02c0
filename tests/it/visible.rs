//! The list of visible triangles, against hand values and against the ids of the picture.

use crate::support::program::truecast;
use crate::support::scenes::{rectangle, standard_camera};
use assert_cmd::Command;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use tempfile::TempDir;
use truecast::accel::BuildPreset;
use truecast::pixel::{Pixel, Resolution, Window};
use truecast::render::visible::{Listing, SubsampleGrid, VisibleTriangle, list_visible};
use truecast::render::{Answerer, Unwatched, VisibilityPath};
use truecast::scene::Scene;
use truecast::visibility::Counting;

const PATHS: [VisibilityPath; 2] = [VisibilityPath::Cast, VisibilityPath::Raster];

fn list(
    scene: &Scene,
    window: Window,
    listing: Listing,
    path: VisibilityPath,
) -> Vec<VisibleTriangle> {
    let preset = BuildPreset::Medium;
    let answerer = Answerer::new(scene, path, preset, &Unwatched);
    let buffer = answerer.see(scene, window, Counting::Nearest, &Unwatched);
    list_visible(scene, &buffer, listing, &answerer, &Unwatched)
}

/// (id, pixels, sub-samples, first pixel) of each line.
fn short(list: &[VisibleTriangle]) -> Vec<(u32, u64, Option<u64>, [u32; 2])> {
    list.iter()
        .map(|v| (v.triangle.get(), v.pixels, v.subsamples, [v.first.x, v.first.y]))
        .collect()
}

fn grid(side: u32) -> Listing {
    Listing::Subsamples(SubsampleGrid::new(side).unwrap())
}

/// Pixel (i, j) spans [i − 8.5, i − 7.5] × [j − 8.5, j − 7.5] in the plane z = 8.
fn scene() -> Scene {
    let mut triangles = Vec::new();
    // 0, 1: exactly columns 3…5 of rows 2 and 3. The diagonal passes x = −3.25 at the centres of
    // row 2 and −4.75 at those of row 3: three centres on either side.
    triangles.extend(rectangle([-5.5, -6.5], [-2.5, -4.5], 8.0));
    // 2, 3: a strip 1/4 pixel wide between the centres of columns 10 and 11, rows 6 to 9.
    triangles.extend(rectangle([2.625, -2.5], [2.875, 1.5], 8.0));
    // 4, 5: hidden behind 0 and 1.
    triangles.extend(rectangle([-5.0, -6.0], [-3.0, -5.0], 8.5));
    // 6, 7: a strip 1/16 pixel wide just right of the centres of column 14, rows 12 and 13.
    triangles.extend(rectangle([6.015_625, 3.5], [6.078_125, 5.5], 8.0));
    Scene::from_triangles(standard_camera(8.0), &triangles)
}

#[test]
fn centres_are_counted_with_the_first_pixel() {
    let scene = scene();
    for path in PATHS {
        let found = list(&scene, scene.camera.resolution().window(), Listing::Centres, path);
        assert_eq!(short(&found), [(0, 3, None, [3, 2]), (1, 3, None, [5, 2])], "{path:?}");
    }
}

#[test]
fn sub_samples_find_what_lies_between_the_centres() {
    let scene = scene();
    let frame = scene.camera.resolution().window();
    for path in PATHS {
        // 2 × 2: columns of sub-samples at ±1/4 of the centre. The strip lies left of the centre of
        // column 11, x = 3, by 0.375…0.125, so it holds those at −1/4: 2 a row, 4 rows.
        let found = short(&list(&scene, frame, grid(2), path));
        let of = |id: u32| found.iter().find(|line| line.0 == id).copied();
        let strip: u64 = [2, 3].iter().filter_map(|&id| of(id)?.2).sum();
        assert_eq!(strip, 8, "{path:?}: {found:?}");
        assert_eq!(of(2).unwrap().1, 0);
        assert_eq!(of(2).unwrap().3, [11, 6]);
        assert_eq!([of(4), of(5), of(6), of(7)], [None; 4]);
        let both: u64 = [0, 1].iter().filter_map(|&id| of(id)?.2).sum();
        assert_eq!(both, 6 * 4);
        // 16 × 16: columns at odd multiples of 1/32; the thin strip holds those at 1/32.
        let found = short(&list(&scene, frame, grid(16), path));
        let thin: u64 = found.iter().filter(|line| line.0 >= 6).filter_map(|line| line.2).sum();
        assert_eq!(thin, 2 * 16);
        let strip: u64 =
            found.iter().filter(|line| [2, 3].contains(&line.0)).filter_map(|line| line.2).sum();
        assert_eq!(strip, 4 * 16 * 4, "a quarter of the width");
        assert!(found.iter().all(|line| ![4, 5].contains(&line.0)), "hidden stays hidden");
        assert!(found.is_sorted_by_key(|line| line.0));
    }
}

#[test]
fn a_crop_lists_its_own_pixels() {
    let scene = scene();
    let frame = scene.camera.resolution();
    let window = Window::new(frame, 4, 3, 12, 8).unwrap();
    for path in PATHS {
        let found = list(&scene, window, grid(4), path);
        let whole = list(&scene, frame.window(), grid(4), path);
        assert!(found.iter().all(|line| window.contains(line.first)));
        for line in &found {
            let of_frame = whole.iter().find(|other| other.triangle == line.triangle).unwrap();
            assert!(line.subsamples <= of_frame.subsamples && line.pixels <= of_frame.pixels);
        }
        let strip = found.iter().filter(|v| [2, 3].contains(&v.triangle.get()));
        let strip: u64 = strip.filter_map(|v| v.subsamples).sum();
        // Rows 6 and 7 of the strip: of the columns at −3/8 and −1/8, both exactly on its edges,
        // the tie rule gives it the left one, four sub-samples a row.
        assert_eq!(strip, 2 * 4, "{path:?}");
        assert_eq!(found[0].first, Pixel { x: 4, y: 3 });
    }
}

/// Runs the program; stdout of a success.
fn listed(folder: &Path, arguments: &[&str]) -> String {
    let (status, stdout, stderr) = truecast(folder, arguments);
    assert_eq!(status, 0, "{stderr}");
    stdout
}

#[test]
fn the_list_is_the_picture_by_triangles() {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/iteration-0.toml");
    let folder = TempDir::new().unwrap();
    let scene = scene.to_str().unwrap();
    let mut lists = Vec::new();
    for path in ["cast", "raster"] {
        let size = ["--size", "120x90", "--crop", "20,10,111,77", "--path", path];
        let files = ["-o", "ids.npy", "--visible", "list.csv", "--subpixel", "2", "--json"];
        let printed = listed(folder.path(), &[&["render", scene], &size[..], &files].concat());
        let document: serde_json::Value = serde_json::from_str(&printed).unwrap();
        let ids = fs::read(folder.path().join("ids.npy")).unwrap();
        let ids: Vec<u32> = npyz::NpyFile::new(&ids[..]).unwrap().into_vec().unwrap();
        let window = Window::new(Resolution::new(120, 90).unwrap(), 20, 10, 111, 77).unwrap();
        let mut expected: BTreeMap<u32, (u64, Pixel)> = BTreeMap::new();
        for (index, &id) in ids.iter().enumerate().filter(|(_, id)| **id != u32::MAX) {
            expected.entry(id).or_insert((0, window.pixel(index))).0 += 1;
        }
        let csv = fs::read_to_string(folder.path().join("list.csv")).unwrap();
        let (header, lines) = csv.split_once('\n').unwrap();
        assert_eq!(header, "id,mesh,source,pixels,subsamples,first_x,first_y");
        let mut missed = 0;
        let mut subsamples = 0;
        for line in lines.lines() {
            let fields: Vec<&str> = line.split(',').collect();
            let number = |k: usize| fields[k].parse::<u64>().unwrap();
            let id = number(0) as u32;
            subsamples += number(4);
            let (mesh, source) = if id < 2 { (0, "plane") } else { (1, "teapot") };
            assert_eq!(number(1), mesh);
            let local = if id < 2 { id } else { id - 2 };
            assert_eq!(fields[2], format!("{source}#{local}"));
            match expected.remove(&id) {
                Some((count, first)) => assert_eq!(
                    [number(3), number(5), number(6)],
                    [count, u64::from(first.x), u64::from(first.y)]
                ),
                None => {
                    assert_eq!(number(3), 0);
                    assert!(number(4) > 0);
                    missed += 1;
                }
            }
        }
        assert!(expected.is_empty(), "not listed: {expected:?}");
        assert!(missed > 100, "the teapot is finer than the pixels");
        assert_eq!(document["visible"]["missed_by_centres"], missed);
        assert_eq!(document["visible"]["subpixel"], 2);
        assert!(subsamples <= 4 * window.len() as u64);
        lists.push(csv);
    }
    assert!(lists[0] == lists[1], "both paths list the same");
}

#[test]
fn a_grid_that_is_not_on_the_lattice_or_has_no_list_is_a_usage_error() {
    let folder = TempDir::new().unwrap();
    for arguments in [
        &["render", "--visible", "list.csv", "--subpixel", "3"][..],
        &["render", "--visible", "list.csv", "--subpixel", "32"],
        &["render", "--subpixel", "4"],
    ] {
        Command::new(env!("CARGO_BIN_EXE_truecast"))
            .current_dir(folder.path())
            .args(arguments)
            .assert()
            .code(2);
    }
    let arguments = ["render", "--visible", "nowhere/list.csv"];
    Command::new(env!("CARGO_BIN_EXE_truecast"))
        .current_dir(folder.path())
        .args(arguments)
        .assert()
        .code(4);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}
