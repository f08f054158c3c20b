import '../../../viewer/src/style.css';
import './style.css';
import { element } from '../../../viewer/src/element.js';
import { fillHelp } from '../../../viewer/src/help.js';
import { Theme } from '../../../viewer/src/theme.js';
import { App } from './app.js';
import { compiledProgram, licences } from './embedded.js';
import { filesOfDrop, filesOfList } from './input_files.js';
import { Program } from './program.js';
import { fillSamples } from './samples.js';

const byId = (id) => document.getElementById(id);

/** Places what this page has beside the elements of the viewer. */
function arrange() {
  byId('panel').prepend(byId('task'), byId('places'));
  byId('stage').append(byId('part-card'));
  document.querySelector('header h1').after(element('button', { id: 'open', title: 'Open another mesh (O)' }, 'Open…'));
}

function listenToFiles(app) {
  const choose = () => byId('file-input').click();
  byId('choose').addEventListener('click', choose);
  byId('open').addEventListener('click', choose);
  byId('file-input').addEventListener('change', ({ target }) => {
    if (target.files.length) app.open(filesOfList(target.files));
    target.value = '';  // the same file may be chosen again
  });
  let depth = 0;  // of elements that something is dragged over
  const over = (change) => {
    depth = Math.max(0, change);
    document.body.classList.toggle('dragged-over', depth > 0);
  };
  const isOfFiles = (event) => [...event.dataTransfer?.types ?? []].includes('Files');
  addEventListener('dragenter', (event) => { if (isOfFiles(event)) over(depth + 1); });
  addEventListener('dragleave', (event) => { if (isOfFiles(event)) over(depth - 1); });
  addEventListener('dragover', (event) => { if (isOfFiles(event)) event.preventDefault(); });
  addEventListener('drop', async (event) => {
    if (!isOfFiles(event)) return;
    event.preventDefault();
    over(0);
    app.open(await filesOfDrop(event.dataTransfer));
  });
}

const theme = new Theme();
const app = new App(new Program(compiledProgram()), theme);
arrange();
listenToFiles(app);
fillSamples(byId('samples'), (name) => app.openSample(name));
fillHelp(byId('help'), unsnarlVersion, [
  ['O', 'open another mesh'],
  ['H', 'hold the component of the picked face still, or let it go'],
  ['G', 'repair'],
]);
const licenceText = element('pre', { tabindex: 0, 'aria-label': 'Licences' });
byId('help').querySelector('.fine').append(element('details', { ontoggle: async () => { licenceText.textContent = await licences(); } },
  element('summary', {}, 'Licences of what is in it'), licenceText));
addEventListener('keydown', (event) => {
  if (app.viewer || event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key === 'o') byId('file-input').click();
  if (event.key === 't') theme.toggle();
  if (event.key === '?') byId('help').showModal();
});
window.unsnarl = app;  // for the console
