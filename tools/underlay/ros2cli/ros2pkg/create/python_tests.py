# SPDX-License-Identifier: Apache-2.0
"""The tests that every new Python package starts with."""

from __future__ import annotations

FLAKE8 = """\
from ament_flake8.main import main_with_errors
import pytest


@pytest.mark.flake8
@pytest.mark.linter
def test_flake8():
    rc, errors = main_with_errors(argv=[])
    assert rc == 0, f'{len(errors)} code style errors or warnings:\\n' + '\\n'.join(errors)
"""

PEP257 = """\
from ament_pep257.main import main
import pytest


@pytest.mark.linter
@pytest.mark.pep257
def test_pep257():
    rc = main(argv=['.', 'test'])
    assert rc == 0, 'Found code style errors or warnings'
"""

COPYRIGHT = """\
from ament_copyright.main import main
import pytest


# Remove the `skip` decorator once the source files have a copyright header.
@pytest.mark.skip(reason='The generated source files have no copyright header yet.')
@pytest.mark.copyright
@pytest.mark.linter
def test_copyright():
    rc = main(argv=['.', 'test'])
    assert rc == 0, 'Found errors'
"""

TESTS = {
    'test_copyright.py': COPYRIGHT,
    'test_flake8.py': FLAKE8,
    'test_pep257.py': PEP257,
}
