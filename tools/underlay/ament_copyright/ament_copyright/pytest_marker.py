# SPDX-License-Identifier: Apache-2.0
"""Make the marker of the copyright tests known to pytest."""

from __future__ import annotations

import pytest


def pytest_configure(config: pytest.Config) -> None:
    """
    Register the marker `copyright` with pytest.

    Parameters
    ----------
    config
        The configuration of pytest.

    """
    config.addinivalue_line('markers', 'copyright: checks copyright headers')
