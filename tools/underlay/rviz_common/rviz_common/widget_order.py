# SPDX-License-Identifier: Apache-2.0
"""The vertical order of the widgets in the page; those not listed are numbered from 0."""

from __future__ import annotations

__all__ = [
    'ALWAYS_ORDER',
    'BAR_ORDER',
    'DOCK_ORDER',
    'FILE_ORDER',
    'LOOK_ORDER',
    'PHONE_ORDER',
    'SELECTION_ORDER',
    'STATUS_ORDER',
    'TABS_ORDER',
    'TOOLS_ORDER',
]

BAR_ORDER = -60.0
ALWAYS_ORDER = -50.0
STATUS_ORDER = -40.0
FILE_ORDER = -30.0
PHONE_ORDER = -27.0
LOOK_ORDER = -25.0
TOOLS_ORDER = -20.0
SELECTION_ORDER = -15.0
TABS_ORDER = -10.0
DOCK_ORDER = -100.0
"""In a tab."""
