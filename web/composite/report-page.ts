/** Report for printing and as a file. lit renders both once, so user input is text and never markup. */

import { html, render, type TemplateResult } from 'lit';
import type { Report } from './report.js';
import look from './report.css?inline';

/** An image in the report. */
export interface ReportPicture {
  readonly name: string;
  /** A data URL. */
  readonly src: string;
}

function page({ name, date, facts, groups, held, steps }: Report, pictures: readonly ReportPicture[]): TemplateResult {
  const list = (texts: readonly string[]): TemplateResult => html`<ul>${texts.map((text) => html`<li>${text}</li>`)}</ul>`;
  return html`<header><h1>${name}</h1>
      <p>Facial composite, ${date.toLocaleString('en-GB', { dateStyle: 'long', timeStyle: 'short' })}</p></header>
    <div class="pictures">${pictures.map((picture) => html`<figure><img src=${picture.src} alt="The face: ${picture.name}" /><figcaption>${picture.name}</figcaption></figure>`)}</div>
    <dl>${facts.map(([fact, text]) => html`<div><dt>${fact}</dt><dd>${text}</dd></div>`)}</dl>
    <h2>Features that differ from the average</h2>
    ${groups.length === 0 ? html`<p>None: this is the average face.</p>` : html`<p>0 is the average face; 1 is as far from it as people mostly are.</p>`}
    <div class="tables">${groups.map(
      ({ title, rows }) => html`<table><caption>${title}</caption>
        <thead><tr><th scope="col">Feature</th><th scope="col">Look</th><th scope="col">Value</th></tr></thead>
        <tbody>${rows.map((row) => html`<tr><th scope="row">${row.name}</th><td>${row.term}</td><td>${row.value}</td></tr>`)}</tbody></table>`,
    )}</div>
    <h2>Held values</h2>
    ${held.length === 0 ? html`<p>Nothing.</p>` : list(held)}
    <h2>How the face was made</h2>
    <ul class="steps">${steps.map(({ step, text }) => html`<li><span>${step}</span>${text}</li>`)}</ul>`;
}

/** Renders a report; on a page of its own it is the main part. */
function draw(report: Report, pictures: readonly ReportPicture[], as: 'section' | 'main'): HTMLElement {
  const drawn = document.createElement(as);
  drawn.className = 'report';
  render(page(report, pictures), drawn);
  return drawn;
}

/** Prints a report: while that lasts it is all there is on paper, and the screen stays as it is. */
export async function printReport(report: Report, pictures: readonly ReportPicture[]): Promise<void> {
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(`${look} @media screen { .report { display: none; } } @media print { body > :not(.report) { display: none !important; } }`);
  const drawn = draw(report, pictures, 'section');
  await Promise.all([...drawn.querySelectorAll('img')].map((image) => image.decode()));
  // Browsers that do not report the end of printing leave the previous report.
  for (const old of document.querySelectorAll('body > .report')) old.remove();
  document.body.append(drawn);
  document.adoptedStyleSheets.push(sheet);
  const end = (): void => {
    drawn.remove();
    document.adoptedStyleSheets = document.adoptedStyleSheets.filter((other) => other !== sheet);
  };
  addEventListener('afterprint', end, { once: true });
  window.print();
}

/** Returns a report as a self-contained file. */
export function reportFile(report: Report, pictures: readonly ReportPicture[]): Blob {
  const drawn = draw(report, pictures, 'main');
  // Lit marks its positions with comments.
  const marks = document.createTreeWalker(drawn, NodeFilter.SHOW_COMMENT);
  const comments: ChildNode[] = [];
  while (marks.nextNode()) comments.push(marks.currentNode as Comment);
  for (const comment of comments) comment.remove();
  const title = document.createElement('title');
  title.textContent = report.name;
  const head = `<meta charset="utf-8">\n<meta name="viewport" content="width=device-width">\n${title.outerHTML}\n<style>\n${look}</style>`;
  return new Blob([`<!doctype html>\n<html lang="en">\n<head>\n${head}\n</head>\n<body>\n${drawn.outerHTML}\n</body>\n</html>\n`], { type: 'text/html' });
}
