# SPDX-License-Identifier: Apache-2.0
"""The error that refuses a URDF."""

from __future__ import annotations

from humanoid_common.errors import NodeStartError


class UrdfError(NodeStartError):
    """Refuse a URDF, with the reason."""
