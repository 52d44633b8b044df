# SPDX-License-Identifier: Apache-2.0
"""The sources keep the code style and are documented."""

from pathlib import Path

from ament_flake8.main import main_with_errors
from ament_pep257.main import main
import pytest

PACKAGE = str(Path(__file__).parents[1])


@pytest.mark.flake8
@pytest.mark.linter
def test_flake8() -> None:
    """There are no code style errors."""
    status, errors = main_with_errors(argv=[PACKAGE])
    assert status == 0, '\n'.join(errors)


@pytest.mark.linter
@pytest.mark.pep257
def test_pep257() -> None:
    """There are no documentation style errors."""
    assert main(argv=[PACKAGE]) == 0
