//! `truecast lobe` as typed.

use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(in crate::cli) struct LobeArguments {
    /// Scene file (TOML) with the material; without it the built-in default scene
    pub(in crate::cli) scene: Option<PathBuf>,
    /// A material of the scene; instead of --kd, --ks and --ns
    #[arg(long, value_name = "NAME", conflicts_with_all = ["kd", "ks", "ns"])]
    pub(in crate::cli) material: Option<String>,
    /// Diffuse reflection, one number or three
    #[arg(long, value_name = "R,G,B", value_parser = parse_coefficients,
          required_unless_present = "material")]
    pub(in crate::cli) kd: Option<[f64; 3]>,
    /// Specular reflection, one number or three
    #[arg(long, value_name = "R,G,B", value_parser = parse_coefficients,
          required_unless_present = "material")]
    pub(in crate::cli) ks: Option<[f64; 3]>,
    /// Specular exponent
    #[arg(long, value_name = "N", value_parser = parse_coefficient,
          required_unless_present = "material")]
    pub(in crate::cli) ns: Option<f64>,
    /// Angle between the normal and the light, -180 to 180 degrees
    #[arg(long, value_name = "DEG", value_parser = parse_angle, allow_negative_numbers = true)]
    pub(in crate::cli) light_angle: f64,
    /// Whose specular lobe [default: the scene's, else blinn]
    #[arg(long, value_enum)]
    pub(in crate::cli) specular: Option<SpecularWord>,
    /// Multiply the specular term by N.L; a scene may ask for it too
    #[arg(long)]
    pub(in crate::cli) specular_cosine: bool,
    /// Output file; .svg or .png by extension; may be repeated [default: lobe.svg, with --json none]
    #[arg(short, long = "output", value_name = "FILE")]
    pub(in crate::cli) output: Vec<PathBuf>,
    /// Print one JSON document on stdout: every degree, every channel
    #[arg(long)]
    pub(in crate::cli) json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum SpecularWord {
    /// (N.H)^ns
    Blinn,
    /// (R.V)^ns
    Phong,
}

fn parse_coefficient(text: &str) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok();
    number
        .filter(|number| number.is_finite() && *number >= 0.0)
        .ok_or_else(|| "expected a finite number, at least 0".to_owned())
}

fn parse_coefficients(text: &str) -> Result<[f64; 3], String> {
    let numbers: Result<Vec<f64>, String> = text.split(',').map(parse_coefficient).collect();
    match numbers.as_deref() {
        Ok(&[grey]) => Ok([grey; 3]),
        Ok(&[red, green, blue]) => Ok([red, green, blue]),
        _ => Err("expected one number or three R,G,B, each finite and at least 0".to_owned()),
    }
}

fn parse_angle(text: &str) -> Result<f64, String> {
    let angle = text.trim().parse::<f64>().ok();
    angle
        .filter(|angle| (-180.0..=180.0).contains(angle))
        .ok_or_else(|| "expected degrees from -180 to 180".to_owned())
}
