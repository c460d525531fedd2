//! Animations of control parameters (GEVH D.3.29): JSON with key times and values by parameter
//! name.
//!
//! ```json
//! {
//!   "seconds": 1.5,
//!   "times": [0, 0.3, 1.5],
//!   "parameters": {
//!     "Joy": { "values": [0, 1, 0], "ease": "smooth" },
//!     "UpperLidLeft": { "times": [0.4, 0.45, 0.6], "values": [0, 1, 0] }
//!   }
//! }
//! ```
//!
//! `seconds` is the length of one pass. Tracks without `times` use those of the animation. Between
//! keys, values are interpolated linearly (`linear`, the default) or rest at each key (`smooth`).

use raconteur_base::curve::{last_at_or_before, lerp, smooth};
use serde::Deserialize;
use serde_json::Value;

use super::name::Parameter;
use crate::members::{Members, items};

/// The longest text that is read, bytes.
const MAX_BYTES: usize = 1 << 20;
/// The longest animation, seconds.
const MAX_SECS: f64 = 3600.0;
/// Maximum number of keys of a track.
const MAX_KEYS: usize = 1 << 14;

/// Animation of control parameters of the face: keyed values per parameter; a story plays it by
/// name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ParameterClip {
    seconds: f64,
    tracks: Vec<(Parameter, Keys)>,
}

/// Clip-wide fields of a file; fields of another type are ignored.
#[derive(Default, Deserialize)]
#[serde(default)]
struct ClipHeader {
    parameters: Option<Members>,
    seconds: Value,
    times: Value,
}

/// Values over time.
#[derive(Clone, Debug, Default, PartialEq)]
struct Keys {
    times: Vec<f64>,
    values: Vec<f64>,
    smooth: bool,
}

impl ParameterClip {
    /// Parses an animation of control parameters from JSON.
    ///
    /// # Errors
    /// Returns an error message that describes the problem and names the parameter.
    pub fn read(text: &str) -> Result<Self, String> {
        if text.len() > MAX_BYTES {
            return Err("it is larger than 1 MB".to_owned());
        }
        let root: ClipHeader =
            serde_json::from_slice(text.as_bytes()).map_err(|e| e.to_string())?;
        let parameters = root.parameters.as_ref().ok_or("it has no parameters")?;
        let seconds = root.seconds.as_f64().unwrap_or(-1.0);
        if !(0.0..=MAX_SECS).contains(&seconds) {
            return Err("its seconds are not between 0 and an hour".to_owned());
        }
        let mut clip = Self {
            seconds,
            tracks: Vec::new(),
        };
        for (name, track) in &parameters.0 {
            let keys = Keys::read(track, &root.times, seconds);
            let keys = keys.map_err(|why| format!("in the parameter {name}, {why}"))?;
            let before = clip.tracks.len();
            for parameter in Parameter::named(name) {
                clip.tracks.retain(|(known, _)| *known != parameter);
                clip.tracks.push((parameter, keys.clone()));
            }
            if clip.tracks.len() == before && Parameter::named(name).next().is_none() {
                return Err(format!("there is no parameter {name}"));
            }
        }
        Ok(clip)
    }

    /// Returns the duration of one pass of the animation, seconds.
    #[must_use]
    pub fn duration_secs(&self) -> f64 {
        self.seconds
    }

    /// Returns the parameters that it moves, each with its index.
    pub(super) fn parameters(&self) -> impl Iterator<Item = (usize, Parameter)> + '_ {
        let tracks = self.tracks.iter().enumerate();
        tracks.map(|(place, (parameter, _))| (place, *parameter))
    }

    /// Returns the value of the parameter at an index, `secs` seconds after the start. O(log n).
    pub(super) fn value(&self, place: usize, secs: f64) -> f64 {
        self.tracks
            .get(place)
            .map_or(0.0, |(_, keys)| keys.sample(secs))
    }
}

impl Keys {
    /// Parses the keys of one parameter. `times` are the key times of the animation, used if the
    /// track has none; `end_secs` is its duration.
    fn read(track: &Value, times: &Value, end_secs: f64) -> Result<Self, String> {
        let numbers = |list: &Value| -> Vec<f64> {
            let read: Option<Vec<f64>> = items(list).iter().map(Value::as_f64).collect();
            read.unwrap_or_default()
        };
        let own = &track["times"];
        let times = numbers(if own.is_null() { times } else { own });
        let values = numbers(&track["values"]);
        let rising = times.windows(2).all(|w| w[1] > w[0]);
        if times.is_empty() || times.len() > MAX_KEYS || !rising {
            return Err("the times do not rise".to_owned());
        }
        if times[0] < 0.0 || times[times.len() - 1] > end_secs {
            return Err("the times are not between 0 and the end".to_owned());
        }
        if values.len() != times.len() {
            return Err("there is not one value for each time".to_owned());
        }
        if !values.iter().all(|v| (-1.0..=1.0).contains(v)) {
            return Err("the values are not between -1 and 1".to_owned());
        }
        let smooth = match track["ease"].as_str() {
            None if track["ease"].is_null() => false,
            Some("linear") => false,
            Some("smooth") => true,
            _ => return Err("ease is not linear or smooth".to_owned()),
        };
        Ok(Self {
            times,
            values,
            smooth,
        })
    }

    fn sample(&self, secs: f64) -> f64 {
        let Some(i) = last_at_or_before(&self.times, secs) else {
            return self.values.first().copied().unwrap_or(0.0);
        };
        let Some(next) = self.times.get(i + 1) else {
            return self.values[i];
        };
        let s = (secs - self.times[i]) / (next - self.times[i]);
        let s = if self.smooth { smooth(s) } else { s };
        lerp(self.values[i], self.values[i + 1], s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SMILE: &str = r#"{"seconds": 1.5, "times": [0, 0.5, 1.5], "parameters": {
        "Joy": {"values": [0, 1, 0.2]},
        "UpperLid": {"times": [0.4], "values": [-0.5]},
        "GazeX": {"times": [0, 1], "values": [-1, 1], "ease": "smooth"}}}"#;

    fn value(clip: &ParameterClip, name: &str, secs: f64) -> f64 {
        let found = clip.parameters().find(|(_, p)| p.name() == name);
        clip.value(found.expect(name).0, secs)
    }

    #[test]
    fn keys_are_read_and_passed() {
        let clip = ParameterClip::read(SMILE).expect("a clip");
        assert_eq!(clip.duration_secs(), 1.5);
        for (secs, joy) in [
            (-1.0, 0.0),
            (0.0, 0.0),
            (0.25, 0.5),
            (0.5, 1.0),
            (1.0, 0.6),
            (9.0, 0.2),
        ] {
            assert!((value(&clip, "joy", secs) - joy).abs() < 1e-12, "{secs}");
        }
        assert_eq!(value(&clip, "UpperLidRight", 0.0), -0.5);
        assert_eq!(value(&clip, "GazeX", 0.25), -1.0 + 2.0 * smooth(0.25));
    }

    #[test]
    fn what_is_wrong_is_told() {
        for (from, to, why) in [
            ("1.5,", "-1,", "its seconds"),
            (
                "[0, 1, 0.2]",
                "[0, 1]",
                "in the parameter Joy, there is not one value",
            ),
            ("[0, 1, 0.2]", "[0, 1, 2]", "the values are not"),
            ("[0, 1, 0.2]", "[0, 1, \"x\"]", "there is not one value"),
            ("[0.4]", "[]", "the times do not rise"),
            ("[0.4]", "[1.6]", "the times are not between"),
            ("[0, 0.5, 1.5]", "[0, 0.5, 0.5]", "the times do not rise"),
            ("\"smooth\"", "\"soft\"", "ease is not"),
            ("\"smooth\"", "1", "ease is not"),
            ("\"Joy\"", "\"Bliss\"", "there is no parameter Bliss"),
            ("\"parameters\"", "\"tracks\"", "it has no parameters"),
            ("{", "", "line 1"),
        ] {
            let text = SMILE.replacen(from, to, 1);
            assert_ne!(text, SMILE);
            let told = ParameterClip::read(&text).expect_err(&text);
            assert!(told.contains(why), "{told}");
        }
        let long = " ".repeat(MAX_BYTES + 1);
        assert!(
            ParameterClip::read(&long).is_err(),
            "a clip that is too long is rejected"
        );
    }

    #[test]
    fn any_change_of_a_text_is_refused_or_gives_values_in_range() {
        let mut read = 0;
        for place in 0..SMILE.len() {
            for by in ["", "0", "9", "-", "e9", ",", "[", "}", "\"", "x"] {
                let text = [&SMILE[..place], by, &SMILE[place + 1..]].concat();
                let Ok(clip) = ParameterClip::read(&text) else {
                    continue;
                };
                read += 1;
                for (track, _) in clip.parameters() {
                    for secs in [-1.0, 0.0, 0.45, 1e9, f64::NAN] {
                        let value = clip.value(track, secs);
                        assert!((-1.0..=1.0).contains(&value), "{text} {secs} {value}");
                    }
                }
            }
        }
        assert!(read > 100, "{read}");
    }
}
