//! Image decoder for figures: the renderer needs pixels, and no browser is available here.

use std::path::Path;

use anyhow::{Context as _, Result, bail};
use raconteur_body::Figure;
use raconteur_body::figure::Image;
use raconteur_render::{Headless, MAX_SIDE_PX};
use raconteur_voice::files::disk;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// Decoded image: width, height, and RGBA bytes in rows from the top.
type Pixels = (u32, u32, Vec<u8>);

/// Uploads a figure and its images to the renderer.
///
/// # Errors
/// Returns an error if the figure cannot be rendered or an image cannot be decoded.
pub(crate) fn set_figure(headless: &mut Headless, figure: &Figure) -> Result<()> {
    headless.set_figure(figure)?;
    for (index, image) in figure.images.iter().enumerate() {
        let (width, height, rgba) = decode(image)
            .with_context(|| format!("picture {index} of the figure {}", figure.name))?;
        headless.set_image(index, width, height, &rgba)?;
    }
    Ok(())
}

/// Writes an RGBA image as PNG; the old file is kept if that fails.
pub(crate) fn write_png(path: &Path, (width, height): (u32, u32), rgba: &[u8]) -> Result<()> {
    let mut bytes = Vec::new();
    let mut encode = || -> Result<()> {
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(rgba)?;
        Ok(writer.finish()?)
    };
    encode().with_context(|| format!("cannot write {}", path.display()))?;
    disk::replace(path, &bytes)
}

fn decode(image: &Image) -> Result<Pixels> {
    match image.mime_type.as_str() {
        "image/png" => decode_png(&image.bytes),
        "image/jpeg" => decode_jpeg(&image.bytes),
        other => bail!("it is of the type {other}; image/png and image/jpeg can be read"),
    }
}

fn decode_png(bytes: &[u8]) -> Result<Pixels> {
    let limits = png::Limits {
        bytes: 4 * MAX_SIDE_PX as usize * MAX_SIDE_PX as usize,
    };
    let mut decoder = png::Decoder::new_with_limits(std::io::Cursor::new(bytes), limits);
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info()?;
    let (width, height) = (reader.info().width, reader.info().height);
    check_size(width, height)?;
    let size = reader
        .output_buffer_size()
        .context("the picture does not fit into memory")?;
    let mut samples = vec![0; size];
    let info = reader.next_frame(&mut samples)?;
    samples.truncate(info.buffer_size());
    let rgba = match info.color_type {
        png::ColorType::Rgba => samples,
        png::ColorType::Rgb => expand::<3>(&samples, |p| [p[0], p[1], p[2], 255]),
        png::ColorType::GrayscaleAlpha => expand::<2>(&samples, |p| [p[0], p[0], p[0], p[1]]),
        png::ColorType::Grayscale => expand::<1>(&samples, |p| [p[0], p[0], p[0], 255]),
        png::ColorType::Indexed => bail!("its palette was not resolved"),
    };
    Ok((width, height, rgba))
}

fn expand<const N: usize>(samples: &[u8], pixel: impl Fn(&[u8; N]) -> [u8; 4]) -> Vec<u8> {
    samples.as_chunks::<N>().0.iter().flat_map(pixel).collect()
}

fn decode_jpeg(bytes: &[u8]) -> Result<Pixels> {
    let options = DecoderOptions::default()
        .jpeg_set_out_colorspace(ColorSpace::RGBA)
        .set_max_width(MAX_SIDE_PX as usize)
        .set_max_height(MAX_SIDE_PX as usize);
    let mut decoder = zune_jpeg::JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    let rgba = decoder.decode()?;
    let info = decoder.info().context("it has no size")?;
    let (width, height) = (u32::from(info.width), u32::from(info.height));
    check_size(width, height)?;
    Ok((width, height, rgba))
}

fn check_size(width: u32, height: u32) -> Result<()> {
    if width.max(height) > MAX_SIDE_PX {
        bail!("it is {width}x{height}; a side is at most {MAX_SIDE_PX} long");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(mime_type: &str, bytes: Vec<u8>) -> Image {
        Image {
            mime_type: mime_type.to_owned(),
            bytes,
        }
    }

    fn png_file(color: png::ColorType, (width, height): (u32, u32), samples: &[u8]) -> Vec<u8> {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, width, height);
        encoder.set_color(color);
        encoder.set_depth(png::BitDepth::Eight);
        encoder
            .write_header()
            .and_then(|mut w| w.write_image_data(samples))
            .unwrap();
        file
    }

    #[test]
    fn every_kind_of_png_becomes_rgba() {
        for (color, samples, expected) in [
            (png::ColorType::Rgba, vec![1, 2, 3, 4], [1, 2, 3, 4]),
            (png::ColorType::Rgb, vec![1, 2, 3], [1, 2, 3, 255]),
            (png::ColorType::GrayscaleAlpha, vec![9, 4], [9, 9, 9, 4]),
            (png::ColorType::Grayscale, vec![9], [9, 9, 9, 255]),
        ] {
            let file = png_file(color, (1, 1), &samples);
            let (w, h, rgba) = decode(&image("image/png", file)).unwrap();
            assert_eq!((w, h, rgba), (1, 1, expected.to_vec()));
        }
    }

    #[test]
    fn what_is_no_picture_is_an_error() {
        let whole = png_file(png::ColorType::Rgb, (16, 16), &[7; 768]);
        for cut in [0, 5, 20, 40, whole.len() - 20] {
            assert!(
                decode(&image("image/png", whole[..cut].to_vec())).is_err(),
                "a truncated PNG is rejected"
            );
        }
        for bytes in [vec![], vec![0xff, 0xd8], vec![0xff; 100], whole.clone()] {
            assert!(
                decode(&image("image/jpeg", bytes)).is_err(),
                "an invalid JPEG is rejected"
            );
        }
        assert!(
            decode(&image("image/webp", whole)).is_err(),
            "an unsupported image type is rejected"
        );
        // A header that claims more than the limit.
        let huge = png_file(png::ColorType::Grayscale, (9000, 1), &[0; 9000]);
        assert!(
            decode(&image("image/png", huge)).is_err(),
            "an oversized image is rejected"
        );
    }
}
