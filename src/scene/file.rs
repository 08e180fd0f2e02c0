//! A scene file as it is written: TOML, with the place of every value. What it means is
//! [`super::Scene`].
//!
//! Only the form is checked here: that the text is TOML, that every key is known, that every value
//! is of its key's kind, that every number is finite and that nothing lacks which must be there.
//! All faults are found in one run. Ranges, names and geometry are checked by `resolve`.
//!
//! # Every key
//!
//! RGB is a list of three numbers, linear, each at least 0. A vector is a list of three numbers.
//! A matrix is a list of rows, or its numbers in one list, row by row. Paths are relative to the
//! scene file. "must" stands where there is no default.
//!
//! The centre of pixel (i, j) is the point (i + ½, j + ½) in the coordinates of `camera.opencv.K`,
//! whose origin is the top left corner of the frame. OpenCV itself, and most calibrations, put
//! that centre at (i, j): add 0.5 to their `cx` and `cy` (`K[0][2]` and `K[1][2]`).
//!
//! | key | default | meaning |
//! |---|---|---|
//! | `version` | must | 1 |
//! | `dialect` | `"curless"` | preset of all switches: `curless`, `angel`, `iit`, `cs315`, `opengl` |
//! | `image` | must | table: the picture |
//! | `camera` | must | table: the camera, in exactly one of its four forms |
//! | `material` | none | list of tables: the materials |
//! | `mesh` | none | list of tables: the meshes; triangle ids count through them in file order |
//! | `light` | none | list of tables: the lights |
//! | `switches` | the dialect's | table: single switches |
//! | `image.width` | must | columns, 1…65536 |
//! | `image.height` | must | rows, 1…65536 |
//! | `image.background` | `[0, 0, 0]` | RGB where nothing is visible |
//! | `image.samples` | 1 | samples per pixel and axis for colour and alpha, 1…16 |
//! | `camera.eye` | must | look-at camera: where it is |
//! | `camera.target` | must | look-at camera: the point in the middle of the image |
//! | `camera.up` | must | look-at camera: what points upwards in the image |
//! | `camera.fov_y_deg` | must | look-at camera: full vertical angle of view, 0 < angle < 180 |
//! | `camera.exact` | none | table: a camera by its lattice numbers |
//! | `camera.opencv` | none | table: a camera by OpenCV's matrices |
//! | `camera.gl` | none | table: a camera by OpenGL's matrices |
//! | `camera.exact.eye` | must | where the camera is |
//! | `camera.exact.d0` | must | direction of the top left corner of the frame |
//! | `camera.exact.dx` | must | step of the direction per column |
//! | `camera.exact.dy` | must | step of the direction per row |
//! | `camera.opencv.K` | must | intrinsic 3×3 matrix, pixels; the centre of pixel (i, j) is (i + ½, j + ½): add 0.5 to `cx`, `cy` of calibrations that put it at (i, j) |
//! | `camera.opencv.R` | must | rotation, 3×3 |
//! | `camera.opencv.t` | must | translation: camera = R·world + t |
//! | `camera.gl.view` | must | view matrix, 4×4, for column vectors |
//! | `camera.gl.projection` | must | projection matrix, 4×4, NDC −1…1, y upwards |
//! | `material.name` | must | name by which meshes refer to it; no name twice |
//! | `material.preset` | none | `metal`, `plastic`, `planet`, `clay`, `red-plastic`: `ka`, `kd`, `ks`, `ns` where they are not written; numbers in [`super::material`] |
//! | `material.ka` | the preset's, else `kd` | RGB: reflection of ambient light |
//! | `material.kd` | the preset's, else `[0.8, 0.8, 0.8]`, with `kd_map` `[1, 1, 1]` | RGB: diffuse reflection |
//! | `material.ks` | the preset's, else `[0, 0, 0]`, with `ks_map` `[1, 1, 1]` | RGB: specular reflection |
//! | `material.ke` | `[0, 0, 0]` | RGB: emission |
//! | `material.ns` | 32 | specular exponent, at least 0 |
//! | `material.unlit` | false | true: radiance is `kd`, times its map, whatever the lights |
//! | `material.opacity` | 1 | 0…1: below 1 what lies behind is seen through, blended front to back |
//! | `material.kd_map` | none | a PNG or JPEG file that multiplies `kd` where a triangle has texture coordinates; `ka` stays as it is |
//! | `material.ks_map` | none | likewise for `ks` |
//! | `material.filter` | `"bilinear"` | of both maps: `"nearest"`, `"bilinear"` or `"mip"` |
//! | `material.wrap` | `"repeat"` | of both maps outside the uv square: `"repeat"` or `"clamp"` |
//! | `mesh.file` | this or `shape` | an OBJ file |
//! | `mesh.shape` | this or `file` | `{ NAME = { … } }`: a generated mesh, see [`shape`] |
//! | `mesh.name` | none | name by which a light's `parent` refers to it; no name twice |
//! | `mesh.polygons` | `"ears"` | how polygons of `file` become triangles: `ears`, convex as a fan and concave by cutting ears; `fan`, all as a fan from the first corner |
//! | `mesh.material` | the file's own, else the default one | name of a material |
//! | `mesh.shading` | `"phong"` | `phong`: normals are interpolated; `gouraud`: colours lit at the corners are; `flat`: one normal per triangle; `vertex-color`: the vertices' colours, unlit |
//! | `mesh.sides` | `"single"` | `"double"`: the shading normal turns towards the eye |
//! | `mesh.vertex_normals` | `"file"` | `"file"`: those of the OBJ file, else unweighted means by smoothing group (`s`; without any all is one group), those of the exact surface for shapes; `"uniform"`, `"area"`, `"angle"`: made anew in object space, each polygon's normal weighted by 1, its area, or its angle at the vertex |
//! | `mesh.crease_deg` | none | 0…180: a corner's normal is made of the faces whose normals differ from its own face's by at most this, instead of by smoothing group; `vertex_normals` is `"uniform"` then, unless `"area"` or `"angle"` |
//! | `mesh.scale` | 1 | factor, or a vector of them; applied first |
//! | `mesh.rotate_deg` | `[0, 0, 0]` | right-handed angles about x, then y, then z |
//! | `mesh.translate` | `[0, 0, 0]` | displacement; applied last |
//! | `mesh.matrix` | none | the whole transform, 4×4, last row 0 0 0 1; instead of the other three |
//! | `light.type` | must | `ambient`, `directional`, `point`, `spot` or `hemisphere` |
//! | `light.name` | none | name by which `render --light` refers to it; no name twice |
//! | `light.parent` | `"world"` | frame of `position`, `target`, `aim`, `direction`: `"world"`; `"camera"` (origin at the eye, x right, y up, looking along −z); `"mesh:NAME"` (object space of the mesh of that name: the light follows its transform) |
//! | `light.position` | must | point, spot: where it is |
//! | `light.target` | this or `aim` | spot: the point that it aims at |
//! | `light.aim` | must | directional, spot: the way the light travels |
//! | `light.intensity` | none | RGB: sets `diffuse` and `specular`; instead of them |
//! | `light.diffuse` | `[0, 0, 0]` | RGB: diffuse part |
//! | `light.specular` | `[0, 0, 0]` | RGB: specular part |
//! | `light.ambient` | `[0, 0, 0]`, must for `ambient` | RGB: ambient part |
//! | `light.attenuation` | `[1, 0, 0]` | point, spot: a, b, c of 1/(a + b·r + c·r²), each ≥ 0, not all 0 |
//! | `light.cutoff_deg` | must | spot: from the axis to the rim, 0 < angle ≤ 180; 180 is no cone |
//! | `light.exponent` | 0 | spot: e of (L·S)^e, at least 0 |
//! | `light.shadows` | false | directional, point, spot: whether opaque surfaces stop its diffuse and specular parts |
//! | `light.direction` | must | hemisphere: towards the top colour |
//! | `light.top` | must | hemisphere: RGB |
//! | `light.bottom` | must | hemisphere: RGB |
//! | `switches.backlit_specular` | `"le0"` | specular is dark where N·L ≤ 0 (`le0`), where N·L < 0 (`lt0`), nowhere (`none`) |
//! | `switches.attenuate_ambient` | false | whether distance and cone weaken a light's own ambient |
//! | `switches.ka` | `"own"` | `own`, or `kd` in place of `ka` |
//! | `switches.specular` | `"blinn"` | `blinn`: (N·H)^ns; `phong`: (V·R)^ns |
//! | `switches.specular_cosine` | false | specular × N·L, the form of a BRDF |
//! | `switches.viewer` | `"local"` | `local`, or `distant`: V against the view axis everywhere |
//! | `switches.interpolation` | `"perspective"` | of colours, normals and uv: `perspective`, or `screen`: linear on the screen |
//! | `switches.renormalize` | true | make the interpolated normal unit |
//! | `switches.fragment_vectors` | `"recompute"` | L and V at each point, or `interpolate` them from the corners |
//! | `switches.flat` | `"face-normal"` | `face-normal`: lit at every pixel; `one-point`: once, at the centroid; `vertex-face-normal`: at the corners; `provoking`: the last corner's colour |
//! | `switches.hemisphere` | `"cosine"` | the blend over the angle: `cosine`, `sine`, `linear` |
//! | `switches.naive_normals` | false | transform normals like directions |
//!
//! The defaults of switches are those of `curless`. The presets:
//!
//! | switch | curless | angel | iit | cs315 | opengl |
//! |---|---|---|---|---|---|
//! | backlit_specular | le0 | lt0 | le0 | none | le0 |
//! | attenuate_ambient | false | false | false | true | true |
//! | specular | blinn | blinn | phong | blinn | blinn |
//! | viewer | local | local | local | local | distant |
//! | interpolation | perspective | perspective | screen | perspective | perspective |
//! | fragment_vectors | recompute | interpolate | recompute | recompute | recompute |
//! | flat | face-normal | one-point | one-point | vertex-face-normal | provoking |
//!
//! The other switches are the same in all of them.
//!
//! Codes of textures are sRGB, 8 or 16 bits; alpha and embedded profiles are not used. The origin
//! of texture coordinates is the bottom left corner of the picture. A texture is read only if a
//! triangle wears a material that names it.

mod camera;
mod generated;
pub(crate) mod keys;
mod light;
mod mesh;
mod refused;
pub mod shape;
mod switches;
pub(crate) mod text;
pub(crate) mod values;

pub use camera::{CameraFile, CameraForm, ImageFile};
pub use generated::GeneratedFile;
pub(crate) use keys::suggestion;
pub use light::LightFile;
pub use mesh::{MaterialFile, MeshFile, SourceFile};
pub(crate) use refused::effect_of_light_type;
pub use switches::SwitchFile;

use super::error::{Place, SceneError};
use keys::Keys;
use text::Faults;
use toml::Spanned;
use toml::de::DeTable;

/// A scene file as written. A part that is `None` or shorter than the text had faults, and they
/// were reported.
#[derive(Clone, Debug, Default)]
pub struct SceneFile {
    /// `dialect`.
    pub dialect: Option<Spanned<String>>,
    /// `[image]`.
    pub image: Option<ImageFile>,
    /// `[camera]`.
    pub camera: Option<CameraFile>,
    /// `[[material]]`, in order.
    pub materials: Vec<MaterialFile>,
    /// Whether a `[[material]]` had faults and is not in `materials`.
    pub materials_lack: bool,
    /// `[[mesh]]`, in order.
    pub meshes: Vec<MeshFile>,
    /// Whether a `[[mesh]]` had faults and is not in `meshes`.
    pub meshes_lack: bool,
    /// `[[light]]`, in order.
    pub lights: Vec<LightFile>,
    /// `[switches]`, those that are set.
    pub switches: Vec<SwitchFile>,
}

/// The one version of the format.
const VERSION: i64 = 1;

impl SceneFile {
    /// Reads what the text says and reports what is wrong with its form.
    pub(crate) fn read(faults: &mut Faults<'_>) -> Self {
        let document = match DeTable::parse(faults.text) {
            Ok(document) => document,
            Err(error) => {
                // One fault: those that follow from it would not be the author's.
                let span = error.span().unwrap_or(0..0);
                faults.at(&span, format!("not TOML: {}", error.message()));
                return Self::default();
            }
        };
        let mut keys = Keys::new(document.get_ref(), 0..0, "the scene file");
        match keys.read("version", values::whole, faults) {
            Some(version) if *version.get_ref() != VERSION => {
                let message = format!("version {} of the format is not known", version.get_ref());
                faults.at_with_help(&version.span(), message, "this program reads `version = 1`");
                return Self::default();
            }
            _ => {}
        }
        for name in ["version", "image", "camera"] {
            if !document.get_ref().contains_key(name) {
                let place = Place::file(faults.file);
                let message = match name {
                    "version" => "the scene file lacks `version = 1`".to_owned(),
                    table => format!("the scene file lacks `[{table}]`"),
                };
                faults.errors.push(SceneError::scene(place, message));
            }
        }
        let dialect = keys.read("dialect", values::text, faults);
        let image = keys.table("image", "[image]", faults);
        let image = image.and_then(|keys| ImageFile::read(keys, faults));
        let camera = keys.table("camera", "[camera]", faults);
        let camera = camera.and_then(|keys| CameraFile::read(keys, faults));
        let before = faults.errors.len();
        let tables = keys.tables("material", "[[material]]", faults);
        let materials =
            tables.into_iter().filter_map(|keys| MaterialFile::read(keys, faults)).collect();
        let materials_lack = faults.errors.len() > before;
        let before = faults.errors.len();
        let tables = keys.tables("mesh", "[[mesh]]", faults);
        let meshes = tables.into_iter().filter_map(|keys| MeshFile::read(keys, faults)).collect();
        let meshes_lack = faults.errors.len() > before;
        let tables = keys.tables("light", "[[light]]", faults);
        let lights = tables.into_iter().filter_map(|keys| LightFile::read(keys, faults)).collect();
        let switches = keys.table("switches", "[switches]", faults);
        let switches = switches.map(|keys| switches::read(keys, faults)).unwrap_or_default();
        keys.close(faults);
        Self {
            dialect,
            image,
            camera,
            materials,
            materials_lack,
            meshes,
            meshes_lack,
            lights,
            switches,
        }
    }
}
