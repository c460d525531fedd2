//! Control parameters: named values that shape the face and the body (GEVH 3.2.4, D.3.27 to
//! D.3.30).

use crate::record::{record, words};

record! {
    /// Sets a control parameter (GEVH D.3.27).
    SetControlParameter = "body-set-control-parameter" {
        /// Parameter, such as `Disgust`.
        parameter: String = "parameterId",
        /// Value to set, 0 to 1.
        value: f64 = "value",
    }
}

record! {
    /// Moves a control parameter through attack, decay, sustain and release (GEVH D.3.28).
    AdsrControlParameter = "body-animate-ADSR-control-parameter" {
        /// Parameter to animate.
        parameter: String = "parameterId",
        /// Duration of the attack, from the previous value to the attack value, seconds.
        attack_secs: f64 = "attackDurationTime",
        /// The value at the end of the attack.
        attack_value: f64 = "attackValue",
        /// Duration of the decay, from the attack value to the decay value, seconds.
        decay_secs: f64 = "decayDurationTime",
        /// The value at the end of the decay.
        decay_value: f64 = "decayValue",
        /// Duration of the sustain, seconds.
        sustain_secs: f64 = "sustainDurationTime",
        /// Sustain value; none: the decay value.
        sustain_value: Option<f64> = "sustainValue",
        /// Duration of the release, from the sustain value to the release value, seconds.
        release_secs: f64 = "releaseDurationTime",
        /// The value at the end.
        release_value: f64 = "releaseValue",
    }
}

record! {
    /// Loads an animation of control parameters into the library (GEVH D.3.29).
    LoadControlParameterAnimation = "body-load-control-parameter-animation" {
        /// Path of the animation file, relative to the story or the library.
        file: String = "file",
        /// True if the file is in the library instead of next to the story.
        is_resources_relative: bool = "isResourcesRelative",
    }
}

words! {
    /// Direction in which an animation of control parameters plays.
    Style {
        /// Plays from start to end.
        Forward = "forward",
        /// Plays from end to start.
        Reverse = "reverse",
        /// Forward, then back.
        PingPong = "pingPong",
        /// Back, then forward.
        ReversePingPong = "reversePingPong",
    }
}

record! {
    /// Plays an animation of control parameters from the library (GEVH D.3.30).
    AnimateControlParameter = "body-animate-control-parameter" {
        /// Animation to play.
        animation: String = "animationId",
        /// Direction of playback.
        style: Style = "style",
        /// Factor for its values.
        gain: f64 = "value",
    }
}

impl AnimateControlParameter {
    /// Returns the playing time, seconds; `length` gives the length of one pass.
    pub(crate) fn length_secs(&self, length: impl Fn(&str) -> Option<f64>) -> f64 {
        let passes = match self.style {
            Style::Forward | Style::Reverse => 1.0,
            Style::PingPong | Style::ReversePingPong => 2.0,
        };
        let known = length(&self.animation).filter(|secs| (0.0..=3600.0).contains(secs));
        known.map_or(0.0, |secs| secs * passes)
    }
}
