# SPDX-License-Identifier: Apache-2.0
"""Tools that draw the tf tree."""

from __future__ import annotations

__all__: list[str] = []
