//! What a script asks of animation players (GEVH 3.2): plain commands at their times.

use super::groups::BoneSet;
use super::playback::Playback;

/// Method by which a player combines its tracks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlayerKind {
    /// The weighted mean of a number of layers (GEVH 3.2.1).
    Multiple(usize),
    /// One animation for each body group (GEVH 3.2.2).
    BodyGroup,
    /// Two stances, tracks 0 and 1, and a blend: the weight of track 1 (GEVH 3.2.3). A clip is
    /// frozen at its beginning.
    Pose,
}

/// A property of a track.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Property {
    /// Playback speed, 1 as recorded; negative ones play backwards.
    Speed,
    /// Weight in the mean; for a body group, its coverage of the layers below, 0 to 1.
    Weight,
    /// Enables the track if not 0.
    Enable,
}

/// An operation on the stacks of tracks.
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

/// A track of a player.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrackRef {
    /// A body group, by its index in [`super::BODY_GROUPS`].
    Group(usize),
    /// A layer, from 0.
    Layer(usize),
}

/// Some tracks of a player; `None` means all.
pub type Tracks = Option<Vec<TrackRef>>;

/// A command of a script to the animation players. Without a name it addresses the player added
/// without a name, else the first one.
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
        /// Its name, empty for the one without. A player of the same name is replaced.
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
        /// Its new value.
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

/// All commands of a script to animation players, in any order. Of two commands at one time the
/// later in the list is applied later.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlayerScript {
    /// Story time in seconds, and the command.
    pub commands: Vec<(f64, PlayerCommand)>,
}

/// Reason why a command has no effect, or less than requested.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CommandProblem {
    /// Its index in [`PlayerScript::commands`].
    pub command: usize,
    /// Kind of the problem.
    pub kind: CommandProblemKind,
}

/// Kind of problem with a command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CommandProblemKind {
    /// No player of this name, or none at all, exists at the time.
    NoPlayer(Option<String>),
    /// The player has no such track.
    NoTrack(TrackRef),
    /// The library has no animation of this name.
    NoClip(String),
}
