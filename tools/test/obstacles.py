# SPDX-License-Identifier: Apache-2.0
"""What keeps people from using a page, as axe-core finds it: names, roles, contrast, focus."""

from __future__ import annotations

from typing import Any

import pytest

__all__ = ['obstacles']

OPTIONS = {'resultTypes': ['violations']}
SEVERE = ('serious', 'critical')


def obstacles(page: Any, *left_out: str) -> list[str]:
    """
    Return what is severely wrong with a page of a browser, or with a frame of one.

    `left_out` are selectors of elements that are not ours. Without axe-core, the test is skipped.
    """
    axe = pytest.importorskip('axe_playwright_python.sync_playwright').Axe()
    context = {'include': [['html']], 'exclude': [[each] for each in left_out]}
    found = axe.run(page, context, OPTIONS).response
    return [
        f'{page.url}: {rule["id"]}: {node["html"]}: {node["failureSummary"]}'
        for rule in found['violations']
        for node in rule['nodes']
        if rule['impact'] in SEVERE
    ]
