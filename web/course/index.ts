/** Entry module of a course page: the player, and the reporting to a learning management system. */

import { register } from '../element/register.js';
import { Course } from './course.js';
import { CoursePage } from './page.js';
import type { Record } from './report.js';
import { Scorm, SCORM_12, SCORM_2004 } from './scorm.js';
import { BrowserRecord } from './storage.js';
import { XapiRecord, type Course as About } from './xapi.js';

/** Record constructors, by the page's `data-record`. */
const RECORDS: { readonly [name: string]: (about: About) => Record } = {
  scorm12: ({ activityId }) => new Scorm(SCORM_12, activityId, storage()),
  scorm2004: ({ activityId }) => new Scorm(SCORM_2004, activityId, storage()),
  xapi: (about) => new XapiRecord(location.href, about, storage()),
  cmi5: (about) => new XapiRecord(location.href, about, storage()),
  html: ({ activityId }) => new BrowserRecord(activityId, storage()),
};

/** Returns the browser's storage, if the page may use it. */
function storage(): Storage | undefined {
  try {
    return localStorage;
  } catch {
    return undefined;
  }
}

/** Parses a share from the page's settings, 0 to 1. */
function share(text: string | undefined): number | undefined {
  const number = Number(text);
  return text && number >= 0 && number <= 1 ? number : undefined;
}

async function begin(): Promise<void> {
  const { record = 'html', course = '', watched, pass } = document.body.dataset;
  const player = document.querySelector('raconteur-player');
  const [bar, result] = ['nav', 'section'].map((name) => document.querySelector<HTMLElement>(name));
  const status = document.querySelector('output');
  const open = RECORDS[record];
  if (player === null || status === null || !bar || !result || open === undefined) throw new Error('This page was not made by “raconteur export”.');
  const rules = { watched: share(watched) ?? 0.9, pass: share(pass) };
  const kept = open({ ...rules, activityId: course, title: document.title, language: document.documentElement.lang });
  await new CoursePage(player, new Course(player, kept, rules), kept, { bar, status, result }, record !== 'html').begin();
}

// The library is next to the page of the course.
register(new URL('library/', document.baseURI).href);
// A page restored from the browser's cache does not reopen a closed session, so it reloads.
addEventListener('pageshow', ({ persisted }) => persisted && location.reload());
void begin();
