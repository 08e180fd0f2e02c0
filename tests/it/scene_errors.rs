//! Every fault of a scene file is named, with its exact place. In the texts below `▸` stands right
//! before the character at which a fault is expected, and is not part of the text.

mod frame;
mod lights;
mod meshes;
mod numbers;

use lights::light_refused;
use meshes::mesh_refused;
use std::path::Path;
use truecast::scene::error::SceneError;
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
    // The misspelt key is the missing one: one fault, not two.
    let fov = HEAD.replace("fov_y_deg", "▸fov");
    let errors = refused_whole(&fov, &["unknown key `fov` in [camera]"]);
    assert_eq!(help(&errors), "did you mean `fov_y_deg`?");
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
        "[[mesh]]\nshape = { box = { size = [1, ▸inf, 1] } }\n",
        &["`size` must be a finite number, not inf"],
    );
}

#[test]
fn errors_are_displayed_one_a_line_with_advice_below() {
    let errors = load(&HEAD.replace("width", "depth")).unwrap_err();
    assert_eq!(
        errors.to_string(),
        "scenes/test.toml:2:1: [image] lacks `width`\n\
         scenes/test.toml:3:1: unknown key `depth` in [image]\n  \
         known here: width, height, background, samples"
    );
}

/// A text with everything in it that a scene without files can have.
const FULL: &str = "[[material]]\nname = \"m\"\nkd = [1, 1, 1]\nns = 3\nopacity = 1\n\
    [[mesh]]\nshape = { plane = { width = 1 } }\nmaterial = \"m\"\nsides = \"double\"\n\
    scale = 2\nrotate_deg = [1, 2, 3]\ntranslate = [1, 2, 3]\n\
    [[mesh]]\nshape = { plane = {} }\n\
    matrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\n\
    [[light]]\ntype = \"spot\"\nposition = [0, 1, 0]\naim = [0, -1, 0]\ncutoff_deg = 20\n\
    exponent = 2\nattenuation = [1, 0, 0]\nintensity = [1, 1, 1]\nambient = [0, 0, 0]\n\
    [switches]\nka = \"own\"\nrenormalize = true\n";

#[test]
fn no_text_panics_and_every_fault_has_a_place() {
    let full = format!("{HEAD}{FULL}");
    assert!(load(&full).is_ok());
    // Cut the text anywhere.
    for end in 0..full.len() {
        drop(load(&full[..end]));
    }
    // Put strange values everywhere.
    let values = [
        "nan",
        "-1",
        "1e999",
        "1e308",
        "-5e-324",
        "99999999999999999999",
        "true",
        "\"ä\"",
        "1979-05-27",
        "[]",
        "{}",
        "[1, 2]",
        "[0, 0, 0]",
        "[1e308, -1e308, 1e308]",
        "[[1], 2]",
        "[{ a = 1 }]",
        "{ a = { b = 1 } }",
    ];
    for (line, written) in full.lines().enumerate() {
        let Some((key, _)) = written.split_once(" = ") else { continue };
        for value in values {
            let mut lines: Vec<&str> = full.lines().collect();
            let strange = format!("{key} = {value}");
            lines[line] = &strange;
            if let Err(errors) = load(&lines.join("\n")) {
                for error in &errors.0 {
                    assert!(error.place.line > 0 && error.place.column > 0, "{strange}: {error}");
                }
            }
        }
    }
}
