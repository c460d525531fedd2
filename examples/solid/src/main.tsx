import { render } from 'solid-js/web';
import { App } from './app';

const place = document.getElementById('app');
if (place) render(() => <App />, place);
