# SPDX-License-Identifier: Apache-2.0
"""Damage at many places of a recording costs one chunk at most: `make stories`."""

from __future__ import annotations

from pathlib import Path

from bag_damage import damage_everywhere
import pytest


@pytest.mark.parametrize('size', [1, 20])
@pytest.mark.parametrize('compression', ['none', 'zstd'])
def test_damage_anywhere_costs_one_chunk_at_most(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, size: int, compression: str
) -> None:
    """Whatever byte is damaged, reading tells it or is right, and recover saves the rest."""
    damage_everywhere(tmp_path / 'bag', monkeypatch, size, compression, step=97)
