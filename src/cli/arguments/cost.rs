//! `truecast cost` as typed.

use clap::Args;
use std::path::PathBuf;
use truecast::cost::CostOptions;
use truecast::pixel::Resolution;

#[derive(Debug, Args)]
#[command(
    after_help = "Two choices are priced. Accuracy: how visibility is decided, on both paths, against \
the exact answer. Tessellation: flat, Gouraud and Phong shading of every torus, uv_sphere and icosphere \
of the scene at 1/4, 1/2, 1 and 2 times the fineness written, against the curved surface itself. All \
settings of a choice take turns in each round. Exit status: 0 ok; 1 an exact level was wrong; 2 usage; 3 \
bad scene, or nothing visible; 4 reading or writing failed; 130 interrupted."
)]
pub(in crate::cli) struct CostArguments {
    /// Scene files (TOML); without any a built-in scene, a torus and a sphere on a floor
    #[arg(value_name = "SCENE")]
    pub(in crate::cli) scenes: Vec<PathBuf>,
    /// Also write the prices to this file: .json, .csv, or .svg with error against time, by
    /// extension; may be repeated
    #[arg(short, long = "output", value_name = "FILE")]
    pub(in crate::cli) output: Vec<PathBuf>,
    /// How often each setting is timed
    #[arg(long, value_name = "N", default_value_t = CostOptions::STANDARD_ROUNDS,
          value_parser = super::bench::parse_rounds)]
    pub(in crate::cli) rounds: usize,
    /// Measure at this size instead of the scenes'
    #[arg(long, value_name = "WxH", value_parser = super::parse_size)]
    pub(in crate::cli) size: Option<Resolution>,
    /// Number of threads; 0 is one per core
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(in crate::cli) threads: usize,
    /// Print one JSON document on stdout
    #[arg(long)]
    pub(in crate::cli) json: bool,
    /// No progress bar, no table; errors and exit status only
    #[arg(long)]
    pub(in crate::cli) quiet: bool,
}
