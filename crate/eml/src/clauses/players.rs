//! Animation players and their animations (GEVH 3.2, D.3.5, D.3.6, D.3.11 to D.3.18).

use super::sets::Member;
use crate::record::{record, words};

words! {
    /// Kind of animation player.
    PlayerKind {
        /// Keyframe animations in layers.
        Multiple = "multiple",
        /// One animation for each body group, such as head or left arm.
        BodyGroup = "bodyGroup",
        /// Poses (GEVH 3.2.3).
        Pose = "pose",
    }
}

record! {
    /// The tracks that a clause is for (GEVH D.3.7).
    Tracks = "tracks" {}
    children {
        /// Sets, body groups and layers.
        members: Vec<Member>
    }
}

record! {
    /// The bones that a player moves (GEVH D.3.13).
    Bones = "bones" {}
    children {
        /// Sets, body groups and bones.
        members: Vec<Member>
    }
}

record! {
    /// Adds an animation player (GEVH D.3.11).
    PlayerAdd = "body-player-add" {
        /// Name; none: the first player.
        name: Option<String> = "name",
        /// Kind of player.
        kind: PlayerKind = "type",
        /// Number of layers; only for [`PlayerKind::Multiple`].
        layers: Option<u32> = "numberOfLayers",
    }
    children {
        /// Bones that it moves; none: all.
        bones: Option<Bones>
    }
}

record! {
    /// Replaces all animation players by one (GEVH D.3.12).
    PlayerSetExclusive = "body-player-set-exclusive" {
        /// Name; none: the first player.
        name: Option<String> = "name",
        /// Kind of player.
        kind: PlayerKind = "type",
        /// Number of layers; only for [`PlayerKind::Multiple`].
        layers: Option<u32> = "numberOfLayers",
    }
    children {
        /// Bones that it moves; none: all.
        bones: Option<Bones>
    }
}

record! {
    /// Changes the priority of an animation player (GEVH D.3.14).
    PlayerChangePriority = "body-player-change-priority" {
        /// Player; none: the first one.
        name: Option<String> = "name",
        /// The new priority; the player with the highest moves a bone.
        priority: i32 = "priority",
    }
}

record! {
    /// Removes an animation player (GEVH D.3.15).
    PlayerRemove = "body-player-remove" {
        /// Player; none: the first one.
        name: Option<String> = "name",
    }
}

record! {
    /// Configures the transitions of keyframe animations (GEVH D.3.5).
    DeterministicAnimation = "body-configure-deterministic-animation" {
        /// Enables cross-fades of animations; none: unchanged.
        smooth: Option<bool> = "smooth",
        /// Length of a cross-fade in seconds; none: unchanged.
        swap_secs: Option<f64> = "swapTime",
    }
}

words! {
    /// A property of tracks.
    TrackProperty {
        /// Playback speed, 1 as recorded.
        Speed = "speed",
        /// Weight in the blend.
        Weight = "weight",
        /// Enables the track: 0 or 1.
        Enable = "enable",
    }
}

words! {
    /// Transition of a property to its new value.
    Transition {
        /// Constant rate of change.
        Linear = "linear",
    }
}

record! {
    /// Sets a property of tracks (GEVH D.3.6).
    DeterministicTrackProperty = "body-configure-deterministic-track-property" {
        /// Property to set.
        property: TrackProperty = "property",
        /// New value of the property; 0 or 1 for [`TrackProperty::Enable`].
        new_value: f64 = "newValue",
        /// Player; none: the first one.
        player: Option<String> = "player",
        /// Length of the transition in seconds.
        duration_secs: f64 = "duration",
        /// Interpolation of the property during the transition.
        transition: Transition = "transition",
    }
    children {
        /// The tracks; there is one list.
        tracks: Option<Tracks>
    }
}

words! {
    /// Operation on the stack of animations.
    PrimitiveKind {
        /// Pushes an animation onto it.
        Push = "push",
        /// The topmost animation is exchanged for another.
        Exchange = "exchange",
        /// Removes the topmost animation.
        Pop = "pop",
        /// Removes all animations.
        Clear = "clearAnimationStack",
    }
}

words! {
    /// Playback mode of an animation (GEVH D.3.18).
    PlaybackStyle {
        /// Repeats forwards without end.
        Loop = "loop",
        /// Repeats backwards without end.
        LoopReverse = "loopReverse",
        /// Forwards and backwards in turn.
        PingPong = "pingPong",
        /// A number of times.
        Iterations = "iterations",
        /// A number of times backwards.
        IterationsReverse = "iterationsReverse",
        /// A number of times, then it leaves the stack.
        TemporaryIterations = "temporaryIterations",
        /// A number of times backwards, then it leaves the stack.
        TemporaryIterationsReverse = "temporaryIterationsReverse",
    }
}

record! {
    /// Playback style of an animation (GEVH D.3.18).
    AnimationStyle = "animation-style" {
        /// Playback mode.
        style: PlaybackStyle = "playbackStyle",
        /// Number of passes, for the modes that end (extension).
        iterations: u32 = "iterations",
    }
}

/// Clause that changes the stack of animations on tracks of a player (GEVH D.3.17).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DeterministicPrimitive {
    /// Operation on the player's stack of animations: push, exchange, pop or clear (GEVH D.3.17).
    pub primitive: PrimitiveKind,
    /// Player; none: the first one.
    pub player: Option<String>,
    /// The animation, for push and exchange.
    pub animation: Option<String>,
    /// Tracks that the operation affects; `None` means all.
    pub tracks: Option<Tracks>,
    /// Playback style; none: in a loop.
    pub style: Option<AnimationStyle>,
}

impl DeterministicPrimitive {
    /// Returns the playing time of the pushed animation, seconds, at its recorded speed; `length`
    /// gives the length of one pass. Endless playback has length 0.
    pub(crate) fn length_secs(&self, length: impl Fn(&str) -> Option<f64>) -> f64 {
        let puts = matches!(
            self.primitive,
            PrimitiveKind::Push | PrimitiveKind::Exchange
        );
        let (Some(name), Some(style), true) = (&self.animation, &self.style, puts) else {
            return 0.0;
        };
        match style.style {
            PlaybackStyle::Loop | PlaybackStyle::LoopReverse | PlaybackStyle::PingPong => 0.0,
            _ => length(name)
                .filter(|secs| (0.0..=3600.0).contains(secs))
                .map_or(0.0, |secs| secs * f64::from(style.iterations.max(1))),
        }
    }
}

impl crate::record::Record for DeterministicPrimitive {
    fn element(&self) -> &'static str {
        "body-deterministic-primitive"
    }

    fn visit(&mut self, visitor: &mut dyn crate::record::Visit) {
        visitor.field("primitive", &mut self.primitive);
        visitor.field("player", &mut self.player);
        visitor.field("animationSetName", &mut self.animation);
        visitor.children(&mut self.tracks);
        visitor.children(&mut self.style);
    }
}
