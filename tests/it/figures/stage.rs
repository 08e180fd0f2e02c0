//! Cells of sheets and changed scenes, rendered to numbers.

use std::fs;
use std::path::{Path, PathBuf};
use truecast::film::Samples;
use truecast::render::{PlaneGroup, PlaneGroups, RenderOptions, Unwatched, render};
use truecast::scene::{Overrides, Scene};
use truecast::sheet::Sheet;

pub(super) type V3 = [f64; 3];

/// The folder of the scenes that come with the project.
pub(super) fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")
}

/// A sheet by its name.
pub(super) fn sheet(name: &str) -> Sheet {
    Sheet::load(&scenes().join("sheets").join(format!("{name}.toml")))
        .unwrap_or_else(|errors| panic!("{errors}"))
}

/// A scene by its path in the folder of scenes, with pieces of its text replaced, each of which
/// stands there exactly once.
pub(super) fn changed(path: &str, changes: &[(&str, &str)]) -> Scene {
    let path = scenes().join(path);
    let mut text = fs::read_to_string(&path).unwrap();
    for (old, new) in changes {
        assert_eq!(text.matches(old).count(), 1, "{old:?} in {}", path.display());
        text = text.replace(old, new);
    }
    Scene::from_toml(&text, &path, path.parent().unwrap(), &Overrides::default())
        .unwrap_or_else(|errors| panic!("{errors}"))
}

/// What a picture holds, row by row.
pub(super) struct Picture {
    pub(super) width: usize,
    /// Linear radiance.
    pub(super) rgb: Vec<V3>,
    /// Number of the object that is seen.
    pub(super) objects: Vec<Option<usize>>,
    /// The unit normal that shading used.
    pub(super) normals: Vec<V3>,
}

impl Picture {
    pub(super) fn of(scene: &Scene) -> Self {
        let groups = [PlaneGroup::Color, PlaneGroup::Identity, PlaneGroup::ShadingNormal];
        let planes = groups.into_iter().fold(PlaneGroups::default(), PlaneGroups::with);
        let film =
            render(scene, &RenderOptions { planes, ..RenderOptions::default() }, &Unwatched).film;
        let vectors = |names: [&str; 3]| -> Vec<V3> {
            let planes = names.map(|name| match film.plane(name) {
                Some(Samples::Float(values)) => values,
                other => panic!("{name}: {other:?}"),
            });
            let count = planes[0].len();
            (0..count).map(|pixel| planes.map(|plane| f64::from(plane[pixel]))).collect()
        };
        let Some(Samples::Uint(ids)) = film.plane("id.object") else { panic!("no objects") };
        Self {
            width: film.window.width() as usize,
            rgb: vectors(["R", "G", "B"]),
            objects: ids.iter().map(|&id| (id != u32::MAX).then_some(id as usize)).collect(),
            normals: vectors(["Ns.X", "Ns.Y", "Ns.Z"]),
        }
    }

    /// Pixels at which the object is seen.
    pub(super) fn pixels_of(&self, object: usize) -> impl Iterator<Item = usize> {
        let objects = self.objects.iter().enumerate();
        objects.filter(move |(_, seen)| **seen == Some(object)).map(|(pixel, _)| pixel)
    }

    /// Root mean square of the difference of all channels, over the pixels at which both show the
    /// same object and, if one is named, that one.
    pub(super) fn difference(&self, other: &Self, object: Option<usize>) -> f64 {
        let (mut sum, mut count) = (0.0, 0);
        for pixel in 0..self.rgb.len() {
            let seen = self.objects[pixel];
            if seen.is_some()
                && seen == other.objects[pixel]
                && (object.is_none() || seen == object)
            {
                sum +=
                    (0..3).map(|k| (self.rgb[pixel][k] - other.rgb[pixel][k]).powi(2)).sum::<f64>();
                count += 3;
            }
        }
        assert!(count > 3000, "enough pixels in common: {count}");
        (sum / f64::from(count)).sqrt()
    }

    /// Mean of all channels over some pixels.
    pub(super) fn mean(&self, pixels: impl Iterator<Item = usize>) -> f64 {
        let values: Vec<f64> = pixels.flat_map(|pixel| self.rgb[pixel]).collect();
        assert!(!values.is_empty());
        values.iter().sum::<f64>() / values.len() as f64
    }
}

pub(super) fn dot(a: V3, b: V3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: V3, b: V3) -> V3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn minus(a: V3, b: V3) -> V3 {
    std::array::from_fn(|k| a[k] - b[k])
}

pub(super) fn unit(a: V3) -> V3 {
    let length = dot(a, a).sqrt();
    a.map(|c| c / length)
}

/// Halfway between two unit vectors.
pub(super) fn halfway(a: V3, b: V3) -> V3 {
    unit(std::array::from_fn(|k| a[k] + b[k]))
}

/// The angle between two unit vectors, in degrees.
pub(super) fn angle_deg(a: V3, b: V3) -> f64 {
    dot(a, b).clamp(-1.0, 1.0).acos().to_degrees()
}
