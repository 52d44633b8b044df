# SPDX-License-Identifier: Apache-2.0
"""Tests of the mend of Fast DDS, without which nodes now and then hang when they end."""

from __future__ import annotations

from pathlib import Path

from console import SetupError
from fast_dds import BROKEN, is_mended, libraries, mend_fast_dds, MENDED
import pytest

NAMES = ('libfastrtps.so', 'libfastrtps.so.2.14', 'libfastrtps.so.2.14.5')


@pytest.fixture
def environment(tmp_path: Path) -> Path:
    """Return an environment with the copies of the library that the wheel brings."""
    (tmp_path / 'lib').mkdir()
    for name in NAMES:
        library = tmp_path / 'lib' / name
        library.write_bytes(b'before' + BROKEN + b'after')
        library.chmod(0o755)
    return tmp_path


def test_all_copies_are_mended(environment: Path) -> None:
    """One instruction differs afterwards, however often it is done."""
    for _ in range(2):
        mend_fast_dds(environment)
        assert sorted(path.name for path in (environment / 'lib').iterdir()) == sorted(NAMES)
        for library in libraries(environment):
            assert library.read_bytes() == b'before' + MENDED + b'after'
            assert library.stat().st_mode & 0o777 == 0o755


@pytest.mark.parametrize('content', [b'', BROKEN * 2, BROKEN + MENDED])
def test_another_build_is_refused(environment: Path, content: bytes) -> None:
    """What the mend does not fit is left as it is, and the message names it."""
    library = environment / 'lib' / NAMES[1]
    library.write_bytes(content)
    with pytest.raises(SetupError, match='nodes could hang') as caught:
        mend_fast_dds(environment)
    assert str(library) in str(caught.value)
    assert library.read_bytes() == content


def test_no_library(tmp_path: Path) -> None:
    """An environment without the library is refused."""
    with pytest.raises(SetupError, match=r'no libfastrtps\.so'):
        mend_fast_dds(tmp_path)


def test_the_environment_of_these_tests_is_mended(root: Path) -> None:
    """What the nodes of this workspace load has the mend."""
    found = libraries(root / '.venv')
    assert [library.name for library in found] == list(NAMES)
    assert all(is_mended(library) for library in found)
