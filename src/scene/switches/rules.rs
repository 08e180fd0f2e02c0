//! The switches as types: what shading branches on, resolved once from the words.
//!
//! No evaluation here; the sources of each alternative stand beside the code that follows it.

use super::SwitchValue;

/// The switches as shading acts on them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rules {
    /// Where the specular part is dark.
    pub backlit_specular: BacklitSpecular,
    /// A positional light's own ambient is multiplied by its f.
    pub attenuate_ambient: bool,
    /// k_a is k_d.
    pub ambient_by_diffuse: bool,
    /// Which lobe.
    pub specular: SpecularModel,
    /// The specular part is multiplied by (N·L)_+.
    pub specular_cosine: bool,
    /// V is the direction against the view axis, everywhere.
    pub distant_viewer: bool,
    /// Colours, normals and texture coordinates are interpolated linearly on the screen.
    pub screen_interpolation: bool,
    /// The interpolated normal is made unit.
    pub renormalize: bool,
    /// L and V are mixed from those of the corners.
    pub interpolate_vectors: bool,
    /// What flat shading means.
    pub flat: FlatMeaning,
    /// The blend of hemisphere lights.
    pub hemisphere: HemisphereCurve,
    /// Normals are transformed like directions.
    pub naive_normals: bool,
}

impl Rules {
    pub(super) fn of(values: &[(&'static str, SwitchValue)]) -> Self {
        let get = |name| values.iter().find(|(known, _)| *known == name).map(|&(_, value)| value);
        let is = |name| get(name) == Some(SwitchValue::Is(true));
        let word = |name| match get(name) {
            Some(SwitchValue::Word(word)) => word,
            _ => "",
        };
        Self {
            backlit_specular: match word("backlit_specular") {
                "lt0" => BacklitSpecular::DarkBelow,
                "none" => BacklitSpecular::NeverDark,
                _ => BacklitSpecular::DarkUpTo,
            },
            attenuate_ambient: is("attenuate_ambient"),
            ambient_by_diffuse: word("ka") == "kd",
            specular: match word("specular") {
                "phong" => SpecularModel::Phong,
                _ => SpecularModel::Blinn,
            },
            specular_cosine: is("specular_cosine"),
            distant_viewer: word("viewer") == "distant",
            screen_interpolation: word("interpolation") == "screen",
            renormalize: is("renormalize"),
            interpolate_vectors: word("fragment_vectors") == "interpolate",
            flat: match word("flat") {
                "one-point" => FlatMeaning::OnePoint,
                "vertex-face-normal" => FlatMeaning::VertexFaceNormal,
                "provoking" => FlatMeaning::Provoking,
                _ => FlatMeaning::FaceNormal,
            },
            hemisphere: match word("hemisphere") {
                "sine" => HemisphereCurve::Sine,
                "linear" => HemisphereCurve::Linear,
                _ => HemisphereCurve::Cosine,
            },
            naive_normals: is("naive_normals"),
        }
    }
}

/// Where the specular part is dark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BacklitSpecular {
    /// Where N·L ≤ 0 (`le0`).
    DarkUpTo,
    /// Where N·L < 0 (`lt0`): at N·L = 0 the highlight survives.
    DarkBelow,
    /// Nowhere (`none`): highlights leak onto faces that are turned away.
    NeverDark,
}

/// Which specular lobe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpecularModel {
    /// (N·H)^ns.
    Blinn,
    /// (V·R)^ns.
    Phong,
}

/// What flat shading means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FlatMeaning {
    /// Lit at every pixel with the face normal.
    FaceNormal,
    /// Lit once, at the centroid, with the face normal.
    OnePoint,
    /// Lit at the corners with the face normal, colours interpolated.
    VertexFaceNormal,
    /// The last corner's colour, lit with its own normal.
    Provoking,
}

/// The blend of hemisphere lights as a function of the angle θ between normal and top.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HemisphereCurve {
    /// a = ½ + ½ cos θ.
    Cosine,
    /// a = 1 − ½ sin θ up to 90°, ½ sin θ beyond.
    Sine,
    /// a = 1 − θ/180°.
    Linear,
}
