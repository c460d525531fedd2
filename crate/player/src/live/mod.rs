//! Live performance (GEVH 3.6): clauses that arrive while the story plays.
//!
//! A fragment is parsed, timed and lowered like a script, and joins the performance. Its times and
//! cues are on the story clock, so that seeking covers it until it is removed. All growth is
//! bounded: see [`limits`].

pub(crate) mod cut;
mod times;
pub(crate) mod wait;

use raconteur_actor::animation::PlayerCommand;
use raconteur_actor::{Actor, Library};
use raconteur_base::order::sort_by_number;
use raconteur_eml::{Diagnostic, Name, Parsed, RunUp, Severity, SortedMap, Span, parse_fragment};

use crate::lower::anchor::is_anchor;
use crate::lower::animations;
use crate::lower::cast::Cast;
use crate::lower::cues::{ClauseRef, Cue, CueKind, UtteranceCue};
use crate::lower::plan::{CarriedCommands, ScriptPlan};
use crate::lower::questions::QuestionCue;
use crate::lower::script::{Script, TimingSources};

/// Limits of a live performance. Beyond them, fragments are refused and the story continues.
pub mod limits {
    /// Maximum length of a live fragment, bytes: some 2,500 words.
    pub const FRAGMENT_BYTES: usize = 16 << 10;
    /// Maximum total length of all remembered fragments, bytes.
    pub const REMEMBERED_BYTES: usize = 64 << 10;
    /// Clauses of all fragments that are remembered, repetitions played out.
    pub const REMEMBERED_CLAUSES: usize = 1024;
    /// Finished fragments are remembered this long for seeking back, and for their names, but
    /// only while there is room; seconds.
    pub const REMEMBERED_SECS: f64 = 300.0;
    /// Commands to animation players, and as many to control parameters, that outlive their
    /// fragments; beyond, the oldest are lost.
    pub const CARRIED_COMMANDS: usize = 1024;
    /// Maximum lead of a fragment over the current time, seconds.
    pub const AHEAD_SECS: f64 = 3600.0;
    /// Number of fragments that a mind may send in a burst.
    pub const BURST: f64 = 20.0;
    /// Fragments a second of story time that it may send for long.
    pub const RATE_HZ: f64 = 10.0;
    /// Maximum number of minds (programs that send fragments) whose rates are counted separately.
    pub const MINDS: usize = 64;
}

/// Time after its last stroke at which an arm is down again, seconds: hold and retraction.
const SETTLE_SECS: f64 = 2.0;

/// Outcome of a live fragment: accepted clauses, utterances, questions and diagnostics; reported to
/// its sender.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FragmentOutcome {
    /// Number of the fragment, from 1; cues refer to it.
    pub fragment: u32,
    /// The `name` of its `eml` element, by which a mind may recognise it.
    pub name: Option<String>,
    /// The clauses that will be performed, by start; empty when the fragment was refused.
    pub clauses: Vec<LiveClause>,
    /// The utterances, by start.
    pub utterances: Vec<UtteranceCue>,
    /// The index of the first of [`FragmentOutcome::utterances`].
    pub first_utterance: usize,
    /// Questions, by time; the sender of the fragment performs the reactions to the answers.
    pub questions: Vec<QuestionCue>,
    /// Problems. An error has cost a clause, or the whole fragment.
    pub diagnostics: Vec<Diagnostic>,
    /// True if the message was `<interrupt/>` instead of a fragment.
    pub interrupts: bool,
    /// Story time at which `<interrupt/>` ended something, seconds; see
    /// [`crate::Player::interrupt`].
    pub cut_secs: Option<f64>,
}

/// Accepted clause of a live fragment, with its times.
#[derive(Clone, Debug, PartialEq)]
pub struct LiveClause {
    /// Identification of the clause.
    pub clause: ClauseRef,
    /// Start of the clause, story time, seconds.
    pub start_secs: f64,
    /// End of the clause, story time, seconds.
    pub end_secs: f64,
}

/// A fragment that is being performed, or is remembered.
struct Fragment {
    bytes: usize,
    clauses: usize,
    end_secs: f64,
    first_utterance: usize,
    marks: SortedMap<Name, f64>,
    plan: ScriptPlan,
    /// Time of the interruption: later markers never occur. Infinite if it was not interrupted.
    cut_secs: f64,
    /// True if none of its cues has been delivered: they may precede the delivery time of all
    /// others.
    fresh: bool,
}

/// Remaining send budget of a mind.
struct SendBudget {
    mind: u32,
    fragments: f64,
    at_secs: f64,
}

/// Incoming live fragment: its text, sender and time of arrival.
pub(crate) struct FragmentText<'a> {
    /// Index of the sending mind.
    pub(crate) mind: u32,
    pub(crate) text: &'a str,
    /// Story time of arrival, seconds.
    pub(crate) now_secs: f64,
    /// Story time from which its own times count, seconds.
    pub(crate) base_secs: f64,
}

/// Performance that a live fragment joins: figure, animations, script and current actor.
pub(crate) struct LiveContext<'a> {
    pub(crate) cast: &'a Cast,
    pub(crate) library: &'a Library,
    /// The story's script, for its bundle, its markers and its sets.
    pub(crate) script: &'a Script,
    pub(crate) story: &'a ScriptPlan,
    /// The actor before the fragment joins.
    pub(crate) actor: &'a Actor,
}

/// Live part of a performance: the fragments that have joined the story, and the budgets of their
/// senders.
pub(crate) struct LivePerformance {
    /// Fragments in order of arrival.
    fragments: Vec<Fragment>,
    fragments_begun: u32,
    utterances_begun: usize,
    allowances: Vec<SendBudget>,
    /// Commands of forgotten fragments that stay in force.
    carried: CarriedCommands,
    /// Cues to deliver next, whatever their time: clauses skipped by a seek, and ends of
    /// interrupted actions.
    due: Vec<Cue>,
}

impl LivePerformance {
    /// Creates a live performance; `utterances` is the number of the story's utterances.
    pub(crate) fn new(utterances: usize) -> Self {
        Self {
            fragments: Vec::new(),
            fragments_begun: 0,
            utterances_begun: utterances,
            allowances: Vec::new(),
            carried: CarriedCommands::default(),
            due: Vec::new(),
        }
    }

    /// Returns the plans of all fragments, in order of arrival.
    pub(crate) fn plans(&self) -> impl Iterator<Item = &ScriptPlan> + Clone {
        self.fragments.iter().map(|f| &f.plan)
    }

    /// Commands of forgotten fragments that stay in force.
    pub(crate) fn carried(&self) -> &CarriedCommands {
        &self.carried
    }

    /// Returns the end time of the last clause, story time; minus infinity if there is none.
    pub(crate) fn end_secs(&self) -> f64 {
        let ends = self.fragments.iter().map(|f| f.end_secs);
        ends.fold(f64::NEG_INFINITY, f64::max)
    }

    /// Returns the utterances of all remembered fragments, with their indices.
    pub(crate) fn utterances(&self) -> impl Iterator<Item = (usize, &UtteranceCue)> {
        self.fragments
            .iter()
            .flat_map(|f| (f.first_utterance..).zip(&f.plan.utterances))
    }

    /// Returns true if a mind may send at a time without exceeding its rate limit.
    pub(crate) fn has_room(&self, mind: u32, now_secs: f64) -> bool {
        let mut known = self.allowances.iter();
        known
            .find(|a| a.mind == mind)
            .is_none_or(|a| a.remaining(now_secs) >= 1.0)
    }

    /// Deducts one fragment from a mind's budget, if any is left.
    fn spend(&mut self, mind: u32, now_secs: f64) -> bool {
        let known = self.allowances.iter().position(|a| a.mind == mind);
        let mut allowance = match known {
            Some(i) => self.allowances.remove(i),
            None => SendBudget {
                mind,
                fragments: limits::BURST,
                at_secs: now_secs,
            },
        };
        allowance.fragments = allowance.remaining(now_secs);
        allowance.at_secs = now_secs;
        let may = allowance.fragments >= 1.0;
        allowance.fragments -= f64::from(u8::from(may));
        // The one that has been silent longest is the first to go.
        self.allowances.push(allowance);
        if self.allowances.len() > limits::MINDS {
            self.allowances.remove(0);
        }
        may
    }

    /// Admits a fragment to the performance.
    pub(crate) fn admit(
        &mut self,
        incoming: &FragmentText<'_>,
        scene: &LiveContext<'_>,
    ) -> FragmentOutcome {
        self.fragments_begun = self.fragments_begun.wrapping_add(1);
        let mut performed = FragmentOutcome {
            fragment: self.fragments_begun,
            first_utterance: self.utterances_begun,
            ..FragmentOutcome::default()
        };
        if let Err(refusal) = self.join(incoming, scene, &mut performed) {
            performed.clauses.clear();
            performed.utterances.clear();
            performed.questions.clear();
            performed.diagnostics.push(refusal);
        }
        performed
    }

    fn join(
        &mut self,
        incoming: &FragmentText<'_>,
        scene: &LiveContext<'_>,
        performed: &mut FragmentOutcome,
    ) -> Result<(), Diagnostic> {
        self.check_rate(incoming.mind, incoming.now_secs)?;
        check_length(incoming.text)?;
        let mut parsed = parse_fragment(incoming.text);
        performed.name = parsed.document.name.clone();
        let most = limits::REMEMBERED_CLAUSES as u64 + 1;
        let played = times::played_out(&parsed.document, most) as usize;
        self.evict(incoming.text.len(), played, incoming.now_secs)?;
        self.bind(&mut parsed, incoming.base_secs, scene);
        let script = self.timed_script(parsed, incoming.base_secs, scene, performed);
        let lead_in_secs = script.timeline.lead_in_secs - incoming.base_secs;
        let end_secs = script.timeline.duration_secs;
        if lead_in_secs.max(end_secs - incoming.now_secs) > limits::AHEAD_SECS {
            let message = "a fragment reaches at most an hour ahead";
            return Err(refusal("live::too-far", message));
        }
        performed.clauses = accepted_clauses(&script);
        if performed.clauses.is_empty() {
            let mut diagnostics = performed.diagnostics.iter();
            return if diagnostics.any(|d| d.severity == Severity::Error) {
                Ok(())
            } else {
                let message = "this fragment has no clauses";
                Err(refusal("live::empty", message))
            };
        }
        let first_utterance = self.utterances_begun;
        let number = Some(performed.fragment);
        let plan = ScriptPlan::new(&script, scene.cast, first_utterance, number);
        self.utterances_begun += plan.utterances.len();
        performed.utterances.clone_from(&plan.utterances);
        performed.questions = script.questions();
        self.fragments.push(Fragment {
            bytes: incoming.text.len(),
            clauses: played.max(1),
            end_secs,
            first_utterance,
            marks: script.timeline.marks,
            plan,
            cut_secs: f64::INFINITY,
            fresh: true,
        });
        Ok(())
    }

    /// Rejects fragments that exceed the rate limit.
    fn check_rate(&mut self, mind: u32, now_secs: f64) -> Result<(), Diagnostic> {
        if !self.spend(mind, now_secs) {
            let message = "too many simultaneous fragments; this one was not read";
            return Err(refusal("live::busy", message).hint("send fewer a second"));
        }
        Ok(())
    }

    /// Resolves the names that a fragment takes from the story and from earlier fragments. The
    /// performer is the story's, and so is the language used for lip animation.
    fn bind(&self, parsed: &mut Parsed, base_secs: f64, scene: &LiveContext<'_>) {
        let late = times::bind(&mut parsed.document, base_secs, |name| {
            let story = &scene.script.timeline.marks;
            self.mark(name).or_else(|| story.get(name).copied())
        });
        parsed.diagnostics.extend(late);
        if parsed.document.sets.is_empty() {
            parsed.document.sets.clone_from(&scene.script.document.sets);
        }
        if parsed.document.performer.is_none() {
            let performer = &scene.script.document.performer;
            parsed.document.performer.clone_from(performer);
        }
    }

    /// Schedules a fragment on the story's clock, late enough for its hands and for others' speech
    /// to end, and reports its problems.
    fn timed_script(
        &self,
        parsed: Parsed,
        base_secs: f64,
        scene: &LiveContext<'_>,
        performed: &mut FragmentOutcome,
    ) -> Script {
        let bundle = &scene.script.bundle;
        let sources = TimingSources {
            bundle: bundle.clone(),
            library: scene.library,
        };
        let mut script = Script::resolve(parsed, sources, bundle.is_some());
        script.page_language = scene.script.page_language;
        script.repertoire = scene.script.repertoire;
        let diagnostics = &mut performed.diagnostics;
        diagnostics.append(&mut script.diagnostics);
        diagnostics.extend(scene.cast.problems(&script.document));
        script.delay(base_secs);
        let at_once = ScriptPlan::new(&script, scene.cast, 0, None);
        let said = self.fragments.iter().flat_map(|f| &f.plan.utterances);
        let said = scene.story.utterances.iter().chain(said);
        let run_up_secs = wait::run_up(&at_once, scene.actor, base_secs);
        let run_up = script.document.run_up.unwrap_or_default();
        let waits_secs = if run_up == RunUp::Delay {
            run_up_secs
        } else {
            0.0
        };
        script.delay(wait::turn(&at_once.utterances, said, waits_secs));
        match run_up {
            RunUp::Delay => script.waits_secs = run_up_secs,
            RunUp::Late => script.hands_from_secs = wait::hands_from(&at_once, run_up_secs),
            RunUp::Snap => {}
        }
        if run_up != RunUp::Delay {
            diagnostics.extend(script.report_progress());
        }
        diagnostics.extend(animations::problems(
            &script.document,
            &script.timeline,
            Some(self.players_before(&scene.story.players)),
        ));
        script
    }

    /// Commands to animation players before a fragment joins.
    fn players_before(&self, story: &[(f64, PlayerCommand)]) -> Vec<(f64, PlayerCommand)> {
        let carried = self.carried.players.iter().chain(story);
        let live = self.fragments.iter().flat_map(|f| &f.plan.players);
        carried.chain(live).cloned().collect()
    }

    /// Returns the story time of a name in the stored fragments; of several, the most recent.
    fn mark(&self, name: &str) -> Option<f64> {
        let mut fragments = self.fragments.iter().rev();
        fragments.find_map(|f| f.marks.get(name).copied().filter(|at| *at <= f.cut_secs))
    }

    /// Removes fragments that ended long ago, and as many other ended ones as necessary.
    fn evict(&mut self, bytes: usize, clauses: usize, now_secs: f64) -> Result<(), Diagnostic> {
        let over = |f: &Fragment, secs: f64| f.end_secs + SETTLE_SECS + secs < now_secs;
        while let Some(old) = self
            .fragments
            .iter()
            .position(|f| over(f, limits::REMEMBERED_SECS))
        {
            self.forget(old);
        }
        loop {
            let sum = |of: fn(&Fragment) -> usize| self.fragments.iter().map(of).sum::<usize>();
            if bytes + sum(|f| f.bytes) <= limits::REMEMBERED_BYTES
                && clauses + sum(|f| f.clauses) <= limits::REMEMBERED_CLAUSES
            {
                return Ok(());
            }
            let Some(oldest) = self.fragments.iter().position(|f| over(f, 0.0)) else {
                let message = "no more clauses fit before some have finished";
                return Err(refusal("live::full", message));
            };
            self.forget(oldest);
        }
    }

    /// Removes a fragment and keeps the commands and places of referents that stay in force.
    fn forget(&mut self, index: usize) {
        let forgotten = self.fragments.remove(index);
        let parameters = &mut self.carried.parameters;
        parameters.extend(forgotten.plan.face.parameters);
        sort_by_number(parameters, |(time_secs, _)| *time_secs);
        let surplus = parameters.len().saturating_sub(limits::CARRIED_COMMANDS);
        parameters.drain(..surplus);
        self.carried.add_places(forgotten.plan.discourse.places);
        self.carried.add_postures(forgotten.plan.postures);
        let players = &mut self.carried.players;
        players.extend(forgotten.plan.players);
        sort_by_number(players, |(time_secs, _)| *time_secs);
        // Commands before the removal of all players have no effect any more.
        let last = players.iter().rposition(|(_, command)| {
            matches!(
                command,
                PlayerCommand::Clear
                    | PlayerCommand::Add {
                        exclusive: true,
                        ..
                    }
            )
        });
        let surplus = players.len().saturating_sub(limits::CARRIED_COMMANDS);
        let (keep, mut place) = (last.unwrap_or(0).max(surplus), 0);
        players.retain(|(_, command)| {
            place += 1;
            let lasting = matches!(command, PlayerCommand::Configure { .. });
            place > keep || (lasting && place > surplus)
        });
    }

    /// Returns the cues after `from_secs` up to and including `to_secs`, sorted by time within each
    /// fragment, preceded by those of skipped clauses.
    pub(crate) fn take_cues(&mut self, from_secs: f64, to_secs: f64) -> Vec<Cue> {
        let mut cues = std::mem::take(&mut self.due);
        for fragment in &mut self.fragments {
            let fresh = std::mem::take(&mut fragment.fresh);
            let from_secs = if fresh { f64::NEG_INFINITY } else { from_secs };
            cues.extend_from_slice(between(&fragment.plan.cues, from_secs, to_secs));
        }
        cues
    }

    /// Notes the clauses that a move from one time to a later one passes over.
    pub(crate) fn skip(&mut self, from_secs: f64, to_secs: f64) {
        for fragment in &mut self.fragments {
            fragment.fresh = false;
            for cue in between(&fragment.plan.cues, from_secs, to_secs) {
                if self.due.len() >= limits::REMEMBERED_CLAUSES {
                    return;
                }
                if let CueKind::ClauseEnd(clause) = &cue.kind {
                    self.due.push(Cue {
                        time_secs: to_secs,
                        kind: CueKind::ClauseSkipped(clause.clone()),
                        ..*cue
                    });
                }
            }
        }
    }
}

impl SendBudget {
    /// Returns the remaining budget at a time. A clock that went back adds nothing.
    fn remaining(&self, now_secs: f64) -> f64 {
        let since_secs = (now_secs - self.at_secs).max(0.0);
        (self.fragments + since_secs * limits::RATE_HZ).min(limits::BURST)
    }
}

/// Returns the cues after one time up to and including another; empty when time runs backwards.
pub(crate) fn between(cues: &[Cue], from_secs: f64, to_secs: f64) -> &[Cue] {
    let first = cues.partition_point(|c| c.time_secs <= from_secs);
    let last = cues.partition_point(|c| c.time_secs <= to_secs);
    cues.get(first..last).unwrap_or_default()
}

/// Returns the accepted clauses of a fragment, sorted by start.
fn accepted_clauses(script: &Script) -> Vec<LiveClause> {
    let clauses = script.timeline.clauses.iter();
    clauses
        .filter(|c| !is_anchor(script.document.clause(c.clause)))
        .map(|timed| LiveClause {
            clause: ClauseRef::from_clause(timed.clause, script.document.clause(timed.clause)),
            start_secs: timed.start_secs,
            end_secs: timed.end_secs,
        })
        .collect()
}

/// Rejects overlong text.
fn check_length(text: &str) -> Result<(), Diagnostic> {
    if text.len() > limits::FRAGMENT_BYTES {
        let message = format!("a fragment has at most {} bytes", limits::FRAGMENT_BYTES);
        return Err(refusal("live::too-large", message));
    }
    Ok(())
}

fn refusal(code: &'static str, message: impl Into<String>) -> Diagnostic {
    Diagnostic::error(code, Span::default(), message)
}
