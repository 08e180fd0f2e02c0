//! Goniometric diagrams: curve samples against formulas of this file, the renderer itself and the
//! claims of the course texts; SVG and PNG as files.

use crate::support::program::truecast;
use serde_json::Value;
use std::fs;
use tempfile::TempDir;
use truecast::accel::BuildPreset;
use truecast::lobe::{Lobe, Reflectance, diagram};
use truecast::pixel::{Pixel, Resolution};
use truecast::render::{Unwatched, VisibilityPath, see};
use truecast::scene::Scene;
use truecast::scene::camera::PinholeCamera;
use truecast::scene::light::{DirectionalLight, Light, LightColors};
use truecast::scene::material::Material;
use truecast::shade::{SurfacePoint, shade_point, surface_point};
use truecast::visibility::Counting;

/// Largest error of a sample of at most 1 with 1 ≤ ns ≤ 100: cosines of angles that are right to
/// 2^-52 rad are right to 2.2e-16, their 100th powers to 100 times that; a factor 10 to spare.
const SAMPLE_TOLERANCE: f64 = 3e-13;

fn document(arguments: &[&str]) -> Value {
    let folder = TempDir::new().unwrap();
    let (status, stdout, stderr) = truecast(folder.path(), arguments);
    assert_eq!(status, 0, "{stderr}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "--json alone writes nothing");
    serde_json::from_str(&stdout).unwrap()
}

fn grey(lobe: Lobe, ks: f64, ns: f64) -> Reflectance {
    Reflectance { kd: [0.25; 3], ks: [ks; 3], ns, lobe, specular_cosine: false }
}

#[test]
fn samples_are_those_of_plane_trigonometry() {
    for (word, cosine) in [("blinn", false), ("phong", false), ("blinn", true), ("phong", true)] {
        for (light, ns) in [(0.0_f64, 1.0_f64), (40.0, 10.0), (75.0, 100.0), (30.0, 2.0)] {
            let (light_text, ns_text) = (light.to_string(), ns.to_string());
            let mut arguments = vec!["lobe", "--kd", "0.5,0.25,0", "--ks", "0.125,0.5,1"];
            arguments.extend(["--ns", &ns_text, "--light-angle", &light_text]);
            arguments.extend(["--specular", word, "--json"]);
            arguments.extend(cosine.then_some("--specular-cosine"));
            let document = document(&arguments);
            let samples = document["samples"].as_array().unwrap();
            assert_eq!(samples.len(), 181);
            for (sample, degree) in samples.iter().zip(-90..) {
                // In the plane, H lies halfway between the angles of L and V, and R opposite L.
                let view = f64::from(degree);
                let angle = if word == "blinn" { 0.5 * (view - light) } else { view - light };
                let n_dot_l = light.to_radians().cos();
                let power = angle.to_radians().cos().max(0.0).powf(ns);
                let power = if cosine { power * n_dot_l } else { power };
                assert_eq!(sample["view_deg"].as_f64(), Some(view));
                let check = |key: &str, channel: usize, right: f64| {
                    let value = sample[key][channel].as_f64().unwrap();
                    let error = (value - right).abs();
                    assert!(error < SAMPLE_TOLERANCE, "{word} {light} {view} {key}: {error:e}");
                };
                for (channel, (kd, ks)) in
                    [(0.5, 0.125), (0.25, 0.5), (0.0, 1.0)].into_iter().enumerate()
                {
                    check("diffuse", channel, kd * n_dot_l);
                    check("specular", channel, ks * power);
                    check("sum", channel, kd * n_dot_l + ks * power);
                }
            }
        }
    }
}

#[test]
fn the_sum_is_what_the_renderer_computes_bit_for_bit() {
    let frame = Resolution::new(2, 2).unwrap();
    let camera =
        PinholeCamera::exact(frame, [0.0; 3], [-1.0, -1.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let triangle = [[-9.0, -9.0, 2.0], [9.0, -9.0, 2.0], [0.0, 9.0, 2.0]];
    let mut scene = Scene::from_triangles(camera.unwrap(), &[triangle]);
    let path = VisibilityPath::Raster;
    let window = frame.window();
    let seen = see(&scene, path, BuildPreset::Medium, window, Counting::Nearest, &Unwatched);
    let visible = seen.buffer.visible[0].as_ref().expect("the triangle covers the frame");
    let (seen, _) = surface_point(&scene, Pixel { x: 0, y: 0 }, visible);
    let (kd, ks, ns) = ([0.5, 0.3, 0.1], [0.9, 0.2, 0.4], 25.0);
    let reflectance = Reflectance { kd, ks, ns, lobe: Lobe::Blinn, specular_cosine: false };
    let material = Material { kd, ks, ns, ka: [0.0; 3], ..Material::default_named("m") };
    let direction = |degrees: f64| {
        let angle = degrees.to_radians();
        [libm::sin(angle), libm::cos(angle), 0.0]
    };
    for light in [10.0, 45.0, 80.0, 130.0] {
        let white = LightColors { ambient: [0.0; 3], diffuse: [1.0; 3], specular: [1.0; 3] };
        let aim = direction(-light).map(|c| -c);
        scene.lights =
            vec![Light::Directional(DirectionalLight { aim, colors: white, shadows: false })];
        for view in -89..=89 {
            let view = f64::from(view);
            if view == 0.0 {
                continue;
            }
            let north = [0.0, 1.0, 0.0];
            let point = SurfacePoint {
                position: [0.0; 3],
                to_eye: direction(view),
                face_normal: north,
                shading_normal: north,
                ..seen
            };
            let rendered = shade_point(&scene, &point, &material);
            assert_eq!(reflectance.at(light, view).sum(), rendered, "{light} {view}");
        }
    }
}

// CS315, figure 2: with the same exponent Blinn's lobe is the wider one; at n = 1 it is still
// there beyond 90° from the mirror direction, where Phong's has ended.
#[test]
fn blinns_lobe_reaches_beyond_a_right_angle_from_the_mirror_direction() {
    let at = |lobe| grey(lobe, 1.0, 1.0).at(60.0, -60.0).specular[0];
    assert!((at(Lobe::Blinn) - 0.5).abs() < SAMPLE_TOLERANCE);
    assert_eq!(at(Lobe::Phong), 0.0);
}

#[test]
fn half_widths_follow_the_exponent() {
    // Rounding of the lobe moves its half by 2^-53 / slope; the flattest slope here, 2^-1 per
    // radian, makes 1e-14 degrees of it.
    const HALF_WIDTH_TOLERANCE_DEG: f64 = 1e-11;
    let mut widths = Vec::new();
    for ns in [10.0, 100.0, 1000.0] {
        let phong = 0.5_f64.powf(1.0 / ns).acos().to_degrees();
        for (lobe, right) in [(Lobe::Phong, phong), (Lobe::Blinn, 2.0 * phong)] {
            let peak = grey(lobe, 0.5, ns).peak(20.0).unwrap();
            assert_eq!(peak.view_deg, 20.0);
            for width in peak.half_width_deg {
                let error = (width.unwrap() - right).abs();
                assert!(error < HALF_WIDTH_TOLERANCE_DEG, "{lobe:?} {ns}: {error:e}");
            }
            widths.push(right);
        }
    }
    assert!(widths[4] < widths[2] && widths[2] < widths[0], "{widths:?}");
    // The surface cuts the side of a grazing light's lobe off.
    let grazing = grey(Lobe::Phong, 0.5, 10.0).peak(85.0).unwrap();
    assert!(grazing.half_width_deg[0].is_some() && grazing.half_width_deg[1].is_none());
    assert_eq!(grey(Lobe::Blinn, 0.0, 10.0).peak(20.0), None);
    assert_eq!(grey(Lobe::Blinn, 0.5, 0.0).peak(20.0), None);
}

#[test]
fn light_along_or_below_the_surface_gives_nothing() {
    for light in [90.0, -90.0, 90.5, 180.0, -135.0] {
        let reflectance = grey(Lobe::Blinn, 1.0, 0.0);
        let samples = reflectance.samples(light);
        assert!(samples.iter().all(|sample| sample.sum() == [0.0; 3]), "{light}");
        assert_eq!(grey(Lobe::Blinn, 1.0, 5.0).peak(light), None);
    }
}

/// Whether every tag closes in order, every attribute is quoted and no text holds a bare `<` or `&`.
fn assert_well_formed(svg: &str) {
    let body = svg.strip_prefix("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n").unwrap();
    let mut open: Vec<&str> = Vec::new();
    let mut rest = body.trim_end();
    while let Some((text, tail)) = rest.split_once('<') {
        let is_known = |entity: &str| {
            ["amp;", "lt;", "gt;", "quot;"].iter().any(|known| entity.starts_with(known))
        };
        assert!(text.split('&').skip(1).all(is_known) && !text.contains('>'), "{text}");
        let (tag, tail) = tail.split_once('>').expect("a tag ends");
        rest = tail;
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name));
        } else {
            assert_eq!(tag.matches('"').count(), 2 * tag.matches("=\"").count(), "{tag}");
            if !tag.ends_with('/') {
                open.push(tag.split_whitespace().next().unwrap());
            }
        }
    }
    assert!(open.is_empty() && rest.is_empty(), "{open:?} {rest}");
}

#[test]
fn both_formats_are_written_and_the_svg_is_well_formed() {
    let folder = TempDir::new().unwrap();
    let arguments = ["lobe", "--material", "brass", "--light-angle", "-35", "-o", "b.svg"];
    let (status, stdout, stderr) =
        truecast(folder.path(), &[&arguments[..], &["-o", "B.PNG"]].concat());
    assert_eq!(status, 0, "{stderr}");
    assert!(stdout.contains("wrote b.svg") && stdout.contains("wrote B.PNG"), "{stdout}");
    assert!(stdout.contains("specular peak at -35 degrees"), "{stdout}");
    let mut names: Vec<_> = fs::read_dir(folder.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names, ["B.PNG", "b.svg"]);
    let svg = fs::read_to_string(folder.path().join("b.svg")).unwrap();
    assert_well_formed(&svg);
    for words in ["Goniometric diagram: brass", "ns = 90", "1/2 of the normal", "-60°"] {
        assert!(svg.contains(words), "no {words:?} in the SVG");
    }
    assert!(fs::read(folder.path().join("B.PNG")).unwrap().starts_with(b"\x89PNG"));

    let (status, _, _) =
        truecast(folder.path(), &["lobe", "--kd=1", "--ks=1", "--ns=1", "--light-angle=0"]);
    assert_eq!((status, folder.path().join("lobe.svg").exists()), (0, true));
}

#[test]
fn names_and_extreme_coefficients_cannot_break_the_drawing() {
    let title = "<script> & \"quotes\" \u{1}";
    for (ks, ns, light) in [(0.0, 0.0, 0.0), (1e300, 1e300, 45.0), (f64::MIN_POSITIVE, 3.0, 90.0)] {
        let drawing = diagram(&grey(Lobe::Blinn, ks, ns), light, title);
        assert_well_formed(&drawing.to_svg());
        assert!(!drawing.to_svg().contains("NaN") && !drawing.to_svg().contains("inf"));
        assert!(drawing.to_picture(1).is_some());
    }
}

#[test]
fn bad_arguments_are_usage_errors_and_unknown_materials_are_not() {
    let folder = TempDir::new().unwrap();
    for arguments in [
        &["lobe"][..],
        &["lobe", "--material", "brass"],
        &["lobe", "--kd", "1", "--ks", "1", "--light-angle", "10"],
        &["lobe", "--kd", "-1", "--ks", "1", "--ns", "1", "--light-angle", "10"],
        &["lobe", "--kd", "1,2", "--ks", "1", "--ns", "1", "--light-angle", "10"],
        &["lobe", "--kd", "1", "--ks", "nan", "--ns", "1", "--light-angle", "10"],
        &["lobe", "--kd", "1", "--ks", "1", "--ns", "inf", "--light-angle", "10"],
        &["lobe", "--kd", "1", "--ks", "1", "--ns", "1", "--light-angle", "181"],
        &["lobe", "--material", "brass", "--ns", "1", "--light-angle", "10"],
        &["lobe", "--material", "brass", "--light-angle", "10", "--specular", "cook"],
        &["lobe", "--material", "brass", "--light-angle", "10", "-o", "lobe.exr"],
        &["lobe", "scene.toml", "--kd", "1", "--ks", "1", "--ns", "1", "--light-angle", "10"],
    ] {
        let (status, stdout, stderr) = truecast(folder.path(), arguments);
        assert_eq!((status, stdout.as_str()), (2, ""), "{arguments:?}: {stderr}");
        assert!(!stderr.is_empty());
    }
    let (status, stdout, stderr) =
        truecast(folder.path(), &["lobe", "--material", "bras", "--light-angle", "10"]);
    assert_eq!((status, stdout.as_str()), (3, ""), "{stderr}");
    assert!(stderr.contains("`bras`") && stderr.contains("did you mean `brass`?"), "{stderr}");
    let missing = ["lobe", "missing.toml", "--material", "m", "--light-angle", "10"];
    assert_eq!(truecast(folder.path(), &missing).0, 4);
    let nowhere = ["lobe", "--material", "brass", "--light-angle", "10", "-o", "nowhere/l.svg"];
    assert_eq!(truecast(folder.path(), &nowhere).0, 4);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "nothing is left behind");
}
