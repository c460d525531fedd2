/** What the pads over the pictures of *Face* and *Viewer* have in common: one drags and presses keys on them to look from elsewhere. */

/** Turn of the view for each pixel that the pointer goes, radians. */
export const TURN_PER_PIXEL = 0.008;

/** A picture that one comes nearer to. */
interface Zoomed {
  readonly zoom: number;
  look(look: { zoom: number }): void;
}

/** The wheel comes nearer. */
export function zoomByWheel(pad: HTMLElement, it: Zoomed): void {
  pad.addEventListener(
    'wheel',
    (event) => {
      // The page scrolls unless the picture is in use.
      if (!event.ctrlKey && document.activeElement !== pad) return;
      event.preventDefault();
      it.look({ zoom: it.zoom * Math.exp(-event.deltaY * 0.0015) });
    },
    { passive: false },
  );
}

/** The keys plus and minus come nearer; whether it was one of them. */
export function zoomByKey({ key }: KeyboardEvent, it: Zoomed): boolean {
  if (key === '+' || key === '=') it.look({ zoom: it.zoom * 1.15 });
  else if (key === '-') it.look({ zoom: it.zoom / 1.15 });
  else return false;
  return true;
}
