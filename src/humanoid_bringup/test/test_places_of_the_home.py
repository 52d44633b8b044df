# SPDX-License-Identifier: Apache-2.0
"""The named places of the apartment are those of its scene."""

from __future__ import annotations

from pathlib import Path

from humanoid_perception.places_file import places_path
from humanoid_simulation.scene_places import main


def test_the_file_of_places_is_that_of_the_scene(tmp_path: Path) -> None:
    """Whoever moves furniture writes it anew, with `scene_places`."""
    written, kept = tmp_path / 'places.yaml', places_path('apartment')
    assert main(['apartment', '--output', str(written)]) == 0
    assert kept is not None and written.read_text() == kept.read_text()
