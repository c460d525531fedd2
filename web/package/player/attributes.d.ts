/** The attributes and events of `<raconteur-player>`, of which the types for frameworks are made. */

import type { RaconteurPlayer } from '../../element/element.js';
import type { MediaEventMap, PlayerEventMap } from '../../element/base/events.js';

export type { RaconteurPlayer };

/** Attributes that are properties by the same name. */
type Named =
  | 'src'
  | 'preload'
  | 'autoplay'
  | 'controls'
  | 'loop'
  | 'muted'
  | 'figure'
  | 'handedness'
  | 'mind'
  | 'speech'
  | 'assets'
  | 'poster'
  | 'film'
  | 'label'
  | 'backend'
  | 'quality'
  | 'loading'
  | 'captions'
  | 'remarks';

/** Attributes of `<raconteur-player>` in addition to those of every element. */
export type PlayerAttributes = { [Name in Named]?: RaconteurPlayer[Name] | undefined } & {
  crossorigin?: '' | 'anonymous' | 'use-credentials' | undefined;
  volume?: number | `${number}` | undefined;
  'playback-rate'?: number | `${number}` | undefined;
  disablepictureinpicture?: boolean | undefined;
  playsinline?: boolean | undefined;
};

/** All events of a player, by name. */
export type PlayerEvents = MediaEventMap & PlayerEventMap;

/** Listeners as attributes: `on` before the events' names. */
export type PlayerHandlers<Prefix extends string> = {
  [Name in keyof PlayerEvents as `${Prefix}${Name}`]?: ((event: PlayerEvents[Name]) => unknown) | undefined;
};
