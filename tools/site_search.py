"""mkdocs hook: a search box on every page, and colours.

The index is a script that pages load, so that the search works from disk, where browsers fetch no data. A result is a
section that has all words, sections that have them in their heading first.
"""

import html
import json
import re
from pathlib import Path

HEADING = re.compile(r'<h([1-4]) id="([^"]*)">(.*?)</h\1>', re.S)
TAG = re.compile(r"<[^>]+>")

BOX = """<div class="site-search"><input type="search" placeholder="Search (press /)"
aria-label="Search"><ol hidden></ol></div><script src="{root}assets/search_index.js"></script>
<script src="{root}assets/search.js"></script>"""

SCRIPT = r"""// Searches unsnarlSections, entries [page, anchor, title, text], for all words that are typed.
(() => {
  const box = document.querySelector('.site-search input');
  const list = document.querySelector('.site-search ol');
  const most = 12;
  const find = (words) => unsnarlSections
    .map(([page, anchor, title, text]) => {
      const head = title.toLowerCase();
      const all = head + ' ' + text.toLowerCase();
      if (!words.every((w) => all.includes(w))) return null;
      return { page, anchor, title, text, score: words.filter((w) => head.includes(w)).length };
    })
    .filter(Boolean).sort((a, b) => b.score - a.score).slice(0, most);
  const excerpt = (text, word) => {
    const at = Math.max(0, text.toLowerCase().indexOf(word) - 40);
    return (at ? '… ' : '') + text.slice(at, at + 140);
  };
  const index = 'assets/search_index.js';
  const root = document.querySelector(`script[src$="${index}"]`).getAttribute('src').replace(index, '');
  box.addEventListener('input', () => {
    const words = box.value.toLowerCase().split(/\s+/).filter((w) => w.length > 1);
    list.hidden = words.length === 0;
    list.replaceChildren(...(words.length ? find(words) : []).map(({ page, anchor, title, text }) => {
      const link = document.createElement('a');
      link.href = `${root}${page}#${anchor}`;
      link.textContent = title;
      const words_of = document.createElement('small');
      words_of.textContent = ` ${page.replace('.html', '')}: ${excerpt(text, words[0])}`;
      const entry = document.createElement('li');
      entry.append(link, words_of);
      return entry;
    }));
    if (!list.hidden && !list.children.length) list.textContent = 'nothing has all these words';
  });
  addEventListener('keydown', (event) => {
    if (event.key === '/' && document.activeElement !== box) { event.preventDefault(); box.focus(); }
    if (event.key === 'Escape') { box.value = ''; list.hidden = true; }
  });
})();
"""

STYLE = """.site-search { position: relative; max-width: 420px; margin: 0 0 12px auto; }
.site-search input { width: 100%; padding: 4px 10px; border: 1px solid #bbb; border-radius: 6px; }
.site-search ol { position: absolute; z-index: 10; right: 0; width: min(620px, 92vw); max-height: 70vh; overflow: auto;
  margin: 4px 0 0; padding: 10px 14px 10px 30px; border: 1px solid #bbb; border-radius: 6px; background: #fff; }
.site-search li { margin-bottom: 6px; }
.site-search small { color: #666; }
pre { max-width: 100%; overflow-x: auto; }
table { display: block; overflow-x: auto; }
@media (prefers-color-scheme: dark) {
  html { background: #fff; filter: invert(0.9) hue-rotate(180deg); }
  img, video { filter: invert(1) hue-rotate(180deg); }
}
"""

sections = []


def plain(text):
    return " ".join(html.unescape(TAG.sub(" ", text)).split())


def on_pre_build(config):
    sections.clear()


def on_page_content(content, page, config, files):
    found = list(HEADING.finditer(content))
    ends = [heading.start() for heading in found[1:]] + [len(content)]
    for heading, end in zip(found, ends):
        sections.append([page.url, heading[2], plain(heading[3]), plain(content[heading.end():end])])
    return content


def on_post_page(output, page, config):
    box = BOX.format(root="../" * page.url.count("/"))
    return output.replace('<div class="row">', box + '<div class="row">', 1)


def on_post_build(config):
    assets = Path(config["site_dir"]) / "assets"
    assets.mkdir(exist_ok=True)
    (assets / "search_index.js").write_text(f"const unsnarlSections = {json.dumps(sections, ensure_ascii=False)};\n")
    (assets / "search.js").write_text(SCRIPT)
    style = STYLE
    try:
        from pygments.formatters import HtmlFormatter
        style += HtmlFormatter(style="friendly").get_style_defs(".codehilite") + "\n"
    except ImportError:
        pass  # code stays black
    (assets / "colours.css").write_text(style)
