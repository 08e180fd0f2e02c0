//! Faults of what must be there, of `[image]` and of `[camera]`.

use super::*;
use truecast::pixel::Resolution;

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
        "version = ▸\"1\"\n▸▸[image]\n▸[camera]\n",
        &[
            "`version` must be a whole number, not a string",
            "[image] lacks `width`",
            "[image] lacks `height`",
            "[camera] lacks `eye`, `target`, `up` and `fov_y_deg` (or one of [camera.exact], \
             [camera.opencv], [camera.gl])",
        ],
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
fn a_size_from_outside_replaces_a_look_at_cameras_size_only() {
    let overrides = Overrides { resolution: Resolution::new(8, 6), ..Overrides::default() };
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
