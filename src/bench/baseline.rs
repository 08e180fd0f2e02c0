//! A report held against an earlier one: what became slower, beyond noise.
//!
//! Times are compared only for the same scene, size, number of threads and instruction set; anything
//! else is an error, never a result. That the machine is the same is for people to know: see
//! [`Baseline::cpu`]. Other programs' times are theirs, and not compared.

use super::report::SCHEMA;
use super::{Measured, Subject};
use serde::Deserialize;

/// A median must be larger by this share of the old one to be called slower.
const LEAST_SHARE: f64 = 0.05;

/// And by this many times the sum of both deviations. Three deviations of a normal distribution are
/// two of its standard deviations.
const DEVIATIONS: f64 = 3.0;

/// A median with its deviation, in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Time {
    /// The median.
    pub median: f64,
    /// The median absolute deviation.
    pub deviation: f64,
}

/// A variant's time then and now.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// The scene.
    pub scene: String,
    /// The variant.
    pub name: String,
    /// The time of the baseline.
    pub old: Time,
    /// The time of now.
    pub new: Time,
}

impl Compared {
    /// Whether it became slower beyond noise: by more than three times the sum of both deviations,
    /// and by more than 5 %.
    pub fn is_regression(&self) -> bool {
        let more = self.new.median - self.old.median;
        more > DEVIATIONS * (self.new.deviation + self.old.deviation)
            && more > LEAST_SHARE * self.old.median
    }

    /// New over old median.
    pub fn ratio(&self) -> f64 {
        self.new.median / self.old.median
    }
}

/// Why a baseline cannot be compared with.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BaselineError {
    /// Not the JSON of a report.
    #[error("not a report of `truecast bench`: {0}; write one with -o FILE.json")]
    NotReport(String),
    /// The JSON of something else, or of another version of reports.
    #[error("the schema is `{0}`, not `{SCHEMA}`; write a new one with -o FILE.json")]
    Schema(String),
    /// Other numbers of threads.
    #[error(
        "{scene} was measured on {old} threads, not {new}; give --threads {old}, or measure it anew"
    )]
    Threads {
        /// The scene.
        scene: String,
        /// Those of the baseline, separated by commas.
        old: String,
        /// Of now.
        new: usize,
    },
    /// Another instruction set.
    #[error("{scene} was measured on {old}, not {new}; give --simd {old}, or measure it anew")]
    Simd {
        /// The scene.
        scene: String,
        /// Those of the baseline, separated by commas.
        old: String,
        /// Of now.
        new: String,
    },
    /// The scene at another size.
    #[error("{scene} was measured at {old}, not {new}; give --size {old}, or measure it anew")]
    Size {
        /// The scene.
        scene: String,
        /// Size of the baseline as WxH, in pixels.
        old: String,
        /// Of now.
        new: String,
    },
    /// The scene has changed.
    #[error(
        "{scene} is not the scene that was measured: its digest is {new}, was {old}; measure it anew"
    )]
    Digest {
        /// The scene.
        scene: String,
        /// Digest of the baseline.
        old: String,
        /// Of now.
        new: String,
    },
    /// The scene was not measured.
    #[error("{scene} was not measured (only {measured}); leave it out, or measure it anew")]
    Missing {
        /// The scene.
        scene: String,
        /// Those that were.
        measured: String,
    },
    /// No variant has a time in both.
    #[error(
        "{scene}: no variant has a time both then and now, so nothing was compared; measure it anew"
    )]
    NothingInCommon {
        /// The scene.
        scene: String,
    },
}

/// An earlier report.
#[derive(Clone, Debug, Deserialize)]
pub struct Baseline {
    machine: OldMachine,
    scenes: Vec<OldScene>,
}

#[derive(Clone, Debug, Deserialize)]
struct Head {
    schema: String,
}

#[derive(Clone, Debug, Deserialize)]
struct OldMachine {
    cpu: Option<String>,
}

#[derive(Clone, Debug, Deserialize)]
struct OldScene {
    scene: String,
    digest: String,
    width: u32,
    height: u32,
    threads: usize,
    simd: String,
    rows: Vec<OldRow>,
}

#[derive(Clone, Debug, Deserialize)]
struct OldRow {
    name: String,
    median_ms: Option<f64>,
    mad_ms: Option<f64>,
}

impl OldRow {
    fn time(&self) -> Option<Time> {
        let (median, deviation) = self.median_ms.zip(self.mad_ms)?;
        Some(Time { median: 1e-3 * median, deviation: 1e-3 * deviation })
    }
}

impl Baseline {
    /// Reads the JSON of a report.
    ///
    /// # Errors
    /// When it is something else; with line and column where that is known.
    pub fn parse(text: &str) -> Result<Self, BaselineError> {
        let not_report = |error: serde_json::Error| BaselineError::NotReport(error.to_string());
        let head: Head = serde_json::from_str(text).map_err(not_report)?;
        if head.schema != SCHEMA {
            return Err(BaselineError::Schema(head.schema));
        }
        serde_json::from_str(text).map_err(not_report)
    }

    /// Model of the processor that it was measured on, if known.
    pub fn cpu(&self) -> Option<&str> {
        self.machine.cpu.as_deref()
    }

    /// Whether times of this subject can be compared with it.
    ///
    /// # Errors
    /// When anything in which subjects may differ is another one.
    pub fn admit(&self, subject: &Subject) -> Result<(), BaselineError> {
        self.scene(subject).map(|_| ())
    }

    /// Every variant that has a time in both, in the order of now.
    ///
    /// # Errors
    /// As [`Self::admit`], and when no variant has.
    pub fn compare(&self, measured: &Measured) -> Result<Vec<Compared>, BaselineError> {
        let scene = &measured.subject.name;
        let old = self.scene(&measured.subject)?;
        let compared: Vec<Compared> = measured
            .rows
            .iter()
            .filter(|row| row.program.is_none())
            .filter_map(|row| {
                let new = row.times?;
                let old = old.rows.iter().find(|old| old.name == row.name)?.time()?;
                Some(Compared {
                    scene: scene.clone(),
                    name: row.name.clone(),
                    old,
                    new: Time { median: new.median, deviation: new.deviation },
                })
            })
            .collect();
        match compared.is_empty() {
            true => Err(BaselineError::NothingInCommon { scene: scene.clone() }),
            false => Ok(compared),
        }
    }

    /// The entry with the subject's digest, or in what the one of its name differs.
    fn scene(&self, subject: &Subject) -> Result<&OldScene, BaselineError> {
        let same: Vec<_> = self.scenes.iter().filter(|old| old.digest == subject.digest).collect();
        let alike: Vec<_> = same.iter().filter(|old| old.threads == subject.threads).collect();
        if let Some(alike) = alike.iter().find(|old| old.simd == subject.simd.name()) {
            return Ok(alike);
        }
        if !alike.is_empty() {
            let old: Vec<&str> = alike.iter().map(|old| &*old.simd).collect();
            return Err(BaselineError::Simd {
                scene: subject.name.clone(),
                old: old.join(","),
                new: subject.simd.to_string(),
            });
        }
        if !same.is_empty() {
            let old: Vec<String> = same.iter().map(|old| old.threads.to_string()).collect();
            return Err(BaselineError::Threads {
                scene: subject.name.clone(),
                old: old.join(","),
                new: subject.threads,
            });
        }
        let scene = subject.name.clone();
        let Some(old) = self.scenes.iter().find(|old| old.scene == scene) else {
            let names: Vec<&str> = self.scenes.iter().map(|old| &*old.scene).collect();
            return Err(BaselineError::Missing { scene, measured: names.join(", ") });
        };
        let size = |width, height| format!("{width}x{height}");
        let new = size(subject.resolution.width(), subject.resolution.height());
        if size(old.width, old.height) != new {
            return Err(BaselineError::Size { scene, old: size(old.width, old.height), new });
        }
        Err(BaselineError::Digest { scene, old: old.digest.clone(), new: subject.digest.clone() })
    }
}

#[cfg(test)]
mod tests;
