//! One triangle, one camera, some lights, chosen by a fixed sequence; what the shaders are given of
//! them. The scene file that says the same is written in `scene_text`.

use super::super::stage::{V3, cross, dot};
use super::gl::{self, Mat4, normalize, sub};
use crate::support::rays::Random;

/// What each vertex has.
#[derive(Clone, Copy)]
pub(super) struct Attributes {
    pub(super) position: V3,
    pub(super) normal: V3,
    pub(super) color: V3,
}

/// A light in eye space; w of the position is 0 for a direction towards the light.
pub(super) struct Light {
    pub(super) position: [f64; 4],
    pub(super) ambient: V3,
    pub(super) diffuse: V3,
    pub(super) specular: V3,
    pub(super) attenuation: V3,
    pub(super) spot: Option<Spot>,
}

pub(super) struct Spot {
    pub(super) aim: V3,
    pub(super) cutoff_deg: f64,
    pub(super) exponent: f64,
}

impl Light {
    pub(super) fn xyz(&self) -> V3 {
        let [x, y, z, _] = self.position;
        [x, y, z]
    }
}

pub(super) struct Material {
    pub(super) emission: V3,
    pub(super) ambient: V3,
    pub(super) diffuse: V3,
    pub(super) specular: V3,
    pub(super) shininess: f64,
}

pub(super) struct Uniforms {
    pub(super) model_view: Mat4,
    pub(super) lights: Vec<Light>,
    pub(super) material: Material,
}

/// Which lights a shader knows.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Lights {
    /// None.
    None,
    /// One at a position, of constant attenuation.
    OnePoint,
    /// One, at a position or infinitely far away.
    One,
    /// One to four, at positions or infinitely far away.
    Several,
    /// One to four, some of them spotlights.
    Spots,
    /// One around everything: ambient colour on top, diffuse colour at the bottom.
    Around,
}

/// What is drawn.
pub(super) struct Configuration {
    pub(super) model: Mat4,
    pub(super) attributes: [Attributes; 3],
    pub(super) eye: V3,
    pub(super) target: V3,
    pub(super) up: V3,
    pub(super) fov_y_deg: f64,
    pub(super) uniforms: Uniforms,
    pub(super) lights: Lights,
}

const IDENTITY: Mat4 =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

/// A multiple of 2^-8 in −reach…reach: with a transform of sixteenths below 4 the product is a
/// number of f32, so that the renderer's rounding of positions changes nothing.
fn coordinate(random: &mut Random, reach: f64) -> f64 {
    ((2.0 * random.unit() - 1.0) * reach * 256.0).round() / 256.0
}

fn vector(random: &mut Random, reach: f64) -> V3 {
    std::array::from_fn(|_| coordinate(random, reach))
}

fn color(random: &mut Random) -> V3 {
    std::array::from_fn(|_| random.step())
}

fn determinant(m: &Mat4) -> f64 {
    let row = |i: usize| [m[i][0], m[i][1], m[i][2]];
    dot(row(0), cross(row(1), row(2)))
}

impl Configuration {
    /// The configuration of a round: one round in four has lights exactly in the plane of a
    /// triangle whose normals stand on it (N·L = 0), one in four beside that plane by 2^-6 … 2^-20
    /// on either side, and the others are random. ns is 0, 1, 10 or 100.
    pub(super) fn of(
        round: usize,
        lights: Lights,
        moves_normals: bool,
        random: &mut Random,
    ) -> Self {
        let material = Material {
            emission: [0.0; 3],
            ambient: color(random),
            diffuse: color(random),
            specular: color(random),
            shininess: [0.0, 1.0, 10.0, 100.0][random.below(4)],
        };
        let uniforms = Uniforms { model_view: IDENTITY, lights: Vec::new(), material };
        let attributes: [Attributes; 3] = std::array::from_fn(|_| Attributes {
            position: vector(random, 3.0),
            normal: [0.0, 0.0, 1.0],
            color: color(random),
        });
        let mut configuration = Self {
            model: IDENTITY,
            attributes,
            eye: [0.0; 3],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            fov_y_deg: 30.0 + 40.0 * random.step(),
            uniforms,
            lights,
        };
        match round % 4 {
            0 => configuration.stand_up(None, random),
            1 => {
                let beside = 2.0_f64.powi(-6 - random.below(15) as i32);
                let side = if random.below(2) == 0 { beside } else { -beside };
                configuration.stand_up(Some(side), random);
            }
            _ => configuration.scatter(moves_normals, random),
        }
        configuration
    }

    /// Everything in a frame along the axes: the triangle in a plane z = constant with its normals
    /// towards +z or −z, the lights in that plane or `beside` it.
    fn stand_up(&mut self, beside: Option<f64>, random: &mut Random) {
        let z = coordinate(random, 3.0);
        let north = if random.below(4) == 0 { -1.0 } else { 1.0 };
        for attribute in &mut self.attributes {
            attribute.position[2] = z;
            attribute.normal = [0.0, 0.0, north];
        }
        let [x, y, _] = self.centre();
        let [x, y] = [x, y].map(|c| (c * 16.0).round() / 16.0);
        self.eye = [x + coordinate(random, 1.0), y + coordinate(random, 1.0), z + 8.0];
        self.target = [self.eye[0], self.eye[1], 0.0];
        let height = beside.unwrap_or(0.0);
        for _ in 0..self.count(random) {
            let mut light = self.light(random);
            // Eye space; the plane is 8 units before the eye.
            light.position[2] = if light.position[3] == 0.0 { height } else { height - 8.0 };
            self.uniforms.lights.push(light);
        }
    }

    /// Anything anywhere.
    fn scatter(&mut self, moves_normals: bool, random: &mut Random) {
        if moves_normals {
            self.model = std::array::from_fn(|i| {
                let sixteenth = |random: &mut Random| (random.below(65) as f64 - 32.0) / 16.0;
                match i {
                    3 => IDENTITY[3],
                    _ => [sixteenth(random), sixteenth(random), sixteenth(random), 0.0],
                }
            });
            if determinant(&self.model).abs() < 0.5 {
                self.model = IDENTITY;
                self.model[2][2] = 4.0;
            }
        }
        // Corner normals within some 60° of the face's.
        let [a, b, c] = self.attributes.map(|attribute| attribute.position);
        let face = normalize(cross(sub(b, a), sub(c, a)));
        for attribute in &mut self.attributes {
            let lean: V3 = std::array::from_fn(|_| 1.2 * random.step() - 0.6);
            attribute.normal = normalize(std::array::from_fn(|k| face[k] + lean[k]));
        }
        let way = normalize(std::array::from_fn(|_| random.step() - 0.499));
        let distance = 6.0 + 10.0 * random.step();
        self.target = self.centre();
        self.eye = std::array::from_fn(|k| self.target[k] + distance * way[k]);
        self.up = normalize(std::array::from_fn(|_| random.step() - 0.501));
        for _ in 0..self.count(random) {
            let light = self.light(random);
            self.uniforms.lights.push(light);
        }
    }

    /// The middle of the triangle in world space.
    fn centre(&self) -> V3 {
        let [a, b, c] = self.corners();
        std::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0)
    }

    /// World positions.
    pub(super) fn corners(&self) -> [V3; 3] {
        self.attributes.map(|attribute| gl::transform(&self.model, attribute.position, 1.0))
    }

    fn count(&self, random: &mut Random) -> usize {
        match self.lights {
            Lights::None => 0,
            Lights::OnePoint | Lights::One | Lights::Around => 1,
            Lights::Several | Lights::Spots => 1 + random.below(4),
        }
    }

    /// A light in eye space, somewhere around the triangle.
    fn light(&self, random: &mut Random) -> Light {
        let [x, y, z] = vector(random, 8.0);
        let far = match self.lights {
            Lights::Around => true,
            Lights::One | Lights::Several | Lights::Spots => random.below(2) == 0,
            Lights::OnePoint | Lights::None => false,
        };
        let diffuse = color(random);
        let mut light = Light {
            position: if far { [x, y, z, 0.0] } else { [x, y, z - 8.0, 1.0] },
            ambient: color(random),
            diffuse,
            specular: color(random),
            attenuation: [1.0, 0.0, 0.0],
            spot: None,
        };
        if matches!(self.lights, Lights::Several | Lights::Spots) {
            light.attenuation = [0.5 + random.step(), 0.3 * random.step(), 0.1 * random.step()];
        }
        if self.lights == Lights::Spots {
            // Curless' I_L is one colour.
            light.specular = diffuse;
            if !far && random.below(3) > 0 {
                let aim = sub([0.0, 0.0, -8.0], light.xyz());
                let aim = std::array::from_fn(|k| aim[k] + 4.0 * random.step() - 2.0);
                light.spot = Some(Spot {
                    aim,
                    cutoff_deg: 5.0 + 70.0 * random.step(),
                    exponent: [0.0, 1.0, 8.0, 64.0][random.below(4)],
                });
            }
        }
        light
    }

    /// Fills in what the shaders take from the application.
    pub(super) fn set_model_view(&mut self) {
        let view = gl::look_at(self.eye, self.target, self.up);
        self.uniforms.model_view = gl::product(&view, &self.model);
    }
}
