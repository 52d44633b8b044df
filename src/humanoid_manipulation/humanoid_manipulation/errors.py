# SPDX-License-Identifier: Apache-2.0
"""What goes wrong when a robot is to move its arms."""

from __future__ import annotations

__all__ = ['ManipulationError']


class ManipulationError(Exception):
    """Something cannot be done with this robot, or with these numbers; the text says why."""
