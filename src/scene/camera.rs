//! The pinhole camera: numbers on a lattice, and the four ways of writing them.
//!
//! A camera is an eye `e` and three vectors; the ray of the point (x, y) of the image plane is
//! `e + t·d`, t > 0, with `d(x, y) = D0 + x·DX + y·DY`, x to the right, y downwards, in pixels.
//! The vectors lie on a lattice on which `d` has no rounding in f64 for any sample on the 1/256
//! pixel grid; so the rounded camera *is* the camera, and every reader of it speaks of the same
//! ray. No ray is set up and no point is projected here: each visibility path does so itself.

use super::lattice::{self, power_of_two};
use crate::pixel::Resolution;

/// Why numbers do not make a camera.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CameraError {
    /// A number is NaN or infinite.
    #[error("`{0}` must be finite numbers")]
    NotFinite(&'static str),
    /// An eye component is outside the range in which all predicates are exact.
    #[error(
        "each component of the eye must be 0 or between 2^-96 (1.3e-29) and 2^126 (8.5e37) in magnitude, not {0:e}"
    )]
    EyeRange(f64),
    /// Eye and target coincide.
    #[error("`eye` and `target` are the same point")]
    NoViewDirection,
    /// The up vector is zero or parallel to the view direction.
    #[error("`up` must not be zero or parallel to the view direction")]
    UpParallel,
    /// The field of view is not inside (0°, 180°).
    #[error("`fov_y_deg` must be greater than 0 and less than 180, not {0}")]
    FieldOfView(f64),
    /// The three lattice vectors lie in one plane: no image, or an orthographic one.
    #[error("the image plane passes through the eye: {0}")]
    Degenerate(&'static str),
    /// The lattice vectors are too large or too small to work with.
    #[error("the camera's vectors must lie between 2^-300 and 2^300 in magnitude")]
    Range,
}

/// A pinhole camera on its lattice.
#[derive(Clone, Debug, PartialEq)]
pub struct PinholeCamera {
    resolution: Resolution,
    eye: [f64; 3],
    d0: [f64; 3],
    dx: [f64; 3],
    dy: [f64; 3],
    axis: [f64; 3],
    z_per_t: f64,
    exponent: i32,
    deviation_pixels: f64,
}

impl PinholeCamera {
    /// A camera at `eye` that looks at `target`: full vertical angle of view in degrees, square
    /// pixels, the image's up in the plane of the view direction and `up`.
    ///
    /// # Errors
    /// [`CameraError`] for every geometry that is no camera.
    pub fn look_at(
        resolution: Resolution,
        eye: [f64; 3],
        target: [f64; 3],
        up: [f64; 3],
        fov_y_deg: f64,
    ) -> Result<Self, CameraError> {
        finite("target", &target)?;
        finite("up", &up)?;
        check_eye(eye)?;
        if !(fov_y_deg > 0.0 && fov_y_deg < 180.0) {
            return Err(CameraError::FieldOfView(fov_y_deg));
        }
        // Build the right-handed frame: f forwards, r to the right, u upwards.
        let f = unit(sub(target, eye)).ok_or(CameraError::NoViewDirection)?;
        let up = unit(up).ok_or(CameraError::UpParallel)?;
        let sideways = cross(f, up);
        // Below 1e-12 the direction of f × up is rounding noise of the two unit vectors.
        if length(sideways) < 1e-12 {
            return Err(CameraError::UpParallel);
        }
        let r = unit(sideways).ok_or(CameraError::UpParallel)?;
        let u = cross(r, f);
        // Span the image plane at distance 1: k is the side of a pixel there.
        let (width, height) = (f64::from(resolution.width()), f64::from(resolution.height()));
        let k = 2.0 * libm::tan(fov_y_deg.to_radians() / 2.0) / height;
        let dx = scaled(r, k);
        let dy = scaled(u, -k);
        let d0 = sub(sub(f, scaled(dx, width / 2.0)), scaled(dy, height / 2.0));
        let mut camera = Self::exact(resolution, eye, d0, dx, dy)?;
        // The plane of a look-at camera is at distance 1, so depth is the ray parameter itself.
        camera.z_per_t = 1.0;
        Ok(camera)
    }

    /// A camera from its lattice numbers. Numbers that lie on the lattice are kept bit for bit,
    /// others are put on it; [`Self::deviation_pixels`] tells how far that moved the image.
    ///
    /// # Errors
    /// [`CameraError`] when a number is not finite or out of range, or the vectors lie in a plane.
    pub fn exact(
        resolution: Resolution,
        eye: [f64; 3],
        d0: [f64; 3],
        dx: [f64; 3],
        dy: [f64; 3],
    ) -> Result<Self, CameraError> {
        check_eye(eye)?;
        for (name, vector) in [("d0", &d0), ("dx", &dx), ("dy", &dy)] {
            finite(name, vector)?;
        }
        let lattice =
            lattice::put_on_lattice(resolution, [d0, dx, dy]).ok_or(CameraError::Range)?;
        let [l0, lx, ly] = lattice.vectors;
        if lattice::determinant_sign([lx, ly, l0], lattice.exponent) == 0 {
            return Err(CameraError::Degenerate("d0, dx and dy lie in one plane"));
        }
        // Orient the view axis so that d · axis > 0; the value is the same for every sample.
        let mut axis =
            unit(cross(lx, ly)).ok_or(CameraError::Degenerate("dx and dy are parallel"))?;
        let mut z_per_t = dot(l0, axis);
        if z_per_t < 0.0 {
            axis = axis.map(|c| -c);
            z_per_t = -z_per_t;
        }
        let deviation_pixels = lattice::deviation_pixels(resolution, [d0, dx, dy], lattice.vectors);
        Ok(Self {
            resolution,
            eye: eye.map(|c| c + 0.0),
            d0: l0,
            dx: lx,
            dy: ly,
            axis,
            z_per_t,
            exponent: lattice.exponent,
            deviation_pixels,
        })
    }

    /// A camera from OpenCV's numbers: `K` the 3×3 intrinsic matrix, `R` and `t` the extrinsic
    /// ones (`x_camera = R·x_world + t`), all row by row. The centre of pixel (i, j) is the point
    /// (i + ½, j + ½) of `K`'s image plane.
    ///
    /// # Errors
    /// [`CameraError`] when `K·R` is singular or a number is not finite or out of range.
    pub fn opencv(
        resolution: Resolution,
        k: [[f64; 3]; 3],
        r: [[f64; 3]; 3],
        t: [f64; 3],
    ) -> Result<Self, CameraError> {
        for (name, rows) in [("K", &k), ("R", &r)] {
            rows.iter().try_for_each(|row| finite(name, row))?;
        }
        finite("t", &t)?;
        let m = std::array::from_fn(|i| {
            std::array::from_fn(|j| k[i][0] * r[0][j] + k[i][1] * r[1][j] + k[i][2] * r[2][j])
        });
        let p = std::array::from_fn(|i| dot(k[i], t));
        Self::projective(resolution, m, p, "K·R is singular")
    }

    /// A camera from OpenGL's 4×4 view and projection matrices, row by row, column vectors:
    /// `clip = projection · view · (x, 1)`; the frame is NDC −1…1, y upwards.
    ///
    /// # Errors
    /// [`CameraError`] for an orthographic or singular projection, or numbers out of range.
    pub fn gl(
        resolution: Resolution,
        view: [[f64; 4]; 4],
        projection: [[f64; 4]; 4],
    ) -> Result<Self, CameraError> {
        for (name, rows) in [("view", &view), ("projection", &projection)] {
            rows.iter().try_for_each(|row| finite(name, row))?;
        }
        let clip: [[f64; 4]; 4] = std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..4).map(|k| projection[i][k] * view[k][j]).sum())
        });
        // Viewport: column = (x/w + 1)·W/2, row = (1 − y/w)·H/2.
        let (w2, h2) = (f64::from(resolution.width()) / 2.0, f64::from(resolution.height()) / 2.0);
        let rows: [[f64; 4]; 3] = [
            std::array::from_fn(|j| w2 * (clip[0][j] + clip[3][j])),
            std::array::from_fn(|j| h2 * (clip[3][j] - clip[1][j])),
            clip[3],
        ];
        let m = rows.map(|row| [row[0], row[1], row[2]]);
        let p = rows.map(|row| row[3]);
        Self::projective(
            resolution,
            m,
            p,
            "projection · view has no eye (orthographic or singular)",
        )
    }

    /// A camera from `(column·w, row·w, w) = M·x + p`: eye −M⁻¹p, directions M⁻¹·(x, y, 1).
    fn projective(
        resolution: Resolution,
        m: [[f64; 3]; 3],
        p: [f64; 3],
        singular: &'static str,
    ) -> Result<Self, CameraError> {
        let cofactors = [cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])];
        let determinant = dot(m[0], cofactors[0]);
        if determinant == 0.0 || !determinant.is_finite() {
            return Err(CameraError::Degenerate(singular));
        }
        let [dx, dy, d0] = cofactors.map(|column| column.map(|c| c / determinant));
        let eye = std::array::from_fn(|i| -(dx[i] * p[0] + dy[i] * p[1] + d0[i] * p[2]));
        Self::exact(resolution, flush_noise(eye), d0, dx, dy)
    }

    /// This camera with every pixel's sample moved by `steps` (columns, rows) of 1/256 pixel, each
    /// −128…128: its sample of pixel (i, j) is the point (i + ½ + a, j + ½ + b) of this camera's
    /// image plane, a = `steps[0]`/256, b = `steps[1]`/256. The same E and nothing rounded.
    ///
    /// D0 + a·DX + b·DY is a sum of multiples of q0 of magnitude at most |D0| + |DX|/2 + |DY|/2 ≤
    /// M ≤ 2^53·q0, so it is an f64; every moved sample lies inside the frame, so its direction is
    /// one of the exact ones of the lattice.
    ///
    /// # Panics
    /// When a step is outside −128…128: the sample would leave its pixel.
    pub fn shifted(&self, steps: [i32; 2]) -> Self {
        assert!(steps.iter().all(|step| step.abs() <= 128), "{steps:?} leaves the pixel");
        let [a, b] = steps.map(|step| f64::from(step) / f64::from(1 << lattice::SUBPIXEL_BITS));
        let d0 = std::array::from_fn(|k| self.d0[k] + a * self.dx[k] + b * self.dy[k]);
        Self { d0, ..self.clone() }
    }

    /// Size of the full frame.
    pub fn resolution(&self) -> Resolution {
        self.resolution
    }

    /// The eye: each component 0 or 2^-96…2^126 in magnitude, never −0.
    pub fn eye(&self) -> [f64; 3] {
        self.eye
    }

    /// Direction at the image plane's origin, the top left corner of the frame.
    pub fn d0(&self) -> [f64; 3] {
        self.d0
    }

    /// Step of the direction per column, to the right.
    pub fn dx(&self) -> [f64; 3] {
        self.dx
    }

    /// Step of the direction per row, downwards.
    pub fn dy(&self) -> [f64; 3] {
        self.dy
    }

    /// Unit view axis, ± DX × DY, oriented so that every ray advances along it.
    pub fn axis(&self) -> [f64; 3] {
        self.axis
    }

    /// Depth along the view axis per unit of ray parameter, d · axis; one value for all samples,
    /// and exactly 1 for a look-at camera.
    pub fn z_per_t(&self) -> f64 {
        self.z_per_t
    }

    /// E of the lattice: `|D0| + W·|DX| + H·|DY| ≤ 2^E` per component, D0 is a multiple of
    /// 2^(E−53), and DX and DY are multiples of 2^(E−45).
    pub fn exponent(&self) -> i32 {
        self.exponent
    }

    /// How far the lattice moved the image from the numbers that were asked for, in pixels
    /// (0 where they lay on the lattice).
    pub fn deviation_pixels(&self) -> f64 {
        self.deviation_pixels
    }
}

fn finite(name: &'static str, values: &[f64]) -> Result<(), CameraError> {
    if values.iter().all(|v| v.is_finite()) { Ok(()) } else { Err(CameraError::NotFinite(name)) }
}

/// The eye's range keeps it a multiple of 2^-149, as every f32 is: the exact arithmetic of both
/// paths then neither over- nor underflows.
fn check_eye(eye: [f64; 3]) -> Result<(), CameraError> {
    finite("eye", &eye)?;
    match eye
        .iter()
        .find(|c| c.abs() > power_of_two(126) || (**c != 0.0 && c.abs() < power_of_two(-96)))
    {
        Some(&component) => Err(CameraError::EyeRange(component)),
        None => Ok(()),
    }
}

/// An eye that comes out of a matrix inverse holds rounding noise where it should hold 0:
/// components below 2^-96 are far beneath the inverse's own error and become 0.
fn flush_noise(eye: [f64; 3]) -> [f64; 3] {
    eye.map(|c| if c.abs() < power_of_two(-96) { 0.0 } else { c })
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn scaled(a: [f64; 3], k: f64) -> [f64; 3] {
    a.map(|c| c * k)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// The unit vector along `a`, divided by its largest component first so that no square leaves the
/// range; `None` for the zero vector.
pub(super) fn unit(a: [f64; 3]) -> Option<[f64; 3]> {
    let largest = a.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return None;
    }
    let a = a.map(|c| c / largest);
    Some(scaled(a, 1.0 / length(a)))
}

#[cfg(test)]
#[path = "camera_tests.rs"]
mod tests;
