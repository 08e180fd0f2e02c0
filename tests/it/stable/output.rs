//! What comes out: codes of sRGB, numbers that have none, and every field of a scene: S19, S20, S35.

use super::*;
use dashu_ratio::RBig;
use truecast::film::{Film, FilmError, Plane, Samples, encode_png};
use truecast::pixel::Resolution;

/// A film of one row with these values in every channel.
fn row(values: &[f32]) -> Film {
    let resolution = Resolution::new(values.len() as u32, 1).unwrap();
    let plane =
        |name: &str| Plane { name: name.to_owned(), samples: Samples::Float(values.to_vec()) };
    Film {
        resolution,
        window: resolution.window(),
        planes: vec![plane("R"), plane("G"), plane("B")],
        description: "{}".to_owned(),
    }
}

/// The red codes of a PNG.
fn codes(film: &Film) -> Vec<u8> {
    let (bytes, _) = encode_png(film).unwrap();
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    pixels.chunks(3).map(|rgb| rgb[0]).collect()
}

/// Whether a linear value reaches the step below code k, EOTF((k − ½)/255), exactly: with
/// EOTF(v) = v/12.92 up to 0.04045 and r^(12/5), r = (v + 0.055)/1.055, above, x ≥ EOTF(v) is
/// x⁵ ≥ r¹².
fn reaches(linear: f32, k: u32) -> bool {
    let fraction = |n: u32, d: u32| RBig::from(n) / RBig::from(d);
    let x = RBig::try_from(f64::from(linear)).unwrap();
    let encoded = fraction(2 * k - 1, 510);
    if encoded <= fraction(4045, 100_000) {
        return x >= encoded / fraction(1292, 100);
    }
    let base = (encoded + fraction(55, 1000)) / fraction(1055, 1000);
    x.pow(5) >= base.pow(12)
}

#[test]
fn s19_srgb_codes_are_the_correctly_rounded_ones() {
    // 255 steps, and nine f32 numbers around each: an f32 formula misses 203 of these 2 295.
    let mut values = Vec::new();
    let mut right = Vec::new();
    for k in 1..=255_u32 {
        let encoded = (f64::from(k) - 0.5) / 255.0;
        let step = match encoded <= 0.040_45 {
            true => encoded / 12.92,
            false => ((encoded + 0.055) / 1.055).powf(2.4),
        };
        let middle = (step as f32).to_bits();
        for bits in middle - 4..=middle + 4 {
            let value = f32::from_bits(bits);
            values.push(value);
            // Steps are far wider apart than four f32 numbers.
            right.push(if reaches(value, k) { k as u8 } else { (k - 1) as u8 });
        }
    }
    assert_eq!(values.len(), 2_295);
    assert_eq!(codes(&row(&values)), right);
    // Below 0 the power is NaN; where the two branches meet, the code is the same by both.
    let odd = [-1e-9, -0.0, 0.0, 1e-45, 0.003_130_8, 0.003_130_668_4, 1.0, 1e30, f32::MAX];
    assert_eq!(codes(&row(&odd)), [0, 0, 0, 0, 10, 10, 255, 255, 255]);
}

#[test]
fn s20_what_is_no_number_never_becomes_black() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let refused = encode_png(&row(&[0.5, bad, 0.5]));
        let named = matches!(refused, Err(FilmError::NotFinite { plane: "R", x: 1, y: 0, .. }));
        assert!(named, "{bad}: {refused:?}");
    }
}

/// Every number of the shading part of a scene stands in ‹›.
const FIELDS: &str = "version = 1
[image]
width = 5
height = 4
background = [‹0.1›, 0.2, 0.3]
[camera]
eye = [‹0.5›, ‹1.0›, ‹6.0›]
target = [‹0.0›, ‹0.25›, ‹0.0›]
up = [‹0.0›, ‹1.0›, ‹0.0›]
fov_y_deg = ‹45.0›
[[material]]
name = \"m\"
ka = [‹0.25›, 0.25, 0.25]
kd = [‹0.5›, 0.5, 0.5]
ks = [‹0.75›, 0.75, 0.75]
ke = [‹0.125›, 0.0, 0.0]
ns = ‹50.0›
opacity = ‹0.5›
[[mesh]]
shape = { uv_sphere = { radius = ‹2.0›, around = 12, rings = 6 } }
material = \"m\"
scale = ‹1.0›
rotate_deg = [‹10.0›, ‹20.0›, ‹30.0›]
translate = [‹0.0›, ‹0.5›, ‹-0.5›]
[[light]]
type = \"ambient\"
ambient = [‹0.1›, 0.1, 0.1]
[[light]]
type = \"directional\"
aim = [‹0.5›, ‹-1.0›, ‹-2.0›]
diffuse = [‹1.0›, 1.0, 1.0]
specular = [‹1.0›, 1.0, 1.0]
[[light]]
type = \"point\"
position = [‹2.0›, ‹3.0›, ‹6.0›]
intensity = [‹1.0›, 1.0, 1.0]
attenuation = [‹1.0›, ‹0.0›, ‹0.5›]
ambient = [‹0.05›, 0.0, 0.0]
[[light]]
type = \"spot\"
position = [‹-2.0›, 3.0, 6.0]
aim = [‹0.5›, ‹-0.75›, ‹-1.5›]
intensity = [0.5, 0.5, 0.5]
attenuation = [‹1.0›, ‹0.25›, ‹0.0›]
cutoff_deg = ‹60.0›
exponent = ‹2.5›
[[light]]
type = \"hemisphere\"
direction = [‹0.0›, ‹1.0›, ‹0.0›]
top = [‹0.5›, 0.5, 1.0]
bottom = [‹0.25›, 0.25, 0.0]
";

#[test]
fn s35_every_field_at_the_ends_of_f32() {
    let parts: Vec<&str> = FIELDS.split(['‹', '›']).collect();
    let audited =
        ["0.0", "-0.0", "1e-45", "1e-38", "1e38", "3.4028234663852886e38", "3.141592653589793"];
    let (mut finite, mut refused) = (0, 0);
    for field in (1..parts.len()).step_by(2) {
        for value in audited {
            let mut replaced = parts.clone();
            replaced[field] = value;
            let text = replaced.concat();
            let name = Path::new("audit.toml");
            match Scene::from_toml(&text, name, Path::new("."), &Overrides::default()) {
                Err(errors) => {
                    assert!(errors.0.iter().all(|error| error.place.line > 0), "{errors}");
                    refused += 1;
                }
                Ok(scene) => {
                    // Products of a colour, a light and 1/1e-45 stay far inside f64.
                    let window = scene.camera.resolution().window();
                    let path = VisibilityPath::Cast;
                    let preset = BuildPreset::Medium;
                    let seen = see(&scene, path, preset, window, Counting::Nearest, &Unwatched);
                    let shaded = shade::shade(&scene, &seen.buffer, Effects::of(&scene), &|| ());
                    let sound = |rgb: &V3| rgb.iter().all(|c| c.is_finite() && *c >= 0.0);
                    let after = parts[field - 1];
                    assert!(shaded.radiance.iter().all(sound), "{value} after {after:?}");
                    assert_eq!(shaded.notes.non_finite, 0);
                    finite += 1;
                }
            }
        }
    }
    assert!(finite > 200 && refused > 20, "{finite} {refused}");
}
