# SPDX-License-Identifier: Apache-2.0
"""The error that refuses a mesh."""

from __future__ import annotations

__all__ = ['MeshError']


class MeshError(ValueError):
    """A mesh that cannot be shown, with the reason."""
