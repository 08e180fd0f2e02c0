//! Cases of the catalogue that do not run at its full size in every run of the suite: what runs, and
//! what runs with `TRUECAST_FULL=1` in the environment.

use std::sync::LazyLock;

/// A number of a case that is smaller in the suite than in the catalogue.
pub(crate) struct CaseSize {
    /// The case, as in the names of tests.
    pub(crate) case: &'static str,
    /// What is counted.
    pub(crate) unit: &'static str,
    /// So many run in the suite.
    suite: usize,
    /// So many run at full size.
    full: usize,
}

/// Closed meshes that go through all configurations; the others of 250 go through one.
pub(crate) const H14: CaseSize =
    CaseSize { case: "h14", unit: "meshes through all configurations", suite: 25, full: 250 };

/// Rays to vertices of the large sphere, at each of two centres.
pub(crate) const H15: CaseSize =
    CaseSize { case: "h15", unit: "rays at each centre", suite: 30_000, full: 300_000 };

/// Of 20 000 rays to the middles of edges at each centre, those that the rasterizer answers too.
pub(crate) const H16: CaseSize =
    CaseSize { case: "h16", unit: "rays rasterized at each centre", suite: 1000, full: 20_000 };

/// Grains of dust that go through all configurations; in the suite a million through one.
pub(crate) const H18: CaseSize =
    CaseSize { case: "h18", unit: "grains through all configurations", suite: 0, full: 1_000_000 };

/// Rays from inside the sphere through each of two trees.
pub(crate) const H57: CaseSize =
    CaseSize { case: "h57", unit: "rays through each tree", suite: 30_000, full: 300_000 };

/// Build presets of a million copies of a triangle.
pub(crate) const H58: CaseSize =
    CaseSize { case: "h58", unit: "build presets of 10^6 copies", suite: 1, full: 5 };

/// Pixels of each of 100 shuffles that the arbiter looks at; at full size in tiles of six sides.
pub(crate) const H63: CaseSize =
    CaseSize { case: "h63", unit: "pixels audited per shuffle", suite: 2, full: 289 };

/// Pixels of 10⁴ rays at 10⁴ triangles that the arbiter looks at.
pub(crate) const H64: CaseSize =
    CaseSize { case: "h64", unit: "pixels audited", suite: 100, full: 10_000 };

/// Pixels that the arbiter looks at, each with thousands of exact candidates; at full size 10⁴
/// triangles go through all configurations.
pub(crate) const H7A: CaseSize =
    CaseSize { case: "h7a", unit: "pixels audited of 10^4 triangles", suite: 6, full: 289 };

/// All of them, in the order of the catalogue. Every other case always runs at its full size.
pub(crate) const REDUCED: [CaseSize; 9] = [H14, H15, H16, H18, H57, H58, H63, H64, H7A];

/// Whether the full sizes run.
pub(crate) fn is_full() -> bool {
    static FULL: LazyLock<bool> =
        LazyLock::new(|| std::env::var_os("TRUECAST_FULL").is_some_and(|value| value == "1"));
    *FULL
}

impl CaseSize {
    /// The number that runs.
    pub(crate) fn running(&self) -> usize {
        if is_full() { self.full } else { self.suite }
    }

    /// The catalogue's number.
    pub(crate) fn full(&self) -> usize {
        self.full
    }
}
