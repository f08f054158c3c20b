"""mkdocs hook: what the pages of docs/ show of the rest of the project is put in when the site is built.

- `<!-- options: COMMAND -->` becomes the table of the command's options, from its --help; the program is
  $UNSNARL_PROGRAM, or build/release/unsnarl.
- `<!-- code: ../PATH -->` becomes the text of the file.
- Links to files of the project that are not pages (../PATH) lead to copies of them, as text.
- Pages that mkdocs.yml does not name come last in the navigation.
"""

import os
import re
import sys
from pathlib import Path

from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File

PROJECT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(PROJECT / "tools"))
import help_text  # noqa: E402

LINK_OUT = re.compile(r"\]\(\.\./([^)#\s]+)\)")
OPTIONS = re.compile(r"^<!-- options: ([\w-]+) -->$", re.M)
CODE = re.compile(r"^<!-- code: \.\./(\S+) -->$", re.M)


def pages_named(nav):
    for item in nav:
        value = next(iter(item.values())) if isinstance(item, dict) else item
        yield from pages_named(value) if isinstance(value, list) else [value]


def on_config(config):
    named = set(pages_named(config["nav"]))
    config["nav"] += [page.name for page in sorted(Path(config["docs_dir"]).glob("*.md")) if page.name not in named]
    return config


def on_files(files, config):
    """Files of the project that pages link to."""
    linked = {path for page in files.documentation_pages()
              for path in LINK_OUT.findall(Path(page.abs_src_path).read_text())}
    for path in sorted(linked):
        if not (PROJECT / path).is_file():
            raise PluginError(f"a page links to ../{path}, which is no file of the project")
        copy = File(f"project/{path}.txt", str(PROJECT), config["site_dir"], use_directory_urls=False)
        copy.abs_src_path = str(PROJECT / path)
        files.append(copy)
    return files


def options_table(command):
    program = os.environ.get("UNSNARL_PROGRAM", str(PROJECT / "build/release/unsnarl"))
    if not os.access(program, os.X_OK):
        raise PluginError(f"no program at {program} to ask for its options: build it, or set UNSNARL_PROGRAM")

    def cell(text):
        return re.sub(r"(?<![\w-])--[a-z][\w-]*\w", r"`\g<0>`", text.replace("|", "\\|").replace("<", "&lt;"))

    lines = []
    for heading, group in help_text.read(program)[command].groups.items():
        lines += [f"**{heading}**", "", "| option | meaning |", "|---|---|"]
        for entry in group:
            value = f" *{cell(entry.value)}*" if entry.value else ""
            lines.append("| " + ", ".join(f"`{name}`" for name in entry.names) + f"{value} | {cell(entry.meaning)} |")
        lines.append("")
    return "\n".join(lines)


def code_block(path):
    return f"```\n{(PROJECT / path).read_text().rstrip()}\n```"


def on_page_markdown(markdown, page, config, files):
    markdown = OPTIONS.sub(lambda found: options_table(found[1]), markdown)
    markdown = LINK_OUT.sub(r"](project/\1.txt)", markdown)
    return CODE.sub(lambda found: code_block(found[1]), markdown)
