/** The words of the first page's lines. */

import { expect, test } from 'vitest';
import { textsOf } from '../pages/landing/script.js';

test('what a script says is read as XML writes it', () => {
  const script =
    "<eml><body><voice-text time='0'>Who <emph>are</emph> you &amp; I,</voice-text><voice-text time='e0'>&lt;b&gt;&#13;&apos;so&apos;&quot; &amp;lt; &no;</voice-text></body></eml>";
  expect(textsOf(script)).toEqual(['Who are you & I,', `<b>\r'so'" &lt; &no;`]);
});
