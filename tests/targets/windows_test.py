#!/usr/bin/env python3
"""The program for Windows does what the one for this system does: the same bytes of every format, and paths, locks,
processes and interruption as Windows has them.

usage: windows_test.py PROGRAM.exe [PROGRAM [RUNNER]]

PROGRAM is the one for this system; without it, nothing is compared, and what the other does is checked alone. RUNNER
(default: wine) runs the other here. What a test needs and this machine lacks is named, and the test left out.
"""
import json
import os
import pty
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SEEDS = Path(__file__).resolve().parents[1] / 'fuzz' / 'seeds'
FORMATS = ['obj', 'off', 'ply', 'stl', 'gltf', 'surf', 'gii', 'vtk', 'vtp', 'msh', 'inp', 'threemf']
TEXT = {'.obj', '.off', '.inp', '.xyz', '.mtl'}  # formats in which a line may end as Windows ends it
SAMPLES = ['mobius_extended', 'linked_rings', 'klein_map', 'overlapping_quads', 'stool']
UNUSUAL = 'Größe 网格 σχήμα'
WINDOWS = THIS = None
RUNNER = []


def without_times(text):
    """What a program says, without what differs from run to run: seconds, and the part of paths that is the machine's."""
    text = re.sub(r'\d+(\.\d+)? (s|min|h|MB)\b', 'N \\2', text)
    return re.sub(r'\d+(\.\d+)?(e-?\d+)? a second', 'N a second', text).replace('\r\n', '\n').replace('\\', '/')


def files_in(folder):
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in sorted(folder.rglob('*')) if path.is_file()}


class Case(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix='unsnarl-windows-')
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.windows, self.this = self.folder / 'windows', self.folder / 'this'
        self.windows.mkdir()
        self.this.mkdir()

    def run_one(self, program, folder, words, **more):
        runner = RUNNER if program == WINDOWS else []
        return subprocess.run([*runner, str(program), *map(str, words)], cwd=folder, capture_output=True, timeout=600,
                              **more)

    def windows_only(self, *words, code=0, **more):
        done = self.run_one(WINDOWS, self.windows, words, **more)
        self.assertEqual(done.returncode, code, done.stderr.decode('utf-8', 'replace'))
        return done

    def both(self, *words, code=None, **more):
        """Runs both in their folders: the same exit code, the same words, the same files. Returns what Windows did."""
        there = self.run_one(WINDOWS, self.windows, words, **more)
        here = self.run_one(THIS, self.this, words, **more) if THIS else there
        said = [without_times(done.stderr.decode('utf-8')) for done in (here, there)]
        self.assertEqual(here.returncode, there.returncode, said)
        if code is not None:
            self.assertEqual(here.returncode, code, said)
        self.assertEqual(said[0], said[1])
        return here, there

    def put(self, name, content):
        for folder in (self.windows, self.this):
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            if isinstance(content, Path):
                shutil.copy(content, path)
            else:
                path.write_bytes(content if isinstance(content, bytes) else content.encode())

    def sample(self, sample, name, *words):
        (self.this / name).parent.mkdir(parents=True, exist_ok=True)
        program, folder = (THIS, self.this) if THIS else (WINDOWS, self.windows)
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        done = self.run_one(program, folder, ['sample', sample, '-o', name, *words])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.put(name, (folder / name).read_bytes())

    def assert_same_files(self, but=()):
        here, there = files_in(self.this), files_in(self.windows)
        if not THIS:
            return
        self.assertEqual(sorted(here), sorted(there))
        for name in here:
            if name not in but:
                self.assertEqual(here[name], there[name], name)

    def assert_same_report(self, name):
        """But for times, memory, the threads and what paths look like."""
        if not THIS:
            return
        def read(folder):
            report = json.loads((folder / name).read_text(encoding='utf-8'))
            for key in ('timing', 'stages', 'seconds', 'cpu_seconds', 'peak_memory_mb', 'run', 'environment'):
                report.pop(key, None)
            return without_times(json.dumps(report, ensure_ascii=False, indent=1))
        numbers = [re.sub(r'"(seconds|cpu_s|cpu_seconds|peak_memory_mb|resident_mb)": [-\d.e+]+', r'"\1": N',
                          read(folder).replace('//', '/')) for folder in (self.this, self.windows)]
        self.assertEqual(*numbers)


class Bytes(Case):
    def test_samples(self):
        for sample in SAMPLES:
            for extension in ('obj', 'off', 'ply', 'glb'):
                with self.subTest(sample=sample, extension=extension):
                    self.both('sample', sample, '-o', f'{sample}.{extension}', code=0)
        for sample, extension in (('curve_star', 'svg'), ('curve_star', 'json'), ('knot_3_1', 'xyz'),
                                  ('routes_star_6', 'json')):
            self.both('sample', sample, '-o', f'{sample}.{extension}', code=0)
        self.assert_same_files()

    def test_every_format(self):
        for kind in FORMATS:
            for seed in sorted((SEEDS / kind).iterdir()):
                with self.subTest(format=kind, file=seed.name):
                    name = seed.name if '.' in seed.name else f'{seed.name}.{kind}'
                    self.put(name, seed)
                    self.both('check', name)
                    self.both('fix', name, '-o', 'fixed-' + name, '--keep-partial', '--quiet')
                    self.assert_same_files()

    def test_reports_pictures_pages_recordings(self):
        self.sample('stool', 'stool.obj')
        self.both('fix', 'stool.obj', '-o', 'fixed.obj', '--report', 'report.json', '--picture', 'picture.png', '--record',
                  'record.unsnarl', '--view', 'page.html')
        self.both('view', 'stool.obj', 'fixed.obj', '-o', 'view.html')
        self.assert_same_files(but=('report.json', 'page.html'))
        self.assert_same_report('report.json')

    def test_applications(self):
        for sample, name in (('curve_star', 'star.svg'), ('knot_3_1', 'knot.xyz'), ('knot_kinks_1', 'kinks.xyz'),
                             ('knot_circle', 'circle.xyz'), ('routes_star_6', 'plan.json')):
            self.sample(sample, name)
        self.both('curves', 'star.svg', '-o', 'untangled.svg', '--quiet')
        self.both('seifert', 'knot.xyz', '-o', 'surface.obj', '--quiet')
        self.both('knot-isotopy', 'kinks.xyz', 'circle.xyz', '-o', 'isotopy', '--quiet')
        self.both('routes', 'plan.json', '-o', 'routes', '--quiet')
        for folder in (self.this, self.windows):
            for timed in (folder / 'isotopy' / 'isotopy.json', folder / 'routes' / 'routes.json'):
                timed.write_text(re.sub(r'"seconds": ?[-\d.e+]+', '"seconds":0', timed.read_text()))
        self.assert_same_files()

    def test_standard_streams(self):
        self.sample('klein_map', 'in.glb')
        given = (self.this / 'in.glb').read_bytes()
        here, there = self.both('fix', '-', '--format', 'glb', '-o', '-', '--quiet', input=given, code=0)
        self.assertEqual(here.stdout, there.stdout)
        self.assertTrue(there.stdout.startswith(b'glTF'))

    def test_lines_that_end_as_windows_ends_them(self):
        for kind in FORMATS:
            for seed in sorted((SEEDS / kind).iterdir()):
                if seed.suffix in TEXT:
                    with self.subTest(file=seed.name):
                        plain = seed.read_bytes().replace(b'\r\n', b'\n')
                        self.put('plain' + seed.suffix, plain)
                        self.put('crlf' + seed.suffix, plain.replace(b'\n', b'\r\n'))
                        self.both('fix', 'crlf' + seed.suffix, '-o', 'fixed' + seed.suffix, '--keep-partial', '--quiet')
                        self.assert_same_files()
                        fixed = self.windows / ('fixed' + seed.suffix)
                        if fixed.exists():
                            self.assertEqual(fixed.read_bytes().count(b'\n'), fixed.read_bytes().count(b'\r\n'))

    def test_versions_and_help(self):
        here, there = self.both('--version', code=0)
        self.assertEqual(here.stdout, there.stdout.replace(b'\r\n', b'\n'))
        for words in (['--help'], ['fix', '--help'], ['batch', '--help']):
            here, there = self.both(*words, code=0)
            self.assertEqual(here.stdout, there.stdout)
        self.both('fxi', code=2)
        self.both('fix', 'none.obj', '-o', 'out.obj', code=3)


class Paths(Case):
    def test_other_alphabets(self):
        folder = UNUSUAL
        self.sample('klein_map', 'in.obj')
        self.put(f'{folder}/{UNUSUAL}.obj', (self.this / 'in.obj').read_bytes())
        self.put(f'{folder}/fixed vertices ÿ.txt', '0\n')
        place = f'{folder}/{UNUSUAL}'
        self.both('check', f'{place}.obj')
        self.both('fix', f'{place}.obj', '-o', f'{folder}/out ж.obj', '--report', f'{place}.json', '--picture',
                  f'{place}.png', '--view', f'{place}.html', '--record', f'{place}.rec', '--highlight',
                  f'{folder}/marked ¶.ply', '--fix-vertices', f'{folder}/fixed vertices ÿ.txt', '--quiet')
        self.both('fix', f'{place}.obj', '-o', f'{folder}/frames.obj', '--picture', f'{folder}/Bilder ä/', '--quiet')
        self.both('fix', 'in.obj', f'{place}.obj', '-o', f'{folder}/Szene ö', '--quiet')
        self.both('view', f'{place}.obj', f'{folder}/out ж.obj', '-o', f'{folder}/page π.html', '--report', f'{place}.json')
        self.both('sample', 'curve_star', '-o', f'{folder}/star ☆.svg')
        self.both('curves', f'{folder}/star ☆.svg', '-o', f'{folder}/curves ☆.svg', '--picture', f'{folder}/☆.png', '--quiet')
        self.both('sample', 'knot_3_1', '-o', f'{folder}/knot ∞.xyz')
        self.both('seifert', f'{folder}/knot ∞.xyz', '-o', f'{folder}/surface ∞.obj', '--quiet')
        self.assert_same_files(but=[f'{place}.json', f'{place}.html', f'{folder}/page π.html'])
        self.assert_same_report(f'{place}.json')

    def test_drives_and_backslashes(self):
        self.sample('klein_map', 'in.obj')
        self.both('fix', 'in.obj', '-o', 'wanted.obj', '--quiet', code=0)
        wanted = (self.this / 'wanted.obj').read_bytes()
        root = 'Z:' + str(self.windows).replace('/', '\\')
        (self.windows / 'sub folder').mkdir()
        for name in ('sub folder\\out.obj', f'{root}\\sub folder\\out.obj', f'{root}/sub folder/out.obj'):
            with self.subTest(name=name):
                self.windows_only('fix', f'{root}\\in.obj', '-o', name, '--quiet')
                out = self.windows / 'sub folder' / 'out.obj'
                self.assertEqual(out.read_bytes(), wanted)
                out.unlink()
        self.windows_only('fix', 'in.obj', '-o', f'{root}\\IN.OBJ'.replace('IN.OBJ', 'in.obj'), '--quiet', code=2)
        self.windows_only('fix', 'in.obj', '-o', 'NUL', '--quiet')

    def test_names_in_files(self):
        """What a glTF or an OBJ refers to, with \\ between the parts, on both systems."""
        seed = json.loads((SEEDS / 'gltf' / 'external.gltf').read_text()) if (SEEDS / 'gltf' / 'external.gltf').exists() \
            else None
        self.sample('klein_map', 'plain.obj')
        text = (self.this / 'plain.obj').read_text()
        self.put('material/textures/white.ppm', b'P6 1 1 255\n\xff\xff\xff')
        self.put('material/all.mtl', 'newmtl skin\nKd 1 0 0\nmap_Kd textures\\white.png\n')
        self.put('mesh.obj', 'mtllib material\\all.mtl\nusemtl skin\n' + text)
        self.both('view', 'mesh.obj', '-o', 'page.html', '--quiet')
        self.assert_same_files()
        if seed is not None:
            self.put('seed.gltf', json.dumps(seed))

    def test_external_buffers(self):
        self.sample('klein_map', 'in.glb')
        glb = (self.this / 'in.glb').read_bytes()
        size = int.from_bytes(glb[12:16], 'little')
        document = json.loads(glb[20:20 + size])
        document['buffers'][0]['uri'] = 'buffers\\größe.bin'
        self.put('mesh.gltf', json.dumps(document))
        self.put('buffers/größe.bin', glb[28 + size:28 + size + document['buffers'][0]['byteLength']])
        for folder in (self.this, self.windows):
            (folder / 'out').mkdir()
        self.both('fix', 'mesh.gltf', '-o', 'out/mesh.gltf', '--quiet', code=0)
        self.assert_same_files()
        self.assertIn('out/buffers/größe.bin', files_in(self.windows))
        self.both('check', 'out/mesh.gltf', code=0)
        document['buffers'][0]['uri'] = '..\\secret.bin'
        self.put('outside.gltf', json.dumps(document))
        self.put('../secret.bin', b'x' * 10000)
        self.both('check', 'outside.gltf', code=3)

    def test_a_drive_in_a_file_is_refused(self):
        self.sample('klein_map', 'in.glb')
        glb = (self.this / 'in.glb').read_bytes()
        size = int.from_bytes(glb[12:16], 'little')
        document = json.loads(glb[20:20 + size])
        self.put('x.bin', glb[28 + size:28 + size + document['buffers'][0]['byteLength']])
        for uri in ('Z:x.bin', 'Z:\\x.bin', '\\x.bin', 'Z:' + str(self.windows).replace('/', '\\') + '\\x.bin'):
            with self.subTest(uri=uri):
                document['buffers'][0]['uri'] = uri
                (self.windows / 'mesh.gltf').write_text(json.dumps(document))
                self.windows_only('check', 'mesh.gltf', code=3)


class Folders(Case):
    def put_meshes(self, count):
        for k in range(count):
            self.sample('klein_map', f'meshes/{UNUSUAL[:5]} {k}/mesh {k}.obj', '--set', f'seed={k + 1}')

    def results(self, folder):
        rows = [json.loads(line) for line in (folder / 'out/results.jsonl').read_text(encoding='utf-8').splitlines()]
        for row in rows:
            row.pop('run', None)
            row.pop('key', None)
            row['message'] = row.get('message', '').replace('\\', '/')
        return rows

    def test_batch(self):
        self.put_meshes(3)
        self.put('meshes/broken.obj', 'f 1 2 3\n')
        self.both('batch', 'meshes', '-o', 'out', '--jobs', '2', '--thumbnails', '--quiet')
        there = files_in(self.windows / 'out/fixed')
        self.assertEqual(len(there), 3)
        if THIS:
            self.assertEqual(self.results(self.this), self.results(self.windows))
            self.assertEqual(files_in(self.this / 'out/fixed'), there)
            self.assertEqual(*((folder / 'out/results.csv').read_bytes().replace(b'\\', b'/')
                               for folder in (self.this, self.windows)))
        again = self.windows_only('batch', 'meshes', '-o', 'out', '--jobs', '2', '--thumbnails', code=1)
        self.assertIn(b'done before', again.stderr)

    def test_a_list_with_drives(self):
        self.put_meshes(2)
        root = 'Z:' + str(self.windows).replace('/', '\\')
        lines = [f'{root}\\meshes\\{UNUSUAL[:5]} 0\\mesh 0.obj\tfirst.obj', f'meshes\\{UNUSUAL[:5]} 1\\mesh 1.obj']
        (self.windows / 'list.txt').write_bytes('\r\n'.join(lines).encode())
        self.windows_only('batch', 'list.txt', '-o', 'out', '--quiet')
        self.assertEqual(set(files_in(self.windows / 'out/fixed')), {'first.obj', f'meshes/{UNUSUAL[:5]} 1/mesh 1.obj'})

    def test_two_batches_take_turns(self):
        self.put_meshes(4)
        command = [*RUNNER, str(WINDOWS), 'batch', 'meshes', '-o', 'out', '--jobs', '1']
        both = [subprocess.Popen(command, cwd=self.windows, stderr=subprocess.PIPE) for _ in range(2)]
        said = [process.communicate(timeout=600)[1].decode() for process in both]
        self.assertEqual([process.returncode for process in both], [0, 0], said)
        self.assertTrue(any('done before' in text for text in said), said)
        self.assertEqual(len(files_in(self.windows / 'out/fixed')), 4)

    def test_a_worker_that_takes_too_long_is_stopped(self):
        self.sample('crumpled_sheet', 'meshes/mesh.obj', '--resolution', '200')
        self.windows_only('batch', 'meshes', '-o', 'out', '--time-limit', '0.2', '--quiet', code=1)
        self.assertEqual(self.results(self.windows)[0]['status'], 'time_limit')

    def test_sequence(self):
        for k in (1, 2, 3):
            self.sample('klein_map', f'frames/f{k}.obj', '--set', f'seed={k}')
        words = ('fix', '--sequence', 'frames/f*.obj', '-o', 'out ü', '--quiet')
        self.both(*words)
        if THIS:
            here, there = files_in(self.this / 'out ü'), files_in(self.windows / 'out ü')
            self.assertEqual(sorted(here), sorted(there))
            for name in here:
                if name.endswith('.obj'):
                    self.assertEqual(here[name], there[name], name)
        self.windows_only('fix', '--sequence', 'frames\\F?.obj', '-o', 'out 2', '--quiet')
        self.assertEqual([name for name in files_in(self.windows / 'out 2') if name.endswith('.obj')],
                         ['f1.obj', 'f2.obj', 'f3.obj'])


class Safety(Case):
    def test_in_place_and_write_protected(self):
        self.sample('klein_map', 'mesh.obj')
        self.both('fix', 'mesh.obj', '--in-place', '--quiet', code=0)
        self.assert_same_files()
        os.chmod(self.windows / 'mesh.obj', 0o444)
        if os.geteuid() != 0:
            self.windows_only('fix', 'mesh.obj', '--in-place', '--quiet', code=4)
        self.both('fix', 'mesh.obj', '-o', 'none/out.obj', '--quiet')

    def test_limits(self):
        self.sample('crumpled_sheet', 'mesh.obj', '--resolution', '200')
        self.windows_only('fix', 'mesh.obj', '-o', 'out.obj', '--time-limit', '0.3', '--quiet', code=5)

    def test_interruption(self):
        """Ctrl-C, typed at a terminal."""
        self.sample('crumpled_sheet', 'mesh.obj', '--resolution', '200')
        (self.windows / 'out.obj').write_text('old\n')
        process, terminal = pty.fork()
        if process == 0:
            os.chdir(self.windows)
            words = [*RUNNER, str(WINDOWS), 'fix', 'mesh.obj', '-o', 'out.obj', '--no-partial', '--quiet']
            os.execvp(words[0], words)
        time.sleep(4)
        os.write(terminal, b'\x03')
        said = b''
        try:
            while piece := os.read(terminal, 4096):
                said += piece
        except OSError:
            pass  # the program has ended
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]), 6, said)
        self.assertEqual(files_in(self.windows), {'mesh.obj': (self.windows / 'mesh.obj').read_bytes(), 'out.obj': b'old\n'})


if __name__ == '__main__':
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    WINDOWS, THIS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else None
    RUNNER = sys.argv[3].split() if len(sys.argv) > 3 else ['wine']
    os.environ.setdefault('WINEDEBUG', '-all')
    unittest.main(argv=[sys.argv[0], *os.environ.get('TESTS', '').split(), '-v'])
