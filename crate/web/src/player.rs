//! Class for JavaScript.

use std::sync::Arc;

use raconteur_player::base::Side;
use raconteur_player::body::Bone;
use raconteur_player::body::figure::Image;
use raconteur_player::body::read::read_figure;
use raconteur_player::reshape::{Hair, HairDonors, Reshaper};
use raconteur_player::stage::{Frame, FramingMargin, Lighting, View};
use raconteur_player::{LanguageTag, Options, Player as Performer};
use raconteur_render::{Backend, CanvasTarget, Quality, RenderStatus};
use serde::Serialize;
use serde_wasm_bindgen::Serializer;
use wasm_bindgen::prelude::*;
use web_sys::HtmlCanvasElement;

use crate::activity::{Activity, ActivityGuard, note};
use crate::lesson::Lesson;
use crate::message::{
    EnvironmentExpression, InterruptionOutcome, MusicPiece, Performance, Utterance,
};
use crate::reading::read;

#[cfg(not(any(feature = "webgpu", feature = "webgl")))]
compile_error!("a build for the browser needs the feature `webgpu` or `webgl`");

/// Largest side of the canvas, device pixels: 8K, and no more memory than that.
const MAX_PIXELS: f64 = 8192.0;

/// Amount of idle motion below which the camera motion is reduced as well.
const LITTLE_MOTION: f64 = 0.5;

/// The outcome of a tick; `TickStatus` in `web/element/base/engine.ts`.
#[derive(Clone, Copy)]
#[repr(u32)]
enum TickStatus {
    Shown = 0,
    Skipped = 1,
    Lost = 2,
    NoPicture = 3,
}

/// Storyteller for a web page: a story, a figure, and a canvas if there is one.
#[wasm_bindgen]
pub struct Player {
    pub(crate) performer: Option<Performer>,
    pub(crate) picture: Option<CanvasTarget>,
    /// Width over height.
    pub(crate) aspect: f64,
    /// Lamps chosen by the page instead of those of the story's set.
    pub(crate) lighting: Option<Lighting>,
    /// View chosen by the page instead of the shot.
    pub(crate) view: Option<View>,
    /// Share of the image height that captions take.
    pub(crate) captions: f64,
    /// The dominant hand, where the page chooses it.
    handedness: Option<Side>,
    language: Option<LanguageTag>,
    sized: bool,
    /// Original figure, once its face has been replaced.
    pub(crate) reshaper: Option<Reshaper>,
    /// Hair donors.
    pub(crate) donors: HairDonors,
    /// Hair and beard that the figure has.
    pub(crate) hair: [Hair; 2],
}

#[wasm_bindgen]
#[allow(
    clippy::needless_pass_by_value,
    reason = "optional bytes arrive as owned only"
)]
impl Player {
    /// Opens a device for `canvas`; without one, the storyteller is audible only.
    pub async fn create(canvas: Option<HtmlCanvasElement>) -> Result<Player, JsError> {
        let backend = if cfg!(feature = "webgpu") {
            Backend::WebGpu
        } else {
            Backend::WebGl
        };
        let picture = match canvas {
            Some(canvas) => Some(CanvasTarget::new(canvas, backend).await?),
            None => None,
        };
        Ok(Self {
            performer: None,
            picture,
            aspect: 1.0,
            view: None,
            lighting: None,
            captions: 0.0,
            handedness: None,
            language: None,
            sized: false,
            reshaper: None,
            donors: HairDonors::new(),
            hair: Default::default(),
        })
    }

    /// Reads a story: `bundle` is the text of `speech.json`, `glb` the figure, `motion` the
    /// amount of idle life from 0 to 1. Problems of the text are in the object returned.
    pub fn load(
        &mut self,
        eml: &str,
        bundle: Option<Vec<u8>>,
        figure: &str,
        glb: &[u8],
        motion: f64,
    ) -> Result<JsValue, JsError> {
        let _activity = ActivityGuard::new(Activity::Figure);
        let figure = Arc::new(read_figure(figure, glb)?);
        self.reshaper = None;
        let options = self.options(motion, FramingMargin::default());
        let (mut performer, story) = read(eml, bundle.as_deref(), figure, options);
        performer.set_view(self.view);
        performer.set_lighting(self.lighting);
        performer.set_captions(self.captions);
        note(Activity::Figure);
        if let Some(picture) = &mut self.picture {
            picture.set_figure(performer.figure())?;
        }
        self.performer = Some(performer);
        plain(&story)
    }

    /// Sets the dominant hand, `left` or `right`, in texts that are read from now on; any other
    /// name uses the story's, else the figure's.
    #[wasm_bindgen(js_name = setHandedness)]
    pub fn set_handedness(&mut self, hand: &str) {
        self.handedness = match hand {
            "left" => Some(Side::Left),
            "right" => Some(Side::Right),
            _ => None,
        };
    }

    /// Sets the default language of lip animation, for texts read from now on without a language in
    /// text or bundle: that of the page, a BCP 47 tag. English for any other name.
    #[wasm_bindgen(js_name = setLanguage)]
    pub fn set_language(&mut self, tag: &str) {
        self.language = LanguageTag::new(tag);
    }

    /// Reads another story for the figure on stage, which keeps its images: nothing is uploaded.
    /// Arguments and result are those of `load`. Returns nothing before a `load`.
    #[wasm_bindgen(js_name = replaceStory)]
    pub fn replace_story(
        &mut self,
        eml: &str,
        bundle: Option<Vec<u8>>,
        motion: f64,
    ) -> Result<JsValue, JsError> {
        self.read_again(eml, bundle.as_deref(), motion, FramingMargin::default())
    }

    /// Returns the number of the figure's images, for the page to decode.
    #[wasm_bindgen(js_name = imageCount)]
    pub fn image_count(&self) -> usize {
        self.performer
            .as_ref()
            .map_or(0, |p| p.figure().images.len())
    }

    /// Returns the type of an image: `image/png` or `image/jpeg`.
    #[wasm_bindgen(js_name = imageType)]
    pub fn image_type(&self, index: usize) -> Option<String> {
        self.image(index).map(|i| i.mime_type.clone())
    }

    /// Returns the bytes of the image file with an index; `None` if they were not provided.
    #[wasm_bindgen(js_name = imageBytes)]
    pub fn image_bytes(&self, index: usize) -> Option<Vec<u8>> {
        self.image(index).map(|i| i.bytes.clone())
    }

    /// Sets a decoded image of the figure: RGBA bytes in rows from the top, straight alpha.
    #[wasm_bindgen(js_name = setImage)]
    pub fn set_image(
        &mut self,
        index: usize,
        width: u32,
        height: u32,
        rgba: &[u8],
    ) -> Result<(), JsError> {
        let _activity = ActivityGuard::new(Activity::Figure);
        if let Some(picture) = &mut self.picture {
            picture.set_image(index, width, height, rgba)?;
        }
        Ok(())
    }

    /// Shows the frame of a time; returns a `TickStatus`.
    pub fn tick(&mut self, time_secs: f64) -> Result<u32, JsError> {
        let Some(performer) = &mut self.performer else {
            return Ok(TickStatus::Skipped as u32);
        };
        let _activity = ActivityGuard::new(Activity::Pose);
        performer.advance(time_secs);
        self.draw(|performer, aspect| performer.frame(time_secs, aspect))
    }

    /// Shows the figure that has waited a number of seconds for playback; returns a `TickStatus`.
    /// The next `tick` continues from there, unless a `seek` comes first.
    #[wasm_bindgen(js_name = evaluateIdle)]
    pub fn evaluate_idle(&mut self, waited_secs: f64) -> Result<u32, JsError> {
        let _activity = ActivityGuard::new(Activity::Pose);
        self.draw(|performer, aspect| performer.evaluate_idle(waited_secs, aspect))
    }

    /// Shows the figure that has waited a number of seconds for an answer at `time_secs`, looking
    /// at an EML bone, or at the viewer for any other name.
    #[wasm_bindgen(js_name = evaluateWaiting)]
    pub fn evaluate_waiting(
        &mut self,
        time_secs: f64,
        waited_secs: f64,
        looked_at: &str,
    ) -> Result<u32, JsError> {
        let _activity = ActivityGuard::new(Activity::Pose);
        let bone = Bone::from_name(looked_at);
        self.draw(|performer, aspect| {
            performer.evaluate_waiting(time_secs, waited_secs, bone, aspect)
        })
    }

    /// Seeks like `seek`, but fades from the waiting behaviour into the story.
    #[wasm_bindgen(js_name = seekWithFade)]
    pub fn seek_with_fade(&mut self, time_secs: f64) {
        if let Some(performer) = &mut self.performer {
            performer.seek_with_fade(time_secs);
        }
    }

    /// Renders at `lowest`, `low`, `medium` or `high` quality; any other name adapts the quality to
    /// frame times.
    #[wasm_bindgen(js_name = setQuality)]
    pub fn set_quality(&mut self, name: &str) {
        let fixed = Quality::NAMES.iter().find(|(_, n)| *n == name);
        if let Some(picture) = &mut self.picture {
            picture.choose(fixed.map(|(quality, _)| *quality));
        }
    }

    /// Sets whether the story is paused: a static image is rendered at full size.
    #[wasm_bindgen(js_name = setResting)]
    pub fn set_resting(&mut self, resting: bool) {
        if let Some(picture) = &mut self.picture {
            picture.set_resting(resting);
        }
    }

    /// Takes the time between two displayed frames, milliseconds; the quality follows it.
    #[wasm_bindgen(js_name = reportFrame)]
    pub fn report_frame(&mut self, ms: f64) {
        if let Some(picture) = &mut self.picture {
            picture.report_frame(ms);
        }
    }

    /// Seeks without delivering the cues between; those at `time_secs` itself are still to come.
    pub fn seek(&mut self, time_secs: f64) {
        if let Some(performer) = &mut self.performer {
            performer.seek(time_secs);
        }
    }

    /// Performs a fragment of EML, with plain times counted from the story time `now_secs`; returns
    /// a `Performance`, or nothing before a `load`. `mind` identifies the sender.
    pub fn perform(
        &mut self,
        mind: u32,
        fragment: &str,
        now_secs: f64,
    ) -> Result<JsValue, JsError> {
        let _activity = ActivityGuard::new(Activity::Fragment);
        let Some(performer) = &mut self.performer else {
            return Ok(JsValue::UNDEFINED);
        };
        let performed = performer.perform(mind, fragment, now_secs);
        plain(&Performance {
            events: performed.events(fragment, now_secs),
            utterances: performed.utterances.iter().map(Utterance::new).collect(),
            first_utterance: performed.first_utterance,
            lesson: Lesson::new(performed.questions, Vec::new()),
            end_secs: performer.end_secs(),
            cut: performed.cut_secs.map(|at_secs| InterruptionOutcome {
                at_secs,
                end_secs: performer.end_secs(),
            }),
        })
    }

    /// Ends the actions of fragments at a story time; returns an `InterruptionOutcome`, or nothing
    /// if there was nothing to end.
    pub fn interrupt(&mut self, now_secs: f64) -> Result<JsValue, JsError> {
        let _activity = ActivityGuard::new(Activity::Fragment);
        let Some(performer) = &mut self.performer else {
            return Ok(JsValue::UNDEFINED);
        };
        let Some(at_secs) = performer.interrupt(now_secs) else {
            return Ok(JsValue::UNDEFINED);
        };
        plain(&InterruptionOutcome {
            at_secs,
            end_secs: performer.end_secs(),
        })
    }

    /// Takes the speech of coming fragments: the text of a bundle that begins with the known one.
    /// Returns false if it does not.
    #[wasm_bindgen(js_name = updateBundle)]
    pub fn update_bundle(&mut self, bundle: &[u8]) -> bool {
        let performer = self.performer.as_mut();
        performer.is_some_and(|performer| performer.update_bundle(bundle))
    }

    /// Sets whether the clock may pass the end of the story, because a mind may send more.
    #[wasm_bindgen(js_name = setOpenEnded)]
    pub fn set_open_ended(&mut self, open_ended: bool) {
        if let Some(performer) = &mut self.performer {
            performer.set_open_ended(open_ended);
        }
    }

    /// Sets the size of the canvas: width and height in CSS pixels, and device pixels per CSS
    /// pixel.
    pub fn resize(&mut self, width: f64, height: f64, dpr: f64) {
        let pixels = |css: f64| {
            let wanted = (css * dpr).round();
            // A size that is not a number becomes the smallest.
            if wanted >= 1.0 {
                wanted.min(MAX_PIXELS)
            } else {
                1.0
            }
        };
        let (width, height) = (pixels(width), pixels(height));
        self.aspect = width / height;
        self.sized = true;
        if let Some(picture) = &mut self.picture {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "1 to 8192"
            )]
            picture.resize(width as u32, height as u32);
        }
    }

    /// Returns the music under the performance, as a list of `MusicPiece`.
    pub fn music(&self) -> Result<JsValue, JsError> {
        let music = self.performer.as_ref().map(Performer::music);
        let music = music.unwrap_or_default().into_iter();
        plain(&music.map(MusicPiece::from).collect::<Vec<_>>())
    }

    /// Returns the environment's expression of emotions at a story time; an
    /// `EnvironmentExpression`.
    #[wasm_bindgen(js_name = environmentExpression)]
    pub fn environment_expression(&self, time_secs: f64) -> Result<JsValue, JsError> {
        let expressed = self
            .performer
            .as_ref()
            .map(|p| p.environment_expression(time_secs));
        plain(&expressed.map(EnvironmentExpression::from))
    }

    /// Returns the cues passed since the last call.
    #[wasm_bindgen(js_name = drainEvents)]
    pub fn drain_events(&mut self) -> Result<JsValue, JsError> {
        match &mut self.performer {
            Some(performer) => plain(&performer.drain_events()),
            None => plain(&[(); 0]),
        }
    }
}

impl Player {
    /// Draws a frame of the current performer.
    fn draw(&mut self, frame: impl FnOnce(&mut Performer, f64) -> &Frame) -> Result<u32, JsError> {
        let status = match (&mut self.performer, &mut self.picture) {
            (None, _) => TickStatus::Skipped,
            (_, None) => TickStatus::NoPicture,
            _ if !self.sized => TickStatus::Skipped,
            (Some(performer), Some(picture)) => {
                let frame = frame(performer, self.aspect);
                note(Activity::Drawing);
                match picture.render(frame)? {
                    RenderStatus::Drawn => TickStatus::Shown,
                    RenderStatus::Skipped => TickStatus::Skipped,
                    RenderStatus::DeviceLost => TickStatus::Lost,
                }
            }
        };
        Ok(status as u32)
    }

    /// Makes the figure on stage read a text, with at least `margin` as framing margin.
    pub(crate) fn read_again(
        &mut self,
        eml: &str,
        bundle: Option<&[u8]>,
        motion: f64,
        room: FramingMargin,
    ) -> Result<JsValue, JsError> {
        let Some(before) = &self.performer else {
            return Ok(JsValue::UNDEFINED);
        };
        let _activity = ActivityGuard::new(Activity::Story);
        let figure = Arc::clone(before.figure());
        let (mut performer, story) = read(eml, bundle, figure, self.options(motion, room));
        performer.set_view(self.view);
        performer.set_lighting(self.lighting);
        performer.set_captions(self.captions);
        self.performer = Some(performer);
        plain(&story)
    }

    fn image(&self, index: usize) -> Option<&Image> {
        self.performer.as_ref()?.figure().images.get(index)
    }
}

impl Player {
    /// Returns the options of a performance, with this amount of idle motion and at least `margin` as
    /// framing margin.
    pub(crate) fn options(&self, motion: f64, margin: FramingMargin) -> Options {
        Options {
            motion_amount: if motion.is_nan() {
                1.0
            } else {
                motion.clamp(0.0, 1.0)
            },
            // Reduced motion implies cuts.
            moving_camera: motion.is_nan() || motion >= LITTLE_MOTION,
            margin,
            handedness: self.handedness,
            language: self.language,
            ..Options::default()
        }
    }

    /// Returns the adapter of the canvas, and statistics of its last image.
    pub(crate) fn picture_info(&self) -> Option<&raconteur_render::RenderInfo> {
        self.picture.as_ref().map(CanvasTarget::info)
    }
}

/// Converts a value to plain JavaScript values, like `JSON.parse`.
pub(crate) fn plain(value: &impl Serialize) -> Result<JsValue, JsError> {
    Ok(value.serialize(&Serializer::json_compatible())?)
}
