//! Baking of the surface to two images: every texel's tissue is evaluated at its position on the
//! body, its height becomes a normal, and both images are filled and encoded.

use jpeg_encoder::{ColorType, Encoder, QuantizationTableType, SamplingFactor};
use raconteur_base::color::linear_to_srgb;
use raconteur_base::{DVec2, DVec3};

use super::SkinParams;
use super::pigment::Palette;
use super::tissue::Tissue;
use crate::atlas::{Hit, Raster, SIZE, fill};
use crate::hair::Cap;
use crate::hand::HandSheet;
use crate::head::HeadSheet;
use raconteur_body::figure::{Image, WRINKLE_HEIGHT_M};

/// Piece of surface in the skin atlas (head or hand), as input of the baking.
pub(super) struct Layer<'a> {
    pub(super) uv: &'a [[f64; 2]],
    pub(super) triangles: &'a [[u32; 3]],
    /// Vertices in true size, mm.
    pub(super) at: &'a [DVec3],
    /// Skin at a position on a triangle.
    pub(super) tissue: &'a (dyn Fn([u32; 3], &Hit) -> Tissue + Sync),
}

/// Baked texture maps of a person's skin: colour, normals and expressive wrinkles.
#[derive(Clone, Debug)]
pub(crate) struct SkinMaps {
    /// sRGB.
    pub(crate) colour: Image,
    /// Tangent space, glTF's convention.
    pub(crate) normal: Image,
    /// Heights as [`Maps::wrinkles`](raconteur_body::figure::TextureMaps::wrinkles) has them.
    pub(crate) wrinkles: Image,
}

/// Maximum slope: steeper ones cause artefacts, because of the texel width and the light.
const MAX_SLOPE: f64 = 0.9;

/// Quality of the encoder, of 100.
const COLOUR_QUALITY: u8 = 86;
const NORMAL_QUALITY: u8 = 66;
const WRINKLE_QUALITY: u8 = 86;

/// Bakes the maps, including the hair painted on the scalp. The result does not depend on the
/// number of threads.
pub(crate) fn bake(
    skin: &SkinParams,
    head: &HeadSheet,
    hand: &HandSheet,
    cap: Option<&Cap>,
) -> SkinMaps {
    let face = head.painter(skin, cap);
    let palm = hand.painter(skin);
    let on_face = |t: [u32; 3], h: &Hit| face.tissue(t, h);
    let on_hand = |t: [u32; 3], h: &Hit| palm.tissue(t, h);
    let layers = [
        Layer {
            uv: &head.uv,
            triangles: &head.triangles,
            at: &head.at,
            tissue: &on_face,
        },
        Layer {
            uv: &hand.uv,
            triangles: &hand.triangles,
            at: &hand.at,
            tissue: &on_hand,
        },
    ];
    let pictures = evaluate(&layers);
    let colour: Vec<u8> = pictures.colour.iter().flatten().map(|&x| srgb(x)).collect();
    let normal: Vec<u8> = pictures
        .normal
        .iter()
        .flatten()
        .map(|&x| (127.0 * x + 128.0).round().clamp(0.0, 255.0) as u8)
        .collect();
    let seen = QuantizationTableType::Default;
    // Three heights are no colour: an eye's coarse view of hues would lose most of them.
    let even = QuantizationTableType::Flat;
    SkinMaps {
        colour: jpeg(&colour, COLOUR_QUALITY, SamplingFactor::R_4_2_0, &seen),
        normal: jpeg(&normal, NORMAL_QUALITY, SamplingFactor::R_4_4_4, &seen),
        wrinkles: jpeg(
            &heights(&pictures.folds_mm),
            WRINKLE_QUALITY,
            SamplingFactor::R_4_4_4,
            &even,
        ),
    }
}

/// Encodes wrinkle heights, mm, as the bytes of the wrinkle map.
fn heights(folds_mm: &[[f32; 3]]) -> Vec<u8> {
    const STEPS: f32 = 127.0 / (WRINKLE_HEIGHT_M * 1000.0);
    let step = |mm: &f32| (128.0 + STEPS * mm).round().clamp(0.0, 255.0) as u8;
    folds_mm.iter().flatten().map(step).collect()
}

/// Baked maps before they are encoded: linear RGB, unit normals, heights in millimetres.
pub(super) struct Pictures {
    pub(super) colour: Vec<[f32; 3]>,
    pub(super) normal: Vec<[f32; 3]>,
    pub(super) folds_mm: Vec<[f32; 3]>,
}

/// Colour, height and heights of wrinkles of a texel.
type Texel = ([f32; 3], f32, [f32; 3]);

pub(super) fn evaluate(layers: &[Layer<'_>]) -> Pictures {
    let mut uv = Vec::new();
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    // Layer and first triangle of each.
    let mut firsts = Vec::new();
    for layer in layers {
        let base = uv.len() as u32;
        firsts.push(triangles.len());
        uv.extend_from_slice(layer.uv);
        triangles.extend(layer.triangles.iter().map(|t| t.map(|v| v + base)));
    }
    let raster = Raster::new(&uv, &triangles);
    let palette = Palette::new();
    let layer_of = |triangle: u32| {
        let l = firsts.partition_point(|&f| f <= triangle as usize) - 1;
        (
            &layers[l],
            layers[l].triangles[triangle as usize - firsts[l]],
        )
    };
    let texel = |hit: &Option<Hit>| {
        hit.map(|h| {
            let (layer, t) = layer_of(h.triangle);
            let tissue = (layer.tissue)(t, &h);
            (
                tissue.rgb(&palette).map(|x| x as f32),
                tissue.height_mm as f32,
                tissue.folds_mm.map(|x| x as f32),
            )
        })
    };
    let mut texels: Vec<Option<Texel>> = vec![None; SIZE * SIZE];
    // Interleaved strips, so that two threads receive equal shares of face and empty space.
    const STRIP: usize = 32 * SIZE;
    std::thread::scope(|scope| {
        let mut halves: [Vec<(&mut [_], &[_])>; 2] = [Vec::new(), Vec::new()];
        let strips = texels.chunks_mut(STRIP).zip(raster.hits.chunks(STRIP));
        for (i, strip) in strips.enumerate() {
            halves[i % 2].push(strip);
        }
        for half in halves {
            let texel = &texel;
            scope.spawn(move || {
                for (out, hits) in half {
                    for (slot, hit) in out.iter_mut().zip(hits) {
                        *slot = texel(hit);
                    }
                }
            });
        }
    });

    let normal = (0..SIZE * SIZE)
        .map(|i| {
            let Some(hit) = raster.hits[i] else {
                return [0.0, 0.0, 1.0];
            };
            let height = |j: Option<usize>| j.and_then(|j| texels[j]).map(|t| f64::from(t.1));
            let here = height(Some(i)).unwrap_or(0.0);
            // Change a texel; on one side only where the other is empty.
            let change =
                |before: Option<usize>, after: Option<usize>| match (height(before), height(after))
                {
                    (Some(a), Some(b)) => (b - a) / 2.0,
                    (Some(a), None) => here - a,
                    (None, Some(b)) => b - here,
                    (None, None) => 0.0,
                };
            let (x, y) = (i % SIZE, i / SIZE);
            let du = change((x > 0).then(|| i - 1), (x + 1 < SIZE).then_some(i + 1));
            let dv = change(
                (y > 0).then(|| i - SIZE),
                (y + 1 < SIZE).then_some(i + SIZE),
            );
            let (layer, t) = layer_of(hit.triangle);
            tilt(layer, t, DVec2::new(du, dv)).map(|x| x as f32)
        })
        .collect();
    let mut colour: Vec<Option<[f32; 3]>> = texels.iter().map(|t| t.map(|t| t.0)).collect();
    fill(&mut colour, SIZE);
    Pictures {
        colour: colour.into_iter().flatten().collect(),
        normal,
        folds_mm: texels.iter().map(|t| t.map_or([0.0; 3], |t| t.2)).collect(),
    }
}

/// Returns the normal in the triangle's tangent frame, from the change of height per texel to the
/// right and down, mm.
fn tilt(layer: &Layer<'_>, t: [u32; 3], change: DVec2) -> [f64; 3] {
    let [a, b, c] = t.map(|v| layer.at[v as usize]);
    let [ua, ub, uc] = t.map(|v| DVec2::from_array(layer.uv[v as usize]) * SIZE as f64);
    let (e, f) = (b - a, c - a);
    let (s, r) = (ub - ua, uc - ua);
    let whole = s.perp_dot(r);
    if whole.abs() < 1e-9 {
        return [0.0, 0.0, 1.0];
    }
    // The surface a texel to the right and a texel down.
    let right = (e * r.y - f * s.y) / whole;
    let down = (f * s.x - e * r.x) / whole;
    let (g, h, k) = (right.dot(right), right.dot(down), down.dot(down));
    let area = g * k - h * h;
    if area < 1e-12 {
        return [0.0, 0.0, 1.0];
    }
    let gradient = right * ((change.x * k - change.y * h) / area)
        + down * ((change.y * g - change.x * h) / area);
    let tangent = right / g.sqrt();
    let up = -(down - tangent * down.dot(tangent)).normalize_or_zero();
    let tilted = DVec3::new(-gradient.dot(tangent), -gradient.dot(up), 1.0);
    let steep = tilted.truncate().length();
    let held = if steep > MAX_SLOPE {
        MAX_SLOPE / steep
    } else {
        1.0
    };
    DVec3::new(tilted.x * held, tilted.y * held, 1.0)
        .normalize()
        .to_array()
}

/// Converts a linear value 0..1 to an sRGB byte.
fn srgb(x: f32) -> u8 {
    (255.0 * linear_to_srgb(f64::from(x.clamp(0.0, 1.0)))).round() as u8
}

/// Encodes an image of [`SIZE`] squared.
///
/// # Panics
/// Never panics: writing to memory does not fail and the size fits the format.
#[allow(clippy::expect_used, reason = "writes to memory at a fixed size")]
fn jpeg(rgb: &[u8], quality: u8, sampling: SamplingFactor, table: &QuantizationTableType) -> Image {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, quality);
    encoder.set_sampling_factor(sampling);
    encoder.set_quantization_tables(table.clone(), table.clone());
    encoder.set_progressive(true);
    encoder.set_optimized_huffman_tables(true);
    encoder
        .encode(rgb, SIZE as u16, SIZE as u16, ColorType::Rgb)
        .expect("memory takes it");
    Image {
        mime_type: "image/jpeg".to_owned(),
        bytes,
    }
}
