"""Has CMake build the library that the Python package calls, and the program that it runs; all else is in pyproject.toml."""

import json
import os
import re
import subprocess
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # setuptools before 70.1
    from wheel.bdist_wheel import bdist_wheel

PROJECT = Path(__file__).parent.resolve()
ABOUT = json.loads((PROJECT / "cmake" / "project.json").read_text())  # version and address


def readme():
    """README.md with links that lead somewhere from a package index too, where the project has an address."""
    text = (PROJECT / "README.md").read_text(encoding="utf-8")
    if not ABOUT["homepage"]:
        return text
    place = {"!": f"{ABOUT['homepage']}/raw/v{ABOUT['version']}/", "": f"{ABOUT['homepage']}/blob/v{ABOUT['version']}/"}
    return re.sub(r"(!?)(\[[^\]]*\]\()(?![a-z]+:|#)", lambda link: link[0] + place[link[1]], text)


class BuildWithLibrary(build_py):
    def run(self):
        super().run()
        build = os.environ.get("UNSNARL_BUILD_DIR")  # one that is configured and built already
        if not build:
            build = Path(self.get_finalized_command("build").build_temp).resolve()
            cmake("-S", PROJECT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON",
                  "-DUNSNARL_BUILD_PYTHON=ON", "-DUNSNARL_BUILD_APPS=ON", "-DUNSNARL_BUILD_TESTS=OFF")
            jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or os.cpu_count() or 1
            cmake("--build", build, "--target", "unsnarl_c", "unsnarl_program", "--parallel", jobs)
        # An editable package is where its sources are.
        destination = PROJECT / "python" if getattr(self, "editable_mode", False) else Path(self.build_lib).resolve()
        cmake("--install", build, "--component", "unsnarl_python", "--prefix", destination)
        for file, option in (("*unsnarl_c.*", "UNSNARL_BUILD_PYTHON"), ("bin/unsnarl*", "UNSNARL_BUILD_APPS")):
            if not list((destination / "unsnarl").glob(file)):
                raise SystemExit(f"error: {build} was configured without -D{option}=ON: it installs no {file}")


def cmake(*arguments):
    subprocess.run(["cmake", *map(str, arguments)], check=True)


class WithLibrary(Distribution):
    def has_ext_modules(self):
        return True  # for one kind of machine


class WheelForAnyPython(bdist_wheel):
    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


setup(
    version=ABOUT["version"].replace(".dev", ".dev0"),  # as Python spells it
    long_description=readme(),
    long_description_content_type="text/markdown",
    project_urls={"Homepage": ABOUT["homepage"]} if ABOUT["homepage"] else {},
    distclass=WithLibrary,
    cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": WheelForAnyPython},
)
