//! The layering test must be able to fail: forbidden imports in every spelling, and texts that
//! only look like one.

use super::violations;

fn at(module: &str) -> Vec<String> {
    module.split("::").map(str::to_owned).collect()
}

/// Spellings of a use of `raster` by a file of `exact` that is the module exact::part.
const FORBIDDEN: &[&str] = &[
    "use crate::raster::Row;",
    "use crate::raster;",
    "pub use crate::raster::Row as Other;",
    "pub(crate) use crate :: raster :: Row ;",
    "use crate::{mesh::TriangleId, raster::Row};",
    "use crate::{mesh, raster};",
    "use crate::raster::{self};",
    "use crate::{\n    mesh::{TriangleId, TriangleMesh},\n    raster::{tiles::Tile},\n};",
    "use crate::{self as all, mesh};",
    "use {crate::mesh::TriangleId, crate::raster::Row};",
    "use crate::*;",
    "use crate::{*};",
    "use crate as all;",
    "extern crate self as all;",
    "use truecast::raster::Row;",
    "use ::truecast::raster::Row;",
    "use super::super::raster::Row;",
    "use super::{interval, super::raster::Row};",
    "use self::super::super::raster::Row;",
    "use super::super::*;",
    "use r#crate::raster::Row;",
    "mod tests { use super::super::super::raster::Row; }",
    "mod a { mod b { fn f() {} } use super::super::super::raster; }",
    "fn f() { crate::raster::rasterize(); }",
    "fn f(row: &crate::raster::Row) -> Vec<crate::mesh::TriangleId> { todo() }",
    "fn f() { super::super::raster::rasterize(); }",
    "impl crate::raster::Fill for Contact {}",
    "macro_rules! m { () => { $crate::raster::rasterize() } }",
    "/* a comment */ use /* inside */ crate::raster::Row; // and behind",
    "const QUOTE: char = '\"'; use crate::raster::Row; const OTHER: char = '\"';",
    "fn f<'a>(x: &'a str) { crate::raster::g::<'a>(x) }",
    "const TEXT: &str = \"a \\\" b\"; use crate::raster::Row;",
    "const TEXT: &str = r#\"a \" b\"#; use crate::raster::Row;",
    "include!(\"../raster/rows.rs\");",
    "#[path = \"../raster.rs\"]\nmod rows;",
];

#[test]
fn every_spelling_of_a_forbidden_import_is_found() {
    for sample in FORBIDDEN {
        let wrong = violations(sample, &at("exact::part"));
        assert_eq!(wrong.len(), 1, "{sample}\n{wrong:?}");
    }
}

#[test]
fn allowed_uses_and_mere_mentions_pass() {
    let fine = [
        "use crate::mesh::TriangleId; use crate::{pixel::Pixel, scene::{Scene, camera}};",
        "use super::rational; use crate::exact::interval::Interval;",
        "mod tests { use super::*; use super::super::rational; }",
        "pub(crate) fn f() {} pub(super) struct S; pub(in crate::exact) mod m;",
        "// use crate::raster::Row;\n/// See [`crate::raster::Row`].\n//! crate::cast",
        "/* use crate::raster; /* nested */ use crate::cast; */",
        "const A: &str = \"crate::raster\"; const B: &str = r#\"use crate::\"cast\"#;",
        "const C: &[u8] = b\"crate::raster\"; const D: &str = \"\\\"; use crate::raster;\";",
        "use std::fmt; use dashu_ratio::Relaxed; fn raster() {} let raster = 1;",
        "let c = include_str!(\"raster.txt\"); #[path = \"part_tests.rs\"] mod tests;",
        "use some::raster::Row; fn f() { other::crate_::raster() }",
    ];
    for sample in fine {
        assert_eq!(violations(sample, &at("exact::part")), Vec::<String>::new(), "{sample}");
    }
}

#[test]
fn the_table_decides_by_module() {
    let uses = |module: &str, used: &str| {
        violations(&format!("use crate::{used}::Thing;"), &at(module)).is_empty()
    };
    for (user, used) in [
        ("cast", "raster"),
        ("cast", "exact"),
        ("raster", "cast"),
        ("raster", "accel"),
        ("exact", "cast"),
        ("exact", "accel"),
        ("shade", "cast"),
        ("shade", "accel"),
        ("render", "exact"),
        ("mesh", "pixel"),
        ("scene", "visibility"),
        ("film", "scene"),
        ("accel", "scene"),
        ("check", "cli"),
        ("scene::camera", "cast"),
        ("cast", "unheard_of"),
    ] {
        assert!(!uses(user, used), "{user} must not use {used}");
    }
    for (user, used) in [
        ("cast", "accel"),
        ("render", "accel"),
        ("check", "exact"),
        ("check::audit", "exact"),
        ("cli::check", "check"),
        ("main", "cli"),
        ("lib", "raster"),
    ] {
        assert!(uses(user, used), "{user} may use {used}");
    }
}

#[test]
fn a_module_without_a_row_is_an_error() {
    assert_eq!(
        violations("fn f() {}", &at("mystery::part")),
        ["`mystery` is missing from the table of floors"]
    );
}

#[test]
fn super_in_a_top_level_module_climbs_to_the_root() {
    let wrong = violations("use super::raster::Row; use super::mesh::TriangleId;", &at("exact"));
    assert_eq!(wrong, ["`exact` may not use `crate::raster::Row`"]);
}
