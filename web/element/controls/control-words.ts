/** Texts of a player's controls, in the language of the surrounding page. */

export interface ControlWords {
  readonly player: string;
  readonly play: string;
  readonly pause: string;
  readonly playAgain: string;
  readonly playStory: string;
  readonly playStoryAgain: string;
  readonly seek: string;
  readonly of: (position: string, duration: string) => string;
  readonly mute: string;
  readonly soundOn: string;
  readonly volume: string;
  readonly percent: (percent: number) => string;
  readonly speed: string;
  readonly captions: string;
  readonly captionsOn: string;
  readonly captionsOff: string;
  /** Choice of no captions, in a list that is named as captions. */
  readonly noCaptions: string;
  readonly fullScreen: string;
  readonly leaveFullScreen: string;
  /** The key in a tip. */
  readonly space: string;
  readonly loading: string;
  readonly gettingReady: string;
  readonly untold: string;
  readonly tryAgain: string;
  readonly pictureLost: string;
  readonly filmShown: string;
  readonly bringingBack: string;
  readonly bringBack: string;
  readonly tryToDraw: string;
  readonly playing: string;
  readonly paused: string;
  readonly ended: string;
  readonly notStarted: string;
  readonly pressPlay: string;
}

const EN: ControlWords = {
  player: 'Player',
  play: 'Play',
  pause: 'Pause',
  playAgain: 'Play again',
  playStory: 'Play the story',
  playStoryAgain: 'Play the story again',
  seek: 'Seek',
  of: (position, duration) => `${position} of ${duration}`,
  mute: 'Mute',
  soundOn: 'Sound on',
  volume: 'Volume',
  percent: (percent) => `${percent} percent`,
  speed: 'Speed',
  captions: 'Captions',
  captionsOn: 'Captions on',
  captionsOff: 'Captions off',
  noCaptions: 'Off',
  fullScreen: 'Full screen',
  leaveFullScreen: 'Leave full screen',
  space: 'space',
  loading: 'Loading the story',
  gettingReady: 'The storyteller is getting ready…',
  untold: 'The story cannot be played',
  tryAgain: 'Try again',
  pictureLost: 'The picture was lost; the story continues with sound and captions.',
  filmShown: 'Rendering is not possible here; a film of the story is shown.',
  bringingBack: 'Restoring it…',
  bringBack: 'Restore it',
  tryToDraw: 'Try to render it',
  playing: 'Playing',
  paused: 'Paused',
  ended: 'The story has ended',
  notStarted: 'The story could not be started',
  pressPlay: 'Press play to begin',
};

const PT: ControlWords = {
  player: 'Leitor',
  play: 'Reproduzir',
  pause: 'Pausa',
  playAgain: 'Reproduzir outra vez',
  playStory: 'Ouvir a história',
  playStoryAgain: 'Ouvir a história outra vez',
  seek: 'Procurar',
  of: (position, duration) => `${position} de ${duration}`,
  mute: 'Sem som',
  soundOn: 'Com som',
  volume: 'Volume',
  percent: (percent) => `${percent} por cento`,
  speed: 'Velocidade',
  captions: 'Legendas',
  captionsOn: 'Com legendas',
  captionsOff: 'Sem legendas',
  noCaptions: 'Desligadas',
  fullScreen: 'Ecrã inteiro',
  leaveFullScreen: 'Sair do ecrã inteiro',
  space: 'espaço',
  loading: 'A carregar a história',
  gettingReady: 'Quem conta está a preparar-se…',
  untold: 'A história não pode ser contada',
  tryAgain: 'Tentar outra vez',
  pictureLost: 'A imagem perdeu-se; a história continua com som e legendas.',
  filmShown: 'Aqui não se pode desenhar; mostra-se um filme da história.',
  bringingBack: 'A trazê-la de volta…',
  bringBack: 'Trazê-la de volta',
  tryToDraw: 'Tentar desenhar',
  playing: 'A contar',
  paused: 'Em pausa',
  ended: 'A história acabou',
  notStarted: 'A história não pôde começar',
  pressPlay: 'Carregue em reproduzir para começar',
};

const DE: ControlWords = {
  player: 'Player',
  play: 'Abspielen',
  pause: 'Pause',
  playAgain: 'Noch einmal abspielen',
  playStory: 'Die Geschichte abspielen',
  playStoryAgain: 'Die Geschichte noch einmal abspielen',
  seek: 'Stelle',
  of: (position, duration) => `${position} von ${duration}`,
  mute: 'Stumm',
  soundOn: 'Ton an',
  volume: 'Lautstärke',
  percent: (percent) => `${percent} Prozent`,
  speed: 'Tempo',
  captions: 'Untertitel',
  captionsOn: 'Untertitel an',
  captionsOff: 'Untertitel aus',
  noCaptions: 'Aus',
  fullScreen: 'Vollbild',
  leaveFullScreen: 'Vollbild verlassen',
  space: 'Leertaste',
  loading: 'Die Geschichte wird geladen',
  gettingReady: 'Gleich wird erzählt…',
  untold: 'Die Geschichte kann nicht erzählt werden',
  tryAgain: 'Noch einmal versuchen',
  pictureLost: 'Das Bild ist verloren; die Geschichte geht mit Ton und Untertiteln weiter.',
  filmShown: 'Hier kann kein Bild gezeichnet werden; ein Film der Geschichte wird gezeigt.',
  bringingBack: 'Es wird zurückgeholt…',
  bringBack: 'Zurückholen',
  tryToDraw: 'Zeichnen versuchen',
  playing: 'Es wird erzählt',
  paused: 'Pause',
  ended: 'Die Geschichte ist zu Ende',
  notStarted: 'Die Geschichte konnte nicht beginnen',
  pressPlay: 'Zum Beginnen auf Abspielen drücken',
};

const LANGUAGES: { readonly [language: string]: ControlWords | undefined } = { en: EN, pt: PT, de: DE };

/** Returns the texts of a language, a BCP 47 tag; English if there are none. */
export const controlWords = (language: string): ControlWords => LANGUAGES[language.toLowerCase().split('-')[0] ?? ''] ?? EN;
