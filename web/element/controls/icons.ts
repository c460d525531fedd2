/** Icons of the controls, drawn on a 24 × 24 grid. */

import { svg, type SVGTemplateResult } from 'lit';

const icon = (path: string): SVGTemplateResult => svg`<svg viewBox="0 0 24 24" width="24" height="24" aria-hidden="true" focusable="false"><path d=${path} /></svg>`;

export const icons = {
  play: icon('M8 5.2v13.6c0 .8.9 1.3 1.6.8l10-6.8c.6-.4.6-1.2 0-1.6l-10-6.8c-.7-.5-1.6 0-1.6.8z'),
  pause: icon('M7 5h3.4v14H7zM13.6 5H17v14h-3.4z'),
  replay: icon('M12 5V2L6.5 6.2 12 10.4V7.3a5.4 5.4 0 1 1-5.3 6.5H4.3A7.7 7.7 0 1 0 12 5z'),
  loud: icon('M4 9.2v5.6h3.6L12.5 19V5L7.6 9.2zM15 8.3a4.6 4.6 0 0 1 0 7.4v-2.4a2.5 2.5 0 0 0 0-2.6zM15 4.6a8 8 0 0 1 0 14.8v-2.3a5.9 5.9 0 0 0 0-10.2z'),
  silent: icon('M4 9.2v5.6h3.6L12.5 19V5L7.6 9.2zM15 9.6l1.3-1.3 2.2 2.2 2.2-2.2L22 9.6 19.8 12l2.2 2.3-1.3 1.4-2.2-2.3-2.2 2.3-1.3-1.4 2.2-2.3z'),
  captions: icon('M4.5 5h15A1.5 1.5 0 0 1 21 6.5v11a1.5 1.5 0 0 1-1.5 1.5h-15A1.5 1.5 0 0 1 3 17.5v-11A1.5 1.5 0 0 1 4.5 5zm1 6v2h5v-2zm7 0v2h6v-2zm-7 3.5v2h8v-2zm10 0v2h3v-2z'),
  enter: icon('M4 4h6v2.2H6.2V10H4zM14 4h6v6h-2.2V6.2H14zM4 14h2.2v3.8H10V20H4zM17.8 14H20v6h-6v-2.2h3.8z'),
  leave: icon('M7.8 4H10v6H4V7.8h3.8zM14 4h2.2v3.8H20V10h-6zM4 14h6v6H7.8v-3.8H4zM14 14h6v2.2h-3.8V20H14z'),
} as const;
