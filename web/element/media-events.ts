/**
 * Events of media elements come a moment after what they tell of, in order, and a new load takes back
 * those that have not come yet (HTML, “queue a media element task” and the load algorithm, step 3).
 */

const queues = new WeakMap<EventTarget, Event[]>();

/** Dispatches events, by their types or as they are, one after another once the running script is over. They do not bubble. */
export function dispatch(media: EventTarget, ...events: readonly (string | Event)[]): void {
  const queue = queues.get(media) ?? [];
  if (queue.length === 0 && events.length > 0) queueMicrotask(() => pass(media));
  queue.push(...events.map((event) => (typeof event === 'string' ? new Event(event) : event)));
  queues.set(media, queue);
}

function pass(media: EventTarget): void {
  const queue = queues.get(media) ?? [];
  for (let next = queue[0]; next !== undefined; next = queue[0]) {
    // It is told, and counts as told, before its listeners are called.
    queue.shift();
    media.dispatchEvent(next);
  }
}

/** Takes back what has not come yet of a story that goes; loudness is not of a story. */
export function takeBack(media: EventTarget): void {
  const queue = queues.get(media);
  queue?.splice(0, Infinity, ...queue.filter(({ type }) => type === 'volumechange'));
}

/** Whether an event of a type has not come yet. */
export function isPending(media: EventTarget, type: string): boolean {
  return queues.get(media)?.some((event) => event.type === type) ?? false;
}
