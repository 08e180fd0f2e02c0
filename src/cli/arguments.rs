//! The command line as typed.

mod bench;
mod cost;
mod lobe;
mod sheet;

pub(super) use bench::BenchArguments;
pub(super) use cost::CostArguments;
pub(super) use lobe::{LobeArguments, SpecularWord};
pub(super) use sheet::SheetArguments;

use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;
use truecast::check::foreign::depth::DEPTH_TOLERANCE_RELATIVE;
use truecast::check::foreign::ids::NOT_FINITE;
use truecast::pixel::{MAX_SIDE, Resolution};
use truecast::raster::{DepthBuffer, DepthFormat, SubpixelBits};
use truecast::render::visible::SubsampleGrid;
use truecast::scene::sampling::SampleGrid;
use truecast::shade::Precision;

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
    /// Write the oracle bundle: triangles, camera and the exact answer of every pixel, for other programs
    Export(ExportArguments),
    /// Explain one pixel: every candidate, the winner, every light term
    Pixel(PixelArguments),
    /// Say which effects the scene calls for, and its resolved camera and switches
    Explain(ExplainArguments),
    /// Time building, casting, rasterizing and shading; a wrong answer gets no time
    Bench(BenchArguments),
    /// Price accuracy: each way to decide and to tessellate, its time against its errors
    Cost(CostArguments),
    /// Lay several renders out in one labelled PNG
    Sheet(SheetArguments),
    /// Draw the goniometric diagram of a reflectance: its polar curves for one light
    Lobe(LobeArguments),
}

#[derive(Debug, Args)]
pub(super) struct RenderArguments {
    /// Scene file (TOML); without it the built-in default scene, a teapot under spotlights
    pub(super) scene: Option<PathBuf>,
    /// Output file; .exr, .png or .npy (ids) by extension; may be repeated [default: NAME.png and
    /// NAME.exr after the scene file, or truecast.png and truecast.exr]
    #[arg(short, long = "output", value_name = "FILE")]
    pub(super) output: Vec<PathBuf>,
    /// Which of the two independent paths answers [default: the one that is predicted to be quicker,
    /// which `explain` tells; the pictures are the same. With another accuracy than exact: raster]
    #[arg(long, value_enum)]
    pub(super) path: Option<PathWord>,
    /// How visibility is decided; only exact promises anything about ids. The others show neither
    /// see-through surfaces nor shadows, and each path has its own
    #[arg(long, value_enum, default_value_t = AccuracyWord::Exact)]
    pub(super) accuracy: AccuracyWord,
    /// Numbers that colours are computed with: double, or single, which is quicker and within 2^-16 of
    /// a light's full radiance per root of its exponents (see `shade::single_error`). Ids, depths and
    /// every other plane are the same
    #[arg(long, value_enum, default_value_t = ShadingWord::Double)]
    pub(super) shading: ShadingWord,
    /// Bits of the watertight rasterizer's grid below the pixel, 0 to 12 [default: 8]
    #[arg(long, value_name = "N", value_parser = parse_subpixel_bits)]
    pub(super) subpixel_bits: Option<SubpixelBits>,
    /// Store the watertight or the fast rasterizer's depths as a graphics processor does, in 16 or 24
    /// bits or as f32 (32); equal stored depths of different triangles show as ties in the plane verdict.tie
    #[arg(long, value_name = "16|24|32", value_parser = parse_depth_bits)]
    pub(super) depth_bits: Option<DepthFormat>,
    /// Depth along the view axis that is stored as 0
    #[arg(long, value_name = "Z", requires = "depth_bits", allow_negative_numbers = true,
          default_value_t = DepthBuffer::STANDARD_NEAR)]
    pub(super) near: f64,
    /// Depth along the view axis that is stored as 1
    #[arg(long, value_name = "Z", requires = "depth_bits", allow_negative_numbers = true,
          default_value_t = DepthBuffer::STANDARD_FAR)]
    pub(super) far: f64,
    /// Planes of the EXR: a comma-separated list of rgba, Z, t, P, N, Ns, uv, bary, id, facing,
    /// cover, verdict, stable, invalid; or all [default: all but cover, stable and invalid]
    #[arg(long, value_name = "LIST")]
    pub(super) aov: Option<String>,
    /// Render at this size instead of the scene's
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(super) size: Option<Resolution>,
    /// NxN samples per pixel for colour and alpha instead of the scene's, N from 1 to 16; every other
    /// plane is of the pixel centre
    #[arg(long, value_name = "N", value_parser = parse_samples)]
    pub(super) samples: Option<SampleGrid>,
    /// Render only columns X0..X1 and rows Y0..Y1 (X1 and Y1 excluded)
    #[arg(long, value_name = "X0,Y0,X1,Y1", value_parser = parse_crop)]
    pub(super) crop: Option<[u32; 4]>,
    /// Keep only this light, by its name or its number from 0 on; may be repeated
    #[arg(long, value_name = "NAME|INDEX")]
    pub(super) light: Vec<String>,
    /// Keep only the ambient part of every light
    #[arg(long)]
    pub(super) ambient_only: bool,
    /// List the visible triangles: id, mesh, file and line, number of pixels, first pixel
    #[arg(long, value_name = "LIST.csv")]
    pub(super) visible: Option<PathBuf>,
    /// Also look at NxN sub-samples in every pixel (N is 2, 4, 8 or 16), and list triangles that no
    /// pixel centre sees; even these are not all: a sliver may lie between sub-samples
    #[arg(long, value_name = "N", requires = "visible", value_parser = parse_subpixel)]
    pub(super) subpixel: Option<SubsampleGrid>,
    /// Folder in which BVHs are kept between runs, under the digest of their triangles; a damaged file
    /// is not used
    #[arg(long, value_name = "DIR")]
    pub(super) bvh_cache: Option<PathBuf>,
    /// Leave out faces of mesh files with a corner that is not finite or out of range, with a
    /// warning, instead of stopping; ids count the triangles that remain
    #[arg(long)]
    pub(super) skip_bad: bool,
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
    #[command(flatten)]
    pub(super) foreign: ForeignArguments,
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
    /// Compare the colour of NxN samples per pixel instead of the scene's, N from 1 to 16
    #[arg(long, value_name = "N", value_parser = parse_samples)]
    pub(super) samples: Option<SampleGrid>,
    /// Leave out faces of mesh files with a corner that is not finite or out of range, with a
    /// warning, instead of stopping; ids count the triangles that remain
    #[arg(long)]
    pub(super) skip_bad: bool,
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
#[command(next_help_heading = "Another program's picture, held against the exact answer")]
pub(super) struct ForeignArguments {
    /// Its triangle ids: .npy, .exr (channel `id.prim`, or the only UINT one) or .png
    #[arg(long, value_name = "FILE", conflicts_with_all = ["pixel", "audit", "samples"])]
    pub(super) ids: Option<PathBuf>,
    /// Its depths: .exr or .npy; along the view axis, or ray parameters if the channel is named `t`
    #[arg(long, value_name = "FILE", conflicts_with_all = ["pixel", "audit", "samples"])]
    pub(super) depth: Option<PathBuf>,
    /// EXR channel of the ids
    #[arg(long, value_name = "NAME", requires = "ids")]
    pub(super) ids_channel: Option<String>,
    /// EXR channel of the depths
    #[arg(long, value_name = "NAME", requires = "depth")]
    pub(super) depth_channel: Option<String>,
    /// Number of its first triangle; with 1, 0 means nothing
    #[arg(long, value_name = "0|1", requires = "ids", default_value_t = 0,
          value_parser = clap::value_parser!(i64).range(0..=1))]
    pub(super) id_base: i64,
    /// Its mark of nothing, a whole number or `nan` [default: 4294967295]
    #[arg(long, value_name = "VALUE", requires = "ids", value_parser = parse_background,
          allow_negative_numbers = true)]
    pub(super) background: Option<i64>,
    /// Its rows run from the bottom up
    #[arg(long)]
    pub(super) flip_y: bool,
    /// Which byte of a PNG pixel is the high one of the id
    #[arg(long, value_enum, requires = "ids", default_value_t = PackedWord::Rgb)]
    pub(super) png_order: PackedWord,
    /// Largest relative error of a depth that is no error
    #[arg(long, value_name = "R", requires = "depth", value_parser = parse_tolerance,
          default_value_t = DEPTH_TOLERANCE_RELATIVE)]
    pub(super) depth_tolerance: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum PackedWord {
    /// 65536 R + 256 G + B
    Rgb,
    /// 65536 B + 256 G + R
    Bgr,
}

#[derive(Debug, Args)]
pub(super) struct ExportArguments {
    /// Scene file (TOML)
    pub(super) scene: PathBuf,
    /// Folder to write; a former bundle is replaced, any other folder must be empty
    #[arg(short, long = "output", value_name = "DIR")]
    pub(super) output: PathBuf,
    /// Export at this size instead of the scene's
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(super) size: Option<Resolution>,
    /// Leave out faces of mesh files with a corner that is not finite or out of range, with a
    /// warning, instead of stopping; ids count the triangles that remain
    #[arg(long)]
    pub(super) skip_bad: bool,
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
    /// Leave out faces of mesh files with a corner that is not finite or out of range, with a
    /// warning, instead of stopping; ids count the triangles that remain
    #[arg(long)]
    pub(super) skip_bad: bool,
    /// Print one JSON document on stdout
    #[arg(long)]
    pub(super) json: bool,
}

#[derive(Debug, Args)]
pub(super) struct ExplainArguments {
    /// Scene file (TOML)
    pub(super) scene: PathBuf,
    /// Also measure what each effect costs on this scene: the share of the shading time that is
    /// saved without it, median of 7 rounds; an effect's share includes all that depends on it, so
    /// shares do not add up to 100 %. Those of other effects than supersampling are of one sample
    /// per pixel. With --json, effects[] get `share`, and `median_ms` and `mad_ms` of the time
    /// without the effect
    #[arg(long)]
    pub(super) measure: bool,
    /// Explain the scene at this size instead of its own
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(super) size: Option<Resolution>,
    /// Leave out faces of mesh files with a corner that is not finite or out of range, with a
    /// warning, instead of stopping; ids count the triangles that remain
    #[arg(long)]
    pub(super) skip_bad: bool,
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

/// `cost` tells what each saves and loses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum AccuracyWord {
    /// Every pixel is the exact answer
    Exact,
    /// f64, believed
    Double,
    /// No holes between neighbours: on raster what a graphics processor does (snapped vertices,
    /// top-left rule, f32 depth), on cast the f32 test of Woop, Benthin and Wald
    Watertight,
    /// f32, believed
    Fast,
}

/// `--shading`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ShadingWord {
    /// f64
    Double,
    /// f32 where its error is bounded
    Single,
}

impl ShadingWord {
    pub(super) const fn precision(self) -> Precision {
        match self {
            Self::Double => Precision::Double,
            Self::Single => Precision::Single,
        }
    }
}

fn parse_size(text: &str) -> Result<Resolution, String> {
    let wanted = || format!("expected WxH, for example 1920x1080, each side 1 to {MAX_SIDE}");
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(wanted)?;
    let [width, height] = [width, height].map(|side| side.trim().parse::<u32>().ok());
    width.zip(height).and_then(|(width, height)| Resolution::new(width, height)).ok_or_else(wanted)
}

fn parse_samples(text: &str) -> Result<SampleGrid, String> {
    let side = text.trim().parse().ok();
    side.and_then(SampleGrid::new)
        .ok_or_else(|| format!("expected a whole number from 1 to {}", SampleGrid::MOST))
}

fn parse_subpixel(text: &str) -> Result<SubsampleGrid, String> {
    let side = text.trim().parse().ok();
    side.and_then(SubsampleGrid::new).ok_or_else(|| "expected 2, 4, 8 or 16".to_owned())
}

fn parse_subpixel_bits(text: &str) -> Result<SubpixelBits, String> {
    let bits = text.trim().parse().ok().and_then(SubpixelBits::new);
    bits.ok_or_else(|| format!("expected a whole number from 0 to {}", SubpixelBits::MOST))
}

fn parse_depth_bits(text: &str) -> Result<DepthFormat, String> {
    let bits = text.trim().parse().ok().and_then(DepthFormat::of_bits);
    bits.ok_or_else(|| "expected 16, 24 or 32".to_owned())
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

fn parse_background(text: &str) -> Result<i64, String> {
    match text.trim() {
        nan if nan.eq_ignore_ascii_case("nan") => Ok(NOT_FINITE),
        number => {
            // As u64 too, so that 2^64 - 1 can be written as it is; it is read as -1.
            let whole = number.parse::<i64>().ok();
            whole
                .or_else(|| number.parse::<u64>().ok().map(|word| word as i64))
                .ok_or_else(|| "expected a whole number or nan".to_owned())
        }
    }
}

fn parse_tolerance(text: &str) -> Result<f64, String> {
    let tolerance = text.trim().parse::<f64>().ok();
    tolerance
        .filter(|tolerance| tolerance.is_finite() && *tolerance >= 0.0)
        .ok_or_else(|| "expected a number that is not negative, for example 1e-6".to_owned())
}
