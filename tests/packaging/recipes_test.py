#!/usr/bin/env python3
"""The recipes for vcpkg, conda-forge and Homebrew name what the build asks for, and are well formed when filled in."""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "packaging"))

from recipes import fill  # noqa: E402

ABOUT = {"version": "1.2.3", "homepage": "https://example.org/unsnarl"}
# By Debian package the names in vcpkg, conda-forge and Homebrew.
NAMES = {
    "libboost-dev": ("boost-multiprecision", "libboost-headers", "boost"),
    "libcli11-dev": ("cli11", "cli11", "cli11"),
    "libeigen3-dev": ("eigen3", "eigen", "eigen@3"),
    "libfmt-dev": ("fmt", "fmt", "fmt"),
    "libgif-dev": ("giflib", "giflib", "giflib"),
    "libpng-dev": ("libpng", "libpng", "libpng"),
    "libpugixml-dev": ("pugixml", "pugixml", "pugixml"),
    "libtbb-dev": ("tbb", "tbb-devel", "tbb"),
    "libzip-dev": ("libzip", "libzip", "libzip"),
    "nlohmann-json3-dev": ("nlohmann-json", "nlohmann_json", "nlohmann-json"),
    "zlib1g-dev": ("zlib", "zlib", "zlib"),
}
# Recipes also name the tools of the build, and what the Python module is made with and runs with.
TOOLS = {"cmake", "ninja", "numpy", "pip", "python", "setuptools", "vcpkg-cmake", "vcpkg-cmake-config", "wheel"}


def asked_for():
    """Debian packages that CMake asks for, without those that are for tests alone."""
    build = (PROJECT / "cmake/debian_packages.txt").read_text().partition("# Only")[0]
    asked = re.findall(r"^ *unsnarl_(?:package|library)\((\S+)", (PROJECT / "cmake/UnsnarlDependencies.cmake").read_text(), re.M)
    return {name for name in asked if re.search(rf"^{re.escape(name)} ", build, re.M)}


class Recipes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.written = {path.name: path for path in fill(Path(cls.folder.name), ABOUT, b"the source")}

    def needs(self, manager, named):
        names = {name for name in named if name not in TOOLS}
        self.assertEqual(names, {NAMES[package][manager] for package in asked_for()})

    def test_nothing_is_left_open(self):
        self.assertEqual(sorted(self.written), ["portfile.cmake", "recipe.yaml", "unsnarl.rb", "vcpkg.json"])
        for path in self.written.values():
            self.assertNotRegex(path.read_text(), r"@[A-Z0-9]+@")
            self.assertIn("1.2.3", path.read_text())

    def test_vcpkg(self):
        manifest = json.loads(self.written["vcpkg.json"].read_text())
        listed = manifest["dependencies"] + manifest["features"]["tools"]["dependencies"]
        self.needs(0, [one if isinstance(one, str) else one["name"] for one in listed])
        # The functions of vcpkg that the port calls, doing nothing.
        called = set(re.findall(r"^ *(vcpkg_\w+)\(", self.written["portfile.cmake"].read_text(), re.M))
        script = Path(self.folder.name) / "try.cmake"
        script.write_text("cmake_minimum_required(VERSION 3.25)\n" + "".join(f"function({name})\nendfunction()\n" for name in sorted(called)) +
                          f'set(CURRENT_PACKAGES_DIR "{self.folder.name}/packages")\ninclude("{self.written["portfile.cmake"]}")\n')
        subprocess.run(["cmake", "-P", script], check=True)

    def test_conda_forge(self):
        try:
            import yaml
        except ImportError:
            self.skipTest("python3-yaml is not installed")
        recipe = yaml.safe_load(self.written["recipe.yaml"].read_text())
        self.needs(1, [one.split()[0] for one in recipe["requirements"]["host"] + recipe["requirements"]["run"]])
        self.assertEqual(len(recipe["source"]["sha256"]), 64)

    def test_homebrew(self):
        formula = self.written["unsnarl.rb"].read_text()
        self.needs(2, re.findall(r'^ *(?:depends_on|uses_from_macos|resource) "(\S+)"', formula, re.M))
        if not shutil.which("ruby"):
            self.skipTest("ruby is not installed")
        subprocess.run(["ruby", "-c", self.written["unsnarl.rb"]], check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    unittest.main()
