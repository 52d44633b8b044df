# SPDX-License-Identifier: Apache-2.0
"""What is above what in the page; what is not listed has a number of its own from 0 on."""

__all__ = ['FILE_ORDER', 'STATUS_ORDER', 'TABS_ORDER', 'TOOLS_ORDER']

STATUS_ORDER = -40.0
FILE_ORDER = -30.0
TOOLS_ORDER = -20.0
TABS_ORDER = -10.0
