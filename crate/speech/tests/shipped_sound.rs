//! What is heard in the bundles that are shipped, against what they tell: pauses are still,
//! plosives burst where their phones are, vowels are voiced. The sound is that of the MP3
//! files, decoded by a library that nobody here wrote.

use std::fs::{self, File};
use std::path::{Path, PathBuf};

use raconteur_speech::bundle::SILENCE;
use raconteur_speech::manner::{Manner, manner};
use raconteur_speech::signal::{bursts, f0, intensity};
use raconteur_speech::{Bundle, Utterance};
use symphonia::core::audio::SampleBuffer;
use symphonia::core::codecs::DecoderOptions;
use symphonia::core::formats::FormatOptions;
use symphonia::core::io::MediaSourceStream;
use symphonia::core::meta::MetadataOptions;
use symphonia::core::probe::Hint;

/// A burst is at its phone when it is no further from it than this.
const BURST_SECS: f64 = 0.02;
/// A pause fades from the speech before it and into the speech after it for this long.
const FADE_SECS: f64 = 0.06;

fn voices(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.join("speech.json").is_file() {
            found.push(path);
        } else if path.is_dir() {
            voices(&path, found);
        }
    }
}

/// One channel of an MP3 without the silence that its encoder added, and its rate.
fn decode(path: &Path) -> (Vec<f64>, f64) {
    let stream = MediaSourceStream::new(Box::new(File::open(path).unwrap()), Default::default());
    let gapless = FormatOptions {
        enable_gapless: true,
        ..FormatOptions::default()
    };
    let mut hint = Hint::new();
    hint.with_extension("mp3");
    let mut format = symphonia::default::get_probe()
        .format(&hint, stream, &gapless, &MetadataOptions::default())
        .unwrap()
        .format;
    let parameters = format.default_track().unwrap().codec_params.clone();
    let mut decoder = symphonia::default::get_codecs()
        .make(&parameters, &DecoderOptions::default())
        .unwrap();
    let mut samples = Vec::new();
    // The end of the file is an error of the reader.
    while let Ok(packet) = format.next_packet() {
        let decoded = decoder.decode(&packet).unwrap();
        let mut buffer = SampleBuffer::<f32>::new(decoded.capacity() as u64, *decoded.spec());
        buffer.copy_interleaved_ref(decoded);
        samples.extend(buffer.samples().iter().copied().map(f64::from));
    }
    (samples, f64::from(parameters.sample_rate.unwrap()))
}

/// How often something holds, of how often it was looked at.
#[derive(Clone, Copy, Default)]
struct Share {
    holds: usize,
    of: usize,
}

impl Share {
    fn count(&mut self, holds: bool) {
        self.holds += usize::from(holds);
        self.of += 1;
    }

    fn add(&mut self, other: Self) {
        self.holds += other.holds;
        self.of += other.of;
    }

    fn percent(self) -> f64 {
        100.0 * self.holds as f64 / self.of.max(1) as f64
    }
}

#[derive(Clone, Copy, Default)]
struct Heard {
    bursts: Share,
    vowels: Share,
    /// Sums of squares and counts, of speech and of pauses.
    speech: (f64, usize),
    pauses: (f64, usize),
}

fn hear(utterance: &Utterance, phone_set: &str, samples: &[f64], rate_hz: f64) -> Heard {
    let mut heard = Heard::default();
    let track = f0::track_voice(samples, rate_hz, 0.005);
    let part = |from: f64, to: f64| {
        let at = |secs: f64| ((secs.max(0.0) * rate_hz) as usize).min(samples.len());
        let (from, to) = (at(from), at(to));
        &samples[from..to.max(from)]
    };
    let power = |sound: &[f64]| (sound.iter().map(|s| s * s).sum::<f64>(), sound.len());
    let add = |sum: &mut (f64, usize), one: (f64, usize)| {
        sum.0 += one.0;
        sum.1 += one.1;
    };
    for (i, phone) in utterance.phones.iter().enumerate() {
        let (from, to) = (phone.start_secs, phone.end_secs);
        if phone.symbol == SILENCE {
            add(
                &mut heard.pauses,
                power(part(from + FADE_SECS, to - FADE_SECS / 2.0)),
            );
            continue;
        }
        add(&mut heard.speech, power(part(from, to)));
        match manner(phone_set, &phone.symbol) {
            Manner::Plosive => {
                // Two plosives in a row share a burst.
                let next = utterance.phones.get(i + 1);
                if next.is_some_and(|n| manner(phone_set, &n.symbol) == Manner::Plosive) {
                    continue;
                }
                let near = bursts::find(samples, rate_hz, from - BURST_SECS, to + BURST_SECS);
                if near.is_some() {
                    heard.bursts.count(true);
                } else if let Some(astray) = bursts::find(samples, rate_hz, from - 0.05, to + 0.05)
                {
                    // Friction begins sharply as well: what is at another consonant is that's.
                    let of_another = utterance.phones.iter().enumerate().any(|(k, other)| {
                        let at = other.start_secs - BURST_SECS..other.end_secs + BURST_SECS;
                        let sharp = matches!(
                            manner(phone_set, &other.symbol),
                            Manner::Plosive | Manner::Fricative
                        );
                        k != i && sharp && at.contains(&astray.secs)
                    });
                    if !of_another {
                        heard.bursts.count(false);
                    }
                }
            }
            Manner::Vowel => {
                let middle = from + 0.5 * (to - from);
                let third = (to - from) / 6.0;
                let share = track.voiced_share(middle - third, middle + third);
                heard.vowels.count(share > 0.0);
            }
            _ => {}
        }
    }
    heard
}

#[test]
fn what_is_heard_is_what_the_bundles_tell() {
    let mut folders = Vec::new();
    let stories = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/stories");
    voices(&stories, &mut folders);
    folders.sort();
    let (mut all_bursts, mut all_vowels) = (Share::default(), Share::default());
    for folder in folders {
        let bundle = Bundle::from_json(&fs::read(folder.join("speech.json")).unwrap()).unwrap();
        let mut sum = Heard::default();
        for utterance in &bundle.utterances {
            let file = &utterance.audio[1].file;
            let (samples, rate_hz) = decode(&folder.join(file));
            let secs = samples.len() as f64 / rate_hz;
            assert!(
                (secs - utterance.duration_secs).abs() < 0.005,
                "{file} lasts {secs} s, its phones {} s",
                utterance.duration_secs
            );
            let phone_set = &bundle.voices[utterance.voice].phone_set;
            let heard = hear(utterance, phone_set, &samples, rate_hz);
            sum.bursts.add(heard.bursts);
            sum.vowels.add(heard.vowels);
            for (sum, one) in [
                (&mut sum.speech, heard.speech),
                (&mut sum.pauses, heard.pauses),
            ] {
                sum.0 += one.0;
                sum.1 += one.1;
            }
        }
        let db = |(power, count): (f64, usize)| intensity::decibels(power / count.max(1) as f64);
        let under = db(sum.speech) - db(sum.pauses);
        println!(
            "{}: bursts {:.1} % of {}, vowels {:.1} % of {}, pauses {under:.1} dB under speech",
            folder.display(),
            sum.bursts.percent(),
            sum.bursts.of,
            sum.vowels.percent(),
            sum.vowels.of
        );
        assert!(under >= 35.0, "{}: {under:.1} dB", folder.display());
        all_bursts.add(sum.bursts);
        all_vowels.add(sum.vowels);
    }
    assert!(all_bursts.of > 300 && all_vowels.of > 700);
    assert!(
        all_bursts.percent() >= 95.0,
        "{:.1} %",
        all_bursts.percent()
    );
    assert!(
        all_vowels.percent() >= 98.0,
        "{:.1} %",
        all_vowels.percent()
    );
}
