//! `truecast lobe`: the goniometric diagram of a reflectance.

use super::OK;
use super::arguments::{LobeArguments, SpecularWord};
use super::failure::Failure;
use super::output::{self, Writing};
use super::render::DEFAULT_SCENE;
use serde_json::json;
use std::path::{Path, PathBuf};
use truecast::drawing::Drawing;
use truecast::film::encode_picture;
use truecast::lobe::{Lobe, Reflectance, diagram, material};
use truecast::scene::switches::SwitchValue;
use truecast::scene::{Overrides, Scene};

/// Pixels per page unit of the PNG, for screens of high density.
const PNG_SCALE: u16 = 2;

/// The format of a file, by its extension.
#[derive(Clone, Copy)]
enum Format {
    Svg,
    Png,
}

pub(super) fn run(arguments: &LobeArguments, writing: &Writing) -> Result<u8, Failure> {
    let targets = targets(arguments)?;
    let reflectance = reflectance(arguments)?;
    let drawing = diagram(&reflectance, arguments.light_angle, &title(arguments));
    for (path, format) in &targets {
        output::save(writing, path, &encode(&drawing, *format)?)?;
    }
    if arguments.json {
        output::print_json(&document(arguments, &reflectance, &targets));
    } else {
        for (path, _) in &targets {
            output::print(&format!("wrote {}\n", path.display()));
        }
        output::print(&peak_line(&reflectance, arguments.light_angle));
    }
    Ok(OK)
}

/// The files, each with its format, refused early when they cannot be written.
fn targets(arguments: &LobeArguments) -> Result<Vec<(PathBuf, Format)>, Failure> {
    let mut paths = arguments.output.clone();
    if paths.is_empty() && !arguments.json {
        paths.push(PathBuf::from("lobe.svg"));
    }
    let format_of = |path: &Path| {
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("svg") => Ok(Format::Svg),
            Some("png") => Ok(Format::Png),
            _ => Err(Failure::usage(format!(
                "{}: the name does not say which format to write; end it in .svg or .png",
                path.display()
            ))),
        }
    };
    let targets = paths.into_iter().map(|path| {
        let format = format_of(&path)?;
        output::check_target(&path)?;
        Ok((path, format))
    });
    targets.collect()
}

fn encode(drawing: &Drawing, format: Format) -> Result<Vec<u8>, Failure> {
    match format {
        Format::Svg => Ok(drawing.to_svg().into_bytes()),
        Format::Png => match drawing.to_picture(PNG_SCALE) {
            Some(picture) => Ok(encode_picture(&picture)?),
            None => Err(Failure::Input("the drawing does not fit the memory".to_owned())),
        },
    }
}

/// What is typed, or what the scene says of the material and its switches.
fn reflectance(arguments: &LobeArguments) -> Result<Reflectance, Failure> {
    let typed = arguments.specular.map(|word| match word {
        SpecularWord::Blinn => Lobe::Blinn,
        SpecularWord::Phong => Lobe::Phong,
    });
    let Some(name) = &arguments.material else {
        if let Some(scene) = &arguments.scene {
            let scene = scene.display();
            let message = format!("which material of {scene}? name it with --material NAME");
            return Err(Failure::usage(message));
        }
        // The command line's own rules demand all three without a material.
        return Ok(Reflectance {
            kd: arguments.kd.unwrap_or_default(),
            ks: arguments.ks.unwrap_or_default(),
            ns: arguments.ns.unwrap_or_default(),
            lobe: typed.unwrap_or_default(),
            specular_cosine: arguments.specular_cosine,
        });
    };
    let overrides = Overrides::default();
    let (scene, file) = match &arguments.scene {
        Some(path) => (Scene::load(path, &overrides)?, path.as_path()),
        None => {
            let file = Path::new("default.toml");
            (Scene::from_toml(DEFAULT_SCENE, file, Path::new("."), &overrides)?, file)
        }
    };
    output::print_warnings(&scene.warnings);
    let material = material(&scene, name)
        .map_err(|why| Failure::Input(format!("{}: {why}", file.display())))?;
    let scenes = match scene.switches.get("specular") {
        Some(SwitchValue::Word("phong")) => Lobe::Phong,
        _ => Lobe::Blinn,
    };
    let with_cosine = scene.switches.get("specular_cosine") == Some(SwitchValue::Is(true));
    Ok(Reflectance {
        kd: material.kd,
        ks: material.ks,
        ns: material.ns,
        lobe: typed.unwrap_or(scenes),
        specular_cosine: arguments.specular_cosine || with_cosine,
    })
}

fn title(arguments: &LobeArguments) -> String {
    match &arguments.material {
        Some(name) => format!("Goniometric diagram: {name}"),
        None => "Goniometric diagram".to_owned(),
    }
}

fn peak_line(reflectance: &Reflectance, light_deg: f64) -> String {
    let Some(peak) = reflectance.peak(light_deg) else {
        return "no specular peak\n".to_owned();
    };
    let side = |width: Option<f64>| match width {
        Some(width) => format!("{width:.3} degrees away"),
        None => "nowhere above the surface".to_owned(),
    };
    let [low, high] = peak.half_width_deg.map(side);
    format!(
        "specular peak at {} degrees; half of it {low} towards -90, {high} towards 90\n",
        peak.view_deg
    )
}

fn document(
    arguments: &LobeArguments,
    reflectance: &Reflectance,
    targets: &[(PathBuf, Format)],
) -> serde_json::Value {
    let samples: Vec<_> = reflectance
        .samples(arguments.light_angle)
        .iter()
        .map(|sample| {
            json!({
                "view_deg": sample.view_deg,
                "diffuse": sample.diffuse,
                "specular": sample.specular,
                "sum": sample.sum(),
            })
        })
        .collect();
    let peak = reflectance.peak(arguments.light_angle).map(|peak| {
        let [low, high] = peak.half_width_deg;
        json!({
            "view_deg": peak.view_deg,
            "half_width_towards_minus_90_deg": low,
            "half_width_towards_plus_90_deg": high,
        })
    });
    json!({
        "schema": "truecast/lobe/1",
        "scene": arguments.scene.as_ref().map(|path| path.display().to_string()),
        "material": arguments.material,
        "kd": reflectance.kd,
        "ks": reflectance.ks,
        "ns": reflectance.ns,
        "specular": reflectance.lobe.name(),
        "specular_cosine": reflectance.specular_cosine,
        "light_angle_deg": arguments.light_angle,
        "peak": peak,
        "samples": samples,
        "files": targets.iter().map(|(path, _)| path.display().to_string()).collect::<Vec<_>>(),
    })
}
