//! Faults of `[[material]]` and `[[mesh]]`.

use super::*;
use truecast::scene::error::Fault;

/// The same for a mesh with a shape.
#[track_caller]
pub(super) fn mesh_refused(marked: &str, messages: &[&str]) {
    refused(&format!("[[mesh]]\nshape = {{ plane = {{}} }}\n{marked}"), messages);
}

#[test]
fn materials() {
    refused(
        "[[material]]\nname = \"a\"\nkd = ▸[1, -1, 0]\nns = ▸-1\nopacity = ▸-0.5\nkd_map = \"w.png\"\n\
         [[material]]\nname = ▸\"a\"\nopacity = ▸2\nfilter = ▸\"mip\"\nwrap = ▸\"clamp\"\n▸[[material]]\n",
        &[
            "`kd` must be at least 0 in every channel, not -1",
            "`ns` must be at least 0, not -1",
            "`opacity` must be from 0 to 1, not -0.5",
            "the name `a` is taken by another material",
            "`opacity` must be from 0 to 1, not 2",
            "`filter` has no use without `kd_map` or `ks_map`",
            "`wrap` has no use without `kd_map` or `ks_map`",
            "[[material]] lacks `name`",
        ],
    );
    let errors = refused(
        "[[material]]\nname = \"brass\"\n[[mesh]]\nshape = { plane = {} }\nmaterial = ▸\"bras\"\n",
        &["there is no material `bras`"],
    );
    assert_eq!(help(&errors), "did you mean `brass`?");
    // A faulty material may be the one that is meant: no second error.
    refused(
        "[[material]]\nname = \"brass\"\nkd = ▸1\n[[mesh]]\nshape = { plane = {} }\nmaterial = \"brass\"\n",
        &["`kd` must be a list of 3 numbers, not a whole number"],
    );
}

#[test]
fn meshes() {
    refused("▸[[mesh]]\n", &["[[mesh]] lacks `file` or `shape`"]);
    refused(
        "[[mesh]]\nfile = \"a.obj\"\n▸shape = { plane = {} }\n",
        &["a mesh has either `file` or `shape`, not both"],
    );
    mesh_refused(
        "shading = ▸\"flatt\"\nsides = ▸\"both\"\n",
        &[
            "there is no shading \"flatt\"",
            "`sides` must be \"single\" or \"double\", not \"both\"",
        ],
    );
    let errors = refused(
        "[[mesh]]\npolygons = ▸\"fans\"\nfile = ▸\"no.ply\"\n",
        &[
            "`polygons` must be \"ears\" or \"fan\", not \"fans\"",
            "ply files are not read by this version",
        ],
    );
    assert_eq!(help(&errors), "did you mean `fan`?");
    mesh_refused("▸polygons = \"fan\"\n", &["`polygons` belongs to a mesh with `file`"]);
    mesh_refused("shading = ▸\"phon\"\n", &["there is no shading \"phon\""]);
    mesh_refused(
        "matrix = ▸[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 1]]\nscale = ▸1\ntranslate = ▸[0, 0, 0]\n",
        &[
            "the last row of `matrix` must be 0 0 0 1, not 0 0 1 1",
            "a mesh has either `matrix` or `scale`, not both",
            "a mesh has either `matrix` or `translate`, not both",
        ],
    );
    refused(
        "▸[[mesh]]\nshape = { plane = {} }\nscale = 1e40\n",
        &[
            "mesh `plane`: a corner at (-1e40, 0e0, -1e40) after the transform; each coordinate must \
           be finite and at most 2^126 (8.5e37) in magnitude",
        ],
    );
}

#[test]
fn shapes() {
    refused("[[mesh]]\nshape = ▸\"plane\"\n", &["`shape` must be a table, not a string"]);
    refused("[[mesh]]\nshape = ▸{}\n", &["`shape` must name one shape, not 0"]);
    let errors = refused("[[mesh]]\nshape = { ▸plain = {} }\n", &["there is no shape `plain`"]);
    assert_eq!(help(&errors), "did you mean `plane`?");
    let errors = refused(
        "[[mesh]]\nshape = { torus = { major = 2, ▸minr = 1 } }\n",
        &["unknown key `minr` in shape `torus`"],
    );
    assert_eq!(help(&errors), "did you mean `minor`?");
    refused(
        "[[mesh]]\nshape = { torus = { major = ▸\"1\" } }\n\
         [[mesh]]\nshape = { torus = { around = ▸-3 } }\n\
         [[mesh]]\nshape = { torus = { around = ▸3.5 } }\n\
         [[mesh]]\nshape = { cone = { caps = ▸1 } }\n\
         [[mesh]]\nshape = { torus = ▸3 }\n",
        &[
            "`major` must be a number, not string \"1\"",
            "`around` must be a whole number, 0 or more, not -3",
            "`around` must be a whole number, 0 or more, not 3.5",
            "`caps` must be true or false, not 1",
            "`torus` must be a table of its parameters, not a whole number",
        ],
    );
    refused(
        "[[mesh]]\nshape = { torus = { major = 1, minor = ▸-1 } }\n",
        &["torus: minor is -1, but must be a length from 1e-18 to 1e18"],
    );
}

#[test]
fn mesh_files_that_cannot_be_read() {
    let errors = load(&format!("{HEAD}[[mesh]]\nfile = \"no-such.obj\"\n")).unwrap_err();
    assert_eq!(errors.fault(), Fault::Reading);
    let error = &errors.0[0];
    assert_eq!((error.place.line, error.place.column), (11, 8));
    assert!(
        error.message.starts_with("the mesh file `scenes/no-such.obj` cannot be read: "),
        "{error}"
    );
    refused(
        "[[mesh]]\nfile = ▸\"a.ply\"\n[[mesh]]\nfile = ▸\"a.png\"\n",
        &[
            "ply files are not read by this version",
            "`scenes/a.png` is not the name of a mesh file",
        ],
    );
    // The same missing file twice is one fault.
    let twice = load(&format!("{HEAD}[[mesh]]\nfile = \"x.obj\"\n[[mesh]]\nfile = \"x.obj\"\n"));
    assert_eq!(twice.unwrap_err().0.len(), 1);
    let missing = Scene::load(Path::new("no-such.toml"), &Overrides::default()).unwrap_err();
    assert_eq!(missing.fault(), Fault::Reading);
    assert!(missing.to_string().starts_with("no-such.toml: the scene file cannot be read: "));
}
