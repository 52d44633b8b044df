# SPDX-License-Identifier: Apache-2.0
"""Exceptions of arm kinematics, motion planning and manipulation."""

from __future__ import annotations

from humanoid_common.errors import UserError

__all__ = ['ManipulationError']


class ManipulationError(UserError):
    """An operation is impossible with this robot or these values; the message states why."""
