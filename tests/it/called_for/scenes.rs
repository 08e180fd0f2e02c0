//! Twelve scenes from the plainest to everything, each of which calls for other effects. The tests
//! of neutrality and the bench of shading share them.

use std::path::Path;
use truecast::pixel::Resolution;
use truecast::scene::{Overrides, Scene};

/// How one scene differs from the others: a teapot on a floor.
struct Recipe {
    name: &'static str,
    /// Keys of the material of both meshes.
    material: &'static str,
    /// Keys of both meshes.
    meshes: &'static str,
    lights: &'static [&'static str],
    /// Switches, and what else stands at the end of the file.
    more: &'static str,
}

const PLAIN: Recipe = Recipe {
    name: "ambient",
    material: "ka = [0.5, 0.25, 0.75]",
    meshes: "",
    lights: &["type = \"ambient\"\nambient = [0.4, 0.5, 0.6]"],
    more: "",
};
const MATTE: &str = "kd = [0.7, 0.5, 0.2]";
const GLOSSY: &str = "kd = [0.7, 0.5, 0.2]\nks = [0.5, 0.6, 0.7]\nns = 30.0";
const MATTE_SUN: &str = "type = \"directional\"\naim = [1, -2, -3]\ndiffuse = [0.9, 0.8, 0.7]";
const SUN: &str = "type = \"directional\"\naim = [1, -2, -3]\nintensity = [0.9, 0.8, 0.7]";
const LAMP: &str = "type = \"point\"\nposition = [2, 5, 5]\nintensity = [0.9, 0.8, 0.7]\n\
    attenuation = [0.5, 0.1, 0.01]";
const HARD_SPOT: &str = "type = \"spot\"\nposition = [2, 6, 6]\ntarget = [0, 0.5, 0]\n\
    diffuse = [0.9, 0.8, 0.7]\ncutoff_deg = 9";
const SOFT_SPOT: &str = "type = \"spot\"\nposition = [-3, 6, 5]\ntarget = [0, 0.5, 0]\n\
    intensity = [0.6, 0.8, 0.9]\ncutoff_deg = 20\nexponent = 40\nattenuation = [1, 0, 0.01]";
const SKY: &str = "type = \"hemisphere\"\ndirection = [1, 3, 0.5]\ntop = [0.2, 0.4, 0.6]\n\
    bottom = [0.2, 0.1, 0]";

const RECIPES: [Recipe; 12] = [
    PLAIN,
    Recipe { name: "emission", material: "ke = [0.2, 0.1, 0.3]", lights: &[], ..PLAIN },
    Recipe { name: "directional, diffuse", material: MATTE, lights: &[MATTE_SUN], ..PLAIN },
    Recipe { name: "directional, specular", material: GLOSSY, lights: &[SUN], ..PLAIN },
    Recipe { name: "point, attenuation", material: GLOSSY, lights: &[LAMP], ..PLAIN },
    Recipe { name: "hard spot", material: MATTE, lights: &[HARD_SPOT], ..PLAIN },
    Recipe { name: "spot, exponent", material: GLOSSY, lights: &[SOFT_SPOT], ..PLAIN },
    Recipe { name: "hemisphere", material: MATTE, lights: &[SKY], ..PLAIN },
    Recipe {
        name: "textured",
        material: "kd_map = \"texture/checker.png\"\nfilter = \"mip\"",
        lights: &[MATTE_SUN],
        ..PLAIN
    },
    Recipe {
        name: "Gouraud",
        material: GLOSSY,
        meshes: "shading = \"gouraud\"",
        lights: &[LAMP],
        ..PLAIN
    },
    Recipe {
        name: "flat, one point",
        material: GLOSSY,
        meshes: "shading = \"flat\"",
        lights: &[LAMP, SKY],
        more: "[switches]\nflat = \"one-point\"\n",
    },
    Recipe {
        name: "everything",
        material: "ke = [0.02, 0.01, 0.03]\nka = [0.2, 0.2, 0.2]\nks = [0.5, 0.6, 0.7]\nns = 30.0\n\
            kd_map = \"texture/checker.png\"\nfilter = \"mip\"",
        meshes: "",
        lights: &[
            "type = \"ambient\"\nambient = [0.4, 0.5, 0.6]",
            "type = \"directional\"\naim = [1, -2, -3]\nintensity = [0.5, 0.4, 0.3]\nshadows = true",
            LAMP,
            HARD_SPOT,
            SOFT_SPOT,
            SKY,
        ],
        more: "[switches]\nfragment_vectors = \"interpolate\"\ninterpolation = \"screen\"\n\
            [[material]]\nname = \"glass\"\nkd = [0.3, 0.5, 0.5]\nopacity = 0.5\n\
            [[mesh]]\nshape = { uv_sphere = {} }\nmaterial = \"glass\"\ntranslate = [2, 1.5, 2]\n",
    },
];

/// The scenes by name, in this size.
pub(crate) fn scenes(width: u32, height: u32) -> Vec<(&'static str, Scene)> {
    let resolution = Resolution::new(width, height);
    RECIPES
        .iter()
        .map(|recipe| {
            let text = text(recipe);
            let base = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
            let overrides = Overrides { resolution, ..Overrides::default() };
            let scene = Scene::from_toml(&text, Path::new(recipe.name), &base, &overrides);
            (recipe.name, scene.unwrap_or_else(|errors| panic!("{errors}")))
        })
        .collect()
}

fn text(recipe: &Recipe) -> String {
    let Recipe { material, meshes, lights, more, name } = recipe;
    let samples = if *name == "everything" { 2 } else { 1 };
    let lights: String = lights.iter().map(|light| format!("[[light]]\n{light}\n")).collect();
    format!(
        "version = 1\n\
        [image]\nwidth = 16\nheight = 9\nsamples = {samples}\nbackground = [0.01, 0.02, 0.03]\n\
        [camera]\neye = [2.2, 5.2, 10.6]\ntarget = [0.25, 1.15, 0]\nup = [0, 1, 0]\n\
        fov_y_deg = 25\n\
        [[material]]\nname = \"m\"\n{material}\n\
        [[mesh]]\nshape = {{ plane = {{ width = 60.0, depth = 60.0 }} }}\nmaterial = \"m\"\n{meshes}\n\
        [[mesh]]\nshape = {{ teapot = {{ segments = 16 }} }}\nmaterial = \"m\"\n{meshes}\n\
        {lights}{more}"
    )
}
