"""What this version of the project is called, where the project lives, and whether it is fit to be released."""

import json
import re
import subprocess
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[1]


def about(project=PROJECT):
    """{"version": "1.2.3" or "1.2.3.dev", "homepage": URL or ""}: the one place of both."""
    return json.loads((project / "cmake" / "project.json").read_text())


def unfit(project=PROJECT):
    """Why the tree cannot be released as it is, a line each; none where it can."""
    version, homepage = about(project)["version"], about(project)["homepage"]
    number = version.removesuffix(".dev")
    heads = re.findall(r"^## \[(\S+)\] - (.*)$", (project / "CHANGELOG.md").read_text(), re.M)
    date = dict(heads).get(number, "")
    cited = dict(re.findall(r"^(version|date-released): (.*)$", (project / "CITATION.cff").read_text(), re.M))
    changed = subprocess.run(["git", "status", "--porcelain"], cwd=project, capture_output=True, text=True).stdout.splitlines()
    found = []
    if version != number:
        found.append(f"cmake/project.json: {version} is a version under work; write {number}")
    if not homepage:
        found.append("cmake/project.json: the project has no homepage; packages and messages name it")
    if not heads or heads[0][0] != number or not re.fullmatch(r"\d{4}-\d\d-\d\d", date):
        found.append(f"CHANGELOG.md: it has to begin with '## [{number}] - ' and the day of the release, as in 2026-01-31")
    if cited.get("version") != number or cited.get("date-released") != date:
        found.append(f"CITATION.cff: it has to say 'version: {number}', and as 'date-released:' the day that CHANGELOG.md says")
    if changed:
        found.append(f"the tree has changes that are not committed: {', '.join(line[3:] for line in changed[:5])}")
    return found
