#!/usr/bin/env python3
"""packaging/release refuses what is not fit to be released, and says everything that is in its way."""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PACKAGING = Path(__file__).resolve().parents[2] / "packaging"
sys.path.insert(0, str(PACKAGING))

from about import unfit  # noqa: E402


class Release(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = Path(folder.name)
        (self.tree / "cmake").mkdir()
        self.write(version="1.2.3", homepage="https://example.org/unsnarl")
        self.git("init", "-q")
        self.git("add", ".")
        self.git("commit", "-q", "-m", "fit")

    def write(self, version, homepage, head="## [1.2.3] - 2026-01-31", released="date-released: 2026-01-31\n"):
        (self.tree / "cmake/project.json").write_text(json.dumps({"version": version, "homepage": homepage}))
        (self.tree / "CHANGELOG.md").write_text(f"# Changelog\n\n{head}\n\n## [1.2.2] - 2025-12-31\n")
        (self.tree / "CITATION.cff").write_text(f"version: {version}\n{released}")

    def git(self, *arguments):
        subprocess.run(["git", "-c", "user.name=x", "-c", "user.email=x@example.org", *arguments], cwd=self.tree, check=True)

    def reasons(self, **changed):
        """Why the tree is unfit with these changes, which are committed."""
        self.write(**{"version": "1.2.3", "homepage": "https://example.org/unsnarl", **changed})
        self.git("commit", "-q", "-a", "--allow-empty", "-m", "changed")
        return unfit(self.tree)

    def test_what_is_fit_is_taken(self):
        self.assertEqual(unfit(self.tree), [])

    def test_every_reason_is_seen_alone(self):
        for word, changed in (("homepage", {"homepage": ""}),
                              ("CHANGELOG.md", {"head": "## [1.2.4] - 2026-02-01\n\n## [1.2.3] - 2026-01-31"}),
                              ("CITATION.cff", {"released": ""}),
                              ("CITATION.cff", {"released": "date-released: 2026-02-01\n"})):
            with self.subTest(changed):
                (reason,) = self.reasons(**changed)
                self.assertIn(word, reason)
        (self.tree / "new.txt").touch()
        self.assertIn("new.txt", unfit(self.tree)[-1])

    def test_a_version_under_work_is_refused(self):
        reasons = self.reasons(version="1.2.3.dev", head="## [1.2.3] - not released yet", released="")
        self.assertEqual([reason.partition(":")[0] for reason in reasons], ["cmake/project.json", "CHANGELOG.md", "CITATION.cff"])

    def test_the_script_ends_with_the_reasons(self):
        done = subprocess.run([sys.executable, "-B", PACKAGING / "release", "--check"], capture_output=True, text=True)
        reasons = unfit()
        self.assertEqual(done.returncode, 1 if reasons else 0)
        self.assertEqual(done.stderr, "".join(f"error: {reason}\n" for reason in reasons))


if __name__ == "__main__":
    unittest.main()
