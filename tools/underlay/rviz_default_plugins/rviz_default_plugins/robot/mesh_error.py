# SPDX-License-Identifier: Apache-2.0
"""The error for a mesh that cannot be shown."""

from __future__ import annotations

__all__ = ['MeshError']


class MeshError(ValueError):
    """A mesh that cannot be shown, with the reason."""
