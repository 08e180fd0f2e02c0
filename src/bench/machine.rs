//! What a benchmark ran on, as far as the standard library, Linux and the build tell.

use std::thread::available_parallelism;

/// The machine of a benchmark.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Machine {
    /// Logical cores that this process may use; `None` where the system does not say.
    pub logical_cores: Option<usize>,
    /// Model of the processor; `None` outside Linux, and where Linux does not name it.
    pub cpu: Option<String>,
    /// Version of this crate.
    pub version: &'static str,
    /// Version of the compiler that built it; `None` where it does not tell.
    pub rustc: Option<&'static str>,
    /// Commit that it was built from, where the package or the builder says so: see `build.rs`.
    pub commit: Option<&'static str>,
}

impl Machine {
    /// This machine.
    pub fn here() -> Self {
        let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        Self {
            logical_cores: available_parallelism().ok().map(usize::from),
            cpu: cpu_model(&text),
            version: env!("CARGO_PKG_VERSION"),
            rustc: option_env!("TRUECAST_RUSTC"),
            commit: option_env!("TRUECAST_COMMIT"),
        }
    }
}

/// The first `model name` of the text of `/proc/cpuinfo`.
fn cpu_model(text: &str) -> Option<String> {
    text.lines()
        .filter_map(|line| line.split_once(':'))
        .find(|(key, _)| key.trim() == "model name")
        .map(|(_, model)| model.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::cpu_model;

    #[test]
    fn the_model_is_named_where_there_is_one() {
        let text =
            "processor\t: 0\nmodel\t\t: 79\nmodel name\t: Abacus 3000 @ 2 Hz\nflags\t: fpu\n";
        assert_eq!(cpu_model(text).as_deref(), Some("Abacus 3000 @ 2 Hz"));
        assert_eq!(cpu_model("processor : 0\nCPU part : 0xd0c\n"), None);
    }
}
