// [guide
import '@raconteur/player';
import type { RaconteurPlayer } from '@raconteur/player';
import type {} from '@raconteur/player/react';
// guide]
import { MediaControlBar, MediaController, MediaMuteButton, MediaPlayButton, MediaTimeDisplay, MediaTimeRange } from 'media-chrome/react';
// [guide
import { useRef, useState } from 'react';

export function App() {
  const player = useRef<RaconteurPlayer>(null);
  const [word, setWord] = useState('');
  const toggle = () => (player.current?.paused ? player.current.play() : player.current?.pause());
  return (
    <main>
      {/* guide] The bar of media-chrome takes the place of the player's own, `controls`. */}
      <MediaController>
        {/* [guide 6 */}
        <raconteur-player
          ref={player}
          slot="media"
          src="/raconteur/stories/hello-world/story.eml"
          assets="/raconteur/"
          label="Hello world"
          onword={({ detail }) => setWord(detail.word.text)}
        />
        {/* guide] */}
        <MediaControlBar>
          <MediaPlayButton />
          <MediaTimeRange />
          <MediaTimeDisplay showDuration />
          <MediaMuteButton />
        </MediaControlBar>
      </MediaController>
      {/* [guide */}
      <p>
        <button type="button" onClick={toggle}>
          Play or pause
        </button>{' '}
        <output>{word}</output>
      </p>
    </main>
  );
}
// guide]
