//! A configuration as a scene file and an OBJ file, as a user would write them.

use super::configuration::{Attributes, Configuration, Light, Lights, Material, Spot};
use super::gl;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use truecast::scene::{Overrides, Scene};

impl Configuration {
    /// The scene: `head` holds the dialect and switches, `folder` receives the mesh.
    pub(super) fn scene(&self, head: &str, shading: &str, folder: &Path) -> Scene {
        let mut obj = String::new();
        for Attributes { position: [x, y, z], color: [r, g, b], .. } in self.attributes {
            writeln!(obj, "v {x:?} {y:?} {z:?} {r:?} {g:?} {b:?}").unwrap();
        }
        for [x, y, z] in self.attributes.map(|attribute| attribute.normal) {
            writeln!(obj, "vn {x:?} {y:?} {z:?}").unwrap();
        }
        obj += "f 1//1 2//2 3//3\n";
        fs::write(folder.join("triangle.obj"), obj).unwrap();
        let Material { emission, ambient, diffuse, specular, shininess } = &self.uniforms.material;
        let Self { eye, target, up, fov_y_deg, .. } = self;
        let matrix = self.model.concat();
        let mut text = format!(
            "version = 1\n{head}\n[image]\nwidth = 9\nheight = 9\n[camera]\neye = {eye:?}\n\
             target = {target:?}\nup = {up:?}\nfov_y_deg = {fov_y_deg:?}\n[[material]]\n\
             name = \"m\"\nke = {emission:?}\nka = {ambient:?}\nkd = {diffuse:?}\n\
             ks = {specular:?}\nns = {shininess:?}\n[[mesh]]\nfile = \"triangle.obj\"\n\
             material = \"m\"\nshading = \"{shading}\"\nmatrix = {matrix:?}\n"
        );
        for light in &self.uniforms.lights {
            self.write_light(light, &mut text);
        }
        Scene::from_toml(&text, Path::new("t.toml"), folder, &Overrides::default())
            .unwrap_or_else(|errors| panic!("{errors}\n{text}"))
    }

    fn write_light(&self, light: &Light, text: &mut String) {
        let Light { ambient, diffuse, specular, attenuation, .. } = light;
        let place = light.xyz();
        *text += "[[light]]\nparent = \"camera\"\n";
        if self.lights == Lights::Around {
            writeln!(
                text,
                "type = \"hemisphere\"\ndirection = {place:?}\ntop = {ambient:?}\n\
                 bottom = {diffuse:?}"
            )
            .unwrap();
            return;
        }
        writeln!(text, "ambient = {ambient:?}\ndiffuse = {diffuse:?}\nspecular = {specular:?}")
            .unwrap();
        if light.position[3] == 0.0 {
            let aim = gl::minus(place);
            writeln!(text, "type = \"directional\"\naim = {aim:?}").unwrap();
            return;
        }
        writeln!(text, "position = {place:?}\nattenuation = {attenuation:?}").unwrap();
        match &light.spot {
            None => *text += "type = \"point\"\n",
            Some(Spot { aim, cutoff_deg, exponent }) => writeln!(
                text,
                "type = \"spot\"\naim = {aim:?}\ncutoff_deg = {cutoff_deg:?}\n\
                 exponent = {exponent:?}"
            )
            .unwrap(),
        }
    }
}
