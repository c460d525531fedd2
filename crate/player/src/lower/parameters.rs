//! Conversion of the clauses of control parameters to the actor's commands (GEVH D.3.27 to D.3.30).

use raconteur_actor::parameters::{Adsr, Parameter, ParameterCommand, PlaybackStyle};
use raconteur_eml::{
    AdsrControlParameter, ClauseKind, Diagnostic, Document, Span, Timeline, nearest, quoted,
};

/// Maximum number of unknown names that are reported.
const MAX_REPORTED: usize = 100;

/// Returns a script's commands to control parameters, sorted by time. Unknown names are omitted;
/// [`problems`] reports them.
pub(crate) fn commands(document: &Document, timeline: &Timeline) -> Vec<(f64, ParameterCommand)> {
    let mut commands = Vec::new();
    for timed in &timeline.clauses {
        let at = timed.start_secs;
        match &document.clause(timed.clause).kind {
            ClauseKind::SetControlParameter(set) => {
                let value = set.value;
                let each = Parameter::named(&set.parameter);
                commands.extend(each.map(|p| (at, ParameterCommand::Set(p, value))));
            }
            ClauseKind::AdsrControlParameter(adsr) => {
                let phases = phases(adsr);
                let each = Parameter::named(&adsr.parameter);
                commands.extend(each.map(|p| (at, ParameterCommand::Lead(p, phases))));
            }
            ClauseKind::AnimateControlParameter(animate) => {
                let play = ParameterCommand::Play {
                    animation: animate.animation.clone(),
                    style: style(animate.style),
                    gain: animate.gain,
                };
                commands.push((at, play));
            }
            _ => {}
        }
    }
    commands
}

fn phases(adsr: &AdsrControlParameter) -> Adsr {
    Adsr {
        secs: [
            adsr.attack_secs,
            adsr.decay_secs,
            adsr.sustain_secs,
            adsr.release_secs,
        ],
        values: [
            adsr.attack_value,
            adsr.decay_value,
            adsr.sustain_value.unwrap_or(adsr.decay_value),
            adsr.release_value,
        ],
    }
}

fn style(style: raconteur_eml::Style) -> PlaybackStyle {
    match style {
        raconteur_eml::Style::Forward => PlaybackStyle::Forward,
        raconteur_eml::Style::Reverse => PlaybackStyle::Reverse,
        raconteur_eml::Style::PingPong => PlaybackStyle::PingPong,
        raconteur_eml::Style::ReversePingPong => PlaybackStyle::ReversePingPong,
    }
}

/// Returns a warning for each unknown parameter name, at its first clause, and for each clause with
/// values out of the parameter's range.
pub(crate) fn problems(document: &Document) -> Vec<Diagnostic> {
    let mut told: Vec<&str> = Vec::new();
    let mut problems = Vec::new();
    for (_, clause) in document.iter() {
        let (name, values): (&str, [f64; 4]) = match &clause.kind {
            ClauseKind::SetControlParameter(set) => (&set.parameter, [set.value; 4]),
            ClauseKind::AdsrControlParameter(adsr) => (&adsr.parameter, phases(adsr).values),
            _ => continue,
        };
        let least = Parameter::named(name).map(Parameter::min_value);
        if let Some(least) = least.reduce(f64::min) {
            problems.extend(range_problem(name, &values, least, clause.tag_span));
        } else if !told.contains(&name) && told.len() < MAX_REPORTED {
            told.push(name);
            problems.push(unknown(name, clause.tag_span));
        }
    }
    problems
}

fn range_problem(name: &str, values: &[f64], least: f64, span: Span) -> Option<Diagnostic> {
    let value = values.iter().find(|v| !(least..=1.0).contains(*v))?;
    let message = format!(
        "{} goes from {least} to 1, so {value} is as much as {}",
        quoted(name),
        value.clamp(least, 1.0)
    );
    Some(Diagnostic::warning("player::out-of-range", span, message))
}

fn unknown(name: &str, span: Span) -> Diagnostic {
    let hint = match nearest(name, Parameter::names()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => "there are muscles such as `ZygomaticusMajorLeft` (without a side: both), \
                 `Jaw`, `JawYaw`, `JawForward`, `JawDown`, `UpperLid`, `LowerLid`, `GazeX`, \
                 `GazeY`, `LipProtrusion`, `LipSeal`, `LipBite`, `TongueTip`, `TongueBack`, \
                 `TongueOut`, `Blush`; visemes such as `PP`; emotions such as `Joy`"
            .to_owned(),
    };
    let message = format!("there is no control parameter {}", quoted(name));
    Diagnostic::warning("player::no-parameter", span, message).hint(hint)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Script;
    use raconteur_actor::parameters::{ParameterScript, ParameterTrack};
    use raconteur_actor::{EmotionTrack, Library};
    use raconteur_body::face::{FaceControls, Muscle};

    const YAWN: &str = r#"{"seconds": 2, "parameters": {
        "Jaw": {"times": [0, 1, 2], "values": [0, 1, 0]},
        "Disgust": {"times": [0, 2], "values": [1, 1]}}}"#;

    fn library() -> Library {
        let mut library = Library::default();
        library
            .add_parameters("faces/yawn.json", YAWN)
            .expect("a clip");
        library
    }

    /// Returns the tracks of a document's parameters and emotions, and its diagnostics.
    fn perform(body: &str) -> (ParameterTrack, EmotionTrack, Vec<Diagnostic>) {
        let mut script = Script::read(&format!("<eml><body>{body}</body></eml>"), None);
        let library = library();
        script.retime(&library);
        let commands = commands(&script.document, &script.timeline);
        let find = |name: &str| library.parameters(name);
        let parameters = ParameterTrack::new(&ParameterScript { commands }, &find);
        let emotions = EmotionTrack::new(&[], parameters.emotions());
        (parameters, emotions, problems(&script.document))
    }

    /// Measures of a face.
    fn seen(controls: &FaceControls, what: &str) -> f64 {
        match what {
            "jaw" => controls.jaw.pitch_rad / 0.35,
            "blush" => controls.blush,
            "lids" => controls.upper_lid[0] + controls.upper_lid[1],
            muscle => controls.contraction[Muscle::by_name(muscle).expect(muscle).index()],
        }
    }

    #[test]
    fn documents_lead_parameters() {
        type Case = (&'static str, &'static [(f64, &'static str, f64)]);
        let cases: &[Case] = &[
            (
                "<body-set-control-parameter time='1' parameterId='ZygomaticusMajor' value='0.5'/>
                 <body-set-control-parameter time='3' parameterId='zygomaticusmajorleft' value='0'/>",
                &[
                    (0.9, "ZygomaticusMajorLeft", 0.0),
                    (2.0, "ZygomaticusMajorLeft", 0.5),
                    (2.0, "ZygomaticusMajorRight", 0.5),
                    (4.0, "ZygomaticusMajorLeft", 0.0),
                    (4.0, "ZygomaticusMajorRight", 0.5),
                ],
            ),
            (
                "<body-animate-ADSR-control-parameter time='1' parameterId='Jaw'
                   attackDurationTime='0.4' attackValue='0.8' decayDurationTime='0.2'
                   decayValue='0.4' sustainDurationTime='1' releaseDurationTime='0.4'/>",
                &[
                    (1.2, "jaw", 0.4),
                    (1.4, "jaw", 0.8),
                    (1.5, "jaw", 0.6),
                    (1.6, "jaw", 0.4),
                    (2.6, "jaw", 0.4),
                    (2.8, "jaw", 0.2),
                    (3.1, "jaw", 0.0),
                ],
            ),
            // Values out of range in both directions.
            (
                "<body-set-control-parameter time='0' parameterId='UpperLid' value='7'/>
                 <body-set-control-parameter time='0' parameterId='Blush' value='-1'/>
                 <body-set-control-parameter time='2' parameterId='Jaw' value='-3'/>",
                &[(1.0, "lids", 2.0), (1.0, "blush", -1.0), (3.0, "jaw", 0.0)],
            ),
            // In a sequence the second begins when the first has played there and back.
            (
                "<seq time='0'><body-animate-control-parameter time='0' animationId='yawn'
                    style='pingPong' value='0.5'/>
                 <body-set-control-parameter time='0' parameterId='LeftLid' value='1'/>
                 <body-set-control-parameter time='0' parameterId='DepressorSeptiNasi' value='1'/></seq>",
                &[
                    (1.0, "jaw", 0.5),
                    (2.0, "jaw", 0.0),
                    (3.0, "jaw", 0.5),
                    (3.9, "DepressorSeptiNasi", 0.0),
                    (4.2, "DepressorSeptiNasi", 1.0),
                    (9.0, "jaw", 0.0),
                    // Half of disgust stays when the animation is over.
                    (9.0, "NasalisLeft", 0.3),
                ],
            ),
            (
                "<body-set-control-parameter time='0' parameterId='Sadness' value='0.5'/>
                 <body-set-control-parameter time='0' parameterId='surprise' value='1'/>
                 <body-set-control-parameter time='2' parameterId='surprise' value='0'/>",
                &[
                    // A third of the one and two of the other.
                    (1.0, "FrontalisLateralLeft", 0.95 * 2.0 / 3.0),
                    (3.0, "FrontalisLateralLeft", 0.0),
                    (3.0, "DepressorAnguliOrisRight", 0.3),
                ],
            ),
        ];
        for (body, wanted) in cases {
            let (parameters, emotions, _) = perform(body);
            for (t, what, value) in *wanted {
                let mut controls = FaceControls::default();
                parameters.add(*t, &mut controls);
                emotions.add(*t, &mut controls);
                let is = seen(&controls, what);
                assert!(
                    (is - value).abs() < 1e-9,
                    "{what} at {t}: {is}, not {value}\n{body}"
                );
            }
        }
    }

    #[test]
    fn unknown_names_are_told_once_with_a_hint() {
        let (_, _, told) = perform(
            "<body-set-control-parameter time='0' parameterId='Disgast' value='1'/>
             <body-set-control-parameter time='1' parameterId='Disgast' value='0'/>
             <body-animate-ADSR-control-parameter time='1' parameterId='Wings'/>
             <body-set-control-parameter time='1' parameterId='VisemePP' value='1'/>",
        );
        let told: Vec<_> = told
            .iter()
            .filter(|d| d.code == "player::no-parameter")
            .collect();
        assert_eq!(told.len(), 2, "{told:?}");
        assert_eq!(told[0].message, "there is no control parameter `Disgast`");
        assert_eq!(told[0].hints, ["did you mean `disgust`?"]);
        assert!(
            told[1].hints[0].contains("visemes such as `PP`"),
            "the hint names the known visemes"
        );
    }
}
