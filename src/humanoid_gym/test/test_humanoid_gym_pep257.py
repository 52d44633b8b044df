# SPDX-License-Identifier: Apache-2.0
"""Check the docstrings."""

from __future__ import annotations

from ament_pep257.main import main
import pytest


@pytest.mark.linter
@pytest.mark.pep257
def test_pep257() -> None:
    """The docstrings follow PEP 257."""
    assert main(argv=['.', 'test']) == 0
