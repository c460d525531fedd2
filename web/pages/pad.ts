/** What the pads over the pictures of *Face* and *Viewer* have in common: one drags and presses keys on them to look from elsewhere. */

/** Turn of the view for each pixel that the pointer goes, radians. */
export const TURN_PER_PIXEL = 0.008;

/** A camera lower than this would look through the floor, metres. */
const MIN_M = 0.12;

/** The least tilt, radians, of a camera this far from what it looks at (metres, the latter's height too) that keeps it above the floor. */
export function leastTilt(height: number, distance: number): number {
  return Math.asin(Math.min(1, Math.max(-1, (MIN_M - height) / distance)));
}

/** A picture that one comes nearer to. */
interface ZoomRange {
  readonly zoom: number;
  look(look: { zoom: number }): void;
}

/** The wheel comes nearer. */
export function zoomByWheel(pad: HTMLElement, it: ZoomRange): void {
  pad.addEventListener(
    'wheel',
    (event) => {
      // The page scrolls unless the picture is in use.
      if (!event.ctrlKey && !pad.matches(':focus')) return;
      event.preventDefault();
      it.look({ zoom: it.zoom * Math.exp(-event.deltaY * 0.0015) });
    },
    { passive: false },
  );
}

/** The keys plus and minus come nearer; whether it was one of them. */
export function zoomByKey({ key }: KeyboardEvent, it: ZoomRange): boolean {
  if (key === '+' || key === '=') it.look({ zoom: it.zoom * 1.15 });
  else if (key === '-') it.look({ zoom: it.zoom / 1.15 });
  else return false;
  return true;
}
