//! Frame content at a time: body and face, joints, hair, light and camera.

use raconteur_actor::EvaluationReport;
use raconteur_base::{DAffine3, DVec3};
use raconteur_body::Bone;
use raconteur_eml as eml;
use raconteur_stage::{Camera, Frame, FramingMargin, Set, StageSet, aside_in, pupil};

use super::Player;
use crate::play::fibres;
use crate::play::shot_director::FramedFigure;

impl Player {
    /// Returns the frame of a time, for an image of `aspect` (width over height). Times outside the
    /// story show its start or end, unless it is open-ended; a time that is not a number shows the
    /// start.
    pub fn frame(&mut self, time_secs: f64, aspect: f64) -> &Frame {
        self.leave_welcome(self.clock.shown_secs(time_secs, self.end_secs()));
        self.evaluate(time_secs);
        self.frame.camera = self.camera(aspect);
        &self.frame
    }

    /// Returns the camera of the current frame, for an image of `aspect` (width over height).
    pub(crate) fn camera(&self, aspect: f64) -> Camera {
        let time_secs = self.frame.time_secs;
        // The figure's scripted position; the camera does not follow its sway.
        let moved = self.actors.actor().world_from_figure(time_secs);
        let stature_m = self.cast.figure.skeleton.stature_m();
        let subject = FramedFigure {
            floor_in_world: moved.map_or(DVec3::ZERO, |m| m.translation.with_y(0.0)),
            stature_m,
        };
        let aside = self.set().aside();
        // An offset figure has correspondingly less room on one side; few hands reach the edge of
        // the reserved space.
        let held = aspect - 0.5 * aside_in(aspect, aside).abs();
        let room = |rest| FramingMargin {
            aside,
            ..self.actors.margin_at(time_secs, rest, stature_m, held)
        };
        self.shots.camera(time_secs, aspect, &subject, room)
    }

    /// Evaluates in order: time, body and face, joints, audio, image.
    pub(super) fn evaluate(&mut self, time_secs: f64) -> EvaluationReport {
        let t = self.clock.shown_secs(time_secs, self.end_secs());
        self.frame.time_secs = t;
        let report = self.actors.evaluate(
            &self.cast.figure.skeleton,
            &self.cast.face,
            t,
            &mut self.pose,
            &mut self.frame.morph_weights,
        );
        if let Some(welcome) = &mut self.idle {
            let weights = &mut self.frame.morph_weights;
            welcome.blend(
                &self.cast.figure.skeleton,
                &self.cast.face,
                t,
                &mut self.pose,
                weights,
            );
        }
        self.cast
            .figure
            .skeleton
            .solve(&self.pose, &mut self.frame.world_from_joint);
        self.swing(t);
        if let (Some(tissue), Some(soft)) = (&self.cast.figure.tissue, &mut self.soft) {
            let controls = |t: f64| {
                let controls = self.actors.controls(t);
                let welcome = self.idle.as_ref();
                welcome.map_or(controls, |w| w.controls(t, &controls))
            };
            soft.advance_to(tissue, t, &controls, &mut self.frame.tissue);
        }
        self.frame.speech = self.speech_at(t);
        self.light(t);
        let arousal = self.actors.actor().arousal(t);
        self.frame.pupil_mm = pupil::diameter_mm(&self.frame.lighting, arousal, t);
        self.frame.visibility = self.shots.visibility(t);
        self.draw_tissue();
        self.frame.handles.clear();
        self.frame
            .handles
            .extend(report.limb_targets.into_iter().flatten());
        report
    }

    /// Simulates the hair for the frame's joints.
    fn swing(&mut self, time_secs: f64) {
        let Some(sway) = &mut self.swinging else {
            return;
        };
        let (figure, face) = (&self.cast.figure, &self.cast.face);
        let (layers, welcome, room) = (&mut self.actors, &mut self.idle, &mut self.scratch);
        let mut posture = |t: f64, out: &mut Vec<DAffine3>| {
            let (pose, weights) = (&mut room.pose, &mut room.morph_weights);
            layers.evaluate(&figure.skeleton, face, t, pose, weights);
            if let Some(welcome) = welcome {
                welcome.blend(&figure.skeleton, face, t, pose, weights);
            }
            figure.skeleton.solve(pose, out);
        };
        let of = (&figure.skeleton, &figure.springs);
        let joints = &mut self.frame.world_from_joint;
        sway.advance_to(of, time_secs, &mut posture, joints);
        let Some(welcome) = &mut self.idle else {
            return;
        };
        let (layers, room) = (&mut self.actors, &mut self.scratch);
        let mut story = |t: f64, out: &mut Vec<DAffine3>| {
            let (pose, weights) = (&mut room.pose, &mut room.morph_weights);
            layers.evaluate(&figure.skeleton, face, t, pose, weights);
            figure.skeleton.solve(pose, out);
        };
        welcome.blend_hair(of, time_secs, &mut story, joints);
    }

    /// Updates the lines of the face's tissue, if they are visible.
    pub(super) fn draw_tissue(&mut self) {
        self.frame.lines.clear();
        let shown = self.frame.visibility;
        if !(shown.springs || shown.muscles || shown.skull) {
            return;
        }
        let skull = Bone::Skull.index();
        let ends = (
            self.frame.world_from_joint.get(skull),
            self.cast.figure.inverse_bind.get(skull),
        );
        if let (Some(tissue), Some(soft), (Some(world), Some(bind))) =
            (&self.cast.figure.tissue, &self.soft, ends)
        {
            fibres::draw(
                shown,
                (tissue, soft.network()),
                &self.frame.tissue,
                *world * *bind,
                &mut self.frame.lines,
            );
        }
    }

    /// Returns the set of the story, or the one that overrides it.
    fn set(&self) -> Set {
        if let Some(set) = self.set_override {
            return Set::from_kind(set);
        }
        let environment = self.script.document.environment.as_ref();
        Set::from_kind(match environment.map(|e| e.set).unwrap_or_default() {
            eml::StageSet::Curtain => StageSet::Curtain,
            eml::StageSet::Fireside => StageSet::Fireside,
            eml::StageSet::Garden => StageSet::Garden,
            eml::StageSet::Night => StageSet::Night,
            eml::StageSet::School => StageSet::School,
        })
    }

    /// Recomputes the emotions, with their shots and lights.
    pub(super) fn direct(&mut self) {
        let library = &self.animations.library;
        self.emotions = self.scripts.feelings(library, self.end_secs());
        self.shots.rebuild(self.scripts.plans(), &self.emotions);
    }

    /// Lights the frame as it is at a story time.
    pub(super) fn light(&mut self, time_secs: f64) {
        let set = self.set();
        let lamps = self.lighting.unwrap_or_else(|| set.lighting());
        let light = self.shots.illumination(time_secs);
        self.frame.set = Set {
            // For users who prefer reduced motion, the set stands still.
            time_secs: if self.shots.moves() { time_secs } else { 0.0 },
            ..light.set(set)
        };
        self.frame.lighting = light.lamps(&lamps);
        let flicker = self.frame.set.flicker();
        for channel in &mut self.frame.lighting.rim.irradiance {
            *channel *= flicker;
        }
    }
}
