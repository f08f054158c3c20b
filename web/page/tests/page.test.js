// Uses the page as people do, in a browser without a display: from the disk, and from a server.
// Environment: UNSNARL_PAGE, the page; UNSNARL_PROGRAM, the program, whose bytes the page must give; CHROMIUM, the browser;
// UNSNARL_PICTURES (optional), a folder for pictures of every state.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { inEveryFormat } from './mesh_files.js';

const { chromium } = createRequire(new URL('../../../viewer/package.json', import.meta.url))('playwright-core');
const program = process.env.UNSNARL_PROGRAM;
const pictures = process.env.UNSNARL_PICTURES;
const folder = mkdtempSync(join(tmpdir(), 'unsnarl-browser-'));
const at = (...names) => join(folder, ...names);
const fromDisk = pathToFileURL(process.env.UNSNARL_PAGE).href;
const phone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 };

let browser;
let page;
let server;
const complaints = [];

/** Runs the program here; its exit code may be any. */
function native(args, cwd = folder) {
  const run = spawnSync(program, args, { cwd, encoding: 'utf8' });
  assert.equal(run.error, undefined);
  return run;
}

function sample(name, file, resolution = 0) {
  execFileSync(program, ['sample', name, '-o', at(file), '--resolution', String(resolution)]);
  return at(file);
}

/** A fresh page; complaints of the browser and what it asks the network for are collected. */
async function newPage(address = fromDisk, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  const opened = await context.newPage();
  opened.on('pageerror', (error) => complaints.push(error.message));
  opened.on('console', (message) => {
    if (['error', 'warning'].includes(message.type()) && !message.text().includes('GPU stall due to ReadPixels'))
      complaints.push(message.text());
  });
  opened.on('request', (request) => {
    if (/^(https?|wss?):/.test(request.url()) && request.url() !== address) complaints.push(`asks the network for ${request.url()}`);
  });
  await opened.goto(address);
  return opened;
}

const isShown = (opened = page) => opened.waitForFunction(() => window.unsnarl.viewer);
const statusOf = (opened = page) => opened.locator('#status').textContent();

/** Gives these files to the page, and waits until the first of them, or one of that name, is shown. */
async function give(paths, name = paths[0].split('/').at(-1), opened = page) {
  await opened.locator('#file-input').setInputFiles(paths);
  await opened.waitForFunction((words) => window.unsnarl.viewer?.page.scene.input.includes(words), name);
  await opened.locator('#busy').waitFor({ state: 'hidden' });
}

async function repair(opened = page) {
  await opened.locator('#repair').click();
  await opened.locator('#verdict').waitFor({ timeout: 120000 });
}

/** The bytes of the file of this name that the page offers. */
async function downloaded(name, opened = page) {
  const [download] = await Promise.all([
    opened.waitForEvent('download'),
    opened.locator('#downloads a').and(opened.locator(`[download="${name}"]`)).click(),
  ]);
  return readFileSync(await download.path());
}

async function picture(name, opened = page, options = {}) {
  if (!pictures) return;
  mkdirSync(pictures, { recursive: true });
  await opened.waitForTimeout(300);
  await opened.screenshot({ path: join(pictures, `${name}.png`), ...options });
}

before(async () => {
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM,
    args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
      '--disable-component-update', '--disable-sync', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });
  const isolated = { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };
  server = createServer(({ url }, response) => {
    response.writeHead(200, { 'Content-Type': 'text/html', ...url === '/isolated' ? isolated : {} });
    response.end(readFileSync(process.env.UNSNARL_PAGE));
  });
  await new Promise((ready) => { server.listen(0, '127.0.0.1', ready); });
  page = await newPage();
}, { timeout: 60000 });

after(async () => {
  await browser?.close();
  server?.close();
  rmSync(folder, { recursive: true, force: true });
});

const served = (path) => `http://127.0.0.1:${server.address().port}${path}`;

test('the empty page says what it is for, and that nothing leaves the computer', async () => {
  await picture('empty');
  assert.match(await page.locator('#start').textContent(), /Nothing leaves your computer/);
  for (const format of ['OBJ', 'OFF', 'PLY', 'STL', 'glTF', 'GLB', '3MF', 'VTK', 'VTP', 'FreeSurfer', 'GIFTI', 'Gmsh', 'Abaqus'])
    assert.ok((await page.locator('#drop').textContent()).includes(format), format);
  assert.equal(await page.locator('main').isVisible(), false);
});

test('the page may not connect to anything', async () => {
  const opened = await newPage(served('/'));
  const refused = await opened.evaluate((url) => fetch(url).then(() => false, () => true), served('/other'));
  assert.ok(refused, 'its own server answered');
  complaints.splice(0, complaints.length, ...complaints.filter((words) => !/violates|Refused to connect|\/other/.test(words)));
  await opened.context().close();
});

test('a sample is shown with its intersections, repaired, and taken home', async () => {
  await page.locator('[data-sample=crossing_tubes]').click();
  await isShown();
  assert.equal(await statusOf(), '116 intersecting pairs');
  await page.locator('#places').getByText('Place 1').click();
  assert.match(await page.locator('#places').textContent(), /1 place.*116 pairs, 116 faces/);
  assert.ok(await page.evaluate(() => window.unsnarl.viewer.before.isRed[window.unsnarl.viewer.state.face] === 1));
  await page.keyboard.press('Escape');
  await page.keyboard.press('f');
  await picture('loaded');
  await repair();
  assert.match(await page.locator('#verdict').textContent(), /Repaired: nothing intersects any more/);
  assert.equal(await statusOf(), 'Embedded');
  await picture('repaired');
  sample('crossing_tubes', 'crossing_tubes.obj');
  native(['fix', 'crossing_tubes.obj', '-o', 'crossing_tubes_fixed.obj', '-q']);
  assert.deepEqual(await downloaded('crossing_tubes_fixed.obj'), readFileSync(at('crossing_tubes_fixed.obj')));
  const report = JSON.parse(await downloaded('crossing_tubes_report.json'));
  assert.equal(report.schema, 'unsnarl-report');
  assert.equal(report.status, 'embedded');
  writeFileSync(at('taken.html'), await downloaded('crossing_tubes.html'));
  const kept = await browser.newPage();
  await kept.goto(pathToFileURL(at('taken.html')).href);
  await kept.waitForFunction(() => window.unsnarl);
  assert.equal(await kept.locator('#status').textContent(), 'Embedded');
  await kept.close();
});

test('before, after and displacement are those of the viewer', async () => {
  const layouts = page.locator('#layout button');
  assert.deepEqual(await layouts.allTextContents(), ['Side by side', 'Divider', 'Blend', 'Iterations']);
  await page.keyboard.press('3');
  await page.locator('#slider').fill('1');
  await page.keyboard.press('d');
  assert.match(await page.locator('#legend').textContent(), /Displacement of the diagonal/);
  await picture('displacement');
  await page.keyboard.press('c');
  await page.keyboard.press('1');
});

test('every format is read and repaired, with the bytes of the program', async () => {
  sample('intersecting_spheres', 'spheres.obj', 16);
  for (const [format, files] of Object.entries(inEveryFormat(readFileSync(at('spheres.obj'))))) {
    mkdirSync(at(format, 'fixed'), { recursive: true });
    for (const [name, bytes] of Object.entries(files)) writeFileSync(at(format, name), bytes);
    const [name] = Object.keys(files);
    const fixed = name.replace(/\.[^.]*$/, (ending) => `_fixed${ending}`);
    assert.equal(native(['fix', name, '-o', `fixed/${fixed}`, '-q'], at(format)).status, 0, format);
    await give(Object.keys(files).map((own) => at(format, own)));
    assert.equal(await page.evaluate(() => window.unsnarl.viewer.before.count), 178, format);
    await repair();
    assert.deepEqual(await downloaded(fixed), readFileSync(at(format, 'fixed', fixed)), format);
    if (format === 'gltf') assert.deepEqual(await downloaded('mesh.bin'), readFileSync(at(format, 'fixed', 'mesh.bin')), 'buffer');
  }
});

test('several files are a scene, and are repaired as one', async () => {
  for (const [name, shift] of [['left', 0], ['right', 0.7]])
    writeFileSync(at(`${name}.obj`), readFileSync(sample('intersecting_spheres', 'one.obj', 12), 'utf8')
      .replace(/^v (\S+)/gm, (_, x) => `v ${Number(x) + shift}`));
  native(['fix', 'left.obj', 'right.obj', '-o', 'scene', '-q']);
  await give([at('right.obj'), at('left.obj')], 'left.obj, right.obj');
  await page.keyboard.press('n');
  assert.match(await page.locator('#part-card').textContent(), /file (left|right)\.obj/);
  await page.keyboard.press('Escape');
  await repair();
  for (const name of ['left.obj', 'right.obj']) assert.deepEqual(await downloaded(name), readFileSync(at('scene', name)), name);
});

test('a texture comes with its mesh', async () => {
  writeFileSync(at('painted.png'), Buffer.from('iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAFklEQVR42mNgOMHwn4Hhzn8mBghgBAAuAQOmCHWyvQAAAABJRU5ErkJggg==', 'base64'));
  writeFileSync(at('painted.mtl'), 'newmtl painted\nmap_Kd painted.png\n');
  writeFileSync(at('painted.obj'), 'mtllib painted.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.2 -1\nv 0.3 0.2 1\nv 0.2 0.3 1\nvt 0 0\nvt 1 0\nvt 0 1\n'
    + 'usemtl painted\nf 1/1 2/2 3/3\nf 4/1 5/2 6/3\n');
  await give(['painted.obj', 'painted.mtl', 'painted.png'].map((name) => at(name)), 'painted.obj');
  assert.equal(await page.evaluate(() => window.unsnarl.viewer.state.colouring), 'texture');
});

test('a part that is clicked is held still', async () => {
  sample('dressed_figure', 'figure.obj');
  await give([at('figure.obj')]);
  const spot = await page.evaluate(() => {
    // In the middle of the triangle nearest to the eye.
    const { page: data, stage } = window.unsnarl.viewer;
    stage.draw();
    const p = stage.camera.position.clone();
    let best = { distance: Infinity };
    for (let t = 0; t < data.triangles.length; t += 3) {
      const middle = [0, 1, 2].map((k) => [0, 1, 2].reduce((sum, c) => sum + data.before.positions[3 * data.triangles[t + c] + k] / 3, 0));
      const distance = p.fromArray(middle).distanceTo(stage.camera.position);
      if (distance < best.distance) best = { distance, at: p.clone().project(stage.camera) };
    }
    const box = stage.canvas.getBoundingClientRect();
    return { x: box.left + (best.at.x + 1) / 2 * box.width, y: box.top + (1 - best.at.y) / 2 * box.height };
  });
  await page.mouse.click(spot.x, spot.y);
  const object = page.locator('#part-card button', { hasText: 'object' });
  const part = (await object.textContent()).replace('object ', '');
  await object.click();
  assert.equal(await object.getAttribute('aria-pressed'), 'true');
  assert.equal(await page.locator('#held li').count(), 1);
  assert.ok((await page.locator('#legend').textContent()).includes('held still'));
  await picture('held');
  native(['fix', 'figure.obj', '-o', 'figure_held.obj', '-q', `--fix-object=${part}`]);
  await repair();
  assert.deepEqual(await downloaded('figure_fixed.obj'), readFileSync(at('figure_held.obj')));
  await page.locator('#held button').click();
  assert.equal(await page.locator('#held li').count(), 0);
  native(['fix', 'figure.obj', '-o', 'figure_free.obj', '-q']);
  await repair();
  assert.deepEqual(await downloaded('figure_fixed.obj'), readFileSync(at('figure_free.obj')));
  assert.notDeepEqual(readFileSync(at('figure_held.obj')), readFileSync(at('figure_free.obj')));
});

test('gap and limits are those of the program', async () => {
  await give([sample('crossing_tubes', 'tubes.obj', 20)]);
  await page.locator('#more summary').click();
  await page.locator('#gap').fill('0.5');
  await page.locator('#hold-boundary').check();
  native(['fix', 'tubes.obj', '-o', 'tubes_gap.obj', '-q', '--min-gap', '0.005', '--fix-boundary']);
  await repair();
  assert.deepEqual(await downloaded('tubes_fixed.obj'), readFileSync(at('tubes_gap.obj')));
  await page.locator('#hold-boundary').uncheck();
  await page.locator('#gap').fill('');
  await give([at('figure.obj')]);
  await page.locator('#most-motion').fill('0.004');
  await page.locator('#unit').selectOption('absolute');
  const limited = native(['fix', 'figure.obj', '-o', 'figure_near.obj', '-q', '--max-displacement', '0.004', '--absolute']);
  assert.equal(limited.status, 5);
  await repair();
  assert.match(await page.locator('#verdict').textContent(), /Stopped at the largest move.*Allow larger moves/);
  assert.deepEqual(await downloaded('figure_fixed.partial.obj'), readFileSync(at('figure_near.partial.obj')));
  await picture('left');
  await page.locator('#most-motion').fill('-1');
  await page.locator('#repair').click();
  assert.equal(await page.locator('#running').isVisible(), false, 'a wrong number starts nothing');
  await page.locator('#most-motion').fill('');
  await page.locator('#unit').selectOption('percent');
});

test('what intersects nothing comes back as it was', async () => {
  await give([at('figure_free.obj')]);
  assert.equal(await statusOf(), 'No self-intersections');
  assert.equal(await page.locator('#places').isVisible(), false);
  await repair();
  assert.match(await page.locator('#verdict').textContent(), /There was nothing to repair/);
  assert.deepEqual(await downloaded('figure_free_fixed.obj'), readFileSync(at('figure_free.obj')));
});

test('a repair shows how far it is, and is cancelled', async () => {
  await give([sample('medusa', 'medusa.obj', 100)]);
  await page.locator('#repair').click();
  await page.getByText(/intersecting pairs? left/).waitFor({ timeout: 60000 });
  await picture('repairing');
  assert.equal(await page.locator('#repair').isVisible(), false);
  await page.locator('#cancel').click();
  await page.locator('#verdict').waitFor();
  assert.match(await page.locator('#verdict').textContent(), /Cancelled.*Nothing was changed/);
  assert.equal(await page.locator('#repair').isVisible(), true);
  await give([at('tubes.obj')]);
  await repair();
  assert.match(await page.locator('#verdict').textContent(), /Repaired/);
});

test('where the page may share memory, cancelling keeps what was reached', async () => {
  const opened = await newPage(served('/isolated'));
  assert.ok(await opened.evaluate(() => crossOriginIsolated));
  await give([at('medusa.obj')], 'medusa.obj', opened);
  await opened.locator('#repair').click();
  await opened.getByText(/intersecting pairs? left/).waitFor({ timeout: 60000 });
  await opened.locator('#cancel').click();
  await opened.locator('#verdict').waitFor({ timeout: 60000 });
  assert.match(await opened.locator('#verdict').textContent(), /^Cancelled: /);
  assert.equal(JSON.parse(await downloaded('medusa_report.json', opened)).status, 'cancelled');
  await give([at('tubes.obj')], 'tubes.obj', opened);
  await repair(opened);
  assert.match(await opened.locator('#verdict').textContent(), /Repaired/);
  await opened.context().close();
});

test('a server gives the same page', async () => {
  const opened = await newPage(served('/'));
  await give([at('tubes.obj')], 'tubes.obj', opened);
  native(['fix', 'tubes.obj', '-o', 'tubes_plain.obj', '-q']);
  await repair(opened);
  assert.deepEqual(await downloaded('tubes_fixed.obj', opened), readFileSync(at('tubes_plain.obj')));
  await opened.context().close();
});

test('files are dropped on it', async () => {
  const opened = await newPage();
  const drop = (names) => opened.evaluate(async (given) => {
    const transfer = new DataTransfer();
    for (const [name, text] of given) transfer.items.add(new File([text], name));
    for (const type of ['dragenter', 'dragover', 'drop']) {
      document.body.dispatchEvent(new DragEvent(type, { bubbles: true, cancelable: true, dataTransfer: transfer }));
      if (type === 'dragover' && !document.body.classList.contains('dragged-over')) throw new Error('no sign of where to drop');
    }
  }, names.map((name) => [name, readFileSync(at(name), 'utf8')]));
  await drop(['tubes.obj']);
  await isShown(opened);
  assert.match(await statusOf(opened), /intersecting pairs/);
  assert.equal(await opened.evaluate(() => document.body.classList.contains('dragged-over')), false);
  await opened.context().close();
});

test('what cannot be read is named, with what to do, and nothing is lost', async () => {
  const opened = await newPage();
  const trouble = opened.locator('#trouble');
  const refused = async (files) => {
    for (const [name, text] of Object.entries(files)) writeFileSync(at(name), text);
    await opened.locator('#file-input').setInputFiles(Object.keys(files).map((name) => at(name)));
    await trouble.waitFor();
    const words = await trouble.textContent();
    await trouble.getByRole('button', { name: 'Dismiss' }).click();
    assert.equal(await trouble.isVisible(), false);
    return words;
  };
  assert.match(await refused({ 'bad.obj': 'v 0 0 0\nf 1 2 3\n' }), /bad\.obj cannot be read.*line 2: face 1 uses vertex 3/);
  assert.match(await refused({ 'notes.txt': 'hello\n' }), /notes\.txt cannot be read.*Formats: OBJ/);
  assert.match(await refused({ 'mesh.zip': 'PK' }), /mesh\.zip cannot be read.*Unpack it/);
  assert.match(await refused({ 'only.mtl': 'newmtl a\n' }), /no mesh.*Drop the mesh together with it/);
  const gltf = inEveryFormat(readFileSync(at('spheres.obj'))).gltf['mesh.gltf'];
  assert.match(await refused({ 'alone.gltf': gltf }), /alone\.gltf cannot be read.*mesh\.bin.*Drop the missing file together/);
  assert.ok(await opened.locator('#start').isVisible());
  await opened.locator('#file-input').setInputFiles(at('bad.obj'));
  await trouble.waitFor();
  await picture('error', opened);
  await give([at('tubes.obj')], 'tubes.obj', opened);
  assert.equal(await trouble.isVisible(), false, 'the next file has no trouble');
  await refused({ 'bad.obj': 'v 0 0 0\nf 1 2 3\n' });
  assert.equal(await opened.evaluate(() => window.unsnarl.viewer.page.scene.input), 'tubes.obj');
  await repair(opened);
  assert.match(await opened.locator('#verdict').textContent(), /Repaired/);
  await opened.context().close();
  complaints.length = 0;
});

test('everything is done with the keyboard', async () => {
  const opened = await newPage();
  const chosen = opened.waitForEvent('filechooser');
  await opened.evaluate(() => {});  // the browser knows by now that the test waits
  await opened.keyboard.press('o');
  await (await chosen).setFiles(at('tubes.obj'));
  await isShown(opened);
  await opened.keyboard.press('n');
  await opened.keyboard.press('h');
  assert.equal(await opened.locator('#held li').textContent(), 'component 0✕');
  await opened.keyboard.press('g');
  await opened.locator('#verdict').waitFor({ timeout: 60000 });
  await opened.keyboard.press('?');
  assert.match(await opened.locator('#help').textContent(), /G\s*repair/);
  await opened.locator('#help summary').click();
  await opened.locator('#help pre', { hasText: 'three.js' }).waitFor();
  await opened.keyboard.press('Escape');
  await opened.context().close();
});

test('everything that can be used has a name', async () => {
  for (const selector of ['button', 'input:not([type=file])', 'select', 'a', 'canvas', 'progress']) {
    const nameless = await page.locator(selector).evaluateAll((nodes) => nodes.filter((node) =>
      !(node.getAttribute('aria-label') || node.textContent.trim() || node.labels?.length || node.title)).map((node) => node.outerHTML));
    assert.deepEqual(nameless, [], selector);
  }
});

test('a phone has all of it', async () => {
  for (const [name, options] of [['phone', phone], ['phone_dark', { ...phone, colorScheme: 'dark' }]]) {
    const opened = await newPage(fromDisk, options);
    const isNarrow = () => opened.evaluate(() => document.documentElement.scrollWidth <= innerWidth);
    assert.ok(await isNarrow());
    await picture(`${name}_empty`, opened);
    await opened.locator('[data-sample=anchored_balls]').tap();
    await isShown(opened);
    assert.ok(await isNarrow());
    assert.equal(await opened.evaluate(() => scrollY), 0, 'the drawing is in sight');
    await picture(`${name}_loaded`, opened);
    const canvas = await opened.locator('#canvas').boundingBox();
    await opened.touchscreen.tap(canvas.x + canvas.width / 2, canvas.y + canvas.height / 2);
    await opened.locator('#part-card button', { hasText: 'component' }).tap();
    assert.equal(await opened.locator('#held li').count(), 1);
    await picture(`${name}_held`, opened);
    await opened.locator('#repair').tap();
    await opened.locator('#verdict').waitFor({ timeout: 60000 });
    assert.ok(await isNarrow());
    await picture(`${name}_repaired`, opened, { fullPage: true });
    await opened.context().close();
  }
});

test('it is dark where the system is', async () => {
  const opened = await newPage(fromDisk, { colorScheme: 'dark' });
  const isDark = () => opened.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).every((c) => Number(c) < 60));
  assert.ok(await isDark());
  await picture('dark_empty', opened);
  await opened.locator('[data-sample=dressed_figure]').click();
  await isShown(opened);
  await repair(opened);
  await picture('dark_repaired', opened);
  await opened.getByRole('button', { name: 'Light or dark' }).click();
  assert.ok(!await isDark());
  await opened.context().close();
});

test('how long it takes from a file to its picture (told, not judged)', async (t) => {
  for (const resolution of [56, 240]) {
    await give([sample('medusa', `medusa_${resolution}.obj`, resolution)]);
    const { faces, seconds } = await page.evaluate(() => ({ faces: window.unsnarl.viewer.page.scene.faces, seconds: window.unsnarl.firstPictureSeconds }));
    t.diagnostic(`${faces} faces: ${seconds.toFixed(2)} s`);
  }
});

test('the browser had nothing to complain about', () => assert.deepEqual(complaints, []));
