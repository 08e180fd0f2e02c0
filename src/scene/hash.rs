//! A digest of everything in a scene that a picture depends on.
//!
//! SHA-256 over the resolved numbers, not over the text: a comment, another spelling of the same
//! number or another folder leaves it alone. Names and warnings are not part of it.

use super::light::{Light, LightColors};
use super::texture::TextureRef;
use super::{Scene, Sides};
use sha2::{Digest, Sha256};

/// The digest as 64 lower-case hexadecimal digits.
pub fn content_hash(scene: &Scene) -> String {
    let mut hash = Sha256::new();
    hash_view(&mut hash, scene);
    hash_mesh(&mut hash, scene);
    hash_surfaces(&mut hash, scene);
    hash_textures(&mut hash, scene);
    scene.lights.iter().for_each(|light| hash_light(&mut hash, light));
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

fn hash_view(hash: &mut Sha256, scene: &Scene) {
    let camera = &scene.camera;
    hash.update(camera.resolution().width().to_le_bytes());
    hash.update(camera.resolution().height().to_le_bytes());
    for vector in [camera.eye(), camera.d0(), camera.dx(), camera.dy(), scene.background] {
        floats(hash, &vector);
    }
    floats(hash, &[camera.z_per_t()]);
    hash.update(scene.samples.side().to_le_bytes());
}

fn hash_mesh(hash: &mut Sha256, scene: &Scene) {
    let mesh = &scene.mesh;
    count(hash, mesh.positions.len());
    for position in &mesh.positions {
        position.iter().for_each(|c| hash.update(c.to_le_bytes()));
    }
    mesh.normals.iter().for_each(|normal| floats(hash, normal));
    mesh.uvs.iter().for_each(|uv| floats(hash, uv));
    // Only where there are colours, so that the digests of scenes without stay.
    if !mesh.colors.is_empty() {
        hash.update(b"colors");
        mesh.colors.iter().for_each(|color| floats(hash, color));
    }
    for list in [&mesh.corners, &mesh.corner_normals, &mesh.corner_uvs] {
        count(hash, list.len());
        list.iter().flatten().for_each(|index| hash.update(index.to_le_bytes()));
    }
}

fn hash_surfaces(hash: &mut Sha256, scene: &Scene) {
    count(hash, scene.objects.len());
    for object in &scene.objects {
        hash.update(object.triangles.end.to_le_bytes());
        hash.update([object.shading as u8, u8::from(object.sides == Sides::Double)]);
    }
    count(hash, scene.materials.len());
    for material in &scene.materials {
        for color in [material.ka, material.kd, material.ks, material.ke] {
            floats(hash, &color);
        }
        floats(hash, &[material.ns, material.opacity]);
        // Only where it says something, so that the digests of lit scenes stay.
        if material.unlit {
            hash.update(b"unlit");
        }
    }
    scene.triangle_materials.iter().for_each(|index| hash.update(index.to_le_bytes()));
}

/// Texels and how they are used; a scene without textures adds nothing. Smaller levels follow from
/// the image itself.
fn hash_textures(hash: &mut Sha256, scene: &Scene) {
    for texture in &scene.textures {
        let base = texture.base();
        hash.update(b"texture");
        hash.update(base.width().to_le_bytes());
        hash.update(base.height().to_le_bytes());
        for row in base.texels().chunks(base.width() as usize) {
            let bytes: Vec<u8> = row.as_flattened().iter().flat_map(|c| c.to_le_bytes()).collect();
            hash.update(bytes);
        }
    }
    for (index, material) in scene.materials.iter().enumerate() {
        let maps = [(b"kd_map", material.kd_map), (b"ks_map", material.ks_map)];
        for (name, map) in maps {
            let Some(TextureRef { texture, filter, wrap, scale, offset }) = map else { continue };
            hash.update(name);
            count(hash, index);
            hash.update(texture.to_le_bytes());
            hash.update([filter as u8, wrap as u8]);
            floats(hash, &scale);
            floats(hash, &offset);
        }
    }
}

fn hash_light(hash: &mut Sha256, light: &Light) {
    match light {
        Light::Ambient(ambient) => {
            hash.update(b"ambient");
            floats(hash, &ambient.ambient);
        }
        Light::Directional(directional) => {
            hash.update(b"directional");
            floats(hash, &directional.aim);
            hash_colors(hash, &directional.colors);
            hash.update([u8::from(directional.shadows)]);
        }
        Light::Point(point) => {
            hash.update(b"point");
            floats(hash, &point.position);
            floats(hash, &point.attenuation);
            hash_colors(hash, &point.colors);
            hash.update([u8::from(point.shadows)]);
        }
        Light::Spot(spot) => {
            hash.update(b"spot");
            floats(hash, &spot.position);
            floats(hash, &spot.aim);
            floats(hash, &spot.attenuation);
            floats(hash, &[spot.cutoff_deg, spot.exponent]);
            hash_colors(hash, &spot.colors);
            hash.update([u8::from(spot.shadows)]);
        }
        Light::Hemisphere(hemisphere) => {
            hash.update(b"hemisphere");
            for values in [hemisphere.up, hemisphere.top, hemisphere.bottom] {
                floats(hash, &values);
            }
        }
    }
}

fn hash_colors(hash: &mut Sha256, colors: &LightColors) {
    for color in [colors.ambient, colors.diffuse, colors.specular] {
        floats(hash, &color);
    }
}

fn floats(hash: &mut Sha256, values: &[f64]) {
    values.iter().for_each(|value| hash.update(value.to_le_bytes()));
}

fn count(hash: &mut Sha256, count: usize) {
    hash.update((count as u64).to_le_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pixel::Resolution;
    use crate::scene::camera::PinholeCamera;
    use crate::scene::sampling::SampleGrid;

    #[test]
    fn the_digest_follows_the_numbers_and_nothing_else() {
        let frame = Resolution::new(4, 4).unwrap();
        let (d0, dx, dy) = ([-2.0, -2.0, 2.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        let camera = PinholeCamera::exact(frame, [0.0; 3], d0, dx, dy).unwrap();
        let triangle = [[0.0, 0.0, 4.0], [1.0, 0.0, 4.0], [0.0, 1.0, 4.0]];
        let scene = Scene::from_triangles(camera, &[triangle]);
        let digest = content_hash(&scene);
        assert_eq!(digest.len(), 64);
        let mut renamed = scene.clone();
        renamed.materials[0].name = "other".to_owned();
        assert_eq!(content_hash(&renamed), digest);
        let mut glassy = scene.clone();
        glassy.materials[0].opacity = 0.5;
        assert_ne!(content_hash(&glassy), digest);
        let mut finer = scene.clone();
        finer.samples = SampleGrid::new(2).unwrap();
        assert_ne!(content_hash(&finer), digest);
        let mut moved = scene;
        moved.mesh.positions[1][0] = f32::from_bits(1.0_f32.to_bits() + 1);
        assert_ne!(content_hash(&moved), digest);
    }
}
