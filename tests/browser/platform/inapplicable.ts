/** Tests of the same folders that do not apply to a storyteller. */

export interface Inapplicable {
  /** Test file; a trailing star matches all files whose names begin with the text before it. */
  readonly test: string;
  readonly reason: string;
}

const SOURCES = 'chooses among `<source>` elements; a story has one address';
const TRACKS = 'is about `<track>` elements; a story brings its captions, and pages add tracks by script';
const CUES = 'is about the class of the cue, which is the browser’s own';
const SHOWN = 'compares how WebVTT is laid out over a picture; the player sets its captions itself';
const FILES = 'is about containers and codecs of sound and pictures; a story is EML';
const FRAMES = 'is about policies for frames, which the browser applies to the sound of any page';
const POSTERS = 'is about posters; the player shows its own picture';
const LAZY = 'a proposal for `loading` that is not in the specification; the player’s own is tested in bare.spec.ts';
const HAND = 'is looked at or listened to by a person; the sound is measured in clock.spec.ts and voice.spec.ts';
const OTHERS = 'is about the classes of the browser alone';

const because = (reason: string, ...tests: readonly string[]): Inapplicable[] => tests.map((test) => ({ test, reason }));

const loading = 'loading-the-media-resource/';
const selection = `${loading}resource-selection-`;
const track = 'track/track-element/';
const video = '/html/semantics/embedded-content/the-video-element/';
const audio = '/html/semantics/embedded-content/the-audio-element/';
const pip = '/picture-in-picture/';

export const inapplicable: readonly Inapplicable[] = [
  ...because(
    SOURCES,
    'video_008.htm',
    `${selection}candidate-insert-before.html`,
    `${selection}candidate-moved.html`,
    `${selection}candidate-remove-*`,
    `${selection}invoke-insert-*`,
    `${selection}pointer-*`,
    `${selection}remove-source.html`,
    `${selection}source-*`,
    `${selection}invoke-audio-constructor*`,
  ),
  ...because(
    'is about scripts that run while the parser is at work; the player is an element of a script',
    `${selection}stable-state-*`,
    `${loading}stable-state-dialogs-manual.html`,
    `${loading}stable-state-beforeunload-manual.html`,
  ),
  ...because(
    TRACKS,
    'interfaces/HTMLElement/HTMLTrackElement/*',
    'interfaces/TextTrack/addCue.html#adding a cue associated with a track element to other track',
    'interfaces/TextTrack/removeCue.html#cue from track element',
    'interfaces/TextTrackCue/track.html#parsed cue',
    'interfaces/TextTrackList/onremovetrack.html',
    'autoplay-with-broken-track.html',
    'ready-states/autoplay-with-slow-text-tracks.html',
    `${track}cloneNode.html`,
    `${track}cors/*`,
    `${track}crashtests/*`,
    `${track}src-clear-cues.html`,
    `${track}src-empty-string.html`,
    `${track}track-api-texttracks.html`,
    `${track}track-cue-mutable-fragment.html`,
    `${track}track-cue-order.html`,
    `${track}track-cues-sorted-before-dispatch.html#a file`,
    `${track}track-data-url.html`,
    `${track}track-default-attribute.html`,
    `${track}track-delete-during-setup.html`,
    `${track}track-element-*`,
    `${track}track-id.html`,
    `${track}track-insert-after-load.html`,
    `${track}track-large-timestamp.html`,
    `${track}track-load-*`,
    `${track}track-mode-triggers-loading.html`,
    `${track}track-node-add-remove.html`,
    `${track}track-remove-by-setting-innerHTML.html`,
    `${track}track-remove-insert-ready-state.html`,
    `${track}track-remove-quickly.html`,
    `${track}track-remove-track*`,
    `${track}track-selection-*`,
    `${track}track-texttracks.html`,
    `${track}vtt-cue-float-precision.html`,
  ),
  ...because(
    CUES,
    'interfaces/TextTrackCue/constructor.html',
    'interfaces/TextTrackCue/endTime.html',
    'interfaces/TextTrackCue/id.html',
    'interfaces/TextTrackCue/onenter.html',
    'interfaces/TextTrackCue/onexit.html',
    'interfaces/TextTrackCue/pauseOnExit.html',
    'interfaces/TextTrackCue/startTime.html',
    `${track}track-add-remove-cue.html`,
    `${track}track-cue-gc.html`,
    `${track}track-cue-inline.html`,
    `${track}track-cue-mutable.html`,
  ),
  ...because(OTHERS, 'interfaces/TrackEvent/*', 'historical.html#MediaController', 'historical.html#TextTrackCue constructor'),
  ...because(
    SHOWN,
    `${track}track-cue-rendering-after*`,
    `${track}track-cue-rendering-h*`,
    `${track}track-cue-rendering-l*`,
    `${track}track-cue-rendering-t*`,
    `${track}track-webvtt-*`,
  ),
  ...because(
    FILES,
    'canPlayType_application_octet_stream_with_codecs_*',
    'canPlayType_codecs_order_*',
    'canPlayType_two_implies_one_*',
    'mime-types/canPlayType.html#with codecs',
    'playing-the-media-resource/fragmented-mp4-end.html',
    'media_fragment_seek.html',
    'error-sequence.html#with a source buffer',
    '/mediacapture-fromelement/testRecordingMediaFragmentsWithMediaSourceAndMediaRecorder.html',
    '/mediacapture-fromelement/cross-origin.html',
  ),
  ...because(
    'plays what is not a story: streams, blobs and media sources',
    'src_object_blob.html',
    '/video-rvfc/request-video-frame-callback-webrtc.https.html',
    `${pip}mediastream.https.html`,
  ),
  ...because(
    FRAMES,
    'autoplay-allowed-by-feature-policy*',
    'autoplay-default-feature-policy.https.sub.html',
    'autoplay-disabled-by-feature-policy*',
    'autoplay-supported-by-permissions-policy.html',
    '/audio-output/setSinkId-detachedContext.html',
  ),
  ...because(POSTERS, `${video}posterloading/*`, `${video}video-poster-*`, `${video}video_content_*`, `${video}video_dynamic_poster_*`),
  ...because(LAZY, `${video}video-loading-*`, `${audio}audio-loading-*`),
  ...because(
    HAND,
    'audio_controls_present-manual.html',
    'audio_muted_overriding_volume-manual.html',
    'audio_muted_present-manual.html',
    'audio_volume_loudest-manual.html',
    'audio_volume_silent-manual.html',
    'video_controls_present-manual.html',
    'video_muted_overriding_volume-manual.html',
    'video_muted_present-manual.html',
    'video_volume_loudest-manual.html',
    'video_volume_silent-manual.html',
    'preserves-pitch.html#pitch of a tone',
  ),
  ...because('the same as the audio row, of `<video>`', 'video_loop_base.html', 'video_muted_check.html', 'video_volume_check.html'),
  ...because('content of an `<audio>` that browsers without it would show', `${audio}audio_001.htm`, `${audio}audio_002.htm`),
  ...because('the size of the element is the page’s, by CSS', `${video}intrinsic_sizes.htm#sizes of files`, `${video}resize-during-playback.html`),
  ...because('where the focus goes is tested in access.ts by all pages', `${video}video-tabindex.html`),
  ...because('clicks on `MediaController`, which is gone from the specification', 'user-interface/activation-behavior.html'),
  ...because('a proposal: no browser is muted by its speed', 'user-interface/muted-playbackrate.tentative.html'),
  ...because('a proposal of one browser’s menu, whose entries are about files; the player has controls of its own, and parts to hide', 'controlsList.tentative.html'),
  ...because('`remote` sends the address of a sound or a film to another device; a story is performed by the page', '/remote-playback/*'),
  ...because('optional: a hidden element may wait', 'ready-states/autoplay-hidden*'),
  ...because('an element without a window has no clock and no scripts of its own', 'playing-the-media-resource/play-in-detached-document.html'),
  ...because(
    'the window belongs to a `<video>` within the player’s shadow root',
    `${pip}css-selector.html`,
    `${pip}shadow-dom.html`,
    `${pip}idlharness.window.js`,
    `${pip}request-picture-in-picture.html#a user gesture is required`,
    `${pip}request-picture-in-picture-twice.html`,
    `${pip}request-picture-in-picture.html#audio only`,
    `${pip}leave-picture-in-picture-disable-attribute.optional.html`,
  ),
  ...because('only its members, which the rows ask for one by one', '/audio-output/idlharness*', '/mediacapture-fromelement/idlharness.html'),
  ...because('a device of a real machine', '/audio-output/setSinkId.https.html#devices exposed by getUserMedia'),
];
