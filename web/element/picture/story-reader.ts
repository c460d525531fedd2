/** Setup of an engine with its content. */

import type { PictureRequest } from './picture-request.js';
import { unusable } from '../engine/figure.js';
import type { StoryFiles } from '../engine/loader.js';
import { isTrap, trapError } from '../engine/trap.js';
import type { GivenFace } from '../face/given-face.js';
import type { Engine } from '../base/engine.js';
import { PlayerError, type Story } from '../base/types.js';

/** Reads the files of a story into engines, with the settings of the page and the given face of the figure. */
export class StoryReader {
  files: StoryFiles;
  readonly #asked: PictureRequest;
  readonly #given: GivenFace;
  /** Applies animations that arrive later; `live`: they belong to live clauses. */
  readonly #follow: (engine: Engine, live: boolean, files: StoryFiles) => void;

  constructor(files: StoryFiles, asked: PictureRequest, given: GivenFace, follow: (engine: Engine, live: boolean, files: StoryFiles) => void) {
    this.files = files;
    this.#asked = asked;
    this.#given = given;
    this.#follow = follow;
  }

  /** Reads the story; `kept`: the figure is already on stage. */
  read(engine: Engine, files = this.files, kept = false): Story {
    const { eml, bundle, figure, edited, language, problem } = files;
    const motion = this.#asked.life;
    this.#asked.prepare(engine);
    engine.setHandedness(figure.handedness ?? '');
    engine.setLanguage(language);
    try {
      const told = kept ? engine.replaceStory(eml, bundle, motion) : undefined;
      const story = told ?? engine.load(eml, bundle, figure.name, figure.glb, motion);
      if (told === undefined) this.#given.apply(engine);
      engine.setOpenEnded(this.#asked.openEnded);
      // An edited text is loaded with capacity for later edits.
      if (edited) return this.reread(engine, files);
      const animated = this.animate(engine, story, files) ?? story;
      return problem === undefined ? animated : { ...animated, diagnostics: [problem, ...animated.diagnostics] };
    } catch (error) {
      // An engine throws only for a figure; all other problems are diagnostics.
      if (error instanceof PlayerError) throw error;
      throw isTrap(error) ? trapError(engine, files, error) : unusable(figure.where, error);
    }
  }

  /** Makes the figure on stage read the text as an edited one. */
  reread(engine: Engine, files = this.files): Story {
    const story = engine.rehearse(files.eml, files.bundle, this.#asked.life, this.#asked.roomy);
    if (story === undefined) throw new PlayerError('No figure is on stage.');
    engine.setOpenEnded(this.#asked.openEnded);
    return this.animate(engine, story, files) ?? story;
  }

  /**
   * Passes the loaded animations to the engine, and later ones when they arrive; without a `story` they belong to live clauses. Returns the story with its new
   * times and diagnostics.
   */
  animate(engine: Engine, story: Story | undefined, files = this.files): Story | undefined {
    const told = files.animations.provide(engine, files.eml);
    this.#follow(engine, story === undefined, files);
    if (told === undefined || story === undefined) return story;
    return { ...told, diagnostics: [...story.diagnostics, ...told.diagnostics] };
  }
}
