'use client';

import '@raconteur/player';
import type { PlayerEventMap, RaconteurPlayer } from '@raconteur/player';
import type {} from '@raconteur/player/react';
import { useEffect, useRef, useState } from 'react';

export function Story() {
  const player = useRef<RaconteurPlayer>(null);
  const [word, setWord] = useState('');
  const toggle = () => (player.current?.paused ? player.current.play() : player.current?.pause());
  // React adds no listeners of custom elements, `onword`, to what the server has made.
  useEffect(() => {
    const { current } = player;
    const show = ({ detail }: PlayerEventMap['word']) => setWord(detail.word.text);
    current?.addEventListener('word', show);
    return () => current?.removeEventListener('word', show);
  }, []);
  return (
    <>
      <raconteur-player ref={player} src="/raconteur/stories/hello-world/story.eml" assets="/raconteur/" label="Hello world" controls />
      <p>
        <button type="button" onClick={toggle}>
          Play or pause
        </button>{' '}
        <output>{word}</output>
      </p>
    </>
  );
}
