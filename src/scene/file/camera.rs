//! `[image]` and `[camera]` as written.

use super::keys::Keys;
use super::text::{Faults, Span};
use super::values::{matrix, number, numbers, whole};
use toml::Spanned;

/// `[image]`.
#[derive(Clone, Debug)]
pub struct ImageFile {
    /// Columns, in pixels.
    pub width: Spanned<i64>,
    /// Rows, in pixels.
    pub height: Spanned<i64>,
    /// Radiance where nothing is visible.
    pub background: Option<Spanned<[f64; 3]>>,
    /// Sub-pixel samples per axis.
    pub samples: Option<Spanned<i64>>,
}

impl ImageFile {
    pub(super) fn read(mut keys: Keys<'_, '_>, faults: &mut Faults<'_>) -> Option<Self> {
        let width = keys.require("width", whole, faults);
        let height = keys.require("height", whole, faults);
        let background = keys.read("background", numbers, faults);
        let samples = keys.read("samples", whole, faults);
        if !keys.close(faults) {
            return None;
        }
        Some(Self { width: width?, height: height?, background, samples })
    }
}

/// `[camera]`, in one of its four forms, and where that form begins.
#[derive(Clone, Debug)]
pub struct CameraFile {
    /// The form and its numbers.
    pub form: CameraForm,
    /// Bytes of the text at which the form begins.
    pub span: Span,
}

/// The four ways of writing a camera.
#[derive(Clone, Debug)]
pub enum CameraForm {
    /// `[camera]` with an eye and a target.
    LookAt {
        /// Where the camera is.
        eye: Spanned<[f64; 3]>,
        /// What is in the middle of the image.
        target: Spanned<[f64; 3]>,
        /// What points upwards in the image.
        up: Spanned<[f64; 3]>,
        /// Full vertical angle of view, degrees.
        fov_y_deg: Spanned<f64>,
    },
    /// `[camera.exact]`: the lattice numbers themselves.
    Exact {
        /// Where the camera is.
        eye: Spanned<[f64; 3]>,
        /// Direction of the top left corner of the frame.
        d0: Spanned<[f64; 3]>,
        /// Step of the direction per column.
        dx: Spanned<[f64; 3]>,
        /// Step of the direction per row.
        dy: Spanned<[f64; 3]>,
    },
    /// `[camera.opencv]`: intrinsic matrix, rotation and translation.
    OpenCv {
        /// Intrinsic matrix, row by row.
        k: Spanned<[[f64; 3]; 3]>,
        /// Rotation, row by row.
        r: Spanned<[[f64; 3]; 3]>,
        /// Translation.
        t: Spanned<[f64; 3]>,
    },
    /// `[camera.gl]`: view and projection matrices.
    Gl {
        /// View matrix, row by row.
        view: Spanned<[[f64; 4]; 4]>,
        /// Projection matrix, row by row.
        projection: Spanned<[[f64; 4]; 4]>,
    },
}

const LOOK_AT: [&str; 4] = ["eye", "target", "up", "fov_y_deg"];

impl CameraFile {
    pub(super) fn read(mut keys: Keys<'_, '_>, faults: &mut Faults<'_>) -> Option<Self> {
        let exact = keys.table("exact", "[camera.exact]", faults);
        let opencv = keys.table("opencv", "[camera.opencv]", faults);
        let gl = keys.table("gl", "[camera.gl]", faults);

        // Name the forms that are begun: a look-at camera by any of its keys.
        let written = keys.written();
        let mut forms: Vec<(&str, Span)> = written
            .iter()
            .filter(|key| ["exact", "opencv", "gl"].contains(&key.get_ref().as_str()))
            .map(|key| (key.get_ref().as_str(), key.span()))
            .collect();
        let look_at = written.iter().find(|key| LOOK_AT.contains(&key.get_ref().as_str()));
        if let Some(key) = look_at {
            forms.push(("look-at", key.span()));
        }
        forms.sort_by_key(|(_, span)| span.start);
        match &forms[..] {
            [] => {
                let message = "[camera] lacks `eye`, `target`, `up` and `fov_y_deg` (or one of \
                               [camera.exact], [camera.opencv], [camera.gl])";
                keys.fault(&keys.header.clone(), message, faults);
            }
            [_] => {}
            [(first, _), (second, span), ..] => {
                let message = format!("the camera is written twice: as {first} and as {second}");
                keys.fault(span, message, faults);
            }
        }

        // Read every form that is begun, so that each fault of it is reported.
        let header = keys.header.clone();
        let look_at = if look_at.is_some() {
            let eye = keys.require("eye", numbers, faults);
            let target = keys.require("target", numbers, faults);
            let up = keys.require("up", numbers, faults);
            let fov_y_deg = keys.require("fov_y_deg", number, faults);
            look_at_form(eye, target, up, fov_y_deg)
        } else {
            for name in LOOK_AT {
                keys.ask(name);
            }
            None
        };
        let span = forms.first().map_or(header, |(_, span)| span.clone());
        let exact = exact.and_then(|keys| exact_form(keys, faults));
        let opencv = opencv.and_then(|keys| opencv_form(keys, faults));
        let gl = gl.and_then(|keys| gl_form(keys, faults));
        if !keys.close(faults) {
            return None;
        }
        Some(Self { form: look_at.or(exact).or(opencv).or(gl)?, span })
    }
}

fn look_at_form(
    eye: Option<Spanned<[f64; 3]>>,
    target: Option<Spanned<[f64; 3]>>,
    up: Option<Spanned<[f64; 3]>>,
    fov_y_deg: Option<Spanned<f64>>,
) -> Option<CameraForm> {
    Some(CameraForm::LookAt { eye: eye?, target: target?, up: up?, fov_y_deg: fov_y_deg? })
}

fn exact_form(mut keys: Keys<'_, '_>, faults: &mut Faults<'_>) -> Option<CameraForm> {
    let eye = keys.require("eye", numbers, faults);
    let d0 = keys.require("d0", numbers, faults);
    let dx = keys.require("dx", numbers, faults);
    let dy = keys.require("dy", numbers, faults);
    if !keys.close(faults) {
        return None;
    }
    Some(CameraForm::Exact { eye: eye?, d0: d0?, dx: dx?, dy: dy? })
}

fn opencv_form(mut keys: Keys<'_, '_>, faults: &mut Faults<'_>) -> Option<CameraForm> {
    let k = keys.require("K", matrix, faults);
    let r = keys.require("R", matrix, faults);
    let t = keys.require("t", numbers, faults);
    if !keys.close(faults) {
        return None;
    }
    Some(CameraForm::OpenCv { k: k?, r: r?, t: t? })
}

fn gl_form(mut keys: Keys<'_, '_>, faults: &mut Faults<'_>) -> Option<CameraForm> {
    let view = keys.require("view", matrix, faults);
    let projection = keys.require("projection", matrix, faults);
    if !keys.close(faults) {
        return None;
    }
    Some(CameraForm::Gl { view: view?, projection: projection? })
}
