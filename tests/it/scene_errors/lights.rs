//! Faults of `[[light]]`, `[switches]` and effects that are not simulated.

use super::*;

#[track_caller]
pub(super) fn light_refused(marked: &str, messages: &[&str]) {
    refused(&format!("[[light]]\n{marked}"), messages);
}

#[test]
fn light_types() {
    let errors = refused("[[light]]\ntype = ▸\"spott\"\n", &["there is no type of light `spott`"]);
    assert_eq!(help(&errors), "did you mean `spot`?");
    light_refused("type = ▸\"area\"\n", &["area lights are not simulated"]);
    light_refused(
        "type = \"hemisphere\"\ndirection = ▸[0, 0, 0]\ntop = ▸[1, -1, 1]\n▸shadows = true\nbottom = [0, 0, 0]\n",
        &[
            "`direction` is a direction and must not have length 0",
            "`top` must be at least 0 in every channel, not -1",
            "the type `hemisphere` has no use for `shadows`",
        ],
    );
    light_refused(
        "type = \"ambient\"\nambient = [1, 1, 1]\n▸intensity = [1, 1, 1]\n",
        &["the type `ambient` has no use for `intensity`"],
    );
    light_refused(
        "type = \"directional\"\naim = [0, -1, 0]\nintensity = [1, 1, 1]\n▸target = [0, 0, 0]\n▸attenuation = [1, 0, 0]\n",
        &[
            "the type `directional` has no use for `target`",
            "the type `directional` has no use for `attenuation`",
        ],
    );
    light_refused(
        "type = \"point\"\nposition = [0, 1, 0]\nintensity = [1, 1, 1]\n▸cutoff_deg = 5\nshadows = true\n",
        &["the type `point` has no use for `cutoff_deg`"],
    );
}

#[test]
fn light_keys() {
    let missing = |text: &str, messages: &[&str]| {
        refused(&format!("{}[[light]]\n{text}", "▸".repeat(messages.len())), messages);
    };
    missing("type = \"ambient\"\n", &["a `ambient` light lacks `ambient`"]);
    missing(
        "type = \"directional\"\n",
        &["a `directional` light lacks a colour", "a `directional` light lacks `aim`"],
    );
    missing(
        "type = \"spot\"\nintensity = [1, 1, 1]\n",
        &[
            "a `spot` light lacks `position`",
            "a `spot` light lacks `target` or `aim`",
            "a `spot` light lacks `cutoff_deg`",
        ],
    );
    light_refused(
        "type = \"spot\"\nposition = [0, 1, 0]\ntarget = [0, 0, 0]\naim = ▸[0, -1, 0]\ncutoff_deg = ▸0\n\
         exponent = ▸-1\nintensity = [1, 1, 1]\ndiffuse = ▸[1, 1, 1]\nattenuation = ▸[1, -1, 0]\n",
        &[
            "a spot has either `target` or `aim`, not both",
            "`cutoff_deg` must be greater than 0 and at most 180, not 0",
            "`exponent` must be at least 0, not -1",
            "`intensity` sets `diffuse`; a light has either, not both",
            "each number of `attenuation` must be at least 0, not -1",
        ],
    );
    light_refused(
        "type = \"spot\"\nposition = [0, 1, 0]\ntarget = ▸[0, 1, 0]\ncutoff_deg = ▸180.5\n\
         intensity = ▸[1, 1, -1]\nspecular = ▸[1, 1, 1]\nattenuation = ▸[0, 0, 0]\n",
        &[
            "`target − position` is a direction and must not have length 0",
            "`cutoff_deg` must be greater than 0 and at most 180, not 180.5",
            "`intensity` must be at least 0 in every channel, not -1",
            "`intensity` sets `specular`; a light has either, not both",
            "the numbers of `attenuation` must not all be 0",
        ],
    );
    light_refused(
        "type = \"directional\"\naim = ▸[0, 0, 0]\nintensity = [1, 1, 1]\n",
        &["`aim` is a direction and must not have length 0"],
    );
}

#[test]
fn dialects_and_switches_that_do_not_exist() {
    let errors =
        refused_whole(&format!("dialect = ▸\"curles\"\n{HEAD}"), &["there is no dialect `curles`"]);
    assert_eq!(help(&errors), "did you mean `curless`?");
    refused(
        "[switches]\nspecular = ▸\"fong\"\nrenormalize = false\nviewer = ▸\"near\"\nka = ▸true\nnaive_normals = ▸\"no\"\n",
        &[
            "`specular` must be \"blinn\" or \"phong\", not \"fong\"",
            "`viewer` must be \"local\" or \"distant\", not \"near\"",
            "`ka` must be \"own\" or \"kd\", not true or false",
            "`naive_normals` must be true or false, not \"no\"",
        ],
    );
}

#[test]
fn effects_that_no_scene_can_have() {
    refused(
        "[▸fog]\ndensity = 1\n[[mesh]]\nshape = { plane = {} }\n▸reflection = 1\n",
        &["`fog`: fog is not simulated", "`reflection`: reflection is not simulated"],
    );
    refused_whole(
        &HEAD.replace("fov_y_deg", "▸depth_of_field = true\nfov_y_deg"),
        &["`depth_of_field`: depth of field is not simulated; the camera is a pinhole"],
    );
}
