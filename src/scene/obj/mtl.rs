//! MTL libraries: the coefficients that the shading equation has.
//!
//! Of textures, those of Kd and Ks are asked for; other maps, refraction and physically based
//! extensions are left out with a warning by name. tobj is not used here: it panics on `Kd 0.8` and
//! gives no lines.

mod map;

use crate::color::LinearRgb;
use crate::scene::error::SceneError;
use crate::scene::material::Material;
use crate::scene::obj::report::{Report, quote};
use crate::scene::obj::statement::{Statements, without_comment};
use crate::scene::texture::{TextureRequest, TextureRequests, Untextured};
use map::read_map;
use std::collections::HashMap;
use std::path::Path;

/// Largest exponent of the format's description.
const MAX_FORMAT_EXPONENT: f64 = 1000.0;

/// The materials of all libraries that a file names.
#[derive(Debug, Default)]
pub(super) struct Library {
    materials: Vec<Material>,
    /// The textures that each asks for.
    textures: Vec<TextureRequests>,
    by_name: HashMap<String, usize>,
    /// Under their names without what looks like a comment.
    by_bare_name: HashMap<String, usize>,
}

impl Library {
    /// The material that a `usemtl` means. Names may hold `#`, and a comment may follow them; so
    /// the name as written goes first, and comments are cut only where it is not found.
    pub(super) fn find(&self, name: &str) -> Option<&Material> {
        self.position(name).map(|position| &self.materials[position])
    }

    /// The textures of the material that a `usemtl` means.
    pub(super) fn textures(&self, name: &str) -> Option<&TextureRequests> {
        self.position(name).map(|position| &self.textures[position])
    }

    fn position(&self, name: &str) -> Option<usize> {
        let bare = without_comment(name);
        let position = self
            .by_name
            .get(name)
            .or_else(|| self.by_name.get(bare))
            .or_else(|| self.by_bare_name.get(bare));
        position.copied()
    }

    /// Adds a material; true when one of the same name gives way.
    fn insert(&mut self, material: Material, textures: TextureRequests) -> bool {
        let position = self.materials.len();
        self.by_bare_name.insert(without_comment(&material.name).to_owned(), position);
        let replaced = self.by_name.insert(material.name.clone(), position).is_some();
        self.materials.push(material);
        self.textures.push(textures);
        replaced
    }
}

/// Adds the materials of one library. Faults go to the report.
pub(super) fn read_library(text: &str, file: &Path, library: &mut Library, report: &mut Report) {
    let mut walk = Statements::new(text, file);
    let mut current: Option<Draft> = None;
    while walk.advance() {
        let keyword = walk.keyword();
        if keyword.text == "newmtl" {
            finish(current.take(), file, library, report);
            let name = walk.name();
            if name.is_empty() {
                let place = walk.place(&keyword);
                report.error(SceneError::scene(place, "`newmtl` gives no name"));
            }
            current = Some(Draft::new(name, keyword.line));
        } else if let Some(draft) = &mut current {
            if let Err(error) = draft.read(&walk, file, report) {
                report.error(error);
            }
        } else {
            report.warn(file, keyword.line, "statements before the first `newmtl` are left out");
        }
    }
    finish(current, file, library, report);
}

/// A material whose statements are still coming; they may come in any order.
struct Draft {
    name: String,
    line: u32,
    ka: Option<LinearRgb>,
    kd: Option<LinearRgb>,
    ks: Option<LinearRgb>,
    ke: Option<LinearRgb>,
    ns: Option<f64>,
    kd_map: Option<TextureRequest>,
    ks_map: Option<TextureRequest>,
    has_specular: bool,
    unlit: bool,
    opacity: Option<f64>,
    transparency: Option<f64>,
}

impl Draft {
    fn new(name: String, line: u32) -> Self {
        Self {
            name,
            line,
            ka: None,
            kd: None,
            ks: None,
            ke: None,
            ns: None,
            kd_map: None,
            ks_map: None,
            has_specular: true,
            unlit: false,
            opacity: None,
            transparency: None,
        }
    }

    fn read(
        &mut self,
        walk: &Statements<'_>,
        file: &Path,
        report: &mut Report,
    ) -> Result<(), SceneError> {
        let keyword = walk.keyword();
        let line = keyword.line;
        match keyword.text {
            "Ka" | "Kd" | "Ks" | "Ke" => {
                let color = read_color(walk, file, report)?;
                let slot = match keyword.text {
                    "Ka" => &mut self.ka,
                    "Kd" => &mut self.kd,
                    "Ks" => &mut self.ks,
                    _ => &mut self.ke,
                };
                *slot = color.or(*slot);
            }
            "Ns" => {
                let exponent = read_coefficient(walk, 0)?;
                if exponent > MAX_FORMAT_EXPONENT {
                    let sentence = "`Ns` exceeds the format's largest, 1000; it is used as written";
                    report.warn(file, line, sentence);
                }
                self.ns = Some(exponent);
            }
            "map_Kd" => self.kd_map = Some(read_map(walk, file, report)?),
            "map_Ks" => self.ks_map = Some(read_map(walk, file, report)?),
            "illum" => self.read_model(walk, file, report)?,
            "d" => {
                // `-halo` makes the opacity depend on the angle.
                let has_halo = walk.values().first().is_some_and(|token| token.text == "-halo");
                if has_halo {
                    let sentence = "`d -halo` (opacity that depends on the angle) is not \
                                    simulated; its number counts at every angle";
                    report.warn(file, line, sentence);
                }
                self.opacity = Some(read_share(walk, usize::from(has_halo), file, report)?);
            }
            "Tr" => self.transparency = Some(read_share(walk, 0, file, report)?),
            // The index of refraction acts in the models 5 to 7 only, which warn by themselves.
            "Ni" => {}
            word => {
                let sentence =
                    format!("{} is not simulated by this version; left out", quote(word));
                report.warn(file, line, &sentence);
            }
        }
        Ok(())
    }

    /// `illum N`: which terms the material has.
    fn read_model(
        &mut self,
        walk: &Statements<'_>,
        file: &Path,
        report: &mut Report,
    ) -> Result<(), SceneError> {
        let line = walk.keyword().line;
        let token = walk.values().first().copied().unwrap_or(walk.keyword());
        self.has_specular = true;
        self.unlit = false;
        match token.text.parse::<u8>() {
            Ok(0) => {
                self.unlit = true;
                self.has_specular = false;
            }
            Ok(1) => self.has_specular = false,
            Ok(2) => {}
            Ok(model @ 3..=10) => {
                let effect = match model {
                    3 | 8 => "the reflection of other surfaces",
                    4 | 9 => "reflecting, transparent glass",
                    5 => "Fresnel reflection",
                    6 => "refraction",
                    7 => "refraction and Fresnel reflection",
                    _ => "shadows on invisible surfaces",
                };
                let sentence = format!(
                    "`illum {model}` asks for {effect}, which is not simulated; the surface is \
                     shaded as `illum 2`"
                );
                report.warn(file, line, &sentence);
            }
            _ => {
                let message = format!("{} is no illumination model", quote(token.text));
                return Err(SceneError::scene(walk.place(&token), message)
                    .with_help("models are numbered from 0 to 10"));
            }
        }
        Ok(())
    }
}

/// Puts a draft's defaults in and adds it to the library.
fn finish(draft: Option<Draft>, file: &Path, library: &mut Library, report: &mut Report) {
    let Some(draft) = draft else { return };
    let disagree = |d: f64, tr: f64| (d - (1.0 - tr)).abs() > 1e-6;
    if let (Some(d), Some(tr)) = (draft.opacity, draft.transparency)
        // 1e-6: exporters write six decimals.
        && disagree(d, tr)
    {
        let sentence = "`d` and `Tr` of a material disagree (`Tr` is 1 - `d`); `d` counts";
        report.warn(file, draft.line, sentence);
    }
    let default = Material::default_named(&draft.name);
    // A texture alone is the whole coefficient.
    let unless_textured = |map: &Option<_>, default| if map.is_some() { [1.0; 3] } else { default };
    let plain_kd = draft.kd.unwrap_or(default.kd);
    let untextured = Untextured {
        ka: draft.ka.unwrap_or(plain_kd),
        kd: plain_kd,
        ks: draft.ks.unwrap_or(default.ks),
    };
    let kd = draft.kd.unwrap_or(unless_textured(&draft.kd_map, default.kd));
    let ks = draft.ks.unwrap_or(unless_textured(&draft.ks_map, default.ks));
    let material = Material {
        ka: draft.ka.unwrap_or(kd),
        kd,
        ks: if draft.has_specular { ks } else { [0.0; 3] },
        ke: draft.ke.unwrap_or(default.ke),
        ns: draft.ns.unwrap_or(default.ns),
        unlit: draft.unlit,
        opacity: draft
            .opacity
            .or_else(|| draft.transparency.map(|tr| 1.0 - tr))
            .unwrap_or(default.opacity),
        ..default
    };
    let ks_map = draft.ks_map.filter(|_| draft.has_specular);
    let textures = TextureRequests { kd: draft.kd_map, ks: ks_map, untextured };
    if library.insert(material, textures) {
        let sentence = "materials are defined again; the last definition counts";
        report.warn(file, draft.line, sentence);
    }
}

/// `r`, which is grey, or `r g b`; `None` with a warning for the forms that need a spectrum.
fn read_color(
    walk: &Statements<'_>,
    file: &Path,
    report: &mut Report,
) -> Result<Option<LinearRgb>, SceneError> {
    let (keyword, values) = (walk.keyword(), walk.values());
    if let Some(form @ ("spectral" | "xyz")) = values.first().map(|token| token.text) {
        let sentence = format!("`{} {form}` is not simulated; left out", keyword.text);
        report.warn(file, keyword.line, &sentence);
        return Ok(None);
    }
    match values.len() {
        1 => Ok(Some([read_coefficient(walk, 0)?; 3])),
        3 => {
            let mut color = [0.0; 3];
            for (channel, value) in color.iter_mut().enumerate() {
                *value = read_coefficient(walk, channel)?;
            }
            Ok(Some(color))
        }
        count => {
            let message = format!("`{}` has {count} numbers; it takes 1 or 3", keyword.text);
            Err(SceneError::scene(walk.place(&keyword), message))
        }
    }
}

/// The value at `position` as a number from 0 to 1; a larger one counts as 1, with a warning.
fn read_share(
    walk: &Statements<'_>,
    position: usize,
    file: &Path,
    report: &mut Report,
) -> Result<f64, SceneError> {
    let share = read_coefficient(walk, position)?;
    if share > 1.0 {
        let keyword = walk.keyword();
        let sentence = format!("{} above 1 counts as 1", quote(keyword.text));
        report.warn(file, keyword.line, &sentence);
    }
    Ok(share.min(1.0))
}

/// The value at `position` as a finite number of at least 0.
fn read_coefficient(walk: &Statements<'_>, position: usize) -> Result<f64, SceneError> {
    let keyword = walk.keyword();
    let Some(token) = walk.values().get(position) else {
        let message = format!("`{}` lacks a number", keyword.text);
        return Err(SceneError::scene(walk.place(&keyword), message));
    };
    let value = walk.number(token)?;
    if value < 0.0 {
        let message = format!("`{}` is negative: {}", keyword.text, quote(token.text));
        return Err(SceneError::scene(walk.place(token), message));
    }
    // Turns -0 into 0.
    Ok(value + 0.0)
}

#[cfg(test)]
mod tests;
