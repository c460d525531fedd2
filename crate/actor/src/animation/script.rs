//! Commands of a script to animation players (GEVH 3.2), as plain data with their times.

use super::groups::BoneSet;
use super::playback::Playback;

/// Kind of an animation player: defines its tracks and how they are combined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlayerKind {
    /// The weighted mean of a number of layers (GEVH 3.2.1).
    Multiple(usize),
    /// One track for each default body group (GEVH 3.2.2).
    BodyGroup,
    /// Two stances, tracks 0 and 1, and a blend: the weight of track 1 (GEVH 3.2.3). A clip is
    /// frozen at its beginning.
    Pose,
}

/// Property of a track that a script can change over time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Property {
    /// Playback speed, 1 as recorded; negative ones play backwards.
    Speed,
    /// Weight in the mean; for a body group, its coverage of the layers below, 0 to 1.
    Weight,
    /// Enables the track if not 0.
    Enable,
}

/// Operation on the stack of animations of a track; the top animation plays.
#[derive(Clone, Debug, PartialEq)]
pub enum Operation {
    /// Puts an animation, by name, on top.
    Push(String, Playback),
    /// Replaces the topmost animation by the named one.
    Exchange(String, Playback),
    /// Removes the topmost animation.
    Pop,
    /// Removes all animations.
    Clear,
}

/// Reference to a track of an animation player, by body group or by layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrackRef {
    /// A body group, by its index in [`super::BODY_GROUPS`].
    Group(usize),
    /// A layer, from 0.
    Layer(usize),
}

/// Tracks of an animation player that a command addresses; `None` means all.
pub type Tracks = Option<Vec<TrackRef>>;

/// Command of a script to the animation players. Without a player name it addresses the unnamed
/// player, otherwise the first one.
#[derive(Clone, Debug, PartialEq)]
pub enum PlayerCommand {
    /// Sets the transitions between animations from here on; `None` keeps a setting.
    Configure {
        /// True to cross-fade animations; false to change within [`super::AT_ONCE_SECS`].
        smooth: Option<bool>,
        /// Length of a cross-fade, seconds.
        swap_secs: Option<f64>,
    },
    /// Adds a player; with `exclusive`, it replaces all others.
    Add {
        /// Name of the player, empty for the unnamed one. It replaces an existing player of the
        /// same name.
        name: String,
        /// Method by which it combines its tracks.
        kind: PlayerKind,
        /// Bones that it moves.
        bones: BoneSet,
        /// True to remove all other players.
        exclusive: bool,
    },
    /// Changes the priority, 0 at first: of two players the one with the higher priority, or
    /// else the later one, moves a bone.
    ChangePriority {
        /// Name of the player.
        player: Option<String>,
        /// The new one.
        priority: i32,
    },
    /// Removes a player.
    Remove {
        /// Name of the player.
        player: Option<String>,
    },
    /// Removes all players.
    Clear,
    /// Sets a property of tracks.
    Set {
        /// Name of the player.
        player: Option<String>,
        /// Addressed tracks.
        tracks: Tracks,
        /// Property to set.
        property: Property,
        /// New value of the property.
        value: f64,
        /// Transition time, seconds.
        duration_secs: f64,
    },
    /// Operates on the stacks of tracks.
    Operate {
        /// Name of the player.
        player: Option<String>,
        /// Addressed tracks.
        tracks: Tracks,
        /// Stack operation.
        operation: Operation,
    },
}

/// All commands of a script to the animation players with their times, in any order. Simultaneous
/// commands apply in list order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlayerScript {
    /// Story time in seconds, and the command.
    pub commands: Vec<(f64, PlayerCommand)>,
}

/// Report of a command that has no effect, or a smaller one than requested, with the reason.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CommandProblem {
    /// Index of the command in [`PlayerScript::commands`].
    pub command: usize,
    /// Kind of the problem.
    pub kind: CommandProblemKind,
}

/// Reason why a command to an animation player fails: unknown player, track or clip.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CommandProblemKind {
    /// No player of this name, or none at all, exists at the time.
    NoPlayer(Option<String>),
    /// The player has no such track.
    NoTrack(TrackRef),
    /// The library has no animation of this name.
    NoClip(String),
}
