//! Schedule of the commands: the players, the animations of each track and their transitions.

use raconteur_base::order::sort_by_number;

use super::groups::{BODY_GROUPS, BoneSet};
use super::piecewise_linear::PiecewiseLinear;
use super::playback::Playback;
use super::script::{
    CommandProblem, CommandProblemKind, Operation, PlayerCommand, PlayerKind, PlayerScript,
    Property, TrackRef, Tracks,
};

/// Default length of a cross-fade, seconds. Designed: as quick as one step.
const SWAP_SECS: f64 = 0.4;
/// Length of an immediate change (`smooth='false'`), seconds. GEVH means no transition at all, but
/// a body has inertia. Designed: about five film frames look immediate, and no joint jumps.
pub const AT_ONCE_SECS: f64 = 0.08;
/// Longest cross-fade, seconds.
const MAX_SWAP_SECS: f64 = 60.0;

/// Value that is active from a start time on and fades in over `fade_secs`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Interval<T> {
    pub(crate) from_secs: f64,
    pub(crate) fade_secs: f64,
    pub(crate) value: T,
}

/// Values over time, each active from its start on; sorted by start time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Intervals<T>(Vec<Interval<T>>);

impl<T> Intervals<T> {
    fn new() -> Self {
        Self(Vec::new())
    }

    /// Activates a value from a time on. Of several at one time the last counts. A value set at the
    /// start of the story counts as active before it.
    fn push(&mut self, from_secs: f64, fade_secs: f64, what: T) {
        if self.0.last().is_some_and(|s| s.from_secs >= from_secs) {
            self.0.pop();
        }
        let fade_secs = if from_secs <= 0.0 { 0.0 } else { fade_secs };
        self.0.push(Interval {
            from_secs,
            fade_secs,
            value: what,
        });
    }

    /// Returns the intervals that have begun by a time, latest first.
    pub(crate) fn started_by(&self, t: f64) -> impl Iterator<Item = &Interval<T>> {
        let n = self.0.partition_point(|s| s.from_secs <= t);
        self.0[..n].iter().rev()
    }
}

/// Animation at the top of a track's stack: the clip, its start time and its playback mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PlayingClip {
    /// Index of its clip.
    pub(crate) clip: usize,
    /// Integral of the track's speed when the clip was put on.
    pub(crate) start_secs: f64,
    pub(crate) style: Playback,
}

/// Track of an animation player over the whole story: its bones, speed, weight, enabled state and
/// the clips on its stack.
#[derive(Clone, Debug)]
pub(crate) struct Track {
    pub(crate) bones: BoneSet,
    pub(crate) speed: PiecewiseLinear,
    pub(crate) weight: PiecewiseLinear,
    /// 0 off, 1 on.
    pub(crate) on: PiecewiseLinear,
    /// The top of the stack.
    pub(crate) top: Intervals<Option<PlayingClip>>,
    operations: Vec<(f64, f64, ResolvedOperation)>,
}

/// An operation with its clip found.
#[derive(Clone, Copy, Debug)]
enum ResolvedOperation {
    Push(usize, Playback),
    Exchange(usize, Playback),
    Pop,
    Clear,
}

/// Animation player over the whole story: its kind and its tracks.
#[derive(Clone, Debug)]
pub(crate) struct PlayerPlan {
    pub(crate) kind: PlayerKind,
    pub(crate) tracks: Vec<Track>,
}

/// Resolved commands of all animation players: players, their order of priority and the clips they
/// use.
#[derive(Clone, Debug)]
pub(crate) struct Schedule {
    pub(crate) players: Vec<PlayerPlan>,
    /// The players that are there, the one that wins last.
    pub(crate) orders: Intervals<Vec<usize>>,
    /// Names of the clips that are played.
    pub(crate) clips: Vec<String>,
}

/// A player that is there while commands are read.
struct ActivePlayer {
    name: String,
    priority: i32,
    player: usize,
}

struct Reader<'a> {
    out: Schedule,
    present: Vec<ActivePlayer>,
    smooth: bool,
    swap_secs: f64,
    problems: Vec<CommandProblem>,
    exists: &'a dyn Fn(&str) -> bool,
}

impl Schedule {
    /// Reads a script. `exists` returns true for known clips, `length` the length of a clip.
    pub(crate) fn new(
        script: &PlayerScript,
        exists: &dyn Fn(&str) -> bool,
        length: &dyn Fn(&str) -> f64,
    ) -> (Self, Vec<CommandProblem>) {
        let mut commands: Vec<(usize, f64, &PlayerCommand)> = script
            .commands
            .iter()
            .enumerate()
            .filter(|(_, (t, _))| t.is_finite())
            .map(|(i, (t, command))| (i, *t, command))
            .collect();
        sort_by_number(&mut commands, |c| c.1);
        let mut reader = Reader {
            out: Self {
                players: Vec::new(),
                orders: Intervals::new(),
                clips: Vec::new(),
            },
            present: Vec::new(),
            smooth: true,
            swap_secs: SWAP_SECS,
            problems: Vec::new(),
            exists,
        };
        for (index, t, command) in commands {
            if let Err(kind) = reader.command(t, command) {
                reader.problems.push(CommandProblem {
                    command: index,
                    kind,
                });
            }
        }
        let mut out = reader.out;
        for track in out.players.iter_mut().flat_map(|p| &mut p.tracks) {
            track.play(&|clip| length(&out.clips[clip]));
        }
        (out, reader.problems)
    }
}

impl Reader<'_> {
    fn fade_secs(&self) -> f64 {
        if self.smooth {
            self.swap_secs
        } else {
            AT_ONCE_SECS
        }
    }

    fn command(&mut self, t: f64, command: &PlayerCommand) -> Result<(), CommandProblemKind> {
        match command {
            PlayerCommand::Configure { smooth, swap_secs } => {
                self.smooth = smooth.unwrap_or(self.smooth);
                if let Some(secs) = swap_secs.filter(|s| s.is_finite()) {
                    // `AT_ONCE_SECS` limits the fastest change.
                    self.swap_secs = secs.clamp(AT_ONCE_SECS, MAX_SWAP_SECS);
                }
            }
            PlayerCommand::Add {
                name,
                kind,
                bones,
                exclusive,
            } => {
                self.present.retain(|p| !exclusive && p.name != *name);
                self.present.push(ActivePlayer {
                    name: name.clone(),
                    priority: 0,
                    player: self.out.players.len(),
                });
                self.out.players.push(PlayerPlan::new(*kind, *bones));
                self.reorder(t);
            }
            PlayerCommand::ChangePriority { player, priority } => {
                let i = self.find(player)?;
                self.present[i].priority = *priority;
                self.reorder(t);
            }
            PlayerCommand::Remove { player } => {
                let i = self.find(player)?;
                self.present.remove(i);
                self.reorder(t);
            }
            PlayerCommand::Clear => {
                self.present.clear();
                self.reorder(t);
            }
            PlayerCommand::Set {
                player,
                tracks,
                property,
                value,
                duration_secs,
            } => {
                let fade_secs = self.fade_secs();
                let (plan, tracks, lost) = self.tracks(player, tracks)?;
                let length_secs = duration_secs.clamp(0.0, 1e9);
                plan.set(t, &tracks, *property, *value, [length_secs, fade_secs]);
                lost?;
            }
            PlayerCommand::Operate {
                player,
                tracks,
                operation,
            } => {
                // A missing player is reported before a missing animation.
                let (_, _, lost) = self.tracks(player, tracks)?;
                let operation = match operation {
                    _ if lost.is_err() && tracks.as_ref().is_some_and(|t| t.len() == 1) => {
                        return lost;
                    }
                    Operation::Push(name, style) => {
                        ResolvedOperation::Push(self.clip(name)?, *style)
                    }
                    Operation::Exchange(name, style) => {
                        ResolvedOperation::Exchange(self.clip(name)?, *style)
                    }
                    Operation::Pop => ResolvedOperation::Pop,
                    Operation::Clear => ResolvedOperation::Clear,
                };
                let fade_secs = self.fade_secs();
                let (plan, tracks, lost) = self.tracks(player, tracks)?;
                for track in tracks {
                    let track = &mut plan.tracks[track];
                    track.operations.push((t, fade_secs, operation));
                }
                lost?;
            }
        }
        Ok(())
    }

    /// Finds a player by name; without a name, the unnamed player, or the first that was added.
    fn find(&self, name: &Option<String>) -> Result<usize, CommandProblemKind> {
        let found = match name {
            Some(name) => self.present.iter().position(|p| p.name == *name),
            None => {
                let unnamed = self.present.iter().position(|p| p.name.is_empty());
                unnamed.or((!self.present.is_empty()).then_some(0))
            }
        };
        found.ok_or_else(|| CommandProblemKind::NoPlayer(name.clone()))
    }

    /// Returns the addressed tracks of a player, and true if one of them does not exist.
    #[allow(clippy::type_complexity, reason = "three results of one search")]
    fn tracks(
        &mut self,
        player: &Option<String>,
        tracks: &Tracks,
    ) -> Result<(&mut PlayerPlan, Vec<usize>, Result<(), CommandProblemKind>), CommandProblemKind>
    {
        let player = self.present[self.find(player)?].player;
        let plan = &mut self.out.players[player];
        let meant: Vec<usize> = match tracks {
            None => (0..plan.tracks.len()).collect(),
            Some(list) => list.iter().filter_map(|track| plan.index(*track)).collect(),
        };
        let mut named = tracks.iter().flatten();
        let lost = named.find(|track| plan.index(**track).is_none());
        let lost = lost.map_or(Ok(()), |i| Err(CommandProblemKind::NoTrack(*i)));
        Ok((plan, meant, lost))
    }

    fn clip(&mut self, name: &str) -> Result<usize, CommandProblemKind> {
        if !(self.exists)(name) {
            return Err(CommandProblemKind::NoClip(name.to_owned()));
        }
        let clips = &mut self.out.clips;
        let known = clips.iter().position(|c| c == name);
        Ok(known.unwrap_or_else(|| {
            clips.push(name.to_owned());
            clips.len() - 1
        }))
    }

    fn reorder(&mut self, t: f64) {
        let mut order: Vec<(i32, usize)> = self
            .present
            .iter()
            .map(|p| (p.priority, p.player))
            .collect();
        // Stable: of equals the later one is above.
        sort_by_number(&mut order, |p| f64::from(p.0));
        let order = order.into_iter().map(|p| p.1).collect();
        let fade_secs = self.fade_secs();
        self.out.orders.push(t, fade_secs, order);
    }
}

impl PlayerPlan {
    fn new(kind: PlayerKind, bones: BoneSet) -> Self {
        let track = |bones: BoneSet, weight: f64| Track {
            bones,
            speed: PiecewiseLinear::constant(1.0),
            weight: PiecewiseLinear::constant(weight),
            on: PiecewiseLinear::constant(1.0),
            top: Intervals::new(),
            operations: Vec::new(),
        };
        let tracks = match kind {
            PlayerKind::Multiple(n) => {
                let n = n.clamp(1, 64);
                (0..n).map(|_| track(bones, 1.0 / n as f64)).collect()
            }
            PlayerKind::BodyGroup => BODY_GROUPS
                .iter()
                .map(|(_, group)| track(group.and(bones), 1.0))
                .collect(),
            PlayerKind::Pose => vec![track(bones, 1.0), track(bones, 0.0)],
        };
        Self { kind, tracks }
    }

    /// Returns the index of an addressed track.
    fn index(&self, track: TrackRef) -> Option<usize> {
        let by_group = self.kind == PlayerKind::BodyGroup;
        let i = match track {
            TrackRef::Group(i) if by_group => i,
            TrackRef::Layer(i) if !by_group => i,
            _ => return None,
        };
        (i < self.tracks.len()).then_some(i)
    }

    /// Sets a property of some tracks from a time on: the transition time for weights and speeds,
    /// or a switch.
    fn set(
        &mut self,
        t: f64,
        tracks: &[usize],
        property: Property,
        value: f64,
        [length_secs, fade_secs]: [f64; 2],
    ) {
        let value = if value.is_finite() { value } else { 0.0 };
        match property {
            Property::Speed => {
                for &i in tracks {
                    self.tracks[i]
                        .speed
                        .set(t, value.clamp(-100.0, 100.0), length_secs);
                }
            }
            Property::Enable => {
                for &i in tracks {
                    let on = if value == 0.0 { 0.0 } else { 1.0 };
                    self.tracks[i].on.set(t, on, fade_secs);
                }
            }
            Property::Weight => self.weigh(t, tracks, value, length_secs.max(AT_ONCE_SECS)),
        }
    }

    /// Gives some tracks a weight, and the others the remainder, in proportion. The weights of
    /// layers sum to 1 at every time, since all move linearly to their new values (GEVH 3.2.1).
    fn weigh(&mut self, t: f64, tracks: &[usize], value: f64, length_secs: f64) {
        let value = value.clamp(0.0, 1.0);
        if self.kind == PlayerKind::BodyGroup {
            for &i in tracks {
                self.tracks[i].weight.set(t, value, length_secs);
            }
            return;
        }
        let mut meant = vec![false; self.tracks.len()];
        tracks.iter().for_each(|i| meant[*i] = true);
        let own = meant.iter().filter(|m| **m).count() as f64;
        let others = self.tracks.len() as f64 - own;
        if own == 0.0 {
            return;
        }
        let each = if others == 0.0 {
            1.0 / own
        } else {
            value.min(1.0 / own)
        };
        let left = 1.0 - own * each;
        let now = |track: &Track| track.weight.sample(t);
        let unmeant = self.tracks.iter().zip(&meant).filter(|(_, m)| !**m);
        let sum: f64 = unmeant.map(|(track, _)| now(track)).sum();
        for (track, meant) in self.tracks.iter_mut().zip(meant) {
            let to = if meant {
                each
            } else if sum > 1e-9 {
                left * now(track) / sum
            } else {
                left / others
            };
            track.weight.set(t, to, length_secs);
        }
    }
}

/// An animation on a stack with its expiry time.
struct StackEntry {
    playing: PlayingClip,
    until_secs: f64,
    /// Fade-out duration, seconds.
    fade_secs: f64,
}

impl Track {
    /// Plays the operations through.
    fn play(&mut self, length: &dyn Fn(usize) -> f64) {
        let mut stack: Vec<StackEntry> = Vec::new();
        for (t, fade_secs, operation) in std::mem::take(&mut self.operations) {
            self.expire(&mut stack, t);
            let entry = |clip: usize, style: Playback| {
                let begun = self.speed.integral(t);
                let passes = style.iterations().filter(|_| style.is_temporary());
                let until = passes.and_then(|n| {
                    let total = f64::from(n) * length(clip);
                    self.speed.time_of_integral(t, begun + total)
                });
                StackEntry {
                    playing: PlayingClip {
                        clip,
                        start_secs: begun,
                        style,
                    },
                    until_secs: until.unwrap_or(f64::INFINITY),
                    fade_secs,
                }
            };
            match operation {
                ResolvedOperation::Push(clip, style) => stack.push(entry(clip, style)),
                ResolvedOperation::Exchange(clip, style) => {
                    stack.pop();
                    stack.push(entry(clip, style));
                }
                ResolvedOperation::Pop => {
                    stack.pop();
                }
                ResolvedOperation::Clear => stack.clear(),
            }
            self.show(&stack, t, fade_secs);
        }
        self.expire(&mut stack, f64::INFINITY);
    }

    /// Removes the entries that expire by a time.
    fn expire(&mut self, stack: &mut Vec<StackEntry>, t: f64) {
        loop {
            let mut next = (f64::INFINITY, SWAP_SECS);
            for entry in stack.iter() {
                if entry.until_secs < next.0 {
                    next = (entry.until_secs, entry.fade_secs);
                }
            }
            let (next, fade_secs) = next;
            if next > t || next.is_infinite() {
                return;
            }
            stack.retain(|e| e.until_secs > next);
            self.show(stack, next, fade_secs);
        }
    }

    fn show(&mut self, stack: &[StackEntry], t: f64, fade_secs: f64) {
        let top = stack.last().map(|e| e.playing);
        let same = self.top.0.last().is_some_and(|s| s.value == top);
        if !same {
            self.top.push(t, fade_secs, top);
        }
    }
}
