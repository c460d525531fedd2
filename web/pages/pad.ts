/** Pads over the pictures of *Face* and *Viewer* for changing the view by dragging and keys. */

/** Rotation of the view per pixel of pointer movement, radians. */
export const TURN_PER_PIXEL = 0.008;

/** Minimum camera height, which keeps the view above the floor, metres. */
const MIN_M = 0.12;

/** Returns the minimum tilt, radians, that keeps a camera at this distance from its target (metres, like the target's height) above the floor. */
export function leastTilt(height: number, distance: number): number {
  return Math.asin(Math.min(1, Math.max(-1, (MIN_M - height) / distance)));
}

/** Picture with a zoom. */
interface ZoomRange {
  readonly zoom: number;
  look(look: { zoom: number }): void;
}

/** Zooms with the wheel. */
export function zoomByWheel(pad: HTMLElement, it: ZoomRange): void {
  pad.addEventListener(
    'wheel',
    (event) => {
      // The page scrolls unless the pad has the focus.
      if (!event.ctrlKey && !pad.matches(':focus')) return;
      event.preventDefault();
      it.look({ zoom: it.zoom * Math.exp(-event.deltaY * 0.0015) });
    },
    { passive: false },
  );
}

/** Zooms with the plus and minus keys; returns true for one of them. */
export function zoomByKey({ key }: KeyboardEvent, it: ZoomRange): boolean {
  if (key === '+' || key === '=') it.look({ zoom: it.zoom * 1.15 });
  else if (key === '-') it.look({ zoom: it.zoom / 1.15 });
  else return false;
  return true;
}
