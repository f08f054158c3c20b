# SPDX-License-Identifier: GPL-3.0-or-later
"""The zip files: what they hold, and that the manifest names it. Needs no Blender.

  /usr/bin/python3 blender/tests/check_packed.py FOLDER
"""

import re
import sys
import tomllib
import unittest
import zipfile
from pathlib import Path

FOLDER = Path(sys.argv.pop(1))


class Packed(unittest.TestCase):
    def extensions(self):
        found = [path for path in sorted(FOLDER.glob("unsnarl-*.zip")) if not path.name.startswith("unsnarl-addon")]
        self.assertTrue(found)
        return [(path.stem, zipfile.ZipFile(path)) for path in found]

    def test_the_manifest_names_what_lies_inside(self):
        for name, packed in self.extensions():
            with self.subTest(name):
                manifest = tomllib.loads(packed.read("blender_manifest.toml").decode())
                self.assertRegex(manifest["version"], r"^\d+\.\d+\.\d+(-[0-9A-Za-z.-]+)?$")
                self.assertEqual(manifest["schema_version"], "1.0.0")
                self.assertRegex(manifest["id"], r"^[a-z][a-z0-9_]*$")
                self.assertEqual(manifest["type"], "add-on")
                self.assertEqual(manifest["license"], ["SPDX:GPL-3.0-or-later"])
                self.assertLessEqual(len(manifest["tagline"]), 64)
                self.assertNotRegex(manifest["tagline"][-1], r"[.!?]")
                self.assertEqual(manifest["platforms"], [re.search(r"(linux|windows)-\w+$", name)[0]])
                (wheel,) = manifest["wheels"]
                self.assertEqual(
                    [one for one in packed.namelist() if one.endswith(".whl")], [wheel.removeprefix("./")]
                )
                for module in ("__init__.py", "versions.py", "operators.py", "LICENSE"):
                    self.assertIn(module, packed.namelist())

    def test_the_add_on_holds_the_same_code_and_the_unpacked_wheel(self):
        for name, packed in self.extensions():
            addon = zipfile.ZipFile(FOLDER / f"{name.replace('unsnarl-', 'unsnarl-addon-', 1)}.zip")
            with self.subTest(name):
                for module in packed.namelist():
                    if module.endswith(".py") and module != "__init__.py":
                        self.assertEqual(addon.read(f"unsnarl_blender/{module}"), packed.read(module))
                library = "unsnarl_c.dll" if "windows" in name else "libunsnarl_c.so"
                self.assertIn(f"unsnarl_blender/wheel/unsnarl/{library}", addon.namelist())
                self.assertTrue(all(one.startswith("unsnarl_blender/") for one in addon.namelist()))

    def test_only_one_file_asks_which_blender_it_is(self):
        (_, packed), *_ = self.extensions()
        for module in packed.namelist():
            if module.endswith(".py") and module != "versions.py":
                self.assertNotRegex(packed.read(module).decode(), r"app\.version|hasattr\(bpy|import unsnarl$")


if __name__ == "__main__":
    unittest.main(verbosity=2)
