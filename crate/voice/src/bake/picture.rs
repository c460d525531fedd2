//! Image of a sentence: the spectrum of its final audio, with the bounds of words and phones and
//! the pitch drawn over it, as SVG.

use core::fmt::Write as _;
use std::path::Path;

use crate::assemble::Speech;
use crate::markup::sable;
use crate::signal::spectrogram::{SpectrogramOptions, spectrogram};
use crate::text::Lexicon;
use anyhow::{Context as _, Result, anyhow};
use base64::prelude::{BASE64_STANDARD, Engine as _};
use quick_xml::escape::partial_escape;
use raconteur_speech::bundle::{FRAME_SECS, hz_of_code};

use super::cast::Cast;
use super::speak::{self, RenderInput};
use crate::files::disk;

/// Width of a second, pixels.
const SECOND: f64 = 420.0;
/// Height of the spectrum.
const HEIGHT: f64 = 360.0;
/// Width of the frequency axis left of the spectrum.
const LEFT: f64 = 56.0;
/// Above it the words, below it the phones and the seconds.
const TOP: f64 = 58.0;
const BELOW: f64 = 64.0;
/// The scale of the pitch at the right, hertz.
const PITCH: (f64, f64) = (50.0, 400.0);

/// Synthesises a SABLE text and writes a plot of its audio and labels to a file.
///
/// # Errors
/// Returns an error if the text cannot be spoken or the plot cannot be written.
pub fn draw(cast: &Cast, text: &str, out: &Path) -> Result<()> {
    let document = if text.trim_start().starts_with('<') {
        text.to_owned()
    } else {
        format!("<SABLE>{text}</SABLE>")
    };
    let (content, _) = sable::read(&document).map_err(|p| anyhow!("{p}"))?;
    let work = RenderInput {
        content: &content,
        role: &cast.primary,
        emotion: None,
        tension: None,
        pace: 1.0,
    };
    let casting = speak::cast(&work, cast, &Lexicon::default())?;
    let track = speak::speak(&work, &casting, cast, &|_| Ok(Vec::new()))?;
    let title = format!("{}: {}", cast.primary.engine, cast.primary.voice.name);
    disk::replace(out, svg(&track, &title)?.as_bytes())
}

fn svg(track: &Speech, title: &str) -> Result<String> {
    let u = &track.utterance;
    let wide = u.duration_secs * SECOND;
    let (width, height) = (LEFT + wide + 48.0, TOP + HEIGHT + BELOW);
    let x = |secs: f64| LEFT + secs * SECOND;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
         viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"system-ui, sans-serif\" font-size=\"13\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fbfaf7\"/>\n\
         <text x=\"{LEFT}\" y=\"18\" font-weight=\"600\">{}</text>\n",
        partial_escape(title)
    );
    let _ = writeln!(
        out,
        "<image x=\"{LEFT}\" y=\"{TOP}\" width=\"{wide:.1}\" height=\"{HEIGHT}\" preserveAspectRatio=\"none\" href=\"data:image/png;base64,{}\"/>",
        spectrum(track)?
    );
    for khz in [1, 2, 3, 4, 5, 6, 7] {
        let y = TOP + HEIGHT * (1.0 - f64::from(khz) / 8.0);
        let _ = writeln!(
            out,
            "<text x=\"{:.0}\" y=\"{:.1}\" text-anchor=\"end\" fill=\"#555\">{khz} kHz</text>",
            LEFT - 8.0,
            y + 4.0
        );
    }
    // Words over the spectrum, their bounds through it.
    for word in &u.words {
        let (from, to) = (x(word.start_secs), x(word.end_secs));
        for at in [from, to] {
            let _ = writeln!(
                out,
                "<path d=\"M{at:.1} {:.0}V{:.0}\" stroke=\"#b3261e\" stroke-width=\"1.2\"/>",
                TOP - 22.0,
                TOP + HEIGHT
            );
        }
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.0}\" text-anchor=\"middle\" fill=\"#7a1a14\">{}</text>",
            (from + to) / 2.0,
            TOP - 8.0,
            partial_escape(&word.text)
        );
    }
    for phone in &u.phones {
        let (from, to) = (x(phone.start_secs), x(phone.end_secs));
        let _ = writeln!(
            out,
            "<path d=\"M{from:.1} {:.0}V{:.0}\" stroke=\"#2456a6\" stroke-width=\"0.8\" stroke-dasharray=\"3 3\"/>\
             <text x=\"{:.1}\" y=\"{:.0}\" text-anchor=\"middle\" fill=\"#1d4485\">{}</text>",
            TOP,
            TOP + HEIGHT + 6.0,
            (from + to) / 2.0,
            TOP + HEIGHT + 20.0,
            partial_escape(&phone.symbol)
        );
    }
    pitch(&mut out, track, &x);
    for tenth in 0..=(u.duration_secs * 5.0) as u32 {
        let secs = f64::from(tenth) / 5.0;
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.0}\" text-anchor=\"middle\" fill=\"#555\">{secs:.1}</text>",
            x(secs),
            TOP + HEIGHT + 44.0
        );
    }
    out.push_str("</svg>\n");
    Ok(out)
}

/// Plots the pitch as a line over the spectrum, on its own musical scale.
fn pitch(out: &mut String, track: &Speech, x: &dyn Fn(f64) -> f64) {
    let y = |hz: f64| {
        let share = libm::log(hz / PITCH.0) / libm::log(PITCH.1 / PITCH.0);
        TOP + HEIGHT * (1.0 - share)
    };
    let mut path = String::new();
    let mut pen = 'M';
    for (i, code) in track.utterance.f0.iter().enumerate() {
        match hz_of_code(*code) {
            Some(hz) => {
                let _ = write!(path, "{pen}{:.1} {:.1}", x(i as f64 * FRAME_SECS), y(hz));
                pen = 'L';
            }
            None => pen = 'M',
        }
    }
    for (color, width) in [("#ffffff", 4.5), ("#0b7a4b", 2.5)] {
        let _ = writeln!(
            out,
            "<path d=\"{path}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\" stroke-linecap=\"round\" stroke-linejoin=\"round\"/>"
        );
    }
    for hz in [75.0, 100.0, 150.0, 200.0, 300.0] {
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.1}\" fill=\"#0b7a4b\">{hz:.0}</text>",
            x(track.utterance.duration_secs) + 6.0,
            y(hz) + 4.0
        );
    }
    let _ = writeln!(
        out,
        "<text x=\"{:.1}\" y=\"{:.1}\" fill=\"#0b7a4b\">Hz</text>",
        x(track.utterance.duration_secs) + 6.0,
        TOP - 6.0
    );
}

/// Returns the spectrogram as a PNG; dark areas have much energy.
fn spectrum(track: &Speech) -> Result<String> {
    let options = SpectrogramOptions {
        step_secs: 1.0 / SECOND,
        height: HEIGHT as usize,
        ..SpectrogramOptions::default()
    };
    let spectrum = spectrogram(&track.samples, track.rate_hz, &options);
    let mut bytes = Vec::new();
    let size = |n: usize| u32::try_from(n).context("the sentence is too long for a picture");
    let mut encoder = png::Encoder::new(&mut bytes, size(spectrum.width)?, size(spectrum.height)?);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Eight);
    let light: Vec<u8> = spectrum.levels.iter().map(|level| 255 - level).collect();
    encoder.write_header()?.write_image_data(&light)?;
    Ok(BASE64_STANDARD.encode(&bytes))
}
