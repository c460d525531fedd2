/**
 * The ways through a story: where it rests until somebody has answered, what follows from an answer, what is passed over, and what
 * was answered. All of it lies one after another in the story's time; what is not meant is leapt over.
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

/** What a learner has done in a story, as data. */
export interface LessonState {
  readonly answered: readonly Answered[];
  readonly values: { readonly [name: string]: Value };
  /** What was set and is not set again, by its place in the story. */
  readonly done: readonly number[];
  /** What is by chance for the learner follows from it: a whole number of 32 bits. */
  readonly seed: number;
  /** How far the learner has come, seconds. */
  readonly furthestSecs: number;
  /** What gotos have led over. */
  readonly skipped: readonly Span[];
}

/** What is to become of the story's time: it goes on, rests, or goes on elsewhere after `fromSecs`. */
export type FlowTurn = { readonly kind: 'go' } | { readonly kind: 'rest'; readonly atSecs: number } | { readonly kind: 'leap'; readonly fromSecs: number; readonly toSecs: number };

/** What became of an answer. */
export interface TakenBranch {
  readonly question: Question;
  readonly answered: Answered;
  readonly turn: FlowTurn;
  /** It is answered for good, and nothing of the story follows from it. */
  readonly isSilent: boolean;
}

/** Something that a story comes to. */
type Mark =
  | FlowEntry
  | { readonly kind: 'ask'; readonly order: number; readonly within?: number; readonly atSecs: number; readonly endSecs: number; readonly question: Question }
  | { readonly kind: 'answer'; readonly order: number; readonly within?: number; readonly atSecs: number; readonly endSecs: number };

const GO: FlowTurn = { kind: 'go' };
/** Times of a story differ by less where they mean the same. */
const NEARLY_SECS = 1e-3;
/** The places of what is not in the story, after all that is. */
export const LIVE = 1e9;
/** More of a state from outside is not read. */
const MAX_DONE = 100_000;

/** Marks in the order in which a story comes to them. */
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
  /** The next mark that the story comes to. */
  #next = 0;
  /** Answers and conditions whose clauses are passed over, by their places. */
  readonly #closed = new Set<number>();
  readonly #answered = new Map<string, Answered>();
  readonly #values = new Values();
  readonly #done = new Set<number>();
  #seed = newSeed();
  #ways: readonly FlowEntry[] = [];
  /** The places of what is not drawn of pools, with all in it. */
  #leftOut: ReadonlySet<number> = new Set();
  #furthestSecs = 0;
  /** Where the story stood at the last step. */
  #stoodSecs = 0;
  readonly #skipped: Span[] = [];
  #asked: Question | undefined;
  /** The answer that is performed, and where the story goes on after it. */
  #follows: { readonly order: number; readonly endSecs: number; readonly toSecs: number } | undefined;

  /** The questions and ways of the text on stage; what was answered to those of the same names stays. */
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

  /** What is by chance for this learner. */
  get seed(): number {
    return this.#seed;
  }

  #draw(): void {
    this.#leftOut = leftOut(this.#questions, this.#ways, this.#seed);
  }

  /** Whether a question may be asked of this learner: it is in no pool, or was drawn. */
  isDrawn({ order }: Question): boolean {
    return !this.#leftOut.has(order);
  }

  /** The text on stage has other times, at this one: voices come while it is told. An answer that is performed goes on. */
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

  /** Asks what was not in the story, from a time on; what was answered to one of its name does not count. */
  add(questions: readonly Question[]): void {
    for (const question of questions) {
      this.#drop(({ name }) => name === question.name);
      this.#answered.delete(question.name);
      // What the story has at that time comes before, and nothing follows by itself.
      const asked = { ...question, order: LIVE + this.#questions.length, endSecs: question.atSecs, answers: [] };
      this.#questions = [...this.#questions, asked];
      const later = this.#marks.findIndex(({ atSecs }, i) => i >= this.#next && atSecs > asked.atSecs);
      const at = later < 0 ? this.#marks.length : later;
      const { order, atSecs, endSecs } = asked;
      this.#marks = [...this.#marks.slice(0, at), { kind: 'ask', order, atSecs, endSecs, question: asked }, ...this.#marks.slice(at)];
    }
    this.#byName = new Map(this.#questions.map((question) => [question.name, question]));
  }

  /** What is not in the story and is not answered is not asked any more. */
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

  /** Nothing is left of a story that goes. */
  clear(): void {
    this.#seed = newSeed();
    this.setStory([], []);
    this.#answered.clear();
    this.#values.clear();
    this.#done.clear();
    this.#furthestSecs = 0;
    this.#skipped.length = 0;
  }

  /** The parts of the story, by time. */
  get parts(): readonly Part[] {
    return this.#marks.flatMap((mark) => (mark.kind === 'part' ? [{ name: mark.name, title: mark.title, startSecs: mark.atSecs, endSecs: mark.endSecs }] : []));
  }

  /** What not everybody comes to: answers, what has a condition, what is not drawn, and what gotos have led this learner over. */
  get optional(): readonly Span[] {
    const isOptional = ({ kind, order }: Mark) => kind === 'ask' || kind === 'if' || (kind === 'item' && this.#leftOut.has(order));
    const spans = this.#marks.filter(isOptional).map(({ atSecs, endSecs }): Span => [atSecs, endSecs]);
    return united([...spans, ...this.#skipped]);
  }

  /** What is asked now. */
  get asked(): Question | undefined {
    return this.#asked;
  }

  /** What was answered, by the questions' order. */
  get answered(): readonly Answered[] {
    return [...this.#byName.keys()].flatMap((name) => this.#answered.get(name) ?? []);
  }

  get score(): Score {
    const asked = [...this.#byName.values()].filter((question) => this.isDrawn(question));
    const points = asked.reduce((sum, { name }) => sum + (this.#answered.get(name)?.points ?? 0), 0);
    return { points, most: asked.reduce((sum, { points }) => sum + points, 0) };
  }

  /** The story has come to a time by itself: whether it may go on. */
  pass(secs: number): FlowTurn {
    const turn = this.#leave(secs) ?? this.#walk(secs);
    if (turn.kind === 'go') this.#furthestSecs = Math.max(this.#furthestSecs, secs);
    this.#stoodSecs = turn.kind === 'go' ? secs : turn.kind === 'rest' ? turn.atSecs : turn.toSecs;
    return turn;
  }

  /** The story was brought to another time: what follows from an answer is not told any more. */
  seek(secs: number): void {
    this.#follows = this.#asked = undefined;
    this.#stoodSecs = secs;
    this.#closed.clear();
    // Nobody comes further than by the ways of the story: from there on it is walked through.
    const from = Math.min(secs, this.#furthestSecs);
    const next = this.#marks.findIndex(({ atSecs }) => atSecs >= from - NEARLY_SECS);
    this.#next = next < 0 ? this.#marks.length : next;
    // What the story has come into: conditions and answers are looked at again.
    const around = this.#marks.findIndex((mark) => mark.kind !== 'part' && mark.atSecs < from - NEARLY_SECS && from < mark.endSecs - NEARLY_SECS);
    if (around >= 0 && around < this.#next) this.#next = around;
  }

  /** Takes an answer to what is asked; undefined where nothing is, or where it is none. */
  answer(given: readonly string[]): TakenBranch | undefined {
    const asked = this.#asked;
    const judgement = asked && judge(asked, given);
    if (asked === undefined || judgement === undefined) return undefined;
    const tries = (this.#answered.get(asked.name)?.tries ?? 0) + 1;
    return this.#take(asked, answeredOf(asked, judgement, tries));
  }

  /** The time for what is asked is over. */
  expire(): TakenBranch | undefined {
    const asked = this.#asked;
    if (asked === undefined) return undefined;
    const tries = (this.#answered.get(asked.name)?.tries ?? 0) + 1;
    return this.#take(asked, { ...answeredOf(asked, unanswered(asked), tries), isFinal: true });
  }

  /** What was done, to be given back to `restore`: data that `JSON.stringify` writes. */
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

  /** Takes what `state` gave, whatever has become of it in between: what is no answer to a question on stage is left out. */
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
   * Adds what a state has that is not known here, where the learner goes on: answers to what was not answered as well, what was set,
   * and how far they came. What is asked now may be answered by that.
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

  /** Where the answer that is performed is over. */
  #leave(secs: number): FlowTurn | undefined {
    const follows = this.#follows;
    if (follows === undefined) return undefined;
    // What is on the way within the answer comes before its end.
    const turn = this.#walk(Math.min(secs, follows.endSecs));
    if (turn.kind !== 'go' || secs < follows.endSecs - NEARLY_SECS) return turn;
    this.#follows = undefined;
    if (secs >= follows.toSecs - NEARLY_SECS) return undefined;
    return { kind: 'leap', fromSecs: follows.endSecs, toSecs: follows.toSecs };
  }

  /** Goes through the marks up to a time. */
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
      // It is come to again, until it is answered.
      if (turn?.kind === 'rest') this.#next = at;
      if (turn !== undefined) return turn;
    }
  }

  /** The story comes to a mark; undefined where it goes on. */
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
        // What stands exactly at its beginning is its own.
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
   * The way from a mark to behind it. A step of the story may be longer than what is passed over: then it goes back to its end, so that
   * nothing of it is told. Whoever has sought further stays there.
   */
  #over({ atSecs, endSecs }: Mark, secs: number, fromSecs: number): FlowTurn | undefined {
    const isStep = atSecs >= this.#stoodSecs - NEARLY_SECS && endSecs > atSecs + NEARLY_SECS;
    return isStep || secs < endSecs - NEARLY_SECS ? { kind: 'leap', fromSecs, toSecs: endSecs } : undefined;
  }

  #open({ order }: Mark, isOpen: boolean): void {
    if (isOpen) this.#closed.delete(order);
    else this.#closed.add(order);
  }

  /** Goes on at a part; undefined where there is none. */
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
    // Who was brought further has come past the part.
    return isBack || part.atSecs > secs + NEARLY_SECS ? { kind: 'leap', fromSecs: atSecs, toSecs: part.atSecs } : undefined;
  }

  /** What was asked and set from one place to another is asked and set anew. */
  #forget(from: number, to: number): void {
    for (const { order, name } of this.#questions) if (order >= from && order <= to) this.#answered.delete(name);
    for (const order of this.#done) if (order >= from && order <= to) this.#done.delete(order);
  }

  /** An answer of a state, judged anew: what comes from outside may claim too much. One whose text was left out is believed. */
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

  /** An answer without its text, which somebody had no room for: what it was worth is what is told. */
  #believed({ name, points: most, tries: allowed, isUngraded = false }: Question, told: Partial<Answered>, tries: number): Answered {
    const isRight = told.isRight === true;
    const points = Math.max(0, Math.min(most, Number(told.points) || 0));
    const isFinal = told.isFinal === true || isRight || isUngraded || tries >= allowed;
    return { name, given: [], ...(isUngraded ? {} : { isRight }), fits: listOf(told.fits).map(String), points, tries, isFinal };
  }
}

/** An answer and what it is worth. What is not graded is taken at once. */
function answeredOf(question: Question, judgement: AnswerGrade, tries: number): Answered {
  return { name: question.name, ...judgement, points: pointsOf(question, judgement), tries, isFinal: judgement.isRight !== false || tries >= question.tries };
}

/** What it is where nothing was answered. */
const unanswered = ({ isUngraded }: Question): AnswerGrade => ({ given: [], fits: [], ...(isUngraded === true ? {} : { isRight: false }) });

const isSeed = (data: unknown): data is number => typeof data === 'number' && Number.isInteger(data) && data >= 0 && data < 2 ** 32;

const isSpan = (data: unknown): data is Span =>
  Array.isArray(data) && data.length === 2 && data.every((secs) => typeof secs === 'number' && Number.isFinite(secs)) && data[0] <= data[1];

const listOf = (data: unknown): readonly unknown[] => (Array.isArray(data) ? (data as unknown[]) : []);
