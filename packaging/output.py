"""Where the packages go: into a folder of the user's, of which nothing else is touched."""

import os
import shutil
import tempfile


def put(package, folder):
    """Moves a finished file into a folder that may hold anything, in place of a file of its name. Returns its place."""
    place = folder / package.name
    with tempfile.TemporaryDirectory(prefix=".unfinished-", dir=folder) as beside:  # on the same file system
        os.replace(shutil.move(package, beside), place)
    return place
