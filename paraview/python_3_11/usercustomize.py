# SPDX-License-Identifier: Apache-2.0
"""Lets ParaView 5.11 load Python plug-ins under Python 3.11, which has no inspect.getargspec any more."""

import inspect

if not hasattr(inspect, "getargspec"):
    inspect.getargspec = inspect.getfullargspec
