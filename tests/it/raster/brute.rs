//! What is visible, straight from the definition: world space, integers, every triangle.
//!
//! It knows nothing of the rasterizer: no homogeneous rows, no filter, no tiles.

use dashu_int::IBig;
use dashu_ratio::RBig;
use std::cmp::Ordering;
use truecast::pixel::Pixel;
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;

/// Everything the definition says about a sample.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Answer {
    /// Nearest triangle.
    pub(crate) id: Option<u32>,
    pub(crate) crossed: u32,
    pub(crate) signed: i32,
    /// Of the nearest triangle: sgn V, tie, t and the weights at the sample.
    pub(crate) nearest: Option<Nearest>,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Nearest {
    pub(crate) volume_sign: i32,
    pub(crate) tie: bool,
    pub(crate) t: RBig,
    pub(crate) weights: [RBig; 3],
}

/// A scene in integers: lengths in units of 2^-149, directions in units of 2^-unit.
pub(crate) struct Brute {
    eye: [IBig; 3],
    d0: [IBig; 3],
    dx: [IBig; 3],
    dy: [IBig; 3],
    /// t in the camera's units = integer t · `t_unit`.
    t_unit: RBig,
    triangles: Vec<[[IBig; 3]; 3]>,
}

struct Covering {
    id: u32,
    sign: i32,
    volume: IBig,
    normal: [IBig; 3],
    edges: [IBig; 3],
}

impl Brute {
    pub(crate) fn new(scene: &Scene) -> Self {
        let camera: &PinholeCamera = &scene.camera;
        let length = |v: [f64; 3]| v.map(|c| in_units(c, -149));
        let unit = camera.exponent() - 53;
        // d(x, y) is taken at doubled coordinates, hence 2·D0.
        let direction = |v: [f64; 3]| v.map(|c| in_units(c, unit));
        let power = |e: i32| {
            let two = RBig::from(IBig::ONE << e.unsigned_abs() as usize);
            if e < 0 { RBig::ONE / two } else { two }
        };
        Self {
            eye: length(camera.eye()),
            d0: direction(camera.d0()).map(|c| c << 1),
            dx: direction(camera.dx()),
            dy: direction(camera.dy()),
            t_unit: power(-149 - unit + 1),
            triangles: scene
                .mesh
                .ids()
                .map(|id| scene.mesh.triangle(id).map(|v| length(v.map(f64::from))))
                .collect(),
        }
    }

    pub(crate) fn at(&self, pixel: Pixel) -> Answer {
        let (x2, y2) = (2 * i64::from(pixel.x) + 1, 2 * i64::from(pixel.y) + 1);
        let d: [IBig; 3] =
            std::array::from_fn(|k| &self.d0[k] + &self.dx[k] * x2 + &self.dy[k] * y2);
        let covering: Vec<Covering> =
            (0..self.triangles.len()).filter_map(|index| self.covering(index as u32, &d)).collect();
        let mut best: Option<&Covering> = None;
        for candidate in &covering {
            // Ids ascend: only a strictly nearer one replaces.
            if best.is_none_or(|best| self.order(candidate, best, &d).1 == Ordering::Less) {
                best = Some(candidate);
            }
        }
        let nearest = best.map(|best| {
            let total = dot(&best.normal, &d);
            let on_edge = best.edges.contains(&IBig::ZERO);
            let same_depth = covering.iter().any(|other| {
                other.id != best.id && self.order(other, best, &d).0 == Ordering::Equal
            });
            Nearest {
                volume_sign: best.sign,
                tie: on_edge || same_depth,
                t: RBig::from(best.volume.clone()) / RBig::from(total.clone()) * &self.t_unit,
                weights: best.edges.clone().map(|w| RBig::from(w) / RBig::from(total.clone())),
            }
        });
        Answer {
            id: best.map(|best| best.id),
            crossed: covering.len() as u32,
            signed: covering.iter().map(|c| c.sign).sum(),
            nearest,
        }
    }

    fn covering(&self, id: u32, d: &[IBig; 3]) -> Option<Covering> {
        let a = self.triangles[id as usize].clone().map(|v| subtract(&v, &self.eye));
        let c = [cross(&a[1], &a[2]), cross(&a[2], &a[0]), cross(&a[0], &a[1])];
        let volume = dot(&a[0], &c[0]);
        let sign = sign_of(&volume);
        if sign == 0 || c.iter().any(|c| self.moved_sign(c, d) != sign) {
            return None;
        }
        let normal: [IBig; 3] = std::array::from_fn(|k| &c[0][k] + &c[1][k] + &c[2][k]);
        Some(Covering { id, sign, volume, normal, edges: c.map(|c| dot(&c, d)) })
    }

    /// Sign of c·d with the sample moved by (+ε, +ε²).
    fn moved_sign(&self, c: &[IBig; 3], d: &[IBig; 3]) -> i32 {
        [dot(c, d), dot(c, &self.dx), dot(c, &self.dy)]
            .iter()
            .map(sign_of)
            .find(|&s| s != 0)
            .unwrap_or(0)
    }

    /// Order of two covering triangles at the sample itself, and moved.
    fn order(&self, a: &Covering, b: &Covering, d: &[IBig; 3]) -> (Ordering, Ordering) {
        // Normalised by sgn V on both sides: V' = sgn V·V and n' = sgn V·n.
        let sign = IBig::from(a.sign * b.sign);
        let g: [IBig; 3] =
            std::array::from_fn(|k| (&a.volume * &b.normal[k] - &b.volume * &a.normal[k]) * &sign);
        (sign_of(&dot(&g, d)).cmp(&0), self.moved_sign(&g, d).cmp(&0))
    }
}

/// A number that is a multiple of 2^unit, as an integer.
fn in_units(value: f64, unit: i32) -> IBig {
    let bits = value.to_bits();
    let biased = ((bits >> 52) & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let (mantissa, exponent) =
        if biased == 0 { (fraction, -1074) } else { (fraction | 1 << 52, biased - 1075) };
    let signed = IBig::from(if value < 0.0 { -mantissa } else { mantissa });
    if exponent >= unit {
        signed << (exponent - unit) as usize
    } else {
        let cut = (unit - exponent) as usize;
        let result = &signed >> cut;
        assert_eq!(&result << cut, signed, "{value:e} is no multiple of 2^{unit}");
        result
    }
}

fn sign_of(value: &IBig) -> i32 {
    match value.cmp(&IBig::ZERO) {
        Ordering::Less => -1,
        Ordering::Equal => 0,
        Ordering::Greater => 1,
    }
}

fn dot(a: &[IBig; 3], b: &[IBig; 3]) -> IBig {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn subtract(a: &[IBig; 3], b: &[IBig; 3]) -> [IBig; 3] {
    std::array::from_fn(|k| &a[k] - &b[k])
}

fn cross(a: &[IBig; 3], b: &[IBig; 3]) -> [IBig; 3] {
    [&a[1] * &b[2] - &a[2] * &b[1], &a[2] * &b[0] - &a[0] * &b[2], &a[0] * &b[1] - &a[1] * &b[0]]
}
