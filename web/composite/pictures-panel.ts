/** Panel of exports: printable images, a film, a report. One at a time, by a separate player. */

import { html, nothing, type TemplateResult } from 'lit';
import { choice } from '../pages/fields.js';
import { SIDES } from '../pages/head-view.js';
import { save } from '../pages/workbench.js';
import type { App } from './app.js';
import { turntable } from './film.js';
import { printPictures } from './print.js';
import { reportOf } from './report.js';
import { printReport, reportFile, type ReportPicture } from './report-page.js';
import { FRAMES, HEAD, Studio, type Framing, type ShotObserver } from './shots.js';

const SIDE_NAMES = { front: 'Front', quarter: 'Three-quarter', profile: 'Profile' } as const;
type Side = keyof typeof SIDE_NAMES;
const TURNS: Readonly<Record<Side, number>> = { front: SIDES.Front, quarter: SIDES['Three-quarter'], profile: SIDES.Left };
/** Views of printable images, including the view of the stage, and all sides. */
const FROM_NAMES = { stage: 'As on the stage', ...SIDE_NAMES, all: 'All three' } as const;
type ViewpointName = keyof typeof FROM_NAMES;
const ALL = Object.keys(SIDE_NAMES) as Side[];
const FRAME_NAMES = { head: FRAMES.head.name, shoulders: FRAMES.shoulders.name } as const;
const GROUNDS = { stage: 'As on the stage', plain: 'A plain wall, in even light' } as const;
/** Sharp on paper at a third of its width, in pixels. */
const REPORT_SIZE = { width: 640, height: 800 };

/** An export in progress. */
interface Job {
  readonly what: string;
  readonly end: AbortController;
  done: number;
  of: number;
}

export class Pictures {
  readonly #studio: Studio;
  #from: ViewpointName = 'front';
  #framing: Framing = HEAD;
  #name = 'face';
  #job: Job | undefined;

  /** Creates the panel; `place` receives the invisible player, `say` reports results, `trouble` reports errors. */
  constructor(
    private readonly app: App,
    place: HTMLElement,
    private readonly page: { say(text: string): void; trouble(text: string): void },
  ) {
    this.#studio = new Studio(app, place);
  }

  /** Renders the panel. */
  draw(): TemplateResult {
    const button = (name: string, work: () => void): TemplateResult =>
      html`<button type="button" class="plain" ?disabled=${this.#job !== undefined} @click=${work}>${name}</button>`;
    const choose = (from: ViewpointName): void => {
      this.#from = from;
      this.app.redraw();
    };
    const framed = (change: Partial<Framing>): void => {
      this.#framing = { ...this.#framing, ...change };
      this.app.redraw();
    };
    const { frame, plain } = this.#framing;
    return html`<section class="region" aria-label="Picture for print"><h3>Picture for print</h3>
        ${choice('side', 'From', this.#from, FROM_NAMES, choose)}
        ${choice('frame', 'Of', frame, FRAME_NAMES, (to) => framed({ frame: to }))}
        ${choice('ground', 'Before', plain ? 'plain' : 'stage', GROUNDS, (to) => framed({ plain: to === 'plain' }))}
        <div class="group">${button('Save picture', () => void this.#print())}</div>
        <p class="about">PNG, 10 × 12.5 cm at 300 dots per inch, rendered at full quality, however simply the stage is rendered; without a graphics card this takes some seconds.</p>
      </section>
      <section class="region" aria-label="Film"><h3>Film</h3>
        <div class="group">${button('Save film', () => void this.#film())}</div>
        <p class="about">The head turns once around in four seconds.</p>
      </section>
      <section class="region" aria-label="Report"><h3>Report</h3>
        <div class="group">${button('Print report', () => void this.#printReport())} ${button('Save report', () => void this.#saveReport())}</div>
        <p class="about">Three pictures, framed as above, hair, marks and light, all features that differ from the average, held values, and every step. The file is a self-contained web page.</p>
      </section>
      <section class="region" aria-label="Figure file"><h3>Figure file</h3>
        <div class="line"><label class="select"><span>Name of the figure</span><input type="text" maxlength="40" .value=${this.#name} autocomplete="off" @input=${(
          event: Event,
        ) => {
          this.#name = (event.target as HTMLInputElement).value;
        }} /></label>${button('Save figure', () => void this.#figure())}</div>
        <p class="about">A figure that performs any story with this face: choose it as <em>Yours</em> next to a story, or put it into a story's folder and name it there, as in <code>&lt;r:performer figure="${fileName(this.#name)}.glb"/&gt;</code>.</p>
      </section>
      ${this.#progress()}`;
  }

  #progress(): TemplateResult | typeof nothing {
    const job = this.#job;
    if (job === undefined) return nothing;
    const text = `${job.what}: ${job.done === 0 ? 'getting ready' : `${job.done} of ${job.of} ${job.of === 1 ? 'picture' : 'pictures'}`}`;
    return html`<div class="busy job"><progress aria-label=${job.what} max=${job.of} .value=${job.done}></progress><span>${text}</span>
      <button type="button" class="plain" @click=${() => job.end.abort()}>Cancel</button></div>`;
  }

  /** Runs one export, and reports its progress and result. */
  async #run(what: string, work: (watch: ShotObserver, file: string) => Promise<string>): Promise<void> {
    if (this.#job !== undefined) return;
    const end = new AbortController();
    // The face may get another name meanwhile.
    const { steps, here } = this.app.history;
    const file = fileName(steps[here]?.name);
    const job: Job = (this.#job = { what, end, done: 0, of: 1 });
    const progress = (done: number, of: number): void => {
      [job.done, job.of] = [done, of];
      this.app.redraw();
    };
    this.page.trouble('');
    this.app.redraw();
    try {
      const became = await work({ signal: end.signal, progress }, file);
      this.page.say(became);
    } catch (error) {
      if (end.signal.aborted) this.page.say(`${what}: cancelled.`);
      else this.page.trouble(`${what} could not be made: ${error instanceof Error ? error.message : String(error)}`);
    }
    this.#job = undefined;
    this.app.redraw();
  }

  #figure(): Promise<void> {
    return this.#run('Figure', async () => {
      const { app } = this;
      const name = fileName(this.#name);
      // Renders the face without its highlights.
      await app.player.setFace(app.face);
      const file = await app.player.figureFile(name);
      await app.show();
      return saved(file, `${name}.glb`);
    });
  }

  #print(): Promise<void> {
    const from = this.#from;
    const { turn, tilt } = this.app.view.from;
    const sides = from === 'stage' ? [{ name: 'view', side: { turn, tilt } }] : (from === 'all' ? ALL : [from]).map((name) => ({ name, side: { turn: TURNS[name] } }));
    return this.#run('Picture', async (watch, file) => {
      const pictures = await printPictures(
        this.#studio,
        sides.map(({ side }) => side),
        watch,
        this.#framing,
      );
      return pictures.map((picture, i) => saved(picture, `${file}-${sides[i]?.name ?? ''}.png`)).join(' ');
    });
  }

  #film(): Promise<void> {
    return this.#run('Film', async (watch, name) => {
      const { file, extension } = await turntable(this.#studio, watch);
      return saved(file, `${name}.${extension}`);
    });
  }

  #printReport(): Promise<void> {
    return this.#run('Report', async (watch) => {
      await printReport(reportOf(this.app, new Date()), await this.#sides(watch));
      return 'The report is ready.';
    });
  }

  #saveReport(): Promise<void> {
    return this.#run('Report', async (watch, file) => {
      const report = reportOf(this.app, new Date());
      return saved(reportFile(report, await this.#sides(watch)), `${file}.html`);
    });
  }

  /** Renders the images of the report. */
  async #sides(watch: ShotObserver): Promise<ReportPicture[]> {
    const sides = ALL.map((side) => ({ turn: TURNS[side] }));
    const pictures = await this.#studio.all(sides, REPORT_SIZE, watch, this.#framing);
    return pictures.map((picture, i) => ({ name: SIDE_NAMES[ALL[i] ?? 'front'], src: picture.toDataURL('image/jpeg', 0.9) }));
  }
}

function saved(file: Blob, name: string): string {
  save(file, name);
  return `${name} is saved.`;
}

/** Returns a file name that is valid on every system. */
export function fileName(name = ''): string {
  return (
    name
      .normalize('NFKD')
      .toLowerCase()
      .replace(/\p{M}/gu, '')
      .replace(/[^a-z0-9]+/g, '-')
      .replace(/^-|-$/g, '')
      .slice(0, 40) || 'face'
  );
}
