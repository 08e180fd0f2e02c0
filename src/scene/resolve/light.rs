//! One light: its type, the keys that the type has a use for, and their ranges.

use super::light_frame::{Frame, Frames};
use super::{at_least_zero, color};
use crate::scene::camera::unit;
use crate::scene::file::text::Faults;
use crate::scene::file::{LightFile, effect_of_light_type, suggestion};
use crate::scene::light::{
    AmbientLight, DirectionalLight, HemisphereLight, Light, LightColors, PointLight, SpotLight,
};
use toml::Spanned;

/// What each type has a use for, beside `type`.
const USES: [(&str, &[&str]); 5] = [
    ("ambient", &["ambient"]),
    ("directional", &["aim", "intensity", "diffuse", "specular", "ambient", "shadows"]),
    (
        "point",
        &["position", "attenuation", "intensity", "diffuse", "specular", "ambient", "shadows"],
    ),
    (
        "spot",
        &[
            "position",
            "target",
            "aim",
            "attenuation",
            "cutoff_deg",
            "exponent",
            "intensity",
            "diffuse",
            "specular",
            "ambient",
            "shadows",
        ],
    ),
    ("hemisphere", &["direction", "top", "bottom"]),
];

/// What every light may have.
const ALWAYS: [&str; 2] = ["type", "name"];

pub(super) fn resolve(
    light: &LightFile,
    frames: &Frames<'_>,
    faults: &mut Faults<'_>,
) -> Option<Light> {
    let before = faults.errors.len();
    let kind = light.kind.get_ref().as_str();
    let Some((_, uses)) = USES.iter().find(|(name, _)| *name == kind) else {
        match effect_of_light_type(kind) {
            Some(effect) => faults.at(&light.kind.span(), effect),
            None => {
                let message = format!("there is no type of light `{kind}`");
                let help = suggestion(kind, &USES.map(|(name, _)| name));
                faults.at_with_help(&light.kind.span(), message, help);
            }
        }
        return None;
    };
    for key in &light.written {
        let name = key.get_ref().as_str();
        // Every light but the ambient one has a point or a direction that a frame can move.
        let is_frame = name == "parent" && kind != "ambient";
        if !(is_frame || ALWAYS.contains(&name) || uses.contains(&name)) {
            let message = format!("the type `{kind}` has no use for `{name}`");
            let help = format!("it has for: {}", uses.join(", "));
            faults.at_with_help(&key.span(), message, help);
        }
    }
    let frame = frames.of(light, faults)?;
    let made = match kind {
        "ambient" => required(&light.ambient, "ambient", light, faults)
            .map(|rgb| Light::Ambient(AmbientLight { ambient: color(rgb, "ambient", faults) })),
        "directional" => directional(light, &frame, faults).map(Light::Directional),
        "point" => point(light, &frame, faults).map(Light::Point),
        "spot" => spot(light, &frame, faults).map(Light::Spot),
        _ => hemisphere(light, &frame, faults).map(Light::Hemisphere),
    };
    made.filter(|_| faults.errors.len() == before)
}

fn directional(
    light: &LightFile,
    frame: &Frame,
    faults: &mut Faults<'_>,
) -> Option<DirectionalLight> {
    let colors = colors(light, faults);
    let aim = required(&light.aim, "aim", light, faults)?;
    let aim = direction(aim, frame.direction(*aim.get_ref()), "aim", faults)?;
    Some(DirectionalLight { aim, colors, shadows: shadows(light) })
}

fn hemisphere(
    light: &LightFile,
    frame: &Frame,
    faults: &mut Faults<'_>,
) -> Option<HemisphereLight> {
    let way = required(&light.direction, "direction", light, faults);
    let up =
        way.and_then(|way| direction(way, frame.direction(*way.get_ref()), "direction", faults));
    let mut rgb = |key: &str, value: &Option<Spanned<[f64; 3]>>| {
        required(value, key, light, faults).map(|rgb| color(rgb, key, faults))
    };
    let (top, bottom) = (rgb("top", &light.top), rgb("bottom", &light.bottom));
    Some(HemisphereLight { up: up?, top: top?, bottom: bottom? })
}

fn shadows(light: &LightFile) -> bool {
    light.shadows.as_ref().is_some_and(|shadows| *shadows.get_ref())
}

fn point(light: &LightFile, frame: &Frame, faults: &mut Faults<'_>) -> Option<PointLight> {
    let colors = colors(light, faults);
    let attenuation = attenuation(light, faults);
    let position = position(light, frame, faults)?;
    Some(PointLight { position, attenuation, colors, shadows: shadows(light) })
}

fn spot(light: &LightFile, frame: &Frame, faults: &mut Faults<'_>) -> Option<SpotLight> {
    let colors = colors(light, faults);
    let attenuation = attenuation(light, faults);
    let exponent =
        light.exponent.as_ref().map_or(0.0, |value| at_least_zero(value, "exponent", faults));
    let position = position(light, frame, faults);
    let aim = spot_aim(light, frame, position, faults);
    let cutoff = required(&light.cutoff_deg, "cutoff_deg", light, faults)?;
    let cutoff_deg = *cutoff.get_ref();
    if !(cutoff_deg > 0.0 && cutoff_deg <= 180.0) {
        let message =
            format!("`cutoff_deg` must be greater than 0 and at most 180, not {cutoff_deg}");
        faults.at(&cutoff.span(), message);
    }
    if let Some(value) = light.exponent.as_ref().filter(|_| cutoff_deg == 180.0) {
        faults.warn(&value.span(), "`exponent` has no effect: a cutoff of 180° is no cone");
    }
    let (position, aim, shadows) = (position?, aim?, shadows(light));
    Some(SpotLight { position, aim, attenuation, cutoff_deg, exponent, colors, shadows })
}

/// `aim`, or the direction from the light to `target`.
fn spot_aim(
    light: &LightFile,
    frame: &Frame,
    position: Option<[f64; 3]>,
    faults: &mut Faults<'_>,
) -> Option<[f64; 3]> {
    match (&light.target, &light.aim) {
        (Some(target), Some(aim)) => {
            let second = if aim.span().start > target.span().start { aim } else { target };
            faults.at(&second.span(), "a spot has either `target` or `aim`, not both");
            None
        }
        (None, None) => {
            faults.at(&light.span, "a `spot` light lacks `target` or `aim`");
            None
        }
        (None, Some(aim)) => direction(aim, frame.direction(*aim.get_ref()), "aim", faults),
        (Some(target), None) => {
            let (to, from) = (frame.position(*target.get_ref()), position?);
            let way = std::array::from_fn(|k| to[k] - from[k]);
            direction(target, way, "target − position", faults)
        }
    }
}

/// `position` in world space.
fn position(light: &LightFile, frame: &Frame, faults: &mut Faults<'_>) -> Option<[f64; 3]> {
    let written = required(&light.position, "position", light, faults)?;
    let position = frame.position(*written.get_ref());
    if !position.iter().all(|c| c.is_finite()) {
        faults.at(&written.span(), "`position` is too far away for 64-bit numbers");
    }
    Some(position)
}

/// The unit vector along `way`.
fn direction(
    written: &Spanned<[f64; 3]>,
    way: [f64; 3],
    name: &str,
    faults: &mut Faults<'_>,
) -> Option<[f64; 3]> {
    let direction = unit(way);
    if direction.is_none() {
        let message = match way.iter().all(|c| c.is_finite()) {
            true => format!("`{name}` is a direction and must not have length 0"),
            false => format!("`{name}` is too long for 64-bit numbers"),
        };
        faults.at(&written.span(), message);
    }
    direction
}

fn attenuation(light: &LightFile, faults: &mut Faults<'_>) -> [f64; 3] {
    let Some(written) = &light.attenuation else { return [1.0, 0.0, 0.0] };
    let numbers = *written.get_ref();
    if let Some(negative) = numbers.iter().find(|&&number| number < 0.0) {
        let message = format!("each number of `attenuation` must be at least 0, not {negative}");
        faults.at(&written.span(), message);
    } else if numbers.iter().all(|&number| number == 0.0) {
        faults.at(&written.span(), "the numbers of `attenuation` must not all be 0");
    }
    numbers
}

fn colors(light: &LightFile, faults: &mut Faults<'_>) -> LightColors {
    if light.intensity.is_some() {
        for (key, value) in [("diffuse", &light.diffuse), ("specular", &light.specular)] {
            if let Some(value) = value {
                let message = format!("`intensity` sets `{key}`; a light has either, not both");
                faults.at(&value.span(), message);
            }
        }
    }
    let parts = [&light.intensity, &light.diffuse, &light.specular, &light.ambient];
    if parts.iter().all(|part| part.is_none()) {
        let message = format!("a `{}` light lacks a colour", light.kind.get_ref());
        faults.at_with_help(
            &light.span,
            message,
            "give `intensity`, or `diffuse` and `specular`, or `ambient`",
        );
    }
    let mut rgb = |key: &str, value: &Option<Spanned<[f64; 3]>>| {
        value.as_ref().map(|rgb| color(rgb, key, faults))
    };
    let intensity = rgb("intensity", &light.intensity);
    let diffuse = rgb("diffuse", &light.diffuse).or(intensity).unwrap_or_default();
    let specular = rgb("specular", &light.specular).or(intensity).unwrap_or_default();
    let ambient = rgb("ambient", &light.ambient).unwrap_or_default();
    LightColors { ambient, diffuse, specular }
}

/// A key that the light's type cannot do without.
fn required<'a, T>(
    value: &'a Option<Spanned<T>>,
    key: &str,
    light: &LightFile,
    faults: &mut Faults<'_>,
) -> Option<&'a Spanned<T>> {
    if value.is_none() {
        let message = format!("a `{}` light lacks `{key}`", light.kind.get_ref());
        faults.at(&light.span, message);
    }
    value.as_ref()
}
