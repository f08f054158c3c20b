// Opens a page that the program wrote, from the disk, in a real browser without a display.
// Environment: UNSNARL_PROGRAM, the program; CHROMIUM, the browser.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

const program = process.env.UNSNARL_PROGRAM;
const folder = mkdtempSync(join(tmpdir(), 'unsnarl-page-'));
const at = (name) => join(folder, name);
const unsnarl = (...args) => execFileSync(program, args, { stdio: ['ignore', 'pipe', 'pipe'] });
/** The name of the input must not end the element that holds it, nor become one. */
const input = 'limb <b>"&amp; $& .obj';

let browser;
let page;
const complaints = [];

async function open(name) {
  await page.goto(pathToFileURL(at(name)).href);
  await page.waitForFunction(() => window.unsnarl || !document.getElementById('failure').hidden);
  assert.equal(await page.locator('#failure').isVisible(), false, await page.locator('#failure').textContent());
}

/** Of the canvas as it is now: the share of its pixels that something is drawn on, of red ones, and a digest. */
function pixels() {
  return page.evaluate(() => {
    const copy = window.unsnarl.stage.snapshot();
    const { data } = copy.getContext('2d').getImageData(0, 0, copy.width, copy.height);
    let drawn = 0, red = 0, digest = 0;
    for (let i = 0; i < data.length; i += 4) {
      if (data[i + 3] > 128) drawn += 1;
      if (data[i + 3] > 128 && data[i] > 120 && data[i + 1] < 0.55 * data[i]) red += 1;
      digest = Math.imul(digest, 31) + data[i] * 65536 + data[i + 1] * 256 + data[i + 2] | 0;
    }
    return { drawn: drawn * 4 / data.length, red: red * 4 / data.length, digest };
  });
}

before(async () => {
  unsnarl('sample', 'posed_limb', '-o', at(input), '--resolution', '40');
  unsnarl('fix', at(input), '-o', at('fixed.obj'), '--view', at('page.html'), '--quiet');
  unsnarl('view', at(input), '-o', at('alone.html'), '--quiet');
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM,
    args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
      '--disable-component-update', '--disable-sync', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });
  page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  page.on('pageerror', (error) => complaints.push(error.message));
  page.on('console', (message) => {
    // The browser's own remark on reading pixels back, which only this test does.
    if (['error', 'warning'].includes(message.type()) && !message.text().includes('GPU stall due to ReadPixels'))
      complaints.push(message.text());
  });
  page.on('request', (request) => {
    if (/^(https?|wss?):/.test(request.url())) complaints.push(`asks the network for ${request.url()}`);
  });
}, { timeout: 120000 });

after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

test('rigid parts are listed with how they moved', async () => {
  unsnarl('sample', 'linked_rings', '-o', at('rings.obj'), '--resolution', '12');
  unsnarl('fix', at('rings.obj'), '-o', at('rings_fixed.obj'), '--rigid-component', '0', '--view', at('rings.html'), '--quiet');
  await open('rings.html');
  const parts = page.locator('section', { has: page.locator('h2', { hasText: 'Rigid parts' }) });
  assert.match(await parts.textContent(), /component 0(at rest|shifted [\d.]+\u202f% \([\d.]+\), turned [\d.]+°)/);
});

test('parts that changed and that overlap are named', async () => {
  unsnarl('sample', 'stool', '-o', at('stool.obj'), '--resolution', '16');
  unsnarl('fix', at('stool.obj'), '-o', at('stool_fixed.obj'), '--view', at('stool.html'), '--report', at('stool.json'), '--quiet');
  await open('stool.html');
  const parts = page.locator('section', { has: page.locator('h2', { hasText: /^Parts$/ }) });
  const report = JSON.parse(readFileSync(at('stool.json'), 'utf8'));
  for (const words of [report.changed_components[0].message, report.advice[0]])
    assert.ok((await parts.textContent()).includes(words), words);
});

test('before and after are drawn side by side, intersections in red', async () => {
  await open('page.html');
  assert.equal(await page.locator('#file-name').textContent(), `${input} → fixed.obj`);
  const { drawn, red } = await pixels();
  assert.ok(drawn > 0.05 && drawn < 0.9, `${drawn} of the canvas is drawn on`);
  assert.ok(red > 0.0003, `${red} of the canvas is red`);
  assert.match(await page.locator('#caption-first').textContent(), /before\d+ intersecting pair/);
  assert.match(await page.locator('#caption-second').textContent(), /afterno self-intersections/);
  assert.equal(await page.locator('#status').textContent(), 'Embedded');
});

test('the slider moves the surface', async () => {
  await page.keyboard.press('3');
  const start = await pixels();
  await page.locator('#slider').fill('0.5');
  const middle = await pixels();
  await page.locator('#slider').fill('1');
  const end = await pixels();
  assert.notEqual(start.digest, middle.digest);
  assert.notEqual(middle.digest, end.digest);
  assert.ok(start.red > 0 && end.red === 0, `red: ${start.red}, then ${end.red}`);
});

test('the divider is dragged between both', async () => {
  await page.keyboard.press('2');
  const stage = await page.locator('#stage').boundingBox();
  const redWithDividerAt = async (share) => {
    const { x, y, width, height } = await page.locator('#divider').boundingBox();
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(stage.x + share * stage.width, y + height / 2, { steps: 3 });
    await page.mouse.up();
    return (await pixels()).red;
  };
  assert.equal(await redWithDividerAt(0.02), 0);
  assert.ok(await redWithDividerAt(0.98) > 0.0003);
});

test('the camera turns by dragging', async () => {
  await page.keyboard.press('1');
  const still = await pixels();
  await page.mouse.move(200, 400);
  await page.mouse.down();
  await page.mouse.move(300, 430, { steps: 4 });
  await page.mouse.up();
  await page.waitForFunction((draws) => window.unsnarl.stage.draws > draws, await page.evaluate(() => window.unsnarl.stage.draws));
  assert.notEqual((await pixels()).digest, still.digest);
  await page.keyboard.press('f');
});

test('quads have the edges of quads', async () => {
  const { edges, quads } = await page.evaluate(() => ({
    edges: window.unsnarl.surface.edges.geometry.index.count / 2,
    quads: window.unsnarl.page.sizes.filter((size) => size === 4).length,
  }));
  assert.ok(quads > 100);
  assert.ok(edges < 2.2 * quads, `${edges} edges of ${quads} quads`);
});

test('displacement has colours and a legend', async () => {
  const before = await pixels();
  await page.keyboard.press('d');
  assert.notEqual((await pixels()).digest, before.digest);
  assert.ok(await page.locator('#legend').isVisible());
  assert.match(await page.locator('#legend .ticks').textContent(), /%/);
  await page.keyboard.press('c');
});

test('the legend says what the colours mean', async () => {
  const entries = () => page.locator('#legend li').allTextContents();
  assert.deepEqual(await entries(), ['intersects another face', 'where faces cross']);
  await page.keyboard.press('n');
  assert.deepEqual((await entries()).slice(2), ['picked face', 'faces that it meets']);
  await page.keyboard.press('Escape');
  await page.keyboard.press('x');
  assert.deepEqual(await entries(), ['intersects another face']);
  await page.keyboard.press('x');
});

test('another axis turns up, and three turns are none', async () => {
  await page.keyboard.press('f');
  const start = await pixels();
  const up = () => page.evaluate(() => window.unsnarl.stage.camera.up.toArray());
  const first = await up();
  await page.keyboard.press('u');
  assert.deepEqual(await up(), [first[2], first[0], first[1]]);
  const turned = await pixels();
  assert.notEqual(turned.digest, start.digest);
  assert.ok(turned.drawn > 0.02);
  await page.keyboard.press('u');
  await page.keyboard.press('u');
  assert.deepEqual(await up(), first);
});

test('a phone has the drawing above and the rest below', async () => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.waitForTimeout(200);
  const box = async (id) => page.locator(id).boundingBox();
  const [stage, panel, header] = [await box('#stage'), await box('#panel'), await box('header')];
  assert.equal(stage.width, 390);
  assert.ok(stage.height > 400 && panel.y >= stage.y + stage.height && panel.width === 390);
  assert.ok(header.width === 390 && await page.evaluate(() => document.documentElement.scrollWidth) <= 390);
  assert.ok((await pixels()).drawn > 0.02);
  const [first, second] = [await box('#caption-first'), await box('#caption-second')];
  assert.ok(second.x === first.x && second.y > first.y + 0.4 * stage.height, 'before above, after below it');
  const side = (await pixels()).drawn;
  await page.keyboard.press('3');
  assert.ok((await pixels()).drawn > side, 'one view alone is shown as large as fits');
  await page.keyboard.press('1');
  if (process.env.PHONE_PICTURE) await page.screenshot({ path: process.env.PHONE_PICTURE });
  await page.setViewportSize({ width: 1280, height: 800 });
  await page.waitForTimeout(200);
});

test('a picked face shows its ids and what it meets', async () => {
  await page.keyboard.press('n');
  const face = Number(await page.locator('#picked-face').textContent());
  const known = await page.evaluate((f) => ({
    vertices: [...window.unsnarl.faces.of(f)].join(', '),
    partners: window.unsnarl.before.partners(f).map((p) => String(p.face)),
  }), face);
  assert.equal(await page.locator('#picked-vertices').textContent(), known.vertices);
  assert.ok(known.partners.length > 0);
  assert.match(await page.locator('#selection').textContent(), /sharing no vertex/);
  assert.match(await page.locator('#selection').textContent(), /component0/);
  assert.deepEqual(await page.locator('#selection .partners').first().locator('button').allTextContents(), known.partners);
  await page.locator('#selection .partners button').first().click();
  assert.equal(await page.locator('#picked-face').textContent(), known.partners[0]);
  await page.getByRole('button', { name: 'next ›' }).click();
  const next = Number(await page.locator('#picked-face').textContent());
  assert.ok(await page.evaluate((f) => window.unsnarl.before.isRed[f] === 1, next));
  await page.getByRole('button', { name: '‹ previous' }).click();
  assert.equal(await page.locator('#picked-face').textContent(), known.partners[0]);
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('#picked-face').count(), 0);
});

test('a click on the surface picks the face under it', async () => {
  await page.keyboard.press('f');
  const spot = await page.evaluate(() => {
    // The middle of a vertex that nothing can hide: the one nearest to the eye.
    const { page: data, stage } = window.unsnarl;
    stage.draw();
    const { positions } = data.before;
    const p = stage.camera.position.clone();
    let best = null;
    for (let i = 0; i < positions.length; i += 3) {
      p.fromArray(positions, i);
      const distance = p.distanceTo(stage.camera.position);
      if (best === null || distance < best.distance) best = { distance, at: p.clone().project(stage.camera), vertex: i / 3 };
    }
    const box = stage.canvas.getBoundingClientRect();
    return { x: box.left + (best.at.x + 1) / 4 * box.width, y: box.top + (1 - best.at.y) / 2 * box.height, vertex: best.vertex };
  });
  await page.mouse.click(spot.x, spot.y);
  const vertices = (await page.locator('#picked-vertices').textContent()).split(', ').map(Number);
  assert.ok(vertices.includes(spot.vertex), `${vertices} should hold ${spot.vertex}`);
});

test('the recorded iterations are scrubbed, and lead from before to after', async () => {
  await page.keyboard.press('4');
  const start = await pixels();
  const last = Number(await page.locator('#slider').getAttribute('max'));
  assert.ok(last > 2, `${last + 1} frames`);
  await page.locator('#slider').fill(String(last));
  const end = await pixels();
  assert.notEqual(end.digest, start.digest);
  assert.ok(start.red > 0 && end.red === 0, `red: ${start.red}, then ${end.red}`);
  const furthest = await page.evaluate(() => {
    const { frames, page: data } = window.unsnarl;
    return Math.max(...frames.positions.map((x, i) => Math.abs(x - data.after.positions[i])));
  });
  assert.ok(furthest < 1e-6, `the last frame is ${furthest} from the result`);
  await page.keyboard.press('ArrowLeft');
  assert.equal(await page.locator('#slider').inputValue(), String(last - 1));
});

test('the history is drawn', async () => {
  assert.ok(await page.locator('#history .chart').count() >= 2);
  assert.match(await page.locator('#history').textContent(), /Intersecting pairs.*Largest step/);
  const [frame] = await page.evaluate(() => [window.unsnarl.state.frame]);
  const chart = await page.locator('#history svg').first().boundingBox();
  await page.mouse.click(chart.x + chart.width / 2, chart.y + chart.height / 2);
  assert.notEqual(await page.evaluate(() => window.unsnarl.state.frame), frame);
  await page.keyboard.press('1');
});

test('light and dark, and help', async () => {
  const theme = () => page.evaluate(() => document.documentElement.dataset.theme);
  const first = await theme();
  await page.keyboard.press('t');
  assert.notEqual(await theme(), first);
  await page.keyboard.press('?');
  assert.ok(await page.locator('#help').isVisible());
  await page.keyboard.press('Escape');
  assert.equal(await page.locator('#help').isVisible(), false);
});

test('one mesh alone', async () => {
  await open('alone.html');
  const { drawn, red } = await pixels();
  assert.ok(drawn > 0.05 && red > 0.0003, `drawn ${drawn}, red ${red}`);
  assert.equal(await page.locator('#layout').isVisible(), false);
});

/** Two by two pixels: green on the left, blue on the right, the lower of which is a hole. */
const image = Buffer.from('iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAFklEQVR42mNgOMHwn4Hhzn8mBghgBAAuAQOmCHWyvQAAAABJRU5ErkJggg==', 'base64');

/** Four strips of a square in the material `painted`, the last of which is crossed by a triangle of the material `plain`. */
function writePainted(name, bytes) {
  writeFileSync(at(`${name}.png`), bytes);
  writeFileSync(at(`${name}.mtl`), `newmtl painted\nmap_Kd ${name}.png\nnewmtl plain\nKd 0.9 0.8 0.1\n`);
  const rows = [0, 1, 2, 3, 4].map((i) => `v 0 ${i / 4} 0\nv 1 ${i / 4} 0\nvt 0 ${i / 4}\nvt 1 ${i / 4}\n`);
  const quads = [1, 3, 5, 7].map((i) => `f ${[i, i + 1, i + 3, i + 2].map((v) => `${v}/${v}`).join(' ')}\n`);
  writeFileSync(at(`${name}.obj`), `mtllib ${name}.mtl\n${rows.join('')}v 0.4 0.9 -0.1\nv 0.5 0.9 0.2\nv 0.6 0.9 -0.1\n`
    + `usemtl painted\n${quads.join('')}usemtl plain\nf 11 12 13\n`);
  return unsnarl('view', at(`${name}.obj`), '-o', at(`${name}.html`));
}

/** Shares of the canvas that are green, and blue. */
const greenAndBlue = () => page.evaluate(() => {
  const copy = window.unsnarl.stage.snapshot();
  const { data } = copy.getContext('2d').getImageData(0, 0, copy.width, copy.height);
  const shares = [0, 0];
  for (let i = 0; i < data.length; i += 4)
    if (data[i + 3] > 128)
      for (const k of [0, 1]) if (data[i + k + 1] > 60 && data[i + k + 1] > 2 * data[i] && data[i + k + 1] > 2 * data[i + 2 - k]) shares[k] += 4 / data.length;
  return shares;
});

test('a mesh is shown with its image, red on top, and without', async () => {
  writePainted('painted', image);
  await open('painted.html');
  assert.equal(await page.evaluate(() => window.unsnarl.state.colouring), 'texture');
  const [green, blue] = await greenAndBlue();
  assert.ok(green > 0.01 && blue > 0.01 && Math.abs(green - blue) < 0.5 * green, `green ${green}, blue ${blue}`);
  assert.ok((await pixels()).red > 0.0001, 'red faces stay visible');
  await page.keyboard.press('c');
  assert.deepEqual(await greenAndBlue(), [0, 0]);
  await page.getByRole('button', { name: 'Texture' }).click();
  assert.deepEqual(await greenAndBlue(), [green, blue]);

});

test('points that glTF masks are holes', async () => {
  const bytes = Buffer.alloc(4 * 12 + 4 * 8);
  [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 1, 0, 0, 1, 0].forEach((x, i) => bytes.writeFloatLE(x, 4 * i));
  const write = (name, mode) => writeFileSync(at(`${name}.gltf`), JSON.stringify({
    asset: { version: '2.0' }, nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0, TEXCOORD_0: 1 }, material: 0, mode: 5 }] }],
    materials: [{ alphaMode: mode, pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }],
    textures: [{ source: 0 }], images: [{ uri: `data:image/png;base64,${image.toString('base64')}` }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 4, type: 'VEC3' }, { bufferView: 1, componentType: 5126, count: 4, type: 'VEC2' }],
    bufferViews: [{ buffer: 0, byteLength: 48 }, { buffer: 0, byteOffset: 48, byteLength: 32 }],
    buffers: [{ byteLength: bytes.length, uri: `data:application/octet-stream;base64,${bytes.toString('base64')}` }],
  }));
  const shares = [];
  for (const mode of ['OPAQUE', 'MASK']) {
    write(mode, mode);
    unsnarl('view', at(`${mode}.gltf`), '-o', at(`${mode}.html`), '--quiet');
    await open(`${mode}.html`);
    shares.push(await greenAndBlue());
  }
  const [[, opaque], [green, masked]] = shares;
  assert.ok(green > 0.01 && masked > 0.2 * opaque && masked < 0.8 * opaque, `blue: ${opaque}, with holes ${masked}`);
});

test('an image that cannot be decoded is left out, and said', async () => {
  writePainted('broken', Buffer.concat([image.subarray(0, 40), Buffer.from('no pixels')]));
  await open('broken.html');
  assert.equal(await page.evaluate(() => window.unsnarl.state.colouring), 'conflicts');
  assert.match(await page.locator('#panel').textContent(), /Image broken\.png is left out: this browser cannot decode it/);
  await page.getByRole('button', { name: 'Materials' }).click();
  assert.ok((await pixels()).drawn > 0.05);
  assert.deepEqual(await greenAndBlue(), [0, 0]);
});

test('what is no image is left out, and said', async () => {
  writePainted('text', 'no image');
  await open('text.html');
  assert.match(await page.locator('#panel').textContent(), /Image text\.png is left out: neither PNG nor JPEG/);
  assert.ok((await pixels()).drawn > 0.05);
});

test('the browser had nothing to complain about', () => assert.deepEqual(complaints, []));
