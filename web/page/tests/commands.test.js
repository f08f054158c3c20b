import assert from 'node:assert/strict';
import { test } from 'node:test';
import { fixCommand, spokenCommand, viewCommand } from '../src/commands.js';

const nothing = { held: [], gap: 0, mostMotion: 0, minutes: 0, isAbsolute: false, holdBoundary: false };
const input = (...meshes) => ({ meshes, files: Object.fromEntries(meshes.map((name) => [name, new Uint8Array(1)])) });

test('a mesh is repaired into a folder of its own', () => {
  const { args, files, page, report } = fixCommand(input('scans/hand.v2.obj'), nothing);
  assert.deepEqual(args, ['fix', 'scans/hand.v2.obj', '-o', 'fixed/hand.v2_fixed.obj', '--view', 'hand.v2.html',
    '--report', 'hand.v2_report.json', '--progress', 'json']);
  assert.deepEqual(Object.keys(files), ['scans/hand.v2.obj', 'fixed/.folder']);
  assert.deepEqual([page, report], ['hand.v2.html', 'hand.v2_report.json']);
});

test('names that are taken are left alone', () => {
  assert.ok(fixCommand(input('fixed/a.obj'), nothing).args.includes('fixed_2/a_fixed.obj'));
  assert.equal(viewCommand(input('view.html')).page, 'view_2.html');
  assert.deepEqual(fixCommand(input('-a.obj'), nothing).args.slice(0, 2), ['fix', './-a.obj']);
});

test('two files are a scene', () => {
  assert.ok(viewCommand(input('a.obj', 'b.obj')).args.includes('--scene'));
  assert.ok(!viewCommand(input('a.obj')).args.includes('--scene'));
  assert.deepEqual(fixCommand(input('a.obj', 'b.obj'), nothing).args.slice(1, 5), ['a.obj', 'b.obj', '-o', 'fixed']);
});

test('what the form asks for are options of the program', () => {
  const held = [{ kind: 'component', name: '3' }, { kind: 'object', name: 'left arm' }];
  const options = (wanted) => fixCommand(input('a.obj'), { ...nothing, ...wanted }).args.slice(10);
  assert.deepEqual(options({ held }), ['--fix-component=3', '--fix-object=left arm']);
  assert.deepEqual(options({ gap: 0.5, mostMotion: 2 }), ['--min-gap', '0.005', '--max-displacement', '0.02']);
  assert.deepEqual(options({ gap: 0.5, isAbsolute: true }), ['--min-gap', '0.5', '--absolute']);
  assert.deepEqual(options({ isAbsolute: true, minutes: 1.5, holdBoundary: true }), ['--time-limit', '90', '--fix-boundary']);
});

test('the command is said as a terminal takes it', () => {
  const { args } = fixCommand(input("it's.obj"), { ...nothing, held: [{ kind: 'object', name: 'left arm' }] });
  assert.equal(spokenCommand(args), "unsnarl fix 'it'\\''s.obj' -o 'fixed/it'\\''s_fixed.obj' '--fix-object=left arm'");
});
