//! The frame and the camera.

use crate::pixel::{MAX_SIDE, Resolution};
use crate::scene::camera::{CameraError, PinholeCamera};
use crate::scene::file::text::{Faults, Span};
use crate::scene::file::{CameraForm, ImageFile, SceneFile};
use crate::scene::load::Overrides;
use crate::scene::sampling::SampleGrid;
use toml::Spanned;

pub(super) fn resolve(
    file: &SceneFile,
    overrides: &Overrides,
    faults: &mut Faults<'_>,
) -> Option<PinholeCamera> {
    let written = file.image.as_ref().and_then(|image| resolution(image, faults));
    let camera = file.camera.as_ref()?;
    let resolution = overrides.resolution.or(written)?;
    // Numbers in pixels are right for one size only.
    let in_pixels = matches!(camera.form, CameraForm::Exact { .. } | CameraForm::OpenCv { .. });
    if in_pixels && written.is_some_and(|written| written != resolution) {
        let message =
            "this camera's numbers belong to the size of `[image]`; no other size can be asked for";
        faults.at_with_help(
            &camera.span,
            message,
            "write a look-at camera, or `[camera.gl]`, to render at any size",
        );
        return None;
    }
    let whole = &camera.span;
    let (made, places) = match &camera.form {
        CameraForm::LookAt { eye, target, up, fov_y_deg } => (
            PinholeCamera::look_at(
                resolution,
                *eye.get_ref(),
                *target.get_ref(),
                *up.get_ref(),
                *fov_y_deg.get_ref(),
            ),
            Places {
                eye: eye.span(),
                target: target.span(),
                up: up.span(),
                fov_y_deg: fov_y_deg.span(),
            },
        ),
        CameraForm::Exact { eye, d0, dx, dy } => (
            PinholeCamera::exact(
                resolution,
                *eye.get_ref(),
                *d0.get_ref(),
                *dx.get_ref(),
                *dy.get_ref(),
            ),
            Places { eye: eye.span(), ..Places::all(whole) },
        ),
        CameraForm::OpenCv { k, r, t } => (
            PinholeCamera::opencv(resolution, *k.get_ref(), *r.get_ref(), *t.get_ref()),
            Places::all(whole),
        ),
        CameraForm::Gl { view, projection } => (
            PinholeCamera::gl(resolution, *view.get_ref(), *projection.get_ref()),
            Places::all(whole),
        ),
    };
    made.map_err(|error| faults.at(places.of(&error, whole), error.to_string())).ok()
}

/// Where the values stand that an error of the camera may be about.
struct Places {
    eye: Span,
    target: Span,
    up: Span,
    fov_y_deg: Span,
}

impl Places {
    fn all(whole: &Span) -> Self {
        let [eye, target, up, fov_y_deg] = [(); 4].map(|()| whole.clone());
        Self { eye, target, up, fov_y_deg }
    }

    fn of<'a>(&'a self, error: &CameraError, whole: &'a Span) -> &'a Span {
        match error {
            CameraError::EyeRange(_) => &self.eye,
            CameraError::NoViewDirection => &self.target,
            CameraError::UpParallel => &self.up,
            CameraError::FieldOfView(_) => &self.fov_y_deg,
            CameraError::NotFinite(_) | CameraError::Degenerate(_) | CameraError::Range => whole,
        }
    }
}

fn resolution(image: &ImageFile, faults: &mut Faults<'_>) -> Option<Resolution> {
    let width = side(&image.width, "width", faults);
    let height = side(&image.height, "height", faults);
    Resolution::new(width?, height?)
}

/// The samples per pixel: one where the file says nothing.
pub(super) fn samples(file: &SceneFile, faults: &mut Faults<'_>) -> SampleGrid {
    let Some(written) = file.image.as_ref().and_then(|image| image.samples.as_ref()) else {
        return SampleGrid::CENTRE;
    };
    let number = *written.get_ref();
    u32::try_from(number).ok().and_then(SampleGrid::new).unwrap_or_else(|| {
        let most = SampleGrid::MOST;
        let message = format!("`samples` must be a whole number from 1 to {most}, not {number}");
        faults.at(&written.span(), message);
        SampleGrid::CENTRE
    })
}

fn side(written: &Spanned<i64>, key: &str, faults: &mut Faults<'_>) -> Option<u32> {
    let number = *written.get_ref();
    let side = u32::try_from(number).ok().filter(|side| (1..=MAX_SIDE).contains(side));
    if side.is_none() {
        let message = format!("`{key}` must be a whole number from 1 to {MAX_SIDE}, not {number}");
        faults.at(&written.span(), message);
    }
    side
}
