//! Every fault of a scene file is named, with its exact place. In the texts below `▸` stands right
//! before the character at which a fault is expected, and is not part of the text.

use std::path::Path;
use truecast::pixel::Resolution;
use truecast::scene::error::{Fault, SceneError};
use truecast::scene::{Overrides, Scene, SceneErrors};

const HEAD: &str = "version = 1\n\
    [image]\nwidth = 4\nheight = 3\n\
    [camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 45\n";

const NAME: &str = "scenes/test.toml";

fn load(text: &str) -> Result<Scene, SceneErrors> {
    Scene::from_toml(text, Path::new(NAME), Path::new("scenes"), &Overrides::default())
}

/// The text without its marks, and the line and column that each mark stood at.
fn unmark(marked: &str) -> (String, Vec<(u32, u32)>) {
    let (mut text, mut places, mut line, mut column) = (String::new(), Vec::new(), 1, 1);
    for character in marked.chars() {
        match character {
            '▸' => {
                places.push((line, column));
                continue;
            }
            '\n' => (line, column) = (line + 1, 1),
            _ => column += 1,
        }
        text.push(character);
    }
    (text, places)
}

/// The whole text has exactly the faults at its marks, with these messages.
#[track_caller]
fn refused_whole(marked: &str, messages: &[&str]) -> Vec<SceneError> {
    let (text, places) = unmark(marked);
    let errors = load(&text).expect_err("the text has a fault").0;
    let found: Vec<_> =
        errors.iter().map(|e| ((e.place.line, e.place.column), e.message.as_str())).collect();
    let expected: Vec<_> = places.into_iter().zip(messages.iter().copied()).collect();
    assert_eq!(found, expected);
    assert!(errors.iter().all(|e| e.place.file == Path::new(NAME)));
    errors
}

/// The same for a text that follows a faultless head.
#[track_caller]
fn refused(marked: &str, messages: &[&str]) -> Vec<SceneError> {
    refused_whole(&format!("{HEAD}{marked}"), messages)
}

/// The same for a mesh with a shape.
#[track_caller]
fn mesh_refused(marked: &str, messages: &[&str]) {
    refused(&format!("[[mesh]]\nshape = {{ plane = {{ size = 1 }} }}\n{marked}"), messages);
}

#[track_caller]
fn light_refused(marked: &str, messages: &[&str]) {
    refused(&format!("[[light]]\n{marked}"), messages);
}

fn help(errors: &[SceneError]) -> &str {
    errors[0].help.as_deref().unwrap_or_default()
}

#[test]
fn text_that_is_not_toml() {
    let (text, places) = unmark(&format!("{HEAD}äö = \"x\" ▸nonsense\n"));
    let errors = load(&text).unwrap_err().0;
    assert_eq!((errors[0].place.line, errors[0].place.column), places[0]);
    assert!(errors[0].message.starts_with("not TOML: "), "{}", errors[0].message);
    assert_eq!(errors.len(), 1);
    let twice = load(&format!("{HEAD}fov_y_deg = 3\n")).unwrap_err().0;
    assert_eq!((twice[0].place.line, twice[0].place.column), (10, 1));
}

#[test]
fn version_image_and_camera_must_be_there() {
    let errors = load("").unwrap_err().0;
    let messages: Vec<_> = errors.iter().map(ToString::to_string).collect();
    assert_eq!(
        messages,
        [
            "scenes/test.toml: the scene file lacks `version = 1`",
            "scenes/test.toml: the scene file lacks `[image]`",
            "scenes/test.toml: the scene file lacks `[camera]`",
        ]
    );
    refused_whole("version = ▸2\nanything = 1", &["version 2 of the format is not known"]);
    refused_whole(
        "version = ▸\"1\"\n[▸image]\n[▸camera]\n".replace("[▸", "▸[").as_str(),
        &[
            "`version` must be a whole number, not a string",
            "[image] lacks `width`",
            "[camera] lacks `eye`, `target`, `up` and `fov_y_deg` (or one of [camera.exact], \
             [camera.opencv], [camera.gl])",
        ],
    );
}

#[test]
fn unknown_keys_with_a_suggestion() {
    let errors = refused("[[▸lights]]\n", &["unknown key `lights` in the scene file"]);
    assert_eq!(help(&errors), "did you mean `light`?");
    let errors = refused(
        "[[material]]\nname = \"brass\"\n▸colour = [1, 1, 1]\n▸Kd = [1, 1, 1]\n",
        &["unknown key `colour` in [[material]]", "unknown key `Kd` in [[material]]"],
    );
    assert!(help(&errors).starts_with("known here: name, ka, kd"), "{}", help(&errors));
    assert_eq!(errors[1].help.as_deref(), Some("did you mean `kd`?"));
    let errors =
        refused("[switches]\n▸specullar = \"blinn\"\n", &["unknown key `specullar` in [switches]"]);
    assert_eq!(help(&errors), "did you mean `specular`?");
    let fov = HEAD.replace("fov_y_deg", "▸fov").replace("[camera]", "▸[camera]");
    let errors =
        refused_whole(&fov, &["[camera] lacks `fov_y_deg`", "unknown key `fov` in [camera]"]);
    assert_eq!(errors[1].help.as_deref(), Some("did you mean `fov_y_deg`?"));
}

#[test]
fn values_of_the_wrong_kind_in_plain_words() {
    refused_whole(
        &HEAD
            .replace("width = 4", "width = ▸\"4\"")
            .replace("height = 3", "height = ▸3.5")
            .replace("eye = [0, 0, 5]", "eye = [0, ▸\"0\", 5]")
            .replace("target = [0, 0, 0]", "target = ▸[0, 0]")
            .replace("up = [0, 1, 0]", "up = ▸true")
            .replace("fov_y_deg = 45", "fov_y_deg = ▸[45]"),
        &[
            "`width` must be a whole number, not a string",
            "`height` must be a whole number, not a number with a fraction",
            "`eye` must be a list of 3 numbers, each a number, not a string",
            "`target` must be a list of 3 numbers, not a list of 2",
            "`up` must be a list of 3 numbers, not true or false",
            "`fov_y_deg` must be a number, not a list",
        ],
    );
    refused(
        "[material]\nname = \"a\"\n".replace("[material]", "▸[material]").as_str(),
        &["`material` must be a list of tables, not a table"],
    );
    mesh_refused(
        "scale = ▸\"2\"\nmatrix = ▸[1, 2]\nmaterial = ▸3\n",
        &[
            "`scale` must be a number or a list of 3 numbers, not a string",
            "`matrix` must be 4 lists of 4 numbers (or the 16 numbers, row by row), not a list of 2",
            "`material` must be a string, not a whole number",
        ],
    );
}

#[test]
fn numbers_that_are_not_finite() {
    light_refused(
        "type = \"point\"\nposition = [0.0, ▸nan, 0.0]\nintensity = [1, 1, ▸-inf]\nexponent = ▸1e999\n",
        &[
            "`position` must be a list of 3 numbers, each a finite number, not nan",
            "`intensity` must be a list of 3 numbers, each a finite number, not -inf",
            "`exponent` must be a finite number, not 1e999",
        ],
    );
    refused(
        "[[mesh]]\nshape = { plane = { size = ▸inf } }\n",
        &["`size` must be a finite number, not inf"],
    );
}

#[test]
fn image_out_of_range() {
    refused_whole(
        &HEAD
            .replace("width = 4", "width = ▸0\nbackground = ▸[0, -0.5, 0]\nsamples = ▸2")
            .replace("height = 3", "height = ▸65537"),
        &[
            "`width` must be a whole number from 1 to 65536, not 0",
            "`background` must be at least 0 in every channel, not -0.5",
            "supersampling (`samples` other than 1) is not simulated by this version",
            "`height` must be a whole number from 1 to 65536, not 65537",
        ],
    );
}

#[test]
fn cameras_that_are_none() {
    let one = |from: &str, to: &str, message: &str| {
        refused_whole(&HEAD.replace(from, to), &[message]);
    };
    one(
        "fov_y_deg = 45",
        "fov_y_deg = ▸180",
        "`fov_y_deg` must be greater than 0 and less than 180, not 180",
    );
    one("target = [0, 0, 0]", "target = ▸[0, 0, 5]", "`eye` and `target` are the same point");
    one(
        "up = [0, 1, 0]",
        "up = ▸[0, 0, 2]",
        "`up` must not be zero or parallel to the view direction",
    );
    one(
        "eye = [0, 0, 5]",
        "eye = ▸[1e-40, 0, 5]",
        "each component of the eye must be 0 or between 2^-96 (1.3e-29) and 2^126 (8.5e37) in \
         magnitude, not 1e-40",
    );
    refused(
        "[camera.▸exact]\neye = [0, 0, 5]\nd0 = [0, 0, -1]\ndx = [1, 0, 0]\ndy = [0, 1, 0]\n",
        &["the camera is written twice: as look-at and as exact"],
    );
    let head = "version = 1\n[image]\nwidth = 4\nheight = 3\n";
    refused_whole(
        &format!(
            "{head}[camera.▸exact]\neye = [0, 0, 5]\nd0 = [1, 1, 0]\ndx = [1, 0, 0]\ndy = [0, 1, 0]\n"
        ),
        &["the image plane passes through the eye: d0, dx and dy lie in one plane"],
    );
    refused_whole(
        &format!("{head}▸[camera.opencv]\nK = ▸[1, 2, 3]\nt = [0, 0, 0]\n"),
        &[
            "[camera.opencv] lacks `R`",
            "`K` must be 3 lists of 3 numbers (or the 9 numbers, row by row), not a list of 3",
        ],
    );
}

#[test]
fn materials() {
    refused(
        "[[material]]\nname = \"a\"\nkd = ▸[1, -1, 0]\nns = ▸-1\nopacity = ▸0.5\n▸kd_map = \"w.png\"\n\
         [[material]]\nname = ▸\"a\"\nopacity = ▸2\n▸filter = \"mip\"\n▸wrap = \"clamp\"\n▸[[material]]\n",
        &[
            "`kd` must be at least 0 in every channel, not -1",
            "`ns` must be at least 0, not -1",
            "transparency (`opacity` other than 1) is not simulated by this version",
            "textures (`kd_map`) are not simulated by this version",
            "the name `a` is taken by another material",
            "`opacity` must be from 0 to 1, not 2",
            "textures (`filter`) are not simulated by this version",
            "textures (`wrap`) are not simulated by this version",
            "[[material]] lacks `name`",
        ],
    );
    let errors = refused(
        "[[material]]\nname = \"brass\"\n[[mesh]]\nshape = { plane = { size = 1 } }\nmaterial = ▸\"bras\"\n",
        &["there is no material `bras`"],
    );
    assert_eq!(help(&errors), "did you mean `brass`?");
    // A faulty material may be the one that is meant: no second error.
    refused(
        "[[material]]\nname = \"brass\"\nkd = ▸1\n[[mesh]]\nshape = { plane = { size = 1 } }\nmaterial = \"brass\"\n",
        &["`kd` must be a list of 3 numbers, not a whole number"],
    );
}

#[test]
fn meshes() {
    refused("▸[[mesh]]\n", &["[[mesh]] lacks `file` or `shape`"]);
    refused(
        "[[mesh]]\nfile = \"a.obj\"\n▸shape = { plane = { size = 1 } }\n",
        &["a mesh has either `file` or `shape`, not both"],
    );
    mesh_refused(
        "shading = ▸\"flat\"\nsides = ▸\"both\"\n",
        &[
            "flat shading is not simulated by this version",
            "`sides` must be \"single\" or \"double\", not \"both\"",
        ],
    );
    mesh_refused("shading = ▸\"phon\"\n", &["there is no shading \"phon\""]);
    mesh_refused("shading = ▸\"gouraud\"\n", &["gouraud shading is not simulated by this version"]);
    mesh_refused(
        "matrix = ▸[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 1]]\nscale = ▸1\ntranslate = ▸[0, 0, 0]\n",
        &[
            "the last row of `matrix` must be 0 0 0 1, not 0 0 1 1",
            "a mesh has either `matrix` or `scale`, not both",
            "a mesh has either `matrix` or `translate`, not both",
        ],
    );
    refused(
        "▸[[mesh]]\nshape = { plane = { size = 1 } }\nscale = 1e40\n",
        &[
            "mesh `plane`: a corner at (-5e39, 0e0, 5e39) after the transform; each coordinate must \
           be finite and at most 2^126 (8.5e37) in magnitude",
        ],
    );
}

#[test]
fn shapes() {
    refused("[[mesh]]\nshape = ▸\"plane\"\n", &["`shape` must be a table, not a string"]);
    refused("[[mesh]]\nshape = ▸{}\n", &["`shape` must name one shape, not 0"]);
    let errors =
        refused("[[mesh]]\nshape = { ▸plain = { size = 1 } }\n", &["there is no shape `plain`"]);
    assert_eq!(help(&errors), "did you mean `plane`?");
    let errors = refused(
        "[[mesh]]\nshape = { plane = { size = 1, ▸sizes = 2 } }\n",
        &["unknown key `sizes` in shape `plane`"],
    );
    assert_eq!(help(&errors), "did you mean `size`?");
    refused("[[mesh]]\nshape = { plane = ▸{} }\n", &["shape `plane` lacks `size`"]);
    refused(
        "[[mesh]]\nshape = { plane = { size = ▸\"1\" } }\n",
        &["`size` must be a number, not string \"1\""],
    );
    let errors = load(&format!("{HEAD}[[mesh]]\nshape = {{ plane = {{ size = -1 }} }}\n"));
    let errors = errors.unwrap_err().0;
    assert_eq!((errors[0].place.line, errors[0].place.column), (11, 9));
    assert!(errors[0].message.starts_with("shape `plane`: "), "{}", errors[0].message);
}

#[test]
fn mesh_files_that_cannot_be_read() {
    let errors = load(&format!("{HEAD}[[mesh]]\nfile = \"no-such.obj\"\n")).unwrap_err();
    assert_eq!(errors.fault(), Fault::Reading);
    let error = &errors.0[0];
    assert_eq!((error.place.line, error.place.column), (11, 8));
    assert!(
        error.message.starts_with("the mesh file `scenes/no-such.obj` cannot be read: "),
        "{error}"
    );
    refused(
        "[[mesh]]\nfile = ▸\"a.ply\"\n[[mesh]]\nfile = ▸\"a.png\"\n",
        &[
            "ply files are not read by this version",
            "`scenes/a.png` is not the name of a mesh file",
        ],
    );
    // The same missing file twice is one fault.
    let twice = load(&format!("{HEAD}[[mesh]]\nfile = \"x.obj\"\n[[mesh]]\nfile = \"x.obj\"\n"));
    assert_eq!(twice.unwrap_err().0.len(), 1);
    let missing = Scene::load(Path::new("no-such.toml"), &Overrides::default()).unwrap_err();
    assert_eq!(missing.fault(), Fault::Reading);
    assert!(missing.to_string().starts_with("no-such.toml: the scene file cannot be read: "));
}

#[test]
fn light_types() {
    let errors = refused("[[light]]\ntype = ▸\"spott\"\n", &["there is no type of light `spott`"]);
    assert_eq!(help(&errors), "did you mean `spot`?");
    light_refused("type = ▸\"area\"\n", &["area lights are not simulated"]);
    light_refused(
        "type = ▸\"hemisphere\"\ndirection = [0, 1, 0]\ntop = [1, 1, 1]\nbottom = [0, 0, 0]\n",
        &["hemisphere lights are not simulated by this version"],
    );
    light_refused(
        "type = \"ambient\"\nambient = [1, 1, 1]\n▸intensity = [1, 1, 1]\n",
        &["the type `ambient` has no use for `intensity`"],
    );
    light_refused(
        "type = \"directional\"\naim = [0, -1, 0]\nintensity = [1, 1, 1]\n▸target = [0, 0, 0]\n▸attenuation = [1, 0, 0]\n",
        &[
            "the type `directional` has no use for `target`",
            "the type `directional` has no use for `attenuation`",
        ],
    );
    light_refused(
        "type = \"point\"\nposition = [0, 1, 0]\nintensity = [1, 1, 1]\n▸cutoff_deg = 5\nshadows = ▸true\n",
        &[
            "the type `point` has no use for `cutoff_deg`",
            "shadows are not simulated by this version",
        ],
    );
}

#[test]
fn light_keys() {
    let missing = |text: &str, messages: &[&str]| {
        refused(&format!("{}[[light]]\n{text}", "▸".repeat(messages.len())), messages);
    };
    missing("type = \"ambient\"\n", &["a `ambient` light lacks `ambient`"]);
    missing(
        "type = \"directional\"\n",
        &["a `directional` light lacks a colour", "a `directional` light lacks `aim`"],
    );
    missing(
        "type = \"spot\"\nintensity = [1, 1, 1]\n",
        &[
            "a `spot` light lacks `position`",
            "a `spot` light lacks `target` or `aim`",
            "a `spot` light lacks `cutoff_deg`",
        ],
    );
    light_refused(
        "type = \"spot\"\nposition = [0, 1, 0]\ntarget = [0, 0, 0]\naim = ▸[0, -1, 0]\ncutoff_deg = ▸0\n\
         exponent = ▸-1\nintensity = [1, 1, 1]\ndiffuse = ▸[1, 1, 1]\nattenuation = ▸[1, -1, 0]\n",
        &[
            "a spot has either `target` or `aim`, not both",
            "`cutoff_deg` must be greater than 0 and at most 180, not 0",
            "`exponent` must be at least 0, not -1",
            "`intensity` sets `diffuse`; a light has either, not both",
            "each number of `attenuation` must be at least 0, not -1",
        ],
    );
    light_refused(
        "type = \"spot\"\nposition = [0, 1, 0]\ntarget = ▸[0, 1, 0]\ncutoff_deg = ▸180.5\n\
         intensity = ▸[1, 1, -1]\nspecular = ▸[1, 1, 1]\nattenuation = ▸[0, 0, 0]\n",
        &[
            "`target − position` is a direction and must not have length 0",
            "`cutoff_deg` must be greater than 0 and at most 180, not 180.5",
            "`intensity` must be at least 0 in every channel, not -1",
            "`intensity` sets `specular`; a light has either, not both",
            "the numbers of `attenuation` must not all be 0",
        ],
    );
    light_refused(
        "type = \"directional\"\naim = ▸[0, 0, 0]\nintensity = [1, 1, 1]\n",
        &["`aim` is a direction and must not have length 0"],
    );
}

#[test]
fn dialects_and_switches_that_are_not_simulated() {
    refused_whole(
        &format!("dialect = ▸\"angel\"\n{HEAD}"),
        &["the dialect `angel` is not simulated by this version"],
    );
    let errors =
        refused_whole(&format!("dialect = ▸\"curles\"\n{HEAD}"), &["there is no dialect `curles`"]);
    assert_eq!(help(&errors), "did you mean `curless`?");
    let errors = refused(
        "[switches]\nspecular = ▸\"phong\"\nrenormalize = ▸false\nviewer = ▸\"near\"\nka = ▸true\nnaive_normals = ▸\"no\"\n",
        &[
            "`specular = phong` is not simulated by this version",
            "`renormalize = false` is not simulated by this version",
            "`viewer` must be \"local\" or \"distant\", not \"near\"",
            "`ka` must be \"own\" or \"kd\", not true or false",
            "`naive_normals` must be true or false, not \"no\"",
        ],
    );
    assert_eq!(help(&errors), "only `blinn` is");
}

#[test]
fn effects_that_no_scene_can_have() {
    refused(
        "[▸fog]\ndensity = 1\n[[mesh]]\nshape = { plane = { size = 1 } }\n▸reflection = 1\n",
        &["`fog`: fog is not simulated", "`reflection`: reflection is not simulated"],
    );
    refused_whole(
        &HEAD.replace("fov_y_deg", "▸depth_of_field = true\nfov_y_deg"),
        &["`depth_of_field`: depth of field is not simulated; the camera is a pinhole"],
    );
}

#[test]
fn a_size_from_outside_replaces_a_look_at_cameras_size_only() {
    let overrides = Overrides { resolution: Resolution::new(8, 6) };
    let with = |text: &str| Scene::from_toml(text, Path::new(NAME), Path::new(""), &overrides);
    assert_eq!(Some(with(HEAD).unwrap().camera.resolution()), overrides.resolution);
    let head = "version = 1\n[image]\nwidth = 4\nheight = 3\n";
    let exact =
        "[camera.exact]\neye = [0, 0, 5]\nd0 = [-2, -1.5, -4]\ndx = [1, 0, 0]\ndy = [0, 1, 0]\n";
    let errors = with(&format!("{head}{exact}")).unwrap_err().0;
    assert_eq!((errors[0].place.line, errors[0].place.column), (5, 9));
    let same = head.replace("width = 4", "width = 8").replace("height = 3", "height = 6");
    assert!(with(&format!("{same}{exact}")).is_ok());
}

#[test]
fn errors_are_displayed_one_a_line_with_advice_below() {
    let errors = load(&HEAD.replace("width", "widht")).unwrap_err();
    assert_eq!(
        errors.to_string(),
        "scenes/test.toml:2:1: [image] lacks `width`\n\
         scenes/test.toml:3:1: unknown key `widht` in [image]\n  did you mean `width`?"
    );
}
