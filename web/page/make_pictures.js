// Makes the pictures of the samples (src/samples) and of docs/browser.md anew, with the page itself:
//   node web/page/make_pictures.js out/browser/unsnarl.html /usr/bin/chromium
import { mkdirSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath, pathToFileURL } from 'node:url';

const { chromium } = createRequire(new URL('../../viewer/package.json', import.meta.url))('playwright-core');
const at = (path) => fileURLToPath(new URL(path, import.meta.url));
const [file, executablePath] = process.argv.slice(2);

const browser = await chromium.launch({ executablePath, args: ['--no-sandbox', '--disable-gpu', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });
const open = async (viewport) => {
  const page = await browser.newPage({ viewport });
  await page.goto(pathToFileURL(file).href);
  return page;
};

const page = await open({ width: 1280, height: 800 });
mkdirSync(at('src/samples'), { recursive: true });
const names = await page.locator('#samples button').evaluateAll((buttons) => buttons.map(({ dataset }) => dataset.sample));
await page.close();
for (const name of names) {
  const small = await open({ width: 400 + 336, height: 264 + 52 + 48 });
  await small.locator(`[data-sample=${name}]`).click();
  await small.waitForFunction(() => window.unsnarl.viewer);
  const text = await small.evaluate(async () => {
    const { viewer } = window.unsnarl;
    document.getElementById('stage').style.cssText = 'position: fixed; width: 400px; height: 264px';
    await new Promise((done) => { setTimeout(done, 300); });
    if (viewer.state.edges) viewer.toggle('edges');
    viewer.stage.showAll();
    return viewer.stage.snapshot().toDataURL('image/webp', 0.8);
  });
  writeFileSync(at(`src/samples/${name}.webp`), Buffer.from(text.split(',')[1], 'base64'));
  await small.close();
}

const shown = await open({ width: 1280, height: 800 });
await shown.locator('[data-sample=dressed_figure]').click();
await shown.waitForFunction(() => window.unsnarl.viewer);
await shown.evaluate(() => window.unsnarl.toggleHeld({ kind: 'object', name: 'body' }));
await shown.locator('#repair').click();
await shown.locator('#verdict').waitFor();
await shown.waitForTimeout(500);
await shown.screenshot({ path: at('../../docs/images/browser.png') });
await browser.close();
