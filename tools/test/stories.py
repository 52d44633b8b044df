# SPDX-License-Identifier: Apache-2.0
"""
A plugin of pytest: all tests in files that are named `story_*.py` are stories.

So are those that are marked as such beside shorter ones of their kind: `make stories` runs both.
"""

from __future__ import annotations

import pytest

__all__ = ['pytest_itemcollected']


def pytest_itemcollected(item: pytest.Item) -> None:
    """Mark the tests of such a file."""
    if item.path.name.startswith('story_'):
        item.add_marker(pytest.mark.story)
