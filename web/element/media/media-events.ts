/**
 * Media events are dispatched asynchronously, each in its own task and in order; a new load cancels pending ones (HTML, “queue a media element task” and the
 * load algorithm, step 3).
 */

/** Event, or an action that the specification schedules in the same queue. */
type Step = Event | (() => void);

const queues = new WeakMap<EventTarget, Step[]>();

/** Queued tasks of all players, in order; the next variable makes the browser run the next one. */
const tasks: (() => void)[] = [];
let knock: (() => void) | undefined;

/** Runs the next task. */
const run = (): void => tasks.shift()?.();

/** Opens a message channel for tasks, which browsers do not throttle like timers. */
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

/** Runs an action after the pending events. */
export function after(media: EventTarget, work: () => void): void {
  queue(media, work);
}

function pass(media: EventTarget): void {
  // The event is fired, and counts as fired, before its listeners run. The queue is empty if the
  // event was cancelled.
  const step = queues.get(media)?.shift();
  if (typeof step === 'function') step();
  else if (step !== undefined) media.dispatchEvent(step);
}

/** Cancels the pending events of an unloaded story; volume events are kept, and pending actions are run. */
export function takeBack(media: EventTarget): void {
  const steps = queues.get(media)?.splice(0) ?? [];
  for (const step of steps) {
    if (typeof step === 'function') step();
    else if (step.type === 'volumechange') queues.get(media)?.push(step);
  }
}

/** Cancels a pending `seeked` event when another seek starts before it is dispatched. */
export function takeBackSeek(media: EventTarget): void {
  const steps = queues.get(media) ?? [];
  const at = steps.findIndex((step) => step instanceof Event && step.type === 'seeked');
  // Its `timeupdate` directly precedes it, unless it has fired already.
  if (at >= 0) steps.splice(Math.max(0, at - 1), Math.min(2, at + 1));
}

/** Returns true if an event of a type is pending. */
export function isPending(media: EventTarget, type: string): boolean {
  return queues.get(media)?.some((step) => step instanceof Event && step.type === type) ?? false;
}
