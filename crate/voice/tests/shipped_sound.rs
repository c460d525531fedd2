//! Comparison of the shipped bundles' audio with their data: pauses are silent, plosives burst at
//! their phones, vowels are voiced. The audio is that of the MP3 files, decoded by a third-party
//! library.

use std::fs::{self, File};
use std::path::{Path, PathBuf};

use raconteur_speech::Bundle;
use raconteur_voice::measured_speech::{MeasuredSpeech, measure_speech};
use symphonia::core::audio::SampleBuffer;
use symphonia::core::codecs::DecoderOptions;
use symphonia::core::formats::FormatOptions;
use symphonia::core::io::MediaSourceStream;
use symphonia::core::meta::MetadataOptions;
use symphonia::core::probe::Hint;

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

#[test]
fn what_is_heard_is_what_the_bundles_tell() {
    let mut folders = Vec::new();
    let stories = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/stories");
    voices(&stories, &mut folders);
    folders.sort();
    let mut all = MeasuredSpeech::default();
    for folder in folders {
        let bundle = Bundle::from_json(&fs::read(folder.join("speech.json")).unwrap()).unwrap();
        let mut sum = MeasuredSpeech::default();
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
            sum.add(&measure_speech(utterance, phone_set, &samples, rate_hz));
        }
        let under = sum.pauses_under_db();
        println!(
            "{}: bursts {:.1} % of {}, vowels {:.1} % of {}, final ones {:.1} % of {}, pauses \
             {under:.1} dB under speech",
            folder.display(),
            sum.bursts.percent(),
            sum.bursts.of,
            sum.vowels.percent(),
            sum.vowels.of,
            sum.final_vowels.percent(),
            sum.final_vowels.of
        );
        assert!(under >= 35.0, "{}: {under:.1} dB", folder.display());
        all.add(&sum);
    }
    assert!(
        all.bursts.of > 600 && all.vowels.of > 1400,
        "enough bursts and vowels are compared"
    );
    assert!(
        all.bursts.percent() >= 95.0,
        "{:.1} %",
        all.bursts.percent()
    );
    assert!(
        all.vowels.percent() >= 99.0,
        "{:.1} %",
        all.vowels.percent()
    );
    assert!(
        all.final_vowels.percent() >= 60.0,
        "{:.1} %",
        all.final_vowels.percent()
    );
}
