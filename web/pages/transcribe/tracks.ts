/** Tracks of a transcription: their annotations as spans of time, whatever these consist of. */

import { isSame, type Item, type Layer, type Run, type Timed, type Transcription } from './types.js';

/** Annotation on the time axis. */
export interface Span {
  readonly item: Item;
  readonly start: number;
  readonly end: number;
  /** Text in the span. */
  readonly label: string;
  /** Class of its colour. */
  readonly look: string;
}

export interface Track {
  readonly id: string;
  readonly name: string;
  readonly spans: readonly Span[];
}

/** Kind of a track, and its layer. */
export function kindOf(track: string): { kind: string; layer: number } {
  const [kind = '', layer = '0'] = track.split('.');
  return { kind, layer: Number(layer) };
}

/** Track over whose annotations those of another one run. */
const PARTS: Readonly<Record<string, string>> = { utterances: 'words', levels: 'utterances', phrases: 'phases' };

/** Returns the track over which a track runs; undefined if its annotations have times. */
function partsOf(track: string): string | undefined {
  const { kind, layer } = kindOf(track);
  const parts = PARTS[kind];
  return parts === 'phases' ? `${parts}.${layer}` : parts;
}

type Annotation = Timed | Run;

/** Returns the annotations of a track. */
export function annotationsOf(transcription: Transcription, track: string): Annotation[] {
  const { kind, layer } = kindOf(track);
  switch (kind) {
    case 'words':
    case 'utterances':
    case 'levels':
    case 'gestures':
      return transcription[kind];
    case 'phases':
    case 'phrases':
      return transcription.layers[layer]?.[kind] ?? [];
    default:
      return [];
  }
}

/** Returns an annotation. */
export function annotationAt(transcription: Transcription, item: Item): Annotation | undefined {
  return annotationsOf(transcription, item.track)[item.index];
}

/** Returns the timed annotation at which an annotation starts or ends. */
export function timedAt(transcription: Transcription, item: Item, side: 'start' | 'end'): Item {
  const parts = partsOf(item.track);
  const run = annotationAt(transcription, item) as Run | undefined;
  if (parts === undefined || run === undefined) return item;
  return timedAt(transcription, { track: parts, index: side === 'start' ? run.first : run.last }, side);
}

/** Returns the time of a side of an annotation; undefined if it does not exist. */
export function timeOf(transcription: Transcription, item: Item, side: 'start' | 'end'): number | undefined {
  return (annotationAt(transcription, timedAt(transcription, item, side)) as Timed | undefined)?.[side];
}

/** Returns all tracks, in the order of GestuRA's passes. */
export function tracksOf(transcription: Transcription): Track[] {
  const { words, utterances, levels, gestures, layers } = transcription;
  const track = <A extends Annotation>(id: string, name: string, annotations: readonly A[], about: (a: A) => { label: string; look: string }): Track => ({
    id,
    name,
    spans: annotations.map((annotation, index) => {
      const item = { track: id, index };
      const start = timeOf(transcription, item, 'start') ?? 0;
      return { item, start, end: Math.max(start, timeOf(transcription, item, 'end') ?? start), ...about(annotation) };
    }),
  });
  const said = (first: number, last: number): string =>
    words
      .slice(first, last + 1)
      .map(({ token }) => token)
      .join(' ');
  const ofLayer = (layer: Layer, index: number): Track[] => [
    track(`phases.${index}`, `Phases, ${layer.name}`, layer.phases, ({ kind }) => ({ label: kind, look: `phase ${lookOf(kind)}` })),
    track(`phrases.${index}`, `Phrases, ${layer.name}`, layer.phrases, ({ dimension, handedness }) => ({
      label: [dimension ?? 'no dimension', handedness].filter(Boolean).join(', '),
      look: 'phrase',
    })),
  ];
  return [
    track('words', 'Words', words, ({ token }) => ({ label: token, look: 'word' })),
    track('utterances', 'Utterances', utterances, ({ text, first, last }) => ({ label: text === '' ? said(first, last) : text, look: 'utterance' })),
    track('levels', 'Discourse', levels, ({ level }) => ({ label: level, look: 'level' })),
    track('gestures', 'Gestures', gestures, ({ class: kind, animation }) => ({ label: animation === undefined ? kind : `${kind}, ${animation}`, look: 'gesture' })),
    ...layers.flatMap(ofLayer),
  ];
}

/** Returns the class of a phase's colour. */
function lookOf(kind: string): string {
  if (kind.endsWith('hold')) return 'hold';
  return kind === 'partial-retraction' ? 'retraction' : kind;
}

/** Returns the end of the last annotation. */
export function endOf(tracks: readonly Track[]): number {
  return tracks.reduce((end, { spans }) => spans.reduce((at, span) => Math.max(at, span.end), end), 0);
}

/** Returns the span of an annotation. */
export function spanOf(tracks: readonly Track[], item: Item | undefined): Span | undefined {
  if (item === undefined) return undefined;
  return tracks.find(({ id }) => id === item.track)?.spans[item.index];
}

/** Returns the annotation that an arrow key reaches from another: in its track, or the nearest one in the track before or after. */
export function neighbour(tracks: readonly Track[], item: Item, key: string): Item | undefined {
  const at = tracks.findIndex(({ id }) => id === item.track);
  const spans = tracks[at]?.spans ?? [];
  const along = { ArrowLeft: item.index - 1, ArrowRight: item.index + 1, Home: 0, End: spans.length - 1 }[key];
  if (along !== undefined) return spans[along]?.item;
  const step = { ArrowUp: -1, ArrowDown: 1 }[key];
  const from = spans[item.index];
  if (step === undefined || from === undefined) return undefined;
  let row = at + step;
  while (tracks[row]?.spans.length === 0) row += step;
  return nearest(tracks[row]?.spans ?? [], (from.start + from.end) / 2);
}

/** Returns the annotation at a time, or the nearest one. */
export function nearest(spans: readonly Span[], secs: number): Item | undefined {
  const far = ({ start, end }: Span): number => Math.max(0, start - secs, secs - end);
  return spans.reduce<Span | undefined>((best, span) => (best === undefined || far(span) < far(best) ? span : best), undefined)?.item;
}

/**
 * Returns the spans of a track that are in view, with the selected one, which keeps the focus. Of spans shorter than `least` seconds that begin within this
 * time, one stands for all.
 */
export function inView(spans: readonly Span[], from: number, to: number, least: number, kept: Item | undefined): Span[] {
  let last = -Infinity;
  return spans.filter(({ item, start, end }) => {
    const isShown = end >= from && start <= to && (end - start >= least || start - last >= least);
    if (isShown) last = start;
    return isShown || isSame(item, kept);
  });
}
