//! Materials.

use super::ReadError;
use super::document::{self, Document};
use crate::figure::{Material, MaterialKind, TextureMaps};

/// Returns the image index of a texture; `None` if the material has no texture.
fn map_of(root: &Document<'_>, texture: Option<usize>) -> Result<Option<usize>, ReadError> {
    let Some(texture) = texture else {
        return Ok(None);
    };
    let image = root.texture_images.get(texture).copied();
    image
        .filter(|&i| i < root.images.len())
        .map(Some)
        .ok_or(ReadError::OutOfRange {
            what: "a material's texture",
        })
}

pub(super) fn read_material(
    root: &Document<'_>,
    primitive: &document::Primitive,
) -> Result<Material, ReadError> {
    let Some(index) = primitive.material else {
        return Ok(Material {
            kind: MaterialKind::Plain,
            base_color: [1.0; 4],
            roughness: 1.0,
            double_sided: false,
            maps: TextureMaps::default(),
        });
    };
    let m = root.materials.get(index).ok_or(ReadError::OutOfRange {
        what: "a mesh's material",
    })?;
    Ok(Material {
        kind: MaterialKind::NAMES
            .into_iter()
            .find(|n| n.1 == m.kind)
            .map_or(MaterialKind::Plain, |n| n.0),
        base_color: m.base_color.map(|x| x as f32),
        roughness: m.roughness as f32,
        double_sided: m.double_sided,
        maps: TextureMaps {
            base_color: map_of(root, m.base_color_texture)?,
            normal: map_of(root, m.normal_texture)?,
            wrinkles: map_of(root, m.wrinkle_texture)?,
        },
    })
}
