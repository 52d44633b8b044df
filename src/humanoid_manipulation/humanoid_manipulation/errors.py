# SPDX-License-Identifier: Apache-2.0
"""Exceptions of arm kinematics, motion planning and manipulation."""

from __future__ import annotations

__all__ = ['ManipulationError']


class ManipulationError(Exception):
    """An operation is impossible with this robot or these values; the message states why."""
