/** Time axis of the tracks: its scale, its view, and its marks. */

/** Maximum scale, pixels per second: a hundredth of a second is a fingertip wide. */
const MAX_SCALE = 2400;
/** Minimum distance of marks, pixels. */
const MARK_PX = 72;
const MARK_STEPS = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600];
/** Share of the view at its ends from which a time is brought further inside. */
const MARGIN = 0.08;

/** Part of the recording in view. */
export interface AxisView {
  /** Time at the left end, seconds. */
  readonly from: number;
  /** Pixels per second. */
  readonly scale: number;
  /** Width of the view, pixels. */
  readonly width: number;
}

/** Returns the time at the right end. */
export const toOf = ({ from, scale, width }: AxisView): number => from + width / scale;

/** Returns the scale that shows a length in a width. */
export const fitted = (secs: number, width: number): number => Math.max(1, width) / Math.max(0.1, secs);

/** Returns the view after a change of the scale by a factor; the time at a position, in pixels from the left end, stays there. */
export function zoomed(view: AxisView, factor: number, at: number, secs: number): AxisView {
  const least = Math.min(MAX_SCALE, fitted(secs, view.width));
  const scale = Math.min(MAX_SCALE, Math.max(least, view.scale * factor));
  const from = view.from + at / view.scale - at / scale;
  return { ...view, scale, from: clamped(from, scale, view.width, secs) };
}

function clamped(from: number, scale: number, width: number, secs: number): number {
  return Math.max(0, Math.min(from, secs - width / scale));
}

/** Returns the left end of a view of the same scale in which a span is visible; that of now, if it is visible already. */
export function revealed(view: AxisView, start: number, end: number, secs: number): number {
  const { from, scale, width } = view;
  const length = width / scale;
  const margin = MARGIN * length;
  if (start >= from && end <= from + length) return from;
  // The start of a span that is longer than the view matters more than its end.
  const wanted = start < from || end - start > length - margin ? start - margin : end - length + margin;
  return clamped(wanted, scale, width, secs);
}

/** Returns the marks of a view: their times and texts. */
export function marks(view: AxisView): { secs: number; text: string }[] {
  const step = MARK_STEPS.find((step) => step * view.scale >= MARK_PX) ?? 600;
  const decimals = step >= 1 ? 0 : step >= 0.1 ? 1 : 2;
  const first = Math.ceil(Math.max(0, view.from) / step);
  const last = Math.floor(toOf(view) / step);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => {
    const secs = (first + i) * step;
    return { secs, text: clock(secs, decimals) };
  });
}

/** Returns a time as text: minutes, if there are any, and seconds. */
export function clock(secs: number, decimals = 2): string {
  const whole = Number(Math.max(0, secs).toFixed(decimals));
  const minutes = Math.floor(whole / 60);
  const rest = (whole - 60 * minutes).toFixed(decimals);
  return minutes === 0 ? rest : `${minutes}:${rest.padStart(decimals === 0 ? 2 : decimals + 3, '0')}`;
}
