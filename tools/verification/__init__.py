"""An independent check of repaired meshes; see tools/verify.py."""
