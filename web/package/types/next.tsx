/** Mistakes that types must see. */

import type {} from '@raconteur/player/react';

export const wrongEvent = (
  <raconteur-player
    src="story.eml"
    controls
    onword={({ detail }) => {
      const text: string = detail.word.text;
      // @ts-expect-error: a word has no such member.
      return `${text}${detail.word.wrong}`;
    }}
  />
);
// @ts-expect-error: there is no such backend.
export const wrongValue = <raconteur-player backend="paper" />;
// @ts-expect-error: there is no such attribute.
export const wrongName = <raconteur-player figur="sofia" />;
