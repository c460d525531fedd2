//! What a script asks of animation players (GEVH 3.2): plain commands at their times.

use super::groups::BoneSet;
use super::playback::Playback;

/// How a player combines its tracks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlayerKind {
    /// The weighted mean of so many layers (GEVH 3.2.1).
    Multiple(usize),
    /// One animation for each body group (GEVH 3.2.2).
    BodyGroup,
    /// Two stances, tracks 0 and 1, and a blend: the weight of track 1 (GEVH 3.2.3). A clip
    /// stands still at its beginning.
    Pose,
}

/// A property of a track.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Property {
    /// Playback speed, 1 as recorded; negative ones play backwards.
    Speed,
    /// Weight in the mean; of a body group, how much it covers the layers below, 0 to 1.
    Weight,
    /// Whether the track is on: not 0.
    Enable,
}

/// An operation on the stacks of tracks.
#[derive(Clone, Debug, PartialEq)]
pub enum Operation {
    /// Puts an animation, by name, on top.
    Push(String, Playback),
    /// Puts an animation, by name, in the place of the topmost one.
    Exchange(String, Playback),
    /// Takes the topmost animation off.
    Pop,
    /// Takes all off.
    Clear,
}

/// A track of a player.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrackRef {
    /// A body group, by its place in [`super::BODY_GROUPS`].
    Group(usize),
    /// A layer, from 0.
    Layer(usize),
}

/// Some tracks of a player; `None` are all.
pub type Tracks = Option<Vec<TrackRef>>;

/// What a script asks. Without a name the player is meant that was added without one, else the
/// first one that is there.
#[derive(Clone, Debug, PartialEq)]
pub enum PlayerCommand {
    /// How animations pass into each other from now on; `None` keeps a setting.
    Configure {
        /// Whether they cross-fade, or change within [`super::AT_ONCE_SECS`].
        smooth: Option<bool>,
        /// Length of a cross-fade, seconds.
        swap_secs: Option<f64>,
    },
    /// Adds a player; with `exclusive`, in the place of all others.
    Add {
        /// Its name, empty for the one without. A player of the same name is replaced.
        name: String,
        /// What it combines.
        kind: PlayerKind,
        /// What it moves.
        bones: BoneSet,
        /// Whether all others go.
        exclusive: bool,
    },
    /// Changes the priority, 0 at first: of two players the one with the higher priority, or
    /// else the later one, moves a bone.
    ChangePriority {
        /// Which.
        player: Option<String>,
        /// The new one.
        priority: i32,
    },
    /// Removes a player.
    Remove {
        /// Which.
        player: Option<String>,
    },
    /// Removes all players.
    Clear,
    /// Sets a property of tracks.
    Set {
        /// Whose.
        player: Option<String>,
        /// Which tracks.
        tracks: Tracks,
        /// Which property.
        property: Property,
        /// Its new value.
        value: f64,
        /// How long it takes to get there, seconds.
        duration_secs: f64,
    },
    /// Operates on the stacks of tracks.
    Operate {
        /// Whose.
        player: Option<String>,
        /// Which tracks.
        tracks: Tracks,
        /// What.
        operation: Operation,
    },
}

/// All that a script asks of animation players, in any order; of two commands at one time
/// the later in the list comes later.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlayerScript {
    /// Story time in seconds, and the command.
    pub commands: Vec<(f64, PlayerCommand)>,
}

/// Why a command does nothing, or less than it says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CommandProblem {
    /// Its index in [`PlayerScript::commands`].
    pub command: usize,
    /// What is wrong.
    pub kind: CommandProblemKind,
}

/// What is wrong with a command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CommandProblemKind {
    /// There is no player of this name, or none at all, at the time.
    NoPlayer(Option<String>),
    /// The player has no such track.
    NoTrack(TrackRef),
    /// The library has no animation of this name.
    NoClip(String),
}
