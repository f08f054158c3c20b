# SPDX-License-Identifier: GPL-3.0-or-later
"""Run inside Blender: installs the add-on's zip as a user does, and runs the tests.

  blender -b --factory-startup --python blender/tests/run.py -- ADDON_ZIP [TEST ...]
"""

import sys
import unittest
from pathlib import Path

import bpy

HERE = Path(__file__).resolve().parent
addon, *names = sys.argv[sys.argv.index("--") + 1 :]
bpy.ops.preferences.addon_install(filepath=addon, overwrite=True)
bpy.ops.preferences.addon_enable(module="unsnarl_blender")
sys.path.insert(0, str(HERE))
loader = unittest.TestLoader()
modules = [path.stem for path in sorted(HERE.glob("*_test.py"))]
suite = loader.loadTestsFromNames(names or modules)
result = unittest.TextTestRunner(verbosity=2, stream=sys.stdout).run(suite)
sys.stdout.flush()
sys.exit(0 if result.wasSuccessful() else 1)
