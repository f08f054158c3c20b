# SPDX-License-Identifier: GPL-3.0-or-later
"""What differs between the add-on for Blender 3.x and the extension for Blender 4.2 and later. No other file asks."""

from pathlib import Path

if (Path(__file__).parent / "wheel").is_dir():  # the add-on: the wheel lies unpacked inside
    from .wheel import unsnarl
else:  # the extension: Blender has installed the wheel that the manifest names
    import unsnarl

__all__ = ["unsnarl", "curves_of"]


def curves_of(animated):
    """The animation curves of a data-block: of its action, or from Blender 4.4 on of the part that is the block's."""
    data = animated.animation_data
    if data is None or data.action is None:
        return []
    if hasattr(data.action, "fcurves"):
        return list(data.action.fcurves)
    bags = [strip.channelbag(data.action_slot) for layer in data.action.layers for strip in layer.strips]
    return [curve for bag in bags if bag is not None for curve in bag.fcurves]
