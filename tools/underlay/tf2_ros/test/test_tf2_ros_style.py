# SPDX-License-Identifier: Apache-2.0
"""The style of the sources."""

from __future__ import annotations

from pathlib import Path

from ament_flake8.main import main_with_errors
from ament_pep257.main import main as pep257_main

PACKAGE = str(Path(__file__).parents[1])


def test_flake8() -> None:
    """The sources follow the style of ROS."""
    status, errors = main_with_errors(argv=[PACKAGE])
    assert status == 0, '\n'.join(errors)


def test_pep257() -> None:
    """The sources are documented in the style of ROS."""
    assert pep257_main(argv=[PACKAGE]) == 0
