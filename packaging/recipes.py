"""Recipes for package managers of others: packaging/recipes has them with @NAMES@ in place of what a release says."""

import hashlib
from pathlib import Path

RECIPES = Path(__file__).resolve().parent / "recipes"


def fill(folder, about, source):
    """Writes all recipes for this version and address, and these bytes of the source distribution. Returns their paths."""
    values = {"VERSION": about["version"], "HOMEPAGE": about["homepage"], "SHA256": hashlib.sha256(source).hexdigest(),
              "SHA512": hashlib.sha512(source).hexdigest()}
    written = []
    for recipe in sorted(path for path in RECIPES.rglob("*") if path.is_file()):
        text = recipe.read_text()
        for name, value in values.items():
            text = text.replace(f"@{name}@", value)
        place = folder / recipe.relative_to(RECIPES)
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text)
        written.append(place)
    return written
