/**
 * Events of media elements come a moment after what they tell of, each in a task of its own and in order, and a new load takes back
 * those that have not come yet (HTML, “queue a media element task” and the load algorithm, step 3).
 */

/** What comes: an event, or something that is done where the specification says so in the same queue. */
type Step = Event | (() => void);

const queues = new WeakMap<EventTarget, Step[]>();

/** Tasks of all players, in order, and what makes the browser run the next of them. */
const tasks: (() => void)[] = [];
let knock: (() => void) | undefined;

/** Runs the next task. */
const run = (): void => tasks.shift()?.();

/** A message makes a task, and none that browsers delay as they do a timer's. */
function opened(): () => void {
  if (typeof MessageChannel !== 'function') return () => void setTimeout(run);
  const { port1, port2 } = new MessageChannel();
  port1.onmessage = run;
  return () => port2.postMessage(undefined);
}

function queue(media: EventTarget, step: Step): void {
  const steps = queues.get(media) ?? [];
  queues.set(media, steps);
  steps.push(step);
  tasks.push(() => pass(media));
  knock ??= opened();
  knock();
}

/** Dispatches events, by their types or as they are, one after another once the running script is over. They do not bubble. */
export function dispatch(media: EventTarget, ...events: readonly (string | Event)[]): void {
  for (const event of events) queue(media, typeof event === 'string' ? new Event(event) : event);
}

/** Does something after the events that are there. */
export function after(media: EventTarget, work: () => void): void {
  queue(media, work);
}

function pass(media: EventTarget): void {
  // It is told, and counts as told, before its listeners are called. None is there where it was taken back.
  const step = queues.get(media)?.shift();
  if (typeof step === 'function') step();
  else if (step !== undefined) media.dispatchEvent(step);
}

/** Takes back what has not come yet of a story that goes; loudness is not of a story, and what was to be done is done. */
export function takeBack(media: EventTarget): void {
  const steps = queues.get(media)?.splice(0) ?? [];
  for (const step of steps) {
    if (typeof step === 'function') step();
    else if (step.type === 'volumechange') queues.get(media)?.push(step);
  }
}

/** Takes back that a seek has ended: another one begins before pages have heard of that. */
export function takeBackSeek(media: EventTarget): void {
  const steps = queues.get(media) ?? [];
  const at = steps.findIndex((step) => step instanceof Event && step.type === 'seeked');
  // Its `timeupdate` is right before it, unless it was told already.
  if (at >= 0) steps.splice(Math.max(0, at - 1), Math.min(2, at + 1));
}

/** Whether an event of a type has not come yet. */
export function isPending(media: EventTarget, type: string): boolean {
  return queues.get(media)?.some((step) => step instanceof Event && step.type === type) ?? false;
}
