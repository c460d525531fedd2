/** Choice of the performing figure: the one set by the page, otherwise the story's choice, otherwise the default. */

import { performerOf } from '../engine/backend.js';
import { FigureError, type FigureFile } from '../engine/figure.js';
import { fetchFigure, readFigure, type RequestedFiles } from '../engine/loader.js';
import { isTrap } from '../engine/trap.js';
import { PlayerError, type Backend, type Diagnostic, type Hand } from '../base/types.js';

/** The default figure; `raconteur` on the command line has the same. */
export const USUAL_FIGURE = 'sofia';

/** Pattern of the element that chooses a figure; XML has no other way to write its name. */
const MAY_CHOOSE = /performer/i;

/** Returns the figure chosen by a text; undefined if it makes no choice. */
export async function figureOf(eml: string, backend: () => Promise<Backend>): Promise<string | undefined> {
  return MAY_CHOOSE.test(eml) ? (await performerOf(await backend(), eml)).figure : undefined;
}

/** Settings of the page. */
export interface PerformerRequest {
  /** Name from the library, address, or name of `given`; without it the story chooses. */
  readonly figure: string | undefined;
  readonly handedness: Hand | undefined;
  /** File of the user's own. */
  readonly given: File | undefined;
  readonly library: URL;
  /** Location of the story; a text without a file has that of the page. */
  readonly story: URL;
}

/** Returns the figure that is to perform a text. */
export async function castFigure(
  wish: PerformerRequest,
  eml: Promise<string>,
  backend: Promise<Backend>,
  wanted: RequestedFiles,
  report: (diagnostic: Diagnostic) => void,
): Promise<FigureFile> {
  const { figure, given, handedness, library, story } = wish;
  const fetched = !figure
    ? fetchChoice(await figureOf(await eml, () => backend), story, library, wanted, report)
    : given?.name === figure
      ? readFigure(given)
      : fetchFigure(figure, library, wanted);
  return { ...(await fetched), handedness };
}

/**
 * Fetches the figure that a story chooses: a name of the library, or a file in the story's folder. If it cannot be loaded, fetches the default one, and
 * `report` receives a diagnostic.
 */
export async function fetchChoice(choice: string | undefined, story: URL, library: URL, wanted: RequestedFiles, report: (diagnostic: Diagnostic) => void): Promise<FigureFile> {
  if (choice !== undefined) {
    try {
      return await fetchFigure(choice, library, wanted, inside(choice, story));
    } catch (error) {
      if (!(error instanceof PlayerError)) throw error;
      report(refusal(error.message));
    }
  }
  return await fetchFigure(USUAL_FIGURE, library, wanted);
}

/** Opens a picture with the figure chosen by a story; if that is not a valid figure, with the default one, and `report` receives a diagnostic. */
export async function openOrUsual<T>(
  open: (figure: FigureFile) => Promise<T>,
  chosen: FigureFile,
  library: URL,
  signal: AbortSignal,
  report: (diagnostic: Diagnostic) => void,
): Promise<T> {
  try {
    return await open(chosen);
  } catch (error) {
    // A trap has another cause than the file.
    if (!(error instanceof FigureError) || isTrap(error) || chosen.name === USUAL_FIGURE) throw error;
    report(refusal(error.message));
    return await open({ ...(await fetchFigure(USUAL_FIGURE, library, { signal, progress: () => undefined })), handedness: chosen.handedness });
  }
}

/** Returns the diagnostic for a story's figure that cannot be used. */
function refusal(message: string): Diagnostic {
  return { code: 'figure-unusable', severity: 'warning', message, hints: [`“${USUAL_FIGURE}” performs instead of the figure that the story chooses.`] };
}

/** Returns the location of a story's own figure; a story cannot access files outside its folder. */
function inside(choice: string, story: URL): URL | undefined {
  if (/^[\w-]+$/.test(choice)) return undefined;
  const folder = new URL('.', story);
  const file = new URL(choice, folder);
  if (!file.href.startsWith(folder.href)) throw new PlayerError(`The figure ${choice} is not in the story's folder.`);
  return file;
}
