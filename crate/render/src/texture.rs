//! Material textures: mip levels are computed here, because a browser's WebGPU computes none.

use std::sync::LazyLock;

use raconteur_base::color::srgb_to_linear;
use wgpu::{Device, Queue, TextureFormat, TextureView};

use crate::RenderError;

/// Largest accepted image side, pixels: 8192² of RGBA are 256 MiB.
pub const MAX_SIDE_PX: u32 = 8192;

/// Largest side stored on the device, pixels; a face that fills a 4K screen shows no more.
const KEPT_SIDE: u32 = 2048;

/// Role of a texture on a surface: colour, normals or height.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// sRGB colour and alpha.
    Color,
    /// Normals in tangent space.
    Normal,
    /// Heights, one in each channel.
    Height,
}

/// Mip level of a texture: width, height and RGBA bytes.
pub(crate) type Level = (u32, u32, Vec<u8>);

/// Rejects an image whose size is invalid or does not match its bytes.
pub(crate) fn check(width: u32, height: u32, rgba: &[u8]) -> Result<(), RenderError> {
    let problem = if width == 0 || height == 0 {
        "it is empty"
    } else if width.max(height) > MAX_SIDE_PX {
        "a side is longer than 8192"
    } else if rgba.len() as u64 != 4 * u64::from(width) * u64::from(height) {
        "its bytes are not four a pixel"
    } else {
        return Ok(());
    };
    Err(RenderError::BadImage {
        width,
        height,
        problem,
    })
}

/// Uploads a checked image with its mip levels.
pub(crate) fn upload(
    device: &Device,
    queue: &Queue,
    role: Role,
    width: u32,
    height: u32,
    rgba: &[u8],
) -> TextureView {
    let limit = device.limits().max_texture_dimension_2d.min(KEPT_SIDE);
    let mut levels: Vec<Level> = Vec::new();
    let (mut w, mut h) = (width, height);
    while w.max(h) > 1 {
        let next = match levels.last() {
            Some((_, _, bytes)) => halved(w, h, bytes, role),
            None => halved(w, h, rgba, role),
        };
        if w.max(h) > limit {
            // The level exceeds the limit, so the half-size level replaces it.
            levels.clear();
        }
        (w, h) = (next.0, next.1);
        levels.push(next);
    }
    let whole = (width.max(height) <= limit).then_some((width, height, rgba));
    let all: Vec<(u32, u32, &[u8])> = whole
        .into_iter()
        .chain(levels.iter().map(|(w, h, b)| (*w, *h, b.as_slice())))
        .collect();
    let format = match role {
        Role::Color => TextureFormat::Rgba8UnormSrgb,
        Role::Normal | Role::Height => TextureFormat::Rgba8Unorm,
    };
    send(device, queue, format, &all)
}

/// Uploads an image given with all its mip levels, the finest first.
pub(crate) fn upload_levels(device: &Device, queue: &Queue, levels: &[Level]) -> TextureView {
    let all: Vec<(u32, u32, &[u8])> = levels
        .iter()
        .map(|(w, h, b)| (*w, *h, b.as_slice()))
        .collect();
    send(device, queue, TextureFormat::Rgba8Unorm, &all)
}

fn send(
    device: &Device,
    queue: &Queue,
    format: TextureFormat,
    all: &[(u32, u32, &[u8])],
) -> TextureView {
    let extent = |width, height| wgpu::Extent3d {
        width,
        height,
        depth_or_array_layers: 1,
    };
    let (w, h) = all.first().map_or((1, 1), |l| (l.0, l.1));
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("picture of a material"),
        size: extent(w, h),
        mip_level_count: all.len() as u32,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    for (level, &(w, h, bytes)) in (0..).zip(all) {
        queue.write_texture(
            wgpu::TexelCopyTextureInfo {
                mip_level: level,
                ..texture.as_image_copy()
            },
            bytes,
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(4 * w),
                rows_per_image: None,
            },
            extent(w, h),
        );
    }
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// Linear light of each sRGB byte.
static LINEAR: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|i| srgb_to_linear(i as f64 / 255.0) as f32));

/// Linear light half way between each sRGB byte and the next.
static BETWEEN: LazyLock<[f32; 255]> =
    LazyLock::new(|| std::array::from_fn(|i| srgb_to_linear((i as f64 + 0.5) / 255.0) as f32));

/// Returns an image of half the size: each pixel the mean of four; colours in linear light and
/// weighted by coverage, normals renormalised, heights averaged directly.
fn halved(width: u32, height: u32, rgba: &[u8], role: Role) -> Level {
    let (w, h) = ((width / 2).max(1), (height / 2).max(1));
    let mut out = Vec::with_capacity((4 * w * h) as usize);
    for y in 0..h {
        for x in 0..w {
            let corners = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| {
                let (x, y) = ((2 * x + i).min(width - 1), (2 * y + j).min(height - 1));
                let at = 4 * (y as usize * width as usize + x as usize);
                [rgba[at], rgba[at + 1], rgba[at + 2], rgba[at + 3]]
            });
            out.extend(match role {
                Role::Color => mean_color(&corners),
                Role::Normal => mean_normal(&corners),
                Role::Height => mean(&corners),
            });
        }
    }
    (w, h, out)
}

fn mean_color(corners: &[[u8; 4]; 4]) -> [u8; 4] {
    let alpha: f32 = corners.iter().map(|p| f32::from(p[3])).sum();
    let mean = |c: usize| {
        let sum = |weight: &dyn Fn(&[u8; 4]) -> f32| -> f32 {
            corners
                .iter()
                .map(|p| weight(p) * LINEAR[usize::from(p[c])])
                .sum()
        };
        // A fully transparent texel keeps its colour for the coarser levels.
        let light = if alpha > 0.0 {
            sum(&|p| f32::from(p[3])) / alpha
        } else {
            sum(&|_| 0.25)
        };
        BETWEEN.partition_point(|&t| t <= light) as u8
    };
    [mean(0), mean(1), mean(2), (alpha / 4.0).round() as u8]
}

fn mean(corners: &[[u8; 4]; 4]) -> [u8; 4] {
    std::array::from_fn(|c| {
        let sum: u16 = corners.iter().map(|p| u16::from(p[c])).sum();
        ((sum + 2) / 4) as u8
    })
}

fn mean_normal(corners: &[[u8; 4]; 4]) -> [u8; 4] {
    let sum = corners.iter().fold(glam::Vec3::ZERO, |sum, p| {
        sum + glam::Vec3::from([p[0], p[1], p[2]].map(|c| f32::from(c) - 127.5))
    });
    let n = sum.try_normalize().unwrap_or(glam::Vec3::Z) * 127.5 + 127.5;
    [n.x, n.y, n.z, 255.0].map(|c| c.round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_black_and_half_white_is_half_the_light() {
        let rgba = [[0, 0, 0, 255], [255; 4], [255; 4], [0, 0, 0, 255]].concat();
        // 0.5 of the light is sRGB 187.5.
        assert_eq!(
            halved(2, 2, &rgba, Role::Color),
            (1, 1, vec![188, 188, 188, 255])
        );
    }

    #[test]
    fn every_grey_keeps_its_value() {
        for grey in 0..=255 {
            let rgba = [grey; 16];
            assert_eq!(halved(2, 2, &rgba, Role::Color).2[..3], [grey; 3]);
        }
    }

    #[test]
    fn clear_pixels_do_not_colour_the_others() {
        let rgba = [[200, 10, 10, 255], [0; 4], [0; 4], [0; 4]].concat();
        assert_eq!(halved(2, 2, &rgba, Role::Color).2, [200, 10, 10, 64]);
    }

    #[test]
    fn mean_normals_are_unit() {
        let rgba = [[255, 128, 128, 255], [0, 128, 128, 255]].concat();
        let (w, h, flat) = halved(2, 1, &rgba, Role::Normal);
        assert_eq!((w, h), (1, 1));
        let n = glam::Vec3::from([flat[0], flat[1], flat[2]].map(|c| f32::from(c) / 127.5 - 1.0));
        assert!((n.length() - 1.0).abs() < 0.02, "{n}");
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        for (w, h, n) in [(0, 4, 0), (8193, 1, 4 * 8193), (2, 2, 15), (2, 2, 17)] {
            assert!(check(w, h, &vec![0; n]).is_err(), "{w} {h} {n}");
        }
        assert!(
            check(2, 3, &[0; 24]).is_ok(),
            "an image of the right size is accepted"
        );
    }
}
