//! Words and numbers drawn together: dialects, switches, ways of shading, textures, samples, frames,
//! with up to three numbers replaced by special floats.

use super::scenes::Form;
use super::{Fate, SPECIALS, assert_sound, load, marks, substitute};
use truecast::film::Samples;
use truecast::render::{PlaneGroups, RenderOptions, Unwatched, VisibilityPath, render};
use truecast::scene::switches::{DIALECTS, SWITCHES};
use truecast::scene::{Scene, Shading};
use truecast::shade::doubt;

/// Numbers stand in ‹›, words that are drawn between two ¦.
const SCENE: &str = "version = 1
dialect = \"¦dialect¦\"
[image]
width = 7
height = 5
samples = ¦samples¦
background = [‹0.1›, 0.2, 0.3]
[camera]
eye = [‹0.5›, ‹1.0›, ‹6.0›]
target = [0.0, ‹0.25›, 0.0]
up = [0.0, 1.0, 0.0]
fov_y_deg = ‹45.0›
[switches]
¦switches¦[[material]]
name = \"m\"
¦preset¦kd = [‹0.5›, 0.6, 0.7]
ka = [0.25, ‹0.25›, 0.25]
ke = [0.0, ‹0.0›, 0.125]
ns = ‹32.0›
opacity = ¦opacity¦
¦map¦¦unlit¦
[[mesh]]
name = \"body\"
file = \"mesh.obj\"
shading = \"¦shading¦\"
sides = \"¦sides¦\"
¦material¦¦normals¦scale = [‹1.5›, ‹1.0›, ‹1.25›]
rotate_deg = [‹10.0›, 20.0, ‹30.0›]
[[mesh]]
shape = { cone = { radius = ‹1.0›, height = ‹1.5›, around = 7 } }
shading = \"¦shading¦\"
material = \"m\"
translate = [‹0.5›, ‹-1.0›, ‹-1.0›]
[[light]]
type = \"hemisphere\"
parent = \"¦parent¦\"
direction = [‹0.5›, ‹1.0›, ‹0.25›]
top = [‹0.5›, 0.5, 1.0]
bottom = [‹0.25›, 0.25, 0.0]
[[light]]
type = \"spot\"
parent = \"¦parent¦\"
position = [‹2.0›, ‹3.0›, ‹4.0›]
aim = [‹-0.5›, ‹-0.75›, ‹-1.0›]
diffuse = [‹1.0›, 0.9, 0.8]
specular = [‹0.5›, 0.5, 0.5]
ambient = [0.1, ‹0.1›, 0.0]
attenuation = [‹1.0›, ‹0.5›, ‹0.25›]
cutoff_deg = ‹60.0›
exponent = ‹8.0›
shadows = ¦shadows¦
[[light]]
type = \"point\"
parent = \"¦parent¦\"
position = [‹-2.0›, ‹2.0›, ‹3.0›]
intensity = [‹0.5›, 0.5, 0.5]
attenuation = [‹0.0›, ‹0.25›, 0.5]
shadows = ¦shadows¦
[[light]]
type = \"directional\"
parent = \"¦parent¦\"
aim = [‹0.25›, ‹-1.0›, ‹-0.5›]
intensity = [0.5, ‹0.5›, 0.25]
shadows = ¦shadows¦
";

const OBJ: &str = "mtllib mesh.mtl
v ‹-2.0› ‹-2.0› ‹0.0› ‹0.5› 0.25 1
v ‹2.0› ‹-2.0› ‹0.5› 1 ‹0.5› 0
v ‹0.0› ‹2.5› ‹-0.5› 0 1 ‹0.25›
v -3 -3 -2 0 0 1
v 3 -3 -2 0 1 0
v 0 4 ‹-2› 1 0 0
vt ‹0.0› ‹0.25›
vt ‹1.0› 0
vt 0 ‹1.0›
vn ‹0.0› ‹0.0› ‹1.0›
vn 0.5 ‹0.0› 1
vn 0 ‹0.5› 1
usemtl shiny
f 1/1/1 2/2/2 3/3/3
f 4/1 5/2 6/3
";

const MTL: &str = "newmtl shiny
Kd ‹0.5› ‹0.6› 0.7
Ks ‹0.5› 0.5 0.5
Ns ‹32.0›
d ‹1.0›
map_Kd -s ‹2.0› ‹3.0› 1 -o ‹0.5› ‹0.25› 0 texels.png
";

/// A small repeatable sequence (Knuth's multiplier).
struct Dice(u64);

impl Dice {
    fn below(&mut self, count: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % count
    }

    fn one_of<'a>(&mut self, words: &[&'a str]) -> &'a str {
        words[self.below(words.len())]
    }
}

/// What to write in the place of a word.
fn draw(place: &str, dice: &mut Dice) -> String {
    let word = match place {
        "dialect" => dice.one_of(&DIALECTS),
        "samples" => dice.one_of(&["1", "1", "1", "2", "3"]),
        "preset" => dice.one_of(&["", "preset = \"metal\"\n", "preset = \"red-plastic\"\n"]),
        "map" => dice.one_of(&[
            "",
            "kd_map = \"texels.png\"\n",
            "kd_map = \"texels.png\"\nks_map = \"texels.png\"\nfilter = \"mip\"\n",
            "ks_map = \"texels.png\"\nfilter = \"nearest\"\nwrap = \"clamp\"\n",
        ]),
        "opacity" => dice.one_of(&["1.0", "‹1.0›", "‹0.75›"]),
        "unlit" => dice.one_of(&["", "", "", "unlit = true"]),
        "shading" => Shading::NAMED[dice.below(Shading::NAMED.len())].1,
        "sides" => dice.one_of(&["single", "double"]),
        "material" => dice.one_of(&["", "material = \"m\"\n"]),
        "normals" => dice.one_of(&[
            "",
            "vertex_normals = \"angle\"\n",
            "vertex_normals = \"area\"\ncrease_deg = ‹60.0›\n",
        ]),
        "parent" => dice.one_of(&["world", "camera", "mesh:body"]),
        "shadows" => dice.one_of(&["false", "false", "true"]),
        "switches" => {
            let mut lines = String::new();
            for switch in &SWITCHES {
                if dice.below(3) != 0 {
                    continue;
                }
                let value = match switch.words {
                    [] => dice.one_of(&["true", "false"]).to_owned(),
                    words => format!("{:?}", dice.one_of(words)),
                };
                lines += &format!("{} = {value}\n", switch.name);
            }
            return lines;
        }
        _ => unreachable!("{place}"),
    };
    word.to_owned()
}

/// The scene with its words drawn, and up to `most` of its numbers replaced.
fn drawn(dice: &mut Dice, most: usize) -> [String; 3] {
    let parts: Vec<&str> = SCENE.split('¦').collect();
    let scene: String = parts
        .iter()
        .enumerate()
        .map(|(k, part)| if k % 2 == 1 { draw(part, dice) } else { (*part).to_owned() })
        .collect();
    let mut texts = [scene, OBJ.to_owned(), MTL.to_owned()];
    for _ in 0..dice.below(most + 1) {
        let text = &mut texts[dice.below(3)];
        let place = dice.below(marks(text));
        let special = SPECIALS[dice.below(SPECIALS.len())];
        *text = keep_marks(text, place, special);
    }
    texts
}

/// Replaces one marked number and leaves every mark.
fn keep_marks(text: &str, place: usize, special: &str) -> String {
    let mut parts: Vec<&str> = text.split_inclusive(['‹', '›']).collect();
    let number = format!("{special}›");
    parts[2 * place + 1] = &number;
    parts.concat()
}

/// The plane `invalid` says where what the counts say how often: for one opaque sample per pixel
/// each says it, for more the centre's cases need not be the samples'.
fn assert_consistent(scene: &Scene, is_simple: bool, name: &str) {
    for path in [VisibilityPath::Cast, VisibilityPath::Raster] {
        let planes = PlaneGroups::all();
        let frame =
            render(scene, &RenderOptions { path, planes, ..Default::default() }, &Unwatched);
        let Some(Samples::Uint(bits)) = frame.film.plane("invalid") else { panic!("{name}") };
        let pixels = |bit: u32| bits.iter().filter(|bits| **bits & bit != 0).count();
        let notes = frame.account.notes;
        assert_eq!(pixels(doubt::BEYOND_RANGE), frame.film.infinite_pixels(), "{name}");
        if !is_simple {
            continue;
        }
        assert!(notes.non_finite as usize <= frame.film.infinite_pixels(), "{name}");
        for (bit, count) in [
            (doubt::LIGHT_AT_SURFACE, notes.lights_at_surface),
            (doubt::NEAR_TERMINATOR, notes.near_terminator),
            (doubt::OPPOSITE_VIEW, notes.opposite_view),
            (doubt::CANCELLED_NORMAL, notes.cancelled_normals),
            (doubt::MISSING_NORMAL, notes.missing_normals),
            (doubt::CANCELLED_VECTORS, notes.cancelled_vectors),
            (doubt::PERSPECTIVE_KEPT, notes.perspective_kept),
        ] {
            assert_eq!(pixels(bit) > 0, count > 0, "{name}: bit {bit}: {notes:?}");
        }
    }
}

#[test]
fn words_and_special_numbers_drawn_together() {
    let folder = tempfile::tempdir().unwrap();
    let texels =
        image::RgbImage::from_fn(4, 2, |x, y| image::Rgb([60 * x as u8, 200 * y as u8, 9]));
    texels.save(folder.path().join("texels.png")).unwrap();
    let mut dice = Dice(20_261_127);
    let mut fate = Fate::default();
    let mut simple = 0;
    for round in 0..ROUNDS {
        // A quarter as they stand: every combination of words is a scene.
        let most = if round % 4 == 0 { 0 } else { 3 };
        let texts = drawn(&mut dice, most);
        let form = Form { name: "drawn", scene: &texts[0], obj: &texts[1], mtl: &texts[2] };
        let name =
            format!("round {round}\n{}", texts.each_ref().map(|t| substitute(t, None)).concat());
        let loaded = load(&form, folder.path(), 0, None);
        assert!(most > 0 || loaded.is_ok(), "{name}: {:?}", loaded.err());
        if let Ok(scene) = &loaded {
            let is_opaque = scene.materials.iter().all(|material| material.opacity == 1.0);
            let casts = scene.lights.iter().any(|light| light.casts_shadows());
            let is_simple = is_opaque && !casts && scene.samples.count() == 1;
            simple += usize::from(is_simple);
            assert_consistent(scene, is_simple, &name);
        }
        assert_sound(loaded, &name, &mut fate);
    }
    assert!(fate.rendered > ROUNDS / 2 && fate.refused > ROUNDS / 20, "{fate:?}");
    assert!(simple > 10, "{simple}");
    assert!(fate.differing.is_empty(), "{} scenes: {}", fate.differing.len(), fate.differing[0]);
    // Only colours and texture coordinates may leave f32.
    let may_overflow = |plane: &String| super::OVERFLOWING.contains(&plane.as_str());
    assert!(fate.overflowing.iter().all(may_overflow), "{:?}", fate.overflowing);
}

const ROUNDS: usize = 600;
