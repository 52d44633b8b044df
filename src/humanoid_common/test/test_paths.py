# SPDX-License-Identifier: Apache-2.0
"""Check how paths that users give are expanded."""

from __future__ import annotations

from pathlib import Path

from humanoid_common.errors import UserError
from humanoid_common.paths import expanded_path
import pytest


def test_home_folders(monkeypatch: pytest.MonkeyPatch) -> None:
    """`~` is that of the user, `~root` that of another one; elsewhere it is a letter."""
    monkeypatch.setenv('HOME', '/home/somebody')
    assert expanded_path('~/maps/room.yaml') == Path('/home/somebody/maps/room.yaml')
    assert expanded_path('~root/room.yaml') == Path('~root').expanduser() / 'room.yaml'
    assert expanded_path('maps/~nobody_here') == Path('maps/~nobody_here')


def test_a_home_folder_that_does_not_exist() -> None:
    """It is named in a sentence, with the way out."""
    with pytest.raises(UserError) as caught:
        expanded_path('~no_one/maps/room.yaml')
    assert str(caught.value) == (
        "'~no_one/maps/room.yaml' cannot be found: there is no home folder '~no_one'. Give the "
        'whole path, from / on.'
    )
