# SPDX-License-Identifier: Apache-2.0
"""Exceptions of the dynamics package."""

from __future__ import annotations


class DynamicsError(Exception):
    """A robot model or state that the dynamics cannot handle; the message states why."""
