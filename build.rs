//! Tells the benchmark what built it: the compiler's version, and the commit where it is known.
//!
//! The commit is `TRUECAST_COMMIT` where the builder sets it, else what `cargo package` wrote into a
//! published package. A checkout is not asked: an answer that is not renewed with every commit would
//! be wrong, and one that is would compile the crate anew each time. Nothing else depends on either,
//! and the build needs no git.

use std::process::Command;

const COMMIT: &str = "TRUECAST_COMMIT";
const PACKAGED: &str = ".cargo_vcs_info.json";

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-env-changed={COMMIT}");
    let compiler = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    if let Some(version) = Command::new(compiler).arg("--version").output().ok()
        && let Ok(text) = String::from_utf8(version.stdout)
        && let Some(line) = text.lines().next()
    {
        println!("cargo:rustc-env=TRUECAST_RUSTC={line}");
    }
    let packaged = || sha1_of(&std::fs::read_to_string(PACKAGED).ok()?);
    if let Some(commit) = std::env::var(COMMIT).ok().or_else(packaged) {
        println!("cargo:rustc-env={COMMIT}={commit}");
    }
}

/// The value of `"sha1"` in the JSON that `cargo package` writes.
fn sha1_of(text: &str) -> Option<String> {
    let after = text.split("\"sha1\"").nth(1)?;
    let value = after.split('"').nth(1)?;
    value.chars().all(|c| c.is_ascii_hexdigit()).then(|| value.to_owned())
}
