# SPDX-License-Identifier: Apache-2.0
"""The vertical order of the widgets in the page; those not listed are numbered from 0."""

__all__ = ['ALWAYS_ORDER', 'FILE_ORDER', 'STATUS_ORDER', 'TABS_ORDER', 'TOOLS_ORDER']

ALWAYS_ORDER = -50.0
STATUS_ORDER = -40.0
FILE_ORDER = -30.0
TOOLS_ORDER = -20.0
TABS_ORDER = -10.0
