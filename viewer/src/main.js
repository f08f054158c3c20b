import './style.css';
import { fillHelp } from './help.js';
import { listenToKeys } from './keyboard.js';
import { readPage } from './page_data.js';
import { Theme } from './theme.js';
import { Viewer } from './viewer.js';

try {
  const began = performance.now();
  const viewer = new Viewer(await readPage(document), new Theme());
  listenToKeys(viewer);
  fillHelp(document.getElementById('help'), viewer.page.scene.version);
  viewer.loadSeconds = (performance.now() - began) / 1000;
  window.unsnarl = viewer;  // for the console
} catch (error) {
  const failure = document.getElementById('failure');
  failure.hidden = false;
  failure.textContent = /webgl/i.test(error.message)
    ? 'This browser cannot draw: WebGL is switched off or missing.' : `This page cannot be shown: ${error.message}`;
  console.error(error);
}
