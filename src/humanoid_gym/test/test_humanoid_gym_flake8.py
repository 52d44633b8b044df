# SPDX-License-Identifier: Apache-2.0
"""Check the style of the code."""

from __future__ import annotations

from ament_flake8.main import main_with_errors
import pytest


@pytest.mark.flake8
@pytest.mark.linter
def test_flake8() -> None:
    """The code follows the style of ROS."""
    status, errors = main_with_errors(argv=[])
    assert status == 0, '\n'.join(errors)
