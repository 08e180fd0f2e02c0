//! The command line as typed.

use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;
use truecast::pixel::{MAX_SIDE, Resolution};
use truecast::raster::SubpixelBits;

/// Casts one ray per pixel at a scene of triangle meshes, and proves which triangle is visible.
#[derive(Debug, Parser)]
#[command(version, about, propagate_version = true, after_help = EXIT_STATUS)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) command: Command,
}

const EXIT_STATUS: &str = "Exit status: 0 ok; 1 a check found a difference; 2 usage; 3 bad scene or \
mesh, or nothing to check; 4 reading or writing failed; 130 interrupted.";

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Render a scene to EXR, PNG or NPY
    Render(RenderArguments),
    /// Compare both visibility paths pixel by pixel; exact arithmetic decides every difference
    Check(CheckArguments),
    /// Explain one pixel: every candidate, the winner, every light term
    Pixel(PixelArguments),
    /// Say which effects the scene calls for, and its resolved camera and switches
    Explain(ExplainArguments),
}

#[derive(Debug, Args)]
pub(super) struct RenderArguments {
    /// Scene file (TOML); without it the built-in default scene, a teapot under spotlights
    pub(super) scene: Option<PathBuf>,
    /// Output file; .exr, .png or .npy (ids) by extension; may be repeated [default: NAME.png and
    /// NAME.exr after the scene file, or truecast.png and truecast.exr]
    #[arg(short, long = "output", value_name = "FILE")]
    pub(super) output: Vec<PathBuf>,
    /// Which of the two independent paths answers
    #[arg(long, value_enum, default_value_t = PathWord::Cast)]
    pub(super) path: PathWord,
    /// How visibility is decided
    #[arg(long, value_enum, default_value_t = AccuracyWord::Exact)]
    pub(super) accuracy: AccuracyWord,
    /// Bits of the watertight rasterizer's grid below the pixel, 0 to 12 [default: 8]
    #[arg(long, value_name = "N", value_parser = parse_subpixel_bits)]
    pub(super) subpixel_bits: Option<SubpixelBits>,
    /// Planes of the EXR: a comma-separated list of rgba, Z, t, P, N, Ns, uv, bary, id, facing,
    /// cover, verdict, stable; or all [default: all but cover and stable]
    #[arg(long, value_name = "LIST")]
    pub(super) aov: Option<String>,
    /// Render at this size instead of the scene's
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(super) size: Option<Resolution>,
    /// Render only columns X0..X1 and rows Y0..Y1 (X1 and Y1 excluded)
    #[arg(long, value_name = "X0,Y0,X1,Y1", value_parser = parse_crop)]
    pub(super) crop: Option<[u32; 4]>,
    /// Number of threads; 0 is one per core
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(super) threads: usize,
    /// Print one JSON document on stdout
    #[arg(long)]
    pub(super) json: bool,
    /// No progress bar, no summary; errors only
    #[arg(long)]
    pub(super) quiet: bool,
}

#[derive(Debug, Args)]
pub(super) struct CheckArguments {
    /// Scene files (TOML)
    #[arg(required = true)]
    pub(super) scenes: Vec<PathBuf>,
    /// Write the picture expected | difference | actual (PNG)
    #[arg(long, value_name = "FILE.png")]
    pub(super) diff: Option<PathBuf>,
    /// Write every difference (CSV)
    #[arg(long, value_name = "FILE.csv")]
    pub(super) csv: Option<PathBuf>,
    /// Check only this pixel and print all three answers
    #[arg(long, value_name = "X,Y", value_parser = parse_pixel)]
    pub(super) pixel: Option<[u32; 2]>,
    /// How many agreeing pixels exact arithmetic audits
    #[arg(long, value_name = "N", default_value_t = 1000)]
    pub(super) audit: usize,
    /// Check at this size instead of the scene's
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(super) size: Option<Resolution>,
    /// Number of threads; 0 is one per core
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(super) threads: usize,
    /// Print one JSON document on stdout
    #[arg(long)]
    pub(super) json: bool,
    /// No progress bar, no summary; errors and exit status only
    #[arg(long)]
    pub(super) quiet: bool,
}

#[derive(Debug, Args)]
pub(super) struct PixelArguments {
    /// Scene file (TOML)
    pub(super) scene: PathBuf,
    /// Column, 0 at the left
    pub(super) x: u32,
    /// Row, 0 at the top
    pub(super) y: u32,
    /// Look at the frame of this size instead of the scene's
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(super) size: Option<Resolution>,
    /// Print one JSON document on stdout
    #[arg(long)]
    pub(super) json: bool,
}

#[derive(Debug, Args)]
pub(super) struct ExplainArguments {
    /// Scene file (TOML)
    pub(super) scene: PathBuf,
    /// Print one JSON document on stdout
    #[arg(long)]
    pub(super) json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum PathWord {
    /// Rays through a BVH
    Cast,
    /// The z-buffer rasterizer
    Raster,
}

/// `double` and `fast` exist to be compared with `exact` and come with that comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum AccuracyWord {
    /// Every pixel is the exact answer
    Exact,
    /// What a graphics processor does: snapped vertices, top-left rule, f32 depth (--path raster)
    Watertight,
}

fn parse_size(text: &str) -> Result<Resolution, String> {
    let wanted = || format!("expected WxH, for example 1920x1080, each side 1 to {MAX_SIDE}");
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(wanted)?;
    let [width, height] = [width, height].map(|side| side.trim().parse::<u32>().ok());
    width.zip(height).and_then(|(width, height)| Resolution::new(width, height)).ok_or_else(wanted)
}

fn parse_subpixel_bits(text: &str) -> Result<SubpixelBits, String> {
    let bits = text.trim().parse().ok().and_then(SubpixelBits::new);
    bits.ok_or_else(|| format!("expected a whole number from 0 to {}", SubpixelBits::MOST))
}

fn parse_crop(text: &str) -> Result<[u32; 4], String> {
    parse_numbers(text).ok_or_else(|| "expected four whole numbers X0,Y0,X1,Y1".to_owned())
}

fn parse_pixel(text: &str) -> Result<[u32; 2], String> {
    parse_numbers(text).ok_or_else(|| "expected two whole numbers X,Y".to_owned())
}

fn parse_numbers<const N: usize>(text: &str) -> Option<[u32; N]> {
    let numbers: Option<Vec<u32>> =
        text.split(',').map(|number| number.trim().parse().ok()).collect();
    numbers?.try_into().ok()
}
