//! Numbers that no surface can be shaded with are refused where they stand: what is not finite,
//! what is negative where it must not be, attenuation without a denominator, cones without an
//! opening, directions without a length.

use super::*;

/// Every number that shading, camera or mesh reads, each between ‹ and ›.
const NUMBERS: &str = "version = 1
[image]
width = 4
height = 3
background = [‹0.1›, ‹0.2›, ‹0.3›]
[camera]
eye = [‹0.5›, ‹1.0›, ‹6.0›]
target = [‹0.0›, ‹0.25›, ‹0.0›]
up = [‹0.0›, ‹1.0›, ‹0.0›]
fov_y_deg = ‹45.0›
[[material]]
name = \"m\"
ka = [‹0.25›, ‹0.25›, ‹0.25›]
kd = [‹0.5›, ‹0.5›, ‹0.5›]
ks = [‹0.75›, ‹0.75›, ‹0.75›]
ke = [‹0.125›, ‹0.0›, ‹0.0›]
ns = ‹50.0›
opacity = ‹0.5›
[[mesh]]
shape = { torus = { major = ‹2.0›, minor = ‹0.5› } }
material = \"m\"
crease_deg = ‹60.0›
scale = [‹1.0›, ‹1.0›, ‹1.0›]
rotate_deg = [‹10.0›, ‹20.0›, ‹30.0›]
translate = [‹0.0›, ‹0.5›, ‹-0.5›]
[[light]]
type = \"ambient\"
ambient = [‹0.1›, ‹0.1›, ‹0.1›]
[[light]]
type = \"directional\"
aim = [‹0.5›, ‹-1.0›, ‹-2.0›]
diffuse = [‹1.0›, ‹1.0›, ‹1.0›]
specular = [‹1.0›, ‹1.0›, ‹1.0›]
ambient = [‹0.1›, ‹0.1›, ‹0.1›]
[[light]]
type = \"point\"
position = [‹2.0›, ‹3.0›, ‹6.0›]
intensity = [‹1.0›, ‹1.0›, ‹1.0›]
attenuation = [‹1.0›, ‹0.0›, ‹0.5›]
[[light]]
type = \"spot\"
position = [‹-2.0›, ‹3.0›, ‹6.0›]
target = [‹0.0›, ‹0.0›, ‹0.0›]
intensity = [‹0.5›, ‹0.5›, ‹0.5›]
attenuation = [‹1.0›, ‹0.25›, ‹0.0›]
cutoff_deg = ‹60.0›
exponent = ‹2.5›
[[light]]
type = \"hemisphere\"
direction = [‹0.0›, ‹1.0›, ‹0.0›]
top = [‹0.5›, ‹0.5›, ‹1.0›]
bottom = [‹0.25›, ‹0.25›, ‹0.0›]
";

/// Line and column, from 1, of the end of a text.
fn end(text: &str) -> (u32, u32) {
    let last = text.lines().last().unwrap_or_default();
    (text.lines().count() as u32, last.chars().count() as u32 + 1)
}

/// The text with one number replaced, the key it belongs to, and where the number and the key's
/// whole value begin.
fn replaced(place: usize, value: &str) -> (String, String, [(u32, u32); 2]) {
    let mut parts: Vec<&str> = NUMBERS.split(['‹', '›']).collect();
    parts[2 * place + 1] = value;
    let before = parts[..2 * place + 1].concat();
    let line = before.lines().last().unwrap();
    let key = line.split(" = ").next().unwrap().to_owned();
    let (number, column) = end(&before);
    let list = line.find('[').map_or(column, |bracket| bracket as u32 + 1);
    (parts.concat(), key, [(number, column), (number, list)])
}

fn count() -> usize {
    NUMBERS.matches('‹').count()
}

#[test]
fn whatever_is_not_finite_is_refused_at_its_own_place() {
    assert!(load(&NUMBERS.replace(['‹', '›'], "")).is_ok());
    for place in 0..count() {
        for value in ["nan", "inf", "-inf", "1e400"] {
            let (text, key, [number, _]) = replaced(place, value);
            let errors = load(&text).expect_err(&key).0;
            assert_eq!(errors.len(), 1, "{key} {value}: {errors:?}");
            let error = &errors[0];
            assert_eq!((error.place.line, error.place.column), number, "{key} {value}: {error}");
            assert!(error.message.contains("finite number, not"), "{error}");
        }
    }
}

#[test]
fn negative_coefficients_and_exponents_are_refused_at_their_value() {
    let never = [
        "background",
        "ka",
        "kd",
        "ks",
        "ke",
        "ns",
        "opacity",
        "ambient",
        "diffuse",
        "specular",
        "intensity",
        "attenuation",
        "cutoff_deg",
        "exponent",
        "top",
        "bottom",
        "crease_deg",
    ];
    let mut tried = Vec::new();
    for place in 0..count() {
        for value in ["-1.0", "-5e-324"] {
            let (text, key, [_, list]) = replaced(place, value);
            if !never.contains(&key.as_str()) {
                continue;
            }
            let errors = load(&text).expect_err(&key).0;
            assert_eq!(errors.len(), 1, "{key} {value}: {errors:?}");
            let error = &errors[0];
            assert_eq!((error.place.line, error.place.column), list, "{key} {value}: {error}");
            let names_it = error.message.contains(&format!("`{key}`"));
            assert!(names_it && error.message.contains(", not -"), "{error}");
            tried.push(key);
        }
    }
    tried.sort();
    tried.dedup();
    assert_eq!(tried.len(), never.len(), "{tried:?}");
}

#[test]
fn lights_without_a_denominator_an_opening_or_a_direction() {
    let spot = "type = \"spot\"\nposition = [0, 1, 0]\nintensity = [1, 1, 1]\n";
    for (keys, message) in [
        (
            "aim = [0, -1, 0]\ncutoff_deg = 9\nattenuation = ▸[0, 0, 0]\n",
            "the numbers of `attenuation` must not all be 0",
        ),
        (
            "aim = [0, -1, 0]\ncutoff_deg = 9\nattenuation = ▸[-0.0, 0.0, -0.0]\n",
            "the numbers of `attenuation` must not all be 0",
        ),
        (
            "aim = [0, -1, 0]\ncutoff_deg = ▸0\n",
            "`cutoff_deg` must be greater than 0 and at most 180, not 0",
        ),
        (
            "aim = [0, -1, 0]\ncutoff_deg = ▸-0.0\n",
            "`cutoff_deg` must be greater than 0 and at most 180, not -0",
        ),
        (
            "aim = [0, -1, 0]\ncutoff_deg = ▸180.00000000000003\n",
            "`cutoff_deg` must be greater than 0 and at most 180, not 180.00000000000003",
        ),
        (
            "aim = ▸[0, -0.0, 0]\ncutoff_deg = 9\n",
            "`aim` is a direction and must not have length 0",
        ),
        (
            "target = ▸[0, 1, 0]\ncutoff_deg = 9\n",
            "`target − position` is a direction and must not have length 0",
        ),
    ] {
        light_refused(&format!("{spot}{keys}"), &[message]);
    }
}

#[test]
fn a_material_library_is_held_to_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let scene = format!("{HEAD}[[mesh]]\nfile = \"m.obj\"\n");
    let obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";
    std::fs::write(folder.path().join("m.obj"), obj).unwrap();
    let load = |library: &str| {
        std::fs::write(folder.path().join("m.mtl"), library).unwrap();
        Scene::from_toml(&scene, Path::new(NAME), folder.path(), &Overrides::default())
    };
    assert!(load("newmtl a\nKd 1 1 1\nNs 0\nd 1\n").is_ok());
    for keyword in ["Ka", "Kd", "Ks", "Ke", "Ns", "d", "Tr"] {
        let is_color = keyword.starts_with('K');
        for bad in ["-1", "-5e-324", "nan", "inf", "-inf", "1e999"] {
            // Of a colour, each channel in turn.
            for channel in 0..if is_color { 3 } else { 1 } {
                let mut numbers = vec!["0.5"; if is_color { 3 } else { 1 }];
                numbers[channel] = bad;
                let (text, places) = unmark(&format!(
                    "newmtl a\n {keyword} {}▸{}\n",
                    numbers[..channel].iter().map(|n| format!("{n} ")).collect::<String>(),
                    numbers[channel..].join(" ")
                ));
                let errors = load(&text).expect_err(&text).0;
                assert_eq!(errors.len(), 1, "{text}: {errors:?}");
                let place = &errors[0].place;
                assert_eq!((place.line, place.column), places[0], "{text}: {}", errors[0]);
                assert!(place.file.ends_with("m.mtl"));
                let says = ["is negative", "is not a finite number"];
                assert!(says.iter().any(|says| errors[0].message.contains(says)), "{}", errors[0]);
            }
        }
    }
}
