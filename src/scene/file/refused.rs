//! Effects that are asked for elsewhere and that no scene of ours can have, by the names under
//! which people ask. They are refused by name, so that nobody waits for fog that never comes.

/// Keys and tables, and what would be said of them.
const KEYS: [(&str, &str); 24] = [
    ("ambient_occlusion", "ambient occlusion is not simulated"),
    ("aperture", "depth of field is not simulated; the camera is a pinhole"),
    ("area", "area lights are not simulated"),
    ("bump_map", "bump mapping is not simulated"),
    ("caustics", "caustics are not simulated"),
    ("depth_of_field", "depth of field is not simulated; the camera is a pinhole"),
    ("displacement", "displacement is not simulated"),
    ("environment", "environment lighting is not simulated"),
    ("far", "there is no far plane; visibility has no clipping"),
    ("focus_distance", "depth of field is not simulated; the camera is a pinhole"),
    ("fog", "fog is not simulated"),
    ("global_illumination", "global illumination is not simulated"),
    ("ior", "refraction is not simulated"),
    ("lens_radius", "depth of field is not simulated; the camera is a pinhole"),
    ("motion_blur", "motion blur is not simulated"),
    ("near", "there is no near plane; visibility has no clipping"),
    ("normal_map", "normal mapping is not simulated"),
    ("radius", "area lights are not simulated"),
    ("reflection", "reflection is not simulated"),
    ("reflectivity", "reflection is not simulated"),
    ("refraction", "refraction is not simulated"),
    ("soft_shadows", "soft shadows are not simulated"),
    ("subsurface", "subsurface scattering is not simulated"),
    ("transmission", "refraction is not simulated"),
];

/// Types of light.
const LIGHT_TYPES: [(&str, &str); 10] = [
    ("area", "area lights are not simulated"),
    ("disk", "area lights are not simulated"),
    ("environment", "environment lights are not simulated"),
    ("ies", "measured lights are not simulated"),
    ("mesh", "area lights are not simulated"),
    ("quad", "area lights are not simulated"),
    ("rect", "area lights are not simulated"),
    ("sky", "environment lights are not simulated"),
    ("sphere", "area lights are not simulated"),
    ("tube", "area lights are not simulated"),
];

/// Why a key of that name is refused, when it names an effect.
pub(super) fn effect_of_key(name: &str) -> Option<&'static str> {
    find(&KEYS, name)
}

/// Why a light of that type is refused, when it names an effect.
pub(crate) fn effect_of_light_type(name: &str) -> Option<&'static str> {
    find(&LIGHT_TYPES, name)
}

fn find(list: &[(&str, &'static str)], name: &str) -> Option<&'static str> {
    list.iter().find(|(known, _)| *known == name).map(|&(_, effect)| effect)
}
