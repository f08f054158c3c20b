"""Has CMake build the compiled part of the Python module; all else is in pyproject.toml."""

import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

PROJECT = Path(__file__).parent.resolve()


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        destination = Path(self.get_ext_fullpath(ext.name)).resolve().parent.parent
        build = os.environ.get("UNSNARL_BUILD_DIR")  # one that is configured and built already
        if not build:
            build = Path(self.build_temp).resolve()
            cmake("-S", PROJECT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DUNSNARL_BUILD_PYTHON=ON",
                  "-DUNSNARL_BUILD_APPS=OFF", "-DUNSNARL_BUILD_TESTS=OFF", f"-DPython3_EXECUTABLE={sys.executable}")
            jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or os.cpu_count() or 1
            cmake("--build", build, "--target", "unsnarl_python", "--parallel", jobs)
        cmake("--install", build, "--component", "unsnarl_python", "--prefix", destination)


def cmake(*arguments):
    subprocess.run(["cmake", *map(str, arguments)], check=True)


setup(
    version=re.search(r"project\(unsnarl VERSION ([\d.]+)", (PROJECT / "CMakeLists.txt").read_text())[1],
    ext_modules=[Extension("unsnarl._native", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
)
