//! The lobe of a reflectance: how much light leaves a surface in each direction of the plane that
//! holds the normal and the light, and its picture, the goniometric diagram.
//!
//! One light of intensity 1 and nothing else: no ambient, no emission, no attenuation, no cone. The
//! functions are those that shade pictures. Angles are measured from the normal, in degrees; the
//! light stands at −`light_deg`, so that the mirror direction is at +`light_deg`. Sources: Curless,
//! "Shading" (goniometric diagrams); CS315, laboratory on reflectance, figures 2 and 3.

mod diagram;

pub use diagram::diagram;

use crate::color::LinearRgb;
use crate::scene::Scene;
use crate::scene::file::suggestion;
use crate::scene::material::Material;
use crate::shade::blinn_phong::blinn_specular;
use crate::shade::reflection::phong_specular;

/// The normal.
const N: [f64; 3] = [0.0, 1.0, 0.0];

/// Halvings of an interval of at most 180° until its ends are neighbours in f64.
const HALVINGS: usize = 64;

/// Whose specular lobe.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Lobe {
    /// Blinn's (N·H)_+^ns.
    #[default]
    Blinn,
    /// Phong's (R·V)_+^ns.
    Phong,
}

impl Lobe {
    /// Its word in scene files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Blinn => "blinn",
            Self::Phong => "phong",
        }
    }
}

/// What a surface does with light from one direction. Coefficients are finite and at least 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Reflectance {
    /// k_d.
    pub kd: LinearRgb,
    /// k_s.
    pub ks: LinearRgb,
    /// n_s.
    pub ns: f64,
    /// Whose lobe the specular term is.
    pub lobe: Lobe,
    /// Whether the specular term is multiplied by N·L.
    pub specular_cosine: bool,
}

/// Radiance towards one viewing angle, per channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The viewing angle, −90…90 degrees.
    pub view_deg: f64,
    /// kd·(N·L).
    pub diffuse: LinearRgb,
    /// ks times the lobe.
    pub specular: LinearRgb,
}

impl Sample {
    /// The two terms together.
    pub fn sum(&self) -> LinearRgb {
        std::array::from_fn(|channel| self.diffuse[channel] + self.specular[channel])
    }
}

/// Where the specular term is largest, and how quickly it falls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// The viewing angle of the maximum, degrees: the mirror direction.
    pub view_deg: f64,
    /// Degrees from there to half of the maximum, towards −90° and towards +90°; `None` where the
    /// surface comes first.
    pub half_width_deg: [Option<f64>; 2],
}

impl Reflectance {
    /// What the shading equation computes for one light of intensity 1 at −`light_deg`, seen from
    /// `view_deg`. Both terms are 0 where N·L ≤ 0.
    pub fn at(&self, light_deg: f64, view_deg: f64) -> Sample {
        let n_dot_l = direction(-light_deg)[1];
        if n_dot_l <= 0.0 {
            return Sample { view_deg, diffuse: [0.0; 3], specular: [0.0; 3] };
        }
        let power = self.power(light_deg, view_deg);
        let weight = if self.specular_cosine { power * n_dot_l } else { power };
        Sample {
            view_deg,
            diffuse: self.kd.map(|k| k * n_dot_l),
            specular: self.ks.map(|k| k * weight),
        }
    }

    /// The whole degrees from −90 to 90.
    pub fn samples(&self, light_deg: f64) -> Vec<Sample> {
        (-90..=90).map(|degree| self.at(light_deg, f64::from(degree))).collect()
    }

    /// The peak of the specular term; `None` where there is none: no specular coefficient, no
    /// exponent, or N·L ≤ 0.
    pub fn peak(&self, light_deg: f64) -> Option<Peak> {
        let has_lobe = self.ns > 0.0 && self.ks.iter().any(|&k| k > 0.0);
        if !has_lobe || direction(-light_deg)[1] <= 0.0 {
            return None;
        }
        let largest = self.power(light_deg, light_deg);
        let is_high = |view_deg: f64| self.power(light_deg, view_deg) >= 0.5 * largest;
        let half_width_deg = [-90.0, 90.0].map(|end| {
            if is_high(end) {
                return None;
            }
            // The lobe falls on the way from the mirror direction to the surface: halve the way.
            let (mut high, mut low) = (light_deg, end);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (high + low);
                *(if is_high(middle) { &mut high } else { &mut low }) = middle;
            }
            Some((high - light_deg).abs())
        });
        Some(Peak { view_deg: light_deg, half_width_deg })
    }

    /// The lobe alone, 0…1.
    fn power(&self, light_deg: f64, view_deg: f64) -> f64 {
        let (l, v) = (direction(-light_deg), direction(view_deg));
        match self.lobe {
            Lobe::Blinn => blinn_specular(N, l, v, self.ns),
            Lobe::Phong => phong_specular(N, l, v, self.ns),
        }
    }
}

/// The material of that name.
///
/// # Errors
/// Says that there is none, and which name was meant.
pub fn material<'s>(scene: &'s Scene, name: &str) -> Result<&'s Material, String> {
    scene.materials.iter().find(|material| material.name == name).ok_or_else(|| {
        let known: Vec<&str> = scene.materials.iter().map(|m| m.name.as_str()).collect();
        let advice = match known.is_empty() {
            true => "it has no material at all".to_owned(),
            false => suggestion(name, &known),
        };
        format!("the scene has no material `{name}`: {advice}")
    })
}

/// The unit direction at an angle from the normal; exact at multiples of 90°, so that light along
/// the surface has N·L = 0.
fn direction(degrees: f64) -> [f64; 3] {
    let [x, y] = match degrees.rem_euclid(360.0) {
        0.0 => [0.0, 1.0],
        90.0 => [1.0, 0.0],
        180.0 => [0.0, -1.0],
        270.0 => [-1.0, 0.0],
        _ => [libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians())],
    };
    [x, y, 0.0]
}
