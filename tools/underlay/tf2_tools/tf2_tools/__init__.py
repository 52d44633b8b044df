# SPDX-License-Identifier: Apache-2.0
"""The tree of the frames as a drawing."""

from __future__ import annotations

__all__: list[str] = []
