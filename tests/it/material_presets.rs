//! `preset` and `unlit` of a material, and the advice about coefficients.

use std::path::Path;
use truecast::scene::hash::content_hash;
use truecast::scene::material::Material;
use truecast::scene::{Overrides, Scene};

fn load(material: &str) -> Result<Scene, String> {
    let text = format!(
        "version = 1\n[image]\nwidth = 4\nheight = 4\n[camera]\neye = [0, 0, 5]\n\
         target = [0, 0, 0]\nup = [0, 1, 0]\nfov_y_deg = 45\n[[material]]\nname = \"m\"\n{material}"
    );
    Scene::from_toml(&text, Path::new("t.toml"), Path::new(""), &Overrides::default())
        .map_err(|errors| errors.to_string())
}

fn material(text: &str) -> Material {
    load(text).unwrap().materials.remove(0)
}

#[test]
fn a22_presets_follow_the_advice() {
    for word in Material::PRESETS {
        let preset = material(&format!("preset = \"{word}\"\n"));
        assert_eq!(Some(&preset), Material::preset(word, "m").as_ref());
        for k in 0..3 {
            let sum = preset.ka[k] + preset.kd[k] + preset.ks[k];
            assert!(sum > 0.0 && sum < 1.0, "{word}: {sum}");
            assert!(preset.ka[k] <= 0.1, "{word}");
        }
        assert_eq!((preset.ke, preset.unlit, preset.excess()), ([0.0; 3], false, None));
    }
    let [metal, plastic, planet, clay, red] =
        Material::PRESETS.map(|w| Material::preset(w, "").unwrap());
    assert!((100.0..=200.0).contains(&metal.ns) && metal.kd[0] < metal.ks[0]);
    // A metal's highlight has the metal's colour, a plastic's has the light's.
    assert!(metal.ks[0] > metal.ks[2] && metal.kd[0] > metal.kd[2]);
    for white in [&plastic, &red] {
        assert!((10.0..=30.0).contains(&white.ns));
        assert_eq!(white.ks, [white.ks[0]; 3]);
    }
    assert!(red.kd[0] > 10.0 * red.kd[1]);
    for matte in [planet, clay] {
        assert_eq!((matte.ks, matte.ns), ([0.0; 3], 0.0));
    }
}

#[test]
fn a22_written_keys_replace_those_of_the_preset() {
    let preset = Material::preset("metal", "m").unwrap();
    let changed = material("preset = \"metal\"\nkd = [0.5, 0.25, 0]\nns = 10\n");
    assert_eq!(changed, Material { kd: [0.5, 0.25, 0.0], ns: 10.0, ..preset });
    // Without a preset, ka still follows kd.
    assert_eq!(material("kd = [0.5, 0.25, 0]\n").ka, [0.5, 0.25, 0.0]);
}

#[test]
fn a22_an_unknown_preset_is_refused_with_a_suggestion() {
    let message = load("preset = \"red-plastik\"\n").unwrap_err();
    assert!(message.contains("t.toml:12:10: there is no preset `red-plastik`"), "{message}");
    assert!(message.contains("did you mean `red-plastic`?"), "{message}");
    assert!(load("preset = \"qqq\"\n").unwrap_err().contains("known here: metal, plastic"));
}

#[test]
fn a22_more_than_arrives_is_told() {
    assert_eq!(material("kd = [0.5, 0.5, 0.5]\nks = [0.5, 0.25, 0.5]\n").excess(), None);
    assert_eq!(material("kd = [0.5, 0.5, 0.5]\nks = [0.5, 0.75, 0.5]\n").excess(), Some(1.25));
    // The default material has ka = kd = 0.8, and that is no fault.
    assert_eq!(material("").excess(), None);
}

#[test]
fn a19_unlit_is_read_and_part_of_the_digest() {
    assert!(!material("").unlit && !material("unlit = false\n").unlit);
    assert!(material("unlit = true\n").unlit);
    let digest = |text: &str| content_hash(&load(text).unwrap());
    assert_eq!(digest(""), digest("unlit = false\n"));
    assert_ne!(digest(""), digest("unlit = true\n"));
    let message = load("unlit = 1\n").unwrap_err();
    assert!(message.contains("`unlit` must be true or false, not a whole number"), "{message}");
}
