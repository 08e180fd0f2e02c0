//! `truecast bench` as typed.

use clap::Args;
use std::path::PathBuf;
use truecast::bench::BenchOptions;
use truecast::pixel::Resolution;

#[derive(Debug, Args)]
#[command(
    after_help = "Every answer to a question of visibility is held against both paths at every \
pixel and against exact arithmetic at 200; a variant with a wrong answer gets no time but its number of \
wrong pixels. Exit status: 0 ok; 1 a wrong answer, or slower than the baseline beyond noise; 2 usage; \
3 bad scene, nothing visible, or a baseline of another scene, size or number of threads; 4 reading or \
writing failed; 130 interrupted."
)]
pub(in crate::cli) struct BenchArguments {
    /// Scene files (TOML); without any the built-in default scene, a teapot under spotlights
    #[arg(value_name = "SCENE")]
    pub(in crate::cli) scenes: Vec<PathBuf>,
    /// Also write the report to this file, .json or .csv by extension; may be repeated
    #[arg(short, long = "output", value_name = "FILE")]
    pub(in crate::cli) output: Vec<PathBuf>,
    /// Compare with an earlier report in JSON: a median that is larger by more than 5 % and by more
    /// than 3 times the sum of both median absolute deviations is slower beyond noise. It must be of
    /// the same scenes, size and number of threads. Measure both with the machine otherwise at rest:
    /// rounds tell how times spread within a run, not what else ran beside all of it
    #[arg(long, value_name = "FILE.json")]
    pub(in crate::cli) baseline: Option<PathBuf>,
    /// How often each variant is timed; all variants take turns in each round
    #[arg(long, value_name = "N", default_value_t = BenchOptions::STANDARD_ROUNDS,
          value_parser = parse_rounds)]
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

fn parse_rounds(text: &str) -> Result<usize, String> {
    let rounds = text.trim().parse().ok().filter(|rounds| (1..=1_000_000).contains(rounds));
    rounds.ok_or_else(|| "expected a whole number from 1 to 1000000".to_owned())
}
