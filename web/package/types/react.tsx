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
// @ts-expect-error: React would not attach it; the name is `onplay`.
export const unheard = <raconteur-player onPlay={() => undefined} />;
// @ts-expect-error: nor this one, `onerror`.
export const unheardToo = <raconteur-player onError={() => undefined} />;
export const heard = (
  <raconteur-player
    onplay={({ type }) => type}
    onPlayCapture={({ currentTarget }) => currentTarget.currentTime}
    onClick={({ currentTarget }) => currentTarget.play()}
    onerror={({ currentTarget }) => currentTarget}
    aria-label="A story"
  />
);
