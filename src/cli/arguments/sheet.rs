//! `truecast sheet` as typed.

use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(in crate::cli) struct SheetArguments {
    /// Sheet file (TOML): scenes, and what each cell changes in its scene
    pub(in crate::cli) sheet: PathBuf,
    /// Output file, .png [default: NAME.png after the sheet file]
    #[arg(short, long = "output", value_name = "FILE.png")]
    pub(in crate::cli) output: Option<PathBuf>,
    /// Number of threads; 0 is one per core
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(in crate::cli) threads: usize,
    /// Print one JSON document on stdout
    #[arg(long)]
    pub(in crate::cli) json: bool,
    /// No progress bar, no summary; errors only
    #[arg(long)]
    pub(in crate::cli) quiet: bool,
}
