//! Sheets as a user meets them: the layout's formula, cells that are plain renders pixel for pixel,
//! what a cell sets, and errors that name the sheet's line and the cell.

use crate::support::program::truecast;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use truecast::check::{CheckOptions, Outcome, check};
use truecast::render::Unwatched;
use truecast::scene::{Overrides, Scene};
use truecast::sheet::Sheet;
use truecast::sheet::layout::{GAP, LABEL_GAP, MARGIN, TITLE_GAP};

const SCENE: &str = r#"version = 1
[image]
width = 40
height = 30
background = [0.1, 0.2, 0.3]
[camera]
eye = [0.0, 0.0, 5.0]
target = [0.0, 0.0, 0.0]
up = [0.0, 1.0, 0.0]
fov_y_deg = 40.0
[[material]]
name = "grey"
kd = [0.5, 0.5, 0.5]
[[mesh]]
shape = { torus = { major = 1.0, minor = 0.4, around = 12, across = 8 } }
material = "grey"
[[light]]
type = "point"
position = [1.0, 2.0, 4.0]
intensity = [0.5, 0.5, 0.25]
"#;

const SHEET: &str = r#"version = 1
scene = "scene.toml"
columns = 2
title = "Two"
row_labels = ["up", "low"]
column_labels = ["left", "right"]
[[cell]]
label = "plain"
[[cell]]
set = { "mesh.0.shape.torus.around" = 5, "light.0.intensity" = [1.0, 1.0, 0.5] }
[[cell]]
scene = "other.toml"
[[cell]]
set = { "light.0.intensity.2" = 1, "dialect" = "curless" }
"#;

/// Height of a line of text at scale 1; the title is twice as high.
const LINE: u32 = 16;

/// A folder with two scenes and a sheet.
struct Folder(TempDir);

impl Folder {
    fn new(sheet: &str) -> Self {
        let folder = Self(TempDir::new().unwrap());
        folder.write("scene.toml", SCENE);
        folder
            .write("other.toml", &SCENE.replace("eye = [0.0, 0.0, 5.0]", "eye = [3.0, 0.0, 4.0]"));
        folder.write("sheet.toml", sheet);
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    /// Exit status, stdout and stderr of a run in the folder.
    fn run(&self, arguments: &[&str]) -> (i32, String, String) {
        truecast(self.0.path(), arguments)
    }

    /// The sheet's `--json` document, after writing `sheet.png`.
    fn document(&self) -> serde_json::Value {
        let (status, stdout, stderr) = self.run(&["sheet", "sheet.toml", "--json"]);
        assert_eq!(status, 0, "{stderr}");
        serde_json::from_str(&stdout).unwrap()
    }

    /// Demands the status and the words, and that nothing was written.
    fn assert_refused(&self, status: i32, words: &[&str]) -> String {
        let before = fs::read_dir(self.0.path()).unwrap().count();
        let (found, stdout, stderr) = self.run(&["sheet", "sheet.toml"]);
        assert_eq!((found, stdout.as_str()), (status, ""), "{stderr}");
        for word in words {
            assert!(stderr.contains(word), "no {word:?} in {stderr}");
        }
        assert_eq!(fs::read_dir(self.0.path()).unwrap().count(), before, "left files behind");
        stderr
    }
}

/// An 8-bit RGB picture.
#[derive(PartialEq)]
struct Picture {
    width: u32,
    height: u32,
    codes: Vec<u8>,
}

impl Picture {
    fn read(path: &Path) -> Self {
        let bytes = fs::read(path).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut codes = vec![0; reader.output_buffer_size().unwrap()];
        let frame = reader.next_frame(&mut codes).unwrap();
        assert_eq!(frame.color_type, png::ColorType::Rgb);
        Self { width: frame.width, height: frame.height, codes }
    }

    fn crop(&self, left: u32, top: u32, width: u32, height: u32) -> Self {
        let row = |y: u32| {
            let start = (3 * (y * self.width + left)) as usize;
            &self.codes[start..start + 3 * width as usize]
        };
        Self { width, height, codes: (top..top + height).flat_map(row).copied().collect() }
    }
}

/// Left edge of a column and top edge of a row of [`SHEET`].
fn corner(column: u32, row: u32) -> (u32, u32) {
    let left = MARGIN + "low".len() as u32 * 8 + GAP;
    let top = MARGIN + 2 * LINE + TITLE_GAP + LINE + LABEL_GAP;
    (left + column * (40 + GAP), top + row * (30 + LABEL_GAP + LINE + GAP))
}

#[test]
fn the_picture_is_as_large_as_the_layout_says() {
    let folder = Folder::new(SHEET);
    let document = folder.document();
    let picture = Picture::read(&folder.path("sheet.png"));
    let (left, top) = corner(1, 1);
    // The last row has no labels of cells and leaves no room for them.
    assert_eq!((picture.width, picture.height), (left + 40 + MARGIN, top + 30 + MARGIN));
    assert_eq!(document["width"], picture.width);
    assert_eq!(document["height"], picture.height);

    let bare = "version = 1\nscene = \"scene.toml\"\ncolumns = 3\n[size]\nwidth = 7\nheight = 5\n\
                [[cell]]\n[[cell]]\n[[cell]]\n[[cell]]\n";
    let folder = Folder::new(bare);
    folder.document();
    let picture = Picture::read(&folder.path("sheet.png"));
    let expected = (2 * MARGIN + 3 * 7 + 2 * GAP, 2 * MARGIN + 2 * 5 + GAP);
    assert_eq!((picture.width, picture.height), expected);
}

#[test]
fn every_cell_is_the_plain_render_of_its_scene() {
    let folder = Folder::new(SHEET);
    folder.document();
    let page = Picture::read(&folder.path("sheet.png"));
    let by_hand = SCENE
        .replace("around = 12", "around = 5")
        .replace("intensity = [0.5, 0.5, 0.25]", "intensity = [1.0, 1.0, 0.5]");
    folder.write("cell-1.toml", &by_hand);
    folder.write("cell-3.toml", &SCENE.replace("0.5, 0.25]", "0.5, 1.0]"));
    let mut pictures = Vec::new();
    for (index, scene) in
        ["scene.toml", "cell-1.toml", "other.toml", "cell-3.toml"].into_iter().enumerate()
    {
        assert_eq!(folder.run(&["render", scene, "-o", "plain.png"]).0, 0);
        let plain = Picture::read(&folder.path("plain.png"));
        let (left, top) = corner(index as u32 % 2, index as u32 / 2);
        let cell = page.crop(left, top, 40, 30);
        assert!(cell == plain, "cell {index} is not {scene}");
        pictures.push(cell);
    }
    for (index, picture) in pictures.iter().enumerate() {
        assert!(!pictures[..index].contains(picture), "cell {index} differs from those before");
    }
}

#[test]
fn json_holds_each_cells_numbers() {
    let sheet = SHEET.replace("\"mesh.0.shape.torus.around\" = 5, ", "");
    let folder = Folder::new(&sheet);
    let document = folder.document();
    assert_eq!(document["schema"], "truecast/sheet/1");
    assert_eq!(document["file"], "sheet.png");
    let cells = document["cells"].as_array().unwrap();
    assert_eq!(cells.len(), 4);
    assert_eq!(cells[0]["label"], "plain");
    assert_eq!((&cells[3]["row"], &cells[3]["column"]), (&1.into(), &1.into()));
    let number = |cell: usize, key: &str, channel: usize| {
        cells[cell][key][channel].as_f64().expect("a number")
    };
    // Cell 1 is cell 0 under twice the light: doubling is exact in every format on the way, and so
    // in f64 sums of f32.
    for key in ["mean_radiance", "max_radiance"] {
        for channel in 0..3 {
            assert_eq!(number(1, key, channel), 2.0 * number(0, key, channel), "{key}");
        }
        assert!(number(0, "max_radiance", 0) > number(0, "mean_radiance", 0));
        assert!(number(0, "mean_radiance", 0) > 0.0);
    }
    assert_eq!(cells[0]["covered_pixels"], cells[1]["covered_pixels"]);
    assert!(cells.iter().all(|cell| cell["seconds"].as_f64().unwrap() > 0.0));
}

#[test]
fn a_cell_that_sees_nothing_has_no_radiance() {
    let sheet = "version = 1\nscene = \"scene.toml\"\ncolumns = 1\n[[cell]]\n\
                 set = { \"camera.target\" = [0.0, 0.0, 9.0] }\n";
    let document = Folder::new(sheet).document();
    let cell = &document["cells"][0];
    assert_eq!(cell["covered_pixels"], 0);
    assert!(cell["mean_radiance"].is_null() && cell["max_radiance"].is_null());
}

#[test]
fn the_same_sheet_gives_the_same_bytes_for_any_number_of_threads() {
    let folder = Folder::new(SHEET);
    let bytes = ["1", "2", "5"].map(|threads| {
        let arguments = ["sheet", "sheet.toml", "-o", "out.PNG", "--threads", threads, "--quiet"];
        assert_eq!(folder.run(&arguments), (0, String::new(), String::new()));
        fs::read(folder.path("out.PNG")).unwrap()
    });
    assert!(bytes[0] == bytes[1] && bytes[1] == bytes[2]);
    assert!(!folder.path("sheet.png").exists());
}

#[test]
fn faults_of_the_sheet_name_its_line() {
    for (from, to, words) in [
        ("columns = 2", "colums = 2", &["sheet.toml:3:1", "unknown key `colums`", "`columns`"][..]),
        ("columns = 2", "columns = 0", &["sheet.toml:3:11", "from 1 to 1024"]),
        ("version = 1", "version = 2", &["sheet.toml:1:11", "`version`"]),
        ("columns = 2", "columns = 3", &["sheet.toml:6:17", "`column_labels`", "give 3"]),
        ("[\"up\", \"low\"]", "[\"up\"]", &["sheet.toml:5:14", "`row_labels`", "give 2 texts"]),
        ("title = \"Two\"", "title = 2", &["sheet.toml:4:9", "`title` must be a string"]),
        ("label = \"plain\"", "lable = \"\"", &["sheet.toml:8:1", "`lable`", "`label`"]),
        ("title = \"Two\"", "size = { width = 8 }", &["sheet.toml:4:8", "lacks `height`"]),
        ("version = 1", "version = = 1", &["sheet.toml:1:", "not TOML"]),
        ("scene = \"scene.toml\"", "", &["sheet.toml:7:1", "in cell 1 (plain)", "`scene`"]),
    ] {
        assert!(SHEET.contains(from));
        let folder = Folder::new(&SHEET.replacen(from, to, 1));
        folder.assert_refused(3, words);
    }
    Folder::new("version = 1\ncolumns = 1\n").assert_refused(3, &["lacks `[[cell]]`"]);
    Folder::new("version = 1\ncolumns = 1\ncell = []\n").assert_refused(3, &["has no cell"]);
    Folder::new("version = 1\n[[cell]]\n").assert_refused(3, &["lacks `columns`"]);
    let huge = format!(
        "{}[size]\nwidth = 65536\nheight = 65536\n",
        SHEET.replace("[[cell]]", "\n[[cell]]")
    );
    Folder::new(&huge).assert_refused(3, &["sheet.toml", "smaller [size]"]);
}

#[test]
fn faults_of_what_a_cell_sets_name_the_cell_and_the_line_in_the_sheet() {
    let set = "set = { \"light.0.intensity.2\" = 1, \"dialect\" = \"curless\" }";
    assert!(SHEET.contains(set));
    for (entry, words) in [
        ("\"light.2.exponent\" = 1", &["sheet.toml:14:9", "no number 2", "in cell 4"][..]),
        ("\"mesh.0.shpae.torus.around\" = 1", &["sheet.toml:14:9", "`shpae`", "`shape`", "cell 4"]),
        ("\"image.widht\" = 4", &["sheet.toml:14:9", "unknown key `widht`", "`width`", "cell 4"]),
        ("\"material.0.kd\" = [-1.0, 0.0, 0.0]", &["sheet.toml:14:9", "kd", "in cell 4 of"]),
        ("\"dialect\" = \"curles\"", &["sheet.toml:14:9", "curles", "in cell 4"]),
        ("\"mesh.0.shape.torus\" = { major = 1.0, minor = 2.0 }", &["sheet.toml:14:9", "cell 4"]),
        ("\"a..b\" = 1", &["sheet.toml:14:9", "empty step", "cell 4"]),
    ] {
        Folder::new(&SHEET.replace(set, &format!("set = {{ {entry} }}"))).assert_refused(3, words);
    }
}

// What is written in the scene file is reported there, though the parser read another text.
#[test]
fn faults_of_the_scene_are_reported_where_they_are_written_and_once() {
    let folder = Folder::new(SHEET);
    folder.write("scene.toml", &SCENE.replace("kd = [0.5, 0.5, 0.5]", "kd = [0.5, -0.5, 0.5]"));
    let stderr = folder.assert_refused(3, &["scene.toml:13:6", "kd", "in cell 1 (plain)"]);
    assert_eq!(stderr.matches("error:").count(), 1, "{stderr}");

    let sheet = "version = 1\nscene = \"scene.toml\"\ncolumns = 1\n[[cell]]\n\
                 set = { \"image.width\" = 20 }\n";
    let folder = Folder::new(sheet);
    folder.write("scene.toml", &SCENE.replace("kd = [0.5, 0.5, 0.5]", "kd = [0.5, -0.5, 0.5]"));
    folder.assert_refused(3, &["scene.toml:13:6", "kd", "in cell 1 of sheet.toml"]);
    folder.write("scene.toml", &SCENE.replace("kd = [", "kd = [["));
    folder.assert_refused(3, &["scene.toml:1", "not TOML", "in cell 1 of sheet.toml"]);
}

#[test]
fn usage_and_reading_failures_have_their_statuses() {
    let folder = Folder::new(SHEET);
    assert_eq!(folder.run(&["sheet", "sheet.toml", "-o", "sheet.exr"]).0, 2);
    assert_eq!(folder.run(&["sheet"]).0, 2);
    assert_eq!(folder.run(&["sheet", "missing.toml"]).0, 4);
    assert_eq!(folder.run(&["sheet", "sheet.toml", "-o", "nowhere/sheet.png"]).0, 4);
    fs::remove_file(folder.path("other.toml")).unwrap();
    folder.assert_refused(4, &["sheet.toml:12:9", "other.toml", "in cell 3"]);
    folder.write("other.toml", &SCENE.replace("intensity = [0.5", "intensity = [1e300"));
    folder.assert_refused(3, &["cell 3", "inf"]);
}

#[test]
fn the_sheets_that_come_with_the_project_load() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/sheets");
    let (mut sheets, mut scenes) = (0, 0);
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let (name, text) = (path.display(), fs::read_to_string(&path).unwrap());
        assert!(text.starts_with("# "), "{name} opens with its purpose");
        if text.contains("[[cell]]") {
            let sheet = Sheet::load(&path).unwrap();
            assert_eq!(sheet.warnings, Vec::<String>::new(), "{name}");
            sheets += 1;
        } else {
            let scene = Scene::load(&path, &Overrides::default()).unwrap();
            let (report, _) = check(&scene, &CheckOptions::default(), &Unwatched);
            assert_eq!(report.outcome(), Outcome::Agreement, "{name}");
            scenes += 1;
        }
    }
    assert!(sheets >= 2 && scenes >= 2, "{sheets} sheets, {scenes} scenes");
}
