//! `truecast bench` as typed.

use crate::cli::obj_scene::{FIELD_OF_VIEW_DEG, View};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use truecast::accel::BuildPreset;
use truecast::bench::BenchOptions;
use truecast::bench::workload::Work;
use truecast::pixel::Resolution;
use truecast::simd::SimdLevel;

#[derive(Debug, Args)]
#[command(
    after_help = "Every answer to a question of visibility is held against both paths at every \
pixel and against exact arithmetic at 200; a variant with a wrong answer gets no time but its number of \
wrong pixels. A program built with the features `peers` or `embree` times other programs' ray casters \
beside its own. Exit status: 0 ok; 1 a wrong answer, or slower than the baseline beyond noise; 2 usage; \
3 bad scene, nothing visible, nothing to measure, or a baseline of another scene, size or number of threads; 4 reading or \
writing failed; 130 interrupted."
)]
pub(in crate::cli) struct BenchArguments {
    /// Scene files (TOML), or mesh files (.obj), which are seen as a whole at 1920x1080; without any the
    /// built-in default scene, a teapot under spotlights
    #[arg(value_name = "SCENE|MESH.obj")]
    pub(in crate::cli) scenes: Vec<PathBuf>,
    /// Where mesh files are seen from
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_point, allow_hyphen_values = true,
          requires = "target")]
    pub(in crate::cli) eye: Option<[f64; 3]>,
    /// The point of mesh files in the middle of the frame
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_point, allow_hyphen_values = true,
          requires = "eye")]
    pub(in crate::cli) target: Option<[f64; 3]>,
    /// Full vertical angle of view of mesh files, in degrees
    #[arg(long, value_name = "DEG", default_value_t = FIELD_OF_VIEW_DEG)]
    pub(in crate::cli) fov: f64,
    /// Also write the report to this file, .json, .csv or .svg by extension; may be repeated
    #[arg(short, long = "output", value_name = "FILE")]
    pub(in crate::cli) output: Vec<PathBuf>,
    /// Compare with an earlier report in JSON: a median that is larger by more than 5 % and by more
    /// than 3 times the sum of both median absolute deviations is slower beyond noise. It must be of
    /// the same scenes, size and number of threads. Measure both with the machine otherwise at rest:
    /// rounds tell how times spread within a run, not what else ran beside all of it
    #[arg(long, value_name = "FILE.json")]
    pub(in crate::cli) baseline: Option<PathBuf>,
    /// Plot how times per ray grow with the number of triangles, over scenes that differ in it
    #[arg(long, value_name = "FILE.svg")]
    pub(in crate::cli) growth: Option<PathBuf>,
    /// How often each variant is timed; all variants take turns in each round
    #[arg(long, value_name = "N", default_value_t = BenchOptions::STANDARD_ROUNDS,
          value_parser = parse_rounds)]
    pub(in crate::cli) rounds: usize,
    /// Measure at this size instead of the scenes'
    #[arg(long, value_name = "WxH", value_parser = super::parse_size)]
    pub(in crate::cli) size: Option<Resolution>,
    /// Numbers of threads, separated by commas: each scene is measured on each; 0 is one per core
    #[arg(long, value_name = "N,...", value_delimiter = ',', default_value = "0")]
    pub(in crate::cli) threads: Vec<usize>,
    /// Kinds of work to measure, separated by commas [default: all]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_enum)]
    pub(in crate::cli) work: Vec<WorkWord>,
    /// Only variants whose name contains one of these texts, separated by semicolons: `cast
    /// medium;embree` [default: all]
    #[arg(long, value_name = "TEXT;...", value_delimiter = ';')]
    pub(in crate::cli) only: Vec<String>,
    /// Presets by which trees are built and cast at, separated by commas [default: all]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_enum)]
    pub(in crate::cli) preset: Vec<PresetWord>,
    /// Instruction sets that vector kernels are held to, Embree's too, separated by commas: each scene
    /// is measured on each; baseline, sse4.2, avx2 or avx512 [default: the machine's best]
    #[arg(long, value_name = "LEVEL,...", value_delimiter = ',', value_parser = parse_simd)]
    pub(in crate::cli) simd: Vec<SimdLevel>,
    /// The shared library of Embree, version 3 or 4 [default: the one that is installed]
    #[cfg(feature = "embree")]
    #[arg(long, value_name = "FILE")]
    pub(in crate::cli) embree: Option<PathBuf>,
    /// Print one JSON document on stdout
    #[arg(long)]
    pub(in crate::cli) json: bool,
    /// No progress bar, no table; errors and exit status only
    #[arg(long)]
    pub(in crate::cli) quiet: bool,
}

impl BenchArguments {
    /// How mesh files are seen.
    pub(in crate::cli) fn view(&self) -> View {
        let eye_and_target = self.eye.zip(self.target).map(|(eye, target)| [eye, target]);
        View { eye_and_target, fov_y_deg: self.fov }
    }

    /// What they ask of each scene.
    pub(in crate::cli) fn options(&self) -> BenchOptions {
        let mut options = BenchOptions {
            rounds: self.rounds,
            only: self.only.clone(),
            holds_simd: !self.simd.is_empty(),
            ..BenchOptions::default()
        };
        if !self.work.is_empty() {
            options.works = self.work.iter().map(|word| word.work()).collect();
        }
        if !self.preset.is_empty() {
            options.presets = self.preset.iter().map(|word| word.preset()).collect();
        }
        #[cfg(feature = "embree")]
        {
            options.embree.clone_from(&self.embree);
        }
        options
    }
}

/// A kind of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum WorkWord {
    /// Building trees
    Build,
    /// The nearest triangle along one ray per pixel
    Closest,
    /// Whether anything stands between each visible point and the first light
    Any,
    /// The nearest triangle at every pixel by the rasterizer
    Raster,
    /// Every triangle at every pixel, counted, by either path
    Cover,
    /// Colours, and the planes of the film
    Shade,
    /// A whole frame
    Frame,
}

impl WorkWord {
    const fn work(self) -> Work {
        match self {
            Self::Build => Work::Build,
            Self::Closest => Work::Closest,
            Self::Any => Work::Any,
            Self::Raster => Work::Raster,
            Self::Cover => Work::Cover,
            Self::Shade => Work::Shade,
            Self::Frame => Work::Frame,
        }
    }
}

/// A build preset.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum PresetWord {
    /// The quickest build
    Fastest,
    /// A quick build
    Fast,
    /// The standard
    Medium,
    /// A slow build
    Slow,
    /// A build that may take minutes on overlapping triangles
    VerySlow,
}

impl PresetWord {
    const fn preset(self) -> BuildPreset {
        match self {
            Self::Fastest => BuildPreset::Fastest,
            Self::Fast => BuildPreset::Fast,
            Self::Medium => BuildPreset::Medium,
            Self::Slow => BuildPreset::Slow,
            Self::VerySlow => BuildPreset::VerySlow,
        }
    }
}

fn parse_point(text: &str) -> Result<[f64; 3], String> {
    let numbers: Option<Vec<f64>> = text
        .split(',')
        .map(|number| number.trim().parse().ok().filter(|n: &f64| n.is_finite()))
        .collect();
    let point = numbers.and_then(|numbers| numbers.try_into().ok());
    point.ok_or_else(|| "expected three finite numbers, such as 3,1.5,-2".to_owned())
}

fn parse_simd(text: &str) -> Result<SimdLevel, String> {
    let level: SimdLevel = text.parse().map_err(|error| format!("{error}"))?;
    let available = SimdLevel::available();
    if available.contains(&level) {
        return Ok(level);
    }
    let names: Vec<&str> = available.into_iter().map(SimdLevel::name).collect();
    Err(format!("this machine has only {}", names.join(", ")))
}

pub(super) fn parse_rounds(text: &str) -> Result<usize, String> {
    let rounds = text.trim().parse().ok().filter(|rounds| (1..=1_000_000).contains(rounds));
    rounds.ok_or_else(|| "expected a whole number from 1 to 1000000".to_owned())
}
