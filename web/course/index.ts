/** What the page of a course imports: the player, and what tells a learning management system of the learner. */

import { register } from '../element/register.js';
import { Course } from './course.js';
import { RecordError, type Record } from './report.js';
import { Scorm, SCORM_12, SCORM_2004 } from './scorm.js';
import { BrowserRecord } from './storage.js';
import { XapiRecord, type Course as About } from './xapi.js';

/** By the page's `data-record`. */
const RECORDS: { readonly [name: string]: (about: About) => Record } = {
  scorm12: () => new Scorm(SCORM_12),
  scorm2004: () => new Scorm(SCORM_2004),
  xapi: (about) => new XapiRecord(location.href, about, storage()),
  cmi5: (about) => new XapiRecord(location.href, about, storage()),
  html: ({ activityId }) => new BrowserRecord(activityId, storage()),
};

/** The browser's, where a page may keep something. */
function storage(): Storage | undefined {
  try {
    return localStorage;
  } catch {
    return undefined;
  }
}

/** A share that the page tells, 0 to 1. */
function share(text: string | undefined): number | undefined {
  const number = Number(text);
  return text && number >= 0 && number <= 1 ? number : undefined;
}

async function begin(): Promise<void> {
  const { record = 'html', course = '', watched, pass } = document.body.dataset;
  const player = document.querySelector('raconteur-player');
  const note = document.querySelector('output');
  if (player === null) return;
  const rules = { watched: share(watched) ?? 0.9, pass: share(pass) };
  const about = { ...rules, activityId: course, title: document.title, language: document.documentElement.lang };
  const open = RECORDS[record] ?? RECORDS['html'];
  if (open === undefined) return;
  try {
    await new Course(player, open(about), rules).begin();
  } catch (error) {
    if (!(error instanceof RecordError)) throw error;
    if (note !== null) note.value = error.message;
  }
}

// The library lies beside the page of the course.
register(new URL('library/', document.baseURI).href);
// A session that was closed is not opened anew in a page that the browser has kept.
addEventListener('pageshow', ({ persisted }) => persisted && location.reload());
void begin();
