# SPDX-License-Identifier: Apache-2.0
"""Exceptions of the dynamics and of the walk."""

from __future__ import annotations


class DynamicsError(Exception):
    """A robot model or state that the dynamics cannot handle; the message states why."""


class WalkingError(ValueError):
    """An input that walking cannot handle; the message states which, and why."""
