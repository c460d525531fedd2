/**
 * Branching of a story: pauses at questions, continuations after answers, skipped parts, and the record of answers. All branches lie one after another on the
 * timeline; the others are skipped.
 */

import type { Answered, Score } from '../base/answers.js';
import { newSeed } from './chance.js';
import { pointsOf } from './credit.js';
import { isOutcome, judge, type AnswerGrade } from './judge.js';
import { leftOut } from './pools.js';
import { type Span, united } from '../base/ranges.js';
import type { Part } from '../media/text-tracks.js';
import type { Question, FlowEntry } from '../base/questions.js';
import { type Value, Values } from './values.js';

/** Serialisable progress of a learner in a story. */
export interface LessonState {
  readonly answered: readonly Answered[];
  readonly values: { readonly [name: string]: Value };
  /** Assignments already performed, by their order in the story. */
  readonly done: readonly number[];
  /** Random seed of the learner, a 32-bit integer. */
  readonly seed: number;
  /** Furthest time reached by the learner, seconds. */
  readonly furthestSecs: number;
  /** Spans skipped by gotos. */
  readonly skipped: readonly Span[];
}

/** Next step of the story's time: continue, pause, or continue elsewhere after `fromSecs`. */
export type FlowTurn = { readonly kind: 'go' } | { readonly kind: 'rest'; readonly atSecs: number } | { readonly kind: 'leap'; readonly fromSecs: number; readonly toSecs: number };

/** Result of an answer. */
export interface TakenBranch {
  readonly question: Question;
  readonly answered: Answered;
  readonly turn: FlowTurn;
  /** True if the answer is final and no part of the story depends on it. */
  readonly isSilent: boolean;
}

/** Mark on the timeline of a story. */
type Mark =
  | FlowEntry
  | { readonly kind: 'ask'; readonly order: number; readonly within?: number; readonly atSecs: number; readonly endSecs: number; readonly question: Question }
  | { readonly kind: 'answer'; readonly order: number; readonly within?: number; readonly atSecs: number; readonly endSecs: number };

const GO: FlowTurn = { kind: 'go' };
/** Times of a story differ by less where they mean the same. */
const NEARLY_SECS = 1e-3;
/** First order number of questions outside the story, after all others. */
export const LIVE = 1e9;
/** Maximum number of entries read from each list of an external state. */
const MAX_DONE = 100_000;

/** Returns the marks in the order of the story. */
function marksOf(questions: readonly Question[], ways: readonly FlowEntry[]): readonly Mark[] {
  const asked = questions.flatMap((question): Mark[] => {
    const { order, within, atSecs, endSecs, answers } = question;
    const around = within === undefined ? {} : { within };
    return [
      { kind: 'ask', order, ...around, atSecs, endSecs, question },
      ...answers.map((answer): Mark => ({ kind: 'answer', order: answer.order, ...around, atSecs: answer.startSecs, endSecs: answer.endSecs })),
    ];
  });
  return [...ways, ...asked].sort((a, b) => a.order - b.order);
}

export class Lesson {
  #questions: readonly Question[] = [];
  #byName: ReadonlyMap<string, Question> = new Map();
  #marks: readonly Mark[] = [];
  /** Index of the next mark. */
  #next = 0;
  /** Answers and conditions whose clauses are skipped, by order. */
  readonly #closed = new Set<number>();
  readonly #answered = new Map<string, Answered>();
  readonly #values = new Values();
  readonly #done = new Set<number>();
  #seed = newSeed();
  #ways: readonly FlowEntry[] = [];
  /** Orders of the items not drawn from pools, with their contents. */
  #leftOut: ReadonlySet<number> = new Set();
  #furthestSecs = 0;
  /** Story time at the last step. */
  #stoodSecs = 0;
  readonly #skipped: Span[] = [];
  #asked: Question | undefined;
  /** Answer being performed, and the time at which the story continues after it. */
  #follows: { readonly order: number; readonly endSecs: number; readonly toSecs: number } | undefined;

  /** Sets the questions and branches of the text on stage; answers to questions of the same names are kept. */
  setStory(questions: readonly Question[], ways: readonly FlowEntry[]): void {
    this.#questions = questions;
    this.#byName = new Map(questions.map((question) => [question.name, question]));
    this.#ways = ways;
    this.#marks = marksOf(questions, ways);
    this.#draw();
    this.#asked = this.#follows = undefined;
    this.#next = 0;
    this.#closed.clear();
  }

  /** Random seed of this learner. */
  get seed(): number {
    return this.#seed;
  }

  #draw(): void {
    this.#leftOut = leftOut(this.#questions, this.#ways, this.#seed);
  }

  /** Returns true if a question may be asked of this learner: it is in no pool, or was drawn. */
  isDrawn({ order }: Question): boolean {
    return !this.#leftOut.has(order);
  }

  /** Updates the times of the text on stage, at the current time: voices may arrive during playback. An answer being performed continues. */
  retime(questions: readonly Question[], ways: readonly FlowEntry[], secs: number): void {
    const performed = this.#follows?.order;
    this.setStory(questions, ways);
    this.seek(secs);
    for (const { answers, endSecs: toSecs } of questions) {
      const answer = answers.find(({ order }) => order === performed);
      if (answer === undefined || secs < answer.startSecs - NEARLY_SECS || secs > answer.endSecs) continue;
      const { order, endSecs } = answer;
      this.#follows = { order, endSecs, toSecs };
      const next = this.#marks.findIndex((mark) => mark.order > order && mark.atSecs >= secs - NEARLY_SECS);
      this.#next = next < 0 ? this.#marks.length : next;
    }
  }

  /** Adds questions outside the story from a given time; earlier answers to the same name do not count. */
  add(questions: readonly Question[]): void {
    for (const question of questions) {
      this.#drop(({ name }) => name === question.name);
      this.#answered.delete(question.name);
      // Events that the story has at that time come first, and nothing follows automatically.
      const asked = { ...question, order: LIVE + this.#questions.length, endSecs: question.atSecs, answers: [] };
      this.#questions = [...this.#questions, asked];
      const later = this.#marks.findIndex(({ atSecs }, i) => i >= this.#next && atSecs > asked.atSecs);
      const at = later < 0 ? this.#marks.length : later;
      const { order, atSecs, endSecs } = asked;
      this.#marks = [...this.#marks.slice(0, at), { kind: 'ask', order, atSecs, endSecs, question: asked }, ...this.#marks.slice(at)];
    }
    this.#byName = new Map(this.#questions.map((question) => [question.name, question]));
  }

  /** Withdraws unanswered questions outside the story. */
  interrupt(): void {
    this.#drop(({ name, order }) => order >= LIVE && this.#answered.get(name)?.isFinal !== true);
    this.#byName = new Map(this.#questions.map((question) => [question.name, question]));
    if (this.#asked !== undefined && !this.#questions.includes(this.#asked)) this.#asked = undefined;
  }

  #drop(isDropped: (question: Question) => boolean): void {
    const isKept = (mark: Mark) => mark.kind !== 'ask' || !isDropped(mark.question);
    this.#next = this.#marks.slice(0, this.#next).filter(isKept).length;
    this.#marks = this.#marks.filter(isKept);
    this.#questions = this.#questions.filter((question) => !isDropped(question));
  }

  /** Clears the state of an unloaded story. */
  clear(): void {
    this.#seed = newSeed();
    this.setStory([], []);
    this.#answered.clear();
    this.#values.clear();
    this.#done.clear();
    this.#furthestSecs = 0;
    this.#skipped.length = 0;
  }

  /** Parts of the story, by time. */
  get parts(): readonly Part[] {
    return this.#marks.flatMap((mark) => (mark.kind === 'part' ? [{ name: mark.name, title: mark.title, startSecs: mark.atSecs, endSecs: mark.endSecs }] : []));
  }

  /** Spans not performed for everyone: answers, conditional parts, items not drawn, and spans that gotos skipped for this learner. */
  get optional(): readonly Span[] {
    const isOptional = ({ kind, order }: Mark) => kind === 'ask' || kind === 'if' || (kind === 'item' && this.#leftOut.has(order));
    const spans = this.#marks.filter(isOptional).map(({ atSecs, endSecs }): Span => [atSecs, endSecs]);
    return united([...spans, ...this.#skipped]);
  }

  /** Current question. */
  get asked(): Question | undefined {
    return this.#asked;
  }

  /** Answers, in the order of the questions. */
  get answered(): readonly Answered[] {
    return [...this.#byName.keys()].flatMap((name) => this.#answered.get(name) ?? []);
  }

  get score(): Score {
    const asked = [...this.#byName.values()].filter((question) => this.isDrawn(question));
    const points = asked.reduce((sum, { name }) => sum + (this.#answered.get(name)?.points ?? 0), 0);
    return { points, most: asked.reduce((sum, { points }) => sum + points, 0) };
  }

  /** Advances to a time reached by playback; returns the next step. */
  pass(secs: number): FlowTurn {
    const turn = this.#leave(secs) ?? this.#walk(secs);
    if (turn.kind === 'go') this.#furthestSecs = Math.max(this.#furthestSecs, secs);
    this.#stoodSecs = turn.kind === 'go' ? secs : turn.kind === 'rest' ? turn.atSecs : turn.toSecs;
    return turn;
  }

  /** Handles a seek to another time: the continuation of an answer is no longer performed. */
  seek(secs: number): void {
    this.#follows = this.#asked = undefined;
    this.#stoodSecs = secs;
    this.#closed.clear();
    // A seek does not pass the furthest position that the story's paths have reached; the rest is
    // traversed from there.
    const from = Math.min(secs, this.#furthestSecs);
    const next = this.#marks.findIndex(({ atSecs }) => atSecs >= from - NEARLY_SECS);
    this.#next = next < 0 ? this.#marks.length : next;
    // The seek target is inside this mark, so its conditions and answers are evaluated again.
    const around = this.#marks.findIndex((mark) => mark.kind !== 'part' && mark.atSecs < from - NEARLY_SECS && from < mark.endSecs - NEARLY_SECS);
    if (around >= 0 && around < this.#next) this.#next = around;
  }

  /** Takes an answer to the current question; undefined if there is none, or if the answer is invalid. */
  answer(given: readonly string[]): TakenBranch | undefined {
    const asked = this.#asked;
    const judgement = asked && judge(asked, given);
    if (asked === undefined || judgement === undefined) return undefined;
    const tries = (this.#answered.get(asked.name)?.tries ?? 0) + 1;
    return this.#take(asked, answeredOf(asked, judgement, tries));
  }

  /** Handles the end of the time limit of the current question. */
  expire(): TakenBranch | undefined {
    const asked = this.#asked;
    if (asked === undefined) return undefined;
    const tries = (this.#answered.get(asked.name)?.tries ?? 0) + 1;
    return this.#take(asked, { ...answeredOf(asked, unanswered(asked), tries), isFinal: true });
  }

  /** Returns the progress for `restore`, as data for `JSON.stringify`. */
  state(): LessonState {
    return {
      answered: [...this.#answered.values()],
      values: this.#values.all,
      done: [...this.#done],
      seed: this.#seed,
      furthestSecs: this.#furthestSecs,
      skipped: united(this.#skipped),
    };
  }

  /** Restores the output of `state`; entries that are not valid answers to a question on stage are dropped. */
  restore(state: unknown): void {
    const { answered, values, done, seed, furthestSecs, skipped } = (state ?? {}) as { [name in keyof LessonState]?: unknown };
    this.#answered.clear();
    this.#asked = this.#follows = undefined;
    for (const told of listOf(answered)) {
      const known = this.#known(told);
      if (known !== undefined) this.#answered.set(known.name, known);
    }
    if (isSeed(seed)) this.#seed = seed;
    this.#draw();
    this.#values.restore(values);
    this.#done.clear();
    for (const order of listOf(done).slice(0, MAX_DONE)) if (Number.isInteger(order)) this.#done.add(order as number);
    this.#furthestSecs = typeof furthestSecs === 'number' && furthestSecs >= 0 ? furthestSecs : 0;
    this.#skipped.splice(0, Infinity, ...listOf(skipped).slice(0, MAX_DONE).filter(isSpan));
    this.seek(0);
  }

  /**
   * Merges unknown entries of a state while the learner continues: answers to unanswered questions, assignments, and the furthest time. This may answer the
   * current question.
   */
  join(state: unknown, secs: number): void {
    const here = this.state();
    this.restore(state);
    for (const answered of here.answered) {
      const before = this.#answered.get(answered.name);
      if (before === undefined || before.points <= answered.points) this.#answered.set(answered.name, answered);
    }
    for (const order of here.done) this.#done.add(order);
    this.#values.restore({ ...this.#values.all, ...here.values });
    this.#furthestSecs = Math.max(this.#furthestSecs, here.furthestSecs);
    this.#skipped.push(...here.skipped);
    this.seek(secs);
  }

  #take(asked: Question, answered: Answered): TakenBranch {
    this.#answered.set(asked.name, answered);
    if (!answered.isFinal) return { question: asked, answered, turn: GO, isSilent: false };
    const { isRight, fits } = answered;
    const reaction = asked.answers.find(({ to }) => isOutcome(to, isRight) || fits.includes(to));
    return { question: asked, answered, turn: this.#react(asked, reaction), isSilent: reaction === undefined };
  }

  #react(asked: Question, reaction: Question['answers'][number] | undefined): FlowTurn {
    this.#asked = undefined;
    this.#next += 1;
    const toSecs = reaction?.startSecs ?? asked.endSecs;
    if (reaction !== undefined) this.#follows = { order: reaction.order, endSecs: reaction.endSecs, toSecs: asked.endSecs };
    return { kind: 'leap', fromSecs: asked.atSecs, toSecs };
  }

  /** Returns the turn at the end of the answer being performed. */
  #leave(secs: number): FlowTurn | undefined {
    const follows = this.#follows;
    if (follows === undefined) return undefined;
    // Marks within the answer come before its end.
    const turn = this.#walk(Math.min(secs, follows.endSecs));
    if (turn.kind !== 'go' || secs < follows.endSecs - NEARLY_SECS) return turn;
    this.#follows = undefined;
    if (secs >= follows.toSecs - NEARLY_SECS) return undefined;
    return { kind: 'leap', fromSecs: follows.endSecs, toSecs: follows.toSecs };
  }

  /** Processes the marks up to a time. */
  #walk(secs: number): FlowTurn {
    for (;;) {
      const at = this.#next;
      const mark = this.#marks[at];
      if (mark === undefined || mark.atSecs > secs + NEARLY_SECS) return GO;
      this.#next = at + 1;
      if (mark.within !== undefined && this.#closed.has(mark.within)) {
        this.#closed.add(mark.order);
        continue;
      }
      const turn = this.#meet(mark, secs);
      // The story returns to the question until it is answered.
      if (turn?.kind === 'rest') this.#next = at;
      if (turn !== undefined) return turn;
    }
  }

  /** Handles a mark; undefined if the story continues. */
  #meet(mark: Mark, secs: number): FlowTurn | undefined {
    switch (mark.kind) {
      case 'part':
      case 'pool':
        return undefined;
      case 'item': {
        const isDrawn = !this.#leftOut.has(mark.order);
        this.#open(mark, isDrawn);
        return isDrawn ? undefined : this.#over(mark, secs, mark.atSecs - 2 * NEARLY_SECS);
      }
      case 'set':
        if (!this.#done.has(mark.order)) this.#values.set(mark);
        this.#done.add(mark.order);
        return undefined;
      case 'if': {
        const holds = this.#values.holds(mark, { score: this.score, answered: (name) => this.#answered.get(name) });
        this.#open(mark, holds);
        // A mark exactly at the start of the path belongs to it.
        return holds ? undefined : this.#over(mark, secs, mark.atSecs - 2 * NEARLY_SECS);
      }
      case 'answer':
        this.#open(mark, this.#follows?.order === mark.order);
        return undefined;
      case 'ask':
        if (this.#answered.get(mark.question.name)?.isFinal !== true) {
          this.#asked = mark.question;
          return { kind: 'rest', atSecs: mark.atSecs };
        }
        return this.#over(mark, secs, mark.atSecs);
      case 'goto':
        return this.#go(mark, secs);
    }
  }

  /**
   * Returns the jump from a mark over its skipped part. If a step passed its end, the jump goes back to the end, so that nothing is missed. A position reached
   * by a seek is kept.
   */
  #over({ atSecs, endSecs }: Mark, secs: number, fromSecs: number): FlowTurn | undefined {
    const isStep = atSecs >= this.#stoodSecs - NEARLY_SECS && endSecs > atSecs + NEARLY_SECS;
    return isStep || secs < endSecs - NEARLY_SECS ? { kind: 'leap', fromSecs, toSecs: endSecs } : undefined;
  }

  #open({ order }: Mark, isOpen: boolean): void {
    if (isOpen) this.#closed.delete(order);
    else this.#closed.add(order);
  }

  /** Jumps to a part; undefined if it does not exist. */
  #go({ order, atSecs, to }: Mark & { readonly kind: 'goto' }, secs: number): FlowTurn | undefined {
    const place = this.#marks.findIndex((mark) => mark.kind === 'part' && mark.name === to);
    const part = this.#marks[place];
    if (part === undefined) return undefined;
    this.#follows = undefined;
    this.#closed.clear();
    this.#next = place;
    const isBack = part.order <= order;
    if (isBack) this.#forget(part.order, order);
    else this.#skipped.push([atSecs, part.atSecs]);
    // A story that jumped further has passed the part.
    return isBack || part.atSecs > secs + NEARLY_SECS ? { kind: 'leap', fromSecs: atSecs, toSecs: part.atSecs } : undefined;
  }

  /** Resets questions and assignments between two positions. */
  #forget(from: number, to: number): void {
    for (const { order, name } of this.#questions) if (order >= from && order <= to) this.#answered.delete(name);
    for (const order of this.#done) if (order >= from && order <= to) this.#done.delete(order);
  }

  /** Validates an answer of a state by judging it again, because external state is untrusted. An answer without its text is accepted. */
  #known(told: unknown): Answered | undefined {
    const { name, given, tries, isFinal } = (told ?? {}) as { [name in keyof Answered]?: unknown };
    const question = typeof name === 'string' ? this.#byName.get(name) : undefined;
    if (question === undefined || !(typeof tries === 'number' && tries >= 1)) return undefined;
    const count = Math.min(question.tries, Math.floor(tries));
    if (given === undefined) return this.#believed(question, told as Partial<Answered>, count);
    if (!Array.isArray(given)) return undefined;
    const known = answeredOf(question, judge(question, given.map(String)) ?? unanswered(question), count);
    const isOver = given.length === 0 && isFinal === true;
    return { ...known, isFinal: known.isFinal || isOver };
  }

  /** Accepts an answer whose text was omitted for lack of space, with its recorded points. */
  #believed({ name, points: most, tries: allowed, isUngraded = false }: Question, told: Partial<Answered>, tries: number): Answered {
    const isRight = told.isRight === true;
    const points = Math.max(0, Math.min(most, Number(told.points) || 0));
    const isFinal = told.isFinal === true || isRight || isUngraded || tries >= allowed;
    return { name, given: [], ...(isUngraded ? {} : { isRight }), fits: listOf(told.fits).map(String), points, tries, isFinal };
  }
}

/** Returns an answer with its points. An ungraded one is final immediately. */
function answeredOf(question: Question, judgement: AnswerGrade, tries: number): Answered {
  return { name: question.name, ...judgement, points: pointsOf(question, judgement), tries, isFinal: judgement.isRight !== false || tries >= question.tries };
}

/** Returns the judgement of a question without an answer. */
const unanswered = ({ isUngraded }: Question): AnswerGrade => ({ given: [], fits: [], ...(isUngraded === true ? {} : { isRight: false }) });

const isSeed = (data: unknown): data is number => typeof data === 'number' && Number.isInteger(data) && data >= 0 && data < 2 ** 32;

const isSpan = (data: unknown): data is Span =>
  Array.isArray(data) && data.length === 2 && data.every((secs) => typeof secs === 'number' && Number.isFinite(secs)) && data[0] <= data[1];

const listOf = (data: unknown): readonly unknown[] => (Array.isArray(data) ? (data as unknown[]) : []);
