import '@raconteur/player';
import type { RaconteurPlayer } from '@raconteur/player';
import type {} from '@raconteur/player/solid';
import { createSignal } from 'solid-js';

export function App() {
  let player: RaconteurPlayer | undefined;
  const [word, setWord] = createSignal('');
  const toggle = () => (player?.paused ? player.play() : player?.pause());
  return (
    <main>
      <raconteur-player
        ref={player}
        src="/raconteur/stories/hello-world/story.eml"
        assets="/raconteur/"
        label="Hello world"
        controls
        on:word={({ detail }) => setWord(detail.word.text)}
      />
      <p>
        <button type="button" onClick={toggle}>
          Play or pause
        </button>{' '}
        <output>{word()}</output>
      </p>
    </main>
  );
}
